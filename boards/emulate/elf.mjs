// The loadable segments of a 32-bit little-endian ELF file: where each lies in ROM or flash, and its bytes.

import { readFileSync } from 'node:fs';

const LOAD = 1;

/** @returns {{address: number, bytes: Buffer}[]} by physical address, which is flash also for initial values of variables */
export function segments(file) {
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
