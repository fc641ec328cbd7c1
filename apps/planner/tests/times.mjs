// Compares the instructions and cycles that the page states with those of linked firmware:
//
//   node times.mjs LIBRARY.wasm images           prints the images of apps/planner/linked whose times the page states
//   node times.mjs LIBRARY.wasm compare FILE     compares what `tools/bench/run images` prints of them, in a file, with the page
import { readFileSync } from 'node:fs';
import { IMAGES, costsBy } from './images.mjs';

const [file, verb, printed] = process.argv.slice(2);
const { library, costs } = await costsBy(file);

// The page's chips by their names, and the emulated cores of their images.
const chips = new Map(library.menu().chips.map(({ key, name }) => [name, key]));

function compare(lines) {
  const largest = new Map();
  let wrong = 0;
  for (const [path, chip, counted, ...taken] of lines) {
    const image = path.split('/').at(-1);
    const [choice, name] = IMAGES[image];
    const { ways, cyclesError } = costs(`${choice}&chip=${chips.get(chip)}`);
    const way = ways.find((other) => other.name === name);
    // For an ESP32-C3 the likely cycles, which lie between the least and the most.
    const cycles = Number(taken.length === 3 ? taken[1] : taken[0]);
    const [off, per] = [way.instructions / counted - 1, way.cycles / way.instructions / (cycles / counted) - 1].map((part) => 100 * part);
    const isGood = Math.abs(off) <= way.error && Math.abs(per) <= cyclesError;
    wrong += isGood ? 0 : 1;
    for (const [what, size] of [[`${name.replace(/\d+/, 'N')}`, off], [`cycles an instruction, ${chip}`, per]]) {
      if (Math.abs(size) > Math.abs(largest.get(what) ?? 0)) largest.set(what, size);
    }
    console.log(`${isGood ? 'ok' : 'WRONG'}: ${chip}, ${image}: instructions ${way.instructions}, counted ${counted}: ${off.toFixed(1)} %, stated ${way.error} %; cycles an instruction ${per.toFixed(1)} %, stated ${cyclesError} %`);
  }
  for (const [what, size] of largest) console.log(`at most ${size.toFixed(1)} %: ${what}`);
  // Every image was compared on every chip.
  return wrong === 0 && lines.length === Object.keys(IMAGES).length * chips.size;
}

if (verb === 'images') Object.keys(IMAGES).forEach((name) => console.log(name));
else if (!compare(readFileSync(printed, 'utf8').trim().split('\n').map((line) => line.split(';')))) process.exit(1);
