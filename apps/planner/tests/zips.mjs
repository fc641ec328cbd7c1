// What `apps/planner/zips` asks of the page:
//
//   node zips.mjs LIBRARY.wasm firmware BOARDS.js BOARD CHOICE OUT.zip   writes what the page's button for the firmware saves
//   node zips.mjs LIBRARY.wasm memory BOARDS.js BOARD CHOICE RAM FLASH   compares the RAM and flash that the page states for a board's
//                                                                       firmware with those of a linked image
//   node zips.mjs LIBRARY.wasm edits BOARDS.js                          compares the edits that make other ways to draw, and changes, with the
//                                                                       templates
//   node zips.mjs LIBRARY.wasm turn CHOICE FRAMES OUT                    writes the first pictures that the page shows of a turn, as a
//                                                                       display in 16-bit colour stores them, the high byte first
//   node zips.mjs LIBRARY.wasm estimate BOARDS.js BOARD CHOICE FRAMES SHOWN   compares the speed that the page shows with that of an
//                                                                       emulated board, in frames per second in the first steps of a turn
import { readFileSync, writeFileSync } from 'node:fs';
import '../page/ways.js';
import '../page/take.js';
import '../page/board.js';
import { withFiles } from './library.mjs';

const ALIGNMENT = 4; // of each buffer: a vertex cache, bins, and up to four strips with two of depths
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

  // What is in the image beside the buffers and the code that draws, such as a driver, is as much as in the board's own template.
  async memory(boards, board, choice, ram, flash) {
    const templates = await templatesOf(boards);
    const { width, height } = displayOf(templates, board) ?? {};
    const { chip = 'stm32f411' } = partsOf(board); // of its target
    const costs = JSON.parse(library.ask('costs', `${choice}&chip=${chip}${width ? `&width=${width}&height=${height}` : ''}`));
    const way = onBoard(costs.ways.find(({ chosen }) => chosen), board, await firmwareOf(library, templates, board), 0, { all: () => 1, rectangle: () => 1, columns: () => 1 });
    const off = 100 * (way.flash / flash - 1);
    console.log(`${board}: the page says ${way.ram} bytes of RAM and ${way.flash} of flash, linked are ${ram} and ${flash}: ${off.toFixed(0)} %`);
    return Math.abs(ram - way.ram) <= 8 * ALIGNMENT && Math.abs(off) <= costs.flashError;
  },

  // Each edit of a way to draw changes a source of some board: otherwise it is out of date.
  async edits(boards) {
    const templates = await templatesOf(boards);
    const texts = [...templates].filter(([path]) => path.endsWith('.rs')).map(([, bytes]) => new TextDecoder().decode(bytes));
    const [idle, used] = [new Set(), new Set()];
    const change = (text, edit) => {
      const made = edited(text, [edit]);
      if (made === text) idle.add(edit);
      else used.add(edit);
      return made;
    };
    for (const choice of ['order=mesh', 'order=painter', 'style=wireframe', 'style=hidden-line', 'whole=1', 'whole=1&style=wireframe', 'format=gray4', 'format=tricolor']) {
      const { sources } = editsOf(new URLSearchParams(choice), JSON.parse(library.ask('costs', choice)));
      texts.forEach((text) => sources.reduce(change, text));
    }
    for (const path of [...templates.keys()].filter((path) => path.endsWith('/smooth.diff'))) {
      const read = (name) => new TextDecoder().decode(templates.get(path.replace('smooth.diff', name)));
      for (const name of ['src/main.rs', 'src/picture.rs']) patched(read(name), name, read('smooth.diff'));
    }
    const outdated = [...idle].filter((edit) => !used.has(edit));
    outdated.forEach(([from]) => console.log(`no template has ${from}`));
    return outdated.length === 0;
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

  // The page states in which range its estimate lies.
  async estimate(boards, board, choice, frames, shown) {
    const templates = await templatesOf(boards);
    const facts = await firmwareOf(library, templates, board);
    const times = [0, 0];
    for (let turn = 0; turn < Number(frames); turn++) {
      const costs = JSON.parse(library.ask('costs', `${choice}&turn=${turn}`));
      const { pixels, about } = library.draw(`${choice}&turn=${turn}`);
      const way = onBoard(costs.ways.find(({ chosen }) => chosen), board, facts, 0, changedParts(pixels, about.width, about.height, 1));
      frameRates(costs, way).forEach((rate, at) => (times[at] += 1 / rate / Number(frames)));
    }
    const [slow, fast] = times.map((time) => 1 / time);
    console.log(`the page says ${slow.toFixed(1)} to ${fast.toFixed(1)} frames/s, the board shows ${shown}`);
    return slow <= shown && shown <= fast;
  },
};

process.exit((await VERBS[verb](...rest)) ? 0 : 1);
