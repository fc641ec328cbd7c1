//! `--firmware` shows what firmware draws: the template is built with a model as its README says, runs on an emulated Cortex-M3,
//! and every pixel that reaches its display is that of the preview.

use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565, Rgb888, RgbColor};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use support::firmware::{self, edit, run, Folder};
use support::ROOT;

const TARGET: &str = "thumbv7m-none-eabi";
/// As in `firmware/display.rs`.
const SIZE: (usize, usize) = (96, 64);

/// A gear of 300 mm with a hole, z up: a closed mesh.
#[test]
fn the_preview_of_an_stl_file_is_the_firmwares_picture() {
    compare("gear", |_| Path::new(ROOT).join("boards/common/all/model.stl"));
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
    let folder = Folder::new(&format!("firmware-{name}"));
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
    if firmware::has_compiler("the template's picture", TARGET) {
        let shown = shown(&folder.0, &model);
        let differing = shown.iter().zip(&preview).filter(|(shown, preview)| shown != preview).count();
        assert_eq!(differing, 0, "pixels of {}", preview.len());
    }
    preview
}

/// The pixels that the command writes, row by row.
fn preview(model: &Path, png: &Path) -> Vec<[u8; 3]> {
    let size = format!("{}x{}", SIZE.0, SIZE.1);
    let mut render = Command::new(env!("CARGO_BIN_EXE_pinhole-render"));
    run(render.arg(model).args(["--firmware", "--size", &size, "--png"]).arg(png));
    let (size, pixels) = pinhole_apps_support::testing::picture(png);
    assert_eq!(size, [SIZE.0, SIZE.1]);
    pixels
}

/// The pixels that arrive at the display of a firmware with the model, each once, row by row.
fn shown(folder: &Path, model: &Path) -> Vec<[u8; 3]> {
    let target_dir = firmware::target_dir(env!("CARGO_TARGET_TMPDIR"));
    let image = firmware::image("any-cortex-m", TARGET, &target_dir, folder, |firmware| {
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
        let semihosting = "[dependencies]\nsemihosting = { version = \"0.1\", features = [\"stdio\"] }\n";
        edit(&firmware.join("Cargo.toml"), "[dependencies]\n", semihosting);
    });
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
