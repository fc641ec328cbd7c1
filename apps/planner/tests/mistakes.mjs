// Tests of the page for what users do by mistake, and what links, files and screen readers make of it: wrong values, wrong files,
// models that cannot be drawn, and controls whose values have limits. browser.mjs runs them.
import assert from 'node:assert/strict';

export const mistakes = ({ address, open, pixels, settled, load, faces, decimates, isGood, dropFiles, stl, SHEET }) => ({
  async 'an own size is chosen, and the size of a panel that is typed there does not hide the fields'(tab) {
    await tab.selectOption('#panel-type', 'own');
    await settled(tab);
    assert.ok(await tab.isVisible('#width'));
    await type(tab, '#width', '320');
    assert.ok(await tab.isVisible('#width'), 'typing 320 × 240 hid the fields');
    await type(tab, '#height', '100');
    await settled(tab);
    assert.match(await tab.textContent('#status'), /^320 × 100:/);
    await tab.selectOption('#panel-type', '0');
    assert.ok(!(await tab.isVisible('#width')));
  },

  async 'a model that cannot be drawn stops the turntable, and its remedy is pressed, with the focus kept'(tab) {
    await tab.click('#turntable');
    await load(tab, 'large.stl', stl(70_000));
    await tab.waitForTimeout(300);
    assert.equal(await tab.getAttribute('#turntable', 'aria-pressed'), 'false');
    if (!(await tab.isVisible('#warnings button.remedy'))) return;
    await tab.evaluate(() => (window.button = document.querySelector('#warnings button.remedy')));
    await tab.locator('#display').press('ArrowLeft');
    await settled(tab);
    assert.ok(await tab.evaluate(() => window.button.isConnected), 'the same warning was made again');
    // Nor is the model read again for another view of it.
    await tab.evaluate(() => {
      window.draws = 0;
      const { draw } = library;
      library.draw = (text) => { window.draws += 1; return draw(text); };
    });
    await tab.locator('#display').press('ArrowLeft');
    await settled(tab);
    assert.equal(await tab.evaluate(() => window.draws), 0);
    await tab.click('#warnings button.remedy');
    await tab.waitForFunction(() => !document.querySelector('#status').classList.contains('bad'));
    assert.ok((await faces(tab)) <= 20_000);
    assert.notEqual(await focused(tab), 'BODY');
  },

  async 'after a remedy the focus is on a control, or on the status'(tab) {
    await load(tab, 'sheet.obj', Buffer.from('v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n'));
    await tab.focus('#warnings button');
    await tab.keyboard.press('Enter');
    await settled(tab);
    assert.equal(await tab.textContent('#warnings'), '');
    assert.equal(await focused(tab), 'two-sided');
    await tab.selectOption('#board', 'stm32f4-ili9341');
    await tab.focus('#other-display button');
    await tab.keyboard.press('Enter');
    await settled(tab);
    assert.equal(await focused(tab), 'panel-type');
  },

  async 'a link with a part that is not understood draws with the default, and says which part'() {
    const parts = ['zoom=abc', 'color=zzz', 'mesh=nothing', 'turn=500', 'yaw=', 'constructor=2', 'light=1,x,2,3', 'projection=round', 'style=flat%26x=9', 'texture=none'];
    for (const part of parts) {
      const tab = await open(`${address}#width=128&${part}`);
      assert.ok(await isGood(tab), `${part}: ${await tab.textContent('#status')}`);
      assert.match(await tab.textContent('#status'), /^128 × 240:/, part);
      const said = await tab.textContent('#notice');
      assert.ok(said.includes(decodeURIComponent(part)), `${part}: ${said}`);
      assert.equal(new URL(tab.url()).hash, '#width=128', part);
      await tab.context().close();
    }
    const good = await open(`${address}#width=128&zoom=150&projection=isometric`);
    assert.equal(await good.textContent('#notice'), '');
    await good.context().close();
  },

  async 'a link of an own file asks for it, and its settings are of that file'(tab) {
    await load(tab, 'a part.stl', stl(400));
    await tab.selectOption('#up', 'y');
    await tab.selectOption('#projection', 'front');
    if (await decimates(tab)) await type(tab, '#decimate-to', '100');
    await settled(tab);
    const [picture, link] = [await pixels(tab), tab.url()];
    const other = await open(link);
    assert.match(await other.textContent('#notice'), /made with a file, a part\.stl: drop it here/);
    assert.equal(await other.inputValue('#mesh'), 'gear');
    assert.equal(await other.inputValue('#up'), 'auto');
    assert.equal(other.url(), link, 'the link is kept, for a reload');
    const gear = await open(`${address}#projection=front`);
    assert.equal(await pixels(other), await pixels(gear), 'the gear has settings of the file');
    await gear.context().close();
    await load(other, 'a part.stl', stl(400));
    assert.equal(await pixels(other), picture);
    assert.equal(await other.textContent('#notice'), '');
    assert.equal(other.url(), link);
    // Another file has its own settings.
    await load(other, 'next.stl', stl(100));
    assert.equal(await other.inputValue('#up'), 'auto');
    await other.context().close();
  },

  async 'a link of an own picture asks for it'(tab) {
    await dropFiles(tab, [['part.obj', SHEET]], true);
    await settled(tab);
    const other = await open(tab.url());
    assert.match(await other.textContent('#notice'), /part\.obj.*halves\.png/);
    assert.ok(await isGood(other));
    assert.equal(await other.inputValue('#style'), 'textured');
    await other.selectOption('#mesh', 'cube');
    await settled(other);
    assert.doesNotMatch(await other.textContent('#notice'), /part\.obj/);
    assert.doesNotMatch(other.url(), /mesh=file/);
    await other.context().close();
  },

  async 'a file that cannot be read is a message, and the model before it stays'(tab) {
    await load(tab, 'good.stl', stl(12));
    const picture = await pixels(tab);
    await tab.setInputFiles('#file', { name: 'notes.zip', mimeType: 'application/zip', buffer: Buffer.from('PK\x03\x04 and so on') });
    await tab.waitForFunction(() => document.querySelector('#status').classList.contains('bad'));
    assert.match(await tab.textContent('#status'), /^notes\.zip: .*good\.stl/);
    await tab.setInputFiles('#file', { name: 'stray.obj', mimeType: 'model/obj', buffer: Buffer.from('v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n') });
    await tab.waitForFunction(() => /stray\.obj:/.test(document.querySelector('#status').textContent)); // it is read before
    assert.match(await tab.textContent('#status'), /^stray\.obj:4: the face names a vertex that does not exist/, 'the name is there once');
    assert.equal(await tab.evaluate(() => document.querySelector('#mesh').selectedOptions[0].textContent), 'good.stl');
    assert.equal(await tab.inputValue('#file'), '');
    assert.ok(!(await tab.evaluate(() => document.querySelector('#display').classList.contains('stale'))));
    assert.equal(await tab.textContent('#model').then((text) => /faces/.test(text)), true);
    await tab.waitForTimeout(300);
    assert.ok(await tab.isVisible('#costs'));
    await tab.click('#nearer');
    await tab.click('#reset');
    await settled(tab);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
    assert.equal(await pixels(tab), picture);
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('#rust')]);
    assert.equal(download.suggestedFilename(), 'good.rs');
  },

  async 'of two models that are dropped one is taken, and the page says so'(tab) {
    await dropFiles(tab, [['readme.txt', 'read me'], ['one.obj', SHEET], ['two.obj', SHEET]]);
    await tab.waitForFunction(() => document.querySelector('#mesh').value === 'file');
    await settled(tab);
    assert.equal(await tab.evaluate(() => document.querySelector('#mesh').selectedOptions[0].textContent), 'one.obj');
    assert.match(await tab.textContent('#notice'), /one\.obj.*not two\.obj, readme\.txt/);
    assert.ok(await isGood(tab), await tab.textContent('#status'));
  },

  async 'while the turntable turns, a screen reader is left in peace, messages stay, and choices are kept'(tab) {
    await tab.waitForTimeout(400);
    await tab.evaluate(() => {
      window.writes = { status: 0, display: 0, cost: 0 };
      for (const id of Object.keys(window.writes)) {
        const options = { childList: true, characterData: true, subtree: true, attributes: id === 'display', attributeFilter: id === 'display' ? ['aria-label'] : undefined };
        new MutationObserver(() => (window.writes[id] += 1)).observe(document.getElementById(id), options);
      }
    });
    await tab.click('#turntable');
    await tab.waitForTimeout(1500);
    const writes = () => tab.evaluate(() => window.writes);
    const { status, display } = await writes();
    assert.ok(status <= 1 && display <= 1, `${status} and ${display} writes`);
    await tab.click('#link');
    await tab.waitForTimeout(400);
    assert.match(await tab.textContent('#status'), /^The link is in/);
    // The costs follow a choice, and are not asked for at each step of the turn.
    const before = (await writes()).cost;
    await tab.selectOption('#chip', 'esp32c3');
    await tab.waitForTimeout(700);
    assert.match(await tab.textContent('#costs'), /ESP32-C3/);
    const { cost } = await writes();
    assert.ok(cost - before === 1, `${cost - before} times`);
    assert.match(tab.url(), /chip=esp32c3/);
    await tab.click('#turntable');
    await tab.waitForTimeout(300);
    assert.match(await tab.textContent('#status'), /drawn/);
    assert.equal((await writes()).cost, cost + 1);
    // A file that is read meanwhile is described.
    await tab.click('#turntable');
    await load(tab, 'turned.stl', stl(12));
    assert.match(await tab.textContent('#status'), /drawn/);
    assert.match(await tab.textContent('#model'), /12 faces/);
    await tab.click('#turntable');
    await tab.selectOption('#mesh', 'gear');
    await settled(tab);
    const outputs = await tab.locator('output').evaluateAll((all) => all.filter((o) => o.ariaLive !== 'off').map((o) => o.id));
    assert.deepEqual(outputs, []);
    // An image takes no keys.
    const [role, description, label] = await tab.locator('#display').evaluate((e) => ['role', 'aria-roledescription', 'aria-label'].map((name) => e.getAttribute(name)));
    assert.equal(role, 'application');
    assert.ok(description && /^gear, flat/.test(label), label);
  },

  async 'the address is not written more often than browsers permit, and has the last choice'(tab) {
    await tab.evaluate(() => {
      window.calls = 0;
      const replace = history.replaceState.bind(history);
      history.replaceState = (...parts) => { window.calls += 1; replace(...parts); };
    });
    const start = Date.now();
    for (let i = 0; i < 60; i++) {
      await tab.locator('#display').press('ArrowLeft');
      await settled(tab);
    }
    const [calls, most] = [await tab.evaluate(() => window.calls), 21 + (Date.now() - start) / 400];
    assert.ok(calls <= most, `${calls} times, more than ${most}`);
    const yaw = await tab.inputValue('#yaw');
    await tab.waitForFunction((yaw) => location.hash.includes(`yaw=${yaw}`), yaw, { timeout: 8000 });
  },

  async 'the slider for faces is logarithmic, has a field beside it, and stays where all faces are too many'(tab) {
    if (!(await decimates(tab))) return;
    await load(tab, 'large.stl', stl(70_000));
    assert.ok(await tab.isVisible('#decimate'), 'no slider while the model is too large');
    await tab.click('#warnings button.remedy');
    await tab.waitForFunction(() => !document.querySelector('#status').classList.contains('bad'));
    assert.match(await tab.textContent('#decimate-value'), /20\u202f000 of 70\u202f000 faces/);
    // A step of the slider is a part of the faces, not a number of them.
    await type(tab, '#decimate-to', '100');
    await settled(tab);
    assert.match(tab.url(), /decimate=100\b/);
    await tab.locator('#decimate').press('ArrowLeft');
    await settled(tab);
    const fewer = Number(await tab.inputValue('#decimate-to'));
    assert.ok(fewer >= 90 && fewer < 100, `${fewer}`);
    await tab.locator('#decimate').press('End');
    await tab.waitForFunction(() => document.querySelector('#status').classList.contains('bad'));
    assert.match(await tab.textContent('#status'), /vertices, more than the 65\u202f536 of a mesh/);
    assert.ok(await tab.isVisible('#decimate'), 'the slider is gone');
    assert.equal(await focused(tab), 'decimate');
    assert.doesNotMatch(tab.url(), /decimate/);
    await tab.locator('#decimate').press('Home');
    await tab.waitForFunction(() => !document.querySelector('#status').classList.contains('bad'));
    // From the low end, too, where steps are smaller than a face.
    for (let i = 0; i < 40; i++) await tab.locator('#decimate').press('ArrowRight');
    assert.ok(Number(await tab.inputValue('#decimate-to')) > 5);
    await load(tab, 'one.obj', Buffer.from('v 0 0 0\nv 3 0 0\nv 3 2 0\nf 1 2 3\n'));
    assert.match(await tab.textContent('#decimate-value'), /^1 face$/);
    assert.match(await tab.textContent('#model'), /3 vertices, 1 face;/);
    assert.match(await tab.textContent('#status'), /\b[01] faces? drawn/);
    assert.doesNotMatch(await tab.textContent('#status'), /\b1 faces/);
  },

  async 'small steps of a wheel add up, and the slider for zoom reaches as far as the wheel'(tab) {
    await tab.locator('#display').hover();
    for (let i = 0; i < 40; i++) {
      await tab.mouse.wheel(0, -1.5);
      await settled(tab);
    }
    const zoom = () => tab.textContent('#zoom-value').then(parseFloat);
    assert.ok((await zoom()) > 105, `${await zoom()} %`);
    for (let i = 0; i < 20; i++) await tab.click('#nearer');
    assert.equal(await zoom(), 2000);
    await tab.locator('#zoom').press('ArrowLeft');
    await settled(tab);
    assert.ok((await zoom()) > 1800 && (await zoom()) < 2000, `${await zoom()} %`);
    await tab.locator('#zoom').press('Home');
    await tab.locator('#zoom').press('ArrowRight');
    await tab.locator('#zoom').press('ArrowRight');
    assert.ok((await zoom()) > 20);
  },

  async 'angles are those of the state, and a lamp above keeps its direction'(tab) {
    assert.equal(await tab.textContent('#around-value'), '26.6°');
    await tab.selectOption('#projection', 'isometric');
    assert.equal(await tab.textContent('#pitch-value'), '35.26°');
    await tab.locator('#around').fill('90');
    await tab.locator('#above').fill('90');
    await settled(tab);
    assert.equal(await tab.textContent('#around-value'), '90°');
    await tab.selectOption('#projection', 'front');
    await tab.locator('#above').fill('0');
    await settled(tab);
    assert.equal(await tab.textContent('#around-value'), '90°');
    assert.match(decodeURIComponent(tab.url()), /light=60,0,0/);
  },

  async 'reset view resets the turn while the turntable turns, and reset all resets everything'(tab) {
    const first = await pixels(tab);
    await tab.click('#turntable');
    await tab.waitForTimeout(900);
    await tab.click('#reset');
    await tab.click('#turntable');
    await settled(tab);
    const turn = Number(/turn=(\d+)/.exec(tab.url())?.[1] ?? 0);
    assert.ok(turn <= 15, `at step ${turn}`);
    await tab.selectOption('#style', 'gouraud');
    await tab.selectOption('#panel-type', '3');
    await tab.click('#reset-all');
    await settled(tab);
    assert.equal(await pixels(tab), first);
    assert.equal(new URL(tab.url()).hash, '');
  },

  async 'a number outside its range is refused with the range, and the one before stays'(tab) {
    await tab.selectOption('#panel-type', 'own');
    for (const [field, wrong, range] of [['#spi', '0.4', '1 to 200'], ['#spi', '-3', '1 to 200'], ['#rows', '0', '1 to 1024'], ['#width', '-5', '1 to 1024'], ['#width', '', '1 to 1024'], ['#height', '5000', '1 to 1024']]) {
      const [before, link] = [await tab.inputValue(field), tab.url()];
      await type(tab, field, wrong);
      const said = (await tab.textContent('#status')).replaceAll('\u202f', '');
      assert.ok(said.includes(range), `${field} ${wrong}: ${said}`);
      assert.equal(await tab.inputValue(field), before);
      await settled(tab);
      assert.equal(tab.url(), link);
    }
    await tab.locator('#width').focus();
    await tab.keyboard.press('Control+a');
    await tab.keyboard.type('e');
    await tab.keyboard.press('Tab');
    assert.equal(await tab.inputValue('#width'), '240');
    await type(tab, '#spi', '20');
    await type(tab, '#spi', '');
    await settled(tab);
    assert.doesNotMatch(tab.url(), /spi/);
    assert.ok(await isGood(tab));
  },

  async 'one row is seen, dithering that is always on is checked, and numbers have one format'(tab) {
    await tab.selectOption('#panel-type', 'own');
    await type(tab, '#width', '1024');
    await type(tab, '#height', '1');
    await settled(tab);
    assert.ok((await tab.locator('#display').boundingBox()).height >= 1);
    await tab.selectOption('#panel-type', { label: 'SSD1306, 128 × 64, black and white' });
    assert.ok((await tab.isChecked('#dither')) && (await tab.isDisabled('#dither')));
    assert.doesNotMatch(tab.url(), /dither/);
    await tab.selectOption('#panel-type', '0');
    assert.ok(!(await tab.isChecked('#dither')) && !(await tab.isDisabled('#dither')));
    await load(tab, 'some 2024.stl', stl(20_000));
    const texts = await tab.evaluate(() => ['status', 'model', 'warnings'].map((id) => document.getElementById(id).textContent));
    assert.doesNotMatch(texts.join(' '), /\d{5}/);
    await load(tab, 'large 2024.stl', stl(70_000));
    assert.match(await tab.textContent('#status'), /^large 2024\.stl: .*65\u202f536/);
  },
});

const focused = (tab) => tab.evaluate(() => document.activeElement.id || document.activeElement.tagName);

// Types a value into a field and leaves it.
async function type(tab, field, value) {
  await tab.locator(field).fill(value);
  await tab.locator(field).press('Tab');
}
