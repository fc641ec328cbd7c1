// The page: controls, mouse, touch and keys change a state. The library draws the state, and the address contains it.
'use strict';

const $ = (id) => document.getElementById(id);
const TURNS = 120; // steps of a turn, as in the library
const DEFAULTS = {
  mesh: 'gear', width: 240, height: 240, format: 'rgb565', style: 'flat', dither: 0, projection: 'perspective', yaw: 30, pitch: 20,
  zoom: 100, x: 0, y: 0, turn: 0, color: 'ffd700', background: '000000', light: '2,3,4', ambient: 48, up: 'auto', flip: 0,
  'fix-winding': 0, 'two-sided': 0, decimate: 0, edges: 0, texture: 'checker', rows: 8, chip: 'rp2040', spi: 0,
};
const NUMBERS = Object.keys(DEFAULTS).filter((key) => typeof DEFAULTS[key] === 'number');

let library;
let menu;
let templates;
let fileName;
const materials = new Map(); // the material libraries that were opened, by their names
let state = { ...DEFAULTS };
let drawnModel = '';
let allFaces = 0; // of the model, without decimation
let slowest = 0; // milliseconds of the last frame that a new mesh was made for
let asked = false;

// Whether the style draws edges instead of faces.
const ofLines = () => ['wireframe', 'hidden-line'].includes(state.style);

// The choice that is passed to the library: every part of the state.
const choice = (of = state) => Object.entries(of).map(([key, value]) => `${key}=${value}`).join('&');

// The address has the parts of the state that differ from the defaults. Files are not in it: a receiver of the link does not have
// them.
function writeAddress() {
  const isOfFile = (key, value) => ['mesh', 'texture'].includes(key) && value === 'file';
  const parts = Object.entries(state).filter(([key, value]) => value !== DEFAULTS[key] && !isOfFile(key, value));
  const text = parts.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join('&');
  history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
}

function readAddress() {
  const read = { ...DEFAULTS };
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (!(key in DEFAULTS)) continue;
    read[key] = NUMBERS.includes(key) ? Number(value) : value;
  }
  const named = menu.projections.find(({ name }) => name === read.projection);
  if (named && !location.hash.includes('yaw=')) read.yaw = named.yaw;
  if (named && !location.hash.includes('pitch=')) read.pitch = named.pitch;
  return read;
}

// Draws once before the next frame of the screen, however many changes there were.
function change(changes) {
  Object.assign(state, changes);
  if (!asked) {
    asked = true;
    requestAnimationFrame(show);
  }
}

function show() {
  asked = false;
  const canvas = $('display');
  try {
    const before = performance.now();
    const { pixels, about } = library.draw(choice());
    const took = performance.now() - before;
    if (canvas.width !== about.width || canvas.height !== about.height) {
      [canvas.width, canvas.height] = [about.width, about.height];
    }
    canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(pixels), about.width, about.height), 0, 0);
    scale();
    canvas.classList.remove('stale');
    const { drawn, culled, clipped } = about.statistics;
    const what = ofLines() ? 'edges' : 'faces';
    say(`${about.width} × ${about.height}: ${drawn} ${what} drawn, ${culled} culled, ${clipped} clipped; ${count(about.bytes)} bytes a frame`);
    canvas.setAttribute('aria-label', `${state.mesh === 'file' ? fileName : state.mesh}, ${state.style}, ${state.projection}, on ${about.width} × ${about.height} pixels`);
    if (JSON.stringify(about.model) !== drawnModel) slowest = took;
    showModel(about.model);
    showCosts(library, choice());
    showBoards();
  } catch (problem) {
    say(problem.message, true);
    drawnModel = '';
    canvas.classList.add('stale');
    $('decimation').hidden = true;
    hideCosts();
    showBoards();
    const buttons = remedyButtons(problem.message);
    $('warnings').replaceChildren(...(buttons.length ? [element('div', { className: 'warning' }, 'This page can do it: ', ...buttons)] : []));
    $('model').textContent = '';
  }
  if (!turning) writeAddress();
}

