// Downloads: pictures, films, firmware and links.
'use strict';

function save(name, blob) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const modelName = () => (state.mesh === 'file' ? fileName.replace(/\.[^.]*$/, '') : state.mesh);

function savePng() {
  $('display').toBlob((blob) => save(`${modelName()}.png`, blob));
}

// The frames are made one by one. The cancel button, another file or another picture ends the film.
let filming = false;

async function saveGif() {
  const name = `${modelName()}.gif`;
  filming = true;
  $('gif').disabled = true;
  $('filming').hidden = false;
  $('filmed').value = 0;
  $('doing').textContent = 'Frames of the turn';
  $('cancel').focus();
  try {
    const bytes = await library.gif(choice(), async (done, all) => {
      [$('filmed').max, $('filmed').value] = [all, done];
      return filming;
    });
    if (bytes) save(name, new Blob([bytes], { type: 'image/gif' }));
    else say('The film was cancelled.');
  } catch (problem) {
    say(problem.message, true);
  }
  const hadFocus = $('filming').contains(document.activeElement);
  $('filming').hidden = true;
  $('gif').disabled = filming = false;
  if (hadFocus) $('gif').focus();
}

// Runs an action that saves a file, and shows a message if it fails.
function saved(action) {
  return async () => {
    try {
      await action();
    } catch (problem) {
      say(problem.message, true);
    }
  };
}

// The choice without a turn, because the firmware turns the model itself.
const still = () => choice({ ...state, turn: 0 });

async function saveZip() {
  const board = $('board').value;
  save(`${board}.zip`, new Blob([await library.zip(board, still())], { type: 'application/zip' }));
}

// Saves one file of the firmware's own code.
async function saveSource(name) {
  save(name, new Blob([await library.source($('board').value, still(), name)]));
}

async function saveRust() {
  save(`${modelName()}.rs`, new Blob([await library.ask('rust', choice())]));
}

async function copyLink() {
  writeAddress();
  const isFile = state.mesh === 'file' || state.texture === 'file' ? ' Your files are not part of it: who opens it is asked for them.' : '';
  try {
    await navigator.clipboard.writeText(location.href);
    say(`The link is in the clipboard.${isFile}`);
  } catch {
    say(`The link is in the address bar.${isFile}`);
  }
}
