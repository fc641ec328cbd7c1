//! The ways to draw that the page compares.

use crate::chip::LARGE;
use crate::choice::{Choice, Order, Style};
use crate::cost::Way;
use crate::display::Format;
use crate::figures::*;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::prelude::*;
use pinhole_apps_support::work::{Frame, LIST};

/// The factor by which faces in fewer than 16 bits a pixel take more instructions, as they are drawn into a band as into any target: for
/// one colour a face, for textures, and for other shaders. Linked firmware took 1.08 to 1.61, 1.2 to 1.3, and 1.23 to 1.92 times as many.
const INDIRECT: [f64; 3] = [1.4, 1.3, 1.6];
/// The error of such instructions, in percent: 29 was found.
const INDIRECT_ERROR: f32 = 35.0;

fn cache(mesh: &Mesh<'_>) -> usize {
    mesh.vertices().len() * size_of::<ScreenVertex>()
}

/// Bytes of a face in a painter: five indices of 16 bits, and a colour.
const PAINTED_FACE: usize = 12;

/// The bytes of `rows` rows of the display; before edges are smoothed, a grey has a byte of its own.
fn strip(choice: &Choice, rows: u32) -> usize {
    match choice.packs() {
        true => choice.size.width as usize * rows as usize,
        false => choice.format.bytes(choice.size.width, rows),
    }
}

fn depths(choice: &Choice, rows: u32) -> usize {
    choice.size.width as usize * rows as usize * size_of::<u16>()
}

