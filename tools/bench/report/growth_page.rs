//! `docs/growth.md`.

use crate::grouped::grouped;
use crate::growth::{Drawn, Growth};
use crate::page::BUILT;
use bench::growth::{names, Way, ALL, CASES, SOME};
use std::fmt::Write;

const HEAD: &str = "\
# How a frame grows

Instructions per vertex, triangle, row and pixel, to estimate the time of a frame before you write it. This page is
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

With double-buffered DMA, drawing and sending overlap, so take the longer of the two. Cycles per instruction depend on core
and flash: take them from [the table below](#cycles-per-instruction). The counts are of
one frame; `Statistics` tells how many faces were drawn. A constant marked *more* is added to what the face or edge costs
anyway:

* *frame*: 1.
* *vertex*: every vertex of the mesh, also with early culling by planes (`Mesh::with_planes`): there the constant is
  for clearing the vertex cache, and transforming the vertices of visible faces is part of *face drawn*.
* *face left out*: a back face; about half the faces of a closed mesh. *Face outside*: all its corners lie in front of the near
  plane, or all beyond one border of the picture; of a front face whose corners lie near the picture, `Statistics` counts that
  as drawn. *Face drawn*: every other face. Of a mesh with planes, count faces in front of the near plane or far beyond a border as left
  out, and others beyond a border as *face beside the picture*.
* *large face*: a drawn face that is higher than 31 rows, crosses the left or right border of the picture, or is cut by a clip
  plane.
* *face to be clipped*: a face that is not outside, with a corner in front of the near plane or far outside the picture; there is none
  if the whole object is in front of the camera. *Face cut*: a face to be clipped that is drawn. Of a mesh with planes, all faces to be
  clipped are front faces, and nearly all are cut.
* *row of a face*: over all drawn faces, the rows of pixels in each. *Pixel of a face*: over all drawn faces, the pixels in each,
  hidden later or not.
* *pixel of the picture*: width × height; it is cleared, and so is its depth.
* *band*; *face in a band*: the sum over bands of the faces touching each: drawn faces plus one for every band border a face
  crosses. *Large* is as above, but without cut faces: a cut face is clipped again in each band that it may
  reach. In bands, *face* is every face of the mesh, drawn or not, but those in front of the near plane or far beyond a border, which are
  outside.
* *edge in a band*: the sum over bands of the edges touching each. *Drawn face beside an edge in a
  band*: for each edge in a band, those of the two faces beside it (`Mesh::with_edge_faces`) that are drawn. *Pixel of a
  line*: over all drawn edges, the pixels in each, hidden or not.
* *face in perspective*: a face over which texture coordinates may not be interpolated linearly, because the difference of a coordinate
  over the face in texels, times the difference of the corners' distances, is not less than the nearest distance (for an accuracy of a
  quarter of a texel). A parallel projection has no such faces. The textured faces that were counted show 64 × 64 texels, four times over
  the mesh.
* *room for a vertex*: the number of vertices that the painter can store, `VERTICES`. *Drawn face, for each band of the
  picture*: drawn faces × bands, because each band visits all of them.
* *edge across the border*: a drawn edge that lies partly outside the picture, on any side. *Edge to be clipped*: has an
  end in front of the near plane or far outside the picture. *Edge cut*: an edge to be clipped of which a part is drawn.

If you know only faces and covered pixels, estimate the rows, and from the average height of a face how many are large:
";

const CHECKED: &str = "
## Whether it holds

The cases below had no part in the fit. *Off* is the relative error of the formula: above 0, its estimate is too high. The last
column is the error with estimated rows and large faces. The means of these columns, with their signs and without, stand below each
table of constants; they include higher bands, few hidden lines and culling by planes, which are not listed here. Only the fit separates per-row and per-pixel cost from per-face cost; [profile.md](profile.md) measures it by
following each instruction: on the M3, these constants agree with it for S2, S3 and S4 within a tenth without depth, and
within a fifth with depth.

";

const FITTED: &str = "
## What it is fitted to