// Boards whose templates do not draw the chosen style and format cannot be chosen.
function showBoards() {
  const boards = drawnModel ? boardsFor(templates, state) : [];
  for (const option of $('board').options) option.disabled = !boards.includes(option.value);
  if (boards.length > 0 && !boards.includes($('board').value)) $('board').value = boards[0];
  for (const id of ['zip', 'picture', 'texels']) $(id).disabled = boards.length === 0;
  $('rust').disabled = !drawnModel;
  $('texels').hidden = state.style !== 'textured';
  showOtherDisplay();
  $('no-firmware').hidden = boards.length > 0 || !drawnModel;
}

// A note if the board's display differs from the one that the page shows: its firmware frames the model for the board's display.
let otherDisplay = '';

function showOtherDisplay() {
  const { width, height } = displayOf(templates, $('board').value) ?? state;
  const isOther = !$('zip').disabled && (width !== state.width || height !== state.height);
  const text = isOther ? `The display of ${$('board').value} has ${width} × ${height} pixels, and its firmware frames the model for them. ` : '';
  if (text === otherDisplay) return;
  otherDisplay = text;
  $('other-display').hidden = !isOther;
  $('other-display').replaceChildren(text, ...(isOther ? [remedyButton(`Show ${width} × ${height} pixels`, { width, height })] : []));
}

const count = (number) => number.toLocaleString('en').replaceAll(',', '\u202f');

function say(text, isBad = false) {
  // Written only where it differs, so that a screen reader does not repeat it.
  if ($('status').textContent !== text) $('status').textContent = text;
  $('status').classList.toggle('bad', isBad);
}

// The importer's warnings, with a button for each remedy that the page has.
function showModel(model) {
  const text = JSON.stringify(model);
  if (text === drawnModel) return;
  drawnModel = text;
  $('model').textContent =
    `${count(model.vertices)} vertices, ${count(model.faces)} faces${model.edges ? `, ${count(model.edges)} edges` : ''}; ${count(model.flash)} bytes of flash`;
  allFaces = model.all;
  showDecimation(state.decimate);
  $('warnings').replaceChildren(...model.warnings.map(({ message, remedies }) =>
    element('div', { className: 'warning' }, `Warning: ${message} `, ...remedyButtons(message, remedies))));
}

// A button for each remedy of a message.
function remedyButtons(message, remedies = []) {
  const made = remedies.map(({ part, value }) => {
    const name = { 'two-sided': 'faces from behind', 'fix-winding': 'winding outwards', flip: 'reversed faces' }[part];
    return remedyButton(`${value ? 'Use' : 'Leave out'} ${name}`, { [part]: value });
  });
  if (menu.decimates && message.includes('--decimate N')) {
    // Half of the present faces, as long as that still helps; for a model too large for a mesh, as many faces as a display can
    // show.
    const now = state.decimate || allFaces;
    const faces = drawnModel && now ? Math.max(Math.min(Math.floor(now / 2), 20_000), 4) : Math.min(20_000, Math.floor((state.decimate || 40_000) / 2));
    if (faces < (state.decimate || Infinity)) made.push(remedyButton(`Decimate to ${count(faces)} faces`, { decimate: faces }));
  }
  return made;
}

function remedyButton(text, changes) {
  const button = element('button', { type: 'button', className: 'remedy' }, text);
  button.addEventListener('click', () => set(changes));
  return button;
}

// The slider goes from 4 faces to all; at its end nothing is decimated.
function showDecimation(decimate) {
  const most = Math.max(allFaces, decimate, 4);
  $('decimation').hidden = !menu.decimates || !drawnModel;
  $('decimate').max = most;
  $('decimate').value = decimate || most;
  $('decimate-faces').textContent = decimate ? `${count(decimate)} of ${count(most)} faces` : `all ${count(most)} faces`;
}

function element(name, properties, ...content) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...content);
  return made;
}

