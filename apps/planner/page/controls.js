// The controls change the state, and follow it.
'use strict';

// Whether the user types the sides, even if a panel of the menu has these sides.
let isOwnSize = false;

function showControls() {
  for (const key of ['mesh', 'style', 'projection', 'up', 'format', 'width', 'height', 'yaw', 'pitch', 'ambient', 'edges', 'chip', 'rows', 'core', 'mhz', 'ram', 'flash']) {
    $(key).value = state[key];
  }
  for (const key of ['flip', 'fix-winding', 'two-sided']) $(key).checked = state[key] === 1;
  $('smooth-edges').checked = smooths();
  $('smooth-edges').disabled = !canSmooth();
  write('smooth-note', canSmooth() ? '' : ofLines() ? 'Edges are smoothed where faces are drawn.' : 'Smooth edges need colours between two others, which this display lacks.');
  for (const key of ['color', 'background']) $(key).value = `#${state[key]}`;
  $('spi').value = state.spi || '';
  $('lamp').hidden = ofLines();
  $('lines').hidden = !ofLines();
  const panel = menu.displays.indexOf(panelOf(state));
  isOwnSize ||= panel < 0;
  $('panel-type').value = isOwnSize ? 'own' : panel;
  $('own').hidden = !isOwnSize;
  $('own-chip').hidden = state.chip !== 'own';
  $('panel-note').textContent = factsOf(panelChosen()).note ?? '';
  const { basis } = menu.chips.find(({ key }) => key === state.chip) ?? {};
  $('basis').textContent = basis ? `An estimate, by ${basis}.` : '';
  $('texture').value = state.texture;
  $('textures').hidden = state.style !== 'textured';
  showDecimation(state.decimate);
  // Some formats always dither faces.
  const isDithered = menu.dithered.includes(state.format);
  $('dither').checked = !ofLines() && (isDithered || state.dither === 1);
  $('dither').disabled = ofLines() || state.style === 'textured' || isDithered;
  moveSlider($('zoom'), ZOOMS, state.zoom);
  readLamp();
  for (const key of ['around', 'above']) $(key).value = lamp[key];
  showValues();
}

// Shows a slider's value in words: a slider has steps and a scale, so its own number may be another one.
function showValue(key, text) {
  $(`${key}-value`).textContent = text;
  $(key).ariaValueText = text;
}

// The numbers of the sliders, beside their names.
function showValues() {
  const angles = { around: lamp.around, above: lamp.above, yaw: state.yaw, pitch: state.pitch };
  for (const [key, degrees] of Object.entries(angles)) showValue(key, `${String(hundredths(degrees)).replace('-', '−')}°`);
  showValue('zoom', `${state.zoom} %`);
  const edges = state.edges ? `more than ${state.edges}°` : state.style === 'wireframe' ? 'any angle' : 'any angle but 0°';
  showValue('edges', edges);
  showValue('ambient', `${Math.round((state.ambient * 100) / 256)} %`);
}

function options(select, items) {
  select.replaceChildren(...items.map(([value, text]) => element('option', { value }, text)));
}

// A field for whole numbers. One that is empty is `empty`, if that is given; any other value that it cannot have is refused with the
// range, and the number before it stays.
function takeNumber(id, key = id, empty = undefined) {
  $(id).addEventListener('change', ({ target: field }) => {
    const isEmpty = field.value === '' && !field.validity.badInput;
    const isGood = isEmpty ? empty !== undefined : field.checkValidity();
    if (isGood) {
      set({ [key]: isEmpty ? empty : Number(field.value) });
      return;
    }
    field.value = ''; // of letters, too, which a browser keeps otherwise
    showControls();
    const kept = field.value ? `${count(Number(field.value))} stays` : 'it stays empty';
    say(`${field.ariaLabel ?? field.labels[0].textContent.trim()}: a whole number from ${count(Number(field.min))} to ${count(Number(field.max))}; ${kept}.`, true);
  });
}

