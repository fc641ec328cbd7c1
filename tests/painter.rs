//! Painter's order: from far to near, equal ones in the order recorded.

mod bridge;
mod oracle;

use bridge::draw::Ink;
use bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use oracle::rng::Rng;
use oracle::target::{Call, Recorder};
use pinhole::{Mesh, Painter, RecordError};

/// 1 … 1000 along −z.
fn camera() -> pinhole::Camera {
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (1, 1), ONE, 1000 * ONE),
        viewport: (0, 0, 16, 16),
    }
    .library()
}

/// Square to the axis, over the whole picture at any distance up to 100.
const VERTICES: [[i16; 3]; 3] = [[-600, -300, 0], [600, -300, 0], [0, 600, 0]];
const FACE: [[u16; 3]; 1] = [[0, 1, 2]];

/// The order in which colours first appear.
fn order(calls: &[Call<Ink>]) -> Vec<u16> {
    let mut order = Vec::new();
    for call in calls {
        if let Call::Solid(_, Ink(colour)) = call {
            if order.last() != Some(colour) {
                order.push(*colour);
            }
        }
    }
    order
}

fn paint(depths: &[i32]) -> Vec<u16> {
    let (camera, mesh) = (camera(), Mesh::new(&VERTICES, 0, &FACE).expect("a mesh"));
    let mut painter = Painter::<Ink, 300, 100>::new();
    for (i, &z) in depths.iter().enumerate() {
        let model = ModelBits(vec![Step::Move([0, 0, -z])]).library();
        painter.add(&camera.place(&mesh, &model), |_| Ink(i as u16)).expect("enough room");
    }
    let mut target = Recorder::sized(16, 16);
    let statistics = painter.draw(&mut target).expect("no error");
    assert_eq!(statistics.drawn as usize, depths.len());
    order(&target.calls)
}

#[test]
fn far_to_near() {
    assert_eq!(paint(&[2 * ONE, 9 * ONE, 5 * ONE, 100 * ONE]), [3, 1, 2, 0]);
}

#[test]
fn equal_ones_in_the_order_recorded() {
    let z = 7 * ONE;
    assert_eq!(paint(&[z; 20]), (0..20).collect::<Vec<u16>>());
    assert_eq!(paint(&[z, 3 * z, z, 3 * z, z]), [1, 3, 0, 2, 4]);
}

#[test]
fn any_number_in_any_order() {
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
    let mut painter = Painter::<Ink, 18, 6>::new();
    let model = ModelBits::default().library();
    painter.add(&camera().place(&mesh, &model), |face| Ink(face as u16)).expect("exactly enough room");
    let mut target = Recorder::sized(16, 16);
    painter.draw(&mut target).expect("no error");
    assert_eq!(order(&target.calls), [2, 4, 0, 1, 5, 3]);
    // The nearest one is what remains.
    assert!(target.pixels.values().all(|&(c, n)| (c, n) == (Ink(3), 6)));
}

#[test]
fn full_says_what_to_raise_and_to_how_much() {
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let (camera, model) = (camera(), ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library());
    let placed = camera.place(&mesh, &model);
    let mut painter = Painter::<Ink, 7, 9>::new();
    for _ in 0..2 {
        painter.add(&placed, |_| Ink(0)).expect("enough room");
    }
    assert!(matches!(painter.add(&placed, |_| Ink(0)), Err(RecordError::Corners { needed: 9, capacity: 7 })));
    let mut painter = Painter::<Ink, 9, 2>::new();
    for _ in 0..2 {
        painter.add(&placed, |_| Ink(0)).expect("enough room");
    }
    assert!(matches!(painter.add(&placed, |_| Ink(1)), Err(RecordError::Faces { needed: 3, capacity: 2 })));
    // What was recorded before is drawn.
    let mut target = Recorder::sized(16, 16);
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 2);
    assert!(target.pixels.values().all(|&(c, n)| (c, n) == (Ink(0), 2)));
    // And with exactly that much it fits.
    let mut painter = Painter::<Ink, 9, 3>::new();
    for _ in 0..3 {
        painter.add(&placed, |_| Ink(0)).expect("enough room");
    }
}

#[test]
fn nothing_recorded_draws_nothing() {
    let mut target = Recorder::sized(16, 16);
    let mut painter = Painter::<Ink, 4, 4>::new();
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 0);
    assert!(target.calls.is_empty());
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let model = ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library();
    painter.add(&camera().place(&mesh, &model), |_| Ink(0)).expect("enough room");
    painter.clear();
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 0);
    assert!(target.calls.is_empty());
}
