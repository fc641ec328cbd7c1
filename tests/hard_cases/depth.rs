//! D: depth.

use embedded_graphics_core::primitives::PointsIter;
use pinhole::prelude::*;
use pinhole::space::{Model, World};
use support::bridge::draw::Shader;
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::screen;
use support::oracle::chain;
use support::oracle::picture::{compare, Scene};
use support::oracle::rng::Rng;
use support::oracle::target::Screen;

const SIZE: (u32, u32) = (96, 80);

/// Draws triangles with an identity model matrix: the visible face of each pixel, or −1, and its depth.
fn draw(
    camera: &CameraBits,
    vertices: &[[i16; 3]],
    exponent: i8,
    faces: &[[u16; 3]],
) -> (Vec<i32>, Vec<u16>) {
    let mesh = Mesh::new(vertices, exponent, faces).expect("a mesh");
    let instance = camera.library().place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    let (picture, depths) = screen(rectangle(0, 0, SIZE.0, SIZE.1), &mut |target, depth| {
        let Ok(_) = instance.faces(|face| Shader(face as u16)).draw(&mut target.depth_tested(depth));
    });
    (picture.pixels.iter().map(|pixel| pixel.map_or(-1, |Shader(face)| face.into())).collect(), depths)
}

/// The scene of [`draw`] for the oracle.
fn scene(camera: &CameraBits, vertices: &[[i16; 3]], exponent: i8, faces: &[[u16; 3]]) -> Scene {
    let exact = camera.exact();
    let row = |i: usize| {
        let [x, y, z] = exact.view.rows[i];
        [x, y, z, -chain::dot(exact.view.rows[i], exact.view.eye)]
    };
    let (last, viewport) = ([0.0, 0.0, 0.0, 1.0], exact.viewport);
    Scene {
        vertices: vertices.iter().map(|&v| chain::vertex(v, exponent)).collect(),
        triangles: faces.iter().map(|f| f.map(usize::from)).collect(),
        model: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], last],
        view: [row(0), row(1), row(2), last],
        projection: exact.projection,
        width: SIZE.0 as usize,
        height: SIZE.1 as usize,
        viewport: [viewport.x, viewport.y, viewport.width, viewport.height],
        cull: false,
    }
}

/// From z = 20 to the origin, 60° upright.
fn camera(near: i32, far: i32) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, 0, 20 * ONE], [0; 3], [0, ONE, 0]),
        ..CameraBits::perspective(0x2aaa_aaab, SIZE, near, far)
    }
}

/// Two triangles over each other's middle, tilted alike, a few units of 2⁻¹⁰ apart: a step of depth is
/// dz = z²·(f − n)/(f·n)·2⁻¹⁶ = 0.0060 there for n = 1, f = 100, about six units.
fn nearly_coplanar(rng: &mut Rng) -> [[i16; 3]; 6] {
    let tilt = [rng.real(-0.7, 0.7), rng.real(-0.7, 0.7)];
    let apart = rng.real(-30.0, 30.0);
    let mut corner = |lift: f64, at: [f64; 2]| {
        let [x, y] = at.map(|c| c * 9_000.0 + rng.real(-1_000.0, 1_000.0));
        [x, y, tilt[0] * x + tilt[1] * y + lift].map(|c| c.round() as i16)
    };
    let around = [[-1.0, -0.8], [1.0, -0.8], [0.0, 1.0]];
    let [a, b, c] = around.map(|at| corner(0.0, at));
    let [d, e, f] = around.map(|at| corner(apart, at));
    [a, b, c, d, e, f]
}

