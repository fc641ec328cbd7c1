//! T1 and F50: frames that place moving objects. Counted is what a frame of an animation does, the objects' transforms with
//! it; the lens is set up before.

use super::{count, drawn, Counted, Deep, Plain, CUBE};
use crate::scene::{self, View, LINE, SIZE};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, World};
use pinhole::{camera::Visibility, prelude::*, Angle};

/// S1's pose is a turn of 37° about y, then one of 28° about x. The camera of T1 is raised by the second instead, on a circle
/// about the cube: sine and cosine of 28°, times S1's distance, in 2⁻¹⁶.
const T1_EYE: [i32; 3] = [0, 126_213, 237_374];

/// The cube of S1 turns by 3° a frame before a camera that stands still; the counted frame shows nearly S1's picture.
pub(super) fn t1(Plain { frame, corners, .. }: &mut Plain<CUBE>) -> Option<Counted> {
    let camera = View::new(T1_EYE, scene::area().size).camera()?;
    let mut turn = Angle::degrees(31);
    count(frame, &mut |picture| {
        turn = black_box(turn + Angle::degrees(3));
        let model = Affine::rotation_y(turn);
        let (camera, mesh) = black_box((&camera, &scene::CUBE.mesh));
        let instance = camera.place(mesh, &model);
        drawn(instance.edges(|_| black_box(LINE)).cached(corners).draw(&mut picture.pixels()))
    })
}

/// Cubes of a row of F50, and rows.
const COLUMNS: i32 = 10;
const ROWS: i32 = 5;

/// Fifty cubes that each turn about y, from the farthest row to the nearest, before a camera that moves along x and looks ahead: 25
/// of them are in view in the counted frame.
pub(super) fn f50_z(Deep { frame, depth, corners }: &mut Deep<CUBE>) -> Option<Counted> {
    let size = Size::new(SIZE, SIZE);
    let mesh = black_box(&scene::CUBE).mesh;
    let sphere = mesh.bounding_sphere();
    let (near, far) = (Scalar::from_bits(black_box(1 << 15)), Scalar::from_bits(black_box(40 << 16)));
    let lens = Projection::perspective(Angle::degrees(black_box(60)), size, near, far).ok()?;
    let viewport = Viewport::new(Point::zero(), size).ok()?;
    let mut time = 0;
    count(frame, &mut |picture| {
        let mut depth = depth.buffer()?;
        let mut draw = |camera: &Camera, model: &Affine<Model, World>| {
            let light = scene::lit(model)?;
            let (shade, mut pixels) = (scene::flat(&mesh, |normal| light.level(normal)), picture.pixels());
            let instance = camera.place(&mesh, model);
            drawn(instance.faces(shade).cached(corners).draw(&mut pixels.depth_tested(&mut depth)))
        };
        time = black_box(time + 1);
        // A sixteenth of a unit a frame.
        let x = Scalar::from_bits((time << 12) - (1 << 15));
        let [eye, ahead] =
            [[3, 0], [0, -12]].map(|at| at.map(Scalar::from_int)).map(|[y, z]| Point3::new(x, y, z));
        let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).ok()?;
        let camera = Camera::new(&view, &lens, &viewport);
        let (frustum, mut in_view) = (camera.frustum(), 0);
        for row in 0..black_box(ROWS) {
            for column in 0..black_box(COLUMNS) {
                let turn = Angle::degrees(3 * time + 20 * column + 7 * row);
                let to = Vector3::from_ints((6 * column - 27) as i16, 0, (6 * row - 32) as i16);
                let model = Affine::<_, Model>::rotation_y(turn).then(&Affine::translation(to));
                if frustum.visibility(&sphere, &model) != Visibility::Outside {
                    in_view += 1;
                    draw(&camera, &model)?;
                }
            }
        }
        black_box(in_view);
        Some(())
    })
}