Least squares of the relative error, over these cases: tori, a sphere and land (with their numbers of triangles), and vertices alone;
seen whole, from close by, and cut by the near plane. The columns give the error of the formula on the M3 for each way of drawing.
Only bands of 8 rows are listed. There is no figure where both sides of faces show, because planes are not used there. The error is largest with depth, where a few
faces fill a small picture or many pixels are drawn behind others: there the estimate is too low.

";

/// `placing`: the instructions of placing an object and of turning its light on each core; `per_instruction`: the section on cycles.
pub(crate) fn text(compiler: &str, all: &[Growth], placing: &[[u64; 2]], per_instruction: &str) -> String {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{FORMULA}");
    let root = rows_of_root(all);
    let _ = writeln!(text, "\n    rows  = {root:.2} · √(faces drawn × pixels of faces)");
    let _ = writeln!(text, "    large = faces drawn × (rows / faces drawn − {SOME}) / {}", ALL - SOME);
    let _ =
        writeln!(text, "\nNone are large below {SOME} rows a face, all from {ALL} on.\n\n## The constants\n");
    text += "In instructions, at opt-level 3 with fat LTO, drawn into memory, every face lit. In bands, faces go into `band.pixels()`, and \
             lines\ninto the band as into any target (`&mut band`), which displays of one bit need.\n";
    text += "\n### Placing an object\n\nNot in the constants below: turning the object and placing it before the camera; and turning the light to it, unless lines are drawn.\n\n|";
    for core in crate::core::CORES {
        let _ = write!(text, " | {}", core.name);
    }
    let _ = writeln!(text, " |\n|---|{}", "--:|".repeat(placing.len()));
    for (at, name) in ["`Affine::rotation_y`, `Camera::place`", "`Lambert::new`"].into_iter().enumerate() {
        let figures = placing.iter().map(|instructions| format!(" {} |", grouped(instructions[at])));
        let _ = writeln!(text, "| {name} |{}", figures.collect::<String>());
    }
    for (ways, title) in all.iter().map(|growth| growth.ways).zip(TITLES) {
        let cores: Vec<&Growth> = all.iter().filter(|growth| growth.ways == ways).collect();
        constants(&mut text, title, &cores);
    }
    text += per_instruction;
    checks(&mut text, all, root);
    fitted(&mut text, all);
    text
}

/// The titles in the order of `WAYS`.
const TITLES: [&str; 16] = [
    "Edges as lines",
    "Faces without depth",
    "Faces with depth",
    "Faces without depth, asked by their planes",
    "Faces with depth, asked by their planes",
    "Faces with depth in bands",
    "Faces with depth in bands, asked by their planes",
    "Edges as lines in bands",
    "Hidden lines in bands",
    "Smooth faces with depth in bands",
    "Flat faces in dithered colours, with depth, in bands",
    "Smooth faces in dithered colours, with depth, in bands",
    "Textured faces with depth in bands",
    "Faces without depth in bands",
    "Faces in painter's order",
    "Faces in painter's order in bands",
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
        ("error in the fit: mean, mean of sizes, largest", |drawn| drawn.case.fitted && drawn.work.faces > 0),
        ("in other cases: mean, mean of sizes, largest", is_check),
    ];
    for (says, chosen) in kinds {
        let _ = write!(text, "| {says} |");
        for core in cores {
            let [mean, size, most] = core.errors(chosen).map(|error| 100.0 * error);
            let _ = write!(text, " {} %, {size:.1} %, {most:.1} % |", signed(mean, 1));
        }
        text.push('\n');
    }
}

/// A percentage with its sign, unless it rounds to zero.
fn signed(percent: f64, digits: usize) -> String {
    let unit = 10f64.powi(digits as i32);
    match (percent * unit).round() / unit {
        0.0 => format!("{:.digits$}", 0.0),
        rounded => format!("{rounded:+.digits$}"),
    }
}

type Chosen = fn(&Drawn) -> bool;

/// Whether a case was not used in the fit, and has something to draw: some meshes have no edges.
fn is_check(drawn: &Drawn) -> bool {
    !drawn.case.fitted && drawn.work.faces > 0
}

