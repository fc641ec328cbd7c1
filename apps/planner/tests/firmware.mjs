// Writes what the page's button for the firmware saves:
//
//   node firmware.mjs LIBRARY.wasm BOARDS.js BOARD CHOICE OUT.zip
import { readFileSync, writeFileSync } from 'node:fs';
import '../page/pinhole.js';
import '../page/take.js';

const [library, boards, board, choice, out] = process.argv.slice(2);
const [, packed] = /"([^"]*)"/.exec(readFileSync(boards, 'utf8'));
const files = firmware(await Pinhole.from(readFileSync(library)), untar(await unpacked(packed)), board, choice);
writeFileSync(out, zip(files));
