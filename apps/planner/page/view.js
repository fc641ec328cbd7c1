// Mouse, touch, keys and the turntable change the view.
'use strict';

const within = (value, least, most) => Math.min(Math.max(value, least), most);
const hundredths = (value) => Math.round(value * 100) / 100;

function orbit(right, up) {
  const yaw = ((((state.yaw + right + 180) % 360) + 360) % 360) - 180;
  const { steepest } = menu.projections.find(({ name }) => name === state.projection);
  set({ yaw: hundredths(yaw), pitch: hundredths(within(state.pitch + up, -steepest, steepest)) });
}

// Moves the picture by pixels of the screen.
function move(right, down) {
  const canvas = $('display');
  const half = Math.min(canvas.clientWidth, canvas.clientHeight) / 2;
  const by = (pixels) => (1000 * pixels) / half;
  set({ x: within(Math.round(state.x + by(right)), -4000, 4000), y: within(Math.round(state.y - by(down)), -4000, 4000) });
}

// The zoom with the fractions that the state does not have, so that small steps of a trackpad add up.
let fineZoom = 100;

function zoom(times) {
  if (Math.round(fineZoom) !== state.zoom) fineZoom = state.zoom;
  fineZoom = within(fineZoom * times, ...ZOOMS);
  if (Math.round(fineZoom) !== state.zoom) set({ zoom: Math.round(fineZoom) });
}

function reset() {
  const { yaw, pitch } = menu.projections.find(({ name }) => name === state.projection);
  set({ yaw, pitch, zoom: 100, x: 0, y: 0, turn: 0 });
}

let turning = false;

function stopTurning() {
  turning = false;
  $('turntable').setAttribute('aria-pressed', false);
}

function turntable() {
  if (turning) {
    stopTurning();
    change({}); // the frame at which the turn ended is described, and its costs and address are shown
    return;
  }
  turning = true;
  $('turntable').setAttribute('aria-pressed', true);
  let last;
  // Steps follow the time that has passed, so a slow tab turns as fast, in larger steps: a turn takes 4 seconds. Pictures change as often
  // as on the display.
  let at = state.turn;
  let [turned, due] = [at, 0];
  const step = (time) => {
    if (!turning) return;
    if (state.turn !== turned) at = state.turn; // it was reset meanwhile
    at += last === undefined ? 0 : within(time - last, 0, 1000) * (TURNS / 4000);
    last = time;
    turned = state.turn;
    if (time >= due) {
      const period = costsShown ? 1000 / framesOf(chosenOf(costsShown), panelChosen()) : 0;
      due = Math.max(due + period, time);
      turned = Math.floor(at) % TURNS;
      if (turned !== state.turn) change({ turn: turned });
    }
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function listenToPointers() {
  const canvas = $('display');
  const pointers = new Map();
  canvas.addEventListener('pointerdown', (e) => {
    canvas.setPointerCapture(e.pointerId);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  canvas.addEventListener('pointermove', (e) => {
    const before = pointers.get(e.pointerId);
    if (!before) return;
    const now = [e.clientX, e.clientY];
    const [right, down] = [now[0] - before[0], now[1] - before[1]];
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const apart = ([x, y]) => Math.max(Math.hypot(x - other[0], y - other[1]), 1);
      zoom(apart(now) / apart(before));
      move(right / 2, down / 2);
    } else if (e.shiftKey || e.buttons === 2) {
      move(right, down);
    } else {
      orbit(-right / 2, down / 2);
    }
    pointers.set(e.pointerId, now);
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
  canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    const pixels = e.deltaY * [1, 16, 400][e.deltaMode]; // some browsers count lines or pages
    zoom(Math.exp(-pixels / 500));
  }, { passive: false });
}

function listenToKeys() {
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  $('display').addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const arrow = ARROWS[e.key];
    if (arrow && e.shiftKey) move(10 * arrow[0], -10 * arrow[1]);
    else if (arrow) orbit(5 * arrow[0], 5 * arrow[1]);
    else if (e.key === '+' || e.key === '=') zoom(1.1);
    else if (e.key === '-') zoom(1 / 1.1);
    else if (e.key === ' ') turntable();
    else if (e.key === '0') reset();
    else return;
    e.preventDefault();
  });
}
