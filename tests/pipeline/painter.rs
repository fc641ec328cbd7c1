//! Painter's order: from far to near, faces of equal depth in the order in which they were added. Translucent faces before and behind
//! opaque ones: far to near, depth tested and not stored.

use embedded_graphics::pixelcolor::{Gray8, GrayColor};
use embedded_graphics::prelude::PointsIter;
use pinhole::{
    color::{Alpha, Half},
    prelude::*,
    shading::{DepthTested, Translucent},
    target::BufferError,
};
use support::bridge;
use support::bridge::draw::{flat_camera, Shader};
use support::bridge::pair::{CameraBits, ModelBits, Step, ONE};
use support::bridge::ways::{bands, memory_with};
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder};

/// 1 … 1000 along −z.
fn camera() -> pinhole::Camera {
    CameraBits::perspective(1 << 30, (16, 16), ONE, 1000 * ONE).library()
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

/// Faces of random depths, added at once, and added with a drawing of those so far now and then: far to near, and faces of equal depth
/// in the order in which they were added.
#[test]
fn painter_sorts_any_number_of_faces() {
    let mut rng = Rng::new(0x9A);
    let (camera, mesh) = (camera(), Mesh::new(&VERTICES, 0, &FACE).expect("a mesh"));
    for round in 0..200 {
        let n: usize = [0, 1, 2, 3, 17, 64, 100][round % 7];
        // Depth steps of 65536 are coarse far away: keep to steps that differ or are equal.
        let depths: Vec<i32> = (0..n).map(|_| (ONE * 5 / 4) << rng.below(7)).collect();
        let mut painter = Painter::<Shader, 300, 100>::new();
        for count in 0..=n {
            if let Some(z) = count.checked_sub(1).map(|i| depths[i]) {
                let model = ModelBits(vec![Step::Move([0, 0, -z])]).library();
                let shader = Shader(count as u16 - 1);
                camera.place(&mesh, &model).faces(|_| shader).sorted(&mut painter).expect("enough room");
            }
            if rng.one_in(5) || count == n {
                let mut target = Recorder::sized(16, 16);
                let drawn = painter.order();
                drawn.draw(&mut target).expect("no error");
                let mut wanted: Vec<u16> = (0..count as u16).collect();
                wanted.sort_by_key(|&i| core::cmp::Reverse(depths[usize::from(i)]));
                assert_eq!((order(&target.calls), drawn.statistics().drawn as usize), (wanted, count));
            }
        }
    }
}

#[test]
fn a_full_painter_names_the_parameter_and_value_to_raise() {
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let (camera, model) = (camera(), ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library());
    let instance = camera.place(&mesh, &model);
    let mut painter = Painter::<Shader, 7, 9>::new();
    for _ in 0..2 {
        instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
    }
    assert!(matches!(
        instance.faces(|_| Shader(0)).sorted(&mut painter),
        Err(BufferError::Full { parameter: "VERTICES", needed: 9, capacity: 7 })
    ));
    let mut painter = Painter::<Shader, 9, 2>::new();
    for _ in 0..2 {
        instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
    }
    assert!(matches!(
        instance.faces(|_| Shader(1)).sorted(&mut painter),
        Err(BufferError::Full { parameter: "FACES", needed: 3, capacity: 2 })
    ));
    // The faces added before are drawn.
    let mut target = Recorder::sized(16, 16);
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 2);
    assert!(target.pixels.values().all(|&(c, n)| (c, n) == (Shader(0), 2)));
    // A mesh that did not fit leaves its room free, and the viewport open.
    let (empty, other) = (Mesh::new(&[[0; 3]; 8], 0, &[]), bridge::draw::cube_camera((3, 4, 9, 9)).library());
    let mut painter = Painter::<Shader, 7, 9>::new();
    let large = empty.expect("a mesh");
    let full = Err(BufferError::Full { parameter: "VERTICES", needed: 8, capacity: 7 });
    assert_eq!(other.place(&large, &model).faces(|_| Shader(0)).sorted(&mut painter), full);
    for added in 0..2 {
        instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
        let full = Err(BufferError::Full { parameter: "VERTICES", needed: 3 * added + 11, capacity: 7 });
        assert_eq!(camera.place(&large, &model).faces(|_| Shader(0)).sorted(&mut painter), full);
    }
    let mut target = Recorder::sized(16, 16);
    assert_eq!(painter.draw(&mut target).expect("no error").drawn, 2);
    // With exactly that capacity the mesh fits.
    let mut painter = Painter::<Shader, 9, 3>::new();
    for _ in 0..3 {
        instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
    }
}

