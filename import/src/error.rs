use crate::script;
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file could not be turned into a mesh: the file, the line where that is known, and what is wrong with it.
///
/// Its `Display` is one line, `file:line: problem`, and so is its `Debug`: that is what a `build.rs` prints whose `main` returns
/// the error. It says what to do by the options of the command line, but from [`build`](crate::build) by the fields of
/// [`Options`](crate::Options).
pub struct ImportError {
    /// The file, as the caller named it.
    pub file: PathBuf,
    /// The line of the file, counted from 1, if the problem lies in one line.
    pub line: Option<usize>,
    /// The problem.
    pub problem: Problem,
    /// Whether the message is for the user of a build script, who has no command line.
    pub(crate) in_script: bool,
}

/// The problems that a model can have.
#[derive(Debug)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be opened or read.
    Read(std::io::Error),
    /// The Rust file cannot be written.
    Write(std::io::Error),
    /// The file's extension is none that this crate reads.
    UnknownFormat,
    /// The file has more bytes than this crate reads, 2³⁰.
    TooLarge,
    /// A line cannot be understood; the text says what was expected.
    Syntax(&'static str),
    /// The file cannot be understood; the text is its parser's.
    Format(String),
    /// The file should be text, but is binary.
    NotText {
        /// The place, counted from 0, of the first byte that is zero.
        byte: usize,
    },
    /// The file ends too soon.
    Truncated {
        /// How many bytes it says it has.
        needed: u64,
        /// How many there are: the first one missing has this number, counted from 0.
        given: u64,
    },
    /// A face names a vertex that the file does not have.
    NoSuchVertex,
    /// A coordinate is NaN or infinite, or becomes so when it is divided by its `w`.
    NotFinite,
    /// A coordinate of a binary file is NaN or infinite.
    NotFiniteAt {
        /// Where its first byte is, counted from 0.
        byte: usize,
    },
    /// The model has no face.
    NoFaces,
    /// None of the model's faces, as many as this, has an area.
    NoArea(usize),
    /// More vertices than `u16` indices can name (65 536), after welding.
    TooManyVertices(usize),
    /// More faces than can be named beside an edge (65 535).
    TooManyFaces(usize),
    /// The largest extent (in model units) is beyond what an exponent of `i8` can scale.
    Extent(f64),
    /// The step of the grid, 2 to this power, is beyond what a mesh may have.
    Exponent(i8),
    /// An option has a value that makes no sense; the text says which.
    Options(&'static str),
    /// A texture is wanted of a build that reads no pictures.
    NoTextures,
    /// Decimation is wanted of a build without it.
    NoDecimation,
}

impl Problem {
    /// The problem with the file it stands in.
    pub(crate) fn at(self, file: &Path, line: Option<usize>) -> ImportError {
        ImportError { file: file.to_owned(), line, problem: self, in_script: false }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Read(error) => write!(f, "cannot be read: {error}"),
            Problem::Write(error) => write!(f, "cannot be written: {error}"),
            Problem::UnknownFormat => f.write_str("is not a model this program reads: export .obj or .stl"),
            Problem::TooLarge => f.write_str("has more than 1 GiB: reduce it in a modelling program"),
            Problem::Syntax(what) => f.write_str(what),
            Problem::Format(what) => f.write_str(what),
            Problem::NotText { byte } => write!(f, "is binary, not text, as byte {byte} is zero: export .obj or .stl"),
            Problem::Truncated { given: 0, .. } => f.write_str("is empty: copy or export it again"),
            Problem::Truncated { needed, given } => {
                write!(f, "ends before byte {given}, but should have {needed} bytes: copy or export it again")
            }
            Problem::NoSuchVertex => f.write_str("the face names a vertex that does not exist"),
            Problem::NotFinite => f.write_str("a coordinate is not a finite number: repair or export the model again"),
            Problem::NotFiniteAt { byte } => {
                write!(f, "the coordinate at byte {byte} is not a finite number: repair or export the model again")
            }
            Problem::NoFaces => f.write_str("has no faces: export the model as a mesh"),
            Problem::NoArea(faces) => write!(f, "has no face with an area, as all {faces} are points or lines: export the model as a mesh"),
            Problem::TooManyVertices(n) => {
                write!(f, "has {n} vertices, more than the 65536 of a mesh: use pinhole-import --decimate N, or split the model")
            }
            Problem::TooManyFaces(n) => {
                write!(f, "has {n} faces, more than the 65535 that can be named beside edges: leave out --edge-faces, or use pinhole-import --decimate N")
            }
            Problem::Extent(extent) => write!(f, "has an extent of {extent:e}, out of range: use another unit, or pinhole-import --fit LENGTH"),
            Problem::Exponent(exponent) => {
                write!(
                    f,
                    "needs a step of 2^{exponent}, but a mesh has 2^-32 to 2^15: use another unit, or pinhole-import --fit LENGTH"
                )
            }
            Problem::Options(what) => f.write_str(what),
            Problem::NoTextures => f.write_str(
                "has a texture, but this build reads no pictures: install it with the feature `textures`",
            ),
            Problem::NoDecimation => f.write_str(
                "cannot be decimated by this build: install it with the feature `decimate`, which needs a C++ compiler",
            ),
        }
    }
}

impl fmt::Debug for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        match self.in_script {
            true => write!(f, " {}", script::in_script(&self.problem.to_string())),
            false => write!(f, " {}", self.problem),
        }
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
