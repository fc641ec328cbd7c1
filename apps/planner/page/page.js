// Starts the page. Controls, mouse, touch and keys change a state; the library draws the state, and the address contains it.
'use strict';

// Shows the state of the address.
async function followAddress() {
  isOwnSize = false;
  written = undefined;
  change(await readAddress());
  showControls();
}

function resetAll() {
  history.replaceState(null, '', location.pathname + location.search);
  followAddress();
}

async function start() {
  try {
    const [script, wasm, boards] = await Promise.all([WORKER, PINHOLE, BOARDS].map(unpacked));
    parts = { script, wasm, boards };
    templates = untar(boards);
    await startWorker();
    menu = await library.menu();
  } catch (problem) {
    say(`This browser cannot run the page: ${problem.message}. It needs WebAssembly, workers and DecompressionStream, which browsers have since 2023.`, true);
    return;
  }
  buildControls();
  listenForDrops();
  listenToPointers();
  listenToKeys();
  $('compare').open = innerWidth > 832;
  followAddress();
  setInterval(watchCalls, 200);
  addEventListener('resize', scale);
  addEventListener('hashchange', followAddress);
}

start();
