//! Sizes of an image's sections, and its symbols, from its ELF file; and the source of each byte of its code, with functions that
//! vanished by inlining, from its debug information, which `llvm-symbolizer` reads.

use crate::{core, Result};
use object::read::elf::ElfFile32;
use object::{elf, Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind};
use std::io::Write;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};

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

/// The library's code: for each address the chain of functions inlined there.
pub(crate) struct Provenance {
    start: u64,
    places: Vec<Place>,
}

/// The functions at an address, the innermost first.
pub(crate) type Place = Vec<Frame>;

/// One function at an address; in [`Provenance`], `file` is relative to `src`, such as `raster/line.rs`.
#[derive(Clone)]
pub(crate) struct Frame {
    pub(crate) file: String,
    pub(crate) function: String,
}

/// An instruction takes two bytes or four.
pub(crate) const STEP: u64 = 2;

/// For every [`STEP`] of an image's code the functions there, the innermost first, with the whole paths of their files.
pub(crate) fn frames(image: &Path) -> Result<Vec<Place>> {
    let mut symbolizer = Command::new("llvm-symbolizer");
    symbolizer.args(["--inlines", "--demangle", "--output-style=LLVM"]).arg("--obj").arg(image);
    let mut child = symbolizer.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let child = child.as_mut().map_err(|error| format!("llvm-symbolizer (Debian: llvm): {error}"))?;
    let code = sizes(image)?.code;
    let mut questions = child.stdin.take().ok_or("its input")?;
    let asker = std::thread::spawn(move || {
        code.step_by(STEP as usize).try_for_each(|at| writeln!(questions, "{at:#x}"))
    });
    let mut text = String::new();
    std::io::Read::read_to_string(&mut child.stdout.take().ok_or("its output")?, &mut text)?;
    asker.join().map_err(|_| "the thread that asks")??;
    child.wait()?;
    // An answer is pairs of lines, a function and its source location, then an empty line.
    let places = text.split("\n\n").map(|answer| {
        let lines: Vec<&str> = answer.lines().collect();
        let frame = |pair: &[&str]| {
            let file = pair.get(1)?.split(':').next()?.to_string();
            Some(Frame { file, function: without_hash(pair[0]).to_string() })
        };
        lines.chunks(2).filter_map(frame).collect()
    });
    Ok(places.collect())
}

/// A function's name without the `::h` and sixteen digits that some compilers put behind it.
fn without_hash(name: &str) -> &str {
    let is_hash = |hash: &str| hash.len() == 16 && hash.bytes().all(|byte| byte.is_ascii_hexdigit());
    match name.rsplit_once("::h") {
        Some((name, hash)) if is_hash(hash) => name,
        _ => name,
    }
}

impl Provenance {
    pub(crate) fn of(image: &Path) -> Result<Self> {
        let library = core::root().join("src");
        let within = |mut frame: Frame| {
            frame.file = Path::new(&frame.file).strip_prefix(&library).ok()?.display().to_string();
            Some(frame)
        };
        let places = frames(image)?.into_iter();
        let places = places.map(|place| place.into_iter().filter_map(within).collect()).collect();
        Ok(Self { start: sizes(image)?.code.start, places })
    }

    /// The library's functions at an address, the innermost first.
    pub(crate) fn at(&self, address: u32) -> Option<&[Frame]> {
        let index = u64::from(address).checked_sub(self.start)? / STEP;
        Some(self.places.get(index as usize)?)
    }

    /// Bytes of this file or folder, and of the functions inlined into it.
    pub(crate) fn because_of(&self, part: &str) -> u64 {
        let is_part = |frame: &Frame| frame.file.starts_with(part);
        STEP * self.places.iter().filter(|place| place.iter().any(is_part)).count() as u64
    }
}
