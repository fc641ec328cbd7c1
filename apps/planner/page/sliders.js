// What sliders need beside their own value: logarithmic scales, the faces of a decimation, and the angles of the lamp, which are more
// than its direction.
'use strict';

const ZOOMS = [20, 2000]; // per cent, as in the library
const STEPS = 200; // of a logarithmic slider

// The whole number at the slider's position, from `least` to `most`.
const numberAt = (slider, [least, most]) => Math.round(least * (most / least) ** (slider.value / STEPS));

// Moves the slider to a number, unless its position stands for this number: near the low end several positions do, and a key could
// not pass them.
function moveSlider(slider, [least, most], number) {
  if (most > least && numberAt(slider, [least, most]) !== number) slider.value = Math.round((STEPS * Math.log(number / least)) / Math.log(most / least));
}

// From 4 faces to all. All faces of a model that is too large are not known until it is decimated: then the slider reaches twice the
// most vertices of a mesh, about as many faces as these have.
const facesRange = () => [4, Math.max(allFaces || (isTooLarge ? 131_072 : 0), 4)];

// The faces that the slider stands for; at its end nothing is decimated, which is 0.
const decimated = () => (Number($('decimate').value) === STEPS ? 0 : numberAt($('decimate'), facesRange()));

function showDecimation(decimate) {
  const [, most] = facesRange();
  const isAll = !decimate || (allFaces > 0 && decimate >= allFaces);
  $('decimation').hidden = !menu.decimates || !(drawnModel || isTooLarge);
  $('decimate').disabled = $('decimate-to').disabled = most <= 4; // nothing is left to decimate
  if (isAll) $('decimate').value = STEPS;
  else if (decimated() !== decimate) moveSlider($('decimate'), facesRange(), Math.min(decimate, most));
  $('decimate-to').max = allFaces || 1_000_000;
  $('decimate-to').value = decimate || '';
  const all = allFaces === 1 ? '' : 'all ';
  showValue('decimate', isAll ? (allFaces ? `${all}${counted(allFaces, 'face')}` : 'all faces') : `${count(decimate)}${allFaces ? ` of ${count(allFaces)}` : ''} faces`);
}

// The angles to the lamp in degrees, and the direction that they were of. A lamp overhead has an angle around, too, to which it
// comes down again.
const lamp = { around: 0, above: 0, light: '' };

function readLamp() {
  if (lamp.light === state.light) return;
  const [x, y, z] = state.light.split(',').map(Number);
  const degrees = (radians) => Math.round((radians * 1800) / Math.PI) / 10;
  Object.assign(lamp, { around: degrees(Math.atan2(x, z)), above: degrees(Math.atan2(y, Math.hypot(x, z))), light: state.light });
}

function moveLamp(angle, degrees) {
  lamp[angle] = degrees;
  const [around, above] = [lamp.around, lamp.above].map((degrees) => (degrees * Math.PI) / 180);
  const direction = [Math.sin(around) * Math.cos(above), Math.sin(above), Math.cos(around) * Math.cos(above)];
  lamp.light = direction.map((c) => Math.round(60 * c) + 0).join(',');
  set({ light: lamp.light });
}
