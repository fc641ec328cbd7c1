//! Flash, variables and stack of single-feature images, minus the empty one; and a check that no image links unused features.

#[path = "../../../tests/device/floats.rs"]
mod floats;

use crate::core::Build;
use crate::elf::{self, Provenance};
use crate::{Result, M0, M3, RV32};
use floats::is_float_routine;
use serde::Deserialize;
use serde_json::{json, Value};
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) const BUILDS: [Build; 5] = [
    Build { target: M3, level: "3" },
    Build { target: M3, level: "s" },
    Build { target: M0, level: "3" },
    Build { target: M0, level: "s" },
    Build { target: RV32, level: "3" },
];
/// The build whose images may not grow.
pub(crate) const M3_AT_3: &[Build] = &[BUILDS[0]];

/// The images of `src/bin/flash_*.rs`, in `images.json`.
#[derive(Deserialize)]
struct Images {
    /// Files and folders of the library of which images of a kind must not hold any code. The image [`WITNESS`] holds code of all of
    /// them, otherwise the check would be blind.
    without: BTreeMap<String, Vec<String>>,
    /// The builds in which images of a kind are measured.
    builds: BTreeMap<String, Vec<String>>,
    images: Vec<Image>,
}

#[derive(Deserialize)]
struct Image {
    name: String,
    says: String,
    without: String,
    builds: String,
}

/// Links everything that other images must not link.
const WITNESS: &str = "dither";

/// Whether the library has this part for this core: cores with a division instruction and cores without have different code.
fn is_for(part: &str, build: Build) -> bool {
    match part {
        "fast/edge20.rs" | "fast/small_triangle.rs" => build.target != M0,
        "fast/bresenham_triangle.rs" => build.target == M0,
        _ => true,
    }
}

/// Measures the images in these builds.
pub(crate) fn measure(builds: &[Build], failures: &mut Vec<String>) -> Result<Vec<Value>> {
    let Images { without, builds: kinds, images } = serde_json::from_str(include_str!("../images.json"))?;
    let mut rows = Vec::new();
    for &build in builds {
        let is_built = |image: &&Image| kinds[&image.builds].contains(&build.to_string());
        let images = || images.iter().filter(is_built);
        let names = ["empty"].into_iter().chain(images().map(|image| image.name.as_str()));
        build.cargo("build", &names.map(|name| format!("--bin=flash_{name}")).collect::<Vec<_>>())?;
        let file = |name: &str| build.image(&format!("flash_{name}"));
        let empty = elf::sizes(&file("empty"))?.flash;
        let witness = Provenance::of(&file(WITNESS))?;
        for Image { name, says, without: kind, .. } in images() {
            let without = without.get(kind).ok_or_else(|| format!("images.json: {name}: no {kind}"))?;
            let elf::Sizes { flash, statics, .. } = elf::sizes(&file(name))?;
            let stack = build.stack(&format!("flash_{name}"))?;
            without_floats(&format!("{build}: {name}"), &file(name), failures)?;
            let from = Provenance::of(&file(name))?;
            for part in without.iter().filter(|part| is_for(part, build)) {
                let (held, seen) = (from.because_of(part), witness.because_of(part));
                if held > 0 {
                    failures.push(format!("{build}: {name} holds {held} bytes of {part}"));
                }
                if seen == 0 {
                    failures.push(format!("{build}: {WITNESS} holds nothing of {part}: the check is blind"));
                }
            }
            let flash = flash.saturating_sub(empty);
            rows.push(json!({"image": name, "target": build.target, "level": build.level, "says": says,
                "flash": flash, "variables": statics, "stack": stack}));
        }
    }
    Ok(rows)
}

/// Fails for each float routine that is linked into an image.
pub(crate) fn without_floats(name: &str, image: &Path, failures: &mut Vec<String>) -> Result<()> {
    let names = elf::symbols(image)?;
    if !names.iter().any(|name| ["Reset", "_start"].contains(&name.as_str())) {
        return Err(format!("{}: not the symbols of a firmware", image.display()).into());
    }
    let routines = names.into_iter().filter(|name| is_float_routine(name));
    failures.extend(routines.map(|routine| format!("{name} holds {routine}, of software floating point")));
    Ok(())
}
