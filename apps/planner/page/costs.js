// What a frame costs: a sentence below the display, and a table of the ways to draw it.
'use strict';

let costTimer;
let costsShown;

// Waits until changes pause: counting the work of a frame takes as long as drawing it.
function showCosts(library, choice) {
  clearTimeout(costTimer);
  costTimer = setTimeout(() => {
    try {
      const costs = JSON.parse(library.ask('costs', choice));
      costsShown = costs;
      $('verdict').replaceChildren(...verdict(costs), ...advice(costs));
      $('cost').replaceChildren(costTable(costs), notes(costs));
      $('costs').hidden = false;
      showFirmware();
    } catch {
      hideCosts(); // the message stands below the display
    }
  }, 120);
}

function hideCosts() {
  clearTimeout(costTimer);
  $('costs').hidden = true;
  $('verdict').replaceChildren();
  costsShown = undefined;
  showFirmware();
}

const kilobytes = (bytes, digits = 1) => `${(bytes / 1024).toFixed(digits).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f')} KB`;
const millions = (number) => (number < 1e5 ? `${Math.round(number / 1e3)}\u00a0k` : `${(number / 1e6).toFixed(2)}\u00a0M`);

const chosenOf = (costs) => costs.ways.find((way) => way.chosen) ?? costs.ways[0];

// The least and the most frames per second, if the instructions and the cycles of one are off as far as they can be, in one direction.
function frameRates(costs, { drawing, bus, error, range }) {
  const off = (1 + error / 100) * (1 + (range.length ? 0 : costs.cyclesError) / 100);
  const [least, most] = range.length ? range : [drawing, drawing];
  return [most * off, least / off].map((time) => 1000 / (time + Number(bus)));
}

const rate = (frames) => (frames < 9.95 ? frames.toFixed(1) : frames.toFixed(0));

// Whether the chosen way fits the chip, and how fast it is.
function verdict(costs) {
  const way = chosenOf(costs);
  const fits = way.fits && way.fitsFlash;
  const [slow, fast] = frameRates(costs, way);
  const uses = `${kilobytes(way.ram + way.beside)} of RAM (it has ${kilobytes(costs.ram, 0)}), ${kilobytes(way.flash)} of flash (${kilobytes(costs.rom, 0)})`;
  const text = `${fits ? 'Fits' : 'Does not fit'} the ${costs.chip}: ${uses}. ${rate(way.blocking)} frames/s (${rate(slow)} to ${rate(fast)}), limited by the ${way.limit}.`;
  return [element('p', { className: fits ? 'verdict' : 'verdict bad' }, text)];
}

// What to change if the chosen way to draw does not fit.
function advice(costs) {
  const way = chosenOf(costs);
  if (way.fits && way.fitsFlash) return [];
  const { rows, faces, both } = advised(costs, way, state.decimate || allFaces);
  const bands = (rows) => `bands of ${rows} ${rows === 1 ? 'row' : 'rows'}`;
  const made = [];
  if (rows) made.push(remedyButton(`Use ${bands(rows)}`, { rows }));
  if (faces && menu.decimates) made.push(remedyButton(`Decimate to ${count(faces)} faces`, { decimate: faces }));
  if (both && menu.decimates) made.push(remedyButton(`Use ${bands(both.rows)} and ${count(both.faces)} faces`, { rows: both.rows, decimate: both.faces }));
  const others = costs.ways.filter((other) => other.fits && other.fitsFlash && other.note);
  const other = others.length ? ` ${others[0].name}, for ${others[0].note}, fits: write it yourself by the library's documentation.` : '';
  const none = made.length || other ? '' : ' Choose a chip with more memory.';
  const needs = `${way.name}: ${kilobytes(way.ram)} of variables and ${kilobytes(way.beside)} of stack${costs.inRam ? ' and code' : ''}, and ${kilobytes(way.flash)} of flash.`;
  return [element('div', { className: 'advice' }, `${capital(needs)}${capital(other, 1)}${none} `, ...made)];
}

// With a capital letter at a place.
const capital = (text, at = 0) => text.slice(0, at) + text.slice(at, at + 1).toUpperCase() + text.slice(at + 1);

const HEAD = ['Way to draw', 'RAM', 'Flash', 'Frames/s', 'by DMA', 'Drawing', 'Sending', 'Limit', 'Instructions', 'Cycles'];

function costTable(costs) {
  const heads = HEAD.map((text) => element('th', { scope: 'col' }, text));
  const body = element('tbody', {}, ...costs.ways.map((way) => costRow(costs, way)));
  const table = element('table', {}, element('thead', {}, element('tr', {}, ...heads)), body);
  return element('div', { className: 'table', tabIndex: 0, role: 'region', ariaLabel: 'Costs of the ways to draw' }, table);
}

