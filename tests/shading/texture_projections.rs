//! Textures of faces that planes cut, under projections of any kind, against rays in f64; and equal pixels by every draw call.

use crate::texture_rays::{camera, library, numbered, perspective, Faces};
use crate::textures::{Colored, Display, Wide, PACKING, SIDE};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    Accuracy, Affine, Angle, Camera, Cull, DepthBuffer, Frame, LitTexels, Mesh, Painter, Picture, Projection,
    Scalar, ScreenVertex, SpanShader, Texels, Texture, Window,
};
use support::oracle::chain::{self, M4};
use support::oracle::rng::Rng;

/// w that grows to the right and downwards, too, and depth across the line of sight.
fn slanted() -> M4 {
    let [x, y, ..] = perspective(100.0);
    [x, y, [0.4, -0.3, -1.1, -3.0], [0.15, -0.2, -1.0, 0.0]]
}

/// A perspective whose near plane is not across the line of sight (Lengyel, *Oblique view frustum depth projection and clipping*,
/// 2005): w as usual, and depth that depends on x and y.
fn oblique_near_plane() -> M4 {
    let [x, y, _, w] = perspective(100.0);
    [x, y, [0.2, 0.5, -1.0, -2.5], w]
}

/// A reverse perspective, in which distant objects are larger.
fn reverse() -> M4 {
    [[0.05, 0.0, 0.0, 0.0], [0.0, 0.05, 0.0, 0.0], [0.0, 0.0, -0.025, -1.0], [0.0, 0.0, 0.0125, 1.0]]
}

/// Cabinet: receding lines run upwards to the right, half as long.
fn cabinet() -> (M4, Projection) {
    let (near, far, half) = (-20, 60, 20);
    let [l, h] = [-half, half].map(Scalar::from_int);
    let window = Window { left: l, right: h, bottom: l, top: h };
    let [near_, far_] = [near, far].map(Scalar::from_int);
    let factor = Scalar::from_ratio(1, 2);
    let lens = Projection::oblique(window, near_, far_, Angle::degrees(45), factor).unwrap();
    let mut matrix = chain::orthographic(-20.0, 20.0, -20.0, 20.0, near.into(), far.into());
    // x' = x − z·cos 45°/2, and y' so: in halves of the window, 20.
    let slope = -0.5f64.sqrt() / 2.0 / 20.0;
    (matrix[0][2], matrix[1][2]) = (slope, slope);
    (matrix, lens)
}

