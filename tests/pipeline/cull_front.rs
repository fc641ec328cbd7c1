//! `Cull::Front` draws of a mesh what `Cull::Back` draws of the mesh with all faces turned over, by every draw call.

use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, RgbColor};
use pinhole::{Camera, Cull, Mesh, MeshInstance, Statistics};
use std::cell::RefCell;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::by_every_call;
use support::oracle::rng::Rng;

const WIDTH: u32 = 60;
const HEIGHT: u32 = 44;
const FACES: usize = 24;

/// The pictures, the faces that were shaded, in order, and the counts. The pictures are left out where faces are cut: rounding depends on
/// the order of corners there.
fn drawing(instance: &MeshInstance<'_>) -> (Option<[Vec<Rgb565>; 2]>, Vec<usize>, Statistics) {
    let shaded = RefCell::new(Vec::new());
    let shade = |face: usize| {
        shaded.borrow_mut().push(face);
        Rgb565::from(RawU16::new(face as u16 + 1))
    };
    let area = rectangle(0, 0, WIDTH, HEIGHT);
    let (drawn, counted) = by_every_call(instance, area, Rgb565::BLACK, &[9, HEIGHT], &shade);
    ((counted.clipped == 0).then_some([drawn.solid, drawn.painted]), shaded.into_inner(), counted)
}

/// A soup about the near plane, and the counts of front, back and other faces.
#[test]
fn front_faces_are_culled_as_back_faces_of_the_mesh_turned_over_are() {
    let mut rng = Rng::new(0xf0);
    let (mut drawn, mut clipped) = (0, 0);
    for case in 0..400 {
        let reach = [300, 900, 3000][case % 3];
        let vertices: Vec<[i16; 3]> =
            (0..3 * FACES).map(|_| [(); 3].map(|()| rng.int(-reach, reach) as i16)).collect();
        let faces: Vec<[u16; 3]> =
            (0..FACES).map(|_| [(); 3].map(|()| rng.below(3 * FACES) as u16)).collect();
        let turned: Vec<[u16; 3]> = faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let camera: Camera = CameraBits {
            view: ViewBits::LookAt([0, ONE, 4 * ONE], [0; 3], [ONE / 5, ONE, 0]),
            projection: match case % 4 {
                0 => ProjectionBits::Orthographic([-4 * ONE, 4 * ONE, -3 * ONE, 3 * ONE], ONE, 9 * ONE),
                _ => ProjectionBits::Perspective(1 << 29, (WIDTH, HEIGHT), ONE, 40 * ONE),
            },
            viewport: (0, 0, WIDTH, HEIGHT),
        }
        .library()
        // Without depth, faces beyond a far plane that does not clip are drawn.
        .with_far_clip(true);
        let model = ModelBits(vec![Step::Y(rng.next() as u32)]).library();
        let [mesh, turned] = [&faces, &turned].map(|faces| Mesh::new(&vertices, -8, faces).unwrap());
        let drawing_of = |mesh, cull| drawing(&camera.place(mesh, &model).with_cull(cull));
        let (front, expected) = (drawing_of(&mesh, Cull::Front), drawing_of(&turned, Cull::Back));
        assert!(front == expected, "case {case}");
        // Each face with area is drawn by one of both.
        let [back, both] = [Cull::Back, Cull::None].map(|cull| drawing_of(&mesh, cull).2);
        assert_eq!(front.2.drawn + back.drawn, both.drawn);
        assert_eq!((front.2.culled, back.culled, both.culled), (back.drawn, front.2.drawn, 0));
        (drawn, clipped) = (drawn + front.2.drawn, clipped + front.2.clipped);
    }
    assert!(drawn > 2000 && clipped > 300, "{drawn} {clipped}");
}
