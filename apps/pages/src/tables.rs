//! The tables by their names.

use crate::data::{number, row, rows, shown, signed, table, Row};
use serde_json::Value;

pub(crate) fn table_of(name: &str) -> Result<String, String> {
    match name {
        "comparison" => comparison(),
        "scenes" => scenes(),
        "variants" => variants(),
        "memory" => memory(),
        "cycles" => cycles(),
        "frames" => frames(),
        "bands" => bands(),
        "cores" => cores(),
        "cycles per instruction" => cycles_per_instruction(),
        "footprint" => footprint(),
        "features" => features(),
        _ => match name.strip_prefix("growth ") {
            Some(way) => growth(way),
            None => Err("unknown".into()),
        },
    }
}

const CORES: [&str; 4] = ["M0", "M3", "M4F", "RV32"];

fn cell<'a>(cells: &'a [Row], scene: &str, variant: &str, core: &str) -> Option<&'a Row> {
    row(cells, &[("scene", scene), ("variant", variant), ("core", core)]).ok()
}

/// The figure of a cell, or a dash.
fn figure(cells: &[Row], [scene, variant, core]: [&str; 3], column: &str) -> String {
    shown(cell(cells, scene, variant, core).and_then(|row| row.get(column)))
}

/// The scene, with the variant unless that is `plain`.
fn named(scene: &str, variant: &str) -> String {
    if variant == "plain" {
        scene.into()
    } else {
        format!("{scene} {variant}")
    }
}

/// The fastest other library with a projection and faces on a cell, and its instructions.
fn best<'a>(rivals: &'a [Row], scene: &str, variant: &str, core: &str) -> Option<(&'a str, i64)> {
    let is_of_cell = |row: &&Row| {
        [("scene", scene), ("variant", variant), ("core", core)]
            .iter()
            .all(|(column, value)| row.get(*column).and_then(Value::as_str) == Some(value))
    };
    let of_cell = rivals.iter().filter(is_of_cell);
    let known = of_cell.filter_map(|row| Some((row["library"].as_str()?, row["instructions"].as_i64()?)));
    known.filter(|(library, _)| *library != "embedded-graphics").min_by_key(|of| of.1)
}

