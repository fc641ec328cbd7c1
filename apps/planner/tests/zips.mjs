// What `apps/planner/zips` asks of the page:
//
//   node zips.mjs LIBRARY.wasm firmware BOARDS.js BOARD CHOICE OUT.zip   writes what the page's button for the firmware saves
//   node zips.mjs LIBRARY.wasm buffers BOARDS.js BOARD CHOICE RAM        compares the RAM that the page states for a board's firmware
//                                                                       with that of a linked image
//   node zips.mjs LIBRARY.wasm turn CHOICE FRAMES OUT                    writes the first pictures that the page shows of a turn, as a
//                                                                       display in 16-bit colour stores them, the high byte first
//   node zips.mjs LIBRARY.wasm estimate CHOICE FRAMES SHOWN              compares the speed that the page shows with that of an emulated
//                                                                       board, in frames per second in the first steps of a turn
import { readFileSync, writeFileSync } from 'node:fs';
import '../page/take.js';
import { withFiles } from './library.mjs';

const ALIGNMENT = 4; // of each buffer
const [file, verb, ...rest] = process.argv.slice(2);
const library = await withFiles(file);

async function templatesOf(boards) {
  const [, packed] = /"([^"]*)"/.exec(readFileSync(boards, 'utf8'));
  return untar(await unpacked(packed));
}

const VERBS = {
  async firmware(boards, board, choice, out) {
    writeFileSync(out, zip(firmware(library, await templatesOf(boards), board, choice)));
    return true;
  },

  // RAM are the bytes of the image's variables. Those that are no buffers, such as a driver's, are as many as in the board's own template,
  // whose README states its RAM with a gear: `boards/check` compares that with its image.
  async buffers(boards, board, choice, ram) {
    const templates = await templatesOf(boards);
    const read = (name) => new TextDecoder().decode(templates.get(`${board}/${name}`) ?? new Uint8Array());
    const { width, height } = displayOf(templates, board);
    const buffers = (text) => {
      const { ways } = JSON.parse(library.ask('costs', `${text}&width=${width}&height=${height}`));
      return buffersOf(board, ways.find(({ chosen }) => chosen));
    };
    const [, stated] = /^\*\*Memory\.\*\* \d+ bytes of flash and (\d+) of RAM/m.exec(read('README.md'));
    const [, rows] = /const ROWS: u32 = (\d+);/.exec(read('src/main.rs') + read('src/picture.rs'));
    const [, angle] = /Feature { degrees: (\d+)\.0 }/.exec(read('build.rs')) ?? [];
    const lines = angle ? `&style=hidden-line&format=mono&edges=${angle}` : '';
    const others = Number(stated) - buffers(`mesh=gear&rows=${rows}${lines}`);
    const [page, linked] = [buffers(choice), Number(ram) - others];
    console.log(`${board}: the page says ${page} bytes of buffers, linked are ${linked}, beside ${others} of the board's`);
    return Math.abs(linked - page) <= 4 * ALIGNMENT && others > 0;
  },

  turn(choice, frames, out) {
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
    return true;
  },

  // The page states how far its estimate may be off.
  estimate(choice, frames, shown) {
    let [seconds, error] = [0, 0];
    for (let turn = 0; turn < Number(frames); turn++) {
      const way = JSON.parse(library.ask('costs', `${choice}&turn=${turn}`)).ways.find(({ chosen }) => chosen);
      seconds += 1 / way.dma;
      error = Math.max(error, way.error);
    }
    const estimate = Number(frames) / seconds;
    const off = 100 * (estimate / Number(shown) - 1);
    console.log(`the page says ${estimate.toFixed(1)} frames/s, the board shows ${shown}: ${off.toFixed(0)} %, of ${Math.round(error)} % stated`);
    return Math.abs(off) <= error;
  },
};

process.exit((await VERBS[verb](...rest)) ? 0 : 1);
