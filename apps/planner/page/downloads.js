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

// The frames are made one by one. Between two of them the page handles events: the cancel button, another file or another picture
// ends the film.
let filming = false;

async function saveGif() {
  const name = `${modelName()}.gif`;
  filming = true;
  $('gif').disabled = true;
  $('filming').hidden = false;
  $('filmed').value = 0;
  $('cancel').focus();
  try {
    const bytes = await library.gif(choice(), async (done, all) => {
      [$('filmed').max, $('filmed').value] = [all, done];
      await new Promise((listened) => setTimeout(listened));
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
  return () => {
    try {
      action();
    } catch (problem) {
      say(problem.message, true);
    }
  };
}

// The choice without a turn, because the firmware turns the model itself.
const still = () => choice({ ...state, turn: 0 });

function saveZip() {
  const board = $('board').value;
  save(`${board}.zip`, new Blob([zip(firmware(library, templates, board, still()))], { type: 'application/zip' }));
}

// Saves one file of the firmware's own code.
function saveSource(name) {
  const files = firmware(library, templates, $('board').value, still());
  save(name, new Blob([files.get(`firmware/src/${name}`)]));
}

function saveRust() {
  save(`${modelName()}.rs`, new Blob([library.ask('rust', choice())]));
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
