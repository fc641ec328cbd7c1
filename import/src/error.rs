use crate::host::shown;
use crate::remedy::{for_finer_grid, messages, said, Remedy, Said};
use crate::warning::{Warning, MOST_FACES};
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file could not be turned into a mesh: the file, the line where that is known, and what is wrong with it.
///
/// Its `Display` is one line, `file:line: problem`, and so is its `Debug`: that is what a program prints whose `main` returns the
/// error. It says what to do by the options of the command line.
pub struct ImportError {
    /// The file, as the caller named it.
    pub file: PathBuf,
    /// The line of the file, counted from 1, if the problem lies in one line.
    pub line: Option<usize>,
    /// The problem.
    pub problem: Problem,
}

messages! {
    /// The problems that a model can have.
    #[derive(Debug)]
    #[allow(missing_docs)] // of fields: said with each variant
    #[non_exhaustive]
    pub enum Problem {
        /// The file cannot be opened or read.
        Read(error: std::io::Error) => ["cannot be read: {error}"]
        /// The Rust file cannot be written.
        Write(error: std::io::Error) => ["cannot be written: {error}"]
        /// The file's extension is none that this crate reads.
        UnknownFormat => ["is not a model this program reads: ", ExportFormat]
        /// The file has more bytes than this crate reads, 2³⁰.
        TooLarge => ["has more than 1 GiB: ", ReduceModel]
        /// A line cannot be understood; the text says what was expected.
        Syntax(what: &'static str) => ["{what}"]
        /// The file cannot be understood; the text is its parser's.
        Format(what: String) => ["{what}"]
        /// The file should be text, but is binary: this byte, counted from 0, is the first that is zero.
        NotText { byte: usize } => ["is binary, not text, as byte {byte} is zero: ", ExportFormat]
        /// The file ends too soon: by what it says it needs more bytes than are given. The first one missing, counted from 0, is byte `given`.
        Truncated { needed: u64, given: u64 } => {
            let what = match given {
                0 => "is empty: ".into(),
                _ => format!("ends before byte {given}, but should have {needed} bytes: "),
            };
            Said::new(what, [CopyAgain])
        }
        /// A face names a vertex that the file does not have.
        NoSuchVertex => ["the face names a vertex that does not exist: ", ExportAgain]
        /// A coordinate is NaN or infinite, or becomes so when it is divided by its `w`.
        NotFinite => ["a coordinate is not a finite number: ", Repair]
        /// The coordinate of a binary file that begins with this byte, counted from 0, is NaN or infinite.
        NotFiniteAt { byte: usize } => ["the coordinate at byte {byte} is not a finite number: ", Repair]
        /// The model has no face, and no line.
        NoFaces => ["has no faces: ", ExportMesh]
        /// An object of this name is wanted ([`Options::objects`](crate::Options::objects)), but the file has those of these names.
        NoSuchObject { name: String, names: Vec<String> } => {
            let others = match names.is_empty() {
                true => ", as none has a name".into(),
                false => format!("; its objects and groups are {}", names.join(", ")),
            };
            Said::new(format!("has no object {name}{others}"), [])
        }
        /// The model does not fit the grid of [`Options::step`](crate::Options::step); the finest that it fits has a step of 2 to
        /// this power.
        Step(finest: i8) => ["does not fit the grid: the finest step that it fits is 2^{finest}: ", Step(*finest)]
        /// None of the model's faces, as many as this, has an area.
        NoArea(faces: usize) => ["has no face with an area, as all {faces} are points or lines: ", ExportMesh]
        /// All of the model's faces, as many as this, lose their area by rounding to the grid. `finer`: the option that gives a finer grid, if one does.
        TooThin { faces: usize, finer: Option<Remedy> } => {
            let grid = "a grid of at most 65535 steps along its longest side";
            let what = format!("has no face with an area on {grid}, as all {faces} are thinner than a step: ");
            Said::new(what, for_finer_grid(*finer))
        }
        /// More vertices than `u16` indices can name (65 536), after welding.
        TooManyVertices(n: usize) => ["has {n} vertices, more than the 65536 of a mesh: ", Decimate(MOST_FACES), SplitModel]
        /// More faces than can be named beside an edge (65 535).
        TooManyFaces(n: usize) => [
            "has {n} faces, more than the 65535 that can be named beside edges: ", NoEdgeFaces, Decimate(MOST_FACES)
        ]
        /// The largest extent (in model units) is beyond what an exponent of `i8` can scale.
        Extent(extent: f64) => ["has an extent of {extent:.2e}, out of range: ", OtherUnit, Fit]
        /// The step of the grid, 2 to this power, is beyond what a mesh may have.
        Exponent(exponent: i8) => ["needs a step of 2^{exponent}, but a mesh has 2^-32 to 2^15: ", OtherUnit, Fit]
        /// An option has a value that makes no sense; the text says which.
        Options(what: &'static str) => ["{what}"]
        /// A texture is wanted of a build that reads no pictures.
        NoTextures => ["has a texture, but this build reads no pictures: ", Feature("textures")]
        /// Clusters are wanted of a build that makes none.
        NoClusters => ["cannot be ordered into clusters by this build: ", Feature("clusters")]
        /// Decimation is wanted of a build without it.
        NoDecimation => {
            let what = Said::new("cannot be decimated by this build: ", [Feature("decimate")]);
            Said { then: ", which needs a C++ compiler", ..what }
        }
    }
}

impl Problem {
    /// The problem with the file it stands in.
    pub(crate) fn at(self, file: &Path, line: Option<usize>) -> ImportError {
        ImportError { file: file.to_owned(), line, problem: self }
    }

    /// The warning of a program that shows the model all the same.
    pub(crate) fn as_warning(&self) -> Warning {
        let Said { what, remedies, .. } = self.said();
        Warning::NotForFirmware { problem: what, remedies }
    }
}

impl ImportError {
    /// The file, and the line if it is known.
    pub(crate) fn location(&self) -> String {
        let file = shown(&self.file.to_string_lossy());
        self.line.map_or_else(|| file.clone(), |line| format!("{file}:{line}"))
    }

    /// The message in one line, with the remedies in a program's own words: imperatives such as "use --flip".
    pub fn worded(&self, words: impl Fn(Remedy) -> String) -> String {
        format!("{}: {}", self.location(), self.problem.worded(words))
    }
}

impl fmt::Debug for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.worded(|remedy| remedy.to_string()))
    }
}

impl Error for Problem {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Problem::Read(error) | Problem::Write(error) => Some(error),
            _ => None,
        }
    }
}

impl Error for ImportError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(&self.problem)
    }
}
