//! Anti-aliased lines: in every way to draw lines, against areas in f64, in bands, and with a depth buffer.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565, RgbColor};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::raster::Pixel;
use pinhole::{
    draw_line, edge_faces, Affine, AntiAliased, Blend, Mesh, MeshInstance, PixelFormat, Pixels, ScreenVertex,
    StoredPixel, Stroke,
};
use support::bridge::draw::{cube_camera, flat_camera, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{ModelBits, Step};
use support::bridge::ways::{bands, lines_by_every_call, memory};
use support::oracle::rng::Rng;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 56;

/// The area of a pixel that is covered by the parallelogram of a line from `a` to `b` in pixels, sampled along the major axis: in
/// each of 4096 slices, the part of the parallelogram's height that lies in the pixel.
fn coverage(a: [f64; 2], b: [f64; 2], pixel: [i32; 2], ends: [i32; 2]) -> f64 {
    let tall = (a[1] - b[1]).abs() > (a[0] - b[0]).abs();
    let turn = |p: [f64; 2]| if tall { [p[1], p[0]] } else { p };
    let (a, b) = (turn(a), turn(b));
    let (column, row) = if tall { (pixel[1], pixel[0]) } else { (pixel[0], pixel[1]) };
    if !(ends[0]..ends[1]).contains(&column) {
        return 0.0;
    }
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    let half = slope.hypot(1.0) / 2.0;
    let slice = |i: i32| {
        let middle = a[1] + slope * (f64::from(column) + (f64::from(i) + 0.5) / 4096.0 - a[0]);
        let (top, bottom) = (middle - half - f64::from(row), middle + half - f64::from(row));
        (bottom.clamp(0.0, 1.0) - top.clamp(0.0, 1.0)) / 4096.0
    };
    (0..4096).map(slice).sum()
}

const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));

