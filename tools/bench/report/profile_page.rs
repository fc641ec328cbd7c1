//! `docs/profile.md`.

use crate::cells::Cell;
use crate::grouped::grouped;
use crate::page::BUILT;
use crate::profile::{Profile, APART};
use crate::prototype::{prototype, Noted};
use crate::speed_page::shown;
use crate::stages::{Stage, STAGES};
use crate::targets::Target;
use crate::Result;
use bench::cells::{placed, CELLS, NO_PLANES};
use bench::tally::{units, Units};
use std::fmt::Write;

const HEAD: &str = "\
# Where a frame's instructions go

The frames of [speed.md](speed.md), stage by stage: the instructions of each stage per vertex, face, row and pixel, compared with a
prototype; the least work of each stage; and the designs that were tried. This page is written by

```sh
tools/bench/run profile
```

";

/// What follows the tables.
const FLOORS: &str = include_str!("floors.md");

const HOW: &str = "
## How it is counted

Each cell's firmware runs once more, and the emulator writes a log of every block of code that it executes. The firmware's debug
information names the source function of each instruction, inlined or not; functions are grouped into stages. A function that
belongs to no stage, such as a wide product or a division on an M0, counts for the stage that calls it. Only the measured
frame counts.";

/// The description of a stage.
struct About {
    title: &'static str,
    /// The item that it processes.
    unit: &'static str,
    what: &'static str,
    count: fn(&Work) -> u32,
}

/// The work of a cell.
struct Work {
    units: Units,
    /// The number of transformed vertices.
    placed: u32,
}

/// The work of a scene. All vertices must be transformed, unless faces are culled by planes.
fn work(scene: &str) -> Result<Work> {
    let units = units(scene).ok_or(scene)?;
    let variants = CELLS.iter().filter(|cell| cell.0 == scene).map(|cell| placed(scene, cell.1));
    let placed: Vec<u32> =
        variants.map(|count| count.map(|count| count as u32)).collect::<Option<_>>().ok_or(scene)?;
    let by_planes = NO_PLANES.iter().any(|cell| cell.0 == scene);
    match placed[..] {
        [placed, ref others @ ..]
            if others.iter().all(|other| *other == placed)
                && (placed == units.vertices || by_planes && (1..units.vertices).contains(&placed)) =>
        {
            Ok(Work { units, placed })
        }
        _ => Err(format!("{scene}: {placed:?} of {} vertices placed", units.vertices).into()),
    }
}

fn about(stage: Stage) -> About {
    let of = |title, unit, what, count| About { title, unit, what, count };
    match stage {
        Stage::Vertices => of(
            "vertices",
            "vertex transformed",
            "from the mesh to a screen vertex of 8 bytes, with depth",
            |work| work.placed,
        ),
        Stage::Light => of("light", "vertex", "S8 only: at each vertex, transformed or not", |work| work.units.vertices),
        Stage::Faces => of(
            "faces",
            "face",
            "its plane, if it has one; loading the corners, area, culling, counting; for lines and 2D triangles, reading them",
            |work| work.units.faces,
        ),
        Stage::PassingOn => of(
            "passing on",
            "face drawn",
            "a face's corners, light and colour, and the calls of the fill loops",
            |work| work.units.drawn,
        ),
        Stage::Sides => of(
            "sides",
            "face drawn",
            "sorting the corners, choosing a loop, start and slope of three edges",
            |work| work.units.drawn,
        ),
        Stage::Planes => {
            of("planes", "face drawn", "the gradient of depth over the triangle; for S8 the light's too", |work| work.units.drawn)
        }
        Stage::Rows => {
            of("rows", "row", "both ends, the row's memory, depth and colour at its start", |work| work.units.rows)
        }
        Stage::Pixels => of("pixels", "pixel", "tests of depth, colours, stores", |work| work.units.pixels),
        Stage::Clears => of("clear", "frame", "of the depth buffer", |_| 1),
        Stage::Lines => {
            of("lines", "line", "whether it must be clipped, its direction and slope", |work| work.units.drawn)
        }
        Stage::LinePixels => {
            of("pixels of lines", "pixel", "the loops along a line, with their set-up", |work| work.units.pixels)
        }
    }
}

