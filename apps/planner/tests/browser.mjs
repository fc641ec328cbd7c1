// Tests the page in a headless Chromium, opened from disk: what a user does with mouse, keys, files and buttons.
//
//   node browser.mjs PAGE MODULES [FOLDER]
//
// MODULES is the folder with playwright-core and axe-core; pictures of the page go into FOLDER.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { controls } from './controls.mjs';
import { mistakes } from './mistakes.mjs';

const [page, modules, folder] = process.argv.slice(2).map((path) => resolve(path));
const { chromium } = createRequire(import.meta.url)(join(modules, 'playwright-core'));
const flags = [
  '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync',
];
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: flags });
const address = pathToFileURL(join(page, 'index.html')).href;
const problems = [];
let passed = 0;
let failed = 0;

const tests = {
  async 'the first picture is there within 2 seconds'(tab) {
    assert.ok(tab.firstPicture <= 2000, `${tab.firstPicture} ms`);
  },

  async 'drag, wheel, keys and buttons change the picture and the address'(tab) {
    const acts = [
      ['a drag', () => drag(tab, 40, 20)],
      ['a drag with Shift', async () => { await tab.keyboard.down('Shift'); await drag(tab, 30, 0); await tab.keyboard.up('Shift'); }],
      ['the wheel', () => tab.mouse.wheel(0, -300)],
      ['an arrow', () => tab.locator('#display').press('ArrowLeft')],
      ['plus', () => tab.locator('#display').press('+')],
      ['the button for zoom', () => tab.click('#farther')],
    ];
    for (const [name, act] of acts) {
      const [picture, link] = [await pixels(tab), tab.url()];
      await act();
      await settled(tab);
      assert.notEqual(await pixels(tab), picture, `${name}: the same picture`);
      assert.notEqual(tab.url(), link, `${name}: the same address`);
    }
    const [picture, link] = [await pixels(tab), tab.url()];
    const other = await open(link);
    assert.equal(await pixels(other), picture, 'the link shows another picture');
    await other.context().close();
  },

  async 'axe finds nothing, in three sizes and both colour schemes'(tab) {
    await tab.evaluate(readFileSync(join(modules, 'axe-core/axe.min.js'), 'utf8'));
    for (const width of [1440, 900, 390]) {
      for (const colorScheme of ['light', 'dark']) {
        await tab.setViewportSize({ width, height: 900 });
        await tab.emulateMedia({ colorScheme });
        const { violations, passes } = await tab.evaluate(() => axe.run(document, { preload: false }));
        const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' '))}`);
        assert.deepEqual(found, [], `${width} px, ${colorScheme}`);
        assert.ok(passes.length > 20, `only ${passes.length} rules apply`);
      }
    }
  },

  async 'every mesh, display and style draws'(tab) {
    for (const control of ['mesh', 'panel-type', 'style', 'projection']) {
      for (const value of await tab.locator(`#${control} option`).evaluateAll((all) => all.map((o) => o.value))) {
        await tab.selectOption(`#${control}`, value);
        await settled(tab);
        assert.ok(await isGood(tab), `${control} ${value}: ${await tab.textContent('#status')}`);
      }
    }
  },

  async 'a file is drawn, and a remedy takes its warning away'(tab) {
    const sheet = 'v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n';
    await load(tab, 'sheet.obj', Buffer.from(sheet));
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    assert.match(await tab.textContent('#warnings'), /open edges: 4/);
    await tab.click('#warnings button');
    await settled(tab);
    assert.equal(await tab.textContent('#warnings'), '');
    assert.ok(await tab.isChecked('#two-sided'));
  },

  async 'an OBJ file is drawn in the colours of its material library, which the ZIP has'(tab) {
    const files = { 'part.obj': `mtllib part.mtl\nusemtl leaf\n${SHEET}`, 'part.mtl': 'newmtl leaf\nKd 0 1 0\n' };
    await tab.setInputFiles('#file', Object.entries(files).map(([name, text]) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) })));
    await tab.waitForFunction(() => document.querySelector('#mesh').value === 'file');
    await tab.selectOption('#projection', 'front');
    await tab.locator('#ambient').fill('256');
    await settled(tab);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    assert.doesNotMatch(await tab.textContent('#warnings'), /material/);
    const pixel = await tab.evaluate(() => [...document.querySelector('#display').getContext('2d').getImageData(100, 120, 1, 1).data]);
    assert.deepEqual(pixel, [0, 255, 0, 255]);
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#zip')]);
    assert.match(readFileSync(await download.path(), 'latin1'), /firmware\/part\.mtlnewmtl leaf/);
  },

  async 'an STL file is dropped'(tab) {
    const data = await tab.evaluateHandle((bytes) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([new Uint8Array(bytes)], 'dropped.stl'));
      return transfer;
    }, [...stl(12)]);
    await tab.dispatchEvent('#frame', 'drop', { dataTransfer: data });
    await tab.waitForFunction(() => document.querySelector('#mesh').value === 'file');
    await settled(tab);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
  },

  async 'a broken file, and one with too many vertices, are messages, and the page goes on'(tab) {
    await tab.setInputFiles('#file', { name: 'broken.stl', mimeType: 'application/octet-stream', buffer: Buffer.from('this is no model') });
    await tab.waitForFunction(() => document.querySelector('#status').classList.contains('bad'));
    assert.match(await tab.textContent('#status'), /^broken\.stl: /);
    // The ready mesh stays.
    assert.equal(await tab.inputValue('#mesh'), 'gear');
    for (const button of ['#zip', '#picture', '#rust']) assert.ok(!(await tab.isDisabled(button)), button);
    await load(tab, 'large.stl', stl(70_000));
    // Nothing of the model before it is left.
    assert.ok(!(await isGood(tab)));
    assert.ok(!(await tab.isVisible('#costs')));
    for (const button of ['#zip', '#picture', '#rust']) assert.ok(await tab.isDisabled(button), button);
    assert.match(await tab.textContent('#status'), /vertices, more than the 65\u202f536 of a mesh/);
    if (await decimates(tab)) {
      // The page's own remedy.
      await tab.click('#warnings button.remedy');
      await tab.waitForFunction(() => !document.querySelector('#status').classList.contains('bad'));
      assert.ok((await faces(tab)) <= 20_000, `${await faces(tab)} faces`);
    }
    await tab.selectOption('#mesh', 'cube');
    await settled(tab);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    assert.equal(await tab.textContent('#warnings'), '');
  },

  async 'the slider decimates, and the link and the mesh in Rust do so too'(tab) {
    if (!(await decimates(tab))) return;
    await tab.selectOption('#mesh', 'teapot');
    await settled(tab);
    assert.equal(await tab.inputValue('#decimate-to'), '');
    const whole = await pixels(tab);
    await tab.locator('#decimate-to').fill('100');
    await tab.locator('#decimate-to').press('Tab');
    await settled(tab);
    assert.ok((await faces(tab)) <= 100, `${await faces(tab)} faces`);
    assert.notEqual(await pixels(tab), whole, 'the same picture');
    assert.match(tab.url(), /decimate=100/);
    await tab.locator('#decimate').press('ArrowLeft');
    await settled(tab);
    const fewer = await tab.inputValue('#decimate-to');
    assert.ok(fewer < 100 && fewer > 90, fewer);
    assert.ok(tab.url().endsWith(`decimate=${fewer}`), tab.url());
    const other = await open(tab.url());
    assert.equal(await pixels(other), await pixels(tab), 'the link shows another picture');
    assert.equal(await other.inputValue('#decimate-to'), fewer);
    await other.context().close();
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#rust')]);
    const [, count] = /FACES: \[\[u16; 3\]; (\d+)\]/.exec(readFileSync(await download.path(), 'utf8'));
    assert.equal(Number(count), await faces(tab));
    await tab.locator('#decimate').press('End');
    await settled(tab);
    assert.equal(await pixels(tab), whole, 'all faces, another picture');
    assert.doesNotMatch(tab.url(), /decimate/);
  },

  async 'textured faces show a pattern, or a picture that is dropped, and a model without coordinates says so'(tab) {
    await tab.selectOption('#style', 'textured');
    await settled(tab);
    assert.match(await tab.textContent('#warnings'), /no texture coordinates: .* export it as OBJ/);
    const pattern = await pixels(tab);
    await tab.selectOption('#texture', 'grid');
    await settled(tab);
    assert.notEqual(await pixels(tab), pattern, 'the pattern is the same');
    await load(tab, 'sheet.obj', Buffer.from(SHEET));
    assert.doesNotMatch(await tab.textContent('#warnings'), /texture coordinates/);
    await tab.selectOption('#projection', 'front');
    // The model faces the eye, so the halves of the picture are seen side by side.
    await dropPicture(tab);
    await tab.locator('#ambient').fill('256');
    await settled(tab);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    const found = await tab.evaluate(() => {
      const canvas = document.querySelector('#display');
      const at = (x, y) => [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
      return [at(90, 120), at(150, 120)];
    });
    assert.deepEqual(found, [[0, 255, 0, 255], [0, 0, 255, 255]]);
    const broken = Buffer.from('no picture');
    await tab.setInputFiles('#picture-file', { name: 'broken.png', mimeType: 'image/png', buffer: broken });
    await tab.waitForFunction(() => document.querySelector('#status').classList.contains('bad'));
    assert.match(await tab.textContent('#status'), /^broken\.png: is no picture/);
  },

  async 'a turn is saved as a GIF, whose frames are the pictures of the display'(tab) {
    await tab.selectOption('#panel-type', { label: 'SSD1306, 128 × 64, black and white' });
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#gif')]);
    assert.equal(download.suggestedFilename(), 'gear.gif');
    const bytes = readFileSync(await download.path());
    // Decodes a film by the browser's own decoder: the number of frames, their duration, and the pixels of one frame.
    const decoded = (index) => tab.evaluate(async ([bytes, index]) => {
      const decoder = new ImageDecoder({ data: new Uint8Array(bytes), type: 'image/gif' });
      await decoder.tracks.ready;
      await decoder.completed;
      const { frameCount, repetitionCount } = decoder.tracks.selectedTrack;
      let [milliseconds, pixels] = [0, ''];
      for (let i = 0; i < frameCount; i++) {
        const { image } = await decoder.decode({ frameIndex: i });
        milliseconds += image.duration / 1000;
        if (i === index) {
          const canvas = Object.assign(document.createElement('canvas'), { width: image.displayWidth, height: image.displayHeight });
          canvas.getContext('2d').drawImage(image, 0, 0);
          pixels = canvas.toDataURL();
        }
        image.close();
      }
      return { frameCount, endless: repetitionCount === Infinity, milliseconds, pixels };
    }, [[...bytes], index]);
    const turned = await open(`${tab.url()}&turn=9`);
    assert.deepEqual(await decoded(3), { frameCount: 40, endless: true, milliseconds: 4000, pixels: await pixels(turned) });
    await turned.context().close();
  },

  async 'a film shows how far it is, the page goes on meanwhile, and it can be cancelled'(tab) {
    await tab.selectOption('#mesh', 'teapot');
    await tab.selectOption('#style', 'gouraud');
    const files = [];
    tab.on('download', (download) => files.push(download.suggestedFilename()));
    await tab.evaluate(() => set({ width: 1024, height: 1024 })); // a film of some seconds
    await settled(tab);
    // A user saves a film and then orbits: the display and the film are drawn in turn.
    const before = await pixels(tab);
    await tab.click('#gif');
    assert.ok(await tab.isDisabled('#gif'));
    await tab.locator('#display').press('ArrowLeft');
    await settled(tab);
    assert.notEqual(await pixels(tab), before);
    await tab.waitForFunction(() => document.querySelector('#filmed').value >= 3);
    assert.ok(await tab.isVisible('#filmed'), 'done before it could be cancelled');
    assert.equal(await tab.evaluate(() => document.querySelector('#filmed').max), 40);
    await tab.click('#cancel');
    await tab.waitForFunction(() => !document.querySelector('#gif').disabled);
    assert.match(await tab.textContent('#status'), /cancelled/);
    assert.ok(!(await tab.isVisible('#filming')));
    // Loading another file also cancels the film.
    await tab.click('#gif');
    await tab.waitForFunction(() => document.querySelector('#filmed').value >= 1);
    await load(tab, 'other.stl', stl(12));
    await tab.waitForFunction(() => !document.querySelector('#gif').disabled);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    assert.deepEqual(files, []);
    await Promise.all([tab.waitForEvent('download'), tab.click('#gif')]);
    assert.deepEqual(files, ['other.gif']);
  },

  async 'a board with another display frames the model for its own, and the page shows that at a press'(tab) {
    const saved = async (button) => {
      const [download] = await Promise.all([tab.waitForEvent('download'), tab.click(button)]);
      return readFileSync(await download.path());
    };
    await tab.selectOption('#projection', 'isometric');
    await settled(tab);
    for (const [board, sides] of [['stm32f4-ili9341', '320 × 240'], ['rp2040-st7789', '240 × 240']]) {
      await tab.selectOption('#board', board);
      await settled(tab);
      assert.match(await tab.textContent('#other-display'), new RegExp(`${board} has ${sides} pixels`));
      const [zip, picture] = [await saved('#zip'), await pixels(tab)];
      await tab.click('#other-display button');
      await settled(tab);
      assert.ok(!(await tab.isVisible('#other-display')));
      assert.match(await tab.textContent('#status'), new RegExp(`^${sides}:`));
      assert.notEqual(await pixels(tab), picture);
      assert.deepEqual(await saved('#zip'), zip, `${board}: the ZIP is another one where the page shows its display`);
    }
    // One takes any display, by a constant.
    await tab.selectOption('#panel-type', { label: 'ST7735, 128 × 128, 16-bit colour' });
    await tab.selectOption('#board', 'any-cortex-m');
    await settled(tab);
    assert.ok(!(await tab.isVisible('#other-display')));
    assert.ok((await saved('#zip')).includes('SIZE: Size = Size::new(128, 128)'));
  },

  async 'the board has its own chip, which the page shows at a press, and is part of the link'(tab) {
    await tab.selectOption('#board', 'stm32f4-ili9341');
    await settled(tab);
    assert.equal(await tab.inputValue('#chip'), 'stm32f411');
    assert.ok(!(await tab.isVisible('#other-chip')));
    await tab.selectOption('#chip', 'esp32c3');
    await settled(tab);
    assert.match(await tab.textContent('#other-chip'), /those of the ESP32-C3, code in flash, which is not the chip of stm32f4-ili9341/);
    const other = await open(tab.url());
    assert.equal(await other.inputValue('#board'), 'stm32f4-ili9341');
    await other.context().close();
    await tab.click('#other-chip button');
    await settled(tab);
    assert.equal(await tab.inputValue('#chip'), 'stm32f411');
    assert.ok(!(await tab.isVisible('#other-chip')));
    // A driver must be added where the display is not known, and decimation needs a compiler for C++.
    assert.match(await tab.textContent('#wiring'), /README has the wiring/);
    await tab.selectOption('#board', 'any-cortex-m');
    await tab.locator('#decimate').focus();
    await tab.keyboard.press('ArrowLeft');
    await settled(tab);
    assert.match(await tab.textContent('#wiring'), /driver of your display into src\/display\.rs.*install g\+\+ or clang/);
    // Four bands of pixels and two of depths beside each other, of half the display's rows each, are too much.
    await tab.selectOption('#board', 'rp2040-two-cores');
    await tab.locator('#rows').fill('120');
    await tab.locator('#rows').press('Tab');
    await tab.waitForFunction(() => /^Does not fit the RP2040.* of RAM \(it has 264 KB\)/.test(document.querySelector('#verdict').textContent));
  },

  async 'a file of 50 MB is read'(tab) {
    // A million triangles in a hundred copies of a body: duplicates are dropped.
    const once = stl(10_000).subarray(84);
    const count = Math.ceil(50e6 / once.length);
    const header = Buffer.alloc(84);
    header.writeUInt32LE(10_000 * count, 80);
    const folder = mkdtempSync(join(tmpdir(), 'planner-'));
    writeFileSync(join(folder, 'fifty.stl'), Buffer.concat([header, ...Array(count).fill(once)]));
    await load(tab, 'fifty.stl', join(folder, 'fifty.stl'), 120_000);
    rmSync(folder, { recursive: true });
    assert.ok(await isGood(tab), await tab.textContent('#status'));
  },

  async 'the turntable turns'(tab) {
    await tab.click('#turntable');
    const pictures = new Set();
    for (let i = 0; i < 5; i++) {
      pictures.add(await pixels(tab));
      await tab.waitForTimeout(200);
    }
    await tab.click('#turntable');
    assert.ok(pictures.size >= 3, `${pictures.size} pictures in a second`);
  },

  async 'a slow tab draws, turns and reads a file'(tab) {
    const slow = await tab.context().newCDPSession(tab);
    await slow.send('Emulation.setCPUThrottlingRate', { rate: 8 });
    await tab.selectOption('#mesh', 'teapot');
    await tab.selectOption('#style', 'gouraud');
    await tab.click('#turntable');
    const turns = new Set();
    for (let i = 0; i < 4; i++) {
      turns.add(await pixels(tab));
      await tab.waitForTimeout(400);
    }
    await tab.click('#turntable');
    assert.ok(turns.size >= 3, `${turns.size} pictures`);
    await load(tab, 'some.stl', stl(2000));
    assert.ok(await isGood(tab), await tab.textContent('#status'));
  },

  async 'everything is reached by the keyboard, in the order of the page, and its focus is seen'(tab) {
    const controls = await tab.evaluate(() =>
      [...document.querySelectorAll('button, input, select, canvas')].filter((e) => e.checkVisibility() && !e.disabled).map((e) => e.id));
    const reached = [];
    // The costs have more that can be opened or moved by keys.
    for (let i = 0; i < controls.length + 40; i++) {
      await tab.keyboard.press('Tab');
      const [id, outline] = await tab.evaluate(() => [document.activeElement.id, getComputedStyle(document.activeElement).outlineStyle]);
      if (id && controls.includes(id)) {
        reached.push(id);
        assert.notEqual(outline, 'none', id);
      }
    }
    assert.deepEqual([...new Set(reached)].filter((id) => id), controls.filter((id) => id));
    await tab.locator('#display').focus();
    for (const key of ['ArrowUp', 'Shift+ArrowRight', '-', '0']) {
      const picture = await pixels(tab);
      await tab.keyboard.press(key);
      await settled(tab);
      assert.notEqual(await pixels(tab), picture, key);
    }
    await tab.keyboard.press(' ');
    assert.equal(await tab.getAttribute('#turntable', 'aria-pressed'), 'true');
    await tab.keyboard.press(' ');
  },

  async 'fingers on a phone orbit, move and zoom'() {
    const tab = await open(address, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    const touch = await tab.context().newCDPSession(tab);
    const { x, y, width, height } = await tab.locator('#display').boundingBox();
    const [middleX, middleY] = [x + width / 2, y + height / 2];
    const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([right, down], id) => ({ x: middleX + right, y: middleY + down, id })) });
    const gesture = async (from, to) => {
      await send('touchStart', from);
      await send('touchMove', to);
      await send('touchEnd', []);
      await settled(tab);
      return new URLSearchParams(new URL(tab.url()).hash.slice(1));
    };
    const orbited = await gesture([[0, 0]], [[40, 10]]);
    assert.ok(orbited.has('yaw') && !orbited.has('zoom'), `${orbited}`);
    const zoomed = await gesture([[-30, 0], [30, 0]], [[-60, 0], [60, 0]]);
    assert.ok(Number(zoomed.get('zoom')) > 150, `${zoomed}`);
    const moved = await gesture([[-30, 0], [30, 0]], [[-30, 30], [30, 30]]);
    assert.ok(Number(moved.get('y')) < -100, `${moved}`);
    assert.equal(await tab.evaluate(() => scrollY), 0, 'the page scrolled');
    await tab.tap('#nearer');
    await tab.context().close();
  },

  async 'the picture is saved as a PNG'(tab) {
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#png')]);
    assert.equal(download.suggestedFilename(), 'gear.png');
  },

  async 'the costs follow the chip and the style'(tab) {
    const costs = () => tab.textContent('#cost');
    await tab.waitForFunction(() => /bands of 8 rows/.test(document.querySelector('#cost').textContent));
    const before = await costs();
    assert.match(await tab.textContent('#notes'), /it tears, unless it is drawn before it is sent, which takes 7 ms/);
    for (const value of await tab.locator('#chip option').evaluateAll((all) => all.map((o) => o.value))) {
      await tab.selectOption('#chip', value);
      await tab.waitForTimeout(300);
      assert.match(await costs(), /Frames/, value);
    }
    assert.notEqual(await costs(), before);
    // What does not fit has a remedy; a display's SPI may be slower than the chip's.
    await tab.selectOption('#chip', 'stm32f030');
    await tab.locator('#rows').fill('64');
    await tab.locator('#rows').press('Tab');
    await tab.waitForFunction(() => /^Does not fit the STM32F030xC: .*\(it has 32 KB\)/.test(document.querySelector('#verdict').textContent));
    await tab.click('#advice button.remedy');
    await tab.waitForFunction(() => /^Fits the STM32F030xC/.test(document.querySelector('#verdict').textContent));
    assert.equal(await tab.inputValue('#rows'), '24');
    // A row of the table sets the rows of a band; the parts of its RAM can be opened.
    await tab.click('#cost button.way >> nth=0');
    assert.equal(await tab.inputValue('#rows'), '8');
    await tab.waitForFunction(() => /bands of 8 rows/.test(document.querySelector('#cost tr.chosen').textContent));
    await tab.click('#cost tr.chosen summary');
    assert.match(await tab.innerText('#cost tr.chosen details'), /vertices 1\.5 KB[^]*depths 3\.8 KB/);
    // 153 600 bytes at 18 MHz take longer than two refreshes of the panel.
    await tab.selectOption('#panel-type', { label: 'ILI9341, 320 × 240, 16-bit colour' });
    await tab.waitForFunction(() => /it tears, as sending alone takes 6\d ms/.test(document.querySelector('#notes').textContent));
    await tab.selectOption('#panel-type', { label: 'SSD1306, 128 × 64, black and white' });
    // Of 1024 bytes and 8 windows of 11, nine bits each.
    await tab.waitForFunction(() => /SPI at 10 MHz[^]*I²C at 400 kHz[^]* 25 ms/.test(document.querySelector('#costs').textContent));
  },

  async 'what does not fit a chip fits after the advice of the page'(tab) {
    const strips = (rings) => {
      const [lines, sides] = [[], 40];
      for (let ring = 0; ring <= rings; ring++) {
        for (let side = 0; side < sides; side++) lines.push(`v ${Math.sin((side * 6.28) / sides)} ${Math.cos((side * 6.28) / sides)} ${ring / 50}`);
      }
      for (let ring = 0; ring < rings; ring++) {
        for (let side = 0; side < sides; side++) {
          const [a, b] = [ring * sides + side + 1, ring * sides + ((side + 1) % sides) + 1];
          lines.push(`f ${a} ${b} ${b + sides} ${a + sides}`);
        }
      }
      return lines.join('\n');
    };
    await load(tab, 'long.obj', Buffer.from(strips(250))); // 20 000 faces
    await tab.selectOption('#chip', 'stm32f030');
    await tab.waitForFunction(() => /^Does not fit/.test(document.querySelector('#verdict').textContent));
    for (let press = 0; press < 2 && /^Does not fit/.test(await tab.textContent('#verdict')); press++) {
      const before = await tab.textContent('#verdict');
      await tab.click('#advice button.remedy');
      await tab.waitForFunction((before) => document.querySelector('#verdict').textContent !== before, before);
    }
    assert.match(await tab.textContent('#verdict'), /^Fits the STM32F030xC/);
    const faces = Number(/([\d\u202f]+) faces/.exec(await tab.textContent('#model'))[1].replaceAll('\u202f', ''));
    assert.ok(faces > 1000 && faces < 5000, `${faces} faces`);
  },

  async 'the firmware of every board is saved, and so are picture.rs and the mesh'(tab) {
    const saves = async (button) => (await Promise.all([tab.waitForEvent('download'), tab.click(button)]))[0];
    await tab.selectOption('#projection', 'cabinet');
    await tab.selectOption('#style', 'gouraud');
    const zips = async (file = 'src/picture.rs') => {
      const boards = await tab.locator('#board option:not([disabled])').evaluateAll((all) => all.map((o) => o.value));
      for (const board of boards) {
        await tab.selectOption('#board', board);
        const download = await saves('#zip');
        assert.equal(download.suggestedFilename(), `${board}.zip`);
        const listed = execFileSync('python3', ['-m', 'zipfile', '-t', await download.path()]).toString();
        assert.match(listed, /Done testing/);
        const names = execFileSync('python3', ['-m', 'zipfile', '-l', await download.path()]).toString();
        assert.ok(names.includes(`firmware/${file}`), names);
      }
      return boards;
    };
    await settled(tab);
    assert.ok((await zips()).length >= 8);
    assert.match(readFileSync(await (await saves('#picture')).path(), 'utf8'), /pinhole::Projection::oblique\(/);
    assert.match(readFileSync(await (await saves('#rust')).path(), 'utf8'), /pub const MODEL: pinhole::Mesh/);

    // Bands have the page's rows. The strips of two cores are two bands high, and fill the display.
    const bands = async (rows) => {
      await tab.locator('#rows').fill(rows);
      await tab.locator('#rows').press('Tab');
      await tab.waitForFunction((rows) => document.querySelector('#cost tr.chosen').textContent.startsWith(`bands of ${rows} rows`), rows);
    };
    await tab.selectOption('#board', 'rp2040-st7789');
    await bands('16');
    // The pixels of two bands, and the clocks of the board.
    assert.match(await tab.textContent('#cost tr.chosen details'), /pixels 15\.0 KB[^]*driver, log and the rest \d/);
    assert.match(await tab.textContent('#notes'), /as rp2040-st7789 has it, M0\+ at 125 MHz, its bus at 62\.5 MHz; one band is drawn while another is sent, and only what changes, here 42 % of the picture\./);
    assert.equal(await tab.inputValue('#chip'), 'rp2040');
    // The figures are those of the board: another clock, another bus, and what changes.
    const speed = () => tab.innerText('#verdict .meters > div:nth-child(3)');
    const before = await speed();
    await tab.selectOption('#board', 'rp2040-embassy');
    await tab.waitForFunction(() => /as rp2040-embassy has it, M0\+ at 200 MHz, its bus at 50 MHz; .*, and only what changes, here \d\d % of/.test(document.querySelector('#notes').textContent));
    assert.notEqual(await speed(), before);
    await tab.selectOption('#board', 'rp2040-st7789');
    await bands('16');
    assert.match(readFileSync(await (await saves('#zip')).path(), 'latin1'), /const ROWS: u32 = 16;/);
    await tab.selectOption('#board', 'rp2040-two-cores');
    await tab.waitForFunction(() => /two cores draw as many bands each\. Use bands of 12 rows/.test(document.querySelector('#bands').textContent));
    await tab.click('#zip');
    await settled(tab);
    assert.match(await tab.textContent('#status'), /rows that divides 120\.$/);
    await bands('8');

    // Textured faces have one more file: for a model without coordinates, and for one with coordinates and a picture.
    const texture = async () => readFileSync(await (await saves('#texels')).path(), 'utf8');
    assert.ok(!(await tab.isVisible('#texels')));
    await tab.selectOption('#style', 'textured');
    await settled(tab);
    assert.ok((await zips('src/texture.rs')).length >= 8);
    assert.match(await texture(), /fn corners\(/);
    await load(tab, 'sheet.obj', Buffer.from(SHEET));
    await dropPicture(tab);
    await settled(tab);
    assert.ok((await zips('src/texture.rs')).length >= 8);
    assert.match(await texture(), /MODEL_TEXTURE\.corners\(face\)[^]*`texture`, 16 x 16 texels of 2 colours/);

    // In other formats, the board of the display and the one for any.
    await tab.selectOption('#style', 'hidden-line');
    await tab.selectOption('#panel-type', { label: 'SSD1306, 128 × 64, black and white' });
    await settled(tab);
    assert.deepEqual(await zips(), ['stm32-ssd1306', 'any-cortex-m']);
    await tab.selectOption('#panel-type', { label: 'e-paper, 212 × 104, black, white and red' });
    await settled(tab);
    assert.deepEqual(await zips('src/tricolor.rs'), ['any-cortex-m']);
  },

  async 'each way to draw in the table can be chosen, and its firmware saved'(tab) {
    const source = async () => {
      const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#picture')]);
      return readFileSync(await download.path(), 'utf8');
    };
    const ways = [
      ['flat', "bands of 8 rows, painter's order", 8, /sorted\([^]*painter\.order/], ['flat', 'bands of 8 rows, without depth', 8, /transform\(self\.cache\)\.bin_faces/],
      ['flat', 'a whole picture, with depth', 1, /faces\.draw\(.*depth_tested/], ['flat', "a whole picture, painter's order", 1, /painter\.order/],
      ['flat', 'a whole picture, without depth', 1, /faces\.draw\(&mut band\.pixels\(\)\)/], ['wireframe', 'lines in a whole picture', 1, /edges\.draw\(&mut band\.pixels\(\)\)/],
      ['wireframe', 'lines in bands of 8 rows', 8, /edges\.draw\(COLOR, &mut band\)/], ['hidden-line', 'hidden lines in bands of 16 rows', 8, /hidden_line\(COLOR/],
    ];
    const before = await pixels(tab);
    for (const [style, name, boards, code] of ways) {
      await tab.selectOption('#style', style);
      await tab.locator('#cost button.way', { hasText: name }).dispatchEvent('click');
      await tab.waitForFunction((name) => document.querySelector('#cost tr.chosen th')?.textContent.startsWith(name), name);
      await settled(tab);
      assert.equal((await pixels(tab)) === before, name === 'a whole picture, with depth', `${name}: the picture`); // a gear is not convex
      assert.equal(await tab.locator('#board option:not([disabled])').count(), boards, name);
      assert.equal(await tab.isVisible('#in-one-piece'), boards === 1, name);
      const text = await source();
      assert.match(text, code, name);
      assert.equal(/[dD]epth/.test(text), /with depth|hidden/.test(name), name);
    }
    await tab.selectOption('#style', 'flat');
    await tab.locator('#cost button.way', { hasText: 'a whole picture, with depth' }).dispatchEvent('click');
    await tab.click('#in-one-piece button');
    await tab.waitForFunction(() => /^bands of 16 rows, with/.test(document.querySelector('#cost tr.chosen').textContent));
  },

  async 'each control has a name, is large enough, and has contrast, in light and dark, on a phone'(tab) {
    for (const colorScheme of ['light', 'dark']) {
      for (const [width, height] of [[1280, 900], [390, 844]]) {
        await tab.emulateMedia({ colorScheme });
        await tab.setViewportSize({ width, height });
        await settled(tab);
        if (folder) await tab.screenshot({ path: join(folder, `${width}-${colorScheme}.png`), fullPage: true });
        const found = await tab.evaluate(judge);
        assert.deepEqual(found, [], `${colorScheme}, ${width} × ${height}`);
      }
    }
  },
};

// In the page: what is wrong with its controls and texts.
function judge() {
  const wrong = [];
  if (document.documentElement.scrollWidth > innerWidth) wrong.push(`${document.documentElement.scrollWidth} pixels wide`);
  const shown = (e) => e.checkVisibility() && e.getClientRects().length > 0;
  for (const control of document.querySelectorAll('button, input, select, canvas')) {
    if (!shown(control)) continue;
    const name = control.getAttribute('aria-label') ?? control.labels?.[0]?.textContent ?? control.textContent;
    if (!name.trim()) wrong.push(`${control.id}: no name`);
    const { width, height } = (control.type === 'checkbox' ? control.parentElement : control).getBoundingClientRect();
    if (width < 24 || height < 24) wrong.push(`${control.id}: ${width} × ${height}`);
  }
  const numbers = (color) => color.match(/[\d.]+/g).map(Number);
  const luminance = (color) => {
    const [r, g, b] = numbers(color).map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  for (const element of document.querySelectorAll('h1, h2, p, label, legend, button, select, td, th, summary, output, .warning')) {
    if (!shown(element) || !element.textContent.trim() || element.disabled) continue;
    let behind = element;
    while (behind && numbers(getComputedStyle(behind).backgroundColor)[3] === 0) behind = behind.parentElement;
    const pair = [getComputedStyle(element).color, getComputedStyle(behind ?? document.body).backgroundColor].map(luminance);
    const contrast = (Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05);
    if (contrast < 4.5) wrong.push(`${element.tagName} ${element.id} ${element.textContent.slice(0, 20)}: contrast ${contrast.toFixed(1)}`);
  }
  return wrong;
}

async function open(link = address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
  const tab = await context.newPage();
  tab.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  tab.on('pageerror', (problem) => problems.push(problem.message));
  tab.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) problems.push(`a request to ${request.url()}`);
  });
  const start = Date.now();
  await tab.goto(link);
  await tab.waitForFunction(() => /drawn/.test(document.querySelector('#status').textContent));
  tab.firstPicture = Date.now() - start;
  // Folded parts are opened, so that their controls are reached.
  await tab.evaluate(() => document.querySelectorAll('details').forEach((part) => (part.open = true)));
  return tab;
}

// A square with texture coordinates.
const SHEET = 'v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n';

// Waits until the page has drawn what was asked for, and answered its controls.
const settled = (tab) => tab.evaluate(async () => {
  const isBusy = () => asked || held || [...waiting.values()].some(({ values }) => !['costs', 'film'].includes(values[0]));
  const late = performance.now() + 2000;
  do await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  while (isBusy() && !(turning && performance.now() > late)); // on a slow tab the turntable always waits for a picture
});
const pixels = (tab) => tab.evaluate(() => document.querySelector('#display').toDataURL());
const faces = async (tab) => Number(/([\d\u202f]+) faces/.exec(await tab.textContent('#model'))[1].replaceAll('\u202f', ''));
// A page built without Clang does not decimate.
const decimates = (tab) => tab.isVisible('#decimate');
const isGood = (tab) => tab.evaluate(() => !document.querySelector('#status').classList.contains('bad'));

async function drag(tab, right, down) {
  const { x, y, width, height } = await tab.locator('#display').boundingBox();
  await tab.mouse.move(x + width / 2, y + height / 2);
  await tab.mouse.down();
  await tab.mouse.move(x + width / 2 + right, y + height / 2 + down, { steps: 3 });
  await tab.mouse.up();
}

// Chooses a file by the control, given its bytes or its path, and waits until the page describes it.
async function load(tab, name, buffer, timeout = 30_000) {
  await tab.setInputFiles('#file', typeof buffer === 'string' ? buffer : { name, mimeType: 'application/octet-stream', buffer });
  await tab.waitForFunction((name) => {
    const [status, mesh] = ['#status', '#mesh'].map((id) => document.querySelector(id));
    return mesh.value === 'file' && mesh.selectedOptions[0].textContent === name && !status.textContent.startsWith('Reading');
  }, name, { timeout });
  await settled(tab);
}

// Drops the picture `halves.png` alone.
async function dropPicture(tab) {
  await dropFiles(tab, [], true);
}

// Drops files together, given their names and texts; with a picture, also a PNG of 16 × 16 pixels: the left half green, the right half
// blue.
async function dropFiles(tab, files, hasPicture = false) {
  const data = await tab.evaluateHandle(async ([files, hasPicture]) => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 16, height: 16 });
    const context = canvas.getContext('2d');
    ['#00ff00', '#0000ff'].forEach((color, i) => {
      context.fillStyle = color;
      context.fillRect(8 * i, 0, 8, 16);
    });
    const transfer = new DataTransfer();
    for (const [name, text] of files) transfer.items.add(new File([text], name));
    if (hasPicture) transfer.items.add(new File([await new Promise((done) => canvas.toBlob(done))], 'halves.png'));
    return transfer;
  }, [files, hasPicture]);
  await tab.dispatchEvent('#frame', 'drop', { dataTransfer: data });
  if (!hasPicture) return;
  await tab.waitForFunction(() => document.querySelector('#texture').selectedOptions[0].textContent === 'halves.png');
}

