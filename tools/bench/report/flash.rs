//! Flash of linking only what is used: images less the empty one, and what they must not hold.

use crate::cross::{self, Build};
use crate::{elf, provenance, Result, M0, M3};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The builds, in the order of the page's columns.
pub(crate) const BUILDS: [Build; 4] = [
    Build { target: M3, level: "3" },
    Build { target: M3, level: "s" },
    Build { target: M0, level: "3" },
    Build { target: M0, level: "s" },
];

/// Source files, or folders of them, that an image must hold nothing of. All of them are in the image `WITNESS`, or the
/// check would be blind.
pub(crate) struct Image {
    pub(crate) name: &'static str,
    /// On the page.
    pub(crate) says: &'static str,
    without: &'static [&'static str],
}

const LIGHT: &str = "shade/";
const DEPTH: [&str; 2] = ["raster/plane.rs", "output/depth.rs"];
const NO_FACES: &[&str] = &[DEPTH[0], DEPTH[1], LIGHT, "raster/triangle.rs"];

pub(crate) const IMAGES: &[Image] = &[
    Image { name: "set_up", says: "set-up", without: NO_FACES },
    Image { name: "wireframe", says: "wireframe", without: NO_FACES },
    Image { name: "wireframe_bands", says: "wireframe in bands", without: NO_FACES },
    Image { name: "solid", says: "flat faces", without: &DEPTH },
    Image { name: "depth", says: "flat faces with depth", without: &[] },
    Image { name: "depth_bands", says: "flat faces with depth in bands", without: &[] },
];

/// Has all that others must not have.
const WITNESS: &str = "depth";
const LIMITS: &str = "tools/bench/flash.txt";

pub(crate) struct Flash {
    /// Bytes more than the empty image has.
    pub(crate) sizes: BTreeMap<(&'static str, Build), u64>,
    /// Bytes of code on the M3 at level 3, by the library's files.
    pub(crate) files: BTreeMap<&'static str, BTreeMap<String, u64>>,
}

pub(crate) fn measure(rebase: bool, failures: &mut Vec<String>) -> Result<Flash> {
    let (mut sizes, mut files) = (BTreeMap::new(), BTreeMap::new());
    for build in BUILDS {
        let bins = ["empty"].into_iter().chain(IMAGES.iter().map(|image| image.name));
        let bins: Vec<String> = bins.map(|name| format!("--bin=flash_{name}")).collect();
        build.cargo("build", &bins.iter().map(String::as_str).collect::<Vec<_>>())?;
        let image = |name: &str| build.image(&format!("flash_{name}"));
        let empty = elf::sizes(&image("empty"))?.flash;
        let sources = |name| provenance::of(&image(name));
        let witness = sources(WITNESS)?;
        for &Image { name, without, .. } in IMAGES {
            sizes.insert((name, build), elf::sizes(&image(name))?.flash.saturating_sub(empty));
            let from = sources(name)?;
            for part in without {
                let bytes = |from: &BTreeMap<String, u64>| -> u64 {
                    from.iter().filter(|(file, _)| file.starts_with(part)).map(|(_, bytes)| bytes).sum()
                };
                let (held, seen) = (bytes(&from), bytes(&witness));
                let where_ = format!("{} at {}", build.target, build.level);
                if held > 0 {
                    failures.push(format!("{where_}: {name} holds {held} bytes of {part}"));
                }
                if seen == 0 {
                    failures.push(format!("{where_}: {WITNESS} holds nothing of {part}: the check is blind"));
                }
            }
            if build == BUILDS[0] {
                files.insert(name, from);
            }
        }
    }
    limits(rebase, &sizes, failures)?;
    Ok(Flash { sizes, files })
}

/// At most 5 % more than what was once committed.
fn limits(
    rebase: bool,
    sizes: &BTreeMap<(&'static str, Build), u64>,
    failures: &mut Vec<String>,
) -> Result<()> {
    let path = cross::root().join(LIMITS);
    if rebase {
        let mut text = String::from("# Bytes of flash above the empty image; 5 % more fail. `tools/bench/run --rebase` writes this.\n");
        for ((name, Build { target, level }), bytes) in sizes {
            writeln!(text, "{target} {level} {name} {bytes}")?;
        }
        std::fs::write(path, text)?;
        return Ok(());
    }
    let text = std::fs::read_to_string(path).map_err(|error| format!("{LIMITS}: {error}"))?;
    for ((name, Build { target, level }), &bytes) in sizes {
        let line = format!("{target} {level} {name} ");
        let limit =
            text.lines().find_map(|l| l.strip_prefix(&line)).and_then(|bytes| bytes.parse::<u64>().ok());
        match limit {
            Some(limit) if bytes * 100 <= limit * 105 => {}
            Some(limit) => failures.push(format!("{line}: {bytes} bytes, 5 % above {limit} are allowed")),
            None => failures.push(format!("{line}: no limit in {LIMITS}")),
        }
    }
    Ok(())
}
