//! Anti-aliased lines.
//!
//! - A pixel has the area that the line's parallelogram covers of it, cut out as a polygon in f64, within the documented bound.
//! - A line from either end, in parts of the picture of any height, is one line.
//! - The edges of a mesh, plain, hidden by faces and tested by depth, are equal in bands and in one piece, and in formats of 16 and 24
//!   bits. With nothing in front, no edge is hidden.

use super::scene::input::Scene;
use super::Bytes;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565, Rgb888, RgbColor};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{color::StoredPixel, draw::draw_line, prelude::*, shading::AntiAliased};
use support::bridge::{self, ways};
use support::oracle::chain;

/// The part of a pixel with x and y from 0 to 1 that lies between two parallels to a line through `at`, whose slope is at most 1 in
/// size, half a pixel away: a polygon, cut by two half planes.
fn covered(at: [f64; 2], slope: f64) -> f64 {
    let half = slope.hypot(1.0) / 2.0;
    let middle = at[1] - slope * at[0];
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let polygon = [1.0, -1.0]
        .into_iter()
        .fold(square, |polygon, sign| chain::cut(&polygon, |p| half - sign * (p[1] - middle - slope * p[0])));
    chain::area(&polygon)
}

fn coordinate(b: &mut Bytes<'_>, from: i64) -> i64 {
    let to = match b.byte() {
        k @ 0..=127 => from + i64::from(k) - 64,
        k @ 128..=143 => i64::from(i16::MAX) - i64::from(k & 15),
        k @ 144..=159 => i64::from(i16::MIN) + i64::from(k & 15),
        160..=191 => from + 8 * b.i8(),
        _ => i64::from(b.i16()),
    };
    to.clamp(i16::MIN.into(), i16::MAX.into())
}

fn line(b: &mut Bytes<'_>) {
    let from = [coordinate(b, 0), coordinate(b, 0)];
    let to = from.map(|c| coordinate(b, c));
    if from == to {
        return;
    }
    let share = i64::from(b.byte());
    let middle = [0, 1].map(|k| from[k] + (to[k] - from[k]) * share / 255 + (b.i8() >> 4));
    let (width, height) = (1 + i64::from(b.byte() & 31), 1 + i64::from(b.byte() & 15));
    let corner = Point::new((middle[0] - width / 2) as i32, (middle[1] - height / 2) as i32);
    let area = Rectangle::new(corner, Size::new(width as u32, height as u32));
    let stroke = AntiAliased(Gray8::WHITE);
    let (start, end) = (bridge::pixel((from[0], from[1])), bridge::pixel((to[0], to[1])));
    let picture = ways::memory(area, Gray8::BLACK, &mut |target, _| {
        let Ok(()) = draw_line(start, end, stroke, target);
    });
    let back = ways::memory(area, Gray8::BLACK, &mut |target, _| {
        let Ok(()) = draw_line(end, start, stroke, target);
    });
    assert!(picture == back, "{from:?} {to:?}");
    let rows = 1 + u32::from(b.byte() & 7);
    let parts = ways::bands(area, Gray8::BLACK, rows, &mut |band, _| {
        let Ok(()) = draw_line(start, end, stroke, &mut band.pixels());
    });
    assert!(picture == parts, "{from:?} {to:?} in parts of {rows} rows");

    // Along the major axis the line reaches from the border of the first pixel to that of the last one.
    let tall = (from[1] - to[1]).abs() > (from[0] - to[0]).abs();
    let turn = |p: [i64; 2]| if tall { [p[1], p[0]] } else { p };
    let (a, c) = (turn(from), turn(to));
    let slope = (c[1] - a[1]) as f64 / (c[0] - a[0]) as f64;
    for (point, color) in area.points().zip(&picture) {
        if i16::try_from(point.x).is_err() || i16::try_from(point.y).is_err() {
            continue; // no pixel has this column or row
        }
        let at = turn([point.x.into(), point.y.into()]);
        let beyond = at[0] < a[0].min(c[0]) || at[0] > a[0].max(c[0]);
        // The start's centre in the pixel's own coordinates.
        let start = [0, 1].map(|k| (a[k] - at[k]) as f64 + 0.5);
        let exact = if beyond { 0.0 } else { covered(start, slope) };
        // 2⁻⁹ + 2⁻¹² of coverage, and half a level.
        let off = (f64::from(color.luma()) - 255.0 * exact).abs();
        assert!(
            off <= 0.5 + 255.0 * (1.0 / 512.0 + 1.0 / 4096.0) + 1e-6,
            "{point:?}: {off} of {exact}, {from:?} {to:?}"
        );
    }
}

fn edges<const N: usize, C: Color + StoredPixel<[u8; N]> + core::fmt::Debug>(
    scene: &Scene,
    rows: u32,
    [sky, face, line]: [C; 3],
) {
    let Some(area) = scene.rectangle() else { return };
    let stroke = AntiAliased(line);
    scene.with_instance(&scene.faces, &scene.edges, |instance| {
        let lines = ways::lines_by_every_call(instance, area, sky, &[rows], stroke, Some(face));
        let mut cache = vec![ScreenVertex::EMPTY; scene.vertices.len()];
        let cached = ways::memory(area, sky, &mut |target, _| {
            let Ok(_) = instance.edges(|_| stroke).cached(&mut cache).draw(target);
        });
        assert!(cached == lines.all, "the cache shows: {scene:?}");
        let open = ways::memory(area, sky, &mut |target, depth| {
            let Ok(_) = instance.edges(|_| stroke).hidden_line(&mut target.depth_tested(depth));
        });
        assert!(open == lines.all, "hidden by nothing: {scene:?}");
    });
}

pub(super) fn check(data: &[u8]) {
    let mut b = Bytes::new(data);
    let kind = b.byte();
    if kind & 1 == 0 {
        return line(&mut b);
    }
    let Some(mut scene) = Scene::read(data.get(1..).unwrap_or_default()) else { return };
    // As drawing with a depth buffer does always, so that all ways count alike. Target `scene` has lines beyond the far plane.
    scene.far_clip = true;
    let rows = 1 + u32::from(kind >> 2) % 20;
    match kind & 2 {
        0 => edges(&scene, rows, [Rgb565::BLUE, Rgb565::new(3, 40, 7), Rgb565::YELLOW]),
        _ => edges(&scene, rows, [Rgb888::BLUE, Rgb888::new(30, 99, 7), Rgb888::YELLOW]),
    }
}
