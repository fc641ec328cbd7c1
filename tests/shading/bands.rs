//! Smooth, tabled and dithered faces by every draw call, and in bands of any height. Plain and translucent colours are tested in `properties`.

use crate::scene::{flat, gouraud, random_colour, random_lights, shaded, Colour, Own};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray4, Rgb565, Rgb888};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::ScreenPoint;
use pinhole::{draw::fill_triangle, prelude::*};
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, by_every_call, screen};
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
        let faces = [(); FACES].map(|()| [(); 3].map(|()| rng.below(VERTICES) as u16));
        let mut shader = || {
            let colours = [(); 3].map(|()| random_colour(rng));
            (flat(colours[0]), gouraud(colours))
        };
        let shaders = (0..FACES).map(|_| shader()).collect();
        let lights = (0..FACES).map(|_| random_lights(rng)).collect();
        let (viewport, frame) = if rng.one_in(3) {
            ((-9, 4, 700, 500), rectangle(-3, 11, 21, 13))
        } else {
            ((0, 0, 21, 13), rectangle(0, 0, 21, 13))
        };
        Self { vertices, faces, shaders, lights, viewport, frame }
    }

    fn place<R>(&self, with: impl FnOnce(&MeshInstance<'_>) -> R) -> R {
        let (_, _, w, h) = self.viewport;
        let camera = CameraBits {
            view: ViewBits::LookAlong([0, 0, 3 * ONE], [0, 0, -ONE], [0, ONE, 0]),
            projection: ProjectionBits::Perspective(1 << 30, (w, h), ONE, 40 * ONE),
            viewport: self.viewport,
        };
        let mesh = Mesh::new(&self.vertices, -6, &self.faces).expect("a mesh");
        with(&camera.library().place(&mesh, &Affine::identity()).with_cull(Cull::None))
    }
}

#[test]
fn bands_of_every_height_add_up_to_the_full_picture() {
    let (mut rng, heights) = (Rng::new(0x80), (1..=13).collect::<Vec<u32>>());
    for _ in 0..60 {
        let scene = Scene::random(&mut rng);
        let (shaders, frame) = (&scene.shaders, scene.frame);
        let tables: Vec<_> = scene.lights.iter().map(|&lights| shaded::<Rgb565>(lights)).collect();
        scene.place(|instance| {
            by_every_call(instance, frame, Rgb565::BLACK, &heights, &|face| shaders[face].1);
            by_every_call(instance, frame, Rgb565::BLACK, &heights, &|face| tables[face]);
            by_every_call(instance, frame, Own::from_bits(0), &heights, &|face| Dithered(shaders[face].1));
            by_every_call(instance, frame, Rgb565::BLACK, &heights, &|face| {
                ScreenDoor::new(shaders[face].1, 20 + face as u8)
            });
            of_parts_of_bytes::<BinaryColor>(instance, &scene);
            of_parts_of_bytes::<Gray4>(instance, &scene);
        });
    }
}

/// Faces of a few pixels with colours of a table. The view is parallel, eight units a pixel, so that many corners and edges hit pixel
/// centres. Faces pierce each other, every fourth one lies in the plane of the face before it, and some lie beyond the viewport's borders.
#[test]
fn tiny_faces_with_depth_are_those_of_the_plain_path() {
    const COUNT: usize = 80;
    let mut rng = Rng::new(0x81);
    let faces: Vec<_> = (0..COUNT as u16)
        .map(|face| [0, 1, 2].map(|corner| 3 * (face - u16::from(face % 4 == 3)) + corner))
        .collect();
    for case in 0..40 {
        let vertices: Vec<_> = (0..COUNT)
            .flat_map(|_| {
                let [x, y, z] = [85, 65, 6].map(|reach| rng.int(-reach, reach));
                let far = if rng.one_in(9) { 32_000 } else { 0 }; // above the frame
                let [width, height] = [0; 2].map(|_| [2, 12, 20, 128][rng.below(4)]);
                [(); 3].map(|()| {
                    let right = [0, width, rng.int(0, width)][rng.below(3)];
                    [x + right, y + far + rng.int(0, height), z + rng.int(-40, 40)].map(|c| c as i16)
                })
            })
            .collect();
        let tables: Vec<_> = (0..COUNT).map(|_| shaded::<Rgb565>(random_lights(&mut rng))).collect();
        let [w, h] = [21, 13].map(|pixels| pixels * ONE / 16);
        let camera = CameraBits {
            view: ViewBits::LookAlong([0, 0, 3 * ONE], [0, 0, -ONE], [0, ONE, 0]),
            projection: ProjectionBits::Orthographic([-w, w, -h, h], ONE / 4, 9 * ONE),
            viewport: (0, 0, 21, 13),
        };
        let mesh = Mesh::new(&vertices, -6, &faces).expect("a mesh");
        let frame = [rectangle(2, 1, 17, 11), rectangle(-3, -2, 28, 17)][case % 2];
        for cull in [Cull::Back, Cull::None] {
            let instance = camera.library().place(&mesh, &Affine::identity()).with_cull(cull);
            by_every_call(&instance, frame, Rgb565::BLACK, &[1, 2, 3, 8, 17], &|face| tables[face]);
        }
    }
}

/// Pixels of less than a byte are packed in bands, and cannot be drawn into memory.
fn of_parts_of_bytes<C: Colour>(instance: &MeshInstance<'_>, scene: &Scene) {
    let shade: &dyn Fn(usize) -> _ = &|face| Dithered(scene.shaders[face].1);
    let (whole, _) = screen(scene.frame, &mut |target, _| {
        let Ok(_) = instance.faces(shade).draw(target);
    });
    let (mut cache, mut bins) = ([ScreenVertex::EMPTY; VERTICES], vec![0; instance.mesh().face_bins_len()]);
    let transformed = instance.transform(&mut cache);
    let mut faces = transformed.bin_faces(&mut bins).expect("room");
    for rows in 1..=13 {
        let banded = bands(scene.frame, C::from_bits(0), rows, &mut |band, _| {
            let Ok(()) = faces.draw(shade, band);
        });
        assert!(banded == whole.over(C::from_bits(0)), "{rows} rows");
    }
}

/// 2D triangles: gradients continue from band to band.
#[test]
fn two_dimensional_triangles_in_bands_add_up_to_the_full_picture() {
    let (mut rng, area) = (Rng::new(0x82), rectangle(0, 0, 200, 120));
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
        let (whole, _) = screen(area, &mut |target, _| {
            let Ok(()) = fill_triangle([a, b, c], smooth, target);
        });
        for rows in [1, 8] {
            let banded = bands(area, Rgb888::BLACK, rows, &mut |band, _| {
                let Ok(()) = match case % 4 {
                    0 | 1 => fill_triangle([a, b, c], smooth, band),
                    _ => fill_triangle([a, b, c], smooth, &mut band.pixels()),
                };
            });
            assert!(banded == whole.over(Rgb888::BLACK), "{:?}, {rows} rows", [a, b, c]);
        }
    }
}
