// What the RP2040's ROM asks of the second stage of booting, after section 2.8.1 of the data sheet.

export const FLASH = 0x10000000;

/** CRC-32 with the polynomial 0x04c11db7, from ones, highest bit first: bytes 252 to 255 of flash have it of those before. */
export function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) crc = crc < 0 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  return crc >>> 0;
}
