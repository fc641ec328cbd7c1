// The boards that draw the choice, and what is said of a board's firmware before it is saved.
'use strict';

// Boards whose templates do not draw the chosen style and format cannot be chosen.
function showBoards() {
  const boards = drawnModel ? boardsFor(templates, state) : [];
  for (const option of $('board').options) option.disabled = !boards.includes(option.value);
  if (boards.length > 0) $('board').value = boards.includes(state.board) ? state.board : boards[0];
  for (const id of ['zip', 'picture', 'texels']) $(id).disabled = boards.length === 0;
  $('rust').disabled = !drawnModel;
  $('texels').hidden = state.style !== 'textured';
  $('no-firmware').hidden = boards.length > 0 || !drawnModel;
  showFirmware();
}

function showFirmware() {
  const board = $('board').value;
  const isOffered = !$('zip').disabled;
  const display = displayOf(templates, board);
  const isOther = isOffered && display && (display.width !== state.width || display.height !== state.height);
  showOtherDisplay(isOther, board, display);
  showOtherChip(isOffered, board);
  showBuffers(isOffered && !isOther, board);
  const driver = display ? 'Its README has the wiring of the display.' : 'Put the driver of your display into src/display.rs: what is there shows nothing.';
  const decimates = state.decimate ? ' Its build decimates the model by a library in C++: install g++ or clang first.' : '';
  write('wiring', isOffered ? driver + decimates : '');
}

// Writes a paragraph, with a button if there are changes to make, only where its text differs: a press on a button must not be lost.
function write(id, text, button, changes) {
  const whole = text + (button ?? '');
  if ($(id).dataset.whole === whole) return;
  $(id).dataset.whole = whole;
  $(id).hidden = !text;
  $(id).replaceChildren(text, ...(button ? [remedyButton(button, changes)] : []));
}

// A note if the board's display differs from the one that the page shows: its firmware frames the model for the board's display.
function showOtherDisplay(isOther, board, display) {
  if (!isOther) return write('other-display', '');
  const { width, height } = display;
  const spi = clockOf(panelOf({ ...display, format: state.format }));
  write('other-display', `The display of ${board} has ${width} × ${height} pixels, and its firmware frames the model for them. `,
    `Show ${width} × ${height} pixels`, { width, height, spi });
}

// A note if the costs are those of another chip than the board's.
function showOtherChip(isOffered, board) {
  const { chip } = partsOf(board);
  const family = (name) => name.split('-')[0];
  if (!isOffered || !chip || family(chip) === family(state.chip)) return write('other-chip', '');
  const name = (key) => menu.chips.find((one) => one.key === key)?.name;
  write('other-chip', `The costs above are those of the ${name(state.chip)}, which is not the chip of ${board}. `, `Show the costs on the ${name(chip)}`, { chip });
}

// The buffers of the board's firmware, if its display has the sides that the page shows.
function showBuffers(isShown, board) {
  const way = costsShown && chosenOf(costsShown);
  if (!isShown || !way?.rows) return write('buffers', '');
  const { strips } = partsOf(board);
  const more = strips > 1 ? `, with the pixels of ${strips} bands, as one is drawn while another is sent` : '';
  const bytes = buffersOf(board, way);
  const isLarge = $('other-chip').hidden && bytes + way.beside > costsShown.ram;
  const large = isLarge ? `. That does not fit the ${kilobytes(costsShown.ram, 0)} of the chip beside ${kilobytes(way.beside)} of stack: choose fewer rows or faces` : '';
  write('buffers', `Its buffers take ${kilobytes(bytes)} of RAM in bands of ${way.rows} rows${more}${large}.`);
}
