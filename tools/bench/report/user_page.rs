//! The part of `docs/speed.md` about scenes as users draw them.

use crate::cells::{Cell, FAST, MAIN, SMALL};
use crate::core::CORES;
use crate::grouped::grouped;
use crate::speed_page::{ratio, shown, Figures};
use crate::targets::Open;
use bench::cells::USER_CELLS;
use std::fmt::Write;

const HEAD: &str = "
## As users draw

The cells above are of objects that lie before the camera as a whole, whose transforms are set up beforehand, drawn in one piece into
memory. Here the near plane cuts them, they move, or pixels go into a DrawTarget or a band. Everything that a table does not mention
is as [above](#what-is-counted). *S* is the count at opt-level s. *Target* and *stretch* are for opt-level 3; nothing fails
where a target is not reached yet. *Once* is the best of S3L and TGX, measured once by another program on the same scene
and emulator; 3DG and EG are measured [in this run](#rivals-in-the-same-run). Where a rival has no figure it was not measured.
";

const NEAR: &str = "
### Near objects

S3's torus with its pose, lens (60°, near 0.5, far 20) and direction of view: C1 with the eye at distance 0.8 from the centre,
where the near plane cuts the torus, and C2 at 1.2. Parts of both lie behind the camera and beyond the borders of the picture.
*Planes*: the mesh with face planes, culled by them; all others: without. *Wire*: all 1500 edges. Not counted: the set-up
before the frame, as above. 3DG leaves parts out: it draws 9 to 14 % fewer pixels than there are.
";

const MOVING: &str = "
### Moving objects

T1: S1's cube, which turns by 3° a frame before a camera that stands still. Counted: its rotation, `Camera::place` and the
wireframe; the picture is S1's. F50: fifty of S2's cubes on a plane, each at another angle, before a camera that moves; 25 are in view.
Counted: the camera's view transform, and for each cube its transform (a rotation and a translation), the test whether its
bounding sphere is in view and, if so, its light, `Camera::place` and its faces or edges. Cubes come from the farthest to the
nearest; with *z* the depth buffer is cleared and tested. Not counted: the lens, and the clear of the picture. 3DG's figure is that of S1:
it sets its matrices up in each frame, but the rotation is given.
";

const DRAW_TARGET: &str = "
### Any DrawTarget

The scenes above, into a DrawTarget that is not this library's (`tools/bench/src/cells/screen.rs`): a slice of pixels with
`draw_iter`, `fill_contiguous` and `fill_solid`, each of which checks pixels and areas against the size. *Pixels* is
`Picture::pixels` on the same scene. The target's own instructions are counted; no bus is. 3DG and EG draw into this
target or into the library's picture, whichever takes fewer instructions.
";

const BANDS: &str = "
### Bands

S3 without planes in bands of 8 and of 16 rows by `Band::pixels`, and *full*, in one piece by `Picture::pixels`. Counted in all of them:
the clear of the picture and, with *z*, of the depth buffer, `Camera::place`, vertices, binning, light, faces and pixels. Not
counted: sending. *Of one piece* is the count divided by that of the frame in one piece; the targets are for this ratio.
";

const SMALL_BUILDS: &str = "
### Opt-level s

The library and the firmware at opt-level s; Rust's core library is built at 3, as it is shipped. From 3 to s TGX takes 8 % more,
and S3L 18 %, each measured once. The last rows have targets for opt-level 3 beyond those of [the cells](#the-cells).
";

pub(crate) fn text(figures: &Figures<'_>) -> String {
    let of = |wanted: fn(&str, &str) -> bool| {
        let cells = USER_CELLS.iter().map(|&(scene, variant, _)| (scene, variant));
        cells.filter(move |(scene, variant)| wanted(scene, variant))
    };
    let mut text = String::from(HEAD);
    text += NEAR;
    table(&mut text, figures, of(|scene, _| scene.starts_with('C')), None);
    text += MOVING;
    table(&mut text, figures, of(|scene, _| matches!(scene, "T1" | "F50")), None);
    text += DRAW_TARGET;
    table(&mut text, figures, of(|_, variant| variant.starts_with("dt")), Some("pixels"));
    text += BANDS;
    bands(&mut text, figures, of(|_, variant| variant.starts_with("bands") || variant.starts_with("full")));
    text += SMALL_BUILDS;
    small(&mut text, figures);
    text
}

/// How a scene is drawn into memory that is drawn otherwise in a variant. Lines and triangles in the plane, and S1, have no
/// other way than `plain`.
fn into_memory(scene: &str, variant: &'static str) -> &'static str {
    match variant {
        "dt" | "planes" => "plain",
        "dt-z" | "planes-z" => "z",
        "dt-wire" if scene == "S1" => "plain",
        "dt-wire" => "wire",
        variant => variant,
    }
}

fn table(
    text: &mut String,
    figures: &Figures<'_>,
    rows: impl Iterator<Item = (&'static str, &'static str)>,
    beside: Option<&str>,
) {
    let (title, line) = beside.map_or(("".into(), ""), |beside| (format!(" {beside} |"), "--:|"));
    let _ = writeln!(
        text,
        "\n| scene | | core | instructions |{title} s | target | stretch | once | | 3DG | EG |\n\
         |---|---|---|--:|{line}--:|--:|--:|---|--:|--:|--:|"
    );
    for (scene, variant) in rows {
        for core in CORES.map(|core| core.name) {
            let Some(cell) = figures.cell(scene, variant, core) else { continue };
            let memory = into_memory(scene, variant);
            let beside = match beside {
                Some(_) => format!(" {} |", count(figures.cell(scene, memory, core))),
                None => String::new(),
            };
            let [target, stretch] = aims(figures.open(scene, variant, FAST, core));
            let open = figures.open(scene, variant, FAST, core);
            let (once, best) = match open.and_then(|open| open.rival) {
                Some((rival, best)) => (rival, grouped(best)),
                None => ("–", "–".into()),
            };
            let rival = |name, scene| figures.rival(name, scene, memory, core).map_or("–".into(), grouped);
            let (gfx, graphics) =
                (rival("3DG", if scene == "T1" { "S1" } else { scene }), rival("EG", scene));
            let _ = writeln!(
                text,
                "| {scene} | {} | {core} | {} |{beside} {} | {target} | {stretch} | {once} | {best} | {gfx} | {graphics} |",
                shown(variant),
                grouped(cell.instructions),
                count(figures.at(scene, variant, SMALL, core)),
            );
        }
    }
}

fn bands(text: &mut String, figures: &Figures<'_>, rows: impl Iterator<Item = (&'static str, &'static str)>) {
    *text += "\n| scene | | core | instructions | of one piece | target | stretch |\n|---|---|---|--:|--:|--:|--:|\n";
    for (scene, variant) in rows {
        let full = if variant.ends_with("-z") { "full-z" } else { "full" };
        for core in CORES.map(|core| core.name) {
            let cells = figures.cell(scene, variant, core).zip(figures.cell(scene, full, core));
            let Some((cell, full)) = cells else { continue };
            let [target, stretch] = match figures.times(scene, variant, core) {
                Some(times) => [times.target, times.stretch].map(|times| format!("{times:.2}")),
                None => ["–", "–"].map(String::from),
            };
            let _ = writeln!(
                text,
                "| {scene} | {variant} | {core} | {} | {} | {target} | {stretch} |",
                grouped(cell.instructions),
                ratio(cell.instructions, full.instructions),
            );
        }
    }
}

fn small(text: &mut String, figures: &Figures<'_>) {
    *text +=
        "\n| scene | | core | at 3 | at s | s / 3 | target | stretch |\n|---|---|---|--:|--:|--:|--:|--:|\n";
    for (scene, variant) in MAIN {
        for core in CORES.map(|core| core.name) {
            let cells = figures.cell(scene, variant, core).zip(figures.at(scene, variant, SMALL, core));
            let Some((fast, small)) = cells else { continue };
            let [target, stretch] = aims(figures.open(scene, variant, SMALL, core));
            let _ = writeln!(
                text,
                "| {scene} | {} | {core} | {} | {} | {} | {target} | {stretch} |",
                shown(variant),
                grouped(fast.instructions),
                grouped(small.instructions),
                ratio(small.instructions, fast.instructions),
            );
        }
    }
    for open in figures.open.iter().filter(|open| open.level == FAST && !open.is_user_cell()) {
        let Some(cell) = figures.cell(open.scene, open.variant, open.core) else { continue };
        let [target, stretch] = aims(Some(open));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | | | {target} | {stretch} |",
            open.scene,
            shown(open.variant),
            open.core,
            grouped(cell.instructions),
        );
    }
}

fn count(cell: Option<&Cell>) -> String {
    cell.map_or("–".into(), |cell| grouped(cell.instructions))
}

fn aims(open: Option<&Open>) -> [String; 2] {
    match open {
        Some(open) => [open.target, open.stretch].map(grouped),
        None => ["–", "–"].map(String::from),
    }
}
