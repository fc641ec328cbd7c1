//! Flash, variables and stack of single-feature images, minus the empty one; and a check that no image links unused features.

#[path = "../../../tests/device/floats.rs"]
mod floats;

use crate::core::Build;
use crate::data::{row, Row};
use crate::provenance::Provenance;
use crate::{elf, Result, M0, M3, RV32};
use floats::is_float_routine;
use serde_json::json;
use std::path::Path;

pub(crate) const BUILDS: [Build; 5] = [
    Build { target: M3, level: "3" },
    Build { target: M3, level: "s" },
    Build { target: M0, level: "3" },
    Build { target: M0, level: "s" },
    Build { target: RV32, level: "3" },
];
const ARM: &[Build] = &[BUILDS[0], BUILDS[1], BUILDS[2], BUILDS[3]];
/// Ways to draw that only the planner compares: at the opt-level whose times it knows.
const FAST: &[Build] = &[BUILDS[0], BUILDS[2], BUILDS[4]];
/// Features that are compared with an image that lacks them, by their difference.
pub(crate) const M3_AT_3: &[Build] = &[BUILDS[0]];

/// An image of `src/bin/flash_*.rs`.
struct Image {
    name: &'static str,
    says: &'static str,
    /// Files and folders of the library of which it must not hold any code. The image [`WITNESS`] holds code of all of them,
    /// otherwise the check would be blind.
    without: &'static [&'static str],
    builds: &'static [Build],
}

const fn image(
    name: &'static str,
    says: &'static str,
    without: &'static [&'static str],
    builds: &'static [Build],
) -> Image {
    Image { name, says, without, builds }
}

const ALL: &[&str] = &[];
const DITHER: &str = "shading/dither.rs";
const SMOOTH: &[&str] = &[DITHER];
const FLAT: &[&str] = &["shading/gouraud.rs", DITHER];
const NO_DEPTH: &[&str] = &["raster/depth.rs", "surface/depth.rs", "shading/gouraud.rs", DITHER];
const NO_FACES: &[&str] = &[
    "raster/depth.rs",
    "surface/depth.rs",
    "raster/gradient.rs",
    "raster/edge.rs",
    "fast/edge20.rs",
    "fast/small_triangle.rs",
    "fast/bresenham_triangle.rs",
    "raster/trapezoid.rs",
    "shading/",
];
/// Strokes are parts of `shading/`, too.
const LINES_ONLY: &[&str] = &[
    "raster/depth.rs",
    "surface/depth.rs",
    "shading/gouraud.rs",
    DITHER,
    "raster/gradient.rs",
    "raster/edge.rs",
    "fast/edge20.rs",
    "fast/small_triangle.rs",
    "fast/bresenham_triangle.rs",
    "raster/trapezoid.rs",
];
const SPRITES: &[&str] = &[
    "raster/depth.rs",
    "surface/depth.rs",
    "raster/gradient.rs",
    "raster/edge.rs",
    "raster/trapezoid.rs",
    "shading/gouraud.rs",
    DITHER,
];

/// Links everything that other images must not link.
const WITNESS: &str = "dither";

