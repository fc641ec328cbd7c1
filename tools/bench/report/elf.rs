//! Sizes of an image's sections, from its ELF file of 32 bits.

use crate::Result;
use std::ops::Range;
use std::path::Path;

/// The sizes of an image in bytes.
pub(crate) struct Sizes {
    /// Bytes of flash: code, constants and the start values of variables.
    pub(crate) flash: u64,
    /// Bytes of RAM that are taken from the start: variables.
    pub(crate) statics: u64,
    /// The addresses of the instructions.
    pub(crate) code: Range<u64>,
    /// Their place in the file.
    code_offset: Range<usize>,
}

/// The bytes of an image's code, from the address in [`Sizes`] on.
pub(crate) fn code(image: &Path) -> Result<Vec<u8>> {
    let at = sizes(image)?.code_offset;
    let file = std::fs::read(image)?;
    Ok(file.get(at).ok_or_else(|| format!("{}: its code is cut off", image.display()))?.to_vec())
}

pub(crate) fn sizes(image: &Path) -> Result<Sizes> {
    let file = std::fs::read(image).map_err(|error| format!("{}: {error}", image.display()))?;
    let short = || format!("{}: no ELF file of 32 bits", image.display());
    if !file.starts_with(b"\x7fELF\x01\x01") {
        return Err(short().into());
    }
    let half = |at: usize| file.get(at..at + 2).map(|b| usize::from(b[0]) | usize::from(b[1]) << 8);
    let word = |at: usize| Some(half(at)? | half(at + 2)? << 16);
    let header = || {
        let (table, size, count) = (word(32)?, half(46)?, half(48)?);
        let names = word(table + half(50)? * size + 16)?;
        let mut sizes = Sizes { flash: 0, statics: 0, code: 0..0, code_offset: 0..0 };
        for section in 0..count {
            let at = table + section * size;
            let (kind, flags) = (word(at + 4)?, word(at + 8)?);
            let (from, bytes) = (word(at + 12)? as u64, word(at + 20)? as u64);
            let (allocated, writable, empty) = (flags & 2 != 0, flags & 1 != 0, kind == 8);
            // The section of the RAM that riscv-rt leaves free.
            let name = file.get(names + word(at)?..)?;
            if name.starts_with(b".stack\0") || name.starts_with(b".heap\0") {
                continue;
            }
            if flags & 4 != 0 && bytes > 0 {
                // One section, of link.x; what an assembler puts into another lies behind it.
                let offset = word(at + 16)?;
                if sizes.code.is_empty() {
                    (sizes.code.start, sizes.code_offset.start) = (from, offset);
                }
                (sizes.code.end, sizes.code_offset.end) = (from + bytes, offset + bytes as usize);
            }
            // Memory that starts empty takes no flash.
            sizes.flash += if allocated && !empty { bytes } else { 0 };
            sizes.statics += if allocated && writable { bytes } else { 0 };
        }
        Some(sizes)
    };
    Ok(header().ok_or_else(short)?)
}
