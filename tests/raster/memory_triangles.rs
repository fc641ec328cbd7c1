//! R1–R9 in memory: the loops that draw triangles into `Picture::pixels` and `Band::pixels`, against the oracle; with depth,
//! against triangles on any other target, which `tools/measure/tests/judge/pictures.rs` compares with an oracle.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565, Rgb888, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    fill_triangle, Affine, Angle, Camera, Cull, DepthBuffer, Dim, Frame, Gouraud, Mesh, Picture, Point3,
    Projection, Scalar, ScreenVertex, SpanShader, Vector3, ViewTransform, Viewport,
};
use support::bridge;
use support::oracle::cases::{self, CLASSES};
use support::oracle::coverage::{covers, rows, Area, P};
use support::oracle::rng::Rng;

const INK: Gray8 = Gray8::new(1);

/// The pixels of a picture after a triangle is drawn; memory behind the picture must not change.
fn drawn(t: [P; 3], (width, height): (usize, usize)) -> Vec<Gray8> {
    let mut memory = vec![Gray8::BLACK; width * height + 3];
    let mut picture =
        Picture::new(&mut memory, Size::new(width as u32, height as u32)).expect("enough memory");
    let Ok(()) = fill_triangle(t.map(bridge::screen_point), INK, &mut picture.pixels());
    assert!(memory[width * height..].iter().all(|&c| c == Gray8::BLACK), "{t:?}");
    memory.truncate(width * height);
    memory
}

/// A word a row.
fn words(pixels: &[Gray8], width: usize) -> Vec<u64> {
    let word = |row: &[Gray8]| row.iter().enumerate().map(|(x, &c)| u64::from(c == INK) << x).sum();
    pixels.chunks(width).map(word).collect()
}

/// A triangle at or about the largest size of a fast path (8160 sub-pixels across and 7680 down, or 8191 down; on a
/// Cortex-M0 7936 down).
fn small(rng: &mut Rng) -> [P; 3] {
    let reach =
        [256, 1000, 4095, 7680, 7681, 7936, 7937, 8160, 8161, 8191, 8192, 8300, 16_384][rng.below(13)];
    let (x, y) = (rng.int(-300, 16_384), rng.int(-300, 16_384));
    let mut p = |i: usize| match (i, rng.below(3)) {
        (1, 0) => (x + reach, y + reach),
        (2, 0) => (x, y + reach),
        (0, 0) => (x, y),
        _ => (x + rng.int(0, reach), y + rng.int(0, reach)),
    };
    let mut t = [p(0), p(1), p(2)];
    rng.shuffle(&mut t);
    t
}

#[test]
fn r9_random_triangles_of_every_class() {
    let mut rng = Rng::new(0x9A18);
    let mut covered = 0;
    let mut check = |t: [P; 3], (width, height): (usize, usize)| {
        let exact = rows(t, Area::new(0, 0, width as i64, height as i64));
        assert!(words(&drawn(t, (width, height)), width) == exact, "{t:?} in {width} x {height}");
        covered += exact.iter().map(|row| u64::from(row.count_ones())).sum::<u64>();
    };
    let sizes = [(64, 64), (64, 64), (64, 3), (7, 64), (1, 64), (33, 50)];
    for i in 0..60_000 {
        check(small(&mut rng), sizes[i % 6]);
        for class in CLASSES {
            check(cases::triangle(&mut rng, class), sizes[i / 7 % 6]);
        }
    }
    assert!(covered > 50_000_000, "{covered}");
}

#[test]
fn r9_triangles_match_in_wide_and_in_tall_pictures() {
    // Beyond 2047 columns a row is drawn in pieces; beyond 512 rows sides are wide.
    let mut rng = Rng::new(0x9A19);
    for (width, height) in [(2047, 4), (2048, 4), (5000, 3), (6, 700), (3, 3000)] {
        for i in 0..60 {
            let mut p = || (rng.int(-1000, 256 * width + 1000), rng.int(-1000, 256 * height + 1000));
            let mut t = [p(), p(), p()];
            if i % 3 == 0 {
                t = [(0, 0), (256 * width, rng.int(0, 3)), (128, 256 * height)];
            }
            let pixels = drawn(t, (width as usize, height as usize));
            for (at, (x, y)) in Area::new(0, 0, width, height).pixels().enumerate() {
                assert_eq!(pixels[at] == INK, covers(t, x, y), "{t:?} ({x}, {y}) in {width} x {height}");
            }
        }
    }
}

#[test]
fn r9_triangles_match_in_bands_away_from_the_origin() {
    let mut rng = Rng::new(0x9A1A);
    for _ in 0..3000 {
        let (left, top) = (rng.int(-20, 30), rng.int(-20, 30));
        let area = bridge::rectangle(left as i32, top as i32, rng.int(1, 64) as u32, rng.int(1, 40) as u32);
        let class = CLASSES[rng.below(6)];
        let t = if rng.one_in(2) { small(&mut rng) } else { cases::triangle(&mut rng, class) };
        let mut strip = vec![0; area.size.width as usize * rng.int(1, 20) as usize];
        let mut frame = Frame::new(area, Gray8::BLACK);
        while let Some(mut band) = frame.next_band(&mut strip).expect("room for a row") {
            let Ok(()) = fill_triangle(t.map(bridge::screen_point), INK, &mut band.pixels());
            let rows = band.area().rows();
            let pixels =
                Area::new(left, rows.start.into(), left + i64::from(area.size.width), rows.end.into())
                    .pixels();
            for ((x, y), byte) in pixels.zip(band.bytes()) {
                assert_eq!(*byte == INK.luma(), covers(t, x, y), "{t:?} ({x}, {y}) in {:?}", band.area());
            }
        }
    }
}

