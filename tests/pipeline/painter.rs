//! Painter's order: from far to near, faces of equal depth in the order in which they were added.

use pinhole::{Mesh, Painter, PainterError};
use support::bridge;
use support::bridge::draw::Shader;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder};

/// 1 … 1000 along −z.
fn camera() -> pinhole::Camera {
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (1, 1), ONE, 1000 * ONE),
        viewport: (0, 0, 16, 16),
    }
    .library()
}

/// A square perpendicular to the axis that covers the picture at any distance up to 100.
const VERTICES: [[i16; 3]; 3] = [[-600, -300, 0], [600, -300, 0], [0, 600, 0]];
const FACE: [[u16; 3]; 1] = [[0, 1, 2]];

/// The order in which colours first appear.
fn order(calls: &[Call<Shader>]) -> Vec<u16> {
    let mut order = Vec::new();
    for call in calls {
        if let Call::Solid(_, Shader(colour)) = call
            && order.last() != Some(colour)
        {
            order.push(*colour);
        }
    }
    order
}

fn paint(depths: &[i32]) -> Vec<u16> {
    let (camera, mesh) = (camera(), Mesh::new(&VERTICES, 0, &FACE).expect("a mesh"));
    let mut painter = Painter::<Shader, 300, 100>::new();
    for (i, &z) in depths.iter().enumerate() {
        let model = ModelBits(vec![Step::Move([0, 0, -z])]).library();
        painter.add(&camera.place(&mesh, &model), |_| Shader(i as u16)).expect("enough room");
    }
    let mut target = Recorder::sized(16, 16);
    let statistics = painter.draw(&mut target).expect("no error");
    assert_eq!(statistics.drawn as usize, depths.len());
    order(&target.calls)
}

#[test]
fn painter_draws_far_faces_first() {
    assert_eq!(paint(&[2 * ONE, 9 * ONE, 5 * ONE, 100 * ONE]), [3, 1, 2, 0]);
}

#[test]
fn painter_keeps_the_order_of_equal_depths() {
    let z = 7 * ONE;
    assert_eq!(paint(&[z; 20]), (0..20).collect::<Vec<u16>>());
    assert_eq!(paint(&[z, 3 * z, z, 3 * z, z]), [1, 3, 0, 2, 4]);
}

#[test]
fn painter_sorts_any_number_of_faces() {
    let mut rng = Rng::new(0x9A);
    for n in [1, 2, 3, 17, 64, 100] {
        for _ in 0..20 {
            // Depth steps of 65536 are coarse far away: keep to steps that differ or are equal.
            let depths: Vec<i32> = (0..n).map(|_| (ONE * 5 / 4) << rng.below(7)).collect();
            let mut wanted: Vec<u16> = (0..n as u16).collect();
            wanted.sort_by_key(|&i| core::cmp::Reverse(depths[usize::from(i)]));
            assert_eq!(paint(&depths), wanted);
        }
    }
}

#[test]
fn faces_of_one_mesh_are_sorted_too() {
    let mut vertices: Vec<[i16; 3]> = Vec::new();
    let mut faces: Vec<[u16; 3]> = Vec::new();
    let depths = [5i16, 3, 80, 2, 40, 3];
    for (k, &z) in depths.iter().enumerate() {
        vertices.extend(VERTICES.map(|[x, y, _]| [x, y, -z]));
        let k = 3 * k as u16;
        faces.push([k, k + 1, k + 2]);
    }
    let mesh = Mesh::new(&vertices, 0, &faces).expect("a mesh");
    let mut painter = Painter::<Shader, 18, 6>::new();
    let model = ModelBits::default().library();
    painter.add(&camera().place(&mesh, &model), |face| Shader(face as u16)).expect("exactly enough room");
    let mut target = Recorder::sized(16, 16);
    painter.draw(&mut target).expect("no error");
    assert_eq!(order(&target.calls), [2, 4, 0, 1, 5, 3]);
    // Only the nearest face remains visible.
    assert!(target.pixels.values().all(|&(c, n)| (c, n) == (Shader(3), 6)));
}

