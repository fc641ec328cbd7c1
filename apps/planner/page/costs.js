// What a frame costs: a sentence below the display, and a table of the ways to draw it.
'use strict';

let costTimer;
const firmwares = new Map(); // the facts of each board's firmware, promised; of a board for any chip, for each

function firmwareFor(board, chip) {
  const of = chip === 'own' ? `own&core=${state.core}` : chip;
  const key = partsOf(board).chip ? board : `${board} ${of}`;
  if (!firmwares.has(key)) firmwares.set(key, firmwareOf(library, templates, board, of));
  return firmwares.get(key);
}
let costsShown;

// Waits until changes pause: counting the work of a frame takes as long as drawing it.
function showCosts(choice) {
  clearTimeout(costTimer);
  const timer = (costTimer = setTimeout(async () => {
    try {
      const costs = await asBuilt(JSON.parse(await library.ask('costs', choice)));
      if (timer !== costTimer) return; // something else was chosen meanwhile
      costsShown = costs;
      $('verdict').replaceChildren(...verdict(costs));
      $('advice').replaceChildren(...advice(costs));
      $('cost').replaceChildren(costTable(costs));
      $('notes').replaceChildren(notes(costs));
      $('costs').hidden = false;
      $('turntable').textContent = `Turn at ${rate(framesOf(chosenOf(costs), panelChosen()))} frames/s`;
      showFirmware();
      showMatrix();
    } catch {
      if (timer === costTimer) hideCosts(); // the message stands below the display
    }
  }, 120));
}

function hideCosts() {
  clearTimeout(costTimer);
  costTimer = undefined;
  $('costs').hidden = true;
  for (const id of ['verdict', 'advice']) $(id).replaceChildren();
  costsShown = undefined;
  showFirmware();
}

const kilobytes = (bytes, digits = 1) => `${(bytes / 1024).toFixed(digits).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f')} KB`;
const millions = (number) => (number < 1e5 ? `${Math.round(number / 1e3)}\u00a0k` : `${(number / 1e6).toFixed(2)}\u00a0M`);

const chosenOf = (costs) => costs.ways.find((way) => way.chosen) ?? costs.ways[0];

// The chosen board, if it has the chosen chip and a display of the chosen kind: then the costs are those of its firmware.
function boardShown(chip = state.chip, panel = panelChosen(), board = state.board) {
  const { chip: own, controller } = partsOf(board);
  return (!own || family(own) === family(chip)) && (!controller || controller === controllerOf(panel)) ? board : undefined;
}

// The costs, with each way to draw as the board's firmware draws it, on a panel that takes so many MHz; on other chips that of the nearest board.
async function asBuilt(costs, panel = panelChosen(), spi = state.spi, parts = changing) {
  const built = async (way, chip, board) => {
    const shown = boardShown(chip, panel, board);
    return shown ? onBoard(way, shown, await firmwareFor(shown, chip), spi, parts) : way;
  };
  const ways = await Promise.all(costs.ways.map((way) => built(way, state.chip, state.board)));
  const chips = await Promise.all(costs.chips.map((way, at) => built(way, menu.chips[at].key, nearestBoard(menu.chips[at].key, panel))));
  return { ...costs, ways, chips };
}

const rate = (frames) => (frames < 9.95 ? frames.toFixed(1) : frames.toFixed(0));

// Whether the chosen way fits the chip, what it lacks if not, and three meters: RAM, flash and speed.
function verdict(costs) {
  const way = chosenOf(costs);
  const [ram, flash] = [way.ram + way.beside, way.flash];
  const lacks = [[way.fits, ram, 'RAM', way.room], [way.fitsFlash, flash, 'flash', way.rom]].filter(([fits]) => !fits);
  const missing = lacks.map(([, uses, of, has]) => `${kilobytes(uses)} of ${of} (it has ${kilobytes(has, 0)})`).join(', ');
  const text = missing ? `Does not fit the ${costs.chip}: ${missing}.` : `Fits the ${costs.chip}.`;
  const [slow, fast] = frameRates(costs, way);
  const panel = panelChosen();
  const [speed, limit] = [framesOf(way, panel), limitOf(way, panel)];
  const of = (name, uses, has, fits) => meter(name, `${kilobytes(uses)} of ${kilobytes(has, 0)}`, fits, uses / has);
  return [
    element('p', { className: missing ? 'verdict bad' : 'verdict' }, text),
    element('div', { className: 'meters' }, of('RAM', ram, way.room, way.fits), of('Flash', flash, way.rom, way.fitsFlash),
      meter('Speed', `${rate(speed)} frames/s (${limit === 'the panel' ? 'at most' : `${rate(slow)} to ${rate(fast)}`}), limited by ${limit}`, true, speed / FASTEST, Math.max(speed, fast) / FASTEST)),
  ];
}

