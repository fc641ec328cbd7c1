// Reads and writes archives. For the page and for node.
'use strict';

// The files of a tar archive: a Map from paths to bytes.
function untar(bytes) {
  const files = new Map();
  const text = (from, to) => new TextDecoder().decode(bytes.subarray(from, to)).replace(/\0.*$/s, '');
  for (let at = 0; at + 512 <= bytes.length && bytes[at] !== 0; ) {
    const size = parseInt(text(at + 124, at + 136), 8);
    if (text(at + 156, at + 157) === '0') files.set(text(at, at + 100), bytes.slice(at + 512, at + 512 + size));
    at += 512 + Math.ceil(size / 512) * 512;
  }
  return files;
}

// A ZIP archive of files, uncompressed: a Map from paths to bytes (PKWARE, APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16).
function zip(files) {
  const parts = [];
  const directory = [];
  let at = 0;
  for (const [path, bytes] of files) {
    const name = new TextEncoder().encode(path);
    // Version 1.0, UTF-8 names, stored, 1 January 2026, 0:00.
    const common = [[20, 2], [0x0800, 2], [0, 2], [0, 2], [0x5c21, 2], [crc32(bytes), 4], [bytes.length, 4], [bytes.length, 4], [name.length, 2], [0, 2]];
    parts.push(numbers([[0x04034b50, 4], ...common]), name, bytes);
    directory.push(numbers([[0x02014b50, 4], [20, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]]), name);
    at += 30 + name.length + bytes.length;
  }
  const size = directory.reduce((sum, { length }) => sum + length, 0);
  const end = numbers([[0x06054b50, 4], [0, 2], [0, 2], [files.size, 2], [files.size, 2], [size, 4], [at, 4], [0, 2]]);
  const all = [...parts, ...directory, end];
  const out = new Uint8Array(all.reduce((sum, { length }) => sum + length, 0));
  all.reduce((place, part) => (out.set(part, place), place + part.length), 0);
  return out;
}

// Numbers of the given bytes each, the least significant byte first.
function numbers(list) {
  return Uint8Array.from(list.flatMap(([value, bytes]) => Array.from({ length: bytes }, (_, i) => (value >>> (8 * i)) & 255)));
}

