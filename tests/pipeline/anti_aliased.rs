//! Anti-aliased lines: in every way to draw lines, in bands, and with a depth buffer; `fuzz/targets/anti_aliased.rs` compares single lines
//! with areas in f64. Where they meet, and where they cross the border of the picture, the oracle is the union of the strokes with round
//! joints: the part of a pixel whose points are within half a pixel of a line, by 32 × 32 samples in f64.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565, RgbColor};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::{
    color::StoredPixel,
    mesh::edge_faces,
    prelude::*,
    shading::{AntiAliased, AntiAliasedBy, Stroke},
    target::Pixels,
};
use std::f64::consts::TAU;
use support::bridge::draw::{cube_camera, flat_camera, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, lines_by_every_call, memory, memory_with};
use support::oracle::rng::Rng;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 56;

const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));

/// What `draw` leaves in memory.
fn picture<C: Color>(draw: &mut dyn FnMut(&mut Pixels<'_, C>)) -> Vec<C> {
    memory(AREA, C::from_bits(0), &mut |target, _| draw(target))
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

fn all_ways<const N: usize, C: Color + StoredPixel<[u8; N]> + core::fmt::Debug>(
    color: C,
    face: C,
    stroke: impl Stroke<C>,
) {
    let background = C::from_bits(0);
    let (mut mixed, mut different) = (0, 0);
    cubes(|instance| {
        let heights = [1, 2, 5, 8, HEIGHT];
        let lines = lines_by_every_call(instance, AREA, background, &heights, stroke, Some(face));
        mixed += lines.all.iter().filter(|&&pixel| ![color, background].contains(&pixel)).count();
        different += u32::from(lines.hidden != lines.tested);
        // With nothing in front: equal to the lines without depth.
        let open = memory(AREA, background, &mut |target, depth| {
            let Ok(_) = instance.edges(|_| stroke).hidden_line(&mut target.depth_tested(depth));
        });
        assert!(open == lines.all);
        // Plain and anti-aliased lines by turns, from the same bins.
        let plain = picture(&mut |target| {
            let Ok(_) = instance.edges(|_| color).draw(target);
        });
        let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 8], [0; 17]);
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
    all_ways(Rgb565::YELLOW, Rgb565::new(3, 9, 14), AntiAliased(Rgb565::YELLOW));
    all_ways(Gray8::WHITE, Gray8::new(70), AntiAliased(Gray8::WHITE));
    all_ways(Rgb565::YELLOW, Rgb565::new(3, 9, 14), AntiAliased(Rgb565::YELLOW).by_table());
    all_ways(Gray8::WHITE, Gray8::new(70), AntiAliased(Gray8::WHITE).by_table());
    // A function is called of covered pixels alone.
    let mix = |color: Rgb565, below, coverage| {
        assert!((1..=256).contains(&coverage), "{coverage}");
        color.over(below, coverage)
    };
    all_ways(Rgb565::CYAN, Rgb565::new(3, 3, 3), AntiAliasedBy::new(Rgb565::CYAN, mix));
}

/// An edge stores its depth where it has half of a pixel or more.
#[test]
fn pixels_of_which_an_edge_has_half_store_its_depth() {
    let mut counts = [0; 2];
    let camera = cube_camera((0, 0, WIDTH, HEIGHT)).library();
    for (turn, edge) in CUBE_EDGES.iter().enumerate() {
        let mesh = Mesh::new(&CUBE, 0, &[]).and_then(|mesh| mesh.with_edges(core::slice::from_ref(edge)));
        let mesh = mesh.expect("an edge");
        let model = ModelBits(vec![Step::Y(turn as u32 * 123_000_000), Step::X(77_000_000)]).library();
        let instance = camera.place(&mesh, &model);
        let (pixels, depths) = memory_with(AREA, AREA, Gray8::BLACK, &mut |target, depth| {
            let stroke = AntiAliased(Gray8::WHITE);
            let Ok(_) = instance.edges(|_| stroke).draw(&mut target.depth_tested(depth));
        });
        // A level on either side is left to rounding.
        for (pixel, depth) in pixels.into_iter().zip(depths) {
            if !(127..=128).contains(&pixel.luma()) {
                assert_eq!(depth != DepthBuffer::NOTHING, pixel.luma() > 128, "{edge:?}: {pixel:?}");
                counts[usize::from(pixel.luma() > 128)] += u32::from(pixel.luma() > 0);
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
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

/// Columns and rows of the picture.
const SIDE: usize = 48;

/// A point of the picture in pixels, y down.
type At = [f64; 2];

/// The vertex at a point of the picture, rounded to 1/256 pixel, for a camera with 256 units to a pixel.
fn vertex([x, y]: At) -> [i16; 3] {
    [(x * 256.0).round() as i16, ((SIDE as f64 - y) * 256.0).round() as i16, 0]
}

/// The brightness of each pixel after white lines were drawn on black from each point to the next: as a wireframe, in
/// bands, with a depth test, and as hidden lines in front of which there is nothing. All pictures are equal.
fn drawn(points: &[At], stroke: impl Stroke<Gray8>) -> Vec<f64> {
    let vertices: Vec<_> = points.iter().map(|&point| vertex(point)).collect();
    let edges: Vec<_> = (1..points.len() as u16).map(|end| [end - 1, end]).collect();
    let mesh = Mesh::new(&vertices, 0, &[]).and_then(|mesh| mesh.with_edges(&edges)).expect("a mesh");
    let camera = flat_camera((SIDE as u32, SIDE as u32), 256, 1).library();
    let instance = camera.place(&mesh, &Affine::identity());
    let area = rectangle(0, 0, SIDE as u32, SIDE as u32);
    let lines = lines_by_every_call(&instance, area, Gray8::BLACK, &[1, 3, 5, SIDE as u32], stroke, None);
    assert!(lines.tested == lines.all && lines.hidden == lines.all, "{points:?}");
    lines.all.iter().map(|color| f64::from(color.luma()) / 255.0).collect()
}

/// The part of a pixel that is within half a pixel of a line from one of the points to the next.
fn covered(points: &[At], [x, y]: [usize; 2]) -> f64 {
    let lines: Vec<_> = points.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    let may_reach = |[a, b]: &&[At; 2]| {
        [x, y].iter().enumerate().all(|(axis, &pixel)| {
            let (low, high) = (a[axis].min(b[axis]) - 0.5, a[axis].max(b[axis]) + 0.5);
            pixel as f64 <= high && pixel as f64 + 1.0 >= low
        })
    };
    let lines: Vec<_> = lines.iter().filter(may_reach).collect();
    let is_near = |p: At, [a, b]: &[At; 2]| {
        let (along, from) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let length = along[0].hypot(along[1]);
        let t = ((from[0] * along[0] + from[1] * along[1]) / length / length).clamp(0.0, 1.0);
        (from[0] - t * along[0]).hypot(from[1] - t * along[1]) <= 0.5
    };
    let sample = |pixel: usize, i: usize| pixel as f64 + (i as f64 + 0.5) / 32.0;
    let samples = (0..32 * 32).map(|i| [sample(x, i % 32), sample(y, i / 32)]);
    if lines.is_empty() {
        return 0.0;
    }
    samples.filter(|&p| lines.iter().any(|line| is_near(p, line))).count() as f64 / (32.0 * 32.0)
}

/// The largest differences between a picture and `opacity` times the oracle, at pixels for which `counts` is true: what is missing and
/// what is too much.
fn differences(points: &[At], picture: &[f64], opacity: f64, counts: impl Fn(At) -> bool) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for (index, own) in picture.iter().enumerate() {
        let pixel = [index % SIDE, index / SIDE];
        if counts(pixel.map(|v| v as f64 + 0.5)) {
            let more = own - opacity * covered(points, pixel);
            largest = [largest[0].max(-more), largest[1].max(more)];
        }
    }
    largest
}

/// A closed regular polygon.
fn polygon(sides: usize, radius: f64, center: At, turn: f64) -> Vec<At> {
    let corner = |i: usize| {
        let (sin, cos) = (turn + TAU * (i % sides) as f64 / sides as f64).sin_cos();
        // Rounded to 1/256 pixel, as the vertex is.
        [center[0] + radius * cos, center[1] + radius * sin].map(|v| (v * 256.0).round() / 256.0)
    };
    (0..=sides).map(corner).collect()
}

/// A stroke of which a pixel keeps half.
fn half(color: Gray8) -> AntiAliasedBy<Gray8, fn(Gray8, Gray8, u16) -> Gray8> {
    AntiAliasedBy::new(color, |color, below, coverage| color.over(below, coverage / 2))
}

/// Sides, radius in pixels, and the largest errors of opaque and of half translucent lines, and with areas from a table, as parts of a pixel.
const POLYGONS: [(usize, f64, [f64; 3]); 7] = [
    (3, 18.0, [0.25, 0.12, 0.55]),
    (4, 18.0, [0.22, 0.10, 0.45]),
    (6, 18.0, [0.18, 0.10, 0.55]),
    (16, 18.0, [0.08, 0.10, 0.35]),
    (64, 18.0, [0.045, 0.10, 0.35]),
    (64, 8.0, [0.06, 0.10, 0.60]),
    (64, 4.0, [0.08, 0.14, 0.60]), // sides of 0.4 pixels
];

#[test]
fn joints_cover_what_the_union_of_the_strokes_covers() {
    let mut rng = Rng::new(0x3C);
    let mut unit = || rng.int(0, 1_000_000) as f64 / 1e6;
    for (sides, radius, bounds) in POLYGONS {
        let mut largest = [0.0_f64; 3];
        for _ in 0..10 {
            let points = polygon(sides, radius, [24.0 + unit(), 24.0 + unit()], TAU * unit());
            let opaque = drawn(&points, AntiAliased(Gray8::WHITE));
            let half = drawn(&points, half(Gray8::WHITE));
            let by_table = drawn(&points, AntiAliased(Gray8::WHITE).by_table());
            for (i, (picture, opacity)) in [(opaque, 1.0), (half, 0.5), (by_table, 1.0)].iter().enumerate() {
                let [less, more] = differences(&points, picture, *opacity, |_| true);
                largest[i] = largest[i].max(less).max(more);
            }
        }
        for (largest, bound) in largest.into_iter().zip(bounds) {
            assert!(largest <= bound && 2.0 * largest > bound, "{sides} sides: {largest}, {bound}");
        }
    }
}

/// Two lines that meet at any angle. Where they run side by side, the second one is laid over the first one, as where lines cross.
#[test]
fn no_angle_between_two_lines_leaves_a_hole() {
    let mut rng = Rng::new(0x4D);
    let mut unit = || rng.int(0, 1_000_000) as f64 / 1e6;
    let mut largest = [0.0_f64; 4];
    for i in 0..300 {
        let joint = [24.0 + unit(), 24.0 + unit()];
        let first = TAU * unit();
        let second = first + TAU * if i % 2 == 0 { unit() } else { f64::from(i % 24) / 24.0 };
        let end = |angle: f64| [joint[0] + 15.0 * angle.cos(), joint[1] + 15.0 * angle.sin()];
        let points = [end(first), joint, end(second)].map(|p| p.map(|v| (v * 256.0).round() / 256.0));
        let near_joint = |p: At| (p[0] - joint[0]).hypot(p[1] - joint[1]) < 9.0;
        let stroke = AntiAliased(Gray8::WHITE);
        let exact = differences(&points, &drawn(&points, stroke), 1.0, near_joint);
        let by_table = differences(&points, &drawn(&points, stroke.by_table()), 1.0, |_| true); // at the ends, too
        for (largest, found) in largest.iter_mut().zip(exact.into_iter().chain(by_table)) {
            *largest = largest.max(found);
        }
    }
    for (largest, bound) in largest.into_iter().zip([0.25, 0.35, 0.65, 0.4]) {
        assert!(largest <= bound && 2.0 * largest > bound, "{largest}, {bound}");
    }
}

/// The joint lies at (0.41, 0.15) of its pixel, one line ends beside the pixel's left border, the other one at its upper border.
#[test]
fn the_pixel_of_a_joint_is_covered_where_the_major_axis_changes() {
    for ends in [[[6.0, 17.0], [26.0, 6.0]], [[6.0, 24.0], [27.0, 9.0]], [[7.0, 20.0], [20.0, 5.0]]] {
        let points = [ends[0], [20.0 + 105.0 / 256.0, 20.0 + 38.0 / 256.0], ends[1]];
        let own = drawn(&points, AntiAliased(Gray8::WHITE))[20 * SIDE + 20];
        let exact = covered(&points, [20, 20]);
        assert!(exact > 0.5 && (own - exact).abs() < 0.15, "{ends:?}: {own}, {exact}");
    }
}

/// The lines of a polygon that is moved over each border in steps of 1/16 pixel.
#[test]
fn lines_beside_the_border_cover_their_part_of_the_border_pixels() {
    let side = SIDE as f64;
    let mut at_border = 0;
    for step in -40..=40 {
        let beyond = f64::from(step) / 16.0;
        for (axis, border, sign) in [(0, 0.0, -1.0), (0, side, 1.0), (1, 0.0, -1.0), (1, side, 1.0)] {
            // A square whose one side lies along the border, with a slope of 0, 1 pixel in 30 and 1 pixel in 9.
            for slope in [0.0, 1.0, -3.3] {
                let mut points = [[9.0, 0.0], [39.0, slope], [33.0, 20.0], [15.0, 20.0], [9.0, 0.0]]
                    .map(|[along, inside]| [along, border + sign * (beyond - inside)]);
                if axis == 0 {
                    points = points.map(|[along, across]| [across, along]);
                }
                let points = points.map(|p| p.map(|v| (v * 256.0).round() / 256.0));
                let picture = drawn(&points, AntiAliased(Gray8::WHITE));
                let beside = |p: At| (p[axis] - border).abs() < 2.0;
                let [less, more] = differences(&points, &picture, 1.0, beside);
                assert!(less.max(more) < 0.2, "{points:?}: {less}, {more}");
                let away = |p: At| beside(p) && (12.0..36.0).contains(&p[1 - axis]);
                let [less, more] = differences(&points, &picture, 1.0, away);
                // The samples' 1/64, and the rounding of two shares.
                assert!(less.max(more) < 0.03, "{points:?}: {less}, {more}");
                at_border += i32::from(
                    beyond > 0.0
                        && picture.iter().enumerate().any(|(index, own)| {
                            let pixel = [index % SIDE, index / SIDE].map(|v| v as f64 + 0.5);
                            away(pixel) && *own > 0.0
                        }),
                );
            }
        }
    }
    assert!(at_border > 50, "{at_border}");
}

/// A line 0.016 pixel below the picture covers 0.484 of the pixels in the last row.
#[test]
fn a_line_just_below_the_picture_covers_half_of_the_last_row() {
    let y = SIDE as f64 + 4.0 / 256.0;
    let picture = drawn(&[[-3.0, y], [SIDE as f64 + 3.0, y]], AntiAliased(Gray8::WHITE));
    let (above, last) = picture.split_at(SIDE * (SIDE - 1));
    assert!(above.iter().all(|&own| own == 0.0));
    assert!(last.iter().all(|&own| (own - 0.484).abs() < 0.004), "{last:?}");
}

/// Edges that end beside a picture cover the pixels that they cover as a part of a larger picture, with each stroke and in each way to draw.
#[test]
fn edges_that_end_beside_the_picture_cover_their_part_of_it() {
    const MORE: i32 = 8;
    let (size, pixel) = (SIDE as i32, 256 * ONE);
    let window = [-MORE * pixel, (size + MORE) * pixel].repeat(2).try_into().expect("four borders");
    let larger = (size + 2 * MORE) as u32;
    let mut larger = CameraBits::ahead(ProjectionBits::Orthographic(window, -ONE, ONE), (larger, larger));
    (larger.viewport.0, larger.viewport.1) = (-MORE, -MORE);
    let (larger, mut rng) = (larger.library(), Rng::new(0xB1));
    let mut mixed = 0;
    for _ in 0..2_000 {
        // From beside a border to anywhere, mostly farther out.
        let from = [rng.int(0, i64::from(size) * 256), -rng.int(1, 700)];
        let to = [from[0] + rng.int(-2000, 2000), from[1] + rng.int(-2000, 100)];
        let (swaps, mirrors) = (rng.below(2) == 1, rng.below(2) == 1);
        let points = [from, to].map(|[x, y]| {
            let y = if mirrors { i64::from(size) * 256 - y } else { y };
            (if swaps { [y, x] } else { [x, y] }).map(|v| v as f64 / 256.0)
        });
        let vertices = points.map(vertex);
        let mesh = Mesh::new(&vertices, 0, &[]).and_then(|mesh| mesh.with_edges(&[[0, 1]])).expect("a mesh");
        let whole = larger.place(&mesh, &Affine::identity());
        let part = |draw: &mut dyn FnMut(&mut Pixels<'_, Gray8>)| -> Vec<f64> {
            let area = rectangle(0, 0, SIDE as u32, SIDE as u32);
            let pixels = memory(area, Gray8::BLACK, &mut |target, _| draw(target));
            pixels.iter().map(|color| f64::from(color.luma()) / 255.0).collect()
        };
        let (exact, by_table) = (AntiAliased(Gray8::WHITE), AntiAliased(Gray8::WHITE).by_table());
        let wanted = [
            part(&mut |target| at_once(&whole, Gray8::WHITE, target)),
            part(&mut |target| at_once(&whole, exact, target)),
            part(&mut |target| at_once(&whole, by_table, target)),
        ];
        mixed += usize::from(wanted[1].iter().chain(&wanted[2]).any(|&own| own > 0.0));
        let found = [drawn(&points, Gray8::WHITE), drawn(&points, exact), drawn(&points, by_table)];
        assert!(found == wanted, "{points:?}");
    }
    assert!(mixed > 300, "{mixed}");
}

/// Draws all edges with one stroke.
fn at_once(instance: &MeshInstance<'_>, stroke: impl Stroke<Gray8>, target: &mut Pixels<'_, Gray8>) {
    let Ok(_) = instance.edges(|_| stroke).draw(target);
}

/// Edges reach one pixel beyond the bounds of the binned edges, or two with areas from a table, as their documentation says.
#[test]
fn edges_reach_beyond_their_bounds_as_far_as_is_said() {
    let (mut rng, mut cache, mut bins) = (Rng::new(0xB0), [ScreenVertex::EMPTY; 2], [0; 8]);
    let camera = flat_camera((SIDE as u32, SIDE as u32), 256, 1).library();
    let area = rectangle(0, 0, SIDE as u32, SIDE as u32);
    let mut farthest = [0; 3];
    for _ in 0..4_000 {
        let mut along = || rng.int(8 * 256, (SIDE as i64 - 8) * 256) as i16;
        let vertices = [0; 2].map(|_| [along(), along(), 0]);
        let mesh = Mesh::new(&vertices, 0, &[]).and_then(|mesh| mesh.with_edges(&[[0, 1]])).expect("a mesh");
        let instance = camera.place(&mesh, &Affine::identity());
        let bounds = instance.transform(&mut cache).bin_edges(&mut bins).expect("room").bounds();
        let (low, high) = (bounds.top_left, bounds.top_left + bounds.size - Point::new(1, 1));
        let mut reach = |stroke, draw: &mut dyn FnMut(&mut Pixels<'_, Gray8>)| {
            let pixels = memory(area, Gray8::BLACK, &mut |target, _| draw(target));
            for at in area.points().zip(pixels).filter_map(|(at, own)| (own != Gray8::BLACK).then_some(at)) {
                let beyond = [low.x - at.x, low.y - at.y, at.x - high.x, at.y - high.y];
                farthest[stroke] = beyond.into_iter().fold(farthest[stroke], i32::max);
            }
        };
        let white = Gray8::WHITE;
        reach(0, &mut |target| at_once(&instance, white, target));
        reach(1, &mut |target| at_once(&instance, AntiAliased(white), target));
        reach(2, &mut |target| at_once(&instance, AntiAliased(white).by_table(), target));
    }
    assert_eq!(farthest, [0, 1, 2]);
}

/// Strokes differ in how far they reach beyond an edge: none ends an edge that the next one still draws.
#[test]
fn binned_edges_are_drawn_with_several_strokes_in_any_order() {
    let thin = Gray8::WHITE;
    let (exact, by_table) = (AntiAliased(thin), AntiAliased(thin).by_table());
    cubes(|instance| {
        let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 8], vec![0; instance.mesh().edge_bins_len()]);
        let mut edges = instance.transform(&mut cache).bin_edges(&mut bins).expect("room");
        let wanted = [
            picture(&mut |target| at_once(instance, thin, target)),
            picture(&mut |target| at_once(instance, exact, target)),
            picture(&mut |target| at_once(instance, by_table, target)),
        ];
        for rows in 1..4 {
            let (frame, mut strip) = (Frame::new(AREA, Gray8::BLACK), vec![0; WIDTH as usize * rows]);
            let mut found = [const { Vec::new() }; 3];
            for index in 0..HEIGHT.div_ceil(rows as u32) {
                let orders = [[0, 1, 2], [2, 1, 0], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1]];
                for stroke in orders[index as usize % 6] {
                    let mut band = frame.nth_band(index, &mut strip).expect("a row").expect("a band");
                    let Ok(()) = match stroke {
                        0 => edges.draw(thin, &mut band.pixels()),
                        1 => edges.draw(exact, &mut band.pixels()),
                        _ => edges.draw(by_table, &mut band.pixels()),
                    };
                    found[stroke].extend(band.colors());
                }
            }
            assert!(found == wanted, "bands of {rows} rows");
        }
    });
}
