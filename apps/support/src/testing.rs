//! Host programs under test: how tests run them, and what all of them promise about standard output and files.
//!
//! Every function here panics where the promise that it is named for does not hold.
#![allow(clippy::missing_panics_doc)] // to panic is what these functions are for

use crate::still;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A program that `cargo test` has built, and the folder below which its tests write.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    file: &'static str,
    scratch: &'static str,
    subcommand: Option<&'static str>,
}

impl Program {
    /// `file` is `env!("CARGO_BIN_EXE_NAME")`, `scratch` is `env!("CARGO_TARGET_TMPDIR")`.
    pub const fn new(file: &'static str, scratch: &'static str) -> Self {
        Self { file, scratch, subcommand: None }
    }

    /// A subcommand of the program.
    #[must_use]
    pub const fn subcommand(self, name: &'static str) -> Self {
        Self { subcommand: Some(name), ..self }
    }

    /// Runs the program.
    pub fn run<S: AsRef<OsStr>>(&self, arguments: &[S]) -> Output {
        self.run_in(Path::new("."), arguments)
    }

    /// Runs the program in a folder.
    pub fn run_in<S: AsRef<OsStr>>(&self, folder: &Path, arguments: &[S]) -> Output {
        self.command(folder, arguments).output().expect("the program starts")
    }

    /// The program with its arguments and working folder, not started yet.
    pub fn command<S: AsRef<OsStr>>(&self, folder: &Path, arguments: &[S]) -> Command {
        let mut command = Command::new(self.file);
        command.args(self.subcommand).args(arguments).current_dir(folder);
        command
    }

    /// An empty folder that no other test uses.
    pub fn folder(&self, test: &str, name: &str) -> PathBuf {
        folder(Path::new(self.scratch), test, name)
    }
}

/// An empty folder below `scratch` that no other test uses.
pub fn folder(scratch: &Path, test: &str, name: &str) -> PathBuf {
    // Tests run at the same time, each in a thread that bears its name, and two may ask for the same `name`.
    let thread = std::thread::current();
    let thread = thread.name().unwrap_or_default().replace("::", "_");
    let folder = scratch.join(test).join(thread).join(name);
    let _ = fs::remove_dir_all(&folder); // from an earlier run
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Asserts that a program refused its input: exit code 2, nothing on standard output, and one line on standard error, which
/// is returned.
pub fn refusal(done: &Output) -> String {
    assert!(done.stdout.is_empty(), "{done:?}");
    message(done)
}

/// The one line on standard error of a program that ended with exit code 2.
fn message(done: &Output) -> String {
    let text = String::from_utf8(done.stderr.clone()).expect("a message in UTF-8");
    assert_eq!((done.status.code(), text.lines().count()), (Some(2), 1), "{text}");
    text
}

/// Writes `skin.obj`, a square, with its material and a picture that is red on the left and blue on the right. Returns the file.
pub fn textured(folder: &Path) -> PathBuf {
    let colors: Vec<_> = (0..64).map(|i| if i % 8 < 4 { Rgb888::RED } else { Rgb888::BLUE }).collect();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    let picture = still::png(Size::new(8, 8), &colors).expect("a picture");
    for (name, content) in [
        ("skin.png", picture),
        ("skin.mtl", b"newmtl skin\nKd 1 1 1\nmap_Kd skin.png\n".into()),
        ("skin.obj", format!("mtllib skin.mtl\nusemtl skin\n{square}").into()),
    ] {
        fs::write(folder.join(name), content).expect("room");
    }
    folder.join("skin.obj")
}

/// The size of a PNG file's picture and its colours, row by row.
pub fn picture(file: &Path) -> ([usize; 2], Vec<[u8; 3]>) {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(file).expect("a picture")));
    decoder.set_transformations(png::Transformations::EXPAND); // a palette to colours
    let mut reader = decoder.read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut bytes).expect("a frame");
    assert_eq!(frame.color_type, png::ColorType::Rgb);
    ([frame.width as usize, frame.height as usize], bytes.as_chunks().0.to_vec())
}

/// The columns and the rows of a picture in which something is drawn: the first, and the first behind it.
pub fn extent(drawn: &[bool], width: usize) -> [[usize; 2]; 2] {
    let height = drawn.len() / width;
    let ends = |all: Vec<usize>| [all[0], all[all.len() - 1] + 1];
    let columns = (0..width).filter(|&x| (0..height).any(|y| drawn[y * width + x])).collect();
    let rows = (0..height).filter(|&y| (0..width).any(|x| drawn[y * width + x])).collect();
    [ends(columns), ends(rows)]
}

/// A reader that closes standard output early (`| head`) is no error.
pub fn closed_output_is_no_error(mut program: Command) {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let done = program.stdout(writer).stderr(Stdio::piped()).output().expect("the program starts");
    assert!(done.status.success() && done.stderr.is_empty(), "{program:?}: {done:?}");
}

/// A full standard output is an error that says so.
#[cfg(target_os = "linux")]
pub fn full_output_is_an_error(mut program: Command) {
    let full = fs::File::options().write(true).open("/dev/full").expect("/dev/full");
    let done = program.stdout(full).stderr(Stdio::piped()).output().expect("the program starts");
    let text = message(&done);
    assert!(text.starts_with("standard output: cannot be written: "), "{program:?}: {text}");
}

/// An output that names the input file, directly or through a link, is refused, and the input stays as it was. `arguments`
/// are followed by the name of that output.
pub fn input_is_not_overwritten(program: Program, folder: &Path, input: &str, arguments: &str) {
    #[cfg_attr(not(unix), allow(unused_mut))]
    let mut names = vec![input];
    #[cfg(unix)]
    {
        fs::hard_link(folder.join(input), folder.join("hard")).expect("a hard link");
        std::os::unix::fs::symlink(input, folder.join("soft")).expect("a symbolic link");
        names.extend(["hard", "soft"]);
    }
    let state = || (fs::read(folder.join(input)).expect("the input"), entries(folder));
    let before = state();
    for output in names {
        let words: Vec<_> = arguments.split(' ').chain([output]).collect();
        let text = refusal(&program.run_in(folder, &words));
        let is_said = |what: &str| text.starts_with(&format!("{output}: {what}"));
        assert!(is_said("is the input file") || is_said("is the model itself"), "{words:?}: {text}");
        assert!(state() == before, "{words:?}");
    }
}

/// Where no file takes a byte, as on a full disk, the program says that `output` cannot be written; `output` is what it was,
/// and no other file is left behind. The program runs in `folder`.
#[cfg(target_os = "linux")]
pub fn failed_write_changes_nothing(program: &Command, folder: &Path, output: &str) {
    let state = || (fs::read(folder.join(output)).ok(), entries(folder));
    let before = state();
    // A file size limit of 0, whose signal (25, SIGXFSZ) is ignored, so that writing fails instead.
    let mut shell = Command::new("sh");
    shell.args(["-c", "trap '' 25; ulimit -f 0; exec \"$@\"", "sh"]).current_dir(folder);
    let done = shell.arg(program.get_program()).args(program.get_args()).output().expect("sh starts");
    let text = message(&done);
    assert!(text.contains(output) && text.contains("cannot be written"), "{program:?}: {text}");
    assert!(state() == before, "{program:?}");
}

/// How many files and folders a folder holds.
fn entries(folder: &Path) -> usize {
    fs::read_dir(folder).expect("a folder").count()
}
