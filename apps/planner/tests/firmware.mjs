// Writes what the page's button for the firmware saves:
//
//   node firmware.mjs LIBRARY.wasm BOARDS.js BOARD CHOICE OUT.zip
import { readFileSync, writeFileSync } from 'node:fs';
import '../page/take.js';
import { withFiles } from './library.mjs';

const [library, boards, board, choice, out] = process.argv.slice(2);
const [, packed] = /"([^"]*)"/.exec(readFileSync(boards, 'utf8'));
const files = firmware(await withFiles(library), untar(await unpacked(packed)), board, choice);
writeFileSync(out, zip(files));
