// Compares what the page states with linked firmware, for `apps/planner/sizes`:
//
//   node linked.mjs LIBRARY.wasm models FOLDER       writes the mesh and the sizes of each image of apps/planner/linked
//   node linked.mjs LIBRARY.wasm sizes FOLDER...     compares the images in these folders, TARGET/release, with the page
//   node linked.mjs LIBRARY.wasm images              prints the images whose times the page states
//   node linked.mjs LIBRARY.wasm times FILE          compares what `tools/bench/run images` prints of them, in a file, with the page
//
// RAM is the image's variables, which must equal the page's figure, except that the linker may align each. Flash is the image's
// flash less that of an image that draws nothing, and must be within the error that the page states.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import '../page/pinhole.js';

// For each image: the choice, the way to draw in the page's table, and the parameters of its source.
const IMAGES = {
  flat_bands: ['mesh=gear&width=128&height=128&rows=8', 'bands of 8 rows, with depth', 'flat'],
  smooth_bands: ['mesh=teapot&width=160&height=120&style=gouraud&rows=8', 'bands of 8 rows, with depth', 'smooth'],
  dithered_bands: ['mesh=torus&width=128&height=160&dither=1&rows=16', 'bands of 16 rows, with depth', 'dithered'],
  smooth_dithered_bands: ['mesh=cylinder&width=128&height=128&style=gouraud&dither=1&rows=8', 'bands of 8 rows, with depth', 'smooth dithered'],
  textured_bands: ['mesh=torus&width=160&height=120&style=textured&rows=8', 'bands of 8 rows, with depth', 'textured'],
  edge_bands: ['mesh=gear&width=160&height=120&smooth-edges=1&rows=8', 'bands of 8 rows, with depth, smooth edges', 'flat'],
  smooth_edge_bands: ['mesh=teapot&width=160&height=120&style=gouraud&smooth-edges=1&rows=16', 'bands of 16 rows, with depth, smooth edges', 'smooth'],
  plain_bands: ['mesh=sphere&width=160&height=128&rows=24', 'bands of 24 rows, without depth', 'flat'],
  painted_bands: ['mesh=gear&width=160&height=128&rows=8', "bands of 8 rows, painter's order", 'flat'],
  painted_picture: ['mesh=arrow&width=128&height=128', "a whole picture, painter's order", 'flat'],
  depth_picture: ['mesh=teapot&width=128&height=128', 'a whole picture, with depth', 'depth'],
  plain_picture: ['mesh=cube&width=160&height=80', 'a whole picture, without depth', 'plain'],
  line_bands: ['mesh=torus&width=160&height=128&style=wireframe&rows=8', 'lines in bands of 8 rows', 'lines'],
  line_picture: ['mesh=gear&style=wireframe&width=128&height=128', 'lines in a whole picture', 'lines'],
  hidden_bands: ['mesh=gear&width=128&height=64&format=mono&style=hidden-line&rows=16', 'hidden lines in bands of 16 rows', 'lines'],
  hidden_color_bands: ['mesh=cylinder&width=128&height=64&style=hidden-line&rows=16', 'hidden lines in bands of 16 rows', 'lines'],
  gray_bands: ['mesh=torus&width=128&height=128&format=gray4&rows=8', 'bands of 8 rows, with depth', 'flat'],
  gray_smooth_bands: ['mesh=teapot&width=96&height=64&format=gray4&style=gouraud&rows=16', 'bands of 16 rows, with depth', 'smooth'],
  gray_textured_bands: ['mesh=cylinder&width=128&height=96&format=gray4&style=textured&rows=8', 'bands of 8 rows, with depth', 'textured'],
  gray_edge_bands: ['mesh=gear&width=128&height=128&format=gray4&smooth-edges=1&rows=16', 'bands of 16 rows, with depth, smooth edges', 'flat'],
  gray_smooth_edge_bands: ['mesh=teapot&width=96&height=64&format=gray2&style=gouraud&smooth-edges=1&rows=8', 'bands of 8 rows, with depth, smooth edges', 'smooth'],
  mono_bands: ['mesh=cylinder&width=96&height=96&format=mono&rows=8', 'bands of 8 rows, with depth', 'dithered'],
};
// For each target, one of the chips whose times are compared.
const CHIPS = { 'thumbv6m-none-eabi': 'rp2040', 'thumbv7m-none-eabi': 'stm32f103', 'riscv32imc-unknown-none-elf': 'esp32c3' };

const [file, verb, ...rest] = process.argv.slice(2);
const library = await Pinhole.from(readFileSync(file));
const costs = (choice) => JSON.parse(library.ask('costs', choice));

const ALIGNMENT = 4; // of each variable

function writeModels(folder) {
  for (const [name, [choice, way, shading]] of Object.entries(IMAGES)) {
    const { width, height } = library.draw(choice).about;
    const { rows } = costs(choice).ways.find((other) => other.name === way);
    const sizes = Object.entries({ WIDTH: width, HEIGHT: height, ROWS: rows || height }).map(([constant, value]) => `const ${constant}: u32 = ${value};`);
    const [, format] = /format=(\w+)/.exec(choice) ?? [];
    const [color, white] = { mono: ['BinaryColor', 'BinaryColor::On'], gray2: ['Gray2', '<Color as GrayColor>::WHITE'], gray4: ['Gray4', '<Color as GrayColor>::WHITE'] }[format] ?? [
      'Rgb565',
      '<Color as RgbColor>::WHITE',
    ];
    const full = (text) => text.replace(/\b(?=[A-Z]\w*Color\b|Gray[24]|Rgb565)/, 'embedded_graphics_core::pixelcolor::');
    const rest = [`type Color = ${full(color)};`, `const WHITE: Color = ${full(white)};`, 'const SIDE: usize = 32;', `const SHADING: &str = "${shading}";`];
    const allowed = (line) => `#[allow(dead_code)]\n${line}\n`;
    writeFileSync(join(folder, `${name}.rs`), library.ask('rust', choice) + [...sizes, ...rest].map(allowed).join(''));
  }
}

