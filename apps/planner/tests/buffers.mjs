// Compares the RAM that the page states for a board's firmware with that of a linked image:
//
//   node buffers.mjs LIBRARY.wasm BOARDS.js BOARD CHOICE RAM
//
// RAM are the bytes of the image's variables. Those that are no buffers, such as a driver's, are as many as in the board's own template, whose
// README states its RAM with a gear: `boards/check` compares that with its image.
import { readFileSync } from 'node:fs';
import '../page/take.js';
import { withFiles } from './library.mjs';

const ALIGNMENT = 4; // of each buffer
const [file, boards, board, choice, ram] = process.argv.slice(2);
const [, packed] = /"([^"]*)"/.exec(readFileSync(boards, 'utf8'));
const templates = untar(await unpacked(packed));
const library = await withFiles(file);
const read = (name) => new TextDecoder().decode(templates.get(`${board}/${name}`) ?? new Uint8Array());

const { width, height } = displayOf(templates, board);
function buffers(text) {
  const { ways } = JSON.parse(library.ask('costs', `${text}&width=${width}&height=${height}`));
  return buffersOf(board, ways.find(({ chosen }) => chosen));
}

const [, stated] = /^\*\*Memory\.\*\* \d+ bytes of flash and (\d+) of RAM/m.exec(read('README.md'));
const [, rows] = /const ROWS: u32 = (\d+);/.exec(read('src/main.rs') + read('src/picture.rs'));
const [, angle] = /Feature { degrees: (\d+)\.0 }/.exec(read('build.rs')) ?? [];
const lines = angle ? `&style=hidden-line&format=mono&edges=${angle}` : '';
const others = Number(stated) - buffers(`mesh=gear&rows=${rows}${lines}`);
const [page, linked] = [buffers(choice), Number(ram) - others];
console.log(`${board}: the page says ${page} bytes of buffers, linked are ${linked}, beside ${others} of the board's`);
process.exit(Math.abs(linked - page) <= 4 * ALIGNMENT && others > 0 ? 0 : 1);