function crc32(bytes) {
  let sum = -1;
  for (const byte of bytes) {
    sum ^= byte;
    for (let i = 0; i < 8; i++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

const DECIMATES = 'Its build decimates the model by a library in C++: install g++ or clang first.';

// Unpacks bytes in gzip in base64.
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The boards that draw this style in this pixel format, into a whole picture or in bands. A board that draws one strip while another is sent
// has bands, and the one with an OLED draws lines.
function boardsFor(templates, { style, format, whole }) {
  const isOfLines = ['wireframe', 'hidden-line'].includes(style);
  return boardsIn(templates).filter((board) => {
    const { controller, strips, format: own } = partsOf(board);
    return !controller || (own === format && !(whole && strips > 1) && (own !== 'mono' || isOfLines));
  });
}

// The boards of the archive. Beside their folders it has the lock file of all.
const boardsIn = (templates) => [...templates.keys()].filter((path) => path.endsWith('/src/main.rs')).map((path) => path.split('/')[0]);

// The boards of the archive with the titles of their READMEs, those for any display last.
function boardsOf(templates) {
  const title = (board) => new TextDecoder().decode(templates.get(`${board}/README.md`)).split('\n')[0].replace('# ', '');
  return boardsIn(templates).map((board) => [board, title(board)]).sort(([a], [b]) => a.startsWith('any-') - b.startsWith('any-'));
}

// A board's chip, by its name in a choice, and its bands in memory: those whose pixels are kept, as one is drawn while another is sent,
// and those whose depths are; how wide a band is, as a part of the picture's width, if the panel is turned; and its display's controller
// and format, an ST7789's in 16-bit colour if none is here. A board that is not here takes any chip and has one band.
const PARTS = {
  'any-cortex-m': { controller: '' },
  'esp32c3-st7789': { chip: 'esp32c3', strips: 2 },
  'nrf52840-embassy': { chip: 'nrf52840', strips: 3 },
  'rp2040-embassy': { chip: 'rp2040', strips: 3 },
  'rp2040-st7789': { chip: 'rp2040', strips: 2 },
  'rp2040-two-cores': { chip: 'rp2040', strips: 4, depths: 2 },
  'rp2350-embassy': { chip: 'rp2350-ram', strips: 3 },
  'stm32-ssd1306': { chip: 'stm32f411', controller: 'SSD1306', format: 'mono' },
  'stm32f4-ili9341': { chip: 'stm32f411', controller: 'ILI9341', strips: 2, width: 240 / 320 },
};
const partsOf = (board) => ({ strips: 1, depths: 1, width: 1, controller: 'ST7789', format: 'rgb565', ...PARTS[board] });

// The bytes of the buffers in a board's firmware, from those of one band.
function buffersOf(board, { parts: [cache, bins, pixels, depths] }) {
  const bands = partsOf(board);
  return cache + bins + bands.width * (bands.strips * pixels + bands.depths * depths);
}

// The sides of a board's display, from the beginning of its README; `null` for a board that takes any display.
function displayOf(templates, board) {
  const readme = new TextDecoder().decode(templates.get(`${board}/README.md`));
  const [, width, height] = /(\d+) × (\d+)/.exec(readme) ?? [];
  return width ? { width: Number(width), height: Number(height) } : null;
}

// The folder `firmware` of a board that draws a choice on its display, made from the archive of templates: a Map from paths to bytes.
function firmware(library, templates, board, text) {
  const files = new Map();
  const parts = new URLSearchParams(text);
  for (const [side, pixels] of Object.entries(displayOf(templates, board) ?? {})) parts.set(side, pixels);
  // Each core draws a band of a strip, and strips fill the display.
  const [rows, height] = ['rows', 'height'].map((key) => Number(parts.get(key)));
  if (board === 'rp2040-two-cores' && height % (2 * rows)) {
    throw new Error(`Each core of ${board} draws every other band, as many as the other one: choose a number of rows that divides ${height / 2}.`);
  }
  const choice = [...parts].map(([key, value]) => `${key}=${value}`).join('&');
  const hasHiddenLines = new TextDecoder().decode(templates.get(`${board}/src/picture.rs`)).includes('.hidden_line(');
  const change = templates.get(`${board}/smooth.diff`);
  const { files: ofAll, sources, changed, isSmoothed } = editsOf(parts, JSON.parse(library.ask('costs', choice)), hasHiddenLines, Boolean(change));
  const diff = isSmoothed ? new TextDecoder().decode(change) : '';
  for (const [path, bytes] of templates) {
    const inside = path.slice(board.length + 1);
    if (!path.startsWith(`${board}/`) || inside === 'smooth.diff') continue;
    const add = (name) => {
      const text = new TextDecoder().decode(bytes);
      const template = edited(name === 'build.rs' ? text : patched(text, name, diff), ofAll); // the library writes build.rs with edges
      const source = name.endsWith('.rs') ? edited(template, sources) : template;
      const made = library.ask('firmware', [choice, name, source].join('\0'));
      files.set(`firmware/${name}`, new TextEncoder().encode(withoutUnused(edited(made, changed[name] ?? []))));
    };
    add(inside);
    if (inside === 'src/picture.rs' && parts.get('style') === 'textured') add('src/texture.rs');
  }
  files.set('firmware/Cargo.lock', templates.get('Cargo.lock'));
  if (parts.get('format') === 'tricolor') files.set('firmware/src/tricolor.rs', templates.get('tricolor.rs'));
  for (const [name, bytes] of library.model(choice)) files.set(`firmware/${name}`, bytes);
  return files;
}

Object.assign(globalThis, { DECIMATES, untar, zip, unpacked, boardsFor, boardsOf, buffersOf, partsOf, displayOf, firmware });
