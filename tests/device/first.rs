//! The README's steps from an empty folder to a picture: its code equals `examples/first`, is short, and does what the
//! README says, on the host and on an emulated microcontroller.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const TARGET: &str = "thumbv7m-none-eabi";

#[test]
fn the_readme_shows_the_example_in_under_30_lines() {
    let picture = read("examples/first/picture.rs");
    assert_eq!(block("rust"), picture);
    assert_eq!(read("boards/stm32f4-ili9341/src/picture.rs"), picture, "the board's");
    // With `mod picture;` and the call, beyond the board's set-up.
    let lines = picture.lines().count() + 2;
    assert!(lines < 30, "{lines} lines");
}

#[test]
fn the_readme_leads_from_an_empty_folder_to_a_picture() {
    let printed = on_the_host();
    assert_pyramid(&printed);
    if has_tools() {
        assert!(on_a_microcontroller() == printed, "not the host's picture");
    }
}

/// The pyramid from an STL file lights the pixels of the pyramid in the README, in any order of its faces.
#[test]
fn the_readme_leads_from_a_model_to_a_picture() {
    let printed = of_a_model("model", "part.stl", pyramid().as_bytes());
    let lit = |printed: &str| {
        printed.split_whitespace().map(|colour| u8::from(colour != "0000") + b'0').collect::<Vec<_>>()
    };
    assert!(lit(&printed) == lit(&on_the_host()), "not the pyramid's pixels");
}

/// A model of many faces: they are lit by their normals, those that point upwards more than those that do not.
#[test]
fn the_readme_leads_from_a_large_model_to_a_picture() {
    let teapot = fs::read(Path::new(ROOT).join("assets/teapot.obj")).expect("the teapot");
    let printed = of_a_model("teapot", "part.obj", &teapot);
    let colours: BTreeSet<&str> = printed.split_whitespace().skip(3).collect();
    assert!(colours.len() > 12, "{colours:?}");
    let rows: Vec<Vec<&str>> = printed.lines().skip(1).map(|row| row.split_whitespace().collect()).collect();
    let red = |colour: &&str| u32::from_str_radix(colour, 16).expect("a colour") >> 11;
    let mean = |rows: &[Vec<&str>]| {
        let reds: Vec<u32> = rows.iter().flatten().filter(|colour| **colour != "0000").map(red).collect();
        reds.iter().sum::<u32>() / reds.len().max(1) as u32
    };
    let lit: Vec<Vec<&str>> =
        rows.into_iter().filter(|row| row.iter().any(|colour| *colour != "0000")).collect();
    let (upper, lower) = lit.split_at(lit.len() / 2);
    assert!(
        lit.len() > 15 && mean(upper) > mean(lower),
        "{} rows, {} {}",
        lit.len(),
        mean(upper),
        mean(lower)
    );
}

/// What the README says to do with a model, and then what the firmware prints.
fn of_a_model(name: &str, file: &str, model: &[u8]) -> String {
    let folder = Folder::new(name);
    let main = [include_str!("first/screen.rs"), include_str!("first/host.rs"), "\nmod part;\n"].concat();
    let firmware = folder.follow_the_readme(&main, "");
    fs::write(firmware.path.join(file), model).expect("the model");
    let import = block("sh").replace("../pinhole", ROOT).replace("part.stl", file);
    let mut import = import.split_whitespace();
    assert_eq!(import.next(), Some("cargo"));
    firmware.run(cargo().args(import));
    let more = block("rust,ignore");
    let (lists, shade) = more.trim_end().rsplit_once('\n').expect("lists, and what shades a face");
    let edited: Vec<&str> = block("rust")
        .leak()
        .lines()
        .filter_map(|line| match line.split_once('=').map_or(line, |(left, _)| left).trim() {
            list if list.starts_with("const FACES") => None,
            list if list.starts_with("const VERTICES") => Some("use crate::part::MESH;"),
            "let mesh" => Some("    let mesh = MESH;"),
            "let (mut cache, mut bins)" => Some(lists),
            "let Ok(_)" => Some(shade),
            _ => Some(line),
        })
        .collect();
    fs::write(firmware.path.join("src/picture.rs"), edited.join("\n")).expect("picture.rs");
    let printed = firmware.run(cargo().arg("run"));
    assert!(printed.starts_with("4096 pixels sent"), "{printed}");
    printed
}