// The bytes of flash, and the bytes of RAM that are taken from the start, from the sections of an ELF file of 32 bits.
function sections(path) {
  const elf = readFileSync(path);
  const [table, size, count] = [elf.readUInt32LE(32), elf.readUInt16LE(46), elf.readUInt16LE(48)];
  const names = elf.readUInt32LE(table + size * elf.readUInt16LE(50) + 16);
  let [flash, variables, kinds] = [0, 0, 0];
  for (let at = table; at < table + size * count; at += size) {
    const [name, type, flags, bytes] = [0, 4, 8, 20].map((field) => elf.readUInt32LE(at + field));
    // riscv-rt gives all free RAM to these sections.
    if (['.stack', '.heap'].includes(elf.toString('latin1', names + name, elf.indexOf(0, names + name)))) continue;
    const [isWritable, isAllocated, isEmpty] = [flags & 1, flags & 2, type === 8];
    if (isAllocated && !isEmpty) flash += bytes;
    if (isAllocated && isWritable) variables += bytes;
    kinds += isAllocated && bytes > 0 ? 1 : 0;
  }
  if (kinds === 0) throw new Error(`${path}: no sections of a firmware`);
  return { flash, variables };
}

function compareSizes(folder) {
  const [target, chip] = Object.entries(CHIPS).find(([name]) => folder.includes(name));
  const empty = sections(join(folder, 'empty'));
  let [largest, wrong] = [0, 0];
  for (const [name, [choice, way]] of Object.entries(IMAGES)) {
    const linked = sections(join(folder, name));
    const { flashError, ways } = costs(`${choice}&chip=${chip}`);
    const { ram, flash, parts } = ways.find((other) => other.name === way);
    const [spare, more] = [linked.variables - empty.variables - ram, linked.flash - empty.flash];
    const off = 100 * (flash / more - 1);
    largest = Math.max(largest, Math.abs(off));
    const isGood = spare >= 0 && spare <= ALIGNMENT * parts.length && Math.abs(off) <= flashError;
    wrong += isGood ? 0 : 1;
    console.log(`${isGood ? 'ok' : 'WRONG'}: ${target} ${name}: RAM ${ram}, linked ${spare} more; flash ${flash}, linked ${more}: ${off.toFixed(1)} %`);
  }
  console.log(`${target}: ${Object.keys(IMAGES).length - wrong} of ${Object.keys(IMAGES).length} images have the sizes that the page states; flash is off by ${largest.toFixed(1)} % at most`);
  return wrong === 0;
}

// The page's chips whose timing is no estimate, by their names, and the emulated cores of their images.
const chips = new Map(library.menu().chips.filter(({ basis }) => !basis).map(({ key, name }) => [name, key]));

function compareTimes(lines) {
  const largest = new Map();
  let wrong = 0;
  for (const [path, chip, counted, ...taken] of lines) {
    const image = path.split('/').at(-1);
    const [choice, name] = IMAGES[image];
    const { ways, cyclesError } = costs(`${choice}&chip=${chips.get(chip)}`);
    const way = ways.find((other) => other.name === name);
    // For an ESP32-C3 the likely cycles, which lie between the least and the most.
    const cycles = Number(taken.length === 3 ? taken[1] : taken[0]);
    const [off, per] = [way.instructions / counted - 1, way.cycles / way.instructions / (cycles / counted) - 1].map((part) => 100 * part);
    const isGood = Math.abs(off) <= way.error && Math.abs(per) <= cyclesError;
    wrong += isGood ? 0 : 1;
    for (const [what, size] of [[`${name.replace(/\d+/, 'N')}`, off], [`cycles an instruction, ${chip}`, per]]) {
      if (Math.abs(size) > Math.abs(largest.get(what) ?? 0)) largest.set(what, size);
    }
    console.log(`${isGood ? 'ok' : 'WRONG'}: ${chip}, ${image}: instructions ${way.instructions}, counted ${counted}: ${off.toFixed(1)} %, stated ${way.error} %; cycles an instruction ${per.toFixed(1)} %, stated ${cyclesError} %`);
  }
  for (const [what, size] of largest) console.log(`at most ${size.toFixed(1)} %: ${what}`);
  // Every image was compared on every chip.
  return wrong === 0 && lines.length === Object.keys(IMAGES).length * chips.size;
}

const VERBS = {
  models: ([folder]) => (writeModels(folder), true),
  sizes: (folders) => folders.map(compareSizes).every(Boolean),
  images: () => (Object.keys(IMAGES).forEach((name) => console.log(name)), true),
  times: ([printed]) => compareTimes(readFileSync(printed, 'utf8').trim().split('\n').map((line) => line.split(';'))),
};
process.exit(VERBS[verb](rest) ? 0 : 1);
