//! The README's steps, executed literally in an empty folder: the first program prints its picture, and the template for
//! firmware links for three kinds of cores.

use crate::floats::is_float_routine;
use pinhole_apps_support::bodies::{self, circle, prism, Body};
use pinhole_apps_support::testing;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use support::{firmware, ROOT};

const FIRST: &str = "## The first picture";
/// Where the README's step 4 writes.
const PICTURE: &str = "target/render/model.png";
const FIRMWARE: &str = "## Your own model on your own display";

#[test]
fn the_readme_shows_the_example_first() {
    assert_eq!(blocks(FIRST, "rust"), [read("examples/first/main.rs")]);
}

#[test]
fn the_readme_leads_from_an_empty_folder_to_a_picture() {
    let folder = Folder::new("first");
    let [commands] = blocks(FIRST, "sh").try_into().expect("one block of commands");
    let (make, run) = commands.trim_end().rsplit_once('\n').expect("lines");
    folder.shell(make, &[]);
    let project = folder.path.join("first");
    fs::write(project.join("src/main.rs"), blocks(FIRST, "rust").concat()).expect("main.rs");
    // The versions that the repository is tested with, which are here already.
    fs::copy(Path::new(ROOT).join("Cargo.lock"), project.join("Cargo.lock")).expect("Cargo.lock");
    assert_eq!(run, "cargo run");
    let printed = folder.shell(&format!("cd first\n{run}"), &[]);

    let rows: Vec<Vec<char>> = printed.lines().skip(1).take(64).map(|row| row.chars().collect()).collect();
    let lit = |x: usize, y: usize| rows.get(y).and_then(|row| row.get(x)) == Some(&'#');
    let columns: Vec<usize> = (0..64).filter(|&x| (0..64).any(|y| lit(x, y))).collect();
    let lines: Vec<usize> = (0..64).filter(|&y| (0..64).any(|x| lit(x, y))).collect();
    // The sphere about the pyramid, whose centre is (0, 1, 0) and whose radius √3, fills the picture; the tip is 1 above the
    // centre, so more than half of the way up, and the corners of the base nearly touch the sphere.
    assert!(printed.starts_with("MockDisplay["), "{printed}");
    assert!((6..=16).contains(&lines[0]) && (44..=62).contains(&lines[lines.len() - 1]), "{printed}");
    assert!(columns[0] >= 1 && columns[columns.len() - 1] <= 62 && columns.len() > 32, "{printed}");
    // Lines without a gap, and nothing filled: 8 edges of at most 64 pixels.
    assert_eq!(lines.len(), lines[lines.len() - 1] - lines[0] + 1, "{printed}");
    let count = (0..64).map(|y| (0..64).filter(|&x| lit(x, y)).count()).sum::<usize>();
    assert!(count > 100 && count < 8 * 64, "{count} pixels:\n{printed}");
}

#[test]
fn the_readme_leads_from_an_empty_folder_to_firmware_for_a_cortex_m0() {
    links_firmware("thumbv6m-none-eabi", "Reset");
}

#[test]
fn the_readme_leads_from_an_empty_folder_to_firmware_for_a_cortex_m4f() {
    links_firmware("thumbv7em-none-eabihf", "Reset");
}

#[test]
fn the_readme_leads_from_an_empty_folder_to_firmware_for_rv32imc() {
    links_firmware("riscv32imc-unknown-none-elf", "_start");
}

