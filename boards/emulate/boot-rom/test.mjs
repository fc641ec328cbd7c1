// The functions of the boot ROM, on the emulated core: `boards/emulate/test` builds the ROM and runs this.
//
//   node test.mjs ROM modules=FOLDER

import assert from 'node:assert/strict';
import test from 'node:test';
import { loadRom, rp2040js } from '../boot.mjs';

const [rom, modules] = process.argv.slice(2);
const { RP2040 } = rp2040js(modules.split('=')[1]);
const refuse = (_, problem) => assert.fail(problem); // such as a word at an address that is no multiple of 4
const mcu = new RP2040();
loadRom(mcu, rom);
mcu.logger = { debug: refuse, info: refuse, warn: refuse, error: refuse };
const write = mcu.writeUint32.bind(mcu);
mcu.writeUint32 = (address, value) => {
  assert.equal(address % 4, 0, 'a word at a multiple of 4');
  write(address, value);
};
let stopped;
mcu.onBreak = (code) => (stopped = code);

const [RAM, END] = [0x20000000, 0x20041000];
const { core } = mcu;

/** Calls a function as firmware does, and returns r0; it may change only the registers that a callee may change. */
function call(address, ...args) {
  assert.equal(address & 1, 1, 'an address of Thumb code');
  const saved = [4, 5, 6, 7, 8, 9, 10, 11].map((register) => [register, 0xa5a50000 + register]);
  for (const [register, value] of saved) core.registers[register] = value;
  core.SP = END;
  args.forEach((value, register) => (core.registers[register] = value));
  core.LR = END | 1;
  core.PC = address & ~1;
  stopped = undefined;
  for (let steps = 0; core.PC !== END && stopped === undefined; steps++) {
    assert.ok(steps < 10000, 'it returns');
    core.executeInstruction();
  }
  if (stopped !== undefined) return undefined;
  assert.equal(core.SP, END);
  for (const [register, value] of saved) assert.equal(core.registers[register], value, `r${register}`);
  return core.registers[0];
}

const code = (letters) => letters.charCodeAt(0) | (letters.charCodeAt(1) << 8);
const lookup = (letters, table = 0x14) => call(mcu.readUint16(0x18), mcu.readUint16(table), code(letters));

test('a reset starts the second stage of booting, which nobody has called', () => {
  core.reset();
  for (let steps = 0; core.PC < RAM && core.PC < 0x10000000; steps++) {
    assert.ok(steps < 10);
    core.executeInstruction();
  }
  assert.deepEqual([core.PC, core.LR, core.SP], [0x10000000, 0, 0x20042000]);
});

test('what is not in a table stops the emulator', () => {
  for (const [letters, table] of [['UB', 0x14], ['CR', 0x16]]) {
    assert.equal(lookup(letters, table), undefined);
    assert.deepEqual([stopped, core.registers[1]], [1, code(letters)]);
  }
});

// Bytes that all differ, between two that must stay.
const LONGEST = 64;
const pattern = (i) => (i * 37 + 11) & 0xff;
const [TO, FROM] = [RAM + 0x100, RAM + 0x200];
function filled(to, changed, what) {
  for (let i = -8; i < LONGEST + 16; i++) {
    assert.equal(mcu.readUint8(TO + i), changed(TO + i - to) ?? 0xee, `${what}: byte ${TO + i - to}`);
  }
}
function prepare() {
  for (let i = -8; i < LONGEST + 16; i++) {
    mcu.writeUint8(TO + i, 0xee);
    mcu.writeUint8(FROM + i, pattern(i));
  }
}

for (const [letters, offsets] of [['MC', [0, 1, 2, 3]], ['C4', [0]]]) {
  test(`${letters} copies every length between all alignments`, () => {
    const copy = lookup(letters);
    for (const a of offsets) {
      for (const b of offsets) {
        for (let length = 0; length <= LONGEST; length++) {
          prepare();
          assert.equal(call(copy, TO + a, FROM + b, length), TO + a);
          filled(TO + a, (i) => (i >= 0 && i < length ? pattern(b + i) : undefined), `${length} from ${b} to ${a}`);
        }
      }
    }
  });
}

for (const [letters, offsets] of [['MS', [0, 1, 2, 3]], ['S4', [0]]]) {
  test(`${letters} fills every length at all alignments with the lowest byte`, () => {
    const fill = lookup(letters);
    for (const a of offsets) {
      for (let length = 0; length <= LONGEST; length++) {
        prepare();
        assert.equal(call(fill, TO + a, 0xffffff5a, length), TO + a);
        filled(TO + a, (i) => (i >= 0 && i < length ? 0x5a : undefined), `${length} at ${a}`);
      }
    }
  });
}

test('bits are counted and reversed', () => {
  const values = [0, 1, 2, 3, 0x80000000, 0xffffffff, 0x7fffffff, 0x00010000, 0x0000ffff, 0x12345678, 0xfedcba98];
  for (let bit = 0; bit < 32; bit++) values.push((1 << bit) >>> 0, (3 << bit) >>> 0, ~(1 << bit) >>> 0, (-1 << bit) >>> 0);
  const [ones, reversed, leading, trailing] = ['P3', 'R3', 'L3', 'T3'].map((letters) => lookup(letters));
  for (const value of values) {
    const digits = value.toString(2).padStart(32, '0');
    assert.equal(call(ones, value), digits.replaceAll('0', '').length, digits);
    assert.equal(call(reversed, value), Number.parseInt([...digits].reverse().join(''), 2), digits);
    assert.equal(call(leading, value), (digits + '1').indexOf('1'), digits);
    assert.equal(call(trailing, value), ([...digits].reverse().join('') + '1').indexOf('1'), digits);
  }
});
