//! The stages of a frame, and which function of which file belongs to which.

use crate::provenance::Frame;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    Vertices,
    /// At vertices.
    Light,
    Faces,
    PassingOn,
    Sides,
    Planes,
    Rows,
    Pixels,
    Clears,
    Lines,
    LinePixels,
}

/// In the order of the page.
pub(crate) const STAGES: [Stage; 11] = [
    Stage::Vertices,
    Stage::Light,
    Stage::Faces,
    Stage::PassingOn,
    Stage::Sides,
    Stage::Planes,
    Stage::Rows,
    Stage::Pixels,
    Stage::Clears,
    Stage::Lines,
    Stage::LinePixels,
];

/// Functions of a file or folder; all, if none is named.
type Rule = (&'static str, &'static [&'static str], Stage);

/// Where one of these is at work, all below belongs to it.
const ABOVE: [Rule; 4] = [
    ("output/depth.rs", &["clear"], Stage::Clears),
    ("output/memory", &["flat", "gentle", "steep", "by_runs"], Stage::LinePixels),
    ("output/memory_line.rs", &[], Stage::Lines),
    ("raster/line.rs", &[], Stage::Lines),
];

/// Elsewhere the innermost function that is one of these. Those that many stages call are not among them.
const RULES: [Rule; 50] = [
    ("output/memory.rs", &["fill", "fill_any"], Stage::Pixels),
    (
        "output/nearer.rs",
        &["fill_nearer", "fill_short_nearer", "fill_few_nearer", "nothing_is_held", "one_nearer"],
        Stage::Pixels,
    ),
    ("output/nearer.rs", &["over"], Stage::Planes),
    ("output/nearer.rs", &[], Stage::Rows),
    ("output/shades.rs", &["few", "many", "look_up"], Stage::Pixels),
    ("output/shades.rs", &["over"], Stage::Planes),
    ("output/shades.rs", &[], Stage::Rows),
    // Of a smooth triangle's span.
    ("output/memory.rs", &["closure of each_span"], Stage::Pixels),
    (
        "output/memory.rs",
        &["rows", "rows_nearer", "closure of each", "fill_row", "shaded", "shaded_nearer", "row"],
        Stage::Rows,
    ),
    ("output/memory.rs", &["new"], Stage::PassingOn),
    ("output/memory.rs", &[], Stage::Sides),
    ("raster/triangle.rs", &["area"], Stage::Faces),
    ("raster/triangle.rs", &["next", "each_span"], Stage::Rows),
    ("raster/triangle.rs", &[], Stage::Sides),
    ("raster/stretch.rs", &["each", "row", "span"], Stage::Rows),
    ("raster/stretch.rs", &[], Stage::Sides),
    ("fast/small_triangle.rs", &["each_span", "span"], Stage::Rows),
    ("fast/small_triangle.rs", &[], Stage::Sides),
    ("fast/bresenham_triangle.rs", &["each", "each_span", "span"], Stage::Rows),
    ("fast/bresenham_triangle.rs", &[], Stage::Sides),
    ("raster/places.rs", &[], Stage::Sides),
    ("fast/edge20.rs", &["next"], Stage::Rows),
    ("fast/edge20.rs", &[], Stage::Sides),
    ("raster/edge.rs", &["next"], Stage::Rows),
    ("raster/edge.rs", &[], Stage::Sides),
    ("raster/gradient.rs", &["at", "down", "step", "sheared"], Stage::Rows),
    ("raster/gradient.rs", &[], Stage::Planes),
    ("raster/depth.rs", &[], Stage::Planes),
    ("raster/light.rs", &[], Stage::Planes),
    ("raster/mod.rs", &["from_subpixels"], Stage::Faces),
    ("shade/lambert.rs", &["levels"], Stage::Light),
    ("shade/gouraud.rs", &["over"], Stage::Planes),
    ("shade/gouraud.rs", &["run"], Stage::Rows),
    ("shade/gouraud.rs", &["next"], Stage::Pixels),
    ("shade/gouraud.rs", &["lit", "part"], Stage::PassingOn),
    ("shade/table.rs", &[], Stage::PassingOn),
    ("shade/channels.rs", &["from_channels"], Stage::Pixels),
    ("shade/", &["dim", "part"], Stage::PassingOn),
    ("camera/vertex_transform.rs", &["at"], Stage::PassingOn),
    ("camera/vertex_transform.rs", &[], Stage::Vertices),
    ("render/facing.rs", &["clear", "project"], Stage::Vertices),
    ("render/transformed.rs", &["project", "project_all"], Stage::Vertices),
    ("render/transformed.rs", &["images"], Stage::PassingOn),
    ("render/smooth.rs", &["over"], Stage::Planes),
    ("render/mod.rs", &[], Stage::PassingOn),
    ("render/plain.rs", &[], Stage::PassingOn),
    ("render/", &[], Stage::Faces),
    ("output/", &[], Stage::PassingOn),
    ("bench/cells/two.rs", &[], Stage::Faces),
    ("bench/", &[], Stage::PassingOn),
];

impl Stage {
    /// Of an instruction, by the functions there, the innermost first; `None` if they may belong to any.
    pub(crate) fn of(frames: &[Frame]) -> Option<Self> {
        let names: Vec<String> = (0..frames.len()).map(|at| name(&frames[at..])).collect();
        let named = || frames.iter().zip(&names);
        let by = |rules: &[Rule]| {
            named().find_map(|(frame, name)| {
                let fits = |(file, functions, _): &&Rule| {
                    frame.file.starts_with(file)
                        && match functions {
                            [] => !name.is_empty(),
                            _ => functions.contains(&name.as_str()),
                        }
                };
                rules.iter().find(fits).map(|rule| rule.2)
            })
        };
        by(&ABOVE).or_else(|| by(&RULES))
    }
}

/// The first one's name without its path and types. A closure is `closure of` the function around it; it has no name where
/// that stands in the same file: then it is a part of that.
fn name(frames: &[Frame]) -> String {
    let Some((frame, around)) = frames.split_first() else { return String::new() };
    let own = last_word(&frame.function);
    match around.first() {
        Some(around) if own.starts_with("{closure") => match around.file == frame.file {
            true => String::new(),
            false => format!("closure of {}", last_word(&around.function)),
        },
        _ => own,
    }
}

/// `at` of `<Plane>::at::<i16>`.
fn last_word(function: &str) -> String {
    let (mut depth, mut plain) = (0u32, String::new());
    for c in function.replace("->", "").chars() {
        match c {
            '<' => depth += 1,
            '>' => depth = depth.saturating_sub(1),
            _ if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    plain.rsplit("::").find(|word| !word.is_empty()).unwrap_or_default().to_string()
}
