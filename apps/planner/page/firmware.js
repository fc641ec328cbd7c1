// The boards that draw the choice, and what is said of a board's firmware before it is saved.
'use strict';

// Boards that do not draw the chosen style and format cannot be chosen.
function showBoards() {
  const boards = drawnModel ? boardsFor(templates, { ...state, whole: isWhole() }) : [];
  for (const option of $('board').options) option.disabled = !boards.includes(option.value);
  if (boards.length > 0) $('board').value = boards.includes(state.board) ? state.board : boards[0];
  for (const id of ['zip', 'picture', 'texels']) $(id).disabled = boards.length === 0;
  $('rust').disabled = !drawnModel;
  $('texels').hidden = state.style !== 'textured';
  write('in-one-piece', isWhole() ? 'The other boards draw one band while they send another. ' : '', ['Draw in bands', { whole: 0 }]);
  showFirmware();
}

function showFirmware() {
  const board = $('board').value;
  const isOffered = !$('zip').disabled;
  const display = displayOf(templates, board);
  const isOther = isOffered && display && (display.width !== state.width || display.height !== state.height);
  showOtherDisplay(isOther, board, display);
  showOtherChip(isOffered, board);
  showBands(isOffered && !isOther, board);
  const driver = display ? 'Its README has the wiring of the display.' : 'Put the driver of your display into src/display.rs: what is there shows nothing.';
  write('to-write', isOffered ? toWrite(board) : '');
  write('wiring', isOffered ? `${driver}${state.decimate ? ` ${DECIMATES}` : ''}` : '');
}

// Writes a paragraph, with buttons, each a text and changes, only where its text differs: a press on a button must not be lost.
function write(id, text, ...buttons) {
  const whole = JSON.stringify([text, buttons]);
  if ($(id).dataset.whole === whole) return;
  $(id).dataset.whole = whole;
  $(id).hidden = !text;
  $(id).replaceChildren(text, ...(text ? buttons.map((button) => remedyButton(...button)) : []));
}

// A note if the board's display differs from the one that the page shows: its firmware frames the model for the board's display.
function showOtherDisplay(isOther, board, display) {
  if (!isOther) return write('other-display', '');
  const { width, height } = display;
  const { controller } = partsOf(board);
  const spi = clockOf({ name: controller });
  write('other-display', `The display of ${board} has ${width} × ${height} pixels, and its firmware frames the model for them. `,
    [`Show ${width} × ${height} pixels`, { width, height, spi, controller }]);
}

const family = (name) => name.split('-')[0];

// The template for a chip and a display: one of both, the plain one first, one of the chip, or the nearest.
function nearestBoard(chip, panel) {
  const score = (board) => (family(partsOf(board).chip ?? '') === family(chip) ? 2 : 0) +
    (partsOf(board).controller === controllerOf(panel) ? 1 : 0) + (/-(st7789|ili9341|ssd1306)$/.test(board) ? 0.5 : 0);
  const best = boardsIn(templates).filter((board) => score(board) >= 2).sort((a, b) => score(b) - score(a))[0];
  return best ?? (chip === 'esp32c6' ? 'esp32c3-st7789' : 'any-cortex-m');
}

// What the user must write where the template is of another chip or another display.
function toWrite(board) {
  const [{ chip, controller }, wanted] = [partsOf(board), controllerOf(panelChosen()) ?? 'your display'];
  const { name } = menu.chips.find(({ key }) => key === state.chip);
  const parts = [];
  if (!chip) parts.push(`target, memory and clocks of the ${name} in .cargo/config.toml, memory.x and src/main.rs`);
  else if (state.chip === 'esp32c6' && board === 'esp32c3-st7789') parts.push('in Cargo.toml the feature esp32c6 of each esp crate, in .cargo/config.toml the target riscv32imac-unknown-none-elf, and the pins');
  if (!controller) parts.push(`SPI and the driver of ${wanted} in src/display.rs`);
  else if (controller !== wanted) parts.push(`the driver of ${wanted} in place of the ${controller}'s`);
  if (smooths() && !templates.has(`${board}/smooth.diff`)) parts.push('smooth edges, as boards/common/two-strips/smooth.diff has them in src/: a SmoothFrame and its memory');
  return parts.length ? `Left for you to write: ${parts.join('; ')}.` : '';
}

// A note if the costs are those of another chip than the board's.
function showOtherChip(isOffered, board) {
  const { chip } = partsOf(board);
  const nearest = nearestBoard(state.chip, panelChosen());
  if (!isOffered || !chip || family(chip) === family(state.chip) || nearest === board) return write('other-chip', '');
  const name = (key) => menu.chips.find((one) => one.key === key)?.name;
  write('other-chip', `The figures are those of the ${name(state.chip)}, which is not the chip of ${board}. `,
    [`Show those of the ${name(chip)}`, { chip }], [`Take ${nearest} instead`, { board: nearest }]);
}

// Bands that the board's cores cannot share.
function showBands(isShown, board) {
  const { rows } = (isShown && costsShown && chosenOf(costsShown)) || {};
  const isUneven = rows && board === 'rp2040-two-cores' && state.height % (2 * rows);
  const fewer = HEIGHTS.find((some) => some < rows && state.height % (2 * some) === 0);
  write('bands', isUneven ? 'Its two cores draw as many bands each. ' : '', ...(fewer ? [[`Use bands of ${fewer} rows`, { rows: fewer }]] : []));
}
