// Tests of the page's controls by what each changes: the picture, the figures, or another part of the page. browser.mjs runs them.
import assert from 'node:assert/strict';
import { closeSync, mkdtempSync, openSync, rmSync, writeSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const PICTURE = 'picture';
const FIGURES = 'figures';

// A control, a value, and what it alone changes; each row follows the one above it.
const CHANGES = [
  ['mesh', 'floor', PICTURE], ['two-sided', true, FIGURES], ['two-sided', false, FIGURES], ['mesh', 'torus', PICTURE], ['decimate-to', '100', PICTURE],
  ['decimate', '150', PICTURE], ['up', 'x', PICTURE], ['flip', true, PICTURE], ['fix-winding', true, PICTURE], ['color', '#00ff00', PICTURE],
  ['background', '#202020', PICTURE], ['dither', true, PICTURE], ['around', '90', PICTURE], ['above', '-20', PICTURE], ['ambient', '200', PICTURE],
  ['projection', 'isometric', PICTURE], ['yaw', '70', PICTURE], ['pitch', '40', PICTURE], ['zoom', '150', PICTURE],
  ['smooth-edges', true, PICTURE], ['smooth-edges', false, PICTURE], ['style', 'textured', PICTURE],
  ['texture', 'grid', PICTURE], ['style', 'wireframe', PICTURE], ['edges', '80', PICTURE], ['panel-type', 'own', '#panel'], ['width', '200', PICTURE],
  ['height', '100', PICTURE], ['format', 'mono', PICTURE], ['chip', 'esp32c3', FIGURES], ['chip', 'own', FIGURES], ['core', 'M7', FIGURES],
  ['mhz', '200', FIGURES], ['ram', '64', FIGURES], ['flash', '100', FIGURES], ['rows', '20', FIGURES], ['spi', '4', FIGURES], ['style', 'hidden-line', PICTURE],
  ['style', 'flat', PICTURE], ['panel-type', '0', PICTURE], ['board', 'any-cortex-m', '#panel'], ['shown', 'RAM', '#matrix'],
];

// Buttons, and what each changes; those that save a file and those of a remedy have tests of their own.
const BUTTONS = [
  ['nearer', PICTURE], ['farther', PICTURE], ['true-size', 'size'], ['true-size', 'size'], ['turntable', PICTURE], ['turntable', 'pressed'], ['reset', PICTURE],
];

export const controls = ({ browser, pixels, settled, isGood, faces, load }) => {
  const text = (tab, part) => tab.evaluate((part) => document.querySelector(part).innerText, part);
  const states = {
    [PICTURE]: pixels,
    [FIGURES]: async (tab) => (await text(tab, '#verdict')) + (await tab.textContent('#cost')),
    pressed: (tab) => tab.getAttribute('#turntable', 'aria-pressed'),
    size: (tab) => tab.evaluate(() => document.querySelector('#display').style.width),
  };
  const stateOf = (tab, part) => (states[part] ?? ((tab) => text(tab, part)))(tab);
  // Acts, and waits until a part of the page differs.
  async function changes(tab, part, what, act) {
    await settled(tab);
    await tab.waitForTimeout(250); // the figures of the change before
    const [before, picture] = [await stateOf(tab, part), await pixels(tab)];
    await act();
    for (let i = 0; (await stateOf(tab, part)) === before; i++) {
      assert.ok(i < 40, `${what}: the ${part} is as before`);
      await tab.waitForTimeout(100);
    }
    if (part === FIGURES) assert.equal(await pixels(tab), picture, `${what} changed the picture`);
  }

  return {
    async 'every control changes the picture, the figures or a part of the page'(tab) {
      await tab.waitForFunction(() => document.querySelector('#matrix td'));
      for (const [id, value, part] of CHANGES) {
        await changes(tab, part, `${id} ${value}`, async () => {
          const control = tab.locator(`#${id}`);
          if (typeof value === 'boolean') await control.setChecked(value);
          else if ((await control.evaluate((e) => e.tagName)) === 'SELECT') await control.selectOption(value);
          else {
            await control.fill(value);
            await control.evaluate((e) => e.dispatchEvent(new Event('change')));
          }
        });
        assert.ok(await isGood(tab), `${id} ${value}: ${await tab.textContent('#status')}`);
      }
      await tab.selectOption('#mesh', 'gear');
      for (const [id, part] of BUTTONS) await changes(tab, part, id, () => tab.click(`#${id}`));
      const [tested, all] = await tab.evaluate((ids) => {
        const all = [...document.querySelectorAll('input:not([type=file]), select')].map((e) => e.id);
        return [ids, all.filter((id) => !ids.includes(id))];
      }, CHANGES.map(([id]) => id));
      assert.deepEqual(all, [], `${tested.length} are tested`);
    },

    async 'smooth edges change the picture and the figures, are in the link, and say where they cannot be'(tab) {
      const colors = () => tab.evaluate(() => {
        const { data } = document.querySelector('#display').getContext('2d').getImageData(0, 0, 240, 240);
        return new Set(new Uint32Array(data.buffer)).size;
      });
      await changes(tab, FIGURES, 'style', () => tab.selectOption('#chip', 'stm32f411'));
      const [sharp, plain, few] = [await pixels(tab), await tab.evaluate(() => chosenOf(costsShown)), await colors()];
      await changes(tab, PICTURE, 'smooth edges', () => tab.check('#smooth-edges'));
      await tab.waitForFunction(() => chosenOf(costsShown).name.endsWith('smooth edges'));
      assert.ok((await colors()) > 2 * few, `${few} colours, smooth ${await colors()}`);
      const smooth = await tab.evaluate(() => chosenOf(costsShown));
      for (const figure of ['ram', 'stack', 'flash', 'instructions', 'cycles']) assert.ok(smooth[figure] > plain[figure], figure);
      assert.doesNotMatch(await tab.textContent('#to-write'), /smooth/);
      await tab.selectOption('#board', 'any-cortex-m');
      await settled(tab);
      assert.match(await tab.textContent('#to-write'), /smooth edges, as boards\/common\/two-strips\/smooth.diff/);
      const [address, picture] = [await tab.evaluate(() => addressText()), await pixels(tab)];
      assert.match(address, /smooth-edges=1/);
      await changes(tab, PICTURE, 'another link', () => tab.evaluate(() => (location.hash = '')));
      assert.equal(await pixels(tab), sharp);
      await changes(tab, PICTURE, 'the link', () => tab.evaluate((text) => (location.hash = text), address));
      assert.equal(await pixels(tab), picture);
      assert.ok(await tab.isChecked('#smooth-edges'));
      for (const [panel, note] of [['SSD1306, 128 × 64, black and white', /colours between two others/], ['e-paper, 212 × 104, black, white and red', /colours between two others/], ['SSD1327, 128 × 128, 16 greys', /^$/]]) {
        await tab.selectOption('#panel-type', { label: panel });
        await settled(tab);
        assert.match(await tab.textContent('#smooth-note'), note);
        assert.equal(await tab.isDisabled('#smooth-edges'), note.source !== '^$');
      }
      await tab.selectOption('#style', 'wireframe');
      assert.match(await tab.textContent('#smooth-note'), /where faces are drawn/);
    },

    async 'a cell of the matrix chooses a chip, a display and the nearest template, and columns sort'(tab) {
      await tab.waitForFunction(() => document.querySelector('#matrix td button'));
      const [chips, displays] = await tab.evaluate(() => [menu.chips.length, menu.displays.length]);
      assert.equal(await tab.locator('#matrix td button').count(), chips * displays);
      assert.match(await tab.textContent('#matrix'), /STM32H743 estimate[^]*S3Not offered: their Xtensa/);
      const cells = [
        // Chip, display, board, what is left to write.
        ['STM32F411xE', 'ILI9341, 320', 'stm32f4-ili9341', /^$/],
        ['RP2040, code in flash', 'GC9A01', 'rp2040-st7789', /driver of GC9A01 in place of the ST7789's/],
        ['STM32H743', 'ILI9488', 'any-cortex-m', /clocks of the STM32H743 .* driver of ILI9488/],
        ['ESP32-C6', 'ST7789, 240 × 240', 'esp32c3-st7789', /feature esp32c6/],
      ];
      for (const [chip, display, board, left] of cells) {
        const cell = tab.locator(`#matrix button[aria-label^="${chip}"][aria-label*="${display}"]`);
        const [, speed] = /([\d.]+) frames/.exec(await cell.getAttribute('aria-label'));
        await cell.click();
        await settled(tab);
        await tab.waitForFunction((chip) => document.querySelector('#verdict').textContent.includes(chip), chip);
        assert.ok((await tab.textContent('#verdict')).includes(`${speed} frames/s`), `${chip}: ${speed}`);
        assert.ok((await tab.evaluate(() => document.querySelector('#panel-type').selectedOptions[0].textContent)).startsWith(display));
        assert.equal(await tab.inputValue('#board'), board);
        assert.match(await tab.textContent('#to-write'), left);
        assert.equal(await tab.getAttribute('#matrix button[aria-pressed=true]', 'aria-label'), await cell.getAttribute('aria-label'));
      }
      assert.match(await tab.textContent('#basis'), /^An estimate, by the range of an ESP32-C3/);
      // By keys: one cell down and to the right of the chosen one is another display and chip.
      await tab.focus('#matrix button[aria-pressed=true]');
      for (const key of ['ArrowDown', 'ArrowRight', 'Enter']) await tab.keyboard.press(key);
      await settled(tab);
      assert.equal(await tab.inputValue('#chip'), 'samd21');
      assert.equal(await tab.inputValue('#height'), '320');
      // The nearest template is offered for a chip that has none.
      await tab.selectOption('#board', 'rp2040-st7789');
      await tab.selectOption('#chip', 'stm32l476');
      await tab.click('#other-chip button >> nth=1');
      await settled(tab);
      assert.equal(await tab.inputValue('#board'), 'any-cortex-m');
      await tab.click('#matrix thead button >> nth=1');
      const column = await tab.locator('#matrix tbody tr td:nth-child(2)').allTextContents();
      const speeds = column.slice(0, chips).map((text) => parseFloat(text.replace('≈', '')));
      assert.deepEqual(speeds, [...speeds].sort((a, b) => b - a));
      // A slower bus than the display's is the user's to choose.
      await tab.locator('#matrix button[aria-label^="STM32F411xE"][aria-label*="ILI9341, 320"]').click();
      await settled(tab);
      const fast = await tab.textContent('#verdict');
      await tab.locator('#spi').fill('10');
      await tab.locator('#spi').press('Tab');
      await tab.waitForFunction((fast) => /limited by sending/.test(document.querySelector('#verdict').textContent) && document.querySelector('#verdict').textContent !== fast, fast);
    },

    async 'the turntable shows as many frames a second as it says'(tab) {
      await tab.evaluate(() => {
        const { putImageData } = CanvasRenderingContext2D.prototype;
        CanvasRenderingContext2D.prototype.putImageData = function (...of) { window.drawn += 1; return putImageData.apply(this, of); };
      });
      const shown = [];
      for (const panel of ['e-paper, 200 × 200, black and white', 'ST7789, 240 × 240, 16-bit colour']) {
        await tab.selectOption('#panel-type', { label: panel });
        await tab.waitForFunction((is) => (document.querySelector('#turntable').textContent === 'Turn at 1.0 frames/s') === is, panel.startsWith('e-paper'));
        // Time is the page's own: a click takes as long as the machine lets it.
        const [frames, most] = await tab.evaluate(async () => {
          const button = document.querySelector('#turntable');
          const rate = Number(button.textContent.match(/[\d.]+/)[0]);
          const start = performance.now();
          window.drawn = 0;
          button.click();
          await new Promise((done) => setTimeout(done, 2500));
          button.click();
          await new Promise(requestAnimationFrame);
          return [window.drawn, (rate * (performance.now() - start)) / 1000 + 2]; // the first frame, and the one at which it ends
        });
        shown.push(frames);
        assert.ok(frames <= most, `${panel}: ${shown} of ${most}`);
      }
      assert.ok(shown[1] > 2 * shown[0], `${shown}`);
    },

    async 'the picture stays in sight while controls scroll, and a phone has three screens'(tab) {
      for (const [width, height, screens] of [[1440, 900, 3], [1024, 768, 3], [390, 844, 3]]) {
        await tab.setViewportSize({ width, height });
        await tab.evaluate((isWide) => document.querySelectorAll('details').forEach((part) => (part.open = isWide && part.id === 'compare')), width > 832);
        await settled(tab);
        const tall = await tab.evaluate(() => document.documentElement.scrollHeight / innerHeight);
        assert.ok(tall <= screens, `${width}: ${tall} screens`);
        await tab.evaluate(() => document.querySelector('#zip').scrollIntoView({ block: 'end' }));
        const { y, height: high } = await tab.locator('#display').boundingBox();
        assert.ok(y >= -1 && y + high <= height, `${width}: the picture is at ${y}`);
      }
    },

    async 'a million faces block the page for less than 100 ms, and can be cancelled'(tab) {
      const folder = mkdtempSync(join(tmpdir(), 'planner-'));
      const file = join(folder, 'million.stl');
      writeHills(file, 708);
      await browser.startTracing(tab, { categories: ['toplevel'] });
      const first = await pixels(tab);
      await tab.setInputFiles('#file', file);
      await tab.waitForFunction(() => /Reading million\.stl|Making the mesh/.test(document.querySelector('#doing').textContent));
      await tab.click('#cancel');
      await tab.waitForFunction(() => /cancelled/.test(document.querySelector('#status').textContent));
      await settled(tab);
      assert.equal(await tab.inputValue('#mesh'), 'gear');
      await tab.click('#nearer');
      await settled(tab);
      assert.notEqual(await pixels(tab), first, 'nothing is drawn after the worker was ended');
      await load(tab, 'million.stl', file, 120_000);
      await tab.click('#warnings button.remedy', { timeout: 60_000 });
      await tab.waitForFunction(() => /drawn/.test(document.querySelector('#status').textContent), null, { timeout: 120_000 });
      rmSync(folder, { recursive: true });
      assert.ok((await faces(tab)) <= 20_000);
      // The processor time of the tasks of the page's own thread: on a busy machine they take longer.
      const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
      const thread = ({ pid, tid }) => `${pid} ${tid}`;
      const mains = traceEvents.filter(({ name, args }) => name === 'thread_name' && args.name === 'CrRendererMain').map(thread);
      const tasks = traceEvents.filter((event) => event.tdur > 0 && mains.includes(thread(event))).map(({ tdur }) => tdur / 1000);
      const longest = Math.max(...tasks);
      console.log(`the longest of ${tasks.length} tasks: ${Math.round(longest)} ms`);
      assert.ok(tasks.length > 100 && longest < 100, `${longest} ms`);
    },
  };
};

// Writes a binary STL file of a height field of so many cells a side, two faces each.
function writeHills(path, cells) {
  const file = openSync(path, 'w');
  const header = Buffer.alloc(84);
  header.writeUInt32LE(2 * cells * cells, 80);
  writeSync(file, header);
  const corner = (x, y) => [x, y, 20 * Math.sin(x / 40) * Math.cos(y / 50)];
  for (let y = 0; y < cells; y++) {
    const row = Buffer.alloc(100 * cells);
    for (let x = 0; x < cells; x++) {
      const [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
      [...a, ...b, ...c].forEach((value, i) => row.writeFloatLE(value, 100 * x + 12 + 4 * i));
      [...a, ...c, ...d].forEach((value, i) => row.writeFloatLE(value, 100 * x + 62 + 4 * i));
    }
    writeSync(file, row);
  }
  closeSync(file);
}
