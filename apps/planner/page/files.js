// Files that are chosen or dropped: models, material libraries and pictures.
'use strict';

async function open(file) {
  filming = false;
  say(`Reading ${file.name} …`);
  try {
    if (isPicture(file)) {
      await openPicture(file);
      return;
    }
    if (isLibrary(file)) {
      await library.load(file);
      loaded.libraries.push(file);
      tooLarge = {};
      drawnModel = '';
      change({});
      return;
    }
    const settings = { ...Object.fromEntries(OF_FILE.map((key) => [key, DEFAULTS[key]])), ...awaited.model?.settings };
    held += 1; // no frame has the new model and the settings of the old one
    try {
      await tryModel(file, settings);
    } finally {
      release();
    }
    loaded.model = file;
    fileName = file.name;
    if (!$('mesh').querySelector('[value=file]')) $('mesh').append(element('option', { value: 'file' }));
    $('mesh').querySelector('[value=file]').textContent = file.name;
    drawnModel = ''; // its measures may be those of the model before it
    allFaces = 0;
    set({ mesh: 'file', ...settings });
  } catch (problem) {
    for (const id of ['file', 'picture-file']) $(id).value = ''; // the page does not have this file
    // The library's messages about a file begin with its name, and the line where that is known.
    const name = problem.message.startsWith(`${file.name}:`) ? '' : `${file.name}: `;
    say(name + grouped(problem.message), true);
    // Figures that were asked for while the library had this file are asked for again.
    matrixOf = undefined;
    if (drawnModel) showCosts(choice());
  }
}

// Loads a model, and draws it once. If it cannot be read, the model before it stays; if decimation makes it one that can be drawn, it is
// taken, because the page has a button for that.
async function tryModel(file, settings) {
  await library.load(file);
  tooLarge = {};
  const before = performance.now();
  try {
    await drawState({ ...state, mesh: 'file', ...settings });
    imported = performance.now() - before;
  } catch (problem) {
    if (isRemedied(problem)) return;
    if (loaded.model && !problem.isCancelled) await library.load(loaded.model);
    throw new Error(drawnModel ? `${problem.message}. The page keeps ${meshName()}.` : problem.message);
  }
}

// A picture for textures, read by the browser, with the sides that a texture has.
async function openPicture(file) {
  let picture;
  try {
    picture = await createImageBitmap(file);
  } catch {
    throw new Error('is no picture that this browser reads: save it as PNG');
  }
  const [width, height] = [picture.width, picture.height].map((side) => within(2 ** Math.round(Math.log2(side)), 8, 256));
  const canvas = element('canvas', { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.fillStyle = '#fff'; // behind transparent parts
  context.fillRect(0, 0, width, height);
  context.drawImage(picture, 0, 0, width, height);
  loaded.picture = [width, new Uint8Array(context.getImageData(0, 0, width, height).data.buffer)];
  await library.picture(...loaded.picture);
  if (!$('texture').querySelector('[value=file]')) $('texture').append(element('option', { value: 'file' }));
  $('texture').querySelector('[value=file]').textContent = file.name;
  pictureName = file.name;
  set({ style: 'textured', texture: 'file' });
}

// A model, its material libraries and a picture may be dropped together: the libraries first, so that the model is drawn in their colours.
async function openAll(files) {
  const [libraries, pictures] = [[...files].filter(isLibrary), [...files].filter(isPicture)];
  // Of what is neither, a model is a model by its name, if one is.
  const others = [...files].filter((file) => !isLibrary(file) && !isPicture(file)).sort((a, b) => isModel(b) - isModel(a));
  for (const file of [...libraries, ...others.slice(0, 1), ...pictures.slice(0, 1)]) await open(file);
  const left = [...others.slice(1), ...pictures.slice(1)].map(({ name }) => name);
  const taken = [...others.slice(0, 1), ...pictures.slice(0, 1)].map(({ name }) => name);
  notice(`${left.length ? `The page shows one model and one picture: ${taken.join(' and ')}, not ${left.join(', ')}.` : ''} ${askForFiles()}`);
}

const isLibrary = ({ name }) => /\.mtl$/i.test(name);
const isModel = ({ name }) => /\.(stl|obj)$/i.test(name);
const isPicture = ({ name }) => /\.(png|bmp|jpe?g|gif|webp)$/i.test(name);

function listenForDrops() {
  const isFile = (e) => e.dataTransfer?.types.includes('Files');
  addEventListener('dragover', (e) => {
    if (!isFile(e)) return;
    e.preventDefault();
    $('frame').classList.add('drop');
  });
  addEventListener('dragleave', () => $('frame').classList.remove('drop'));
  addEventListener('drop', (e) => {
    $('frame').classList.remove('drop');
    if (!isFile(e)) return;
    e.preventDefault();
    openAll(e.dataTransfer.files);
  });
}