// Each pixel of the display takes a whole number of screen pixels, as many as fit.
function scale() {
  const canvas = $('display');
  const room = $('frame').clientWidth - 24;
  const fits = Math.min(room / canvas.width, Math.max(innerHeight * 0.6, 240) / canvas.height);
  const fine = devicePixelRatio || 1;
  const times = fits * fine >= 1 ? Math.floor(fits * fine) / fine : fits;
  canvas.style.width = `${canvas.width * times}px`;
  canvas.style.height = `${canvas.height * times}px`;
}

// Changes the state and the controls.
function set(changes) {
  change(changes);
  showControls();
}

// The display of the menu that has these pixels.
const panelOf = ({ width, height, format }) => menu.displays.find((d) => d.width === width && d.height === height && d.format === format);

// MHz that a controller's SPI takes by its data sheet, of an ILI9341 those of the board; an ST7789 takes what the chips have.
const CLOCKS = { ILI9341: 25, ST7735: 15, SSD1306: 10, SSD1327: 10, 'e-paper': 10 };

function showControls() {
  for (const key of ['mesh', 'style', 'projection', 'up', 'format', 'width', 'height', 'yaw', 'pitch', 'zoom', 'ambient', 'edges', 'chip', 'rows']) {
    $(key).value = state[key];
  }
  for (const key of ['dither', 'flip', 'fix-winding', 'two-sided']) $(key).checked = state[key] === 1;
  for (const key of ['color', 'background']) $(key).value = `#${state[key]}`;
  $('spi').value = state.spi || '';
  $('lamp').hidden = ofLines();
  $('lines').hidden = !ofLines();
  const panel = menu.displays.indexOf(panelOf(state));
  if ($('panel-type').value !== 'own' || panel >= 0) $('panel-type').value = panel >= 0 ? panel : 'own';
  $('own').hidden = $('panel-type').value !== 'own';
  $('texture').value = state.texture;
  $('textures').hidden = state.style !== 'textured';
  showDecimation(state.decimate);
  $('dither').disabled = ofLines() || state.style === 'textured' || menu.dithered.includes(state.format);
  const [x, y, z] = state.light.split(',').map(Number);
  $('around').value = Math.round((Math.atan2(x, z) * 180) / Math.PI);
  $('above').value = Math.round((Math.atan2(y, Math.hypot(x, z)) * 180) / Math.PI);
  showValues();
}

// The numbers of the sliders, beside their names.
function showValues() {
  for (const key of ['around', 'above', 'yaw', 'pitch']) $(`${key}-value`).textContent = `${$(key).value.replace('-', '−')}°`;
  $('zoom-value').textContent = `${state.zoom} %`;
  $('edges-value').textContent = state.edges ? `more than ${state.edges}°` : state.style === 'wireframe' ? 'any angle' : 'any angle but 0°';
  $('ambient-value').textContent = `${Math.round((state.ambient * 100) / 256)} %`;
}

function options(select, items) {
  select.replaceChildren(...items.map(([value, text]) => element('option', { value }, text)));
}