const FASTEST = 60; // frames/s at the end of the meter

// A named bar with its value in words, filled to a part of 1, and more faintly as far as the value may be.
function meter(name, text, isGood, part, most = part) {
  const width = (part) => `width: ${Math.min(100 * part, 100).toFixed(1)}%`;
  const bar = element('div', { className: isGood ? 'meter' : 'meter bad', role: 'meter', ariaLabel: name, ariaValueText: text, ariaValueMin: 0, ariaValueMax: 100,
    ariaValueNow: Math.min(Math.round(100 * part), 100) }, element('i', { className: 'range', style: width(most) }), element('i', { style: width(part) }));
  return element('div', {}, element('b', {}, name), bar, element('div', { className: 'note' }, text));
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
  const other = costs.ways.find((other) => other.fits && other.fitsFlash && other.note);
  if (other) made.push(remedyButton(`${capital(other.name)}, for ${other.note}`, choiceOf(other)));
  if (isWhole()) made.push(remedyButton('Draw in bands', { whole: 0 }));
  if (smooths()) made.push(remedyButton('Draw without smooth edges', { 'smooth-edges': 0 }));
  const chip = menu.chips.find(({ basis }, at) => !basis && costs.chips[at].fits && costs.chips[at].fitsFlash);
  if (chip) made.push(remedyButton(`Use the ${chip.name}`, { chip: chip.key, board: nearestBoard(chip.key, panelChosen()) }));
  const needs = `${way.name}: ${kilobytes(way.ram)} of variables and ${kilobytes(way.beside)} of stack${costs.inRam ? ' and code' : ''}, and ${kilobytes(way.flash)} of flash.`;
  return [element('div', { className: 'advice' }, `${capital(needs)} `, ...made)];
}

const capital = (text) => text.slice(0, 1).toUpperCase() + text.slice(1);

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

// What chooses a way to draw.
const choiceOf = ({ order, rows }) => ({ order, whole: rows ? 0 : 1, ...(rows && { rows }) });

// The name of a way to draw: a button that chooses it, if another one is chosen.
function wayName(way) {
  const name = way.chosen ? way.name : element('button', { type: 'button', className: 'way', title: 'Draw in this way' }, way.name);
  if (!way.chosen) name.addEventListener('click', () => set(choiceOf(way)));
  return element('th', { scope: 'row' }, name, ...(way.note ? [element('div', { className: 'note' }, way.note)] : []));
}

// The bytes of variables, and what they are.
function memory(way) {
  const names = ['vertices', 'bins or sorted faces', 'pixels', 'depths', 'smooth edges: rows and list', 'driver, log and the rest'];
  const parts = way.parts.map((bytes, at) => [bytes, names[at]]).filter(([bytes]) => bytes > 0);
  const summary = element('summary', {}, kilobytes(way.ram), ...(way.fits ? [] : [misfit()]));
  return element('details', {}, summary, ...parts.map(([bytes, name]) => element('div', { className: 'note' }, `${name} ${kilobytes(bytes)}`)));
}

// A time; for a chip whose cycles are not all known, the likely time and its range; and the error of the instructions.
function drawing({ drawing, range, error }) {
  const span = range.length ? ` (${range.map((time) => time.toFixed(1)).join('–')})` : '';
  return `${drawing.toFixed(1)}\u00a0ms${span} ±\u00a0${Math.round(error)}\u00a0%`;
}

