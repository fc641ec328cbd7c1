//! The registers of an ST7789, which `panel.rs` writes.

use embedded_graphics_core::geometry::Point;

/// Where the glass's first pixel lies in the ST7789's memory, which is 240 × 320: (0, 80) on modules that show the lower part of it.
pub const OFFSET: Point = Point::zero();
/// Commands with their parameters, of which a panel remembers the effect. Other controllers need more: their data sheets, and the
/// models of the crate mipidsi, have them.
pub const REGISTERS: [(u8, &[u8]); 6] = [
    (0x36, &[0x00]), // MADCTL: columns from left to right, rows from top to bottom, red before blue
    (0x21, &[]),     // INVON, for a glass whose colours are inverted; 0x20, INVOFF, for another
    (0x3a, &[0x55]), // COLMOD: 16 bits a pixel
    (0x13, &[]),     // NORON
    (0x35, &[0x00]), // TEON: the pin TE is high while the panel reads no row
    (0x29, &[]),     // DISPON
];
