// The address of the page contains the state, so that a link shows the same picture.
'use strict';

// The address has the parts of the state that differ from the defaults. Files are not in it: a receiver of the link does not have
// them.
function writeAddress() {
  const isOfFile = (key, value) => ['mesh', 'texture'].includes(key) && value === 'file';
  const parts = Object.entries(state).filter(([key, value]) => value !== DEFAULTS[key] && !isOfFile(key, value));
  const text = parts.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join('&');
  history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
}

function readAddress() {
  const read = { ...DEFAULTS };
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (!(key in DEFAULTS)) continue;
    read[key] = NUMBERS.includes(key) ? Number(value) : value;
  }
  const named = menu.projections.find(({ name }) => name === read.projection);
  if (named && !location.hash.includes('yaw=')) read.yaw = named.yaw;
  if (named && !location.hash.includes('pitch=')) read.pitch = named.pitch;
  return read;
}
