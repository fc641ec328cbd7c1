// Compares the speed that the page shows with that of an emulated board:
//
//   node estimate.mjs LIBRARY.wasm CHOICE FRAMES SHOWN
//
// SHOWN is the number of frames per second in the first FRAMES steps of a turn. The page states how far its estimate may be off.
import { withFiles } from './library.mjs';

const [file, choice, frames, shown] = process.argv.slice(2);
const library = await withFiles(file);
let [seconds, error] = [0, 0];
for (let turn = 0; turn < Number(frames); turn++) {
  const way = JSON.parse(library.ask('costs', `${choice}&turn=${turn}`)).ways.find(({ chosen }) => chosen);
  seconds += 1 / way.dma;
  error = Math.max(error, way.error);
}
const estimate = Number(frames) / seconds;
const off = 100 * (estimate / Number(shown) - 1);
console.log(`the page says ${estimate.toFixed(1)} frames/s, the board shows ${shown}: ${off.toFixed(0)} %, of ${Math.round(error)} % stated`);
process.exit(Math.abs(off) <= error ? 0 : 1);
