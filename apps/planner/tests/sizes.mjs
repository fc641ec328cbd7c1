// The sizes that the page states, and those of linked firmware:
//
//   node sizes.mjs LIBRARY.wasm models FOLDER            writes the mesh and the sizes of each image of apps/planner/linked
//   node sizes.mjs LIBRARY.wasm compare FOLDER...        compares the images in these folders, TARGET/release, with the page
//
// RAM is the image's variables, which must be those that the page states; the linker may align each. Flash is what the image has more
// than one that draws nothing, and must be as near as the page says.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import '../page/pinhole.js';

// Of each image: the choice, the way to draw in the page's table, and what the source needs to know.
const IMAGES = {
  flat_bands: ['mesh=gear&rows=8', 'bands of 8 rows, with depth', 'flat'],
  smooth_bands: ['mesh=teapot&width=320&style=gouraud&rows=8', 'bands of 8 rows, with depth', 'smooth'],
  dithered_bands: ['mesh=torus&dither=1&rows=16', 'bands of 16 rows, with depth', 'dithered'],
  smooth_dithered_bands: ['mesh=cylinder&style=gouraud&dither=1&rows=8', 'bands of 8 rows, with depth', 'smooth dithered'],
  textured_bands: ['mesh=torus&style=textured&rows=8', 'bands of 8 rows, with depth', 'textured'],
  plain_bands: ['mesh=sphere&rows=24', 'bands of 24 rows, without depth', 'flat'],
  painted_bands: ['mesh=gear&width=320&rows=8', "bands of 8 rows, painter's order", 'flat'],
  painted_picture: ['mesh=arrow&width=128&height=128', "a whole picture, painter's order", 'flat'],
  depth_picture: ['mesh=teapot&width=128&height=128', 'a whole picture, with depth', 'depth'],
  plain_picture: ['mesh=cube&width=160&height=80', 'a whole picture, without depth', 'plain'],
  line_bands: ['mesh=torus&style=wireframe&rows=8', 'lines in bands of 8 rows', 'lines'],
  line_picture: ['mesh=gear&style=wireframe&width=128&height=128', 'lines in a whole picture', 'lines'],
  hidden_bands: ['mesh=gear&width=128&height=64&format=mono&style=hidden-line&rows=16', 'hidden lines in bands of 16 rows', 'lines'],
  gray_bands: ['mesh=torus&width=128&height=128&format=gray4&rows=8', 'bands of 8 rows, with depth', 'flat'],
  mono_bands: ['mesh=cylinder&width=200&height=200&format=mono&rows=8', 'bands of 8 rows, with depth', 'dithered'],
};
// A chip for each target.
const CHIPS = { 'thumbv6m-none-eabi': 'rp2040', 'thumbv7m-none-eabi': 'stm32f103', 'riscv32imc-unknown-none-elf': 'esp32c3' };
const ALIGNMENT = 4; // of each variable

const [file, verb, ...folders] = process.argv.slice(2);
const library = await Pinhole.from(readFileSync(file));
const costs = (choice) => JSON.parse(library.ask('costs', choice));

function writeModels(folder) {
  for (const [name, [choice, way, shading]] of Object.entries(IMAGES)) {
    const { width, height } = library.draw(choice).about;
    const { rows } = costs(choice).ways.find((other) => other.name === way);
    const sizes = Object.entries({ WIDTH: width, HEIGHT: height, ROWS: rows ?? height }).map(([constant, value]) => `const ${constant}: u32 = ${value};`);
    const rest = ['const SIDE: usize = 32;', `const SHADING: &str = "${shading}";`];
    const allowed = (line) => `#[allow(dead_code)]\n${line}\n`;
    writeFileSync(join(folder, `${name}.rs`), library.ask('rust', choice) + [...sizes, ...rest].map(allowed).join(''));
  }
}

// What takes flash, and what takes RAM from the start, by the sections of an ELF file of 32 bits.
function sections(path) {
  const elf = readFileSync(path);
  const [table, size, count] = [elf.readUInt32LE(32), elf.readUInt16LE(46), elf.readUInt16LE(48)];
  let [flash, variables, kinds] = [0, 0, 0];
  for (let at = table; at < table + size * count; at += size) {
    const [type, flags, bytes] = [elf.readUInt32LE(at + 4), elf.readUInt32LE(at + 8), elf.readUInt32LE(at + 20)];
    const [isWritable, isAllocated, isEmpty] = [flags & 1, flags & 2, type === 8];
    if (isAllocated && !isEmpty) flash += bytes;
    if (isAllocated && isWritable) variables += bytes;
    kinds += isAllocated && bytes > 0 ? 1 : 0;
  }
  if (kinds === 0) throw new Error(`${path}: no sections of a firmware`);
  return { flash, variables };
}

function compare(folder) {
  const [target, chip] = Object.entries(CHIPS).find(([name]) => folder.includes(name));
  const empty = sections(join(folder, 'empty'));
  let [largest, wrong, compared] = [0, 0, 0];
  for (const [name, [choice, way]] of Object.entries(IMAGES)) {
    if (!existsSync(join(folder, name))) continue;
    compared += 1;
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
  console.log(`${target}: ${compared - wrong} of ${compared} images have the sizes that the page states; flash is off by ${largest.toFixed(1)} % at most`);
  return wrong === 0 && compared >= 5;
}

if (verb === 'models') writeModels(folders[0]);
else if (!folders.map(compare).every(Boolean)) process.exit(1);
