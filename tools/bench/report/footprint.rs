//! Flash, variables and stack of linking only what is used: of images less the empty one, and what these must not hold.

use crate::cross::{self, Build};
use crate::provenance::{Part, Provenance};
use crate::{elf, Result, M0, M3};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The builds, in the order of the page's columns.
pub(crate) const BUILDS: [Build; 4] = [
    Build { target: M3, level: "3" },
    Build { target: M3, level: "s" },
    Build { target: M0, level: "3" },
    Build { target: M0, level: "s" },
];

/// An image, and the parts of the library that it must hold nothing of. All of these are in the image `WITNESS`, or the
/// check would be blind.
pub(crate) struct Image {
    pub(crate) name: &'static str,
    /// On the page.
    pub(crate) says: &'static str,
    /// What it is to come down to on the M3 at level 3.
    pub(crate) goal: Option<u64>,
    without: &'static [Part],
}

/// What the stack of all of them is to come down to on the M3 at level 3, the program's own frames included.
pub(crate) const STACK: u64 = 1536;

const DITHER: Part = Part("shade/dither.rs", None);
const FLAT: &[Part] = &[Part("shade/gouraud.rs", None), DITHER];
const NO_DEPTH: &[Part] = &[Part("raster/depth.rs", None), Part("output/depth.rs", None), FLAT[0], DITHER];
const NO_FACES: &[Part] = &[
    NO_DEPTH[0],
    NO_DEPTH[1],
    Part("raster/plane.rs", None),
    Part("raster/edge.rs", None),
    Part("raster/side.rs", None),
    Part("raster/halves.rs", None),
    Part("raster/walk.rs", None),
    Part("raster/stretch.rs", None),
    Part("shade/", None),
];

pub(crate) const IMAGES: &[Image] = &[
    Image { name: "place", says: "a placed mesh", goal: None, without: NO_FACES },
    Image { name: "camera", says: "and a camera made at run time", goal: None, without: NO_FACES },
    Image { name: "wireframe", says: "wireframe", goal: Some(6 << 10), without: NO_FACES },
    Image { name: "wireframe_bands", says: "wireframe in bands", goal: None, without: NO_FACES },
    Image { name: "solid", says: "flat faces", goal: None, without: NO_DEPTH },
    Image { name: "depth", says: "flat faces with depth", goal: Some(10 << 10), without: FLAT },
    Image { name: "depth_bands", says: "flat faces with depth in bands", goal: None, without: FLAT },
    Image { name: "gouraud", says: "smooth faces with depth in bands", goal: None, without: &[DITHER] },
    Image { name: "dither", says: "the same, dithered", goal: None, without: &[] },
    Image { name: "everything", says: "everything", goal: Some(20 << 10), without: &[] },
];

/// Has all that others must not have.
const WITNESS: &str = "dither";
const LIMITS: &str = "tools/bench/footprint.txt";

pub(crate) struct Footprint {
    pub(crate) sizes: BTreeMap<(&'static str, Build), Size>,
    /// Where the code comes from, on the M3 at level 3.
    pub(crate) code: BTreeMap<&'static str, Provenance>,
}

/// In bytes.
#[derive(Clone, Copy)]
pub(crate) struct Size {
    /// More than the empty image has.
    pub(crate) flash: u64,
    pub(crate) variables: u64,
    pub(crate) stack: u64,
}

/// All images, as arguments for cargo.
pub(crate) fn bins() -> Vec<String> {
    let names = ["empty"].into_iter().chain(IMAGES.iter().map(|image| image.name));
    names.map(|name| format!("--bin=flash_{name}")).collect()
}

/// Whether the library has that for this core: one that divides has another way than one that does not.
fn is_for(Part(file, _): &Part, build: Build) -> bool {
    match *file {
        "raster/side.rs" | "raster/halves.rs" => build.target == M3,
        "raster/walk.rs" => build.target == M0,
        _ => true,
    }
}

pub(crate) fn measure(rebase: bool, failures: &mut Vec<String>) -> Result<Footprint> {
    let (mut sizes, mut code) = (BTreeMap::new(), BTreeMap::new());
    for build in BUILDS {
        build.cargo("build", &bins())?;
        let image = |name: &str| build.image(&format!("flash_{name}"));
        let empty = elf::sizes(&image("empty"))?.flash;
        let witness = Provenance::of(&image(WITNESS))?;
        for &Image { name, without, .. } in IMAGES {
            let elf::Sizes { flash, statics, .. } = elf::sizes(&image(name))?;
            let (_, stack) = build.run(&format!("flash_{name}"))?;
            let size = Size { flash: flash.saturating_sub(empty), variables: statics, stack };
            sizes.insert((name, build), size);
            let from = Provenance::of(&image(name))?;
            for &part in without.iter().filter(|&part| is_for(part, build)) {
                let Part(file, function) = part;
                let part_name = format!("{file} {}", function.unwrap_or_default());
                let (held, seen) = (from.because_of(part), witness.because_of(part));
                if held > 0 {
                    failures.push(format!("{build}: {name} holds {held} bytes of {part_name}"));
                }
                if seen == 0 {
                    failures
                        .push(format!("{build}: {WITNESS} holds nothing of {part_name}: the check is blind"));
                }
            }
            if build == BUILDS[0] {
                code.insert(name, from);
            }
        }
    }
    limits(rebase, &sizes, failures)?;
    Ok(Footprint { sizes, code })
}

/// At most 5 % more than what was once committed.
fn limits(
    rebase: bool,
    sizes: &BTreeMap<(&'static str, Build), Size>,
    failures: &mut Vec<String>,
) -> Result<()> {
    let path = cross::root().join(LIMITS);
    if rebase {
        let mut text = String::from("# Bytes of flash above the empty image; 5 % more fail. `tools/bench/run --rebase` writes this.\n");
        for ((name, Build { target, level }), Size { flash, .. }) in sizes {
            writeln!(text, "{target} {level} {name} {flash}")?;
        }
        std::fs::write(path, text)?;
        return Ok(());
    }
    let text = std::fs::read_to_string(path).map_err(|error| format!("{LIMITS}: {error}"))?;
    for ((name, Build { target, level }), &Size { flash: bytes, .. }) in sizes {
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
