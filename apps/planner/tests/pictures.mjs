// Draws by the library for browsers what the host drew, and compares checksums:
//
//   node pictures.mjs LIBRARY.wasm <LINES
//
// Each line of the input is `CHOICE CHECKSUM`, as pinhole-planner-pictures prints it.
import { readFileSync } from 'node:fs';
import '../page/pinhole.js';

const library = await Pinhole.from(readFileSync(process.argv[2]));
const lines = readFileSync(0, 'utf8').split('\n').filter(Boolean);
let failed = 0;
for (const line of lines) {
  const [choice, expected] = line.split(' ');
  let found;
  try {
    found = checksum(library.draw(choice).pixels);
  } catch (problem) {
    found = problem.message;
  }
  if (found !== expected) {
    failed += 1;
    if (failed <= 10) console.error(`${choice}: ${found}, on the host ${expected}`);
  }
}
console.log(`${lines.length - failed} of ${lines.length} pictures equal the host's`);
process.exit(failed === 0 && lines.length > 300 ? 0 : 1);

// FNV-1a of 32 bits.
function checksum(bytes) {
  let sum = 0x811c9dc5;
  for (const byte of bytes) sum = Math.imul(sum ^ byte, 0x01000193);
  return (sum >>> 0).toString(16).padStart(8, '0');
}