pub(crate) fn text(compiler: &str, profiles: &[Profile], targets: &[Target]) -> Result<String> {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{HOW}");
    let apart = profiles.iter().map(Profile::apart).max().unwrap_or_default();
    write!(
        text,
        " Its stages add up to what the clock counted, within {apart} instructions (asserted: {APART}).\n\n"
    )?;
    text += "| stage | for one | |\n|---|---|---|\n";
    for About { title, unit, what, .. } in STAGES.map(about) {
        writeln!(text, "| {title} | {unit} | {what} |")?;
    }
    things(&mut text)?;
    for core in ["M3", "M0"] {
        whole(&mut text, core, profiles)?;
    }
    above(&mut text, profiles, targets)?;
    text += FLOORS;
    Ok(text)
}

const THINGS: &str = "
## How much there is to do

Counted on the host. S3, S4 and S8 are culled by planes, so only the vertices of possibly visible faces are transformed. Rows and pixels
are counted over all drawn faces, hidden later or not.

| scene | vertices | transformed | faces, edges or lines | drawn | rows | pixels |
|---|--:|--:|--:|--:|--:|--:|
";

fn things(text: &mut String) -> Result<()> {
    *text += THINGS;
    let mut scenes: Vec<&str> = CELLS.iter().map(|cell| cell.0).collect();
    scenes.dedup();
    for scene in scenes {
        let Work { units: Units { vertices, faces, drawn, rows, pixels }, placed } = work(scene)?;
        let columns = [vertices, placed, faces, drawn, rows, pixels].map(|count| grouped(count.into()));
        writeln!(text, "| {scene} | {} |", columns.join(" | "))?;
    }
    Ok(())
}

/// All scenes on a core.
fn whole(text: &mut String, core: &str, profiles: &[Profile]) -> Result<()> {
    let titles = STAGES.map(|stage| about(stage).title);
    write!(text, "\n## Instructions of the {core}\n\n| scene | | all | {} |\n", titles.join(" | "))?;
    writeln!(text, "|---|---|--:|{}", "--:|".repeat(STAGES.len()))?;
    for profile in profiles.iter().filter(|profile| profile.cell.core.name == core) {
        let Cell { scene, variant, instructions, .. } = profile.cell;
        let columns = STAGES.map(|stage| count(profile.of(stage)));
        writeln!(
            text,
            "| {scene} | {} | {} | {} |",
            shown(variant),
            grouped(instructions),
            columns.join(" | ")
        )?;
    }
    Ok(())
}

const ABOVE: &str = "
## Above the target

