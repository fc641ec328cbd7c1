// The library: calls of its exports, with texts and bytes passed through its memory. For the page and for node.
'use strict';

class Pinhole {
  // From the bytes of the library.
  static async from(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Pinhole(instance.exports);
  }

  constructor(exports) {
    this.exports = exports;
  }

  // A name, and the bytes of its file.
  load(name, bytes) {
    const start = new TextEncoder().encode(name);
    const input = this.input(start.length + bytes.length);
    input.set(start);
    input.set(bytes, start.length);
    this.answer(this.exports.load(start.length));
  }

  // A picture for textures: its width, and red, green, blue and opacity of its pixels.
  picture(width, bytes) {
    this.input(bytes.length).set(bytes);
    this.answer(this.exports.picture(width));
  }

  menu() {
    return JSON.parse(this.answer(this.exports.menu()));
  }

  // The pixels of a choice and what the frame was; throws an Error with a message for the user.
  draw(choice) {
    this.write(choice);
    const about = JSON.parse(this.answer(this.exports.draw()));
    const pixels = new Uint8ClampedArray(this.exports.memory.buffer, this.exports.pixels(), this.exports.pixels_len());
    return { pixels, about };
  }

  // A turn of the model as the bytes of a GIF file. After each frame, `goesOn` gets how many are done and all that there are: its
  // promise is of whether to go on. Otherwise there is no file.
  async gif(choice, goesOn) {
    let [done, all] = [0, 1];
    while (done < all) {
      [done, all] = this.ask('film', done === 0 ? choice : '').split(' ').map(Number);
      if (!(await goesOn(done, all))) return null;
    }
    return this.bytes('gif', '');
  }

  // The name that the model's file has in a firmware, and its bytes.
  model(choice) {
    const bytes = this.bytes('model', choice);
    const end = bytes.indexOf(0);
    return [new TextDecoder().decode(bytes.subarray(0, end)), bytes.subarray(end + 1)];
  }

  // A function from a text to bytes.
  bytes(name, text) {
    this.write(text);
    const isGood = this.exports[name]();
    const bytes = new Uint8Array(this.exports.memory.buffer, this.exports.output(), this.exports.output_len()).slice();
    if (!isGood) throw new Error(new TextDecoder().decode(bytes));
    return bytes;
  }

  // A function from a text to a text.
  ask(name, text) {
    this.write(text);
    return this.answer(this.exports[name]());
  }

  write(text) {
    const bytes = new TextEncoder().encode(text);
    this.input(bytes.length).set(bytes);
  }

  // The memory may have moved: a view is of one call only.
  input(length) {
    const start = this.exports.input(length);
    return new Uint8Array(this.exports.memory.buffer, start, length);
  }

  answer(isGood) {
    const bytes = new Uint8Array(this.exports.memory.buffer, this.exports.output(), this.exports.output_len());
    const text = new TextDecoder().decode(bytes);
    if (!isGood) throw new Error(text);
    return text;
  }
}

globalThis.Pinhole = Pinhole;
