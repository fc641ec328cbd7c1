// The address of the page contains the state, so that a link shows the same picture.
'use strict';

// What a link has of a file that is not here: its name, and the settings that are of that file. Another mesh is shown until the
// user opens it.
let awaited = {};
const OF_FILE = ['up', 'flip', 'fix-winding', 'two-sided', 'decimate'];

// The parts of the state that differ from the defaults, with the names of the files: a receiver of the link does not have the files.
function addressText(of = state) {
  const { model, picture } = awaited;
  const all = { ...of, ...(model && { mesh: 'file', ...model.settings }), ...(picture && { texture: 'file' }) };
  const parts = Object.entries(all).filter(([key, value]) => value !== DEFAULTS[key]);
  if (all.mesh === 'file') parts.push(['file', model?.name ?? fileName]);
  if (all.texture === 'file') parts.push(['picture', picture?.name ?? pictureName]);
  return parts.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join('&');
}

// The address is written at most 20 times at once, and then every 400 ms: Safari permits 100 times in 30 seconds.
let written; // the text that was written last, without a turn that goes on
let addressTimer = 0;
let [permits, permitsAt] = [20, 0];

function addressSoon() {
  const text = addressText(turning ? { ...state, turn: 0 } : state);
  if (text === written) return;
  written = text;
  if (addressTimer) return;
  const now = performance.now();
  permits = Math.min(permits + (now - permitsAt) / 400, 20);
  permitsAt = now;
  if (permits >= 1) writeAddress();
  else addressTimer = setTimeout(writeAddress, (1 - permits) * 400);
}

function writeAddress() {
  clearTimeout(addressTimer);
  addressTimer = 0;
  permits -= 1;
  const text = addressText();
  history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
}

// The state of the address. What is not understood has its default, and a notice says so.
async function readAddress() {
  const read = { ...DEFAULTS };
  const parts = new URLSearchParams(location.hash.slice(1));
  const [file, picture] = ['file', 'picture'].map((key) => parts.get(key));
  for (const key of ['file', 'picture']) parts.delete(key);
  const wrong = [];
  for (const [key, value] of parts) {
    const problem = await problemOf(key, value);
    if (problem) wrong.push(`${key}=${value}: ${problem}`);
    else read[key] = NUMBERS.includes(key) ? Number(value) : value;
  }
  const isWrong = (key) => wrong.some((text) => text.startsWith(`${key}=`));
  const named = menu.projections.find(({ name }) => name === read.projection);
  for (const key of ['yaw', 'pitch']) if (!parts.has(key) || isWrong(key)) read[key] = named[key];
  awaitFiles(read, file, picture);
  notice(wrong.length ? `Not understood in the link, and left out: ${wrong.join('; ')}. ${askForFiles()}` : askForFiles());
  return read;
}

// What is wrong with a part of an address, by the library, which gets the part alone.
async function problemOf(key, value) {
  if (!Object.hasOwn(DEFAULTS, key)) return 'no such part';
  if (key === 'mesh' && value === 'file') return '';
  if (key === 'board') return boardsOf(templates).some(([board]) => board === value) ? '' : 'no such board';
  if (key === 'controller') return menu.displays.some((panel) => controllerOf(panel) === value) ? '' : 'no such controller';
  if (key === 'light' && value.split(',').length !== 3) return 'not three numbers';
  if (/[&=]/.test(value)) return 'not a value';
  try {
    await library.bytes('model', `${key}=${value}`);
    return '';
  } catch ({ message }) {
    return message.replace(`${key}=${value}: `, '');
  }
}

// Leaves files out of a state that are not here.
function awaitFiles(read, file, picture) {
  awaited = {};
  if (read.mesh === 'file' && (!fileName || (file && file !== fileName))) {
    awaited.model = { name: file ?? '', settings: Object.fromEntries(OF_FILE.map((key) => [key, read[key]])) };
    for (const key of ['mesh', ...OF_FILE]) read[key] = DEFAULTS[key];
  }
  if (read.texture === 'file' && (!pictureName || (picture && picture !== pictureName))) {
    awaited.picture = { name: picture ?? '' };
    read.texture = DEFAULTS.texture;
  }
}

const askForFiles = () => {
  const names = Object.values(awaited).map(({ name }) => name || 'without a name');
  const [files, it] = names.length > 1 ? ['files', 'them'] : ['a file', 'it'];
  return names.length ? `This link was made with ${files}, ${names.join(' and ')}: drop ${it} here.` : '';
};

// A choice of another mesh or texture takes the place of the file that the link names.
function stopAwaiting(changes) {
  const asked = askForFiles();
  if ('texture' in changes) delete awaited.picture;
  if (['mesh', ...OF_FILE].some((key) => key in changes)) delete awaited.model;
  if (askForFiles() !== asked) notice(askForFiles());
}
