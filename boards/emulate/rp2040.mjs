// Runs an image on an emulated RP2040 and reports what its SPI bus and its pins do.
//
//   node rp2040.mjs ROM IMAGE modules=FOLDER spi=0 wires=18,19 select=17 command=20 watch=21 log=ADDRESS
//
// ROM and IMAGE are ELF files. `modules` is the folder with node_modules, `wires` the pins of clock and data, `select` and
// `command` those at the display's CS and D/C, `watch` pins whose changes are reported, separated by commas, and `log` the
// address of the image's RTT control block. `inputs` are changes of pins from outside, `MILLISECONDS:PIN=LEVEL` in the order of
// time, separated by commas; until its first one such a pin is high, as if pulled up. `tearing` is a pin at the display's TE. With byte N, `fail=N stalls=1` lets DMA wait
// for ever, until it is aborted, and `fail=N stalls=0` lets it end with an error of its bus. rp2040js counts cycles as the
// Cortex-M0+ does; flash is as fast as RAM, because
// misses of its cache are not modelled, nor is the second core.

import { writeSync } from 'node:fs';
import { loadFlash, loadRom, rp2040js } from './boot.mjs';

// The records by which an emulator reports on standard output; src/events.rs reads them. A record has 8 bytes: a value, a kind,
// and a time of 48 bits in nanoseconds, which suffice for three days; little-endian.
/** A byte on the bus: bit 0 is the D/C line at its last bit (high for data), bit 1 the select line (high if not selected). */
const BYTE = 0x00;
/** A pin has changed: its number, and its level in bit 7. */
const PIN = 0x10;
/** A byte of the log. */
const LOG = 0x20;
/** In place of the time: how long the core has waited for the bus since the last of these records. */
const WAITED = 0x30;
/** Nothing but the time. */
const TIME = 0x40;
/** In place of the time: how long a byte takes on the bus, from now on. */
const CLOCK = 0x60;
/** The emulator has broken the bus, as it was asked to. */
const BROKEN = 0x50;
/** The chip was reset: 1 by its firmware, 0 by its watchdog. */
const RESET = 0x70;

const buffer = Buffer.alloc(1 << 16);
let filled = 0;

function report(kind, value, nanoseconds) {
  buffer[filled] = value;
  buffer[filled + 1] = kind;
  buffer.writeUIntLE(Math.round(nanoseconds), filled + 2, 6);
  filled += 8;
  if (filled === buffer.length) flush();
}

function flush() {
  for (let written = 0; written < filled; ) {
    try {
      written += writeSync(1, buffer, written, filled - written);
    } catch (error) {
      // The reader has seen enough.
      if (error.code === 'EPIPE') process.exit(0);
      throw error;
    }
  }
  filled = 0;
}

const [rom, image, ...rest] = process.argv.slice(2);
const options = Object.fromEntries(rest.map((option) => option.split(/=(.*)/s)));
const number = (name) => Number(options[name]);
const { ConsoleLogger, GPIOPinState, LogLevel, RP2040 } = rp2040js(options.modules);

const mcu = new RP2040();
mcu.logger = new ConsoleLogger(LogLevel.Error, true);
const { clock, core } = mcu;

function fail(problem) {
  flush();
  console.error(`${problem}, at ${core.PC.toString(16)} after ${(clock.nanos / 1e6).toFixed(3)} ms`);
  process.exit(1);
}

loadRom(mcu, rom);
loadFlash(mcu, image);
mcu.onBreak = (code) => {
  const letters = String.fromCharCode(core.registers[1] & 0xff, core.registers[1] >> 8);
  fail(code === 1 ? `boot.s has no function ${letters}` : code === 2 ? 'HardFault' : `breakpoint ${code}`);
};

