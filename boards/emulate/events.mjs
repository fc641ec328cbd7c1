// The records by which an emulator reports on standard output; src/events.rs reads them. A record has 8 bytes: a value, a kind,
// and a time of 48 bits in nanoseconds, which suffice for three days; little-endian.

import { writeSync } from 'node:fs';

/** A byte on the bus: bit 0 is the D/C line at its last bit (high for data), bit 1 the select line (high if not selected). */
export const BYTE = 0x00;
/** A pin has changed: its number, and its level in bit 7. */
export const PIN = 0x10;
/** A byte of the log. */
export const LOG = 0x20;
/** In place of the time: how long the core has waited for the bus since the last of these records. */
export const WAITED = 0x30;
/** Nothing but the time. */
export const TIME = 0x40;
/** In place of the time: how long a byte takes on the bus, from now on. */
export const CLOCK = 0x60;
/** The emulator has broken the bus, as it was asked to. */
export const BROKEN = 0x50;

const buffer = Buffer.alloc(1 << 16);
let filled = 0;

export function report(kind, value, nanoseconds) {
  buffer[filled] = value;
  buffer[filled + 1] = kind;
  buffer.writeUIntLE(Math.round(nanoseconds), filled + 2, 6);
  filled += 8;
  if (filled === buffer.length) flush();
}

export function flush() {
  for (let written = 0; written < filled; ) {
    try {
      written += writeSync(1, buffer, written, filled - written);
    } catch (error) {
      // The reader has seen enough.
      if (error.code === 'EPIPE') process.exit(0);
      throw error;
    }
  }
  filled = 0;
}