/// Follows the README's commands for a target. The image must have the entry, this template's picture and no routine for
/// floating point or for formatting text.
fn links_firmware(target: &str, entry: &str) {
    if !firmware::has_compiler(&format!("firmware for {target}"), target) {
        return;
    }
    // One at a time: all are built into one folder, and cargo takes them for one package, which it builds again where a file is
    // newer than what it has built.
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = Folder::new(target);
    let [commands, model, preview] = blocks(FIRMWARE, "sh").try_into().expect("three blocks of commands");
    // The README says to set the target in .cargo/config.toml, whose value this variable replaces.
    folder.shell(&commands, &[("CARGO_BUILD_TARGET", target)]);
    let symbols = firmware_symbols(target);
    let names: Vec<&str> = symbols.lines().filter_map(|line| line.split_whitespace().last()).collect();
    assert!(names.contains(&entry) && names.iter().any(|name| name.contains("depth_tested")), "{symbols}");
    let unwanted = |name: &&str| is_float_routine(name) || name.contains("core3fmt");
    assert_eq!(names.into_iter().filter(unwanted).collect::<Vec<_>>(), [""; 0], "{target}");
    // What follows is the same for all targets.
    if target == "thumbv6m-none-eabi" {
        previews(&folder, &model, &preview);
        is_set_as_the_readme_says(&folder, target);
    }
}

/// Follows the README's steps 3 and 4: the picture is that of the model, and then of a changed `src/picture.rs`.
fn previews(folder: &Folder, model: &str, preview: &str) {
    let drawn = |commands: &str| folder.picture(commands);
    // The README's first picture, which has the gear of the template.
    let gear = drawn(preview);
    let bytes = |file: &Path| fs::read(file).expect("a picture");
    assert!(bytes(&folder.path.join(PICTURE)) == bytes(&Path::new(ROOT).join("docs/part.png")));
    fs::write(folder.path.join("bracket.stl"), bodies::stl(&plate())).expect("bracket.stl");
    let plate = drawn(&format!("{model}{preview}"));
    assert!(plate != gear);

    let code = folder.path.join("firmware/src/picture.rs");
    let text = fs::read_to_string(&code).expect("picture.rs");
    firmware::edit(&code, "Rgb565::CSS_GOLD", "Rgb565::CSS_TEAL");
    let changed = drawn(preview);
    fs::write(&code, text).expect("picture.rs");
    // Gold has more red than blue, teal no red; the outline is one.
    let is_gold = |&[r, g, b]: &[u8; 3]| r > g && g > b;
    let is_teal = |&[r, g, b]: &[u8; 3]| r == 0 && g > 0 && b > 0;
    let drawn = plate.iter().filter(|color| **color != [0; 3]).count();
    assert!(drawn > 5000 && plate.iter().filter(|color| is_gold(color)).count() == drawn);
    let differing = plate.iter().zip(&changed).filter(|(plate, changed)| is_gold(plate) != is_teal(changed));
    assert_eq!(differing.count(), 0);
}

/// The README's step 4 for a template before and after its change: some pixels differ, fewer than a quarter of the model's.
#[test]
fn the_readme_previews_a_template_with_smooth_edges() {
    let folder = Folder::new("smooth");
    folder.shell("pinhole/boards/new rp2040-st7789 firmware", &[]);
    let [_, _, preview] = blocks(FIRMWARE, "sh").try_into().expect("three blocks of commands");
    let plain = folder.picture(&preview);
    let smooth = folder.picture(&format!("patch -p0 < smooth.diff\n{preview}"));
    let drawn = plain.iter().filter(|color| **color != [0; 3]).count();
    let differing = plain.iter().zip(&smooth).filter(|(plain, smooth)| plain != smooth).count();
    assert!(differing > 500 && differing < drawn / 4, "{differing} pixels of {drawn}");
}

/// A plate of 300 mm as a CAD program has it, z up, with a hole.
fn plate() -> Body {
    // The corner of the square in a direction: the larger coordinate is 150.
    let square = circle(32, |i| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / 32.0).sin_cos();
        150.0 / sin.abs().max(cos.abs())
    });
    prism(&square, &circle(32, |_| 60.0), 20.0)
}