/// Every pixel that a face shows, cut by near, far, guard band and sides, is that of a ray, for each accuracy.
#[test]
fn cut_faces_show_the_texels_of_rays_under_every_projection() {
    let near = perspective(2000.0);
    let close = perspective(20.0);
    let (oblique, cabinet) = cabinet();
    let cases: [(&str, M4, Projection, bool, i64, f64); 6] = [
        ("far plane", close, library(&close), true, 400, 0.03),
        ("guard band", near, library(&near), false, 4000, 0.03),
        ("slanted", slanted(), library(&slanted()), true, 400, 0.03),
        ("slanted near plane", oblique_near_plane(), library(&oblique_near_plane()), true, 400, 0.03),
        ("reverse", reverse(), library(&reverse()), true, 400, 0.03),
        ("cabinet", oblique, cabinet, true, 900, 0.03),
    ];
    for (name, matrix, lens, far, reach, planes) in cases {
        let mut rng = Rng::new(31);
        let mut faces = Faces::soup(&mut rng, 90, reach, 2500, |rng| rng.int(-4000, 4000) as i16);
        // A floor and a wall through all of the volume.
        let (low, high) = (-6000, 6000);
        for [a, b, c, d] in [
            [[low, -80, 3000], [high, -80, 3000], [high, -80, -9000], [low, -80, -9000]],
            [[150, low, 3000], [60, high, 3000], [60, high, -9000], [150, low, -9000]],
        ] {
            faces.push([a, b, c], [[0, 3000], [3000, 3000], [3000, 0]]);
            faces.push([a, c, d], [[0, 3000], [3000, 0], [0, 0]]);
        }
        let camera = camera(&lens).with_far_clip(far);
        for (accuracy, chosen) in
            [(Accuracy::Quarter, 0.25), (Accuracy::Eighth, 0.125), (Accuracy::Sixteenth, 0.0625)]
        {
            let bits = [6, 5];
            let texture = Texture::new(numbered(bits)).with_accuracy(accuracy);
            let wide = Texture::new(Wide(numbered(bits))).with_accuracy(accuracy);
            let (mut pixels, mut drawn) = (0, 0);
            for (face, &uv) in faces.uv.iter().enumerate() {
                let ray = faces.ray(face, &matrix, [1.0 / 16.0; 2]);
                let (worst, count) = ray.worst_repeated(&faces.draw(face, &camera, wide.at(uv)), bits);
                assert!(worst <= chosen + planes, "{name}, {accuracy:?}, face {face}: {worst}");
                let (worst, _) = ray.worst_repeated(&faces.draw(face, &camera, texture.at(uv)), bits);
                let bound = chosen + planes + 64.0 * PACKING;
                assert!(worst <= bound, "{name}, {accuracy:?}, face {face}, packed: {worst}");
                (pixels, drawn) = (pixels + count, drawn + usize::from(count > 0));
            }
            assert!(pixels > 20_000 && drawn > 6, "{name}: {pixels} pixels of {drawn} faces");
        }
    }
}

/// Coordinates at both ends of `i16`, from end to end in a face, and w that differ 32767 times: rays again, and the documented error
/// of the planes, 8·2⁻²⁴ of the range of coordinates times the ratio of w.
#[test]
fn coordinates_at_the_ends_of_i16_and_w_of_any_ratio() {
    let matrix = chain::perspective(0x2aaa_aaab, SIDE, SIDE, 1.0 / 64.0, 2000.0);
    let camera = camera(&library(&matrix));
    let mut rng = Rng::new(41);
    let mut faces = Faces::new(-6);
    for i in 0..200i16 {
        // One corner close to the eye, one up to 32767/64 away, and one anywhere between.
        let mut corner = |w: i64| {
            let side = |rng: &mut Rng| rng.int(-w, w) * 6 / 10;
            [side(&mut rng), side(&mut rng), -w].map(|c| c as i16)
        };
        let between = [32767, 3000, 200, 10, 2][usize::try_from(i % 5).unwrap()];
        let corners = [corner(1 + i64::from(i % 3)), corner(between), corner(32_767)];
        let uv = [(); 3].map(|()| [(); 2].map(|()| [i16::MIN, i16::MAX, 0][rng.below(3)]));
        faces.push(corners, uv);
    }
    // The largest errors among 16 000 such faces, some of which reach ten times as far out of the picture.
    let (low, high) = (i16::MIN, i16::MAX);
    faces.push([[2, 24, -6], [3540, -597, -3000], [-720, 976, -3000]], [[high, low], [high, 0], [0, low]]);
    faces.push(
        [[24, 0, -4], [-1821, 32_000, -20_000], [1552, -3944, -20_000]],
        [[0, high], [low, high], [0, low]],
    );
    const FEW: [u32; 2] = [8, 8]; // errors of more than 128 texels wrap
    let bits = [12, 12]; // so that no error wraps
    let (mut pixels, mut largest) = (0, f64::MIN);
    for (accuracy, chosen) in [(Accuracy::Quarter, 0.25), (Accuracy::Sixteenth, 0.0625)] {
        let texture = Texture::new(Wide(numbered(bits))).with_accuracy(accuracy);
        let small = Texture::new(numbered(FEW)).with_accuracy(accuracy);
        for (face, &uv) in faces.uv.iter().enumerate() {
            let ray = faces.ray(face, &matrix, [1.0 / 16.0; 2]);
            let w = [0, 1, 2].map(|i| f64::from(-faces.vertices[3 * face + i][2]));
            let ratio = w.iter().copied().fold(0.0, f64::max) / w.iter().copied().fold(f64::MAX, f64::min);
            // 65535 units of 1/16 texel.
            let planes = 4096.0 * ratio * 2f64.powi(-24);
            let (repeated, count) = ray.worst_repeated(&faces.draw(face, &camera, texture.at(uv)), bits);
            let (clamped, _) = ray.worst_clamped(&faces.draw(face, &camera, texture.clamped_at(uv)), bits);
            let (packed, _) = ray.worst_repeated(&faces.draw(face, &camera, small.at(uv)), FEW);
            for worst in [repeated, clamped, packed - 256.0 * PACKING] {
                let bound = chosen + 0.03 + 8.0 * planes;
                assert!(worst <= bound, "face {face}, {ratio} times as far: {worst}");
                largest = largest.max((worst - chosen) / planes);
            }
            pixels += count;
        }
    }
    // The bound is at most twice the error that is met.
    assert!(pixels > 100_000 && largest > 4.0, "{pixels} pixels, {largest}");
}

