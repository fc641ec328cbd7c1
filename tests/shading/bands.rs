//! Smooth and dithered pictures in bands of any height equal the picture drawn at once.

use crate::scene::{
    flat, for_every_colour, gouraud, random_colour, random_lights, shaded, Colour, Own, Picture,
};
use embedded_graphics_core::pixelcolor::{Gray8, Rgb565, Rgb888};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::ScreenPoint;
use pinhole::{
    fill_triangle, Affine, Camera, Cull, DepthBuffer, Dithered, Flat, Frame, Gouraud, Mesh, Painter,
    ScreenVertex, SpanShader, StoredPixel, TableShader,
};
use support::bridge;
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::shade::Lit;

const FACES: usize = 14;
const VERTICES: usize = 16;

/// A tangle of faces about the picture, some of them through the near plane, some far larger than the screen.
struct Scene {
    vertices: [[i16; 3]; VERTICES],
    faces: [[u16; 3]; FACES],
    shaders: Vec<(Flat, Gouraud)>,
    lights: Vec<[Lit; 3]>,
    /// The viewport, and a frame that shows a part of it or all of it.
    viewport: (i32, i32, u32, u32),
    frame: Rectangle,
}

impl Scene {
    fn random(rng: &mut Rng) -> Self {
        let mut vertices = [[0; 3]; VERTICES];
        for vertex in &mut vertices {
            let reach = if rng.one_in(5) { 3000 } else { 300 };
            *vertex = [rng.int(-reach, reach), rng.int(-reach, reach), rng.int(-500, 30)].map(|c| c as i16);
        }
        let mut index = || rng.below(VERTICES) as u16;
        let faces = [[0; 3]; FACES].map(|face| face.map(|_: u16| index()));
        let shaders = (0..FACES)
            .map(|_| {
                let colours = [0; 3].map(|_| random_colour(rng));
                (flat(colours[0]), gouraud(colours))
            })
            .collect();
        let lights = (0..FACES).map(|_| random_lights(rng)).collect();
        let (viewport, frame) = if rng.one_in(3) {
            ((-9, 4, 700, 500), bridge::rectangle(-3, 11, 21, 13))
        } else {
            ((0, 0, 21, 13), bridge::rectangle(0, 0, 21, 13))
        };
        Self { vertices, faces, shaders, lights, viewport, frame }
    }

    fn camera(&self) -> Camera {
        let (_, _, w, h) = self.viewport;
        CameraBits {
            view: ViewBits::LookAlong([0, 0, 3 * ONE], [0, 0, -ONE], [0, ONE, 0]),
            projection: ProjectionBits::Perspective(1 << 30, (w, h), ONE, 40 * ONE),
            viewport: self.viewport,
        }
        .library()
    }

    fn check<C: Colour, I: SpanShader<C>>(&self, shader: &dyn Fn(usize) -> I) {
        let (camera, background) = (self.camera(), C::decode(0));
        let mesh = Mesh::new(&self.vertices, -6, &self.faces).expect("a mesh");
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        let pixels = (self.frame.size.width * self.frame.size.height) as usize;
        let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; VERTICES], [0; FACES + 1]);

        let [mut solid, mut nearer, mut painted] = [0; 3].map(|_| Picture::<C>::new(self.frame));
        let Ok(_) = instance.solid(shader, &mut corners, &mut solid);
        let mut storage = vec![0; pixels];
        let mut depth = DepthBuffer::new(self.frame, &mut storage).expect("storage");
        let Ok(_) = instance.depth_tested(shader, &mut corners, &mut depth, &mut nearer);
        let mut painter = Box::new(Painter::<I, 200, 80>::new());
        painter.add(&instance, shader).expect("room");
        let order = painter.order();
        let Ok(()) = order.draw(&mut painted);

        let banded = |rows: u32, draw: &mut dyn FnMut(&mut pinhole::Band<'_, C>)| -> Vec<C> {
            let mut frame = Frame::new(self.frame, background);
            let mut strip = vec![0xff; Frame::<C>::strip_bytes(self.frame.size.width, rows)];
            let mut colours = Vec::new();
            while let Some(mut band) = frame.next_band(&mut strip).expect("a row at least") {
                draw(&mut band);
                colours.extend(band.colors());
            }
            colours
        };
        let name = core::any::type_name::<(C, I)>();
        for rows in 1..=self.frame.size.height {
            let order = &order;
            let bands = banded(rows, &mut |band| {
                let Ok(()) = order.draw(band);
            });
            assert!(bands == painted.before(background), "{name}: painter, {rows} rows");
            let projected = instance.transform(&mut corners);
            let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
            let bands = banded(rows, &mut |band| {
                let Ok(()) = faces.solid(shader, band);
            });
            assert!(bands == solid.before(background), "{name}: {rows} rows");
            let projected = instance.transform_depth(&mut corners);
            let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
            let bands = banded(rows, &mut |band| {
                let mut storage = vec![0; pixels];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                let Ok(()) = faces.depth_tested(shader, &mut depth, band);
            });
            assert!(bands == nearer.before(background), "{name}: with depth, {rows} rows");
        }
    }
}

