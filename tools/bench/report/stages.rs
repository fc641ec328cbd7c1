//! The stages of a frame, and which function of which file belongs to which.

use crate::provenance::Frame;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    Vertices,
    /// The light at each vertex.
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

/// The stages in the order of the page.
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

/// A file or folder, its functions (all if none is named), and their stage.
type Rule = (&'static str, &'static [&'static str], Stage);

/// A rule that matches any frame, inner or outer, decides for the whole instruction.
const ABOVE: [Rule; 4] = [
    ("surface/depth.rs", &["clear"], Stage::Clears),
    ("fast/line_fill.rs", &["flat", "gentle", "steep", "by_runs"], Stage::LinePixels),
    ("fast/line_fill.rs", &[], Stage::Lines),
    ("raster/line.rs", &[], Stage::Lines),
];

/// Otherwise the innermost frame that a rule matches decides. Functions that many stages call are not listed.
const RULES: [Rule; 66] = [
    ("surface/block_fill.rs", &[], Stage::Pixels),
    ("surface/memory.rs", &["new"], Stage::PassingOn),
    ("fast/solid_fill.rs", &["fill_rows", "closure of each", "fill_row"], Stage::Rows),
    ("fast/solid_fill.rs", &[], Stage::Sides),
    (
        "fast/depth_fill.rs",
        &["fill_few", "fill_each", "fill_blocks", "is_clear", "put_nearer"],
        Stage::Pixels,
    ),
    ("fast/depth_fill.rs", &["set_up"], Stage::Planes),
    ("fast/depth_fill.rs", &["triangle_nearer", "fill_nearer", "small", "low", "large"], Stage::Sides),
    ("fast/depth_fill.rs", &[], Stage::Rows),
    ("fast/table_fill.rs", &["fill_each", "fill_blocks"], Stage::Pixels),
    ("fast/table_fill.rs", &["set_up"], Stage::Planes),
    ("fast/table_fill.rs", &["triangle_nearer"], Stage::Sides),
    ("fast/table_fill.rs", &[], Stage::Rows),
    // The span of a smooth triangle.
    (
        "fast/shaded_fill.rs",
        &["put_line", "put_line_nearer", "closure of runs", "closure of lines"],
        Stage::Pixels,
    ),
    ("fast/shaded_fill.rs", &["triangle", "triangle_nearer"], Stage::Sides),
    ("fast/shaded_fill.rs", &[], Stage::Rows),
    ("fast/rows.rs", &["each", "sheared"], Stage::Rows),
    ("fast/rows.rs", &[], Stage::Sides),
    ("fast/spans.rs", &["next"], Stage::Rows),
    ("fast/spans.rs", &[], Stage::Sides),
    ("fast/small_triangle.rs", &["each", "span"], Stage::Rows),
    ("fast/small_triangle.rs", &[], Stage::Sides),
    ("fast/bresenham_triangle.rs", &["each", "span"], Stage::Rows),
    ("fast/bresenham_triangle.rs", &[], Stage::Sides),
    ("fast/edge20.rs", &["next"], Stage::Rows),
    ("fast/edge20.rs", &[], Stage::Sides),
    ("fast/tiny_gradient.rs", &[], Stage::Planes),
    ("raster/triangle.rs", &["area"], Stage::Faces),
    ("raster/triangle.rs", &["set"], Stage::PassingOn),
    ("raster/triangle.rs", &[], Stage::Sides),
    ("raster/any_triangle.rs", &["next"], Stage::Rows),
    ("raster/any_triangle.rs", &[], Stage::Sides),
    ("raster/trapezoid.rs", &["each", "row", "span"], Stage::Rows),
    ("raster/trapezoid.rs", &[], Stage::Sides),
    ("raster/pixel_layout.rs", &[], Stage::Sides),
    ("raster/row_scratch.rs", &[], Stage::Sides),
    ("raster/edge.rs", &["next"], Stage::Rows),
    ("raster/edge.rs", &[], Stage::Sides),
    ("raster/gradient.rs", &["at", "row_step", "step"], Stage::Rows),
    ("raster/gradient.rs", &[], Stage::Planes),
    ("raster/gradient_setup.rs", &[], Stage::Planes),
    ("raster/depth.rs", &[], Stage::Planes),
    ("raster/table_light.rs", &[], Stage::Planes),
    ("raster/screen.rs", &["from_subpixels"], Stage::Faces),
    ("shading/lambert.rs", &["levels"], Stage::Light),
    ("shading/gouraud.rs", &["gradients"], Stage::Planes),
    ("shading/gouraud.rs", &["run"], Stage::Rows),
    ("shading/gouraud.rs", &["next"], Stage::Pixels),
    ("shading/lit.rs", &["gradients", "per_channel"], Stage::Planes),
    ("shading/smooth.rs", &["set_up"], Stage::Planes),
    ("shading/table.rs", &["look_up"], Stage::Pixels),
    ("shading/table.rs", &["light"], Stage::Planes),
    ("shading/table.rs", &[], Stage::PassingOn),
    ("shading/channels.rs", &["from_channels"], Stage::Pixels),
    ("shading/", &["dim", "lit", "with_weights", "sub_face", "with_corners"], Stage::PassingOn),
    ("camera/vertex_transform.rs", &["unpack"], Stage::PassingOn),
    ("camera/vertex_transform.rs", &[], Stage::Vertices),
    ("pipeline/vertex_cache.rs", &["transform_one", "transform_all"], Stage::Vertices),
    // Clears the lazy cache.
    ("pipeline/vertex_cache.rs", &["new"], Stage::Vertices),
    ("pipeline/vertex_cache.rs", &["unpack"], Stage::PassingOn),
    ("pipeline/face_triangles.rs", &["set_whole", "set_triangle"], Stage::PassingOn),
    ("pipeline/fill.rs", &[], Stage::PassingOn),
    ("pipeline/draw_2d.rs", &[], Stage::PassingOn),
    ("pipeline/", &[], Stage::Faces),
    ("surface/", &[], Stage::PassingOn),
    ("bench/cells/two.rs", &[], Stage::Faces),
    ("bench/", &[], Stage::PassingOn),
];

impl Stage {
    /// The stage of an instruction, given the functions inlined there, the innermost first. `None`: no rule applies, so it belongs to its caller's
    /// stage.
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

/// The name of the first frame's function without its path and types. A closure is `closure of` the function that calls it; a closure
/// called from its own file has no name, so that it counts as part of its caller.
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

/// The function's name: `at` of `<Gradient>::at::<i16>`.
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
