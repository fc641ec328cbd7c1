// Compares the sizes that the page states with those of linked firmware:
//
//   node sizes.mjs LIBRARY.wasm models FOLDER            writes the mesh and the sizes of each image of apps/planner/linked
//   node sizes.mjs LIBRARY.wasm compare FOLDER...        compares the images in these folders, TARGET/release, with the page
//
// RAM is the image's variables, which must equal the page's figure, except that the linker may align each. Flash is the image's
// flash less that of an image that draws nothing, and must be within the error that the page states.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { CHIPS, IMAGES, costsBy } from './images.mjs';

const ALIGNMENT = 4; // of each variable

const [file, verb, ...folders] = process.argv.slice(2);
const { library, costs } = await costsBy(file);

function writeModels(folder) {
  for (const [name, [choice, way, shading]] of Object.entries(IMAGES)) {
    const { width, height } = library.draw(choice).about;
    const { rows } = costs(choice).ways.find((other) => other.name === way);
    const sizes = Object.entries({ WIDTH: width, HEIGHT: height, ROWS: rows ?? height }).map(([constant, value]) => `const ${constant}: u32 = ${value};`);
    const color = `embedded_graphics_core::pixelcolor::${choice.includes('format=mono') ? 'BinaryColor' : 'Rgb565'}`;
    const rest = [`type Color = ${color};`, 'const SIDE: usize = 32;', `const SHADING: &str = "${shading}";`];
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

function compare(folder) {
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

if (verb === 'models') writeModels(folders[0]);
else if (!folders.map(compare).every(Boolean)) process.exit(1);