/// Texels in four colours, of which light dims two channels.
#[derive(Clone, Copy)]
struct LitColored;

impl Texels for LitColored {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        Colored.size_bits()
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        Colored.texel(u, v)
    }
}

impl LitTexels for LitColored {
    const LEVEL_BITS: u32 = 7;

    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Rgb888 {
        Rgb888::new((u >> 24) as u8, level as u8, (v >> 24) as u8)
    }
}

/// One picture, however it is drawn: into memory, into a DrawTarget, in bands of both kinds, through a painter, with depth.
fn equal_everywhere<S: SpanShader<Rgb888>>(
    name: &str,
    faces: &Faces,
    camera: &Camera,
    shade: &dyn Fn(usize) -> S,
) {
    let sky = Rgb888::new(1, 2, 3);
    let area = Rectangle::new(Point::zero(), Size::new(SIDE, SIDE));
    let indices = faces.indices();
    let mesh = Mesh::new(&faces.vertices, faces.exponent, &indices).unwrap();
    let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    let blank = || vec![sky; (SIDE * SIDE) as usize];
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let mut numbers = vec![0; (SIDE * SIDE) as usize];

    let mut display = Display(blank());
    let Ok(_) = instance.solid(shade, &mut cache, &mut display);
    let drawn = display.0.iter().filter(|&&pixel| pixel != sky).count();
    assert!(drawn > 5_000, "{name}: {drawn}");
    let mut pixels = blank();
    let Ok(_) =
        instance.solid(shade, &mut cache, &mut Picture::new(&mut pixels, area.size).unwrap().pixels());
    assert!(pixels == display.0, "{name}: memory");

    let mut deep = Display(blank());
    let mut depth = DepthBuffer::new(area, &mut numbers).unwrap();
    let Ok(_) = instance.depth_tested(shade, &mut cache, &mut depth, &mut deep);
    let mut pixels = blank();
    let mut depth = DepthBuffer::new(area, &mut numbers).unwrap();
    let mut picture = Picture::new(&mut pixels, area.size).unwrap();
    let Ok(_) = instance.depth_tested(shade, &mut cache, &mut depth, &mut picture.pixels());
    assert!(pixels == deep.0, "{name}: memory, with depth");

    // The painter's order is that of the faces' distances, so its target and its memory are compared.
    let mut painter = Painter::<S, 512, 128>::new();
    painter.add(&instance, shade).unwrap();
    let mut painted = Display(blank());
    let Ok(_) = painter.draw(&mut painted);
    let mut pixels = blank();
    painter.add(&instance, shade).unwrap();
    let Ok(_) = painter.draw(&mut Picture::new(&mut pixels, area.size).unwrap().pixels());
    assert!(pixels == painted.0, "{name}: painter");
    // One face alone shows through the painter what it shows without.
    let one = [indices[0]];
    let mesh_of_one = Mesh::new(&faces.vertices, faces.exponent, &one).unwrap();
    let alone = camera.place(&mesh_of_one, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    let (mut own, mut through) = (Display(blank()), Display(blank()));
    let Ok(_) = alone.solid(shade, &mut [], &mut own);
    painter.clear();
    painter.add(&alone, shade).unwrap();
    let Ok(_) = painter.draw(&mut through);
    assert!(own.0 == through.0, "{name}: one face through the painter");

    // In bands of 13 rows.
    for (by_memory, with_depth) in [(true, false), (false, false), (true, true), (false, true)] {
        let mut banded = Display(blank());
        let (mut strip, mut bin_storage) = (vec![0u8; (SIDE * 13 * 3) as usize], vec![0u16; 4096]);
        let mut frame = Frame::new(area, sky);
        if with_depth {
            let mut bins = instance.transform_depth(&mut cache).bin_faces(&mut bin_storage).unwrap();
            while let Some(mut band) = frame.next_band(&mut strip).unwrap() {
                let mut depth = DepthBuffer::new(band.area(), &mut numbers).unwrap();
                let Ok(()) = match by_memory {
                    true => bins.depth_tested(shade, &mut depth, &mut band.pixels()),
                    false => bins.depth_tested(shade, &mut depth, &mut band),
                };
                let Ok(()) = band.send(&mut banded);
            }
        } else {
            let mut bins = instance.transform(&mut cache).bin_faces(&mut bin_storage).unwrap();
            while let Some(mut band) = frame.next_band(&mut strip).unwrap() {
                let Ok(()) = match by_memory {
                    true => bins.solid(shade, &mut band.pixels()),
                    false => bins.solid(shade, &mut band),
                };
                let Ok(()) = band.send(&mut banded);
            }
        }
        let whole = if with_depth { &deep } else { &display };
        assert!(banded.0 == whole.0, "{name}: bands, by memory {by_memory}, with depth {with_depth}");
    }
}

/// Repeated, clamped and lit textures of cut faces: equal pixels by every draw call.
#[test]
fn cut_textured_faces_are_equal_by_every_draw_call() {
    let mut rng = Rng::new(51);
    for (name, lens, reach) in [
        ("far plane", library(&perspective(20.0)), 400),
        ("guard band", library(&perspective(2000.0)), 6000),
        ("slanted", library(&slanted()), 400),
        ("cabinet", cabinet().1, 900),
    ] {
        let mut faces = Faces::new(-6);
        faces.push(
            [[-6000, -80, 3000], [6000, -90, 3000], [0, -60, -9000]],
            [[0, 3000], [3000, 3000], [1500, 0]],
        );
        let soup = Faces::soup(&mut rng, 60, reach, 2500, |rng| rng.int(-4000, 4000) as i16);
        faces.vertices.extend(soup.vertices);
        faces.uv.extend(soup.uv);
        let camera = camera(&lens).with_far_clip(true);
        let levels: Vec<[u16; 3]> =
            faces.uv.iter().map(|_| [(); 3].map(|()| rng.int(0, 256) as u16)).collect();
        let (texture, lit) = (Texture::new(Colored), Texture::new(LitColored));
        equal_everywhere(name, &faces, &camera, &|face| texture.at(faces.uv[face]));
        equal_everywhere(name, &faces, &camera, &|face| texture.clamped_at(faces.uv[face]));
        equal_everywhere(name, &faces, &camera, &|face| lit.at(faces.uv[face]).lit(levels[face]));
        equal_everywhere(name, &faces, &camera, &|face| lit.clamped_at(faces.uv[face]).lit(levels[face]));
    }
}
