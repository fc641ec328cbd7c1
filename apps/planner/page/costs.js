// What a frame costs, as a table of the ways to draw it.
'use strict';

let costTimer;

// Waits until changes pause: counting the work of a frame takes as long as drawing it.
function showCosts(library, choice) {
  clearTimeout(costTimer);
  costTimer = setTimeout(() => {
    try {
      const costs = JSON.parse(library.ask('costs', choice));
      $('cost').replaceChildren(costTable(costs), ...advice(costs).map((text) => element('p', { className: 'advice' }, `${text} `, ...remedyButtons(text))), notes(costs));
      $('costs').hidden = false;
    } catch {
      $('costs').hidden = true; // the message stands below the display
    }
  }, 120);
}

const kilobytes = (bytes) => `${(bytes / 1024).toFixed(1)} KB`;

// A time; for a chip whose cycles are not all known, the likely time and its range; and the error of the instructions.
function drawing({ drawing, range, error }) {
  const span = range.length ? ` (${range.join('–')})` : '';
  return `${drawing} ms${span} ± ${Math.round(error)} %`;
}

function costTable(costs) {
  const head = ['Way to draw', 'RAM', 'Flash', 'Instructions', 'Cycles', 'Drawing', 'Sending', 'Frames/s', 'Limit'];
  const table = element('table', {}, element('thead', {}, element('tr', {}, ...head.map((text) => element('th', { scope: 'col' }, text)))));
  const body = element('tbody', {});
  for (const way of costs.ways) {
    const [cache, bins, pixels, depths] = way.parts;
    const name = element('th', { scope: 'row' }, way.name, ...(way.note ? [element('div', { className: 'note' }, way.note)] : []));
    const ram = element('td', { className: way.fits ? '' : 'bad' }, kilobytes(way.ram), way.fits ? '' : ' does not fit');
    ram.title = `vertices ${count(cache)}, bins or sorted faces ${count(bins)}, pixels ${count(pixels)}, depths ${count(depths)} bytes`;
    const cells = [ram, kilobytes(way.flash), count(way.instructions), count(way.cycles), drawing(way),
      `${way.bus} ms`, `${way.blocking}, ${way.dma} by DMA`, way.limit];
    const row = element('tr', { className: way.chosen ? 'chosen' : '' }, name);
    row.append(...cells.map((cell) => (cell instanceof Node ? cell : element('td', {}, cell))));
    body.append(row);
  }
  table.append(body);
  return element('div', { className: 'table', tabIndex: 0, role: 'region', ariaLabel: 'Costs of the ways to draw' }, table);
}

const chosenOf = (costs) => costs.ways.find((way) => way.chosen) ?? costs.ways[0];

// What to change if the chosen way to draw does not fit.
function advice(costs) {
  const chosen = chosenOf(costs);
  if (chosen.fits) return [];
  const smaller = costs.ways.filter((way) => way.fits && way.rows).sort((a, b) => a.ram - b.ram)[0];
  if (smaller) return [`${chosen.name}: ${kilobytes(chosen.ram)} of RAM, but the ${costs.chip} has ${kilobytes(costs.ram)}. Use ${smaller.name}: ${kilobytes(smaller.ram)}.`];
  const [cache, bins] = chosen.parts;
  const mesh = cache + bins;
  return [`No way to draw fits the ${kilobytes(costs.ram)} of the ${costs.chip}. Vertices and bins take ${kilobytes(mesh)}: use fewer faces (pinhole-import --decimate N), or a chip with more RAM.`];
}

function notes(costs) {
  const { stack } = chosenOf(costs);
  const inexact = costs.exact ? '' : ' Drawing was measured in 16-bit colour; pixels of less than a byte take longer.';
  return element('p', { className: 'note' },
    `${costs.chip}, ${costs.core} at ${costs.clock} MHz, sending at ${costs.spi} MHz. RAM is the size of the variables, exact to the byte; the stack takes ${kilobytes(stack)} more. Flash is the mesh and the code that draws, at opt-level 3, ± ${costs.flashError} %; drivers and logs come on top. Times are computed by the formula of docs/growth.md; ± is the largest error of its instructions in any measured case. Cycles per instruction differ by up to ${costs.cyclesError} % from model to model; the chip adds: ${costs.error}.${inexact}`);
}
