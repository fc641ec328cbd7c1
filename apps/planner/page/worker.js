// Runs in a worker: the library and the templates. Answers the page's calls in their order. apps/planner/build packs this file with ways.js,
// pinhole.js and take.js.
'use strict';

let library;
let templates;

const CALLS = {
  async start(wasm, boards) {
    library = await Pinhole.from(wasm);
    templates = untar(boards);
  },
  load: async (file) => library.load(file.name, new Uint8Array(await file.arrayBuffer())),
  picture: (width, bytes) => library.picture(width, bytes),
  menu: () => library.menu(),
  draw(choice) {
    const { pixels, about } = library.draw(choice);
    return { pixels: pixels.slice(), about };
  },
  ask: (name, text) => library.ask(name, text),
  bytes: (name, text) => library.bytes(name, text),
  zip: (board, choice) => zip(firmware(library, templates, board, choice)),
  source: (board, choice, name) => firmware(library, templates, board, choice).get(`firmware/src/${name}`),
};

let last = Promise.resolve();
onmessage = ({ data: [id, name, ...values] }) => {
  last = last.then(async () => {
    try {
      postMessage([id, await CALLS[name](...values)]);
    } catch (problem) {
      const { message, remedies } = problem;
      postMessage([id, undefined, { message, remedies, isFatal: problem instanceof WebAssembly.RuntimeError || problem instanceof RangeError }]);
    }
  });
};
