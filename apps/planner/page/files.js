// Files that are chosen or dropped: models, material libraries and pictures.
'use strict';

async function open(file) {
  filming = false;
  say(`Reading ${file.name} …`);
  try {
    if (/\.(png|bmp|jpe?g|gif|webp)$/i.test(file.name)) {
      await openPicture(file);
      return;
    }
    const bytes = new Uint8Array(await file.arrayBuffer());
    await new Promise((done) => setTimeout(done)); // so that the line above is seen
    library.load(file.name, bytes);
    if (isLibrary(file)) {
      materials.set(file.name, bytes);
      drawnModel = '';
      change({});
      return;
    }
    fileName = file.name;
    if (!$('mesh').querySelector('[value=file]')) $('mesh').append(element('option', { value: 'file' }));
    $('mesh').querySelector('[value=file]').textContent = file.name;
    const settings = Object.fromEntries(OF_FILE.map((key) => [key, DEFAULTS[key]]));
    set({ mesh: 'file', ...settings, ...awaited.model?.settings });
  } catch (problem) {
    say(`${file.name}: ${problem.message}`, true);
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
  library.picture(width, new Uint8Array(context.getImageData(0, 0, width, height).data.buffer));
  if (!$('texture').querySelector('[value=file]')) $('texture').append(element('option', { value: 'file' }));
  $('texture').querySelector('[value=file]').textContent = file.name;
  pictureName = file.name;
  set({ style: 'textured', texture: 'file' });
}

// A model, its material libraries and a picture may be dropped together: the libraries first, so that the model is drawn in their colours.
async function openAll(files) {
  for (const file of [...files].sort((a, b) => isLibrary(b) - isLibrary(a))) await open(file);
}

const isLibrary = ({ name }) => /\.mtl$/i.test(name);

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
