//! The ways to draw that the page compares.

use crate::chip::LARGE;
use crate::choice::{Choice, Style};
use crate::cost::Way;
use crate::display::Format;
use crate::figures::*;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{Mesh, Painter, ScreenVertex};
use pinhole_apps_support::work::Frame;

/// The factor by which faces in fewer than 16 bits a pixel take more instructions, as they are drawn into a band as into any target: for
/// one colour a face, for textures, and for other shaders. Linked firmware took 1.08 to 1.61, 1.2 to 1.3, and 1.23 to 1.92 times as many.
const INDIRECT: [f64; 3] = [1.4, 1.3, 1.6];
/// The error of such instructions, in percent: 29 was found.
const INDIRECT_ERROR: f32 = 35.0;

fn cache(mesh: &Mesh<'_>) -> usize {
    mesh.cache_len() * size_of::<ScreenVertex>()
}

/// Bytes of a face in a painter: five indices of 16 bits, and a colour.
const PAINTED: usize = 12;

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
    choice.format == Format::Rgb565
}

/// The code that draws into bands of a format. Images are measured in 16-bit colour; other formats draw into a band as into any
/// target.
fn into(choice: &Choice, code: Code) -> Code {
    if is_in_memory(choice) {
        code
    } else {
        code.and(TARGET_CODE, BANDS_CODE)
    }
}

/// The time of a frame of faces that take so many times the instructions of 16-bit colour, with a lamp, which is turned to the object
/// first.
fn lit((mut time, error): ([f64; 4], f32), times: f64) -> ([f64; 4], f32) {
    time.iter_mut().zip(LIGHTING).for_each(|(time, light)| *time = *time * times + light);
    (time, if times > 1.0 { error.max(INDIRECT_ERROR) } else { error })
}

pub(crate) fn faces(
    mesh: &Mesh<'_>,
    choice: &Choice,
    frame: &Frame,
    strip: &dyn Fn(u32) -> usize,
) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.face_bins_len() * size_of::<u16>();
    let (in_bands, in_one_piece) = (|rows| frame.work(Some(rows)), frame.work(None));
    let is_plain = choice.style == Style::Flat && !choice.dithers();
    let shading = if is_plain {
        0
    } else if choice.style == Style::Textured {
        1
    } else {
        2
    };
    let (code, constants) = match (choice.style, choice.dithers()) {
        (Style::Textured, _) => (TEXTURED_BANDS_CODE, &TEXTURED_BANDS),
        (Style::Gouraud, true) => (SMOOTH_DITHERED_BANDS_CODE, &SMOOTH_DITHERED_BANDS),
        (Style::Gouraud, false) => (SMOOTH_BANDS_CODE, &SMOOTH_BANDS),
        (_, true) => (DITHERED_BANDS_CODE, &DITHERED_BANDS),
        (_, false) => (BANDS_CODE, &BANDS),
    };
    let times = if is_in_memory(choice) { 1.0 } else { INDIRECT[shading] };
    let way = |name: &str, ram: [usize; 4], code, time, kind, rows: Option<u32>, note| Way {
        name: rows.map_or(name.into(), |rows| format!("bands of {rows} rows, {name}")),
        ram,
        code,
        time: lit(time, times),
        kind,
        bands: rows.map_or(1, |rows| whole.div_ceil(rows)),
        rows,
        note,
    };
    let with_depth = |rows: u32| {
        let ram = [cache(mesh), bins, strip(rows), depths(choice, rows)];
        let time = constants.time(&in_bands(rows));
        // Code for flat faces has neither smooth shading nor textures.
        let kind = if choice.style == Style::Flat { 2 } else { LARGE };
        way("with depth", ram, into(choice, code), time, kind, Some(rows), "")
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(with_depth).collect();
    if !(is_plain && is_in_memory(choice)) {
        return ways;
    }
    // Room for all faces, because another view may show more of them.
    let painted = size_of::<Painter<Rgb565, 0, 0>>() + PAINTED * mesh.faces().len();
    let (small, rows) = ("small faces that do not pierce each other", choice.rows());
    let ram = [cache(mesh), painted, strip(rows), 0];
    let time = PAINTED_BANDS.time(&in_bands(rows));
    ways.push(way("painter's order", ram, PAINTED_BANDS_CODE, time, 1, Some(rows), small));
    let (convex, ram) = ("one convex object only", [cache(mesh), bins, strip(rows), 0]);
    ways.push(way(
        "without depth",
        ram,
        PLAIN_BANDS_CODE,
        PLAIN_BANDS.time(&in_bands(rows)),
        1,
        Some(rows),
        convex,
    ));
    let ram = [cache(mesh), 0, strip(whole), depths(choice, whole)];
    let time = DEPTH.time(&in_one_piece);
    ways.push(way("a whole picture, with depth", ram, DEPTH_CODE, time, 2, None, ""));
    let ram = [cache(mesh), painted, strip(whole), 0];
    let time = PAINTED_WHOLE.time(&in_one_piece);
    ways.push(way("a whole picture, painter's order", ram, PAINTED_CODE, time, 1, None, small));
    let (ram, time) = ([cache(mesh), 0, strip(whole), 0], FACES.time(&in_one_piece));
    ways.push(way("a whole picture, without depth", ram, FACES_CODE, time, 1, None, convex));
    ways
}

pub(crate) fn lines(
    mesh: &Mesh<'_>,
    choice: &Choice,
    frame: &Frame,
    strip: &dyn Fn(u32) -> usize,
) -> Vec<Way> {
    let whole = choice.size.height;
    let bins = mesh.edge_bins_len() * size_of::<u16>();
    let in_bands = |rows: u32| Way {
        name: format!("lines in bands of {rows} rows"),
        ram: [cache(mesh), bins, strip(rows), 0],
        code: LINES_BANDS_CODE,
        time: LINE_BANDS.time(&frame.work(Some(rows))),
        kind: 0,
        bands: whole.div_ceil(rows),
        rows: Some(rows),
        note: "",
    };
    let mut ways: Vec<Way> = heights(choice).into_iter().map(in_bands).collect();
    if is_in_memory(choice) {
        ways.push(Way {
            name: "lines in a whole picture".into(),
            ram: [cache(mesh), 0, strip(whole), 0],
            code: LINES_CODE,
            time: LINES.time(&frame.work(None)),
            kind: 0,
            bands: 1,
            rows: None,
            note: "",
        });
    }
    ways
}

pub(crate) fn hidden_lines(
    mesh: &Mesh<'_>,
    choice: &Choice,
    frame: &Frame,
    strip: &dyn Fn(u32) -> usize,
) -> Vec<Way> {
    let bins = (mesh.face_bins_len() + mesh.edge_bins_len()) * size_of::<u16>();
    let in_bands = |rows: u32| Way {
        name: format!("hidden lines in bands of {rows} rows"),
        ram: [cache(mesh), bins, strip(rows), depths(choice, rows)],
        code: HIDDEN_BANDS_CODE,
        time: HIDDEN_BANDS.time(&frame.work(Some(rows))),
        kind: LARGE,
        bands: choice.size.height.div_ceil(rows),
        rows: Some(rows),
        note: "",
    };
    heights(choice).into_iter().map(in_bands).collect()
}
