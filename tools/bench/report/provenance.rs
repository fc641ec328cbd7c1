//! Which source each byte of an image's code comes from, functions that vanished by inlining included: from the
//! image's debug information, which `llvm-symbolizer` reads.

use crate::{cross, elf, Result};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Code of the library, by the chain of calls that were inlined into one another at one place.
pub(crate) struct Provenance {
    places: Vec<Vec<Frame>>,
}

/// One function of the library at one place; `file` is like `raster/line.rs`.
struct Frame {
    file: String,
    function: String,
}

/// The code of a folder or file, or of one function in it.
#[derive(Clone, Copy)]
pub(crate) struct Part(pub(crate) &'static str, pub(crate) Option<&'static str>);

/// An instruction takes two bytes or four.
const STEP: u64 = 2;

impl Provenance {
    pub(crate) fn of(image: &Path) -> Result<Self> {
        let mut symbolizer = Command::new("llvm-symbolizer");
        symbolizer.args(["--inlines", "--demangle", "--output-style=LLVM"]).arg("--obj").arg(image);
        let mut child = symbolizer.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let child = child.as_mut().map_err(|error| format!("llvm-symbolizer (Debian: llvm): {error}"))?;
        let code = elf::sizes(image)?.code;
        let mut questions = child.stdin.take().ok_or("its input")?;
        let asker = std::thread::spawn(move || {
            code.step_by(STEP as usize).try_for_each(|at| writeln!(questions, "{at:#x}"))
        });
        let mut text = String::new();
        std::io::Read::read_to_string(&mut child.stdout.take().ok_or("its output")?, &mut text)?;
        asker.join().map_err(|_| "the thread that asks")??;
        child.wait()?;
        // An answer is pairs of lines, a function and its place, the innermost first; then an empty line.
        let library = cross::root().join("src");
        let places = text.split("\n\n").map(|answer| {
            let lines: Vec<&str> = answer.lines().collect();
            let frame = |pair: &[&str]| {
                let path = pair.get(1)?.split(':').next()?;
                let file = Path::new(path).strip_prefix(&library).ok()?;
                Some(Frame { file: file.display().to_string(), function: pair[0].to_string() })
            };
            lines.chunks(2).filter_map(frame).collect()
        });
        Ok(Self { places: places.collect() })
    }

    /// Bytes that were written in one of these files, or inlined there from other libraries.
    pub(crate) fn of_file(&self, file: &str) -> u64 {
        let innermost = |place: &&Vec<Frame>| place.first().is_some_and(|frame| frame.file.starts_with(file));
        STEP * self.places.iter().filter(innermost).count() as u64
    }

    /// Bytes that are there because of this part: its own and what it calls, where that was inlined.
    pub(crate) fn because_of(&self, Part(file, function): Part) -> u64 {
        let named = |frame: &Frame| function.is_none_or(|name| frame.function.contains(name));
        let part = |frame: &Frame| frame.file.starts_with(file) && named(frame);
        STEP * self.places.iter().filter(|place| place.iter().any(part)).count() as u64
    }
}
