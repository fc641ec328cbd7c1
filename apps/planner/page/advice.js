// What to change so that a way to draw fits a chip. For the page and for node.
'use strict';

const HEIGHTS = [48, 32, 24, 16, 12, 8, 6, 4, 2, 1];

// The rows of a band, and the number of faces, with which a way to draw would fit: `rows` and `faces` each do it alone, `both` are the two
// where neither does. `faces` are those that the model has.
function advised(costs, way, faces) {
  if (way.fits && way.fitsFlash) return {};
  const [cache, bins, pixels, depths, ...others] = way.parts;
  const height = way.rows || 1; // a whole picture is as one row
  const aRow = (pixels + depths) / height;
  const room = way.room - way.beside - 1 - others.reduce((sum, bytes) => sum + bytes, 0);
  const smooths = /smooth edges$/.test(way.name);
  const least = smooths ? 4 : 1; // and two that wait
  const lower = (most) => HEIGHTS.find((rows) => rows < way.rows && rows >= least && aRow * rows <= most);
  // What a mesh takes grows by its faces, in RAM and in flash.
  const inFlash = (way.rom - (way.flash - costs.mesh)) / costs.mesh;
  // A decimated surface has more edges a face, since fewer of its faces are flat together.
  const [, sure] = [['hidden lines', 0.6], ['lines', 0.9], ['', 0.95]].find(([start]) => way.name.startsWith(start));
  // The heads of bins, at most 32 of two bytes for faces or edges, become fewer by steps.
  const heads = smooths || way.name.startsWith('hidden lines') ? 128 : 64;
  const fewer = (rows) => {
    const most = sure * faces * Math.min((room - aRow * rows - heads) / (cache + bins), inFlash);
    // Two digits are as much as the estimate is good for.
    const digit = 10 ** Math.max(Math.floor(Math.log10(most)) - 1, 0);
    return most >= 4 && most < faces ? Math.floor(most / digit) * digit : undefined;
  };
  const advice = { rows: way.fitsFlash ? lower(room - cache - bins) : undefined, faces: fewer(height) };
  // A few faces of a model show nothing of it, and decimation does not get there.
  if (advice.faces < faces / 8) advice.faces = undefined;
  if (advice.rows || advice.faces) return advice;
  // Half of the room for the mesh.
  const rows = Math.min(lower(room / 2) ?? height, height);
  const few = fewer(rows);
  // Edges that are not smoothed are better than a few faces.
  return few && !(smooths && few < faces / 8) ? { both: { rows, faces: few } } : {};
}

Object.assign(globalThis, { advised });
