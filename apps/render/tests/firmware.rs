//! `--firmware` shows what firmware draws: the template is built with a model as its README says, runs on an emulated Cortex-M3,
//! and every pixel that reaches its display is that of the preview.

use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565, Rgb888, RgbColor};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const TARGET: &str = "thumbv7m-none-eabi";
/// As in `firmware/display.rs`.
const SIZE: (usize, usize) = (96, 64);

/// A gear of 300 mm with a hole, z up: a closed mesh.
#[test]
fn the_preview_of_an_stl_file_is_the_firmwares_picture() {
    compare("gear", |_| Path::new(ROOT).join("boards/any-cortex-m/model.stl"));
}

/// The teapot, y up: an open mesh of 992 faces, here of two materials.
#[test]
fn the_preview_of_an_obj_file_with_materials_is_the_firmwares_picture() {
    let preview = compare("teapot", |folder| {
        let teapot = fs::read_to_string(Path::new(ROOT).join("assets/teapot.obj")).expect("the teapot");
        let (vertices, faces) = teapot.split_at(teapot.find("\nf ").expect("faces"));
        let half = faces.len() / 2 + faces[faces.len() / 2..].find('\n').expect("another face");
        let (first, second) = faces.split_at(half);
        let painted = format!("mtllib teapot.mtl\n{vertices}\nusemtl tea{first}\nusemtl milk{second}");
        fs::write(folder.join("teapot.mtl"), "newmtl tea\nKd 1 0 0\nnewmtl milk\nKd 0 0 1\n")
            .expect("teapot.mtl");
        fs::write(folder.join("teapot.obj"), painted).expect("teapot.obj");
        folder.join("teapot.obj")
    });
    // Red and blue, in light and shade.
    let (red, blue) = (
        preview.iter().filter(|[r, g, b]| *r > 0 && [*g, *b] == [0; 2]).count(),
        preview.iter().filter(|[r, g, b]| *b > 0 && [*r, *g] == [0; 2]).count(),
    );
    let drawn = preview.iter().filter(|color| **color != [0; 3]).count();
    assert!(red > 100 && blue > 100 && red + blue == drawn, "{red} red, {blue} blue, {drawn} drawn");
}

/// Compares both pictures of a model, which is made in a folder, and gives the preview.
fn compare(name: &str, model: impl FnOnce(&Path) -> PathBuf) -> Vec<[u8; 3]> {
    let folder = Folder(std::env::temp_dir().join(format!("pinhole-firmware-{name}-{}", std::process::id())));
    fs::create_dir_all(&folder.0).expect("a folder");
    let model = model(&folder.0);
    let preview = preview(&model, &folder.0.join("preview.png"));
    // Neither empty nor full, and in light and shade.
    let mut colours = preview.clone();
    colours.sort_unstable();
    colours.dedup();
    let lit = preview.iter().filter(|colour| **colour != [0; 3]).count();
    assert!(
        lit > 500 && lit < SIZE.0 * SIZE.1 - 500 && colours.len() > 8,
        "{lit} pixels, {} colours",
        colours.len()
    );
    if has_tools() {
        let shown = shown(&folder.0.join("firmware"), &model);
        let differing = shown.iter().zip(&preview).filter(|(shown, preview)| shown != preview).count();
        assert_eq!(differing, 0, "pixels of {}", preview.len());
    }
    preview
}

/// The pixels that the command writes, row by row.
fn preview(model: &Path, png: &Path) -> Vec<[u8; 3]> {
    let render = Command::new(env!("CARGO_BIN_EXE_pinhole-render"))
        .arg(model)
        .args(["--firmware", "--size", &format!("{}x{}", SIZE.0, SIZE.1), "--png"])
        .arg(png)
        .output()
        .expect("the command");
    assert!(render.status.success(), "{}", String::from_utf8_lossy(&render.stderr));
    let (size, pixels) = pinhole_apps_support::testing::picture(png);
    assert_eq!(size, [SIZE.0, SIZE.1]);
    pixels
}