fn every_ink<C: Colour>(scene: &Scene) {
    let smooth = |face: usize| scene.shaders[face].1;
    let even = |face: usize| scene.shaders[face].0;
    scene.check::<C, Gouraud>(&smooth);
    scene.check::<C, Dithered<Gouraud>>(&|face| smooth(face).dithered());
    let tables: Vec<_> = scene.lights.iter().map(|&lights| shaded::<C>(lights)).collect();
    scene.check::<C, TableShader<'_, C>>(&|face| tables[face]);
    scene.check::<C, Flat>(&even);
    scene.check::<C, Dithered<Flat>>(&|face| even(face).dithered());
}

#[test]
fn bands_of_every_height_add_up_to_the_full_picture() {
    let mut rng = Rng::new(0x80);
    for _ in 0..60 {
        let scene = Scene::random(&mut rng);
        for_every_colour!(every_ink(&scene));
    }
}

/// Bands whose pixels are stored in their memory, with one to four bytes per pixel.
fn through_pixels<C: Colour + StoredPixel<[u8; N]>, const N: usize>(scene: &Scene) {
    let camera = scene.camera();
    let mesh = Mesh::new(&scene.vertices, -6, &scene.faces).expect("a mesh");
    let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
    let pixels = (scene.frame.size.width * scene.frame.size.height) as usize;
    let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; VERTICES], [0; FACES + 1]);
    let projected = instance.transform_depth(&mut corners);
    let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
    for rows in [1, 7, scene.frame.size.height] {
        let [one, other] = [false, true].map(|fast| {
            let mut frame = Frame::new(scene.frame, C::decode(0));
            let mut strip = vec![0xff; Frame::<C>::strip_bytes(scene.frame.size.width, rows)];
            let mut bytes = Vec::new();
            while let Some(mut band) = frame.next_band(&mut strip).expect("a row at least") {
                let mut storage = vec![0; pixels];
                let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
                let smooth = |face: usize| scene.shaders[face].1.dithered();
                let Ok(()) = match fast {
                    true => faces.depth_tested(smooth, &mut depth, &mut band.pixels()),
                    false => faces.depth_tested(smooth, &mut depth, &mut band),
                };
                bytes.extend_from_slice(band.bytes());
            }
            bytes
        });
        assert!(one == other, "{}, {rows} rows", core::any::type_name::<C>());
    }
}

#[test]
fn bands_of_stored_pixels_send_the_full_picture() {
    let mut rng = Rng::new(0x81);
    for _ in 0..60 {
        let scene = Scene::random(&mut rng);
        through_pixels::<Gray8, 1>(&scene);
        through_pixels::<Rgb565, 2>(&scene);
        through_pixels::<Rgb888, 3>(&scene);
        through_pixels::<Own, 4>(&scene);
    }
}

/// 2D triangles: gradients continue from band to band.
#[test]
fn two_dimensional_triangles_in_bands_add_up_to_the_full_picture() {
    let mut rng = Rng::new(0x82);
    let area = Rectangle::new(Point::zero(), Size::new(200, 120));
    for case in 0..4_000 {
        let reach = [20_000, 60_000, 2_000_000][case % 3];
        let corner = |rng: &mut Rng| {
            let [x, y] = [0; 2].map(|_| rng.int(-reach, reach) as i32);
            ScreenPoint::from_subpixels(x, y).expect("in the guard band")
        };
        let [a, b, mut c] = [0; 3].map(|_| corner(&mut rng));
        if case % 2 == 0 {
            // A steep gradient: the third corner is next to the line through the other two.
            let mut between = |a: i32, b: i32| a / 2 + b / 2 + rng.int(-3000, 3000) as i32;
            let (x, y) = (between(a.x(), b.x()), between(a.y(), b.y()));
            c = ScreenPoint::from_subpixels(x, y).unwrap_or(c);
        }
        let smooth = gouraud([0; 3].map(|_| random_colour(&mut rng)));
        let mut whole = Picture::<Rgb888>::new(area);
        let Ok(()) = fill_triangle([a, b, c], smooth, &mut whole);
        let wanted = whole.before(Rgb888::default());
        for rows in [1, 8] {
            let mut frame = Frame::new(area, Rgb888::default());
            let mut strip = vec![0; Frame::<Rgb888>::strip_bytes(area.size.width, rows)];
            let mut colours = Vec::new();
            while let Some(mut band) = frame.next_band(&mut strip).expect("a row at least") {
                let Ok(()) = match case % 4 {
                    0 | 1 => fill_triangle([a, b, c], smooth, &mut band),
                    _ => fill_triangle([a, b, c], smooth, &mut band.pixels()),
                };
                colours.extend(band.colors());
            }
            assert!(colours == wanted, "{:?}, {rows} rows", [a, b, c]);
        }
    }
}
