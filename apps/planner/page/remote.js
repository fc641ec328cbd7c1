// The library as the page sees it: calls to a worker, so that a large model never blocks the page. A long call shows how long it has
// taken, and a button that ends it with the worker.
'use strict';

let worker;
let parts; // of which a worker is made: its script, the library and the templates
const waiting = new Map(); // the calls that are not answered, by their numbers
let calls = 0;
const loaded = { libraries: [] }; // what a new worker needs: material libraries, `model`, and the values of `picture`

function call(name, ...values) {
  return new Promise((resolve, reject) => {
    waiting.set(++calls, { name, values, resolve, reject, since: performance.now() });
    worker.postMessage([calls, name, ...values]);
  });
}

const library = Object.fromEntries(['load', 'picture', 'menu', 'draw', 'ask', 'bytes', 'zip', 'source'].map((name) => [name, (...values) => call(name, ...values)]));
library.gif = Pinhole.prototype.gif;

async function startWorker() {
  const address = URL.createObjectURL(new Blob([parts.script]));
  worker = new Worker(address);
  worker.onmessage = ({ data: [id, result, problem] }) => {
    const { resolve, reject } = waiting.get(id) ?? {};
    if (!waiting.delete(id)) return; // of a worker that was ended meanwhile
    if (!problem) return resolve(result);
    if (problem.isFatal) {
      problem.message = 'this browser has too little memory for it';
      endWorker(problem.message);
    }
    reject(Object.assign(new Error(problem.message), problem));
  };
  const files = [...loaded.libraries, ...(loaded.model ? [loaded.model] : [])];
  const starting = [call('start', parts.wasm, parts.boards), ...files.map(library.load), ...(loaded.picture ? [library.picture(...loaded.picture)] : [])];
  await Promise.all(starting);
  URL.revokeObjectURL(address);
}

// Ends the worker, and what it does, for a new one.
function endWorker(message) {
  worker.terminate();
  const ended = [...waiting.values()];
  waiting.clear();
  startWorker().catch(() => {}); // a file that cannot be read again is missed when it is drawn
  for (const { reject } of ended) reject(Object.assign(new Error(message), { isCancelled: true }));
}

// Shows a call that takes long, and how long it has taken.
function watchCalls() {
  const [first] = [...waiting.values()].filter(({ values }) => values[0] !== 'costs' && values[0] !== 'film');
  const took = first ? performance.now() - first.since : 0;
  if (filming) return;
  $('filming').hidden = took < 300;
  if (took < 300) return;
  const what = first.name === 'load' ? `Reading ${first.values[0].name}` : first.name === 'draw' ? 'Making the mesh' : 'Working';
  $('doing').textContent = `${what}: ${Math.round(took / 1000)} s`;
  $('filmed').removeAttribute('value');
}

function cancel() {
  if (filming) filming = false;
  else endWorker('cancelled');
}