/// Follows the README's steps 5 and 6: each line of its table is in the template, once, and is set to another chip and display.
/// The image is then linked for these.
fn is_set_as_the_readme_says(folder: &Folder, target: &str) {
    let readme = read("README.md");
    let (_, section) = readme.split_once("| file | line |").expect("the table of the steps");
    let cell = |text: &str| text.trim().trim_matches('`').to_string();
    let lines: Vec<[String; 2]> = section
        .lines()
        .map_while(|line| (!line.starts_with("## ")).then_some(line.trim()))
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            line.split('|')
                .skip(1)
                .take(2)
                .map(cell)
                .collect::<Vec<_>>()
                .try_into()
                .expect("a file and a line")
        })
        .collect();
    // An nRF51822, as it is in data sheets, and a display of 128 x 160 pixels.
    let chip = [
        format!("target = \"{target}\""),
        "runner = \"probe-rs run --chip nRF51822_xxAB\"".into(),
        "FLASH : ORIGIN = 0x00000000, LENGTH = 128K".into(),
        "RAM   : ORIGIN = 0x20000000, LENGTH = 16K".into(),
        "const MEGAHERTZ: u32 = 64;".into(),
        "pub const SIZE: Size = Size::new(128, 160);".into(),
    ];
    assert_eq!(lines.len(), chip.len(), "{lines:?}");
    for ([file, line], new) in lines.iter().zip(&chip) {
        let file = folder.path.join("firmware").join(file);
        let text = fs::read_to_string(&file).expect("a file of the template");
        let found = text.matches(line.as_str()).count();
        // The line of a chip is there for every core of its kind.
        assert!(
            if line.starts_with("runner") { found >= 1 } else { found == 1 },
            "{}: {line}",
            file.display()
        );
        let word = line.split(['=', ':']).next();
        assert_eq!(word, new.split(['=', ':']).next(), "it sets what the README names");
        fs::write(&file, text.replace(line.as_str(), new)).expect("a file of the template");
    }
    // Step 6: a driver, here one that counts pixels.
    firmware::edit(
        &folder.path.join("firmware/src/display.rs"),
        "black_box((area, pixels));",
        "black_box((area, pixels.len()));",
    );

    folder.shell("cd firmware\ncargo build --release", &[("CARGO_BUILD_TARGET", target)]);
    let symbols = firmware_symbols(target);
    let address = |name: &str| -> u64 {
        let line = symbols.lines().find(|line| line.split_whitespace().last() == Some(name));
        let line = line.unwrap_or_else(|| panic!("no {name}: {symbols}"));
        u64::from_str_radix(line.split_whitespace().next().unwrap_or(""), 16).expect("an address")
    };
    assert!(address("Reset") < 128 << 10, "in the chip's flash");
    assert_eq!(address("_stack_start"), 0x2000_0000 + (16 << 10), "the end of its RAM");
}

fn target_dir() -> PathBuf {
    firmware::target_dir(env!("CARGO_TARGET_TMPDIR"))
}

/// The symbols of the firmware's image, one a line.
fn firmware_symbols(target: &str) -> String {
    let image = target_dir().join(target).join("release/firmware");
    firmware::run(firmware::cross(&target_dir()).args(["bash", "-c", "\"$NM\" \"$1\"", "nm"]).arg(image))
}

/// A copy has all modules that it names, laid out as in the repository, and names nothing outside.
#[test]
fn copies_of_templates_are_complete() {
    let folder = Folder::new("copies");
    for board in firmware::templates() {
        folder.shell(
            &format!(
                "pinhole/boards/new {board} {board} ../pinhole
                cd {board}
                rustfmt --check --edition 2021 --config-path ../pinhole build.rs $(find . -name main.rs -o -name report.rs) >&2
                ls model.stl .gitignore Cargo.lock ../pinhole
                if grep -rnE 'common/|\\.\\./\\.\\./\\.\\.' . >&2; then exit 1; fi"
            ),
            &[],
        );
    }
}