function buildControls() {
  options($('mesh'), menu.meshes.map((name) => [name, name]));
  options($('panel-type'), [...menu.displays.map(({ name }, i) => [i, name]), ['own', 'another size']]);
  options($('format'), menu.formats.map((name) => [name, name]));
  options($('style'), menu.styles.map((name) => [name, { 'hidden-line': 'hidden line', flat: 'flat faces', gouraud: 'Gouraud' }[name] ?? name]));
  options($('projection'), menu.projections.map(({ name }) => [name, name]));
  options($('texture'), menu.textures.filter((name) => name !== 'file').map((name) => [name, name]));
  options($('chip'), menu.chips.map(({ key, name }) => [key, name]));
  options($('board'), [...new Set([...templates.keys()].map((path) => path.split('/')[0]))].map((name) => [name, name]));
  options($('up'), [['auto', 'as usual for the file'], ...menu.axes.map((name) => [name, name])]);

  // Another mesh has another number of faces.
  $('mesh').addEventListener('input', (e) => set({ mesh: e.target.value, decimate: 0 }));
  for (const key of ['style', 'texture', 'up', 'format', 'chip']) $(key).addEventListener('input', (e) => set({ [key]: e.target.value }));
  for (const key of ['yaw', 'pitch', 'zoom', 'ambient', 'edges']) $(key).addEventListener('input', (e) => set({ [key]: Number(e.target.value) }));
  for (const key of ['width', 'height', 'rows']) {
    $(key).addEventListener('change', (e) => set({ [key]: Math.min(Math.max(Math.round(Number(e.target.value)) || 1, 1), 1024) }));
  }
  $('spi').addEventListener('change', (e) => set({ spi: within(Math.round(Number(e.target.value)) || 0, 0, 200) }));
  for (const key of ['dither', 'flip', 'fix-winding', 'two-sided']) {
    $(key).addEventListener('input', (e) => set({ [key]: e.target.checked ? 1 : 0 }));
  }
  for (const key of ['color', 'background']) $(key).addEventListener('input', (e) => set({ [key]: e.target.value.slice(1) }));
  const decimated = () => ($('decimate').value === $('decimate').max ? 0 : Number($('decimate').value));
  // Decimates while the slider is dragged, if the mesh is made fast enough; otherwise when it is released.
  $('decimate').addEventListener('input', () => {
    if (slowest < 250) set({ decimate: decimated() });
    else showDecimation(decimated());
  });
  $('decimate').addEventListener('change', () => set({ decimate: decimated() }));
  for (const key of ['around', 'above']) {
    $(key).addEventListener('input', () => {
      const [around, above] = [$('around').value, $('above').value].map((degrees) => (degrees * Math.PI) / 180);
      const direction = [Math.sin(around) * Math.cos(above), Math.sin(above), Math.cos(around) * Math.cos(above)];
      change({ light: direction.map((c) => Math.round(60 * c) + 0).join(',') });
      showValues();
    });
  }
  $('projection').addEventListener('input', (e) => {
    const { name, yaw, pitch } = menu.projections.find(({ name }) => name === e.target.value);
    set({ projection: name, yaw, pitch });
  });
  $('panel-type').addEventListener('input', (e) => {
    const display = menu.displays[e.target.value];
    if (display) {
      const isPaper = display.name.startsWith('e-paper');
      const wasPaper = state.background === 'ffffff';
      const { width, height, format } = display;
      const spi = CLOCKS[display.name.split(',')[0]] ?? 0;
      set({ width, height, format, spi, ...(isPaper === wasPaper ? {} : { background: isPaper ? 'ffffff' : '000000' }) });
    } else {
      showControls();
    }
  });
  for (const id of ['file', 'picture-file']) $(id).addEventListener('change', (e) => openAll(e.target.files));
  $('board').addEventListener('input', (e) => {
    const { chip } = partsOf(e.target.value);
    if (chip) set({ chip });
    showOtherDisplay();
    showBuffers();
  });
  $('panel').addEventListener('submit', (e) => e.preventDefault());
  $('reset').addEventListener('click', reset);
  $('nearer').addEventListener('click', () => zoom(1.25));
  $('farther').addEventListener('click', () => zoom(0.8));
  $('turntable').addEventListener('click', turntable);
  $('png').addEventListener('click', savePng);
  $('gif').addEventListener('click', saveGif);
  $('cancel').addEventListener('click', () => (filming = false));
  $('link').addEventListener('click', copyLink);
  $('zip').addEventListener('click', saved(saveZip));
  $('picture').addEventListener('click', saved(() => saveSource('picture.rs')));
  $('texels').addEventListener('click', saved(() => saveSource('texture.rs')));
  $('rust').addEventListener('click', saved(saveRust));
}

// Files

async function open(file) {
  filming = false;
  say(`Reading ${file.name} …`);
  try {
    if (/\.(png|bmp|jpe?g|gif|webp)$/i.test(file.name)) {
      await openPicture(file);
      return;
    }
    const bytes = new Uint8Array(await file.arrayBuffer());
    await new Promise((done) => setTimeout(done)); // so that the line above is seen
    library.load(file.name, bytes);
    if (isLibrary(file)) {
      materials.set(file.name, bytes);
      drawnModel = '';
      change({});
      return;
    }
    fileName = file.name;
    if (!$('mesh').querySelector('[value=file]')) $('mesh').append(element('option', { value: 'file' }));
    $('mesh').querySelector('[value=file]').textContent = file.name;
    set({ mesh: 'file', up: 'auto', flip: 0, 'fix-winding': 0, 'two-sided': 0, decimate: 0 });
  } catch (problem) {
    say(`${file.name}: ${problem.message}`, true);
  }
}