// A binary STL file of a surface of triangles around an axis, pointed at its ends.
function stl(count) {
  const bytes = Buffer.alloc(84 + 50 * count);
  bytes.writeUInt32LE(count, 80);
  const point = (i, z) => [Math.cos((2 * Math.PI * i) / count) * (2 + (i % 7)), Math.sin((2 * Math.PI * i) / count) * (2 + (i % 7)), z];
  for (let i = 0; i < count; i++) {
    const corners = [point(i, 0), point(i + 1, 0), point(i + 0.5, 3)];
    corners.flat().forEach((c, k) => bytes.writeFloatLE(c, 84 + 50 * i + 12 + 4 * k));
  }
  return bytes;
}

Object.assign(tests, controls({ browser, pixels, settled, isGood, faces, load }), mistakes({ address, open, pixels, settled, load, faces, decimates, isGood, dropFiles, stl, SHEET }));

// ONLY selects tests by parts of their names with `|` between them, for work on some of them.
const only = process.env.ONLY ?? '';
for (const [name, test] of Object.entries(tests).filter(([name]) => only.split('|').some((part) => name.includes(part)))) {
  const tab = await open();
  problems.length = 0;
  try {
    await test(tab);
    assert.deepEqual(problems, [], 'in the console');
    passed += 1;
    console.log(`ok: ${name}`);
  } catch (problem) {
    failed += 1;
    console.log(`FAILED: ${name}: ${problem.message}`);
  }
  await tab.context().close();
}
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