/// What `draw` leaves in memory.
fn picture<C: PixelFormat>(draw: &mut dyn FnMut(&mut Pixels<'_, C>)) -> Vec<C> {
    memory(AREA, C::decode(0), &mut |target, _| draw(target))
}

#[test]
fn lines_between_pixels_cover_the_area_of_the_parallelogram() {
    let mut rng = Rng::new(0xAA);
    let mut covered = 0;
    for i in 0..60 {
        let mut end = |limit: i64| [rng.int(-limit, limit), rng.int(-limit, limit)];
        // Inside, across the borders, and from one end of the range of pixels to the other.
        let (a, b) = match i % 3 {
            0 => (end(10).map(|v| v + 25), end(20).map(|v| v + 27)),
            1 => (end(90), end(90)),
            _ => (end(32_000), end(60).map(|v| v + 20)),
        };
        if a == b {
            continue;
        }
        let tall = (a[1] - b[1]).abs() > (a[0] - b[0]).abs();
        let major = |p: [i64; 2]| p[usize::from(tall)] as i32;
        let ends = [major(a).min(major(b)), major(a).max(major(b)) + 1];
        let pixel = |[x, y]: [i64; 2]| Pixel { x: x as i16, y: y as i16 };
        let cells = picture(&mut |target| {
            let Ok(()) = draw_line(pixel(a), pixel(b), AntiAliased(Gray8::WHITE), target);
        });
        let centre = |p: [i64; 2]| p.map(|v| v as f64 + 0.5);
        for (index, cell) in cells.iter().enumerate() {
            let at = [index as i32 % WIDTH as i32, index as i32 / WIDTH as i32];
            let exact = 255.0 * coverage(centre(a), centre(b), at, ends);
            // Half a level, 255 · (2⁻⁹ + 2⁻¹²), and 0.04 for the slices.
            assert!((f64::from(cell.luma()) - exact).abs() < 1.1, "{a:?} {b:?} {at:?}: {cell:?}, {exact}");
            covered += u32::from(exact > 0.0);
        }
        // In the other direction, and in parts of the picture.
        let back = picture(&mut |target| {
            let Ok(()) = draw_line(pixel(b), pixel(a), AntiAliased(Gray8::WHITE), target);
        });
        assert!(back == cells || a == b, "{a:?} {b:?}");
        let mut parts = vec![Gray8::BLACK; cells.len()];
        for (y, part) in (0..).step_by(8).zip(parts.chunks_mut((WIDTH * 8) as usize)) {
            let area = Rectangle::new(Point::new(0, y), Size::new(WIDTH, 8));
            let mut part = Pixels::new(part, area).expect("cells");
            let Ok(()) = draw_line(pixel(a), pixel(b), AntiAliased(Gray8::WHITE), &mut part);
        }
        assert!(parts == cells, "{a:?} {b:?}");
    }
    assert!(covered > 1_500, "{covered}");
}

/// A turned cube, with an instance that fills most of the picture, or reaches beyond its borders and the near plane.
fn cubes(with: impl FnMut(&MeshInstance<'_>)) {
    cubes_in((0, 0, WIDTH, HEIGHT), with);
}

/// [`cubes`] in a viewport.
fn cubes_in(viewport: (i32, i32, u32, u32), mut with: impl FnMut(&MeshInstance<'_>)) {
    let beside = edge_faces(&CUBE_EDGES, &CUBE_FACES);
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let mesh = mesh.with_edges(&CUBE_EDGES).expect("edges").with_edge_faces(&beside).expect("faces");
    let camera = cube_camera(viewport).library();
    let one = 1 << 16;
    for turn in 0..4 {
        for [x, y, z] in [[0, 0, 0], [2 * one, one, 0], [0, one / 2, 2 * one]] {
            let angle = [turn * 300_000_000, 77_000_000];
            let model = ModelBits(vec![Step::Y(angle[0]), Step::X(angle[1]), Step::Move([x, y, z])]);
            with(&camera.place(&mesh, &model.library()));
        }
    }
}

fn all_ways<const N: usize, C: PixelFormat + StoredPixel<[u8; N]> + Blend + core::fmt::Debug>(
    color: C,
    face: C,
) {
    let (stroke, background) = (AntiAliased(color), C::decode(0));
    let (mut mixed, mut different) = (0, 0);
    cubes(|instance| {
        let heights = [1, 2, 5, 8, HEIGHT];
        let lines = lines_by_every_call(instance, AREA, background, &heights, stroke, Some(face));
        mixed += lines.all.iter().filter(|&&pixel| ![color, background].contains(&pixel)).count();
        different += u32::from(lines.hidden != lines.tested);
        // With nothing in front: equal to the lines without depth.
        let open = memory(AREA, background, &mut |target, depth| {
            let Ok(_) = instance.hidden_line(stroke, &mut [], depth, target);
        });
        assert!(open == lines.all);
        // Plain and anti-aliased lines by turns, from the same bins.
        let plain = picture(&mut |target| {
            let Ok(_) = instance.wireframe(color, &mut [], target);
        });
        let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 8], [0; 13]);
        let transformed = instance.transform(&mut cache);
        let mut edges = transformed.bin_edges(&mut bins).expect("room");
        for rows in heights {
            let mut is_plain = false;
            let both = bands(AREA, background, rows, &mut |band, _| {
                is_plain = !is_plain;
                let Ok(()) = match is_plain {
                    true => edges.draw(color, &mut band.pixels()),
                    false => edges.draw(stroke, &mut band.pixels()),
                };
            });
            for (i, pixel) in both.into_iter().enumerate() {
                let is_plain = (i as u32 / WIDTH / rows).is_multiple_of(2);
                assert_eq!(pixel, if is_plain { plain[i] } else { lines.all[i] }, "{rows} rows");
            }
        }
    });
    assert!(mixed > 2_000 && different > 3, "{mixed}, {different}");
}

#[test]
fn edges_are_equal_in_bands_and_in_one_piece() {
    all_ways(Rgb565::YELLOW, Rgb565::new(3, 9, 14));
    all_ways(Gray8::WHITE, Gray8::new(70));
}

/// The target is larger: the pixels of a line that leaves the viewport end at its border, in columns too that the border divides.
#[test]
fn no_pixel_outside_the_viewport_changes() {
    let (x, y, width, height) = (6, 9, WIDTH - 13, HEIGHT - 20);
    let viewport = Rectangle::new(Point::new(x, y), Size::new(width, height));
    let mut at_border = 0;
    cubes_in((x, y, width, height), |instance| {
        let lines = lines_by_every_call(instance, AREA, Gray8::BLACK, &[], AntiAliased(Gray8::WHITE), None);
        for pixels in [lines.all, lines.tested] {
            for (point, pixel) in AREA.points().zip(pixels) {
                assert!(viewport.contains(point) || pixel == Gray8::BLACK, "{point}: {pixel:?}");
                let is_inner = viewport.offset(-1).contains(point);
                at_border += u32::from(!is_inner && pixel != Gray8::BLACK);
            }
        }
    });
    assert!(at_border > 50, "{at_border}");
}

/// The edges at the back of a closed solid lie behind its faces; those in front are drawn in full strength.
#[test]
fn faces_hide_the_lines_behind_them() {
    let [mut hidden, mut missing, mut more, mut drawn_pixels] = [0_u32; 4];
    cubes(|instance| {
        let plain = lines_by_every_call(instance, AREA, Gray8::BLACK, &[], Gray8::WHITE, None);
        let smooth = lines_by_every_call(instance, AREA, Gray8::BLACK, &[], AntiAliased(Gray8::WHITE), None);
        let (all, plain, smooth) = (plain.all, plain.hidden, smooth.hidden);
        let at = |cells: &[Gray8], x: i32, y: i32| {
            let inside = (0..WIDTH as i32).contains(&x) && (0..HEIGHT as i32).contains(&y);
            if inside {
                cells[(y * WIDTH as i32 + x) as usize].luma()
            } else {
                0
            }
        };
        let near = |cells: &[Gray8], x: i32, y: i32| {
            (-2..=2).any(|dy| (-2..=2).any(|dx| at(cells, x + dx, y + dy) > 0))
        };
        for point in AREA.points() {
            let (x, y) = (point.x, point.y);
            // Within two pixels of a plain line there is an anti-aliased one, and the other way round.
            drawn_pixels += u32::from(at(&smooth, x, y) > 0);
            missing += u32::from(at(&plain, x, y) > 0 && !near(&smooth, x, y));
            more += u32::from(at(&smooth, x, y) > 0 && !near(&plain, x, y));
            hidden += u32::from(at(&all, x, y) > 0 && !near(&smooth, x, y));
        }
    });
    // As plain lines: errors are possible within a pixel of where a face begins to hide an edge.
    assert!(hidden > 100 && drawn_pixels > 2_000, "{hidden}, {drawn_pixels}");
    assert!(
        missing * 200 <= drawn_pixels && more * 200 <= drawn_pixels,
        "{missing}, {more} of {drawn_pixels}"
    );
}

/// The colors that lines of one direction leave multiply: the parts of a line have the pixels of the line, wherever it is divided.
#[test]
fn the_parts_of_a_line_are_the_line() {
    let camera = flat_camera((WIDTH, HEIGHT), 16, 1).library();
    let mut rng = Rng::new(0x1A);
    let mut largest = 0;
    for _ in 0..50 {
        let start = [rng.int(0, 200) as i16, rng.int(0, 200) as i16, 0];
        let step = [rng.int(1, 7) as i16, rng.int(-7, 7) as i16];
        let at = |i: i16| [start[0] + i * step[0], start[1] + i * step[1], 0];
        let parts: Vec<_> = (0..=100).map(at).collect();
        let divided = Mesh::new(&parts, 0, &[]).expect("points");
        let ends = [at(0), at(100)];
        let whole = Mesh::new(&ends, 0, &[]).expect("points");
        let draw = |mesh: &Mesh<'_>, stroke: AntiAliased<Gray8>| {
            picture(&mut |target| {
                let Ok(_) = camera.place(mesh, &Affine::identity()).polyline(stroke, target);
            })
        };
        let (divided, whole) =
            (draw(&divided, AntiAliased(Gray8::WHITE)), draw(&whole, AntiAliased(Gray8::WHITE)));
        for (divided, whole) in divided.iter().zip(&whole) {
            // Up to nine parts share a pixel, of which each share is rounded. A pixel at a joint keeps 1/32 of what is below.
            let (divided, whole) = (i32::from(divided.luma()), i32::from(whole.luma()));
            largest = largest.max((divided - whole).abs());
        }
        assert!(whole.iter().any(|pixel| pixel.luma() > 100) || start[0] > 150);
    }
    assert!((7..=12).contains(&largest), "{largest}");
}

