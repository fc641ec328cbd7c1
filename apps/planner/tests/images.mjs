// The firmware of apps/planner/linked: the page's choice and way to draw for each image.
import { readFileSync } from 'node:fs';
import '../page/pinhole.js';

// For each image: the choice, the way to draw in the page's table, and the parameters of its source.
export const IMAGES = {
  flat_bands: ['mesh=gear&width=128&height=128&rows=8', 'bands of 8 rows, with depth', 'flat'],
  smooth_bands: ['mesh=teapot&width=160&height=120&style=gouraud&rows=8', 'bands of 8 rows, with depth', 'smooth'],
  dithered_bands: ['mesh=torus&width=128&height=160&dither=1&rows=16', 'bands of 16 rows, with depth', 'dithered'],
  smooth_dithered_bands: ['mesh=cylinder&width=128&height=128&style=gouraud&dither=1&rows=8', 'bands of 8 rows, with depth', 'smooth dithered'],
  textured_bands: ['mesh=torus&width=160&height=120&style=textured&rows=8', 'bands of 8 rows, with depth', 'textured'],
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
  mono_bands: ['mesh=cylinder&width=96&height=96&format=mono&rows=8', 'bands of 8 rows, with depth', 'dithered'],
};
// For each target, one of the chips whose times are compared.
export const CHIPS = { 'thumbv6m-none-eabi': 'rp2040', 'thumbv7m-none-eabi': 'stm32f103', 'riscv32imc-unknown-none-elf': 'esp32c3' };

// The page's costs of a choice, computed by the library in a file.
export async function costsBy(file) {
  const library = await Pinhole.from(readFileSync(file));
  return { library, costs: (choice) => JSON.parse(library.ask('costs', choice)) };
}