// The clocks and the bus of the board that is shown.
function ofBoard({ core }, { clock, rows }) {
  const { bus, cores, hasDma, sends: part, ...of } = factsOfBoard(templates, state.board);
  const sends = `${hasDma ? 'one band is drawn while another is sent' : 'each band is drawn, then sent'}${part === 'all' ? '' : `, and only what changes, here ${Math.round(100 * changing[part](rows))} % of the picture`}`;
  return `as ${state.board} has it, ${cores > 1 ? 'two cores, ' : ''}${core} at ${of.clock || clock} MHz, ${bus ? `its bus at ${bus < 1 ? '0.4' : bus} MHz; ` : ''}${sends}.`;
}

function notes(costs) {
  const way = chosenOf(costs);
  const rest = boardShown() ? "What else the template's firmware has, such as its driver and its log, is included." : 'The driver and the log of a firmware come on top.';
  const inexact = costs.exact || ofLines() ? '' : ' Faces in fewer bits a pixel take 1.3 to 1.6 times the instructions of 16-bit colour: compared with some linked firmware only.';
  const lines = [
    `${costs.chip}: ${boardShown() ? ofBoard(costs, way) : `${costs.core} at ${way.clock} MHz, SPI at ${costs.spi} MHz; each band is drawn, then sent.`}`,
    `Bands: the frame is drawn in strips of some rows, each of which is sent before the next is drawn, so no picture of the whole display is in memory. With depth: the nearest face shows, at each pixel. Painter's order: faces are drawn from the farthest to the nearest, without a depth for each pixel. Bins: which faces each band has.`,
    `RAM: the variables of the way to draw, to the byte. The stack takes ${kilobytes(way.stack)} more${costs.inRam ? ', and the code, which is copied to RAM, as much as it takes in flash' : ''}. ${rest}`,
    `Flash: the mesh and the code that draws, at opt-level 3, ± ${costs.flashError} %. ${rest}`,
    `Frames/s: each band is drawn, then sent; by DMA: one is drawn while another is sent, so there are two of them in RAM, if there is room. In the range of the meter, by DMA, sending is hidden by drawing wholly or not at all.`,
    ...(smooths() ? ['Smooth edges: silhouettes and, where each face has one light, creases. The last two rows of each band wait for the next band, so a band has at least four rows, and 16 edges are kept between bands. The mesh lists its edges, and the faces beside them, in flash.'] : []),
    ...displayNotes(costs),
    `Drawing: ± is the largest error of the instructions in any case measured (docs/growth.md).${inexact} The cycles of an instruction differ by up to ${costs.cyclesError} % from model to model. ${costs.estimate ? 'The chip\'s timing is an estimate' : 'Error of the chip\'s timing'}: ${costs.error}.`,
  ];
  return element('ul', { className: 'note' }, ...lines.map((line) => element('li', {}, line)));
}

// Whether a picture can be free of tearing. The scan starts at the top with the first band, runs ahead of it, and overtakes it if it comes
// again before the last band is written.
function tearing({ frames, blocking, bus }) {
  const [most, written] = [2000 / 60, 1000 / (frames ?? blocking)];
  const sent = `${bus.toFixed(0)} ms`;
  const tears = written < most ? 'it can be free of tearing' : bus < most ? `it tears, unless it is drawn before it is sent, which takes ${sent}` : `it tears, as sending alone takes ${sent}`;
  return `Tearing: a picture that starts at the panel's TE signal must be written within two refreshes, ${most.toFixed(0)} ms at 60 Hz. Here it takes ${written.toFixed(0)} ms: ${tears}.`;
}

// What the bus is, or what takes longer than drawing and sending.
function displayNotes(costs) {
  const { name } = panelOf(state) ?? { name: '' };
  const notes = [];
  if (state.format === 'rgb565') notes.push(tearing(chosenOf(costs)));
  if (name.startsWith('SSD1306')) {
    // Nine bits a byte, at 400 kHz.
    notes.push(`By I²C at 400 kHz, as on stm32-ssd1306, sending takes ${Math.round((9 * costs.ways[0].bytes) / 400)} ms.`);
  }
  if (name.startsWith('e-paper')) notes.push('The table of ways to draw has frames/s of drawing and sending alone, without the time in which e-paper changes.');
  return notes;
}