/// The oracle counts depths within two steps as equal. Faces farther apart must be drawn right in both orders.
#[test]
fn d1_faces_two_steps_apart_are_told_apart() {
    let mut rng = Rng::new(0xd1);
    let (mut shown, mut decided) = (0, 0);
    for _ in 0..300 {
        let camera = camera(ONE, 100 * ONE);
        let vertices = nearly_coplanar(&mut rng);
        for faces in [[[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]] {
            let (ids, depths) = draw(&camera, &vertices, -10, &faces);
            let found = compare(&scene(&camera, &vertices, -10, &faces), &ids, &depths);
            assert!(found.shift <= 0.0028 && found.depth <= 0.54, "{vertices:?}: {found:?}");
            shown += found.covered;
            decided += ids.iter().filter(|&&id| id == 0).count();
        }
    }
    // Each triangle is visible about half of the time.
    assert!(shown > 500_000 && decided * 3 > shown && decided * 3 < shown * 2, "{decided} of {shown}");
}

/// Depths less than two steps apart may be drawn in either order, but repeatably; of equal depths the first stays.
#[test]
fn d1_the_first_of_two_equal_depths_stays() {
    let mut rng = Rng::new(0xd1d1);
    for _ in 0..100 {
        let camera = camera(ONE, 100 * ONE);
        let mut vertices = nearly_coplanar(&mut rng);
        let once = draw(&camera, &vertices, -10, &[[0, 1, 2], [3, 4, 5]]);
        assert!(once == draw(&camera, &vertices, -10, &[[0, 1, 2], [3, 4, 5]]));
        for i in 0..3 {
            vertices[3 + i] = vertices[i];
        }
        let (ids, _) = draw(&camera, &vertices, -10, &[[0, 1, 2], [3, 4, 5]]);
        assert!(ids.iter().all(|&id| id <= 0) && ids.contains(&0));
    }
}

/// docs/spec.md, section 7: the stored depth is round(65535·(z/w + 1)/2), and 65535 where nothing is drawn; it is linear on the screen.
#[test]
fn d3_stored_depth_is_rounded_and_linear_on_the_screen() {
    let mut rng = Rng::new(0xd3);
    let wall = |z: i16| {
        let (x, y) = (i16::MAX, i16::MAX);
        [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]]
    };
    let faces = [[0, 1, 2], [0, 2, 3]];
    // An empty depth buffer.
    let (_, depths) = draw(&camera(ONE, 100 * ONE), &wall(0), -10, &[]);
    assert!(depths.iter().all(|&d| d == DepthBuffer::NOTHING));
    for flat in [false, true] {
        for _ in 0..300 {
            let (near, far) = (rng.int(1, 12) as i32 * ONE / 2, rng.int(26, 200) as i32 * ONE);
            let mut camera = camera(near, far);
            if flat {
                let window = [-20, 20, -20, 20].map(|c| c * ONE);
                camera.projection = ProjectionBits::Orthographic(window, near, far);
            }
            // From 14 units before the middle to 6 behind.
            let vertices = wall(rng.int(-6 * 1024, 14 * 1024) as i16);
            let exact = camera.exact();
            let clip = exact.clip(&chain::IDENTITY, chain::vertex(vertices[0], -10));
            let depth = chain::depth(clip);
            let (_, depths) = draw(&camera, &vertices, -10, &faces);
            let stored = f64::from(depths[0]);
            assert!(
                depths.iter().all(|&d| f64::from(d) == stored),
                "a wall perpendicular to the view has one depth"
            );
            // Rounded to nearest but for what the chain adds, as stated for `MeshInstance::project`.
            assert!((stored - depth).abs() <= 0.51, "{stored} for {depth}");
        }
    }
    // On the near plane and on the far one.
    let (_, depths) = draw(&camera(8 * ONE, 24 * ONE), &wall(12 * 1024), -10, &faces);
    assert!(depths.iter().all(|&d| d == 0));
    let (_, depths) = draw(&camera(8 * ONE, 24 * ONE), &wall(-4 * 1024), -10, &faces);
    assert!(depths.iter().all(|&d| d == 65_534));
}

/// Only pixels inside the depth buffer are drawn, and these as with a depth buffer that covers the target.
#[test]
fn d3_only_pixels_of_the_depth_buffer_are_drawn() {
    let camera = camera(ONE, 100 * ONE);
    let mut rng = Rng::new(0xd3d3);
    let vertices = nearly_coplanar(&mut rng);
    let faces = [[0, 1, 2], [3, 4, 5]];
    let (ids, whole) = draw(&camera, &vertices, -10, &faces);
    let mesh = Mesh::new(&vertices, -10, &faces).expect("a mesh");
    let instance = camera.library().place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    for (x, y, width, height) in [(0, 0, SIZE.0, 8), (-5, 30, 40, 1), (90, 70, 1000, 1000), (20, 20, 0, 5)] {
        let mut picture = Screen::sized(SIZE.0, SIZE.1);
        let mut storage = vec![7; (width * height) as usize];
        let mut depth = DepthBuffer::new(rectangle(x, y, width, height), &mut storage).expect("storage");
        let Ok(_) = instance.faces(|face| Shader(face as u16)).draw(&mut picture.depth_tested(&mut depth));
        for (at, (&id, &deep)) in rectangle(0, 0, SIZE.0, SIZE.1).points().zip(ids.iter().zip(&whole)) {
            let held = depth.at(at);
            assert_eq!(held.is_some(), rectangle(x, y, width, height).contains(at));
            let seen = picture.at(at).map_or(-1, |Shader(face)| face.into());
            assert_eq!((seen, held.unwrap_or(deep)), (if held.is_some() { id } else { -1 }, deep));
        }
    }
}
