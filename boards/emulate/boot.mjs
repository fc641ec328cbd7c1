// An RP2040 with our boot ROM, and the start-up that the chip's own ROM does for the firmware.

import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { segments } from './elf.mjs';

const FLASH = 0x10000000;
const STAGE = 252;

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
