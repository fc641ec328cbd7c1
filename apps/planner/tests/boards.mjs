// Tests that the page's figures for each board's firmware are those of its README:
//
//   node boards.mjs LIBRARY.wasm BOARDS.js
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import '../page/pinhole.js';
import '../page/take.js';
import '../page/board.js';

const library = await Pinhole.from(readFileSync(process.argv[2]));
const [, packed] = /"([^"]*)"/.exec(readFileSync(process.argv[3], 'utf8'));
const templates = untar(await unpacked(packed));
const STEPS = 8; // of a turn

// The firmware for any chip, on each kind of core.
const sizes = [];
for (const chip of ['stm32f030', 'stm32f103', 'stm32f411', 'stm32h743', 'rp2350-ram', 'esp32c6', 'own&core=M0+']) {
  const { flash, rest } = await firmwareOf(library, templates, 'any-cortex-m', chip);
  sizes.push(flash);
  assert.ok(rest.flash > 1000 && rest.flash < 10_000 && rest.ram > 0, `${chip}: ${JSON.stringify(rest)}`);
}
const [m0, m3, m4, m7, m33, rv32, own] = sizes;
assert.ok(m0 > m3 && rv32 > m3 && m33 !== m4, sizes.join(', '));
assert.deepEqual([m7, own], [m4, m0]);

let compared = 0;
const parts = []; // of the shorter of drawing and sending, that the longer one does not hide
for (const [board] of boardsOf(templates)) {
  const facts = await firmwareOf(library, templates, board);
  const times = [0, 0, 0]; // of frames at the least and the most rate, and of sending
  for (let step = 0; step < STEPS; step++) {
    const choice = `${choiceOfTemplate(templates, board)}&turn=${(120 / STEPS) * step}`;
    const { pixels, about } = library.draw(choice);
    const changing = changedParts(pixels, about.width, about.height, /format=mono/.test(choice) ? 8 : 1);
    const costs = JSON.parse(library.ask('costs', choice));
    const way = onBoard(costs.ways.find(({ chosen }) => chosen), board, facts, 0, changing);
    assert.deepEqual([way.ram, way.flash], [facts.ram, facts.flash], board);
    assert.ok(facts.rest.ram > 0 && facts.rest.flash > 0, board);
    const [slow, fast] = frameRates(costs, way);
    [1000 / slow, 1000 / fast, way.bus].forEach((time, at) => (times[at] += time / STEPS));
  }
  const readme = new TextDecoder().decode(templates.get(`${board}/README.md`));
  const [, ...run] = /^\*\*Speed\.\*\* ([\d.]+) frames\/s, (\d+) % of the time waiting for the bus, (\d+) bytes/m.exec(readme) ?? [];
  if (run.length) {
    const [frames, waits, bytes] = run.map(Number);
    const [short, long] = [(1000 / frames) * (1 - waits / 100), (bytes * 8) / (1000 * facts.bus)].sort((a, b) => a - b);
    parts.push((1000 / frames - long) / short);
  }
  const [slow, fast, bus] = times.map((time) => 1000 / time);
  const [, isLimit, stated] = /^(at most )?([\d.]+)$/.exec(facts.frames) ?? [];
  console.log(`${board}: its README says ${facts.frames || 'nothing'}, the page ${slow.toFixed(1)} to ${fast.toFixed(1)} frames/s, by the bus alone ${bus.toFixed(1)}`);
  if (!stated) continue;
  compared += 1;
  if (isLimit) assert.ok(Math.abs(bus / stated - 1) < 0.1, board);
  else assert.ok(slow <= stated && stated <= fast, board);
}
console.log(`not hidden: ${parts.map((part) => part.toFixed(2)).join(', ')}, the page takes ${NOT_HIDDEN}`);
assert.ok(parts.length >= 3 && Math.min(...parts) < NOT_HIDDEN && NOT_HIDDEN < Math.max(...parts));
assert.ok(compared >= 7, `${compared} figures of boards/README.md are compared`);