/// A mesh without vertices leaves nothing behind, not even its viewport.
#[test]
fn an_empty_mesh_leaves_the_viewport_open() {
    let (empty, mesh) = (Mesh::new(&[], 0, &[]), Mesh::new(&VERTICES, 0, &FACE));
    let (empty, mesh) = (empty.expect("a mesh"), mesh.expect("a mesh"));
    let model = ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library();
    let other = bridge::draw::cube_camera((3, 4, 9, 9)).library();
    let mut painter = Painter::<Shader, 4, 4>::new();
    other.place(&empty, &model).faces(|_| Shader(0)).sorted(&mut painter).expect("no room needed");
    camera()
        .place(&mesh, &model)
        .faces(|_| Shader(7))
        .sorted(&mut painter)
        .expect("the first that draws anything");
    assert_eq!(
        other.place(&mesh, &model).faces(|_| Shader(0)).sorted(&mut painter),
        Err(BufferError::OtherViewport)
    );
    let mut target = Recorder::sized(16, 16);
    painter.draw(&mut target).expect("no error");
    assert_eq!(order(&target.calls), [7]);
}

#[test]
fn drawing_empties_the_painter_even_if_the_target_fails() {
    let mesh = Mesh::new(&VERTICES, 0, &FACE).expect("a mesh");
    let (camera, model) = (camera(), ModelBits(vec![Step::Move([0, 0, -5 * ONE])]).library());
    let instance = camera.place(&mesh, &model);
    let mut painter = Painter::<Shader, 3, 1>::new();
    for fails in [None, Some(0), Some(3)] {
        instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
        let mut target = Recorder::sized(16, 16);
        target.fails_at = fails;
        assert_eq!(painter.draw(&mut target).is_err(), fails.is_some());
        let mut target = Recorder::sized(16, 16);
        let statistics = painter.draw(&mut target).expect("no error");
        assert!(target.calls.is_empty());
        assert_eq!(statistics, pinhole::draw::Statistics::default());
    }
    instance.faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
    painter.clear();
    assert_eq!(painter.draw(&mut Recorder::sized(16, 16)), Ok(pinhole::draw::Statistics::default()));
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
        let instance = camera.place(&mesh, &model).with_cull(pinhole::draw::Cull::None);
        let mut painter = Painter::<Shader, 60, 20>::new();
        instance.faces(|face| Shader(face as u16)).sorted(&mut painter).expect("enough room");
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
    // 8 bytes for a vertex; 10 bytes and a colour for a face.
    assert_eq!(size_of::<pinhole::camera::ScreenVertex>(), 8);
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
        camera
            .place(&whole, &model)
            .faces(|_| {
                shaded = shaded.wrapping_add(1);
                Shader(shaded)
            })
            .sorted(&mut painter)
            .expect("65536 corners and 65535 faces");
        assert!(matches!(
            camera.place(&none, &model).faces(|_| Shader(0)).sorted(&mut painter),
            Err(BufferError::Full { parameter: "VERTICES", needed: 65_537, .. })
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
            camera.place(mesh, &model).faces(|_| Shader(0)).sorted(&mut painter).expect("enough room");
        }
        assert!(matches!(
            camera.place(&one, &model).faces(|_| Shader(0)).sorted(&mut painter),
            Err(BufferError::Full { parameter: "FACES", needed: 65_536, .. })
        ));
        let mut target = Recorder::new(bridge::rectangle(8, 8, 1, 1));
        assert_eq!(painter.draw(&mut target).expect("no error").drawn, 65_535);
    };
    std::thread::Builder::new().stack_size(64 << 20).spawn(big).expect("a thread").join().expect("no panic");
}

static FACES_10922: [[u16; 3]; 10_922] = [[0, 1, 2]; 10_922];

const SIDE: i32 = 24;
const SIZE: (u32, u32) = (SIDE as u32, SIDE as u32);

/// A rectangle of pixels in a plane `depth` before the far one.
#[derive(Clone, Copy)]
struct Pane {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
    height: i16,
    luma: u8,
}

impl Pane {
    fn random(rng: &mut Rng, height: i16) -> Self {
        let mut side = || {
            let (a, b) = (rng.int(-4, 27) as i32, rng.int(-4, 27) as i32);
            (a.min(b), a.max(b) + 1)
        };
        let ((left, right), (top, bottom)) = (side(), side());
        Self { left, top, right, bottom, height, luma: rng.int(0, 255) as u8 }
    }

    fn covers(&self, x: i32, y: i32) -> bool {
        (self.left..self.right).contains(&x) && (self.top..self.bottom).contains(&y)
    }

    /// 16 units to a pixel; y points up.
    fn corners(&self) -> [[i16; 3]; 4] {
        let [left, right] = [self.left, self.right].map(|x| (16 * x) as i16);
        let [top, bottom] = [self.top, self.bottom].map(|y| (16 * (SIDE - y)) as i16);
        let z = self.height;
        [[left, bottom, z], [right, bottom, z], [right, top, z], [left, top, z]]
    }
}

const QUAD: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// Far to near by definition, in integers: the mean of both lumas, rounded to the translucent one's half up.
fn expected(walls: &[Pane], panes: &[Pane], x: i32, y: i32) -> u8 {
    let wall = walls.iter().filter(|wall| wall.covers(x, y)).max_by_key(|wall| wall.height);
    let mut luma = wall.map_or(0, |wall| u32::from(wall.luma));
    let mut before: Vec<_> = panes
        .iter()
        .filter(|pane| pane.covers(x, y) && wall.is_none_or(|wall| pane.height > wall.height))
        .collect();
    before.sort_by_key(|pane| pane.height);
    for pane in before {
        luma = u32::from(pane.luma).div_ceil(2) + luma / 2;
    }
    luma as u8
}

