//! What the compiler says of wrong programs, in the caller's line and before any code is generated.

use std::fs;
use std::path::Path;
use std::process::Command;
use support::ROOT;

const BEGINNING: &str = "#![allow(unused)]
use embedded_graphics::{mock_display::MockDisplay, pixelcolor::{BinaryColor, Rgb565}, prelude::*};
use pinhole::{meshes::{CUBE, TORUS}, prelude::*, target::BufferError, Angle};
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut display = MockDisplay::<Rgb565>::new();
    let viewport = Viewport::new(Point::zero(), display.size())?;
    let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    let cube = camera.place(&CUBE, &Affine::identity());
    let mut buffers = mesh_buffers!(CUBE);
    let mut depths = [0; 64 * 64];
    let mut depth = DepthBuffer::new(display.bounding_box(), &mut depths)?;
";

#[test]
fn messages_name_the_remedy() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("messages");
    let programs = folder.join("src/bin");
    fs::create_dir_all(&programs).expect("a folder");
    let manifest = format!(
        "[package]\nname = \"messages\"\nversion = \"0.0.0\"\nedition = \"2021\"\n[workspace]\n[dependencies]\n\
         embedded-graphics = \"0.8\"\npinhole = {{ path = {ROOT:?} }}\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    // The versions that are there already.
    fs::copy(Path::new(ROOT).join("Cargo.lock"), folder.join("Cargo.lock")).expect("a lock file");

    let cases: Vec<_> = include_str!("messages.txt").split("\n[").skip(1).collect();
    for (index, case) in cases.iter().enumerate() {
        let code = case.lines().skip(1).filter(|line| !line.starts_with("=> "));
        let program = format!(
            "{BEGINNING}{}    Ok(())\n}}\n",
            code.map(|line| format!("    {line}\n")).collect::<String>()
        );
        fs::write(programs.join(format!("case_{index}.rs")), program).expect("a program");
    }
    for (index, case) in cases.iter().enumerate() {
        let bin = format!("case_{index}");
        let mut check = Command::new(env!("CARGO"));
        check.args(["check", "--quiet", "--offline", "--bin", &bin]).current_dir(&folder);
        let output = check.env("CARGO_TARGET_DIR", folder.join("target")).output().expect("cargo runs");
        let said = String::from_utf8_lossy(&output.stderr);
        let parts: Vec<_> = case.lines().filter_map(|line| line.strip_prefix("=> ")).collect();
        assert_eq!(output.status.success(), parts.is_empty(), "[{case}\n{said}");
        for part in parts {
            assert!(said.contains(part), "[{case}\nno {part:?} in\n{said}");
        }
        assert!(is_in_the_callers_line(&said, &bin) || output.status.success(), "[{case}\n{said}");
    }
    assert!(cases.len() >= 9, "{} cases", cases.len());
}

/// Whether the first error is in the program, not in the library.
fn is_in_the_callers_line(said: &str, bin: &str) -> bool {
    let place = said.lines().find_map(|line| line.trim_start().strip_prefix("--> "));
    place.is_some_and(|place| place.starts_with(&format!("src/bin/{bin}.rs")))
}