/// Cargo takes no other names, or would take one of a dependency for that dependency.
#[test]
fn a_copy_is_named_like_its_folder() {
    let folder = Folder::new("names");
    let printed = folder.shell(
        "pinhole/boards/new rp2040-st7789 copies/my-gauge
        cd copies/my-gauge
        grep -xF 'name = \"my-gauge\"' Cargo.toml Cargo.lock
        grep -o 'release/my-gauge' README.md
        for name in 'my gauge' 1st-gauge -gauge defmt rp2040-embassy; do
          if ../../pinhole/boards/new rp2040-st7789 \"../$name\" || [ -e \"../$name\" ]; then exit 1; fi
        done",
        &[],
    );
    assert_eq!(printed.lines().count(), 4, "{printed}");
}

/// The README's figures of RAM: 8 bytes for a vertex, 2 for a face, 4 for a pixel of a band, and 15 KB for 500 vertices and 1000
/// faces with 1 KB for the log.
#[test]
fn the_readme_says_how_much_ram_the_template_takes() {
    let buffers = size_of::<pinhole::MeshBuffers<500, { 1000 + 1000_usize.div_ceil(16) + 32 }>>();
    let strip = size_of_val(&pinhole::strip_buffers!(embedded_graphics::pixelcolor::Rgb565, 240, 8));
    // 2 bytes for 16 faces more, 64 for the bins, and 2 align the next buffer.
    assert_eq!((buffers, strip), (500 * 8 + 1095 * 2 + 2, 240 * 8 * 4));
    let readme = read("README.md");
    assert!(readme.contains(
        "RAM = 8 B per vertex + 2 B per face + 4 B per pixel of a band (colour and depth): 15 KB for"
    ));
    assert!(readme.contains("15 KB for 500 vertices, 1000 faces and bands of\n8 × 240 pixels"));
    assert_eq!((buffers + strip + 1024).div_ceil(1000), 15);
}

/// The README's code blocks of a language below a heading, in their order.
fn blocks(heading: &str, language: &str) -> Vec<String> {
    let readme = read("README.md");
    let (_, section) = readme.split_once(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("no {heading}"));
    let section = section.split("\n## ").next().unwrap_or("");
    let begin = format!("```{language}\n");
    let begun = section.split(&begin).skip(1);
    let blocks: Vec<String> =
        begun.map(|rest| rest.split_once("```\n").expect("its end").0.to_string()).collect();
    assert!(!blocks.is_empty(), "{heading}: no {language}");
    blocks
}

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// An empty folder with the repository in it as `pinhole`.
struct Folder {
    path: PathBuf,
    _temporary: firmware::Folder,
}

impl Folder {
    fn new(name: &str) -> Self {
        let temporary = firmware::Folder::new(&format!("template-{name}"));
        let path = temporary.0.clone();
        #[cfg(unix)]
        std::os::unix::fs::symlink(ROOT, path.join("pinhole")).expect("a link");
        Self { path, _temporary: temporary }
    }

    /// The picture that the commands, run in the firmware's folder, make of its model.
    fn picture(&self, commands: &str) -> Vec<[u8; 3]> {
        self.shell(&format!("cd firmware\n{commands}"), &[]);
        testing::picture(&self.path.join(PICTURE)).1
    }

    /// What the commands print. They run with the compiler for the target that `variables` name, if they name one.
    fn shell(&self, commands: &str, variables: &[(&str, &str)]) -> String {
        let script = format!("set -euo pipefail\n{commands}");
        let mut command = match variables {
            [] => {
                let mut command = Command::new("bash");
                command.args(["-c", &script]);
                command.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("first"));
                command
            }
            [(_, target), ..] => {
                // `--target` is for tools/cross, which finds a compiler by it; the commands do not see it.
                let mut command = firmware::cross(&target_dir());
                command.args(["bash", "-c", &script, "--target", target]);
                command
            }
        };
        command.envs(variables.iter().copied());
        // As in boards/check, whose builds these share.
        command.env("CARGO_PROFILE_RELEASE_DEBUG", "false");
        // These would replace the flags of the templates.
        command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
        firmware::run(command.current_dir(&self.path))
    }
}
