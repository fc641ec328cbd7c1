// The library: wraps the calls of its exports, which exchange texts and bytes through its memory. For the page and for node.
'use strict';

class Pinhole {
  // Makes a library from its WebAssembly bytes.
  static async from(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Pinhole(instance.exports);
  }

  constructor(exports) {
    this.exports = exports;
  }

  // Loads a model: the name of a file, and its bytes.
  load(name, bytes) {
    const start = new TextEncoder().encode(name);
    const input = this.input(start.length + bytes.length);
    input.set(start);
    input.set(bytes, start.length);
    this.answer(this.exports.load(start.length));
  }

  // Loads a picture for textures: its width, and red, green, blue and opacity of its pixels.
  picture(width, bytes) {
    this.input(bytes.length).set(bytes);
    this.answer(this.exports.picture(width));
  }

  menu() {
    return JSON.parse(this.answer(this.exports.menu()));
  }

  // Draws a choice. Returns the pixels and a description of the frame.
  draw(choice) {
    this.write(choice);
    const about = JSON.parse(this.answer(this.exports.draw()));
    const pixels = new Uint8ClampedArray(this.exports.memory.buffer, this.exports.pixels(), this.exports.pixels_len());
    return { pixels, about };
  }

  // A turn of the model as the bytes of a GIF file. After each frame, `goesOn` gets the number of frames done and the number of
  // all frames, and promises whether to go on. If not, the result is `null`.
  async gif(choice, goesOn) {
    let [done, all] = [0, 1];
    while (done < all) {
      [done, all] = (await this.ask('film', done === 0 ? choice : '')).split(' ').map(Number);
      if (!(await goesOn(done, all))) return null;
    }
    return this.bytes('gif', '');
  }

  // The files of the model in a firmware, itself and its material libraries: for each its name and its bytes.
  model(choice) {
    let bytes = this.bytes('model', choice);
    const word = () => {
      const end = bytes.indexOf(0);
      const text = new TextDecoder().decode(bytes.subarray(0, end));
      bytes = bytes.subarray(end + 1);
      return text;
    };
    const files = [];
    while (bytes.length) {
      const [name, length] = [word(), Number(word())];
      files.push([name, bytes.subarray(0, length)]);
      bytes = bytes.subarray(length);
    }
    return files;
  }

  // Calls an export that takes a text and returns bytes.
  bytes(name, text) {
    this.write(text);
    const isGood = this.exports[name]();
    const bytes = new Uint8Array(this.exports.memory.buffer, this.exports.output(), this.exports.output_len()).slice();
    if (!isGood) refuse(new TextDecoder().decode(bytes));
    return bytes;
  }

  // Calls an export that takes a text and returns a text.
  ask(name, text) {
    this.write(text);
    return this.answer(this.exports[name]());
  }

  write(text) {
    const bytes = new TextEncoder().encode(text);
    this.input(bytes.length).set(bytes);
  }

  // Growing memory may move it, so a view is valid for one call only.
  input(length) {
    const start = this.exports.input(length);
    return new Uint8Array(this.exports.memory.buffer, start, length);
  }

  answer(isGood) {
    const bytes = new Uint8Array(this.exports.memory.buffer, this.exports.output(), this.exports.output_len());
    const text = new TextDecoder().decode(bytes);
    if (!isGood) refuse(text);
    return text;
  }
}

// Throws an Error with a message for the user, and the buttons of its remedies.
function refuse(text) {
  const { message, remedies } = JSON.parse(text);
  throw Object.assign(new Error(message), { remedies });
}

globalThis.Pinhole = Pinhole;