Per vertex, face, row and pixel, for each scene that exceeds its target on one of the cores. *Prototype* is the throw-away
program by which the targets were set, where its figures were noted, once for all scenes: it has no near plane, does not test
which vertices must be clipped, transforms all of them, and knows the width of the picture at compile time. *More* is the
library's additional instructions in that stage of the M3's frame. The work that both must do, and the library's own, is described
[below](#floors).
";

fn above(text: &mut String, profiles: &[Profile], targets: &[Target]) -> Result<()> {
    *text += ABOVE;
    let mut none = true;
    for &(scene, variant, _) in CELLS {
        let of = |core: &str| {
            let cell = |cell: &Cell| (cell.scene, cell.variant, cell.core.name) == (scene, variant, core);
            let target =
                targets.iter().find(|of| (of.scene, of.variant, of.core) == (scene, variant, core))?;
            Some((profiles.iter().find(|profile| cell(&profile.cell))?, target))
        };
        let [Some(m3), Some(m4), Some(m0)] = ["M3", "M4F", "M0"].map(of) else { continue };
        let more = |(profile, target): &(&Profile, &Target)| profile.cell.instructions > target.target;
        if [m3, m4, m0].iter().any(more) {
            none = false;
            each(text, [m3, m4, m0])?;
        }
    }
    if none {
        *text += "\nThere is none.\n";
    }
    Ok(())
}

fn each(text: &mut String, cores: [(&Profile, &Target); 3]) -> Result<()> {
    let [(m3, of), (m4, _), (m0, _)] = cores;
    let (scene, variant) = (of.scene, of.variant);
    let of_target = cores.map(|(profile, target)| {
        format!("{} {:.3}", target.core, profile.cell.instructions as f64 / target.target as f64)
    });
    let title = [scene, shown(variant)].join(" ");
    write!(text, "\n### {}\n\nTimes the target: {}.", title.trim(), of_target.join(", "))?;
    let work = work(scene)?;
    if variant == "plain" && m3.of(Stage::Pixels) > 0 {
        write!(text, " Pixels in pairs: {}.", grouped(u64::from(work.units.pixels) / 2))?;
    }
    *text += TABLE;
    for stage in STAGES.into_iter().filter(|stage| [m3, m4, m0].iter().any(|of| of.of(*stage) > 0)) {
        let About { title, unit, count, .. } = about(stage);
        let these = count(&work);
        // The prototype transforms all vertices.
        let then_these = if stage == Stage::Vertices { work.units.vertices } else { these };
        let noted = |core| prototype(stage, scene, variant, core);
        let [then_m3, then_m0] = ["M3", "M0"].map(|core| noted(core).map_or("–".into(), range));
        // Of sides and planes together, where there are planes.
        let ours = m3.of(stage) + if stage == Stage::Sides { m3.of(Stage::Planes) } else { 0 };
        let more = noted("M3").map_or("–".into(), |(from, to)| {
            let more = (ours as f64 - (from + to) / 2.0 * f64::from(then_these)).round();
            format!("{}{}", if more < 0.0 { "-" } else { "+" }, grouped(more.abs() as u64))
        });
        let with = if stage == Stage::Sides && m3.of(Stage::Planes) > 0 && then_m3 != "–" {
            ", with planes"
        } else {
            ""
        };
        let [m3, m4, m0] = [m3, m4, m0].map(|profile| one(profile.of(stage), these));
        let these = grouped(these.into());
        writeln!(
            text,
            "| {unit} | {title} | {these} | {m3} | {then_m3}{with} | {more} | {m4} | {m0} | {then_m0} |"
        )?;
    }
    writeln!(text, "\nDesigns tried with it: {}, [below](#what-was-tried).", tried(scene, variant))?;
    Ok(())
}

/// The number of rows in the table of designs tried that have a figure of this cell.
fn tried(scene: &str, variant: &str) -> usize {
    // Else the scene's name is enough.
    let both = CELLS.iter().filter(|cell| cell.0 == scene).count() > 1;
    let this = |row: &&str| {
        row.match_indices(scene)
            .any(|(at, name)| !both || row[at + name.len()..].starts_with(" z") == (variant == "z"))
    };
    let (_, rows) = FLOORS.split_once("## What was tried").unwrap_or_default();
    rows.lines().filter(|line| line.starts_with('|')).filter(this).count()
}

const TABLE: &str = "

| for one | stage | of these | M3 | prototype | more | M4F | M0 | prototype |
|---|---|--:|--:|--:|--:|--:|--:|--:|
";

/// The figure in the form in which it was noted.
fn range((from, to): Noted) -> String {
    let whole = |number: f64| match number.fract() == 0.0 {
        true => grouped(number as u64),
        false => number.to_string(),
    };
    match from == to {
        true => whole(from),
        false => format!("{} to {}", whole(from), whole(to)),
    }
}

/// Instructions per item.
fn one(instructions: u64, these: u32) -> String {
    let one = instructions as f64 / f64::from(these);
    match one < 100.0 {
        true => format!("{one:.1}"),
        false => grouped(one.round() as u64),
    }
}

fn count(instructions: u64) -> String {
    match instructions {
        0 => "–".into(),
        _ => grouped(instructions),
    }
}