const IMAGES: &[Image] = &[
    image("place", "a placed mesh", NO_FACES, &BUILDS),
    image("camera", "a placed mesh, and a camera made at run time", NO_FACES, ARM),
    image("wireframe_inside", "wireframe, without clipping", NO_FACES, ARM),
    image("wireframe", "wireframe", NO_FACES, ARM),
    image("wireframe_pixels", "wireframe, into a DrawTarget in memory", NO_FACES, &BUILDS),
    image("wireframe_smooth", "wireframe, anti-aliased, into a picture", LINES_ONLY, ARM),
    image("wireframe_bands", "wireframe in bands", NO_FACES, &BUILDS),
    image("solid", "flat faces", NO_DEPTH, ARM),
    image("solid_inside", "flat faces, without clipping", NO_DEPTH, ARM),
    image("picture", "flat faces, into a picture in memory", NO_DEPTH, &BUILDS),
    image("solid_bands", "flat faces in bands, into `pixels()`", NO_DEPTH, &BUILDS),
    image("depth", "flat faces with depth", FLAT, ARM),
    image("depth_bands", "flat faces with depth in bands", FLAT, &BUILDS),
    image("depth_pixels", "flat faces with depth in bands, into `pixels()`", FLAT, &BUILDS),
    image(
        "framing",
        "flat faces with depth in bands, into `pixels()`, before a camera that frames them",
        FLAT,
        FAST,
    ),
    image("dither", "smooth faces in dithered colours, with depth, in bands", ALL, &BUILDS),
    image("depth_picture", "flat faces with depth, into a picture in memory", FLAT, FAST),
    image("gouraud_pixels", "smooth faces with depth in bands, into `pixels()`", SMOOTH, FAST),
    image(
        "flat_dither_pixels",
        "flat faces in dithered colours, with depth, in bands, into `pixels()`",
        ALL,
        FAST,
    ),
    image(
        "dither_pixels",
        "smooth faces in dithered colours, with depth, in bands, into `pixels()`",
        ALL,
        FAST,
    ),
    image("textured_pixels", "textured faces with depth in bands, into `pixels()`", FLAT, FAST),
    image("painter", "flat faces in painter's order, into a picture in memory", FLAT, FAST),
    image("painter_bands", "flat faces in painter's order, in bands, into `pixels()`", FLAT, FAST),
    image("hidden_bands", "hidden lines in bands", FLAT, FAST),
    image("textured", "textured faces, into a picture in memory", NO_DEPTH, M3_AT_3),
    image("color", "faces of constant colours, into a picture in memory", NO_DEPTH, M3_AT_3),
    image(
        "screen_door",
        "faces of constant colours behind a screen door, into a picture in memory",
        NO_DEPTH,
        M3_AT_3,
    ),
    image("half", "faces of constant colours, half mixed, into a picture in memory", NO_DEPTH, M3_AT_3),
    image("fogged", "faces of constant colours in fog by pixel, into a picture in memory", FLAT, M3_AT_3),
    image("keyed", "textured faces with a transparent colour, into a picture in memory", NO_DEPTH, M3_AT_3),
    image("shades", "smooth faces by a shade table, into a picture in memory", NO_DEPTH, M3_AT_3),
    image(
        "vertex_fog",
        "faces in fog by vertex, by a shade table, into a picture in memory",
        NO_DEPTH,
        M3_AT_3,
    ),
    image("sprites", "sprites with a transparent colour, into a picture in memory", SPRITES, M3_AT_3),
    image("everything", "everything", ALL, ARM),
    image("everything_inside", "everything, without clipping", ALL, ARM),
];

/// The images of a build.
fn images(build: Build) -> impl Iterator<Item = &'static Image> {
    IMAGES.iter().filter(move |image| image.builds.contains(&build))
}

/// Whether the library has this part for this core: cores with a division instruction and cores without have different code.
fn is_for(part: &str, build: Build) -> bool {
    match part {
        "fast/edge20.rs" | "fast/small_triangle.rs" => build.target != M0,
        "fast/bresenham_triangle.rs" => build.target == M0,
        _ => true,
    }
}

/// Measures the images in these builds.
pub(crate) fn measure(builds: &[Build], failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for &build in builds {
        let names = ["empty"].into_iter().chain(images(build).map(|image| image.name));
        build.cargo("build", &names.map(|name| format!("--bin=flash_{name}")).collect::<Vec<_>>())?;
        let file = |name: &str| build.image(&format!("flash_{name}"));
        let empty = elf::sizes(&file("empty"))?.flash;
        let witness = Provenance::of(&file(WITNESS))?;
        for &Image { name, says, without, .. } in images(build) {
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
            rows.push(row([
                ("image", json!(name)),
                ("target", json!(build.target)),
                ("level", json!(build.level)),
                ("says", json!(says)),
                ("flash", json!(flash.saturating_sub(empty))),
                ("variables", json!(statics)),
                ("stack", json!(stack)),
            ]));
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