/// The heights of bands that are compared: the chosen one, and others.
fn heights(choice: &Choice) -> Vec<u32> {
    let mut rows = vec![8, 16, 48, choice.rows()];
    rows.retain(|rows| *rows <= choice.size.height);
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// Whether a pixel is a number of whole bytes, into which the fastest code draws.
fn is_in_memory(choice: &Choice) -> bool {
    choice.format == Format::Rgb565 || choice.packs()
}

/// The code that draws into bands of a format. Images are measured in 16-bit colour; other formats draw into a band as into any
/// target.
fn into(choice: &Choice, code: Code) -> Code {
    if is_in_memory(choice) {
        code
    } else {
        code.and(DEPTH_BANDS_CODE, DEPTH_PIXELS_CODE)
    }
}

/// The time of a frame of faces that take so many times the instructions of 16-bit colour, with a lamp, which is turned to the object
/// first.
fn lit((mut time, error): ([f64; 4], f32), times: f64) -> ([f64; 4], f32) {
    time.iter_mut().zip(LIGHTING).for_each(|(time, light)| *time = *time * times + light);
    (time, if times > 1.0 { error.max(INDIRECT_ERROR) } else { error })
}

/// The instructions of a frame on the four cores, and their largest error in percent.
type Time = ([f64; 4], f32);

/// A way to draw in bands of so many rows, or in one piece.
fn way(
    choice: &Choice,
    name: String,
    ram: [usize; 4],
    code: Code,
    time: Time,
    kind: usize,
    rows: Option<u32>,
) -> Way {
    let bands = rows.map_or(1, |rows| choice.size.height.div_ceil(rows));
    let [cache, bins, pixels, depths] = ram;
    let ram = [cache, bins, pixels, depths, 0];
    Way { name, ram, code, time, kind, bands, rows, order: Order::Depth, note: "" }
}

pub(crate) fn faces(mesh: &Mesh<'_>, choice: &Choice, frame: &Frame) -> Vec<Way> {
    let (whole, rows) = (choice.size.height, choice.rows());
    let bins = mesh.face_bins_len() * size_of::<u16>();
    let is_plain = choice.style == Style::Flat && !choice.dithers();
    let shading = match choice.style {
        _ if is_plain => 0,
        Style::Textured => 1,
        _ => 2,
    };
    let (code, constants) = match (choice.style, choice.dithers()) {
        // Textures take more in any band than flat faces do.
        (Style::Textured, _) if !is_in_memory(choice) => (TEXTURED_BANDS_CODE, &TEXTURED_BANDS),
        (Style::Textured, _) => (TEXTURED_PIXELS_CODE, &TEXTURED_BANDS),
        (Style::Gouraud, true) => (into(choice, DITHER_PIXELS_CODE), &SMOOTH_DITHERED_BANDS),
        (Style::Gouraud, false) => (into(choice, GOURAUD_PIXELS_CODE), &SMOOTH_BANDS),
        (_, true) => (into(choice, FLAT_DITHER_PIXELS_CODE), &DITHERED_BANDS),
        (_, false) => (into(choice, DEPTH_PIXELS_CODE), &BANDS),
    };
    let times = if is_in_memory(choice) { 1.0 } else { INDIRECT[shading] };
    // Pixels and, with depth, their depths; beside the cache, and room for what is sorted or binned.
    let of =
        |name: &str, room: usize, has_depth: bool, code, constants: &Constants, kind, rows: Option<u32>| {
            let height = rows.unwrap_or(whole);
            let depths = if has_depth { depths(choice, height) } else { 0 };
            let name = rows.map_or(name.into(), |rows| format!("bands of {rows} rows, {name}"));
            let time = lit(constants.time(&frame.work(rows)), times);
            way(choice, name, [cache(mesh), room, strip(choice, height), depths], code, time, kind, rows)
        };
    // Code for flat faces has neither smooth shading nor textures.
    let kind = if choice.style == Style::Flat { 2 } else { LARGE };
    let with_depth = |rows| of("with depth", bins, true, code, constants, kind, Some(rows));
    if choice.smooths() {
        let smoothed = |rows| smoothed(with_depth(rows), mesh, choice, frame);
        return heights(choice).into_iter().map(smoothed).collect();
    }
    let mut ways: Vec<Way> = heights(choice).into_iter().map(with_depth).collect();
    if !(is_plain && is_in_memory(choice)) {
        return ways;
    }
    // Room for all faces, because another view may show more of them.
    let painted = size_of::<Painter<Rgb565, 0, 0>>() + PAINTED_FACE * mesh.faces().len();
    let (small, convex) = ("small faces that do not pierce each other", "one convex object only");
    let rows = Some(rows);
    for (note, order, way) in [
        (
            small,
            Order::Painter,
            of("painter's order", painted, false, PAINTER_BANDS_CODE, &PAINTED_BANDS, 1, rows),
        ),
        (convex, Order::Mesh, of("without depth", bins, false, SOLID_BANDS_CODE, &PLAIN_BANDS, 1, rows)),
        ("", Order::Depth, of("a whole picture, with depth", 0, true, DEPTH_PICTURE_CODE, &DEPTH, 2, None)),
        (
            small,
            Order::Painter,
            of("a whole picture, painter's order", painted, false, PAINTER_CODE, &PAINTED, 1, None),
        ),
        (convex, Order::Mesh, of("a whole picture, without depth", 0, false, PICTURE_CODE, &FACES, 1, None)),
    ] {
        ways.push(Way { note, order, ..way });
    }
    ways
}

/// Bytes of an entry of the list of edges that are set up.
const SMOOTH_EDGE: usize = 72;

/// The instructions that pack a grey pixel on the four cores.
const PACKING: [f64; 4] = [30.0, 15.0, 15.0, 15.0];

/// A way to draw faces with depth in bands, with smooth edges.
fn smoothed(mut way: Way, mesh: &Mesh<'_>, choice: &Choice, frame: &Frame) -> Way {
    way.name += ", smooth edges";
    let [_, bins, .., fixed] = &mut way.ram;
    *bins += mesh.smooth_bins_len() * size_of::<u16>();
    // The rows that wait, two more rows of the strip and of its depths, and the list.
    *fixed = 2 * strip(choice, 2) + depths(choice, 2) + LIST as usize * SMOOTH_EDGE;
    way.code = way.code.with_smooth_edges();
    way.kind = LARGE;
    let (_, error) = way.time;
    let (smoothing, error_of_smoothing) = SMOOTH_EDGES.time(&frame.work(way.rows));
    let packed = if choice.packs() { f64::from(choice.size.width * choice.size.height) } else { 0.0 };
    way.time.1 = 0.0;
    for ((time, more), packing) in way.time.0.iter_mut().zip(smoothing).zip(PACKING) {
        let off = *time * f64::from(error) + more * f64::from(error_of_smoothing);
        *time += more + packing * packed;
        way.time.1 = way.time.1.max((off / *time) as f32);
    }
    way
}

pub(crate) fn lines(mesh: &Mesh<'_>, choice: &Choice, frame: &Frame) -> Vec<Way> {
    let bins = mesh.edge_bins_len() * size_of::<u16>();
    let in_bands = |rows| {
        let (name, ram) =
            (format!("lines in bands of {rows} rows"), [cache(mesh), bins, strip(choice, rows), 0]);
        let time = LINE_BANDS.time(&frame.work(Some(rows)));
        way(choice, name, ram, WIREFRAME_BANDS_CODE, time, 0, Some(rows))
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    if is_in_memory(choice) {
        let ram = [cache(mesh), 0, strip(choice, choice.size.height), 0];
        let time = LINES.time(&frame.work(None));
        ways.push(way(choice, "lines in a whole picture".into(), ram, WIREFRAME_PIXELS_CODE, time, 0, None));
    }
    ways
}

pub(crate) fn hidden_lines(mesh: &Mesh<'_>, choice: &Choice, frame: &Frame) -> Vec<Way> {
    let bins = (mesh.face_bins_len() + mesh.edge_bins_len()) * size_of::<u16>();
    let in_bands = |rows| {
        let ram = [cache(mesh), bins, strip(choice, rows), depths(choice, rows)];
        let time = HIDDEN_BANDS.time(&frame.work(Some(rows)));
        way(
            choice,
            format!("hidden lines in bands of {rows} rows"),
            ram,
            HIDDEN_BANDS_CODE,
            time,
            LARGE,
            Some(rows),
        )
    };
    heights(choice).into_iter().map(in_bands).collect()
}
