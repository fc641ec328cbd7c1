//! The registers of an ILI9341, which `panel.rs` writes.

use embedded_graphics_core::geometry::Point;

/// Where the glass's first pixel lies in the controller's memory.
pub const OFFSET: Point = Point::zero();
/// Commands with their parameters, of which a panel remembers the effect. Other controllers need more: their data sheets, and the
/// models of the crate mipidsi, have them.
pub const REGISTERS: [(u8, &[u8]); 7] = [
    (0x36, &[0x48]), // MADCTL: columns from right to left, rows as they are read, and blue before red
    (0xb1, &[0x01, 0x18]), // FRMCTR1: 40 refreshes a second in place of 70, so that fewer of them show two frames
    (0xb4, &[0x00]),       // DIC: inverts the voltage by lines
    (0x20, &[]),           // INVOFF; 0x21, INVON, for a glass whose colours are inverted
    (0x3a, &[0x55]),       // COLMOD: 16 bits a pixel
    (0x13, &[]),           // NORON
    (0x29, &[]),           // DISPON
];
