//! Sizes of an image's sections, and its symbols, from its ELF file.

use crate::Result;
use object::read::elf::ElfFile32;
use object::{elf, Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind};
use std::ops::Range;
use std::path::Path;

/// The sizes of an image in bytes.
#[derive(Default)]
pub(crate) struct Sizes {
    /// Bytes of flash: code, constants and the start values of variables.
    pub(crate) flash: u64,
    /// Bytes of RAM that are taken from the start: variables.
    pub(crate) statics: u64,
    /// The addresses of the instructions.
    pub(crate) code: Range<u64>,
    /// The bytes of the instructions.
    pub(crate) bytes: Vec<u8>,
}

fn read<T>(image: &Path, of: impl FnOnce(&ElfFile32<'_>) -> object::Result<T>) -> Result<T> {
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", image.display());
    let file = std::fs::read(image).map_err(|error| named(&error))?;
    Ok(ElfFile32::parse(&*file).and_then(|file| of(&file)).map_err(|error| named(&error))?)
}

pub(crate) fn sizes(image: &Path) -> Result<Sizes> {
    read(image, |file| {
        let mut sizes = Sizes::default();
        for section in file.sections() {
            // The sections of the RAM that riscv-rt leaves free.
            if matches!(section.name()?, ".stack" | ".heap") {
                continue;
            }
            let SectionFlags::Elf { sh_flags } = section.flags() else { continue };
            let has = |flag: u32| sh_flags & u64::from(flag) != 0;
            if has(elf::SHF_EXECINSTR) && section.size() > 0 {
                // One section, of link.x; what an assembler puts into another lies behind it.
                if sizes.code.is_empty() {
                    (sizes.code.start, sizes.bytes) = (section.address(), section.data()?.to_vec());
                }
                sizes.code.end = section.address() + section.size();
            }
            // Memory that starts empty takes no flash.
            let is_empty = section.kind() == SectionKind::UninitializedData;
            sizes.flash += if has(elf::SHF_ALLOC) && !is_empty { section.size() } else { 0 };
            sizes.statics += if has(elf::SHF_ALLOC) && has(elf::SHF_WRITE) { section.size() } else { 0 };
        }
        Ok(sizes)
    })
}

/// The names of an image's symbols.
pub(crate) fn symbols(image: &Path) -> Result<Vec<String>> {
    read(image, |file| file.symbols().map(|symbol| Ok(symbol.name()?.to_string())).collect())
}
