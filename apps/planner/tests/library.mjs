// The library as the page has it after a model and a picture were dropped: `mesh=file` is a globe whose corners have texture
// coordinates, `texture=file` a picture of 64 × 32 texels in more colours than a texture stores.
import { readFileSync } from 'node:fs';
import '../page/pinhole.js';

const [AROUND, DOWN] = [16, 8];

function globe() {
  const lines = [];
  for (let row = 0; row <= DOWN; row++) {
    const polar = (Math.PI * row) / DOWN;
    for (let column = 0; column <= AROUND; column++) {
      const angle = (2 * Math.PI * column) / AROUND;
      const place = [Math.sin(polar) * Math.cos(angle), Math.cos(polar), -Math.sin(polar) * Math.sin(angle)];
      if (column < AROUND) lines.push(`v ${place.map((c) => c.toFixed(6)).join(' ')}`);
      lines.push(`vt ${column / AROUND} ${1 - row / DOWN}`);
    }
  }
  const corner = (row, column) => `${row * AROUND + (column % AROUND) + 1}/${row * (AROUND + 1) + column + 1}`;
  for (let row = 0; row < DOWN; row++) {
    for (let column = 0; column < AROUND; column++) {
      const [a, b] = [corner(row, column), corner(row + 1, column)];
      const [c, d] = [corner(row + 1, column + 1), corner(row, column + 1)];
      if (row < DOWN - 1) lines.push(`f ${a} ${b} ${c}`);
      if (row > 0) lines.push(`f ${a} ${c} ${d}`);
    }
  }
  return lines.join('\n');
}

const [WIDTH, HEIGHT] = [64, 32];

const picture = () =>
  Uint8Array.from({ length: 4 * WIDTH * HEIGHT }, (_, i) => {
    const [x, y] = [(i >> 2) % WIDTH, Math.floor((i >> 2) / WIDTH)];
    return [4 * x, 8 * y, 4 * ((x * y) % 64), 255][i % 4];
  });

export async function withFiles(file) {
  const library = await Pinhole.from(readFileSync(file));
  library.load('globe.obj', new TextEncoder().encode(globe()));
  library.picture(WIDTH, picture());
  return library;
}