function costRow(costs, way) {
  const dma = way.fitsTwice ? way.dma.toFixed(1) : 'no room';
  const contents = [
    memory(way), element('span', {}, kilobytes(way.flash), ...(way.fitsFlash ? [] : [misfit()])), way.blocking.toFixed(1), dma, drawing(way),
    `${way.bus.toFixed(2)}\u00a0ms`, way.limit, millions(way.instructions), millions(way.cycles),
  ];
  const bad = [!way.fits, !way.fitsFlash];
  const cells = contents.map((content, at) => {
    const cell = element('td', { className: bad[at] ? 'bad' : '' }, content);
    cell.dataset.head = HEAD[at + 1]; // shown on narrow screens, where a row is a card
    return cell;
  });
  return element('tr', { className: way.chosen ? 'chosen' : '' }, wayName(way), ...cells);
}

const misfit = () => element('div', {}, 'does not fit');

// The name of a way to draw; a button if it differs from the chosen one by its rows, which it then sets.
function wayName(way) {
  const isOther = way.rows && !way.chosen && !way.note;
  const name = isOther ? element('button', { type: 'button', className: 'way', title: `Use bands of ${way.rows} rows` }, way.name) : way.name;
  if (isOther) name.addEventListener('click', () => set({ rows: way.rows }));
  return element('th', { scope: 'row' }, name, ...(way.note ? [element('div', { className: 'note' }, way.note)] : []));
}

// The bytes of variables, and what they are.
function memory(way) {
  const names = ['vertices', 'bins or sorted faces', 'pixels', 'depths'];
  const parts = way.parts.map((bytes, at) => [bytes, names[at]]).filter(([bytes]) => bytes > 0);
  const summary = element('summary', {}, kilobytes(way.ram), ...(way.fits ? [] : [misfit()]));
  return element('details', {}, summary, ...parts.map(([bytes, name]) => element('div', { className: 'note' }, `${name} ${kilobytes(bytes)}`)));
}

// A time; for a chip whose cycles are not all known, the likely time and its range; and the error of the instructions.
function drawing({ drawing, range, error }) {
  const span = range.length ? ` (${range.map((time) => time.toFixed(1)).join('–')})` : '';
  return `${drawing.toFixed(1)}\u00a0ms${span} ±\u00a0${Math.round(error)}\u00a0%`;
}

function notes(costs) {
  const { stack } = chosenOf(costs);
  const inexact = costs.exact || ofLines() ? '' : ' Faces in fewer bits a pixel take 1.3 to 1.6 times the instructions of 16-bit colour: compared with some linked firmware only.';
  const lines = [
    `${costs.chip}: ${costs.core} at ${costs.clock} MHz, SPI at ${costs.spi} MHz.`,
    `Bands: the frame is drawn in strips of some rows, each of which is sent before the next is drawn, so no picture of the whole display is in memory. With depth: the nearest face shows, at each pixel. Painter's order: faces are drawn from the farthest to the nearest, without a depth for each pixel. Bins: which faces each band has.`,
    `RAM: the variables of the way to draw, to the byte. The stack takes ${kilobytes(stack)} more${costs.inRam ? ', and the code, which is copied to RAM, as much as it takes in flash' : ''}. The driver and the log of a firmware take about 1 KB more.`,
    `Flash: the mesh and the code that draws, at opt-level 3, ± ${costs.flashError} %. Drivers and logs come on top.`,
    `Frames/s: each band is drawn, then sent; by DMA: one is drawn while another is sent, so there are two of them in RAM, if there is room.`,
    ...displayNotes(costs),
    `Drawing: ± is the largest error of the instructions in any case measured (docs/growth.md).${inexact} The cycles of an instruction differ by up to ${costs.cyclesError} % from model to model. Error of the chip's timing: ${costs.error}.`,
  ];
  return element('ul', { className: 'note' }, ...lines.map((line) => element('li', {}, line)));
}

// What the bus is, or what takes longer than drawing and sending.
function displayNotes(costs) {
  const { name } = panelOf(state) ?? { name: '' };
  const notes = [];
  if (name.startsWith('SSD1306')) {
    // Nine bits a byte, at 400 kHz.
    notes.push(`By I²C at 400 kHz, as on stm32-ssd1306, sending takes ${Math.round((9 * costs.ways[0].bytes) / 400)} ms.`);
  }
  if (name.startsWith('e-paper')) notes.push('E-paper itself takes about a second to change, with a third colour up to half a minute: Frames/s is of drawing and sending alone.');
  return notes;
}
