//! R8 for clipped faces: faces cut at the near plane and at the guard band are as watertight as others. From inside a closed mesh every
//! pixel is drawn exactly once. That it is drawn by the right face is in `fuzz/targets/scene/cut.rs`.

use pinhole::prelude::*;
use std::collections::BTreeMap;
use support::bridge::draw::{solid, Shader};
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::coverage::Area;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

/// A box of n × n squares a side, its faces seen from inside, no T-junctions: the vertices are
/// jittered along the walls.
fn room(rng: &mut Rng, n: i64, size: i64) -> (Vec<[i16; 3]>, Vec<[u16; 3]>) {
    let mut index: BTreeMap<[i64; 3], u16> = BTreeMap::new();
    let mut vertices: Vec<[i16; 3]> = Vec::new();
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [0, n] {
            for i in 0..n {
                for j in 0..n {
                    let mut corner = |i: i64, j: i64| {
                        let mut key = [0; 3];
                        (key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3]) = (side, i, j);
                        *index.entry(key).or_insert_with(|| {
                            let jitter = (2 * size / n / 4).max(1);
                            vertices.push(key.map(|k| {
                                let inner = k > 0 && k < n;
                                let at = -size + 2 * size * k / n;
                                (at + if inner { rng.int(-jitter, jitter) } else { 0 }) as i16
                            }));
                            (vertices.len() - 1) as u16
                        })
                    };
                    let [a, b, c, d] =
                        [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                    // (axis, next, next) is right-handed: a b c d turns towards +axis.
                    let quad = if side == 0 { [a, b, c, d] } else { [a, d, c, b] };
                    let [a, b, c, d] = quad;
                    if rng.one_in(2) {
                        faces.extend([[a, b, c], [a, c, d]]);
                    } else {
                        faces.extend([[a, b, d], [b, c, d]]);
                    }
                }
            }
        }
    }
    (vertices, faces)
}

/// Every pixel is drawn exactly once, in mesh order and in painter's order.
fn once(camera: &CameraBits, model: &ModelBits, vertices: &[[i16; 3]], exponent: i8, faces: &[[u16; 3]]) {
    let (_, _, width, height) = camera.viewport;
    let mesh = Mesh::new(vertices, exponent, faces).expect("a mesh");
    let (library, model_library) = (camera.library(), model.library());
    let instance = library.place(&mesh, &model_library);
    let mut target = Recorder::sized(width, height);
    let statistics = solid(&instance, &mut target).expect("no error");
    for (x, y) in Area::new(0, 0, width.into(), height.into()).pixels() {
        assert_eq!(
            target.count(x as i32, y as i32),
            1,
            "({x}, {y}): {camera:?} {model:?} {vertices:?}·2^{exponent} {faces:?} {statistics:?}\n{}",
            target.picture(width as i32, height as i32, |Shader(f)| char::from(b'a' + (f % 26) as u8))
        );
    }
    let mut painter = Painter::<Shader, 800, 800>::new();
    instance.faces(|face| Shader(face as u16)).sorted(&mut painter).expect("enough room");
    let mut painted = Recorder::sized(width, height);
    assert_eq!(painter.draw(&mut painted), Ok(statistics));
    assert!(painted.pixels == target.pixels, "the painter draws another picture");
    // All faces face the eye: culling removes none.
    let mut both = Recorder::sized(width, height);
    solid(&instance.with_cull(Cull::None), &mut both).expect("no error");
    assert!(
        both.pixels == target.pixels,
        "faces turned over: {camera:?} {model:?} {vertices:?}·2^{exponent}"
    );
}

fn inside(seed: u64, count: usize, squares: i64, fov: (f64, f64), sizes: (f64, f64)) {
    let mut rng = Rng::new(seed);
    let mut done = 0;
    while done < count {
        let size = rng.log(sizes.0, sizes.1);
        // The mesh in i16 with an exponent that makes the size.
        let exponent = (size / 32767.0).log2().ceil() as i8 + rng.int(0, 6) as i8;
        let units = (size / f64::from(exponent).exp2()).round() as i64;
        if !(squares * 8..=32767).contains(&units) || exponent > 0 {
            continue;
        }
        let size = units as f64 * f64::from(exponent).exp2();
        let (vertices, faces) = room(&mut rng, squares, units);
        // The eye at least 0.75 away from the walls; the near window stays within that.
        let free = size - 0.75;
        let at =
            [0; 3].map(|_| free * [rng.real(-1.0, 1.0), rng.real(-0.3, 0.3), 1.0, -1.0, 0.0][rng.below(5)]);
        let offset = [[0.0; 3], [20_000.0, -19_500.0, 20_300.0]][rng.below(2)];
        if offset[0] != 0.0 && size > 8000.0 {
            continue;
        }
        let eye = bits(core::array::from_fn(|i| at[i] + offset[i])).expect("in range");
        let gaze = bits(rng.direction().map(|c| 100.0 * c)).expect("in range");
        let turn = 2f64.powi(32) / 360.0;
        let camera = CameraBits {
            view: ViewBits::LookAlong(eye, gaze, [0, ONE, 3]),
            projection: ProjectionBits::Perspective(
                (rng.log(fov.0, fov.1) * turn) as u32,
                (4, 3),
                ONE / 4,
                32767 * ONE,
            ),
            viewport: (0, 0, 32, 24),
        };
        // A cube turned about its centre still holds an eye near it.
        let mut model = ModelBits::default();
        if at.iter().all(|c| c.abs() < 0.3 * size) {
            model = ModelBits::random_rotation(&mut rng);
        }
        model.0.push(Step::Move(bits(offset).expect("in range")));
        once(&camera, &model, &vertices, exponent, &faces);
        done += 1;
    }
}

#[test]
fn rooms_seen_from_inside_cover_every_pixel_once() {
    // Squares a side, the range of the field of view in degrees, and that of the size.
    inside(0xB1, 1500, 1, (20.0, 100.0), (1.0, 30_000.0));
    inside(0xB2, 1000, 1, (0.2, 20.0), (1.0, 30_000.0));
    inside(0xB3, 600, 3, (20.0, 100.0), (1.0, 1000.0));
    inside(0xB4, 150, 7, (20.0, 100.0), (1.0, 1000.0));
    inside(0xB5, 500, 3, (0.2, 20.0), (1.0, 1000.0));
}