const SIZE: Size = Size::new(90, 70);

/// Colours and depths of a mesh, drawn into the picture's memory or as on any target, with a depth buffer for an area.
fn tested<I: SpanShader<Rgb565>>(
    mesh: &Mesh<'_>,
    area: Rectangle,
    shade: impl Fn(usize) -> I,
    fast: bool,
) -> (Vec<Rgb565>, Vec<u16>) {
    let viewport = Viewport::new(bridge::rectangle(0, 0, 0, 0).top_left, SIZE).expect("a viewport");
    let (eye, up) = (Point3::from_ints(0, 1, 6), Vector3::from_ints(0, 1, 0));
    let view = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), up).expect("a direction");
    let [near, far] = [2, 12].map(Scalar::from_int);
    let lens = Projection::perspective(Angle::degrees(60), SIZE, near, far).expect("near before far");
    let camera = Camera::new(&view, &lens, &viewport);
    let model = Affine::<Model, World>::identity();
    let mut pixels = vec![Rgb565::CSS_BLACK; (SIZE.width * SIZE.height) as usize];
    let mut held = vec![0; (area.size.width * area.size.height) as usize];
    let mut corners = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let mut picture = Picture::new(&mut pixels, SIZE).expect("enough memory");
    let mut depth = DepthBuffer::new(area, &mut held).expect("enough memory");
    let instance = camera.place(mesh, &model).with_cull(Cull::None);
    let Ok(_) = match fast {
        true => instance.depth_tested(shade, &mut corners, &mut depth, &mut picture.pixels()),
        false => instance.depth_tested(shade, &mut corners, &mut depth, &mut picture),
    };
    (pixels, held)
}

#[test]
fn memory_targets_store_the_depth_and_colors_of_any_target() {
    let mut rng = Rng::new(0x9A1B);
    let mut seen = 0;
    for reach in [60, 300, 1500, 9000] {
        for case in 0..60 {
            // Only in the first three does the depth buffer have the layout of the picture.
            let Size { width, height } = SIZE;
            let area = [
                bridge::rectangle(0, 0, width, height),
                bridge::rectangle(0, 0, width, height - 9),
                bridge::rectangle(0, 0, width, height + 9),
                bridge::rectangle(0, 0, width - 1, height),
                bridge::rectangle(0, 1, width, height),
                bridge::rectangle(-5, -3, width + 20, height / 2),
            ][case % 6];
            // Vertices in units of 2^-10, some before the near plane, some outside the picture.
            let mut vertices = Vec::new();
            for _ in 0..20 {
                let centre: [i64; 3] = core::array::from_fn(|_| rng.int(-4000, 4000));
                for _ in 0..3 {
                    vertices.push(centre.map(|c| (c + rng.int(-reach, reach)) as i16));
                }
            }
            let faces: Vec<[u16; 3]> = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            let mesh = Mesh::new(&vertices, -10, &faces).expect("faces of these vertices");
            let plain = |face: usize| Rgb565::CSS_GOLD.dim(12 * (face as u16 + 1));
            let lit = |face: usize| Gouraud::lit(Rgb888::CSS_GOLD, [10 * face as u16 + 40, 256, 100]);
            let smooth = |face: usize| {
                Gouraud::new([Rgb888::CSS_GOLD, Rgb888::new(face as u8, 9, 99), Rgb888::CSS_RED])
            };
            let fast = tested(&mesh, area, plain, true);
            assert!(fast == tested(&mesh, area, plain, false), "{vertices:?}");
            assert!(tested(&mesh, area, smooth, true) == tested(&mesh, area, smooth, false), "{vertices:?}");
            assert!(tested(&mesh, area, lit, true) == tested(&mesh, area, lit, false), "{vertices:?}");
            let dithered = |face| smooth(face).dithered();
            assert!(
                tested(&mesh, area, dithered, true) == tested(&mesh, area, dithered, false),
                "{vertices:?}"
            );
            seen += fast.1.iter().filter(|&&depth| depth != DepthBuffer::NOTHING).count();
        }
    }
    assert!(seen > 100_000, "{seen}");
}

#[test]
fn clear_resets_every_pixel_of_a_depth_buffer() {
    for (from, count) in
        (0..4).flat_map(|from| [0, 1, 2, 3, 63, 64, 65, 66, 67, 130].map(|count| (from, count)))
    {
        let mut storage = [7; 140];
        let area = Rectangle::new(Point::new(3, -2), Size::new(count as u32, 1));
        let mut depth = DepthBuffer::new(area, &mut storage[from..]).expect("enough memory");
        depth.clear();
        let cleared = storage.iter().enumerate().all(|(i, &v)| {
            let is_inside = (from..from + count).contains(&i);
            v == if is_inside { u16::MAX } else { 7 }
        });
        assert!(cleared, "{count} from {from}: {storage:?}");
    }
}
