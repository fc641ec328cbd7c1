// Starts the page. Controls, mouse, touch and keys change a state; the library draws the state, and the address contains it.
'use strict';

// Shows the state of the address.
function followAddress() {
  isOwnSize = false;
  written = undefined;
  change(readAddress());
  showControls();
}

function resetAll() {
  history.replaceState(null, '', location.pathname + location.search);
  followAddress();
}

async function start() {
  try {
    library = await Pinhole.from(await unpacked(PINHOLE));
    templates = untar(await unpacked(BOARDS));
  } catch (problem) {
    say(`This browser cannot run the page: ${problem.message}. It needs WebAssembly and DecompressionStream, which browsers have since 2023.`, true);
    return;
  }
  menu = library.menu();
  buildControls();
  listenForDrops();
  listenToPointers();
  listenToKeys();
  followAddress();
  addEventListener('resize', scale);
  addEventListener('hashchange', followAddress);
}

start();
