// The state of the page: what the user chose, and what was loaded.
'use strict';

const $ = (id) => document.getElementById(id);
const TURNS = 120; // steps of a turn, as in the library
const DEFAULTS = {
  mesh: 'gear', width: 240, height: 240, format: 'rgb565', style: 'flat', dither: 0, 'smooth-edges': 0, order: 'depth', whole: 0, projection: 'perspective', yaw: 30, pitch: 20,
  zoom: 100, x: 0, y: 0, turn: 0, color: 'ffd700', background: '000000', light: '2,3,4', ambient: 48, up: 'auto', flip: 0,
  'fix-winding': 0, 'two-sided': 0, decimate: 0, edges: 0, texture: 'checker', rows: 8, chip: 'rp2040', spi: 0, board: 'rp2040-st7789',
  controller: 'ST7789', core: 'M4', mhz: 100, ram: 128, flash: 512,
};
const NUMBERS = Object.keys(DEFAULTS).filter((key) => typeof DEFAULTS[key] === 'number');

let menu;
let templates;
let fileName; // of the model that was opened
let pictureName; // of the picture that was opened
let state = { ...DEFAULTS };
let drawnModel = '';
let allFaces = 0; // of the model, without decimation; 0 if they are not known
let isTooLarge = false; // whether the model cannot be drawn with as many faces as now
let slowest = 0; // milliseconds of the last frame that a new mesh was made for
let imported = 0; // milliseconds in which the file that was opened last was drawn first
let asked = false; // whether a frame will be drawn
let held = 0; // what holds frames back: one that is being drawn, a file that is being read
let shown; // the state that was drawn last
let changing = { all: () => 1, rectangle: () => 1, columns: () => 1 }; // the parts of the picture that change while the model turns

// Whether the style draws edges instead of faces.
const ofLines = () => ['wireframe', 'hidden-line'].includes(state.style);

// Whether edges of faces are smoothed, as far as style and display permit.
const canSmooth = () => !ofLines() && menu.mixing.includes(state.format);
const smooths = () => canSmooth() && state['smooth-edges'] === 1;

// Whether the picture is drawn in one piece: one colour a face, or lines, in 16-bit colour.
const isWhole = () => state.whole === 1 && state.format === 'rgb565' && (state.style === 'wireframe' || (state.style === 'flat' && !state.dither && !smooths()));

// The name of the chosen mesh in the menu.
const meshName = () => (state.mesh === 'file' ? fileName : state.mesh);

// The choice that is passed to the library: every part of the state but the board and the controller, which change neither the picture
// nor its costs, and the bits of a pixel on the bus.
const choice = ({ board, controller, ...of } = state) =>
  Object.entries({ ...of, wire: factsOf(panelOf({ controller, ...of })).wire ?? 0 }).map(([key, value]) => `${key}=${value}`).join('&');

// The display of the menu that has these pixels: that of the chosen controller, if several have.
function panelOf({ width, height, format, controller }) {
  const all = menu.displays.filter((d) => d.width === width && d.height === height && d.format === format);
  return all.find(({ name }) => name.startsWith(controller)) ?? all[0];
}
const panelChosen = () => (isOwnSize ? undefined : panelOf(state));

// Facts about controllers. MHz that SPI takes by the data sheet; an ILI9341, whose data sheet has 10, is usually run at 25 to 40; an ST7789
// takes 62.5, more than most chips have. The diagonal in inches, by height if there are several, and for a round panel that of the square
// around it. Bits of a pixel on the bus, if they are not those in memory. Frames per second that the panel can show. What a driver must do.
const FACTS = {
  ST7789: { inches: { 240: 1.3, 320: 2 } },
  ILI9341: { spi: 25, inches: 2.4 },
  ILI9488: { spi: 20, inches: 3.5, wire: 24, note: 'By SPI it takes three bytes a pixel: the driver widens 16-bit colours as it sends them.' },
  GC9A01: { inches: 1.81, isRound: true, note: 'The corners are sent, but not seen.' },
  CO5300: { spi: 50, inches: 2.02, isRound: true, note: 'Windows have even columns and rows, so a band has an even number of rows. The figures are of one data line; by QSPI sending takes a quarter.' },
  ST7735: { spi: 15, inches: 1.44 },
  SSD1306: { spi: 10, inches: 0.96 },
  SH1106: { spi: 4, inches: 1.3, note: 'Its memory has 132 columns, of which the glass shows 128 from the third, and is written page by page.' },
  SSD1327: { spi: 10, inches: 1.5 },
  'e-paper': { spi: 10, most: 1, inches: { 200: 1.54, 128: 2.9, 300: 4.2, 104: 2.13 }, note: 'The panel takes about a second to change, with a third colour up to half a minute.' },
};
const controllerOf = (panel) => panel?.name.split(',')[0];
const factsOf = (panel) => FACTS[controllerOf(panel)] ?? {};
const clockOf = (panel) => factsOf(panel).spi ?? 0;

// Frames per second of a way to draw on a panel that may be slower; and what limits them.
const framesOf = (way, panel) => Math.min(way.frames ?? way.blocking, factsOf(panel).most ?? Infinity);
const limitOf = (way, panel) => ((way.frames ?? way.blocking) > (factsOf(panel).most ?? Infinity) ? 'the panel' : way.limit === 'bus' ? 'sending' : 'drawing');

// Draws once before the next frame of the screen, however many changes there were.
function change(changes) {
  Object.assign(state, changes);
  if (!asked) {
    asked = true;
    requestAnimationFrame(show);
  }
}

// Changes the state and the controls.
function set(changes) {
  stopAwaiting(changes);
  change(changes);
  showControls();
}

const count = (number) => number.toLocaleString('en').replaceAll(',', '\u202f');

// A message of the library, with its numbers written as the page's own.
// It may begin with the name of the file, which stays as it is.
function grouped(message) {
  const name = message.startsWith(`${fileName}: `) ? `${fileName}: ` : '';
  return name + message.slice(name.length).replace(/(?<![\w.])\d{4,}(?![\w]|\.\d)/g, (digits) => count(Number(digits)));
}

const counted = (number, one, many = `${one}s`) => `${count(number)} ${number === 1 ? one : many}`;

function say(text, isBad = false) {
  // Written only where it differs, so that a screen reader does not repeat it.
  if ($('status').textContent !== text) $('status').textContent = text;
  $('status').classList.toggle('bad', isBad);
}

// What the user should know beside the picture, until something else takes its place.
function notice(text) {
  $('notice').textContent = text.trim();
}

function element(name, properties, ...content) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...content);
  return made;
}