function buildControls() {
  options($('mesh'), menu.meshes.map((name) => [name, name]));
  options($('panel-type'), [...menu.displays.map(({ name }, i) => [i, name]), ['own', 'another size']]);
  options($('format'), menu.formats.map((name) => [name, name]));
  options($('style'), menu.styles.map((name) => [name, { 'hidden-line': 'hidden line', flat: 'flat faces', gouraud: 'Gouraud' }[name] ?? name]));
  options($('projection'), menu.projections.map(({ name }) => [name, name]));
  options($('texture'), menu.textures.filter((name) => name !== 'file').map((name) => [name, name]));
  options($('chip'), menu.chips.map(({ key, name }) => [key, name]));
  options($('core'), menu.cores.map((name) => [name, name]));
  options($('shown'), Object.keys(SHOWN).map((name) => [name, name]));
  options($('board'), boardsOf(templates));
  options($('up'), [['auto', 'as usual for the file'], ...menu.axes.map((name) => [name, name])]);

  // Another mesh has another number of faces.
  $('mesh').addEventListener('input', (e) => {
    allFaces = 0;
    set({ mesh: e.target.value, decimate: 0 });
  });
  for (const key of ['style', 'texture', 'up', 'format', 'chip', 'core']) $(key).addEventListener('input', (e) => set({ [key]: e.target.value }));
  for (const key of ['yaw', 'pitch', 'ambient', 'edges']) $(key).addEventListener('input', (e) => set({ [key]: Number(e.target.value) }));
  $('zoom').addEventListener('input', (e) => set({ zoom: numberAt(e.target, ZOOMS) }));
  for (const key of ['width', 'height', 'rows', 'mhz', 'ram', 'flash']) {
    takeNumber(key);
  }
  takeNumber('spi', 'spi', 0);
  for (const key of ['dither', 'smooth-edges', 'flip', 'fix-winding', 'two-sided']) {
    $(key).addEventListener('input', (e) => set({ [key]: e.target.checked ? 1 : 0 }));
  }
  for (const key of ['color', 'background']) $(key).addEventListener('input', (e) => set({ [key]: e.target.value.slice(1) }));
  // Decimates while the slider is dragged, if the mesh is made fast enough; otherwise when it is released.
  $('decimate').addEventListener('input', () => {
    if (slowest < 250) set({ decimate: decimated() });
    else showDecimation(decimated());
  });
  $('decimate').addEventListener('change', () => set({ decimate: decimated() }));
  takeNumber('decimate-to', 'decimate', 0);
  for (const key of ['around', 'above']) {
    $(key).addEventListener('input', (e) => moveLamp(key, Number(e.target.value)));
  }
  $('projection').addEventListener('input', (e) => {
    const { name, yaw, pitch } = menu.projections.find(({ name }) => name === e.target.value);
    set({ projection: name, yaw, pitch });
  });
  $('panel-type').addEventListener('input', (e) => {
    const display = menu.displays[e.target.value];
    isOwnSize = !display;
    if (display) {
      const isPaper = display.name.startsWith('e-paper');
      const wasPaper = state.background === 'ffffff';
      const { width, height, format } = display;
      const [controller, spi] = [controllerOf(display), clockOf(display)];
      set({ width, height, format, spi, controller, ...(isPaper === wasPaper ? {} : { background: isPaper ? 'ffffff' : '000000' }) });
    } else {
      showControls();
    }
  });
  $('shown').addEventListener('input', drawMatrix);
  $('matrix').addEventListener('keydown', moveInMatrix);
  $('compare').addEventListener('toggle', showMatrix);
  for (const id of ['file', 'picture-file']) $(id).addEventListener('change', (e) => openAll(e.target.files));
  $('board').addEventListener('input', (e) => {
    const board = e.target.value;
    set({ board, chip: partsOf(board).chip ?? state.chip });
  });
  $('panel').addEventListener('submit', (e) => e.preventDefault());
  $('reset').addEventListener('click', reset);
  $('reset-all').addEventListener('click', resetAll);
  $('nearer').addEventListener('click', () => zoom(1.25));
  $('farther').addEventListener('click', () => zoom(0.8));
  $('true-size').addEventListener('click', trueSize);
  $('turntable').addEventListener('click', turntable);
  $('png').addEventListener('click', savePng);
  $('gif').addEventListener('click', saveGif);
  $('cancel').addEventListener('click', cancel);
  $('link').addEventListener('click', copyLink);
  $('zip').addEventListener('click', saved(saveZip));
  $('picture').addEventListener('click', saved(() => saveSource('picture.rs')));
  $('texels').addEventListener('click', saved(() => saveSource('texture.rs')));
  $('rust').addEventListener('click', saved(saveRust));
}
