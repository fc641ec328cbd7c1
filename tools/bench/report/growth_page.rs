//! `docs/growth.md`.

use crate::grouped::grouped;
use crate::growth::{Drawn, Growth};
use crate::page::BUILT;
use bench::growth::{names, Way};
use std::fmt::Write;

const HEAD: &str = "\
# How a frame grows

What a vertex, a triangle, a row and a pixel take, and with that the time of a frame before it is written. This page is
written by

```sh
tools/bench/run growth
```

";

const FORMULA: &str = "
## The formula

Count what a frame has of each thing, and add up count × constant, from the column of your core:

    instructions = Σ count × constant
    time         = instructions × cycles per instruction / clock  +  pixels sent × 16 / SPI clock

The last two run beside each other where DMA sends one band while the next is drawn: then the longer of them counts. Cycles
for an instruction are your core's and its flash's: draw one frame of any scene on the board, count its cycles, and divide by what
the formula says. The counts are of one frame:

* *vertex*: of the mesh; each is transformed once. Where faces are asked by their planes (`Placed::facing`) only those of
  faces that are not known to be turned away are transformed, and count with these.
* *face left out*: turned away, or not in the picture; of a closed mesh about half. *Face drawn*: the others.
* *face to be clipped*: has a corner before the near plane or far outside the picture; none, where the object is before
  the camera as a whole; by planes, those turned away do not count. *Face cut*: of those, what was cut and drawn.
* *row of a face*: over all drawn faces, the rows of pixels in each. *Of a large face*: of one that is wider or
  higher than 64 pixels.
* *pixel of a face*: over all drawn faces, hidden later or not.
* *pixel of the picture*: width × height; it is cleared, and so is its depth.
* *band*; *face in a band*: over all bands, the faces that begin, end or go on in each: drawn faces and one more
  for every border between bands that a face lies across.

Who knows only the faces and the pixels that they cover together guesses the rows:
";

const CHECKED: &str = "
## Whether it holds

Constants are fitted by least squares of the relative error to tori of 24 to 20 000 triangles, to a sphere and to land, of
60 × 60 to 240 × 240 pixels, whole and cut by the near plane. The cases below had no part in that. *Off* is
what the formula says, over what was counted; the last column is the same with guessed rows.

| way | scene | picture | M0 counts | off | M3 counts | off | M4F counts | off | M3, rows guessed |
|---|---|---|--:|--:|--:|--:|--:|--:|--:|
";

pub(crate) fn text(compiler: &str, all: &[Growth]) -> String {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{FORMULA}");
    let root = rows_of_root(all);
    let _ = writeln!(text, "`rows = {root:.2} · √(faces drawn × pixels of faces)`.\n\n## The constants\n");
    text += "In instructions, at opt-level 3 with fat LTO, drawn into memory, every face lit.\n";
    for (ways, title) in all.iter().map(|growth| growth.ways).zip(TITLES) {
        let cores: Vec<&Growth> = all.iter().filter(|growth| growth.ways == ways).collect();
        constants(&mut text, title, &cores);
    }
    checks(&mut text, all, root);
    text
}

/// In the order of `WAYS`.
const TITLES: [&str; 6] = [
    "Edges as lines",
    "Faces without depth",
    "Faces with depth",
    "Faces without depth, asked by their planes",
    "Faces with depth, asked by their planes",
    "Faces with depth in bands",
];

fn constants(text: &mut String, title: &str, cores: &[&Growth]) {
    let Some(first) = cores.first() else { return };
    let _ = write!(text, "\n### {title}\n\n| |");
    for core in cores {
        let _ = write!(text, " {} |", core.core.name);
    }
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(cores.len()));
    for (at, name) in names(first.ways[0]).iter().enumerate() {
        let _ = write!(text, "| {name} |");
        for core in cores {
            let constant = core.constants[at];
            let _ = match constant.abs() < 20.0 {
                true => write!(text, " {constant:.2} |"),
                false => write!(text, " {constant:.0} |"),
            };
        }
        text.push('\n');
    }
    let kinds: [(&str, Chosen); 2] = [
        ("error in the fit: mean, largest", |drawn| drawn.case.fitted),
        ("in other cases: mean, largest", is_check),
    ];
    for (says, chosen) in kinds {
        let _ = write!(text, "| {says} |");
        for core in cores {
            let [most, mean] = core.errors(chosen);
            let _ = write!(text, " {:.1} %, {:.1} % |", 100.0 * mean, 100.0 * most);
        }
        text.push('\n');
    }
}

type Chosen = fn(&Drawn) -> bool;

/// Not used in the fit, and with something to draw: some meshes have no edges.
fn is_check(drawn: &Drawn) -> bool {
    !drawn.case.fitted && drawn.work.faces > 0
}

fn checks(text: &mut String, all: &[Growth], root: f64) {
    *text += CHECKED;
    let Some(first) = all.first() else { return };
    for ways in all.iter().filter(|growth| growth.core == first.core).map(|growth| growth.ways) {
        let cores: Vec<&Growth> = all.iter().filter(|growth| growth.ways == ways).collect();
        let Some(of) = cores.first() else { continue };
        for (at, drawn) in of.drawn.iter().enumerate().filter(|(_, drawn)| is_check(drawn)) {
            let Drawn { case, way, .. } = drawn;
            let [width, height] = case.size;
            let _ = write!(text, "| {way} | {} | {width} × {height} |", case.name);
            for core in &cores {
                let drawn = &core.drawn[at];
                let off = 100.0 * (core.ratio(drawn) - 1.0);
                let _ = write!(text, " {} | {off:+.0} % |", grouped(drawn.instructions));
            }
            let guessed = cores.iter().find(|core| core.core.name == "M3" && *way != Way::Lines);
            let _ = match guessed {
                Some(core) => {
                    let drawn = &core.drawn[at];
                    let work = drawn.work.guessed(root);
                    let off = 100.0 * (core.ratio(&Drawn { work, ..*drawn }) - 1.0);
                    writeln!(text, " {off:+.0} % |")
                }
                None => writeln!(text, " – |"),
            };
        }
    }
}

/// Rows over the root of faces and pixels, on average of the cases of the fit.
fn rows_of_root(all: &[Growth]) -> f64 {
    let Some(faces) = all.iter().find(|growth| growth.ways == [Way::Faces]) else { return 0.0 };
    let fitted =
        faces.drawn.iter().map(|drawn| drawn.work).zip(faces.drawn.iter().map(|drawn| drawn.case.fitted));
    let whole = fitted.filter(|(work, fitted)| *fitted && work.pixels > 0 && work.clipped == 0);
    let ratios: Vec<f64> = whole
        .map(|(work, _)| {
            let [small, large] = work.rows.map(f64::from);
            (small + large) / (f64::from(work.drawn) * f64::from(work.pixels)).sqrt()
        })
        .collect();
    ratios.iter().sum::<f64>() / ratios.len() as f64
}
