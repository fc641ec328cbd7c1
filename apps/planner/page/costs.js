// What a frame costs, as a table of the ways to draw it.
'use strict';

let costTimer;
let costsShown;

// Waits until changes pause: counting the work of a frame takes as long as drawing it.
function showCosts(library, choice) {
  clearTimeout(costTimer);
  costTimer = setTimeout(() => {
    try {
      const costs = JSON.parse(library.ask('costs', choice));
      $('cost').replaceChildren(...advice(costs), costTable(costs), notes(costs));
      $('costs').hidden = false;
      costsShown = costs;
      showBuffers();
    } catch {
      hideCosts(); // the message stands below the display
    }
  }, 120);
}

function hideCosts() {
  clearTimeout(costTimer);
  $('costs').hidden = true;
  costsShown = undefined;
  showBuffers();
}

const kilobytes = (bytes) => `${(bytes / 1024).toFixed(1)} KB`;

// A time; for a chip whose cycles are not all known, the likely time and its range; and the error of the instructions.
function drawing({ drawing, range, error }) {
  const span = range.length ? ` (${range.map((time) => time.toFixed(2)).join('–')})` : '';
  return `${drawing.toFixed(2)}\u00a0ms${span} ±\u00a0${Math.round(error)}\u00a0%`;
}

function costTable(costs) {
  const head = ['Way to draw', 'RAM', 'Flash', 'Frames/s', 'by DMA', 'Drawing', 'Sending', 'Limit', 'Instructions', 'Cycles'];
  const table = element('table', {}, element('thead', {}, element('tr', {}, ...head.map((text) => element('th', { scope: 'col' }, text)))));
  const body = element('tbody', {});
  for (const way of costs.ways) {
    const [cache, bins, pixels, depths] = way.parts;
    const name = element('th', { scope: 'row' }, way.name, ...(way.note ? [element('div', { className: 'note' }, way.note)] : []));
    const ram = element('td', { className: way.fits ? '' : 'bad' }, kilobytes(way.ram), ...(way.fits ? [] : [element('div', {}, 'does not fit')]));
    ram.title = `vertices ${count(cache)}, bins or sorted faces ${count(bins)}, pixels ${count(pixels)}, depths ${count(depths)} bytes`;
    const cells = [ram, kilobytes(way.flash), way.blocking.toFixed(1), way.dma.toFixed(1), drawing(way), `${way.bus.toFixed(2)}\u00a0ms`, way.limit, count(way.instructions),
      count(way.cycles)];
    const row = element('tr', { className: way.chosen ? 'chosen' : '' }, name);
    row.append(...cells.map((cell) => (cell instanceof Node ? cell : element('td', {}, cell))));
    body.append(row);
  }
  table.append(body);
  return element('div', { className: 'table', tabIndex: 0, role: 'region', ariaLabel: 'Costs of the ways to draw' }, table);
}

const chosenOf = (costs) => costs.ways.find((way) => way.chosen) ?? costs.ways[0];

// The buffers of the board's firmware, whose display may have other sides than the page shows.
function showBuffers() {
  const [board, way] = [$('board').value, costsShown && chosenOf(costsShown)];
  const isShown = way?.rows && !$('zip').disabled && $('other-display').hidden;
  const { strips } = partsOf(board);
  const more = strips > 1 ? `, with the pixels of ${strips} bands, as one is drawn while another is sent` : '';
  $('buffers').textContent = isShown ? `Its buffers take ${kilobytes(buffersOf(board, way))} of RAM in bands of ${way.rows} rows${more}.` : '';
}

// What to change if the chosen way to draw does not fit.
function advice(costs) {
  const chosen = chosenOf(costs);
  if (chosen.fits) return [];
  const smaller = costs.ways.filter((way) => way.fits && way.rows).sort((a, b) => a.ram - b.ram)[0];
  if (smaller) {
    const text = `${chosen.name}: ${kilobytes(chosen.ram)} of RAM, but the ${costs.chip} has ${kilobytes(costs.ram)}. Use ${smaller.name}: ${kilobytes(smaller.ram)}. `;
    const page = smaller.rows === state.rows ? [] : [remedyButton(`Use bands of ${smaller.rows} rows`, { rows: smaller.rows })];
    return [element('p', { className: 'advice' }, text, ...page)];
  }
  const [cache, bins] = chosen.parts;
  const mesh = cache + bins;
  const text = `No way to draw fits the ${kilobytes(costs.ram)} of the ${costs.chip}. Vertices and bins take ${kilobytes(mesh)}: use fewer faces (pinhole-import --decimate N), or a chip with more RAM. `;
  return [element('p', { className: 'advice' }, text, ...remedyButtons(text))];
}

function notes(costs) {
  const { stack } = chosenOf(costs);
  const inexact = costs.exact || ofLines() ? '' : ' Faces in fewer bits a pixel take 1.4 times the instructions of 16-bit colour, dithered or shaded 1.6 times: compared with some linked firmware only.';
  const lines = [
    `${costs.chip}: ${costs.core} at ${costs.clock} MHz, SPI at ${costs.spi} MHz.`,
    `RAM: the variables of the way to draw, to the byte. The stack takes ${kilobytes(stack)} more.`,
    `Flash: the mesh and the code that draws, at opt-level 3, ± ${costs.flashError} %. Drivers and logs come on top.`,
    `Frames/s: each band is drawn, then sent; by DMA: one is drawn while another is sent.`,
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
