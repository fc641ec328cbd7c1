// Tests that what does not fit a chip fits after the page's advice:
//
//   node advice.mjs LIBRARY.wasm
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import '../page/pinhole.js';
import '../page/advice.js';

const library = await Pinhole.from(readFileSync(process.argv[2]));
const chosen = (choice) => {
  const { faces } = library.draw(choice).about.model;
  const costs = JSON.parse(library.ask('costs', choice));
  return { faces, costs, way: costs.ways.find(({ chosen }) => chosen) };
};

// A ball of 16 000 faces, too many for two of the chips.
const ball = [];
const [AROUND, DOWN] = [100, 80];
for (let i = 0; i <= AROUND * (DOWN + 1); i++) {
  const [around, down] = [(2 * Math.PI * (i % AROUND)) / AROUND, (Math.PI * Math.floor(i / AROUND)) / DOWN];
  ball.push(`v ${Math.sin(down) * Math.sin(around)} ${Math.cos(down)} ${Math.sin(down) * Math.cos(around)}`);
}
for (let i = 0; i < AROUND * DOWN; i++) {
  const next = i + 1 - ((i + 1) % AROUND === 0 ? AROUND : 0);
  ball.push(`f ${i + 1} ${i + 1 + AROUND} ${next + 1 + AROUND} ${next + 1}`);
}
library.load('ball.obj', new TextEncoder().encode(ball.join('\n')));
const { decimates } = library.menu();

let [byRows, byFaces] = [0, 0];
for (const chip of ['stm32f030', 'stm32f103', 'rp2040-ram']) {
  for (const style of ['flat', 'flat&smooth-edges=1', 'gouraud', 'textured', 'wireframe', 'hidden-line']) {
    for (const size of ['width=1024&height=600&rows=8', 'width=240&height=240&rows=64', 'width=320&height=240&rows=1000', 'width=1024&height=300&rows=1']) {
      for (const mesh of ['gear', 'teapot', 'file']) {
        const choice = `mesh=${mesh}&chip=${chip}&style=${style}&${size}`;
        const { faces, costs, way } = chosen(choice);
        const { rows, faces: fewer, both } = advised(costs, way, faces);
        assert.ok(!(way.fits && way.fitsFlash) || !(rows || fewer || both), `${choice}: advice for what fits`);
        const fits = (more) => {
          const { way } = chosen(`${choice}&${more}`);
          assert.ok(way.fits && way.fitsFlash, `${choice}: with ${more} it does not fit`);
        };
        if (rows) fits(`rows=${rows}`);
        if (fewer && decimates) fits(`decimate=${fewer}`);
        if (both && decimates) fits(`rows=${both.rows}&decimate=${both.faces}`);
        byRows += rows ? 1 : 0;
        byFaces += fewer || both ? 1 : 0;
        const isAdvised = (choice) => {
          const { faces, costs, way } = chosen(choice);
          return (way.fits && way.fitsFlash) || Object.values(advised(costs, way, faces)).some(Boolean);
        };
        // The page has a button for it.
        const sharp = choice.replace('&smooth-edges=1', '');
        assert.ok(isAdvised(choice) || (sharp !== choice && isAdvised(sharp)), `${choice}: no advice`);
      }
    }
  }
}
assert.ok(byRows > 30 && (byFaces > 20 || !decimates), `${byRows} by rows, ${byFaces} by faces`);
console.log(`advice by rows: ${byRows} fit, by faces: ${byFaces} fit`);