/// The README's: speed and memory of a whole frame and of one in bands, and those of other libraries, which draw whole frames.
fn comparison() -> Result<String, String> {
    let (cells, rivals) = (rows("cells")?, rows("rivals")?);
    let (whole, banded) = ("z", "bands8-z");
    let mut lines = Vec::new();
    for core in ["M0", "M3", "M4F"] {
        let (library, count) = best(&rivals, "S3", "z", core).ok_or("no other library")?;
        let [whole, banded] = [whole, banded].map(|way| figure(&cells, ["S3", way, core], "instructions"));
        lines.push(vec![
            format!("instructions, Cortex-{core}"),
            whole,
            banded,
            format!("{library} {}", signed(count)),
        ]);
    }
    let mut peers: Vec<&Row> = rivals.iter().filter(|row| row.contains_key("code")).collect();
    let mut others = |bytes: fn(&Row) -> Option<i64>| {
        peers.sort_by_key(|peer| bytes(peer));
        let one = |peer: &&Row| {
            format!("{} {} KB", shown(peer.get("library")), (bytes(peer).unwrap_or(0) + 500) / 1000)
        };
        peers.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    let ways = [whole, banded].map(|way| cell(&cells, "S3", way, "M3").ok_or("no such cell"));
    let of_ways = |bytes: &dyn Fn(&Row) -> Result<i64, String>| {
        let [whole, banded] = ways;
        Ok::<_, String>([signed(bytes(whole?)?), signed(bytes(banded?)?)])
    };
    let [whole, banded] = of_ways(&|cell| Ok(number(cell, "ram")? as i64 + number(cell, "stack")? as i64))?;
    let frames = others(|peer| Some(peer.get("depth")?.as_i64()? + peer.get("frame")?.as_i64()?));
    lines.push(vec!["bytes of RAM, stack included".into(), whole, banded, frames]);
    let [whole, banded] = of_ways(&|cell| Ok(number(cell, "flash")? as i64 - TORUS))?;
    let theirs = others(|peer| peer.get("code")?.as_i64());
    lines.push(vec!["bytes of code, without the mesh".into(), whole, banded, theirs]);
    Ok(table(&["", "whole frame", "bands of 8 rows", "other libraries, whole frame"], lines))
}

/// The torus in flash: 500 vertices of 6 bytes, and 1000 faces with a normal and a plane.
const TORUS: i64 = 500 * 6 + 1000 * (6 + 6 + 2);

/// The cells that other libraries can draw.
const SCENES: [[&str; 2]; 11] = [
    ["S1", "plain"],
    ["S2", "plain"],
    ["S2", "z"],
    ["S3", "plain"],
    ["S3", "z"],
    ["S4", "plain"],
    ["S4", "z"],
    ["S5", "plain"],
    ["S6", "plain"],
    ["S7", "plain"],
    ["S8", "z"],
];

fn scenes() -> Result<String, String> {
    let (cells, rivals) = (rows("cells")?, rows("rivals")?);
    let line = |[scene, variant]: [&str; 2]| {
        let mut line = vec![named(scene, variant)];
        line.extend(CORES.map(|core| figure(&cells, [scene, variant, core], "instructions")));
        for core in ["M0", "M4F"] {
            let other = best(&rivals, scene, variant, core);
            line.push(other.map_or("–".into(), |(library, count)| format!("{library} {}", signed(count))));
        }
        line
    };
    let header = ["scene", "M0", "M3", "M4F", "RV32", "best other, M0", "best other, M4F"];
    Ok(table(&header, SCENES.map(line)))
}

/// What else a frame may have, with what it is.
const VARIANTS: [[&str; 3]; 21] = [
    ["S3", "no-planes", "S3 without face planes"],
    ["S3", "no-planes-z", "– with depth"],
    ["S3", "wire", "S3, all 1500 edges"],
    ["S3", "smooth", "– anti-aliased"],
    ["S3", "dt", "S3 into a DrawTarget of the firmware"],
    ["S3", "dt-z", "– with depth"],
    ["S3", "z-s", "S3 with depth, built at opt-level s"],
    ["C1", "plain", "S3's torus cut by the near plane, without face planes"],
    ["C1", "z", "– with depth"],
    ["C1", "planes", "– with face planes"],
    ["T1", "plain", "S1 turning: the object is placed in the frame"],
    ["F50", "z", "50 cubes with depth, 25 of them in view, placed in the frame"],
    ["X1", "plain", "S3's torus, textured"],
    ["X1", "z", "– with depth"],
    ["X2", "plain", "a textured floor over the picture"],
    ["G1", "plain", "S3 in fog by pixel"],
    ["G1", "z", "– with depth"],
    ["B1", "z", "50 keyed sprites of 16 × 16 texels, with depth"],
    ["S5", "half", "S5 blended in equal parts"],
    ["S5", "alpha", "S5 blended by an alpha"],
    ["S6", "smooth", "S6 anti-aliased"],
];

fn variants() -> Result<String, String> {
    let cells = rows("cells")?;
    let line = |[scene, variant, says]: [&str; 3]| {
        let mut line = vec![says.to_string(), named(scene, variant)];
        line.extend(CORES.map(|core| figure(&cells, [scene, variant, core], "instructions")));
        line
    };
    Ok(table(&["frame", "cell", "M0", "M3", "M4F", "RV32"], VARIANTS.map(line)))
}

fn memory() -> Result<String, String> {
    let cells = rows("cells")?;
    let more = [["S3", "bands8-z"], ["S4", "bands8-z"]];
    let line = |[scene, variant]: [&str; 2]| {
        let mut line = vec![named(scene, variant)];
        line.extend(["flash", "ram", "stack"].map(|column| figure(&cells, [scene, variant, "M3"], column)));
        line
    };
    Ok(table(&["cell", "flash", "RAM", "stack"], SCENES.into_iter().chain(more).map(line)))
}

fn cycles() -> Result<String, String> {
    let (cycles, cores) = (rows("cycles")?, ["M0", "M0+", "M3", "M4", "M33"]);
    let line = |[scene, variant]: [&str; 2]| {
        let mut line = vec![named(scene, variant)];
        line.extend(cores.map(|core| figure(&cycles, [scene, variant, core], "cycles")));
        line
    };
    Ok(table(&["scene", "M0", "M0+", "M3", "M4", "M33"], SCENES.map(line)))
}

/// S3 with depth and S1 on each chip in bands.
fn frames() -> Result<String, String> {
    let (chips, frames) = (rows("chips")?, rows("frames")?);
    let mut lines = Vec::new();
    for chip in chips.iter().filter(|chip| chip.contains_key("rows")) {
        for (scene, variant) in [("S1", "wire"), ("S3", "z")] {
            let is_it = |frame: &&Row| {
                frame["chip"] == chip["chip"]
                    && frame["scene"] == scene
                    && frame["variant"] == variant
                    && frame["rows"] == chip["rows"]
            };
            let frame = frames.iter().find(is_it).ok_or("a frame is missing")?;
            let mut line = vec![shown(chip.get("chip")), named(scene, variant)];
            line.extend(
                ["rows", "drawing_ms", "waits_percent", "fps_blocking", "fps_dma"]
                    .map(|column| shown(frame.get(column))),
            );
            lines.push(line);
        }
    }
    let header = ["chip", "scene", "rows", "drawing, ms", "waits, %", "fps, blocking", "fps, DMA"];
    Ok(table(&header, lines))
}

fn bands() -> Result<String, String> {
    let cells = rows("cells")?;
    let mut lines = Vec::new();
    for depth in ["", "-z"] {
        for core in CORES {
            let count = |variant: &str| {
                let variant = format!("{variant}{depth}");
                let cell = cell(&cells, "S3", &variant, core).ok_or_else(|| format!("no {variant}"))?;
                number(cell, "instructions")
            };
            let [full, high, low] = [count("full")?, count("bands16")?, count("bands8")?];
            let what = if depth.is_empty() { "without depth" } else { "with depth" };
            let mut line = vec![format!("{what}, {core}")];
            line.extend([full, high, low].map(|count| signed(count as i64)));
            line.extend([high, low].map(|count| format!("{:.2}", count / full)));
            lines.push(line);
        }
    }
    let header =
        ["S3", "in one piece", "bands of 16 rows", "of 8 rows", "16 rows / one piece", "8 rows / one piece"];
    Ok(table(&header, lines))
}

fn cores() -> Result<String, String> {
    let mut lines = Vec::new();
    for row in rows("cores")? {
        let text = |column: &str| shown(row.get(column));
        let share = number(&row, "frame")? / number(&row, "one")?;
        let what = format!("{}, code for {}", named(&text("scene"), &text("variant")), text("core"));
        lines.push(vec![what, text("one"), text("frame"), format!("{share:.2}")]);
    }
    Ok(table(&["scene", "one core", "two cores", "two / one"], lines))
}

fn cycles_per_instruction() -> Result<String, String> {
    let mut lines = Vec::new();
    for row in rows("chips")? {
        let list = |column: &str| row.get(column).and_then(Value::as_array).cloned().unwrap_or_default();
        let [all, least, most, ideal] = ["cycles", "least", "most", "cycles_without_waits"].map(list);
        let of = |at: usize| {
            let one = shown(all.get(at));
            match (least.get(at), most.get(at)) {
                (Some(least), Some(most)) => format!("{one} ({least}–{most})"),
                _ if ideal.get(at) == all.get(at) => one,
                _ => format!("{one}, {} without waits", shown(ideal.get(at))),
            }
        };
        lines.push(vec![shown(row.get("chip")), shown(row.get("mhz")), of(0), of(1), of(2)]);
    }
    Ok(table(&["chip", "MHz", "lines", "faces", "faces with depth"], lines))
}

/// The constants of a way to draw on all cores.
fn growth(way: &str) -> Result<String, String> {
    let rows = rows("growth")?;
    let of_cores = CORES.map(|core| row(&rows, &[("way", way), ("core", core)]));
    let [m0, m3, m4, rv] = of_cores;
    let cores = [m0?, m3?, m4?, rv?];
    let list =
        |row: &Row, column: &str| row.get(column).and_then(Value::as_array).cloned().unwrap_or_default();
    let mut lines = Vec::new();
    for (at, name) in list(cores[0], "names").iter().enumerate() {
        let mut line = vec![shown(Some(name))];
        line.extend(cores.map(|core| shown(list(core, "constants").get(at))));
        lines.push(line);
    }
    if way != "placing" {
        let mut line = vec!["largest error of a frame, %".to_string()];
        line.extend(cores.map(|core| {
            let largest =
                |column: &str| list(core, column).get(1).and_then(Value::as_f64).unwrap_or_default();
            largest("mean_and_largest_error_in_the_fit")
                .max(largest("mean_and_largest_error_elsewhere"))
                .to_string()
        }));
        lines.push(line);
    }
    Ok(table(&["", "M0", "M3", "M4F", "RV32"], lines))
}

/// The images that a user chooses from.
const IMAGES: [&str; 24] = [
    "place",
    "camera",
    "wireframe_inside",
    "wireframe",
    "wireframe_smooth",
    "wireframe_bands",
    "hidden_bands",
    "solid_inside",
    "solid",
    "picture",
    "solid_bands",
    "depth",
    "depth_picture",
    "depth_bands",
    "depth_pixels",
    "framing",
    "gouraud_pixels",
    "flat_dither_pixels",
    "dither_pixels",
    "textured_pixels",
    "painter",
    "painter_bands",
    "everything_inside",
    "everything",
];

fn footprint() -> Result<String, String> {
    let rows = rows("footprint")?;
    let line = |image: &str| {
        let of = |target: &str, level: &str, column: &str| {
            let row = row(&rows, &[("image", image), ("target", target), ("level", level)]).ok();
            shown(row.and_then(|row| row.get(column)))
        };
        let [m0, m3, rv] = ["thumbv6m-none-eabi", "thumbv7m-none-eabi", "riscv32imc-unknown-none-elf"];
        vec![
            of(m3, "3", "says"),
            of(m0, "3", "flash"),
            of(m3, "3", "flash"),
            of(m3, "s", "flash"),
            of(rv, "3", "flash"),
            of(m3, "3", "variables"),
            of(m0, "3", "stack"),
            of(m3, "3", "stack"),
        ]
    };
    let header = [
        "firmware",
        "M0: flash",
        "M3: flash",
        "M3, s: flash",
        "RV32: flash",
        "variables",
        "M0: stack",
        "M3: stack",
    ];
    Ok(table(&header, IMAGES.map(line)))
}

/// A feature, an image with it, and one that draws alike without it.
const FEATURES: [[&str; 3]; 6] = [
    ["a screen door", "screen_door", "color"],
    ["half mixed", "half", "color"],
    ["a transparent colour", "keyed", "textured"],
    ["fog by vertex", "vertex_fog", "shades"],
    ["fog by pixel", "fogged", "color"],
    ["sprites", "sprites", "place"],
];

fn features() -> Result<String, String> {
    let rows = rows("footprint")?;
    let of = |image| row(&rows, &[("image", image), ("target", "thumbv7m-none-eabi"), ("level", "3")]);
    let mut lines = Vec::new();
    for [feature, with, without] in FEATURES {
        let added = number(of(with)?, "flash")? - number(of(without)?, "flash")?;
        lines.push(vec![feature.into(), shown(of(without)?.get("says")), signed(added as i64)]);
    }
    Ok(table(&["feature", "beyond", "flash"], lines))
}