fn checks(text: &mut String, all: &[Growth], root: f64) {
    *text += CHECKED;
    let Some(first) = all.first() else { return };
    let cores = || all.iter().filter(|growth| growth.ways == first.ways);
    *text += "| way | scene | picture |";
    for growth in cores() {
        let _ = write!(text, " {} counts | off |", growth.core.name);
    }
    let _ = writeln!(text, " M3, guessed |\n|---|---|---|{}--:|", "--:|--:|".repeat(cores().count()));
    for ways in all.iter().filter(|growth| growth.core == first.core).map(|growth| growth.ways) {
        let cores: Vec<&Growth> = all.iter().filter(|growth| growth.ways == ways).collect();
        let Some(of) = cores.first() else { continue };
        // The page would be too long for the package with all of them.
        let is_culled =
            matches!(ways.first(), Some(Way::PlaneCulled | Way::FacingDepth | Way::FacingBands(_)));
        let is_listed = |way: Way| !is_culled && ways.first() == Some(&way);
        let checks = of.drawn.iter().enumerate().filter(|(_, drawn)| is_check(drawn) && is_listed(drawn.way));
        for (at, drawn) in checks {
            let Drawn { case, way, .. } = drawn;
            let [width, height] = case.size;
            let _ = write!(text, "| {way} | {} | {width} × {height} |", case.name);
            for core in &cores {
                let drawn = &core.drawn[at];
                let off = 100.0 * (core.ratio(drawn) - 1.0);
                let _ = write!(text, " {} | {} % |", grouped(drawn.instructions), signed(off, 0));
            }
            let guessed = cores.iter().find(|core| core.core.name == "M3" && way.is_of_faces());
            let _ = match guessed {
                Some(core) => {
                    let drawn = &core.drawn[at];
                    let work = drawn.work.guessed(root);
                    let off = 100.0 * (core.ratio(&Drawn { work, ..*drawn }) - 1.0);
                    writeln!(text, " {} % |", signed(off, 0))
                }
                None => writeln!(text, " – |"),
            };
        }
    }
}

/// The cases of the fit, and how far it is off on the M3.
fn fitted(text: &mut String, all: &[Growth]) {
    *text += FITTED;
    let of_core: Vec<&Growth> = all.iter().filter(|growth| growth.core.name == "M3").collect();
    // The page would be too long for the package with all of them.
    let ways: Vec<Way> = of_core.iter().filter_map(|growth| growth.ways.first()).copied().collect();
    *text += "| scene | picture |";
    for way in &ways {
        let _ = write!(text, " {way} |");
    }
    let _ = writeln!(text, "\n|---|---|{}", "--:|".repeat(ways.len()));
    for case in CASES.iter().filter(|case| case.fitted) {
        let [width, height] = case.size;
        let _ = write!(text, "| {} | {width} × {height} |", case.name);
        for way in &ways {
            let drawn = of_core.iter().find_map(|growth| {
                let mut all = growth.drawn.iter();
                let drawn = all.find(|drawn| {
                    drawn.case.name == case.name && drawn.case.size == case.size && drawn.way == *way
                })?;
                Some(growth.ratio(drawn))
            });
            let _ = match drawn {
                Some(ratio) => write!(text, " {} % |", signed(100.0 * (ratio - 1.0), 0)),
                None => write!(text, " – |"),
            };
        }
        text.push('\n');
    }
}

/// Rows over the root of faces and pixels, on average of the cases of the fit.
fn rows_of_root(all: &[Growth]) -> f64 {
    let Some(faces) = all.iter().find(|growth| growth.ways == [Way::Faces]) else { return 0.0 };
    let fitted =
        faces.drawn.iter().map(|drawn| drawn.work).zip(faces.drawn.iter().map(|drawn| drawn.case.fitted));
    let whole = fitted.filter(|(work, fitted)| *fitted && work.pixels > 0 && work.clipped == 0);
    let ratios: Vec<f64> = whole
        .map(|(work, _)| f64::from(work.rows) / (f64::from(work.drawn) * f64::from(work.pixels)).sqrt())
        .collect();
    ratios.iter().sum::<f64>() / ratios.len() as f64
}
