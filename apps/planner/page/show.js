// Draws the state, and shows what the library says about it: the picture, the model, its warnings and the boards.
'use strict';

async function show() {
  if (held) return; // drawn when nothing holds it back
  asked = false;
  held += 1;
  const of = { ...state };
  try {
    await showState(of);
  } finally {
    release();
  }
}

// Draws what was asked for while frames were held back.
function release() {
  held -= 1;
  if (asked) requestAnimationFrame(show);
}

// The parts of a picture that change while the model turns.
const changedIn = ({ pixels, about }, { format }) => changedParts(pixels, about.width, about.height, format === 'mono' ? 8 : 1);

async function showState(of) {
  const canvas = $('display');
  try {
    const before = performance.now();
    const { pixels, about } = await drawState(of);
    const took = performance.now() - before;
    canvas.classList.toggle('round', factsOf(panelChosen()).isRound === true);
    if (canvas.width !== about.width || canvas.height !== about.height) {
      [canvas.width, canvas.height] = [about.width, about.height];
    }
    canvas.getContext('2d').putImageData(new ImageData(pixels, about.width, about.height), 0, 0);
    scale();
    shown = of;
    changing = changedIn({ pixels, about }, of);
    canvas.classList.remove('stale');
    // While the model turns, only another choice changes what is shown beside it: a screen reader that reads each frame never ends.
    const kind = JSON.stringify([{ ...of, turn: 0 }, about.model]);
    if (turning && drawnModel && kind === shownKind) return;
    shownKind = kind;
    describe(about);
    if (JSON.stringify(about.model) !== drawnModel) slowest = Math.max(took, imported);
    imported = 0;
    showModel(about.model);
    showCosts(choice(of));
    showBoards();
  } catch (problem) {
    if (problem.isCancelled && shown) {
      set(shown);
      say(`Stopped: ${problem.message}.`);
      return;
    }
    shownKind = '';
    say(grouped(problem.message), true);
    drawnModel = '';
    canvas.classList.add('stale');
    isTooLarge = isRemedied(problem);
    showDecimation(state.decimate);
    hideCosts();
    showBoards();
    // A turn would fail at each step: an import of half a second, again and again.
    stopTurning();
    showWarnings(`failed ${problem.message}`, () => {
      const buttons = remedyButtons(problem.remedies);
      return buttons.length ? [element('div', { className: 'warning' }, 'This page can do it: ', ...buttons)] : [];
    });
    $('model').textContent = '';
  }
  addressSoon();
}

// The last model that was too large, and its error: it is not read again for each view of it.
let tooLarge = {};
const modelKey = (of) => JSON.stringify(['mesh', 'style', 'edges', 'smooth-edges', 'format', ...OF_FILE].map((key) => of[key]));

async function drawState(of = state) {
  const model = modelKey(of);
  if (tooLarge.model === model) throw tooLarge.problem;
  try {
    return await library.draw(choice(of));
  } catch (problem) {
    if (isRemedied(problem)) tooLarge = { model, problem };
    throw problem;
  }
}

// The choice, without the turn, and the model that the page shows now.
let shownKind = '';

// Describes the frame in words.
function describe({ width, height, bytes, statistics: { drawn, culled, clipped } }) {
  say(`${width} × ${height}: ${counted(drawn, ofLines() ? 'edge' : 'face')} drawn, ${count(culled)} seen from behind and left out (culled), ${count(clipped)} cut at a border (clipped); ${count(bytes)} bytes a frame`);
  const label = `${meshName()}, ${state.style}, ${state.projection}, on ${width} × ${height} pixels`;
  if ($('display').getAttribute('aria-label') !== label) $('display').setAttribute('aria-label', label);
}

// The importer's warnings, with a button for each remedy that the page has.
function showModel(model) {
  const text = JSON.stringify(model);
  if (text === drawnModel) return;
  drawnModel = text;
  $('model').textContent =
    `${counted(model.vertices, 'vertex', 'vertices')}, ${counted(model.faces, 'face')}${model.edges ? `, ${counted(model.edges, 'edge')}` : ''}; ${count(model.flash)} bytes of flash`;
  allFaces = model.all;
  isTooLarge = false;
  showDecimation(state.decimate);
  showWarnings(text, () => model.warnings.map(({ message, remedies }) =>
    element('div', { className: 'warning' }, `Warning: ${grouped(message)} `, ...remedyButtons(remedies))));
}

// What the warnings are about. They are made again only if this differs: a button that is replaced between press and release is
// not clicked.
let warnedOf = '';

function showWarnings(about, make) {
  const text = `${about} ${state.decimate}`; // a remedy offers fewer faces than now
  if (text === warnedOf) return;
  warnedOf = text;
  $('warnings').replaceChildren(...make());
}

// Whether decimation makes a model one that can be drawn.
const isRemedied = ({ remedies = [] }) => remedies.some(({ changes }) => 'decimate' in changes);

// A button for each remedy: its name, and what it changes in the choice.
function remedyButtons(remedies = []) {
  const button = ({ name, changes }) =>
    'decimate' in changes ? decimationButtons() : [remedyButton(name[0].toUpperCase() + name.slice(1), changes)];
  return remedies.flatMap(button);
}

// A button that decimates the model, as long as that still helps: to half of the present faces; for a model too large for a mesh, to as
// many faces as a display can show.
function decimationButtons() {
  const now = state.decimate || allFaces;
  const faces = drawnModel && now ? Math.max(Math.min(Math.floor(now / 2), 20_000), 4) : Math.min(20_000, Math.floor((state.decimate || 40_000) / 2));
  return faces < (state.decimate || Infinity) ? [remedyButton(`Decimate to ${count(faces)} faces`, { decimate: faces })] : [];
}

function remedyButton(text, changes) {
  const button = element('button', { type: 'button', className: 'remedy' }, text);
  button.addEventListener('click', () => {
    set(changes);
    // The button goes away, and the focus with it, unless it is moved: to the control that changed, if it is seen.
    const [key] = Object.keys(changes);
    const control = key === 'width' ? $('panel-type') : $(key);
    (control?.checkVisibility() && !control.disabled ? control : $('status')).focus();
  });
  return button;
}

let isTrueSize = false;

function trueSize() {
  isTrueSize = !isTrueSize;
  $('true-size').setAttribute('aria-pressed', isTrueSize);
  scale();
}

// In true size the panel is as large as its glass, where the screen has 96 pixels an inch. Otherwise each pixel of the display takes a whole number of
// screen pixels, as many as fit.
function scale() {
  const canvas = $('display');
  const bezel = canvas.offsetWidth - canvas.clientWidth;
  const isNarrow = matchMedia('(max-width: 52rem)').matches;
  const fits = Math.min(($('frame').clientWidth - bezel) / canvas.width, Math.max(innerHeight * (isNarrow ? 0.3 : 0.64), 160) / canvas.height);
  const fine = devicePixelRatio || 1;
  const times = fits * fine >= 1 ? Math.floor(fits * fine) / fine : fits;
  // A display of one row, or of one column, is seen, too.
  const { inches } = factsOf(panelChosen());
  $('true-size').hidden = !inches;
  // CSS has 96 pixels an inch.
  const shown = isTrueSize && inches ? (96 * (inches[canvas.height] ?? inches)) / Math.hypot(canvas.width, canvas.height) : times;
  canvas.style.width = `${Math.max(canvas.width * shown, 1)}px`;
  canvas.style.height = `${Math.max(canvas.height * shown, 1)}px`;
}
