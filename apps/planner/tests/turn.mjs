// Writes the pictures that the page shows of a turn, as a display in 16-bit colour stores them:
//
//   node turn.mjs LIBRARY.wasm CHOICE FRAMES OUT
//
// Writes the first FRAMES steps of a turn, one picture after the other, two bytes per pixel, the high byte first.
import { writeFileSync } from 'node:fs';
import { withFiles } from './library.mjs';

const [file, choice, frames, out] = process.argv.slice(2);
const library = await withFiles(file);
const pictures = [];
for (let turn = 0; turn < Number(frames); turn++) {
  const { pixels } = library.draw(`${choice}&turn=${turn}`);
  const stored = Buffer.alloc(pixels.length / 2);
  for (let at = 0; at < pixels.length; at += 4) {
    // A channel of 5 or 6 bits is spread over 8 bits: its highest bits are the channel.
    const [r, g, b] = [pixels[at] >> 3, pixels[at + 1] >> 2, pixels[at + 2] >> 3];
    stored.writeUInt16BE((r << 11) | (g << 5) | b, at / 2);
  }
  pictures.push(stored);
}
writeFileSync(out, Buffer.concat(pictures));
