//! Anti-aliased lines: in every way to draw lines, against areas in f64, in bands, and with a depth buffer.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565, RgbColor};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::raster::Pixel;
use pinhole::{
    draw_line, edge_faces, Affine, AntiAliased, Blend, Camera, DepthBuffer, Frame, Mesh, MeshInstance,
    Picture, PixelFormat, Pixels, Point3, Projection, Scalar, ScreenVertex, Side, StoredPixel, Stroke,
    ViewTransform, Viewport, Window,
};
use support::bridge::draw::{cube_camera, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{ModelBits, Step};
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

fn picture<C: PixelFormat>(draw: impl FnOnce(&mut Pixels<'_, C>)) -> Vec<C> {
    let mut cells = vec![C::decode(0); (WIDTH * HEIGHT) as usize];
    draw(&mut Picture::new(&mut cells, Size::new(WIDTH, HEIGHT)).expect("cells").pixels());
    cells
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
        let cells = picture(|target| {
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
        let back = picture(|target| {
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

/// Draws in bands of these many rows, and compares with the picture.
fn in_bands<const N: usize, C: PixelFormat + StoredPixel<[u8; N]> + core::fmt::Debug>(
    rows: u32,
    whole: &[C],
    mut draw: impl FnMut(&mut Pixels<'_, C, [u8; N]>, &mut DepthBuffer<'_>),
) {
    let area = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
    let mut strip = vec![0; Frame::<C>::strip_bytes(WIDTH, rows)];
    let mut depths = vec![0; (WIDTH * rows) as usize];
    let mut frame = Frame::new(area, C::decode(0));
    let mut colors = Vec::new();
    while let Some(mut band) = frame.next_band(&mut strip).expect("a strip") {
        let mut depth = DepthBuffer::new(band.area(), &mut depths).expect("depths");
        draw(&mut band.pixels(), &mut depth);
        colors.extend(band.colors());
    }
    assert!(colors == whole, "{rows} rows");
}

fn all_ways<const N: usize, C: PixelFormat + StoredPixel<[u8; N]> + Blend + core::fmt::Debug>(
    color: C,
    face: C,
) {
    let stroke = AntiAliased(color);
    let (mut mixed, mut different) = (0, 0);
    cubes(|instance| {
        let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 8], [0; 13]);
        let plain = picture(|target| {
            let Ok(_) = instance.wireframe(stroke, &mut [], target);
        });
        mixed += plain.iter().filter(|&&pixel| ![color, C::decode(0)].contains(&pixel)).count();
        // With nothing in front: equal to the lines without depth.
        let mut depths = vec![0; (WIDTH * HEIGHT) as usize];
        let area = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
        let open = picture(|target| {
            let mut depth = DepthBuffer::new(area, &mut depths).expect("depths");
            let Ok(_) = instance.hidden_line(stroke, &mut [], &mut depth, target);
        });
        assert!(open == plain);
        // Over faces, then hidden lines and lines with depth.
        let mut drawn = |hidden: bool| {
            picture(|target| {
                let mut depth = DepthBuffer::new(area, &mut depths).expect("depths");
                let Ok(_) = instance.depth_tested(|_| face, &mut [], &mut depth, target);
                let Ok(_) = match hidden {
                    true => instance.hidden_line(stroke, &mut [], &mut depth, target),
                    false => instance.wireframe_depth_tested(stroke, &mut [], &mut depth, target),
                };
            })
        };
        let (hidden, tested) = (drawn(true), drawn(false));
        different += u32::from(hidden != tested);
        let mut face_bins = [0; 13];
        let transformed = instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(&mut face_bins).expect("room");
        let mut edges = transformed.bin_edges(&mut bins).expect("room");
        for rows in [1, 2, 5, 8, HEIGHT] {
            in_bands(rows, &plain, |band, _| {
                let Ok(()) = edges.draw(stroke, band);
            });
            in_bands(rows, &hidden, |band, depth| {
                let Ok(()) = faces.depth_tested(|_| face, depth, band);
                let Ok(()) = edges.hidden_line(stroke, depth, band);
            });
            in_bands(rows, &tested, |band, depth| {
                let Ok(()) = faces.depth_tested(|_| face, depth, band);
                let Ok(()) = edges.depth_tested(stroke, depth, band);
            });
            // Plain and anti-aliased lines by turns, from the same bins.
            let mut turn = 0;
            let both = picture(|target| {
                for (y, plain) in (0..HEIGHT).step_by(rows as usize).zip([true, false].into_iter().cycle()) {
                    let mut cells = vec![C::decode(0); (WIDTH * HEIGHT) as usize];
                    let mut other = Picture::new(&mut cells, Size::new(WIDTH, HEIGHT)).expect("cells");
                    let Ok(_) = match plain {
                        true => instance.wireframe(color, &mut [], &mut other.pixels()),
                        false => instance.wireframe(stroke, &mut [], &mut other.pixels()),
                    };
                    let area =
                        Rectangle::new(Point::new(0, y as i32), Size::new(WIDTH, rows.min(HEIGHT - y)));
                    copy(&cells, area, target);
                }
            });
            in_bands(rows, &both, |band, _| {
                turn += 1;
                let Ok(()) = match turn % 2 {
                    1 => edges.draw(color, band),
                    _ => edges.draw(stroke, band),
                };
            });
        }
    });
    assert!(mixed > 2_000 && different > 3, "{mixed}, {different}");
}

fn copy<C: PixelFormat>(cells: &[C], area: Rectangle, target: &mut Pixels<'_, C>) {
    use pinhole::{raster::Span, Target};
    for point in area.points() {
        let color = cells[(point.y * WIDTH as i32 + point.x) as usize];
        let Ok(()) = target.fill(Span { x: point.x, y: point.y, width: 1, height: 1 }, color);
    }
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
        let mut depths = vec![0; (WIDTH * HEIGHT) as usize];
        let area = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
        for depth_tested in [false, true] {
            let pixels = picture::<Gray8>(|target| {
                let mut depth = DepthBuffer::new(area, &mut depths).expect("depths");
                let stroke = AntiAliased(Gray8::WHITE);
                let Ok(_) = match depth_tested {
                    false => instance.wireframe(stroke, &mut [], target),
                    true => instance.wireframe_depth_tested(stroke, &mut [], &mut depth, target),
                };
            });
            for (point, pixel) in area.points().zip(pixels) {
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
    let area = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));
    let [mut hidden, mut missing, mut more, mut drawn_pixels] = [0_u32; 4];
    cubes(|instance| {
        let drawn = |stroke: bool| {
            let mut depths = vec![0; (WIDTH * HEIGHT) as usize];
            picture(|target| {
                let mut depth = DepthBuffer::new(area, &mut depths).expect("depths");
                instance.depth_only(&mut [], &mut depth);
                let Ok(_) = match stroke {
                    true => instance.hidden_line(AntiAliased(Gray8::WHITE), &mut [], &mut depth, target),
                    false => instance.hidden_line(Gray8::WHITE, &mut [], &mut depth, target),
                };
            })
        };
        let all = picture(|target| {
            let Ok(_) = instance.wireframe(Gray8::WHITE, &mut [], target);
        });
        let (smooth, plain) = (drawn(true), drawn(false));
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
        for point in area.points() {
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

/// A camera that looks at the plane z = 0 with 16 units to a pixel: vertices are exact on the screen.
fn flat_camera() -> Camera {
    let viewport = Viewport::new(Point::zero(), Size::new(WIDTH, HEIGHT)).expect("a viewport");
    let [zero, one] = [0, 1].map(Scalar::from_int);
    let [right, top] = [WIDTH, HEIGHT].map(|v| Scalar::from_int(v as i32 * 16));
    let window = Window { left: zero, right, bottom: zero, top };
    let view = ViewTransform::multiview(Point3::from_ints(0, 0, 0), Side::Front);
    Camera::new(&view, &Projection::orthographic(window, -one, one).expect("a box"), &viewport)
}

/// The colors that lines of one direction leave multiply: the parts of a line have the pixels of the line, wherever it is divided.
#[test]
fn the_parts_of_a_line_are_the_line() {
    let camera = flat_camera();
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
            picture(|target| {
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
    let camera = flat_camera();
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
        let whole = picture(|target| {
            let Ok(_) = instance.wireframe(stroke, &mut [], target);
        });
        let plain = picture(|target| {
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
        let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 2], [0; 2]);
        let mut edges = instance.transform(&mut cache).bin_edges(&mut bins).expect("room");
        for rows in [1, 2, 3, 4, 7] {
            in_bands(rows, &whole, |band, _| {
                let Ok(()) = edges.draw(stroke, band);
            });
        }
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