#[test]
fn panes_are_mixed_from_far_to_near_where_no_wall_hides_them() {
    let area = bridge::rectangle(0, 0, SIZE.0, SIZE.1);
    let mut rng = Rng::new(0x7A4E);
    let (camera, mut hidden, mut stacked) = (flat_camera(SIZE, 16, 1000).library(), 0, 0);
    for _ in 0..60 {
        // Heights differ, so far to near is an order; they come shuffled.
        let mut heights: Vec<i16> = (0..9).map(|i| 40 * i - 160).collect();
        for i in (1..heights.len()).rev() {
            heights.swap(i, rng.below(i + 1));
        }
        let all: Vec<_> = heights.iter().map(|&height| Pane::random(&mut rng, height)).collect();
        let (walls, panes) = all.split_at(3);
        let corners: Vec<_> = all.iter().map(Pane::corners).collect();
        let meshes: Vec<_> = corners.iter().map(|c| Mesh::new(c, 0, &QUAD).expect("a quad")).collect();
        let place = |i: usize| camera.place(&meshes[i], &Affine::identity());
        let mut painter = Painter::<DepthTested<Translucent<Gray8, Half>>, 24, 12>::new();
        for (i, pane) in panes.iter().enumerate() {
            let shader = DepthTested::new(Translucent::new(Gray8::new(pane.luma), Half));
            place(i + 3).faces(|_| shader).sorted(&mut painter).expect("room");
        }

        // In bands, the depths of each from the walls.
        for rows in [1, 5, SIDE as u32] {
            let order = painter.order();
            let colors = bands(area, Gray8::BLACK, rows, &mut |band, depth| {
                for (i, wall) in walls.iter().enumerate() {
                    let color = |_| Gray8::new(wall.luma);
                    let Ok(_) = place(i).faces(color).draw(&mut band.pixels().depth_tested(depth));
                }
                let before = depth.values().to_vec();
                let Ok(()) = order.draw(&mut band.pixels().depth_tested(depth));
                assert!(depth.values() == before);
            });
            for (point, color) in area.points().zip(colors) {
                let (x, y) = (point.x, point.y);
                let exact = expected(walls, panes, x, y);
                assert_eq!(color.luma(), exact, "{point}, {rows} rows");
                let covered: Vec<_> = panes.iter().filter(|pane| pane.covers(x, y)).collect();
                stacked += u32::from(covered.len() > 2);
                hidden += u32::from(
                    covered
                        .iter()
                        .any(|pane| walls.iter().any(|wall| wall.covers(x, y) && wall.height > pane.height)),
                );
            }
        }
    }
    assert!(hidden > 10_000 && stacked > 10_000, "{hidden}, {stacked}");
}

/// Opaque faces, cut by the near and the far plane and by the borders: the depth buffer is the one that faces in mesh order give.
#[test]
fn opaque_faces_store_their_depth() {
    let area = bridge::rectangle(0, 0, SIZE.0, SIZE.1);
    let camera = flat_camera(SIZE, 16, 1000).library();
    let mut rng = Rng::new(0x51D);
    for _ in 0..40 {
        let mut corner =
            || [rng.int(-200, 600) as i16, rng.int(-200, 600) as i16, rng.int(-1500, 1500) as i16];
        let corners = [corner(), corner(), corner(), corner()];
        let mesh = Mesh::new(&corners, 0, &[[0, 1, 2], [0, 2, 1], [1, 2, 3], [2, 1, 3]]).expect("faces");
        let instance = camera.place(&mesh, &Affine::identity());
        let color = |face: usize| Gray8::new(60 * face as u8 + 60);
        let (_, depths) = memory_with(area, area, Gray8::BLACK, &mut |target, depth| {
            let Ok(_) = instance.faces(color).draw(&mut target.depth_tested(depth));
        });
        let (_, painted) = memory_with(area, area, Gray8::BLACK, &mut |target, depth| {
            let mut painter = Painter::<DepthTested<Gray8>, 50, 20>::new();
            instance.faces(|face| DepthTested::new(color(face))).sorted(&mut painter).expect("room");
            let Ok(_) = painter.draw(&mut target.depth_tested(depth));
        });
        assert!(depths == painted);
        // With translucent faces, no depth is stored.
        let (_, painted) = memory_with(area, area, Gray8::BLACK, &mut |target, depth| {
            let mut painter = Painter::<DepthTested<Translucent<Gray8, Alpha>>, 50, 20>::new();
            instance
                .faces(|face| DepthTested::new(Translucent::new(color(face), Alpha::new(7))))
                .sorted(&mut painter)
                .expect("room");
            let Ok(_) = painter.draw(&mut target.depth_tested(depth));
        });
        assert!(painted.iter().all(|&depth| depth == DepthBuffer::NOTHING));
    }
}