/// The pixels that arrive at the display of a firmware with the model, each once, row by row.
fn shown(firmware: &Path, model: &Path) -> Vec<[u8; 3]> {
    // One at a time: all are built into one folder, and cargo takes them for one package, which it builds again where a file is
    // newer than what it has built.
    static ONE: Mutex<()> = Mutex::new(());
    let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    run(Command::new("bash").arg(Path::new(ROOT).join("boards/new")).arg("any-cortex-m").arg(firmware));
    let file = format!("model.{}", model.extension().expect("an extension").to_string_lossy());
    fs::copy(model, firmware.join(&file)).expect("the model");
    let library = model.with_extension("mtl");
    if library.exists() {
        fs::copy(&library, firmware.join(library.file_name().expect("a name"))).expect("its materials");
    }
    edit(&firmware.join("build.rs"), "\"model.stl\"", &format!("\"{file}\""));
    // The emulated board's memory, and a display that prints what it gets.
    fs::copy(Path::new(ROOT).join("memory.x"), firmware.join("memory.x")).expect("memory.x");
    fs::write(firmware.join("src/display.rs"), include_str!("firmware/display.rs")).expect("display.rs");
    edit(
        &firmware.join("Cargo.toml"),
        "[dependencies]\n",
        "[dependencies]\nsemihosting = { version = \"0.1\", features = [\"stdio\"] }\n",
    );
    let target_dir = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("cross");
    let mut build = Command::new("bash");
    build.arg(Path::new(ROOT).join("tools/cross"));
    build.args([env!("CARGO"), "build", "--release", "--target", TARGET]);
    build.env("CARGO_TARGET_DIR", &target_dir);
    // These would replace the flags of the template.
    build.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    build.current_dir(firmware);
    run(&mut build);
    let image = firmware.join("image");
    fs::copy(target_dir.join(TARGET).join("release/any-cortex-m"), &image).expect("the image");
    drop(one);

    let printed =
        run(Command::new("bash").arg(Path::new(ROOT).join("tools/emulate")).arg("cortex-m3").arg(image));
    let mut pixels = vec![None; SIZE.0 * SIZE.1];
    for line in printed.lines() {
        let numbers: Vec<usize> = line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let [x, y, colour] = numbers[..] else { panic!("{line}") };
        assert!(x < SIZE.0 && y < SIZE.1, "{line}");
        let colour = Rgb888::from(Rgb565::from(RawU16::new(colour as u16)));
        let before = pixels[y * SIZE.0 + x].replace([colour.r(), colour.g(), colour.b()]);
        assert_eq!(before, None, "{line}: sent twice");
    }
    pixels.into_iter().map(|pixel| pixel.expect("every pixel is sent")).collect()
}

/// Replaces a text that the file has once.
fn edit(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).expect("a file of the template");
    assert_eq!(text.matches(from).count(), 1, "{}: {from}", file.display());
    fs::write(file, text.replace(from, to)).expect("a file");
}

fn run(command: &mut Command) -> String {
    let output = command.stdin(Stdio::null()).output().expect("a command");
    assert!(output.status.success(), "{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// Whether the tools for the emulated microcontroller are there. If not, the test says so; with `CI` set it fails.
fn has_tools() -> bool {
    let check = Command::new("bash").args(["tools/cross", "--check", TARGET]).current_dir(ROOT).output();
    let lacking = match check {
        Ok(check) if check.status.success() => return true,
        Ok(check) => String::from_utf8_lossy(&check.stderr).into_owned(),
        Err(error) => format!("bash: {error}\n"),
    };
    assert!(std::env::var_os("CI").is_none(), "{TARGET}: {lacking}");
    // Not by eprintln, which the test harness shows only when a test fails.
    write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: the template's picture on {TARGET}\n{lacking}")
        .expect("stderr");
    false
}

/// A temporary folder outside the repository, so that the repository's `.cargo/config.toml` does not apply.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