// A picture for textures, read by the browser, with the sides that a texture has.
async function openPicture(file) {
  let picture;
  try {
    picture = await createImageBitmap(file);
  } catch {
    throw new Error('is no picture that this browser reads: save it as PNG');
  }
  const [width, height] = [picture.width, picture.height].map((side) => within(2 ** Math.round(Math.log2(side)), 8, 256));
  const canvas = element('canvas', { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.fillStyle = '#fff'; // behind transparent parts
  context.fillRect(0, 0, width, height);
  context.drawImage(picture, 0, 0, width, height);
  library.picture(width, new Uint8Array(context.getImageData(0, 0, width, height).data.buffer));
  if (!$('texture').querySelector('[value=file]')) $('texture').append(element('option', { value: 'file' }));
  $('texture').querySelector('[value=file]').textContent = file.name;
  set({ style: 'textured', texture: 'file' });
}

// A model, its material libraries and a picture may be dropped together: the libraries first, so that the model is drawn in their colours.
async function openAll(files) {
  for (const file of [...files].sort((a, b) => isLibrary(b) - isLibrary(a))) await open(file);
}

const isLibrary = ({ name }) => /\.mtl$/i.test(name);

function listenForDrops() {
  const isFile = (e) => e.dataTransfer?.types.includes('Files');
  addEventListener('dragover', (e) => {
    if (!isFile(e)) return;
    e.preventDefault();
    $('frame').classList.add('drop');
  });
  addEventListener('dragleave', () => $('frame').classList.remove('drop'));
  addEventListener('drop', (e) => {
    $('frame').classList.remove('drop');
    if (!isFile(e)) return;
    e.preventDefault();
    openAll(e.dataTransfer.files);
  });
}

// The view

const within = (value, least, most) => Math.min(Math.max(value, least), most);
const hundredths = (value) => Math.round(value * 100) / 100;

function orbit(right, up) {
  const yaw = ((((state.yaw + right + 180) % 360) + 360) % 360) - 180;
  const { steepest } = menu.projections.find(({ name }) => name === state.projection);
  set({ yaw: hundredths(yaw), pitch: hundredths(within(state.pitch + up, -steepest, steepest)) });
}

// Moves the picture by pixels of the screen.
function move(right, down) {
  const canvas = $('display');
  const half = Math.min(canvas.clientWidth, canvas.clientHeight) / 2;
  const by = (pixels) => (1000 * pixels) / half;
  set({ x: within(Math.round(state.x + by(right)), -4000, 4000), y: within(Math.round(state.y - by(down)), -4000, 4000) });
}

function zoom(times) {
  set({ zoom: within(Math.round(state.zoom * times), 20, 2000) });
}

function reset() {
  const { yaw, pitch } = menu.projections.find(({ name }) => name === state.projection);
  set({ yaw, pitch, zoom: 100, x: 0, y: 0, turn: 0 });
}

let turning = false;

function turntable() {
  turning = !turning;
  $('turntable').setAttribute('aria-pressed', turning);
  let last;
  // Steps follow the time that has passed, so a slow tab turns as fast, in larger steps: a turn takes 4 seconds.
  let at = state.turn;
  const step = (time) => {
    if (!turning) return;
    at += last === undefined ? 0 : within(time - last, 0, 1000) * (TURNS / 4000);
    last = time;
    const turn = Math.floor(at) % TURNS;
    if (turn !== state.turn) change({ turn });
    requestAnimationFrame(step);
  };
  if (turning) requestAnimationFrame(step);
  else writeAddress();
}

function listenToPointers() {
  const canvas = $('display');
  const pointers = new Map();
  canvas.addEventListener('pointerdown', (e) => {
    canvas.setPointerCapture(e.pointerId);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  canvas.addEventListener('pointermove', (e) => {
    const before = pointers.get(e.pointerId);
    if (!before) return;
    const now = [e.clientX, e.clientY];
    const [right, down] = [now[0] - before[0], now[1] - before[1]];
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const apart = ([x, y]) => Math.max(Math.hypot(x - other[0], y - other[1]), 1);
      zoom(apart(now) / apart(before));
      move(right / 2, down / 2);
    } else if (e.shiftKey || e.buttons === 2) {
      move(right, down);
    } else {
      orbit(-right / 2, down / 2);
    }
    pointers.set(e.pointerId, now);
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
  canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    zoom(Math.exp(-e.deltaY / 500));
  }, { passive: false });
}

function listenToKeys() {
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  $('display').addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const arrow = ARROWS[e.key];
    if (arrow && e.shiftKey) move(10 * arrow[0], -10 * arrow[1]);
    else if (arrow) orbit(5 * arrow[0], 5 * arrow[1]);
    else if (e.key === '+' || e.key === '=') zoom(1.1);
    else if (e.key === '-') zoom(1 / 1.1);
    else if (e.key === ' ') turntable();
    else if (e.key === '0') reset();
    else return;
    e.preventDefault();
  });
}

// Downloads

function save(name, blob) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const modelName = () => (state.mesh === 'file' ? fileName.replace(/\.[^.]*$/, '') : state.mesh);

function savePng() {
  $('display').toBlob((blob) => save(`${modelName()}.png`, blob));
}

// The frames are made one by one. Between two of them the page handles events: the cancel button, another file or another picture
// ends the film.
let filming = false;

async function saveGif() {
  const name = `${modelName()}.gif`;
  filming = true;
  $('gif').disabled = true;
  $('filming').hidden = false;
  $('filmed').value = 0;
  $('cancel').focus();
  try {
    const bytes = await library.gif(choice(), async (done, all) => {
      [$('filmed').max, $('filmed').value] = [all, done];
      await new Promise((listened) => setTimeout(listened));
      return filming;
    });
    if (bytes) save(name, new Blob([bytes], { type: 'image/gif' }));
    else say('The film was cancelled.');
  } catch (problem) {
    say(problem.message, true);
  }
  const hadFocus = $('filming').contains(document.activeElement);
  $('filming').hidden = true;
  $('gif').disabled = filming = false;
  if (hadFocus) $('gif').focus();
}

// Runs an action that saves a file, and shows a message if it fails.
function saved(action) {
  return () => {
    try {
      action();
    } catch (problem) {
      say(problem.message, true);
    }
  };
}

// The choice without a turn, because the firmware turns the model itself.
const still = () => choice({ ...state, turn: 0 });

function saveZip() {
  const board = $('board').value;
  save(`${board}.zip`, new Blob([zip(firmware(library, templates, board, still(), state.mesh === 'file' ? materials : undefined))], { type: 'application/zip' }));
}

// Saves one file of the firmware's own code.
function saveSource(name) {
  const files = firmware(library, templates, $('board').value, still());
  save(name, new Blob([files.get(`firmware/src/${name}`)]));
}

function saveRust() {
  save(`${modelName()}.rs`, new Blob([library.ask('rust', choice())]));
}

async function copyLink() {
  writeAddress();
  const isFile = state.mesh === 'file' || state.texture === 'file' ? ' Your files are not part of it.' : '';
  try {
    await navigator.clipboard.writeText(location.href);
    say(`The link is in the clipboard.${isFile}`);
  } catch {
    say(`The link is in the address bar.${isFile}`);
  }
}

async function start() {
  try {
    library = await Pinhole.from(await unpacked(PINHOLE));
    templates = untar(await unpacked(BOARDS));
  } catch (problem) {
    say(`This browser cannot run the page: ${problem.message}. It needs WebAssembly and DecompressionStream, which browsers have since 2023.`, true);
    return;
  }
  menu = library.menu();
  buildControls();
  listenForDrops();
  listenToPointers();
  listenToKeys();
  set(readAddress());
  addEventListener('resize', scale);
  addEventListener('hashchange', () => set(readAddress()));
}

start();