// Levels of pins: not driven counts as high, as if pulled up.
const levels = Array.from(mcu.gpio, () => true);
const [select, command] = [number('select'), number('command')];
let unselected = false; // at any time of the byte that is being sent
const watched = (options.watch ?? '').split(',').filter(Boolean).map(Number);
mcu.gpio.forEach((pin, index) =>
  pin.addListener((state) => {
    levels[index] = state !== GPIOPinState.Low;
    if (index === select && levels[index]) unselected = true;
    if (watched.includes(index)) report(PIN, index | (levels[index] ? 0x80 : 0), clock.nanos);
  }),
);

// Pins that are driven from outside.
const changes = (options.inputs ?? '').split(',').filter(Boolean).map((change) => change.split(/[:=]/).map(Number));
for (const [, pin] of changes) mcu.gpio[pin].setInputValue(true);
let driven = 0;
const nextChange = clock.createAlarm(() => {
  const [, pin, level] = changes[driven++];
  mcu.gpio[pin].setInputValue(level === 1);
  scheduleChange();
});
function scheduleChange() {
  if (driven < changes.length) nextChange.schedule(Math.max(changes[driven][0] * 1e6 - clock.nanos, 0));
}
scheduleChange();

// TE, as src/watch.rs has it: high in the first lines of a refresh, if the display was told to drive it (TEON).
const [LINE, LINES, PORCH, TEON] = [48449, 344, 24, 0x35];
let drivesTe = false;
const tearing = number('tearing'); // NaN: not connected
const edge = clock.createAlarm(() => {
  const line = Math.round(clock.nanos / LINE) % LINES;
  mcu.gpio[tearing].setInputValue(drivesTe && line < PORCH);
  edge.schedule((line < PORCH ? PORCH - line : LINES - line) * LINE);
});
if (!Number.isNaN(tearing)) edge.schedule(0);

// The bus. A byte takes its bits' time; the display takes D/C at the last bit, and must be selected from the first one.
const spi = mcu.spi[number('spi')];
const FUNCTION_SPI = 1;
const wires = options.wires.split(',').map(Number);
let [shifted, byteTime] = [0, 0];
let untilFault = number('fail'); // NaN: none
const arrived = clock.createAlarm(() => {
  if (untilFault-- === 0) breakDma(number('stalls') === 1);
  drivesTe ||= !levels[command] && (shifted & 0xff) === TEON;
  const lines = (levels[command] ? 1 : 0) | (unselected ? 2 : 0);
  if (spi.dataBits === 16) report(BYTE | lines, shifted >> 8, clock.nanos - byteTime);
  report(BYTE | lines, shifted & 0xff, clock.nanos);
  spi.completeTransmit(0);
});
spi.onTransmit = (value) => {
  const { control0, dataBits, clockFrequency } = spi;
  // Mode 0 or 3: the display takes a bit when the clock rises.
  if (((control0 >> 6) & 1) !== ((control0 >> 7) & 1)) fail('the SPI is neither in mode 0 nor in mode 3');
  for (const pin of wires) {
    if (mcu.gpio[pin].functionSelect !== FUNCTION_SPI) fail(`pin ${pin} is not the SPI's`);
  }
  if (dataBits !== 8 && dataBits !== 16) fail(`an SPI frame of ${dataBits} bits`);
  if (byteTime !== 8e9 / clockFrequency) report(CLOCK, 0, (byteTime = 8e9 / clockFrequency));
  shifted = value;
  unselected = levels[select];
  arrived.schedule((dataBits * 1e9) / clockFrequency);
};

// A running channel of DMA is not served any more, or its bus reports an error: it halts, raises its interrupt, and does not start
// before the flag is cleared.
const [AHB_ERROR, ERRORS] = [2 ** 31, (1 << 30) | (1 << 29)]; // READ_ERROR, WRITE_ERROR
function breakDma(stalls) {
  report(BROKEN, 0, clock.nanos);
  for (const channel of mcu.dma.channels.filter(({ active }) => active)) {
    channel.transferAlarm.cancel();
    if (stalls) {
      channel.scheduleTransfer = () => {};
      channel.abort = () => {
        delete channel.scheduleTransfer;
        delete channel.abort;
        channel.abort();
      };
      continue;
    }
    channel.ctrl = (channel.ctrl & ~BUSY) | (1 << 30);
    mcu.dma.intRaw |= 1 << channel.index;
    mcu.dma.checkInterrupts();
    channel.start = () => {
      if (channel.ctrl & ERRORS) fail('DMA is started with an error of the transfer before');
      delete channel.start;
      channel.start();
    };
  }
}