#[test]
fn a_full_painter_names_the_parameter_and_value_to_raise() {
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let (camera, model) = (camera(), ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library());
    let instance = camera.place(&mesh, &model);
    let mut painter = Painter::<Shader, 7, 9>::new();
    for _ in 0..2 {
        painter.add(&instance, |_| Shader(0)).expect("enough room");
    }
    assert!(matches!(
        painter.add(&instance, |_| Shader(0)),
        Err(PainterError::Vertices { needed: 9, capacity: 7 })
    ));
    let mut painter = Painter::<Shader, 9, 2>::new();
    for _ in 0..2 {
        painter.add(&instance, |_| Shader(0)).expect("enough room");
    }
    assert!(matches!(
        painter.add(&instance, |_| Shader(1)),
        Err(PainterError::Faces { needed: 3, capacity: 2 })
    ));
    // The faces added before are drawn.
    let mut target = Recorder::sized(16, 16);
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 2);
    assert!(target.pixels.values().all(|&(c, n)| (c, n) == (Shader(0), 2)));
    // With exactly that capacity the mesh fits.
    let mut painter = Painter::<Shader, 9, 3>::new();
    for _ in 0..3 {
        painter.add(&instance, |_| Shader(0)).expect("enough room");
    }
}

#[test]
fn nothing_recorded_draws_nothing() {
    let mut target = Recorder::sized(16, 16);
    let mut painter = Painter::<Shader, 4, 4>::new();
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 0);
    assert!(target.calls.is_empty());
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let model = ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library();
    painter.add(&camera().place(&mesh, &model), |_| Shader(0)).expect("enough room");
    painter.clear();
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 0);
    assert!(target.calls.is_empty());
}

/// A mesh without vertices leaves nothing behind, not even its viewport.
#[test]
fn an_empty_mesh_leaves_the_viewport_open() {
    let (empty, mesh) = (Mesh::new(&[], 0, &[]), Mesh::new(&VERTICES, 0, &FACE));
    let (empty, mesh) = (empty.expect("a mesh"), mesh.expect("a mesh"));
    let model = ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library();
    let other = bridge::draw::cube_camera((3, 4, 9, 9)).library();
    let mut painter = Painter::<Shader, 4, 4>::new();
    painter.add(&other.place(&empty, &model), |_| Shader(0)).expect("no room needed");
    painter.add(&camera().place(&mesh, &model), |_| Shader(7)).expect("the first that draws anything");
    assert_eq!(painter.add(&other.place(&mesh, &model), |_| Shader(0)), Err(PainterError::OtherViewport));
    let mut target = Recorder::sized(16, 16);
    painter.draw(&mut target).expect("no error");
    assert_eq!(order(&target.calls), [7]);
}

/// Sorting, drawing, adding faces and sorting again gives the order of all faces added at once.
#[test]
fn painter_sorts_faces_added_later() {
    let mut rng = Rng::new(0x9C);
    let (camera, mesh) = (camera(), Mesh::new(&VERTICES, 0, &FACE).expect("a mesh"));
    for _ in 0..200 {
        let depths: Vec<i32> = (0..20).map(|_| (ONE * 5 / 4) << rng.below(7)).collect();
        let mut painter = Painter::<Shader, 60, 20>::new();
        for (i, &z) in depths.iter().enumerate() {
            let model = ModelBits(vec![Step::Move([0, 0, -z])]).library();
            painter.add(&camera.place(&mesh, &model), |_| Shader(i as u16)).expect("enough room");
            if rng.one_in(3) || i == 19 {
                let mut target = Recorder::sized(16, 16);
                painter.order().draw(&mut target).expect("no error");
                assert_eq!(order(&target.calls), paint(&depths[..=i]), "{depths:?}");
            }
        }
    }
}

#[test]
fn drawing_empties_the_painter_even_if_the_target_fails() {
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let (camera, model) = (camera(), ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library());
    let instance = camera.place(&mesh, &model);
    let mut painter = Painter::<Shader, 3, 1>::new();
    for fails in [None, Some(0), Some(3)] {
        painter.add(&instance, |_| Shader(0)).expect("enough room");
        let mut target = Recorder::sized(16, 16);
        target.fails_at = fails;
        assert_eq!(painter.draw(&mut target).is_err(), fails.is_some());
        let mut target = Recorder::sized(16, 16);
        let statistics = painter.draw(&mut target).expect("no error");
        assert!(target.calls.is_empty());
        assert_eq!(statistics, pinhole::Statistics::default());
    }
}