/// The README's code, as text.
fn pyramid() -> String {
    let corners = [[-1, -1, 1], [1, -1, 1], [1, -1, -1], [-1, -1, -1], [0, 1, 0]];
    let mut stl = String::from("solid pyramid\n");
    for face in [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]] {
        stl += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in face.map(|corner: usize| corners[corner]) {
            stl += &format!("vertex {x} {y} {z}\n");
        }
        stl += "endloop\nendfacet\n";
    }
    stl + "endsolid pyramid\n"
}

fn on_the_host() -> String {
    let folder = Folder::new("host");
    let main = [include_str!("first/screen.rs"), include_str!("first/host.rs")].concat();
    folder.follow_the_readme(&main, "").run(cargo().arg("run"))
}

/// Memory layout and linker flags are those of the examples; QEMU runs the program instead of a probe.
fn on_a_microcontroller() -> String {
    let folder = Folder::new("device");
    let main =
        ["#![no_std]\n#![no_main]\n", include_str!("first/screen.rs"), include_str!("first/device.rs")]
            .concat();
    let firmware = folder.follow_the_readme(
        &main,
        "cortex-m = { version = \"0.7\", features = [\"critical-section-single-core\"] }\n\
         cortex-m-rt = \"0.7\"\n\
         semihosting = { version = \"0.1\", features = [\"stdio\", \"panic-handler\"] }\n\
         [profile.release]\n\
         panic = \"abort\"\n",
    );
    firmware.copy("memory.x");
    firmware.copy("tools/emulate");
    firmware.copy(".cargo/config.toml");
    let mut cross = Command::new("bash");
    cross.arg(Path::new(ROOT).join("tools/cross")).arg(env!("CARGO"));
    cross.args(["run", "--release", "--target", TARGET]);
    // With the other device tests: core is built once.
    cross.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("cross"));
    // These would replace the flags by which firmware is linked.
    cross.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    firmware.run(&mut cross)
}

/// Worked out by hand. The eye is √58 = 7.616 from the origin, and 30° for 64 rows make a focal length of 119.4 rows. So
/// the tip, 1 above the origin, is 7.616 − 3/7.616 = 7.222 away and 7/7.616·119.4/7.222 = 15.2 rows above the middle,
/// at (32, 16.8). The corner (−1, −1, 1) is turned to (−0.366, −1, 1.366), is 6.754 away, and appears at (25.5, 57.8).
/// The edge between them, at x = 25.5 + 6.5·(57.8 − y)/41, parts two faces.
fn assert_pyramid(printed: &str) {
    let mut lines = printed.lines();
    assert_eq!(lines.next(), Some("4096 pixels sent"), "each pixel once");
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split_whitespace().collect()).collect();
    assert!(rows.len() == 64 && rows.iter().all(|row| row.len() == 64));
    let lit = |row: &Vec<&str>| row.iter().any(|&colour| colour != "0000");
    let (first, last) = (rows.iter().position(lit), rows.iter().rposition(lit));
    // A tip may lie between the centres of its row's pixels.
    assert!(matches!(first, Some(16..=18)) && matches!(last, Some(56..=57)), "{first:?}, {last:?}");
    // Gold, (31, 53, 0) of 31, 63, 31: left of the edge face 3, in 256 − 3·40 of 256, and right of it face 0 in full light.
    let gold =
        |level: u32| format!("{:04x}", ((31 * level + 128) >> 8) << 11 | ((53 * level + 128) >> 8) << 5);
    // At y = 40.5 the edge is at x = 28.2.
    let (left, right) = (rows[40][26], rows[40][31]);
    assert_eq!([left, right].map(str::to_string), [gold(136), gold(256)]);
}