/// An edge reaches into the pixels one row beyond those of its ends. Bands in which no other pixel of the edge lies have these pixels,
/// too.
#[test]
fn bands_have_the_pixels_of_edges_one_row_beyond_the_ends() {
    let camera = flat_camera((WIDTH, HEIGHT), 16, 1).library();
    let mut rng = Rng::new(0x2B);
    let mut beyond = 0;
    for i in 0..200 {
        let start = [rng.int(200, 800) as i16, 16 * rng.int(10, 40) as i16 - (i % 3), 0];
        let run = rng.int(40, 200) as i16;
        let rise =
            [run, -run, run - 8, 3 - run, rng.int(-200, 200) as i16][usize::from(i.unsigned_abs()) % 5];
        let ends = [start, [start[0] + run, start[1] + rise, 0]];
        let mesh = Mesh::new(&ends, 0, &[]).and_then(|mesh| mesh.with_edges(&[[0, 1]])).expect("an edge");
        let instance = camera.place(&mesh, &Affine::identity());
        let stroke = AntiAliased(Gray8::WHITE);
        let whole = picture(&mut |target| {
            let Ok(_) = instance.wireframe(stroke, &mut [], target);
        });
        let plain = picture(&mut |target| {
            let Ok(_) = instance.wireframe(Gray8::WHITE, &mut [], target);
        });
        let rows = |cells: &[Gray8]| {
            let first = cells.iter().position(|cell| cell.luma() > 0).unwrap_or(0) as u32 / WIDTH;
            let last = cells.iter().rposition(|cell| cell.luma() > 0).unwrap_or(0) as u32 / WIDTH;
            [i64::from(first), i64::from(last)]
        };
        let ([first, last], [plain_first, plain_last]) = (rows(&whole), rows(&plain));
        assert!(plain_first - first <= 1 && last - plain_last <= 1);
        beyond += i32::from(plain_first - first == 1) + i32::from(last - plain_last == 1);
        let lines = lines_by_every_call(&instance, AREA, Gray8::BLACK, &[1, 2, 3, 4, 7], stroke, None);
        assert!(lines.all == whole);
    }
    assert!(beyond >= 100, "{beyond}");
}

#[test]
fn a_color_is_a_stroke_of_itself() {
    assert_eq!(
        (Stroke::color(&Gray8::WHITE), AntiAliased(Gray8::WHITE).color()),
        (Gray8::WHITE, Gray8::WHITE)
    );
    const { assert!(!<Gray8 as Stroke<Gray8>>::IS_ANTI_ALIASED) };
    assert_eq!(Gray8::WHITE.covering(Gray8::BLACK, 0), Gray8::WHITE);
}
