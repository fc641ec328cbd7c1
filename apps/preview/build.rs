//! Finds the project whose picture is compiled: that which the variable `PINHOLE_PROJECT` names, or what the templates share.

use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-env-changed=PINHOLE_PROJECT");
    println!("cargo::rerun-if-changed=build.rs");
    let shared = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../boards/common"));
    let (project, picture, script) = match std::env::var_os("PINHOLE_PROJECT") {
        Some(project) => (project.into(), "src/picture.rs", "build.rs"),
        None => (shared, "two-strips/src/picture.rs", "all/build.rs"),
    };
    let project = project.canonicalize()?;
    let (picture, script) = (project.join(picture), project.join(script));
    // That it changes matters here for the macro alone; the compiler notices for itself that it reads another text.
    println!("cargo::rerun-if-changed={}", picture.display());
    let text = std::fs::read_to_string(&picture)?;
    let draws = match (text.contains("struct Turned"), text.contains("struct Smoothing")) {
        (true, true) => "draws_bands!(picture, Deg0, Smoothing)", // as after `smooth.diff`
        (true, false) => "draws_bands!(picture)",
        (false, _) => "draws_into_a_target!(picture)",
    };
    let project = project.to_str().ok_or("the path of the project is not UTF-8")?;
    let code = format!(
        "#[allow(dead_code, unreachable_pub)]\n#[path = {picture:?}]\nmod picture;\n\
         #[allow(dead_code, unreachable_pub)]\n#[path = {script:?}]\nmod script;\n\
         pinhole_render::{draws};\n\
         const PROJECT: &str = {project:?};\n"
    );
    std::fs::write(PathBuf::from(std::env::var_os("OUT_DIR").ok_or("no OUT_DIR")?).join("project.rs"), code)?;
    Ok(())
}