/// The README's only block of this language after the heading.
fn block(language: &str) -> String {
    let readme = read("README.md");
    let (_, section) = readme.split_once("\n## In your own firmware\n").expect("the heading");
    let section = section.split("\n## ").next().unwrap_or("");
    let (_, block) = section.split_once(&format!("```{language}\n")).expect("a block");
    block.split_once("```\n").expect("its end").0.to_string()
}

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A folder outside the repository, so that cargo does not take its packages for the repository's. Only one exists at a time:
/// all are built into one target folder, and cargo takes them for one package, rebuilt where a file is newer.
struct Folder {
    path: PathBuf,
    _one: MutexGuard<'static, ()>,
}

impl Folder {
    fn new(name: &str) -> Self {
        static ONE: Mutex<()> = Mutex::new(());
        let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
        let path = std::env::temp_dir().join(format!("pinhole-first-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder");
        Self { path, _one: one }
    }

    /// `cargo new`, the README's lines of Cargo.toml with some more, its code, and this main.rs.
    fn follow_the_readme(&self, main: &str, more: &str) -> Firmware<'_> {
        let new = cargo()
            .args(["new", "--quiet", "--vcs", "none", "firmware"])
            .current_dir(&self.path)
            .output()
            .expect("cargo");
        assert!(new.status.success(), "{}", String::from_utf8_lossy(&new.stderr));
        let firmware = Firmware { path: self.path.join("firmware"), _folder: self };
        let manifest = fs::read_to_string(firmware.path.join("Cargo.toml")).expect("cargo made it");
        let lines = block("toml");
        let lines = lines.strip_prefix("[dependencies]\n").expect("dependencies").replace("../pinhole", ROOT);
        assert!(lines.contains(ROOT) && manifest.ends_with("[dependencies]\n"), "{lines}{manifest}");
        fs::write(firmware.path.join("Cargo.toml"), format!("{manifest}{lines}{more}")).expect("Cargo.toml");
        fs::write(firmware.path.join("src/picture.rs"), block("rust")).expect("picture.rs");
        fs::write(firmware.path.join("src/main.rs"), main).expect("main.rs");
        // The versions that the repository is tested with, which are here already.
        firmware.copy("Cargo.lock");
        firmware
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.path); // a temporary folder
    }
}

struct Firmware<'a> {
    path: PathBuf,
    _folder: &'a Folder,
}

impl Firmware<'_> {
    /// Copies a file of the repository.
    fn copy(&self, file: &str) {
        let to = self.path.join(file);
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(Path::new(ROOT).join(file), to).unwrap_or_else(|error| panic!("{file}: {error}"));
    }

    /// What the command prints in the firmware's folder.
    fn run(&self, command: &mut Command) -> String {
        let output = command.current_dir(&self.path).stdin(Stdio::null()).output().expect("a command");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    }
}

fn cargo() -> Command {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("first"));
    cargo
}

/// Whether a target is installed. If not, the test says so; with `CI` set it fails.
fn has_tools() -> bool {
    let check = Command::new("bash").args(["tools/cross", "--check", TARGET]).current_dir(ROOT).output();
    let lacking = match check {
        Ok(check) if check.status.success() => return true,
        Ok(check) => String::from_utf8_lossy(&check.stderr).into_owned(),
        Err(error) => format!("bash: {error}\n"),
    };
    assert!(std::env::var_os("CI").is_none(), "{TARGET}: {lacking}");
    // Not by eprintln, which the test harness shows only when a test fails.
    write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: the README's firmware on {TARGET}\n{lacking}")
        .expect("stderr");
    false
}