#[test]
fn painter_sorts_by_the_mean_depth_of_the_corners() {
    // Slanted triangles at random; each face shows at least a pixel to be seen in the order.
    let mut rng = Rng::new(0x9B);
    let camera = camera();
    let model = ModelBits::default().library();
    let mut compared = 0;
    for _ in 0..500 {
        let vertices: Vec<[i16; 3]> = (0..60)
            .map(|_| {
                let z = rng.int(20, 2000);
                let r = z * 5 / 4;
                [rng.int(-r, r) as i16, rng.int(-r, r) as i16, -z as i16]
            })
            .collect();
        let faces: Vec<[u16; 3]> = (0..20).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh::new(&vertices, -4, &faces).expect("a mesh");
        let instance = camera.place(&mesh, &model).with_cull(pinhole::Cull::None);
        let mut painter = Painter::<Shader, 60, 20>::new();
        painter.add(&instance, |face| Shader(face as u16)).expect("enough room");
        let mut target = Recorder::sized(16, 16);
        painter.draw(&mut target).expect("no error");
        let sum = |face: u16| -> Option<u32> {
            faces[usize::from(face)]
                .iter()
                .map(|&v| instance.project(usize::from(v)).ok().map(|seen| u32::from(seen.depth)))
                .sum()
        };
        for pair in order(&target.calls).windows(2) {
            let (Some(a), Some(b)) = (sum(pair[0]), sum(pair[1])) else { continue };
            compared += 1;
            // Faces whose mean depths are the same step keep the order in which they were added.
            assert!(a + 3 >= b, "face {} at {a}/3 before face {} at {b}/3", pair[0], pair[1]);
            assert!(a != b || pair[0] < pair[1]);
        }
    }
    assert!(compared > 3000, "{compared}");
}

#[test]
fn the_painter_has_its_documented_size() {
    use core::mem::size_of;
    // 8 bytes for a vertex; 10 bytes and a color for a face.
    assert_eq!(size_of::<pinhole::ScreenVertex>(), 8);
    let empty = size_of::<Painter<Shader, 0, 0>>();
    assert_eq!(size_of::<Painter<Shader, 100, 0>>() - empty, 800);
    assert!(size_of::<Painter<Shader, 0, 100>>() - empty <= 1200);
}

#[test]
fn a_painter_holds_as_many_faces_as_its_index_can_name() {
    // The storage is larger than indices reach: 65536 corners and 65535 faces are the end.
    let big = || {
        let camera = camera();
        let model = ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library();
        let mut vertices = vec![VERTICES[0]; 65_533];
        vertices.extend(VERTICES);
        let last = [65_533u16, 65_534, 65_535];
        let faces = vec![last; 65_535];
        let whole = Mesh::new(&vertices, 0, &faces).expect("a mesh");
        let none = Mesh::new(&vertices[..1], 0, &[]).expect("a mesh");
        let mut painter = Painter::<Shader, 65_600, 65_600>::new();
        let mut shaded = 0u16;
        painter
            .add(&camera.place(&whole, &model), |_| {
                shaded = shaded.wrapping_add(1);
                Shader(shaded)
            })
            .expect("65536 corners and 65535 faces");
        assert!(matches!(
            painter.add(&camera.place(&none, &model), |_| Shader(0)),
            Err(PainterError::Vertices { needed: 65_537, .. })
        ));
        let mut target = Recorder::new(bridge::rectangle(8, 8, 1, 1));
        assert_eq!(painter.draw(&mut target).expect("no error").drawn, 65_535);
        // All depths are equal: the order in which the faces were added.
        let wanted: Vec<_> = (1..=65_535).collect();
        assert_eq!(order(&target.calls), wanted);
        // The last face that fits, and one too many, with few corners: 6 · 10922 + 3 = 65535.
        let many = Mesh::new(&VERTICES, 0, &FACES_10922).expect("a mesh");
        let one = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
        for mesh in [&many, &many, &many, &many, &many, &many, &one, &one, &one] {
            painter.add(&camera.place(mesh, &model), |_| Shader(0)).expect("enough room");
        }
        assert!(matches!(
            painter.add(&camera.place(&one, &model), |_| Shader(0)),
            Err(PainterError::Faces { needed: 65_536, .. })
        ));
        let mut target = Recorder::new(bridge::rectangle(8, 8, 1, 1));
        assert_eq!(painter.draw(&mut target).expect("no error").drawn, 65_535);
    };
    std::thread::Builder::new().stack_size(64 << 20).spawn(big).expect("a thread").join().expect("no panic");
}

static FACES_10922: [[u16; 3]; 10_922] = [[0, 1, 2]; 10_922];
