// The matrix of chips and displays: what the model costs on each, at the chosen rows of a band. A click on a cell chooses it.
'use strict';

// What a cell can show of a way to draw on a chip, and how chips are sorted by it: by the number, the best first.
const SHOWN = {
  'frames/s': { text: (way, panel) => rate(framesOf(way, panel)), best: (way, panel) => -framesOf(way, panel) },
  'drawing, ms': { text: (way) => way.drawing.toFixed(1), best: (way) => way.drawing },
  'sending, ms': { text: (way) => way.bus.toFixed(1), best: (way) => way.bus },
  'limited by': { text: limitOf, best: (way, panel) => limitOf(way, panel).length },
  RAM: { text: (way) => kilobytes(way.ram + way.beside), best: (way) => way.ram + way.beside },
  flash: { text: (way) => kilobytes(way.flash), best: (way) => way.flash },
};

let matrixTimer;
let matrixOf; // the choice that the matrix was asked for, without its chip and display
let columns = []; // for each display, the costs on each chip; an unfinished matrix has fewer
let sortedBy = -1; // the column that the rows are sorted by

// The displays of the menu, and the user's own.
const allPanels = () => (isOwnSize ? [...menu.displays, { name: 'own', ...state }] : menu.displays);
const withPanel = ({ name, width, height, format }) => ({ width, height, format, ...(name !== 'own' && { controller: name.split(',')[0], spi: clockOf({ name }) }) });

// Asks for the matrix when changes pause and it is open, display by display.
function showMatrix() {
  clearTimeout(matrixTimer);
  if (!$('compare').open || $('costs').hidden) return;
  const { chip, spi, controller, board, width, height, format, ...of } = state;
  const asked = JSON.stringify([of, isOwnSize && [width, height, format, spi]]);
  if (asked === matrixOf) return drawMatrix();
  matrixTimer = setTimeout(async () => {
    matrixOf = asked;
    columns = [];
    const base = { ...state };
    for (const panel of allPanels()) {
      let chips = []; // stays so if the model cannot be drawn there
      try {
        const of = { ...base, ...withPanel(panel) };
        const costs = JSON.parse(await library.ask('costs', choice(of)));
        chips = (await asBuilt(costs, panel, of.spi, changedIn(await library.draw(choice(of)), of))).chips;
      } catch {}
      if (matrixOf !== asked) return;
      columns.push(chips);
    }
    drawMatrix();
  }, 300);
}

function drawMatrix() {
  const panels = allPanels();
  if (columns.length !== panels.length) return; // it is being asked for
  const shown = SHOWN[$('shown').value];
  const rows = menu.chips.map((chip, at) => ({ chip, ways: columns.map((column) => column[at]) }));
  const misses = (way) => !way || !way.fits || !way.fitsFlash;
  if (sortedBy >= panels.length) sortedBy = -1;
  const order = ({ ways: { [sortedBy]: way } }) => (misses(way) ? Infinity : shown.best(way, panels[sortedBy]));
  if (sortedBy >= 0) rows.sort((a, b) => order(a) - order(b) || 0);
  const head = (name, at) => {
    const button = element('button', { type: 'button', className: 'way', title: 'Sort the chips by this column', tabIndex: at < 0 ? 0 : -1 }, name);
    button.addEventListener('click', () => {
      sortedBy = at;
      drawMatrix();
      $('matrix').querySelectorAll('thead button')[at + 1].focus();
    });
    return element('th', { scope: 'col', ariaSort: at === sortedBy ? 'ascending' : 'none' }, button);
  };
  const cell = (chip, way, panel) => {
    if (!way) return element('td', {}, '–');
    const lacks = [!way.fits && 'RAM', !way.fitsFlash && 'flash'].filter(Boolean).join(' or ');
    const about = `${chip.name}, ${panel.name}: ${lacks ? `no ${lacks}` : 'fits'}; ${rate(framesOf(way, panel))} frames/s, drawn in ${way.drawing} ms, sent in ${way.bus} ms, limited by ${limitOf(way, panel)}; ${kilobytes(way.ram + way.beside)} of RAM, ${kilobytes(way.flash)} of flash`;
    const isChosen = chip.key === state.chip && panel === (panelChosen() ?? panels.at(-1));
    const text = lacks && !/RAM|flash/.test($('shown').value) ? `no ${lacks}` : `${chip.basis && '≈ '}${shown.text(way, panel)}`;
    const button = element('button', { type: 'button', title: about, ariaLabel: about, ariaPressed: isChosen, tabIndex: isChosen ? 0 : -1, className: lacks ? 'cell bad' : 'cell' }, text);
    button.addEventListener('click', () => {
      set({ chip: chip.key, ...withPanel(panel), board: nearestBoard(chip.key, panel) });
      if (panel.name !== 'own') isOwnSize = false;
      showControls();
    });
    return element('td', {}, button);
  };
  const lines = rows.map(({ chip, ways }) => element('tr', {},
    element('th', { scope: 'row', title: chip.basis }, chip.name, ...(chip.basis ? [element('span', { className: 'note' }, ' estimate')] : [])),
    ...ways.map((way, at) => cell(chip, way, panels[at]))));
  const why = element('tr', {}, element('th', { scope: 'row' }, 'ESP32, S2, S3'), element('td', { colSpan: panels.length, className: 'note' }, XTENSA));
  const title = ({ name, width, height }) => (name === 'own' ? `own ${width} × ${height}` : name.split(',').slice(0, 2).join('').replaceAll(' × ', '\u00a0×\u00a0').replace('-', '\u2011'));
  const focused = [...$('matrix').querySelectorAll('button')].indexOf(document.activeElement);
  $('matrix').replaceChildren(element('table', {},
    element('thead', {}, element('tr', {}, head('Chip', -1), ...panels.map((panel, at) => head(title(panel), at)))),
    element('tbody', {}, ...lines, why)));
  if (focused >= 0) $('matrix').querySelectorAll('button')[focused]?.focus();
}

// Arrow keys move the focus from cell to cell, as Tab reaches only the chosen one.
function moveInMatrix(e) {
  const [down, right] = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[e.key] ?? [];
  const cell = e.target.closest('td, th');
  const next = cell && $('matrix').firstChild.rows[cell.parentElement.rowIndex + down]?.cells[cell.cellIndex + right]?.querySelector('button');
  if (!next) return;
  e.preventDefault();
  next.focus();
}

const XTENSA = 'Not offered: their Xtensa cores need a fork of the Rust compiler (espup), which this project neither builds nor measures with. The ESP32-C3 and C6 are RISC-V, which it does.';