// A reset by the watchdog's timer, or by its trigger. Registers of peripherals keep what they have.
const watchdog = mcu.peripherals[0x40058];
let restarts = false;
watchdog.onWatchdogTrigger = () => {
  report(RESET, watchdog.reason >> 1, clock.nanos);
  restarts = true;
};
function restart() {
  restarts = false;
  for (const channel of mcu.dma.channels) {
    channel.abort();
    channel.ctrl &= ~ERRORS;
  }
  watchdog.writeUint32(0, 0);
  Object.assign(core, { VTOR: 0, PM: false, waiting: false, pendingInterrupts: 0 });
  core.reset();
}

// Waiting: the core polls a status that says that SPI or DMA are busy, or it sleeps. Two polls that are further apart than a loop
// takes are not one wait.
const LOOP = 100;
let [waited, polled] = [0, 0];
function poll() {
  if (clock.nanos - polled < LOOP * cycle) waited += clock.nanos - polled;
  else if (waited > 0) reportWaiting();
  polled = clock.nanos;
}
function reportWaiting() {
  report(WAITED, 0, waited);
  waited = 0;
}
const [BUSY, CHANNELS, CONTROL, ABORT] = [1 << 24, 0x300, [0x0c, 0x10, 0x20, 0x30], 0x444];
const readDma = mcu.dma.readUint32.bind(mcu.dma);
mcu.dma.readUint32 = (offset) => {
  if (offset === ABORT) return 0; // done at once; rp2040js does not have it
  const value = readDma(offset);
  if (offset >= CHANNELS || !CONTROL.includes(offset & 0x3f)) return value;
  if (value & BUSY) poll();
  return value & ERRORS ? value + AHB_ERROR : value; // rp2040js has its two causes alone
};
const [SSPSR, BSY] = [0x0c, 1 << 4];
const readSpi = spi.readUint32.bind(spi);
spi.readUint32 = (offset) => {
  const value = readSpi(offset);
  if (offset === SSPSR && value & BSY) poll();
  return value;
};

// The log: takes out what the image has put into the first channel of RTT.
const rtt = number('log');
const [BUFFER, SIZE, WRITTEN, READ] = [28, 32, 36, 40].map((offset) => rtt + offset);
function takeLog() {
  const [start, size, end] = [BUFFER, SIZE, WRITTEN].map((address) => mcu.readUint32(address));
  let read = mcu.readUint32(READ);
  // Before the image has copied the initial values, the block holds anything.
  if (start < 0x20000000 || start + size > 0x20042000 || end >= size || read >= size) return;
  for (; read !== end; read = (read + 1) % size) report(LOG, mcu.readUint8(start + read), clock.nanos);
  mcu.writeUint32(READ, end);
}

const INTERVAL = 100_000;
let cycle = 8;
for (let next = INTERVAL; ; ) {
  for (let i = 0; i < 1000; i++) {
    if (restarts) restart();
    if (core.waiting) {
      const sleep = clock.nanosToNextAlarm;
      if (sleep <= 0 && !clock.nextAlarm) fail('the core sleeps, and nothing would wake it');
      waited += sleep;
      clock.tick(sleep);
    } else {
      clock.tick(core.executeInstruction() * cycle);
    }
  }
  cycle = 1e9 / mcu.clkSys;
  if (clock.nanos >= next) {
    if (Number.isFinite(rtt)) takeLog();
    report(TIME, 0, clock.nanos);
    next = clock.nanos + INTERVAL;
  }
}
