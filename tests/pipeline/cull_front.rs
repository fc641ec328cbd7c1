//! `Cull::Front` draws of a mesh what `Cull::Back` draws of the mesh with all faces turned over, by every draw call.

use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Camera, Cull, DepthBuffer, Mesh, MeshInstance, Painter, ScreenVertex, Statistics};
use std::cell::RefCell;
use std::collections::BTreeMap;
use support::bridge::draw::Shader;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const WIDTH: u32 = 60;
const HEIGHT: u32 = 44;
const FACES: usize = 24;

/// The pixels, with the faces that they show and how often they were drawn; the faces that were shaded, in order; and the counts.
type Drawing = (BTreeMap<(i32, i32), (Shader, u32)>, Vec<usize>, Statistics);

/// Without depth, with depth, in bands of both kinds and from far to near. The pixels are left out where rounding depends on the order
/// of corners: with depth, and where faces are cut.
fn drawings(instance: &MeshInstance<'_>) -> [Drawing; 5] {
    let shaded = RefCell::new(Vec::new());
    let shade = |face: usize| {
        shaded.borrow_mut().push(face);
        Shader(face as u16)
    };
    let target = || Recorder::<Shader>::sized(WIDTH, HEIGHT);
    let drawing = |pixels, statistics: Statistics| match statistics.clipped {
        0 => (pixels, shaded.take(), statistics),
        _ => (BTreeMap::new(), shaded.take(), statistics),
    };
    let mut cache = vec![ScreenVertex::EMPTY; 3 * FACES];
    let (mut bins, mut depths) = (vec![0; 4 * FACES], vec![0; (WIDTH * HEIGHT) as usize]);

    let mut plain = target();
    let statistics = instance.solid(shade, &mut cache, &mut plain).unwrap();
    let plain = drawing(plain.pixels, statistics);

    let mut deep = target();
    let mut depth = DepthBuffer::new(deep.bounding_box(), &mut depths).unwrap();
    let statistics = instance.depth_tested(shade, &mut cache, &mut depth, &mut deep).unwrap();
    let deep = drawing(BTreeMap::new(), statistics);

    let bands =
        || (0..HEIGHT as i32).step_by(9).map(|y| Rectangle::new(Point::new(0, y), Size::new(WIDTH, 9)));
    let mut pixels = BTreeMap::new();
    let mut faces = instance.bin_faces(&mut cache, &mut bins).unwrap();
    for area in bands() {
        let mut band = Recorder::new(area);
        faces.solid(shade, &mut band).unwrap();
        pixels.extend(band.pixels);
    }
    let statistics = faces.statistics();
    let binned = drawing(pixels, statistics);

    let mut faces = instance.bin_faces_with_depth(&mut cache, &mut bins).unwrap();
    for area in bands() {
        let mut band = Recorder::new(area);
        let mut depth = DepthBuffer::new(area, &mut depths).unwrap();
        faces.depth_tested(shade, &mut depth, &mut band).unwrap();
    }
    let statistics = faces.statistics();
    let binned_deep = drawing(BTreeMap::new(), statistics);

    let mut painter = Painter::<Shader, 512, 256>::new();
    painter.add(instance, shade).unwrap();
    let mut painted = target();
    let statistics = painter.draw(&mut painted).unwrap();
    let painted = drawing(painted.pixels, statistics);
    [plain, deep, binned, binned_deep, painted]
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
        .library();
        let model = ModelBits(vec![Step::Y(rng.next() as u32)]).library();
        let [mesh, turned] = [&faces, &turned].map(|faces| Mesh::new(&vertices, -8, faces).unwrap());
        let front = camera.place(&mesh, &model).with_cull(Cull::Front);
        let back = camera.place(&mesh, &model).with_cull(Cull::Back);
        let both = camera.place(&mesh, &model).with_cull(Cull::None);
        let expected = camera.place(&turned, &model).with_cull(Cull::Back);
        let [found, expected] = [front, expected].map(|instance| drawings(&instance));
        assert!(found == expected, "case {case}");
        // Each face with area is drawn by one of both.
        for ((of_front, of_back), of_both) in
            found.iter().zip(drawings(&back)).zip(drawings(&both)).map(|((a, b), c)| ((a.2, b.2), c.2))
        {
            assert_eq!(of_front.drawn + of_back.drawn, of_both.drawn);
            assert_eq!((of_front.culled, of_back.culled), (of_back.drawn, of_front.drawn));
            assert_eq!(of_both.culled, 0);
        }
        (drawn, clipped) = (drawn + found[0].2.drawn, clipped + found[0].2.clipped);
    }
    assert!(drawn > 2000 && clipped > 300, "{drawn} {clipped}");
}
