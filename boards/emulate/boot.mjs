// An RP2040 with our boot ROM, and the start-up that the chip's own ROM does for the firmware.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const FLASH = 0x10000000;
const STAGE = 252;
const LOAD = 1;

/** The emulator, from the folder that boards/emulate/run has installed it in. */
export function rp2040js(folder) {
  return createRequire(`${resolve(folder)}/`)('rp2040js');
}

/** Puts the ROM into an emulated chip, and resets it. */
export function loadRom(mcu, rom) {
  for (const { address, bytes } of segments(rom)) {
    for (let i = 0; i + 3 < bytes.length; i += 4) mcu.bootrom[(address + i) / 4] = bytes.readUInt32LE(i);
  }
  mcu.reset();
}

/** Flashes an image. The chip's ROM starts only a second stage of booting with a CRC (section 2.8.1 of the data sheet). */
export function loadFlash(mcu, image) {
  for (const { address, bytes } of segments(image)) mcu.flash.set(bytes, address - FLASH);
  const crc = mcu.flashView.getUint32(STAGE, true);
  if (crc32(mcu.flash.subarray(0, STAGE)) !== crc) throw new Error('the second stage of booting has a wrong CRC');
}

/** CRC-32 with the polynomial 0x04c11db7, from ones, highest bit first. */
function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) crc = crc < 0 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  return crc >>> 0;
}

/**
 * The loadable segments of a 32-bit little-endian ELF file: where each lies in ROM or flash, and its bytes.
 * @returns {{address: number, bytes: Buffer}[]} by physical address, which is flash also for initial values of variables
 */
function segments(file) {
  const elf = readFileSync(file);
  if (elf.readUInt32BE(0) !== 0x7f454c46 || elf[4] !== 1 || elf[5] !== 1) throw new Error(`${file}: not a 32-bit ELF file`);
  const [table, size, count] = [elf.readUInt32LE(28), elf.readUInt16LE(42), elf.readUInt16LE(44)];
  const headers = Array.from({ length: count }, (_, i) => elf.subarray(table + i * size, table + (i + 1) * size));
  return headers
    .filter((header) => header.readUInt32LE(0) === LOAD && header.readUInt32LE(16) > 0)
    .map((header) => {
      const [offset, length] = [header.readUInt32LE(4), header.readUInt32LE(16)];
      return { address: header.readUInt32LE(12), bytes: elf.subarray(offset, offset + length) };
    });
}
