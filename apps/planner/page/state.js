// The state of the page: what the user chose, and what was loaded.
'use strict';

const $ = (id) => document.getElementById(id);
const TURNS = 120; // steps of a turn, as in the library
const DEFAULTS = {
  mesh: 'gear', width: 240, height: 240, format: 'rgb565', style: 'flat', dither: 0, projection: 'perspective', yaw: 30, pitch: 20,
  zoom: 100, x: 0, y: 0, turn: 0, color: 'ffd700', background: '000000', light: '2,3,4', ambient: 48, up: 'auto', flip: 0,
  'fix-winding': 0, 'two-sided': 0, decimate: 0, edges: 0, texture: 'checker', rows: 8, chip: 'rp2040', spi: 0, board: 'rp2040-st7789',
};
const NUMBERS = Object.keys(DEFAULTS).filter((key) => typeof DEFAULTS[key] === 'number');

let library;
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
let asked = false;

// Whether the style draws edges instead of faces.
const ofLines = () => ['wireframe', 'hidden-line'].includes(state.style);

// The name of the chosen mesh in the menu.
const meshName = () => (state.mesh === 'file' ? fileName : state.mesh);

// The choice that is passed to the library: every part of the state but the board, which changes neither the picture nor its costs.
const choice = ({ board, ...of } = state) => Object.entries(of).map(([key, value]) => `${key}=${value}`).join('&');

// The display of the menu that has these pixels.
const panelOf = ({ width, height, format }) => menu.displays.find((d) => d.width === width && d.height === height && d.format === format);

// MHz that a controller's SPI takes by its data sheet; an ILI9341, whose data sheet has 10, is usually run at 25 to 40. An ST7789 takes
// 62.5, more than most chips have.
const CLOCKS = { ILI9341: 25, ST7735: 15, SSD1306: 10, SSD1327: 10, 'e-paper': 10 };
const clockOf = (panel) => CLOCKS[panel?.name.split(',')[0]] ?? 0;

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
