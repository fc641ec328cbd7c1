// What a board's own firmware costs: the costs of a choice with the board's clocks, bus and strips, and with what else is in the firmware.
// For the page and for node.
'use strict';

const inTemplates = (templates, path) => new TextDecoder().decode(templates.get(path) ?? new Uint8Array());

// A board's row in boards/README.md: MHz of its core and its bus, 0 if it takes any chip; how many cores draw, whether one band is drawn
// while another is sent, what it sends (all, the rectangle that has changed, or of each band
// the columns that have changed), and what is stated of its firmware with a gear: of one for any chip, by the core.
function factsOfBoard(templates, board, core = '') {
  const row = inTemplates(templates, 'README.md').split('\n').find((line) => line.startsWith(`| [${board}]`)) ?? '';
  const [, , cores, , wiring, bands, ...sizes] = row.split('|');
  const rows = inTemplates(templates, `${board}/README.md`).split('\n').map((line) => line.split(' | '));
  const [, , ...ofCore] = rows.find(([target, of]) => target.startsWith('| `') && of?.split(', ').includes(core)) ?? [];
  const [flash, ram] = (ofCore.length ? ofCore : sizes).map(parseFloat);
  const number = (pattern, text) => Number(pattern.exec(text)?.[1] ?? 0);
  return {
    clock: number(/([\d.]+) MHz/, cores),
    // I²C has nine bits a byte.
    bus: number(/SPI at ([\d.]+) MHz/, wiring) || (number(/I2C at (\d+) kHz/, wiring) * 8) / 9000,
    cores: /^ two/.test(cores) ? 2 : 1, hasDma: /DMA/.test(bands), sends: /each band/.test(bands) ? 'columns' : /changed/.test(bands) ? 'rectangle' : 'all',
    flash, ram, frames: (sizes[2] ?? '').trim(),
  };
}

// The choice that a template draws as it comes, on its own chip, if it has one.
function choiceOfTemplate(templates, board, chip = 'stm32f411') {
  const { chip: own = chip, format } = partsOf(board);
  const read = (name) => inTemplates(templates, `${board}/${name}`);
  const [, rows] = /const ROWS: u32 = (\d+);/.exec(read('src/main.rs') + read('src/picture.rs'));
  const [, angle] = /Feature { degrees: (\d+)\.0 }/.exec(read('build.rs')) ?? [];
  const { width, height } = displayOf(templates, board) ?? { width: 240, height: 240 };
  const look = angle ? `&style=hidden-line&edges=${angle}` : '';
  return `mesh=gear&chip=${own}&format=${format}&width=${width}&height=${height}&rows=${rows}${look}`;
}

// The facts of a board, with the bytes of RAM and flash that its firmware has beside the buffers and the code of a way to draw: driver, log, HAL.
async function firmwareOf(library, templates, board, chip) {
  const { core, ways } = JSON.parse(await library.ask('costs', choiceOfTemplate(templates, board, chip)));
  const way = ways.find(({ chosen }) => chosen);
  const facts = factsOfBoard(templates, board, core);
  return { ...facts, rest: { ram: facts.ram - buffersOf(board, way), flash: facts.flash - way.flash } };
}

// Two cores take this part of the time of one (docs/data/cells.json, cores16-z by bands16-z: 0.56 to 0.58).
const OF_TWO_CORES = 0.58;
// The part of the shorter of drawing and sending that the longer one does not hide, as bands differ: tests/boards.mjs prints that of each emulated board.
const NOT_HIDDEN = 0.4;

// A way to draw as a board's firmware draws it, on a panel that takes `spi` MHz (0: as many as the board has), if these parts of the
// picture change from frame to frame.
function onBoard(way, board, facts, spi, changing) {
  const [{ strips, depths, width }, { rest }] = [partsOf(board), facts];
  const [cache, bins, pixels, depth, smooth] = way.parts;
  // `smooth` has two rows that wait of one strip and one band of depths, and `kept`. Each further strip, or band of depths, has two, too.
  const waiting = smooth && (2 / way.rows) * (width * (strips * pixels + pixels + depths * depth) - 2 * pixels - depth);
  const parts = [cache, bins, width * strips * pixels, width * depths * depth, smooth + waiting, rest.ram];
  const [ram, flash] = [parts.reduce((sum, bytes) => sum + bytes, 0), way.flash + rest.flash];
  const scale = (way.clock / (facts.clock || way.clock)) * (facts.cores > 1 ? OF_TWO_CORES : 1);
  const [drawing, range] = [way.drawing * scale, way.range.map((time) => time * scale)];
  const whole = facts.bus ? (way.bytes * 8) / (1000 * Math.min(facts.bus, spi || Infinity)) : way.bus;
  const bus = whole * changing[facts.sends === 'rectangle' && way.order === 'painter' ? 'all' : facts.sends](way.rows); // a painter has no bounds
  const [short, long] = [drawing, bus].sort((a, b) => a - b);
  const [blocking, dma] = [1000 / (drawing + bus), 1000 / (long + NOT_HIDDEN * short)];
  const fits = Number(ram + way.beside < way.room);
  return {
    ...way, parts, ram, flash, drawing, range, bus, blocking, dma, hasDma: facts.hasDma, fits, fitsTwice: fits, fitsFlash: Number(flash < way.rom),
    frames: facts.hasDma ? dma : blocking, limit: drawing > bus ? 'CPU' : 'bus',
  };
}

// The least and the most frames per second, if the instructions and the cycles of one are off as far as they can be, in one direction; by
// DMA at worst nothing is sent while a band is drawn, and at best all is.
function frameRates({ cyclesError }, { drawing, bus, error, range, hasDma }) {
  const off = (1 + error / 100) * (1 + (range.length ? 0 : cyclesError) / 100);
  const [least, most] = range.length ? range : [drawing, drawing];
  return [1000 / (most * off + bus), 1000 / (hasDma ? Math.max(least / off, bus) : least / off + bus)];
}

// The parts of a picture that change while the model turns: the rectangle around what is drawn, as far as the corner shows the background, in
// steps of rows (a display of one bit a pixel has eight rows in a byte), and the columns of each band of so many rows of this rectangle. A panel's rows lie along
// its shorter side.
function changedParts(pixels, width, height, step) {
  const words = new Uint32Array(pixels.buffer, pixels.byteOffset, width * height);
  const isTurned = width > height && step === 1;
  const join = ([first, last], [from, to]) => [Math.min(first, from), Math.max(last, to)];
  const rows = Array(isTurned ? width : height).fill([Infinity, -Infinity]);
  words.forEach((word, at) => {
    if (word === words[0]) return;
    const [column, row] = isTurned ? [Math.floor(at / width), at % width] : [at % width, Math.floor(at / width)];
    rows[row] = join(rows[row], [column, column]);
  });
  const [top, bottom] = rows.reduce((ends, [first], row) => (first < Infinity ? join(ends, [row, row]) : ends), [Infinity, -Infinity]);
  const from = Math.floor(top / step) * step;
  const part = (band) => {
    let sum = 0;
    for (let row = from; row <= bottom; row += band) {
      const [first, last] = rows.slice(row, row + band).reduce(join);
      sum += Math.max(last - first + 1, 0) * Math.min(band, Math.ceil((bottom + 1 - row) / step) * step);
    }
    return Math.min(sum / (width * height), 1);
  };
  const rectangle = () => part(width + height);
  return { all: () => 1, rectangle, columns: (rows) => (rows ? part(rows) : rectangle()) };
}

Object.assign(globalThis, { factsOfBoard, choiceOfTemplate, firmwareOf, NOT_HIDDEN, onBoard, frameRates, changedParts });
