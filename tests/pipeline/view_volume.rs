//! docs/spec.md, section 5: what is counted as clipped, and the visibility of bounding spheres. `src/clip.rs` tests clipped lines and triangles.

use pinhole::{camera::Visibility, math::Sphere, prelude::*};
use support::bridge;
use support::bridge::draw::Shader;
use support::bridge::pair::{bits, random_view, CameraBits, ModelBits, ProjectionBits, Step, ONE};
use support::bridge::{point, scalar};
use support::oracle::chain::{self, V4};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

#[test]
fn clipped_counts_what_was_cut_and_nothing_else() {
    // 90°, 15 px of focal length: a corner at x, z = −3 lies at 20 + 5·x px; the guard band ends at
    // ±8192.
    let camera = CameraBits::perspective(1 << 30, (40, 30), ONE, 100 * ONE).library();
    let model = ModelBits::default().library();
    for (x, clipped) in [(1i16, 0), (300, 0), (810, 0), (1000, 0), (1600, 0), (1634, 0), (1635, 1), (9000, 1)]
    {
        let vertices = [[0, 0, -3], [x, -1, -3], [0, 2, -3]];
        let mesh =
            Mesh::new(&vertices, 0, &[[0, 1, 2]]).and_then(|m| m.with_edges(&[[0, 1]])).expect("a mesh");
        let instance = camera.place(&mesh, &model);
        assert_eq!(instance.project(1).is_err(), clipped == 1, "{x}");
        let mut target = Recorder::sized(40, 30);
        let faces = instance.faces(|_| Shader(0)).draw(&mut target).expect("no error");
        let edges = instance.edges(|_| Shader(0)).draw(&mut target).expect("no error");
        assert_eq!((faces.drawn, faces.clipped), (1, clipped), "a face with a corner at {x}");
        assert_eq!((edges.drawn, edges.clipped), (1, clipped), "an edge with an end at {x}");
    }
}

/// How often each answer was returned.
#[derive(Debug, Default)]
struct Tally {
    outside: usize,
    partly: usize,
    inside: usize,
}

impl Tally {
    fn count(&mut self, found: Visibility) {
        *match found {
            Visibility::Outside => &mut self.outside,
            Visibility::Partly => &mut self.partly,
            Visibility::Inside => &mut self.inside,
        } += 1;
    }

    fn assert_each_above(&self, least: usize) {
        assert!([self.outside, self.partly, self.inside].iter().all(|&n| n > least), "{self:?}");
    }
}

/// A node's sphere is never `Outside` with a vertex inside the volume, never `Inside` with one outside. The faces of a node that is
/// `Inside` are not clipped, and those of a node that is `Outside` draw nothing. Returns the answer.
fn classified(camera: &CameraBits, model: &ModelBits, vertices: &[[i16; 3]], exponent: i8) -> Visibility {
    let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let mesh = Mesh::new(vertices, exponent, &faces).expect("a mesh");
    let (library, placed) = (camera.library().with_far_clip(true), model.library());
    let sphere = mesh.bounding_sphere();
    let found = library.frustum().visibility(&sphere, &placed);
    // One frustum for many objects gives the camera's answer for each.
    assert_eq!(library.frustum().visibility(&sphere, &placed), found, "{camera:?} {model:?}");
    // The largest radius stands for no bound, also where a model makes it small.
    let boundless = Sphere { radius: scalar(i32::MAX), ..sphere };
    let shrunk = ModelBits([vec![Step::Scale([1; 3])], model.0.clone()].concat()).library();
    for placed in [&placed, &shrunk] {
        assert_eq!(
            library.frustum().visibility(&boundless, placed),
            Visibility::Partly,
            "{camera:?} {model:?}"
        );
    }
    let (exact, exact_model) = (camera.exact(), model.exact());
    let margin = |&v: &[i16; 3]| {
        let clip = exact.clip(&exact_model, chain::vertex(v, exponent));
        let [x, y, z, w] = clip;
        let least = [w + x, w - x, w + y, w - y, w + z, w - z].into_iter().fold(f64::INFINITY, f64::min);
        least / w.abs().max(1.0)
    };
    let draw = || {
        let mut target = Recorder::<Shader>::sized(320, 200);
        let instance = library.place(&mesh, &placed).with_cull(Cull::None);
        (instance.faces(|_| Shader(1)).draw(&mut target).expect("no error"), target.pixels.is_empty())
    };
    match found {
        Visibility::Outside => {
            assert!(vertices.iter().all(|v| margin(v) < 1e-6), "{camera:?} {model:?}");
            assert!(draw().1, "{camera:?} {model:?}");
        }
        Visibility::Inside => {
            assert!(vertices.iter().all(|v| margin(v) > -1e-6), "{camera:?} {model:?}");
            let (drawn, _) = draw();
            assert_eq!((drawn.clipped, drawn.outside), (0, 0), "{camera:?} {model:?}");
        }
        Visibility::Partly => {}
    }
    found
}

/// A tetrahedron of up to 1000 units.
fn vertices(rng: &mut Rng) -> [[i16; 3]; 4] {
    [0; 4].map(|_| [0; 3].map(|_| rng.int(-1000, 1000) as i16))
}

/// `Partly` is returned only where the exact sphere comes near to a plane's border.
#[test]
fn s5_bounding_spheres_are_classified_as_their_vertices() {
    assert_eq!(size_of::<pinhole::camera::Frustum>(), 264, "its documentation says so");
    let mut rng = Rng::new(0x506);
    let mut tally = Tally::default();
    for _ in 0..30_000 {
        let distance = rng.log(1.0, 300.0);
        let (near, far) = (ONE, 400 * ONE);
        let w = [-ONE, ONE / 2 + rng.int(0, i64::from(ONE)) as i32, -ONE, ONE];
        let projection = if rng.one_in(2) {
            ProjectionBits::Frustum(w, near, far)
        } else {
            ProjectionBits::Orthographic(w.map(|c| 50 * c), near, far)
        };
        let camera = CameraBits { view: random_view(&mut rng), projection, viewport: (0, 0, 320, 200) };
        let exact = camera.exact();
        // A mesh somewhere about the volume.
        let at =
            [distance * rng.real(-1.5, 1.5), distance * rng.real(-1.5, 1.5), -distance * rng.real(-0.3, 1.6)];
        let Some(world) = bits(exact.view.back(at)) else { continue };
        let exponent = (rng.log(0.01, distance) / 1000.0).log2().floor().clamp(-32.0, 0.0) as i8;
        let mut model = ModelBits::random_rotation(&mut rng);
        let is_rigid = !rng.one_in(3);
        if !is_rigid {
            model.0.push(Step::Scale([ONE / 2, ONE, 2 * ONE]));
        }
        model.0.push(Step::Move(world));
        let vertices = vertices(&mut rng);
        let found = classified(&camera, &model, &vertices, exponent);
        tally.count(found);
        // A rigid model: the exact sphere against the exact planes.
        if is_rigid {
            let sphere = Mesh::new(&vertices, exponent, &[]).expect("a mesh").bounding_sphere();
            let centre = exact.view.apply_placed(&model.exact(), bridge::reals(sphere.centre));
            let (radius, m) = (chain::fx(sphere.radius.to_bits()), exact.projection);
            let mut least = f64::INFINITY;
            for (row, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
                let [x, y, z, d]: V4 = core::array::from_fn(|k| m[3][k] + sign * m[row][k]);
                let n = [x, y, z];
                least = least.min((chain::dot(n, centre) + d) / chain::length(n) / radius);
            }
            let want = match least {
                ..-1.0 => Visibility::Outside,
                1.0.. => Visibility::Inside,
                _ => Visibility::Partly,
            };
            let margin = 1e-6 + 2e-6 * (distance / radius).max(1.0);
            let is_undecided = found == Visibility::Partly && (least.abs() - 1.0).abs() < margin;
            assert!(found == want || is_undecided, "{least}: {camera:?} {model:?}");
        }
    }
    tally.assert_each_above(1000);
}

/// At any ratio of far to near: at a large one the far plane depends on the last bits.
#[test]
fn s5_triangles_inside_the_volume_are_not_clipped() {
    let mut rng = Rng::new(0x508);
    let mut tally = Tally::default();
    for _ in 0..60_000 {
        let near = rng.log(1.0, 65_536.0 * 4.0) as i32;
        let far =
            (f64::from(near) * rng.log(1.001, 4e9)).clamp(f64::from(near) + 2.0, f64::from(i32::MAX)) as i32;
        let side = (f64::from(near) * rng.log(0.01, 4.0)).max(1.0) as i32;
        let camera = CameraBits {
            view: random_view(&mut rng),
            projection: ProjectionBits::Frustum([-side, side, -side, side], near, far),
            viewport: (0, 0, 320, 200),
        };
        // Next to near, next to far, and between.
        let [first, last] = [near, far].map(chain::fx);
        let size = rng.log(1e-5, 0.3) * last;
        let depth = match rng.below(5) {
            0 => first + size * rng.real(0.9, 1.9),
            1 => last - size * rng.real(0.9, 1.9),
            2 => first - size * rng.real(0.9, 1.9),
            3 => last + size * rng.real(0.9, 1.9),
            _ => rng.log(first, last),
        };
        let Some(world) = bits(camera.exact().view.back([0.0, 0.0, -depth])) else { continue };
        let exponent = (size / 1000.0).log2().floor().clamp(-32.0, 5.0) as i8;
        let mut model = ModelBits::random_rotation(&mut rng);
        model.0.push(Step::Move(world));
        tally.count(classified(&camera, &model, &vertices(&mut rng), exponent));
    }
    tally.assert_each_above(1000);
}

/// Points next to the borders of windows far off the axis, where coefficients are large: a point with a position in the
/// picture is not outside.
#[test]
fn s5_points_in_an_off_axis_picture_are_inside() {
    let mut rng = Rng::new(0x509);
    let (mut tally, mut shown) = (Tally::default(), 0);
    for _ in 0..200_000 {
        let near = rng.log(65_536.0, 65_536.0 * 16_000.0) as i32;
        let width = rng.log(16.0, f64::from(near)) as i32;
        let aside = (rng.log(1.0, 1e5) * f64::from(width)).min(2e9) as i32;
        let sides = [aside, aside.saturating_add(width)];
        let sides = if rng.below(2) == 0 { sides } else { [-sides[1], -sides[0]] };
        let camera = CameraBits {
            view: random_view(&mut rng),
            projection: ProjectionBits::Frustum(
                [sides[0], sides[1], -width / 2, width / 2 + 1],
                near,
                2 * near,
            ),
            viewport: (0, 0, 320, 200),
        };
        let depth = chain::fx(near) * rng.real(1.1, 1.9);
        // Next to the left border, or to the right one.
        let border = f64::from(sides[rng.below(2)]) / f64::from(near);
        let off = rng.log(1e-9, 0.1) * if rng.below(2) == 0 { 1.0 } else { -1.0 };
        let x = depth * (border + f64::from(width) / f64::from(near) * off);
        let Some(world) = bits(camera.exact().view.back([x, 0.0, -depth])) else { continue };
        let mut model = ModelBits::random_rotation(&mut rng);
        model.0.push(Step::Move(world));
        let mesh = Mesh::new(&[[1, 1, 1]], -20, &[]).expect("a mesh");
        let (library, model) = (camera.library(), model.library());
        let found = library.frustum().visibility(&mesh.bounding_sphere(), &model);
        tally.count(found);
        let Ok(pinhole::camera::Projected { point: at, .. }) = library.place(&mesh, &model).project(0) else {
            continue;
        };
        let inside = (1..320 * 256).contains(&at.x()) && (1..200 * 256).contains(&at.y());
        shown += u32::from(inside);
        assert!(!inside || found != Visibility::Outside, "{camera:?} {world:?}: {at:?}");
    }
    println!("{shown} {tally:?}");
    assert!(shown > 1000);
}

/// Points far out and close to a plane: the error of the plane's rounded coefficients grows with the distance.
#[test]
fn s5_outcodes_of_far_points_match_f64() {
    let mut rng = Rng::new(0x507);
    let mut tally = Tally::default();
    for _ in 0..60_000 {
        let w = [-ONE, ONE / 2 + rng.int(0, i64::from(ONE)) as i32, -ONE, ONE];
        let projection = ProjectionBits::Frustum(w, ONE, 30_000 * ONE);
        let camera = CameraBits { view: random_view(&mut rng), projection, viewport: (0, 0, 320, 200) };
        let exact = camera.exact();
        // Next to the plane through the right border, at distances from far below the error to above it.
        let z = rng.log(1_000.0, 20_000.0);
        let at =
            [chain::fx(w[1]) * z + rng.real(-1.0, 1.0) * rng.log(1e-4, 1.0), z * rng.real(-0.5, 0.5), -z];
        let Some(world) = bits(exact.view.back(at)) else { continue };
        let sphere = Sphere { centre: point(world), radius: scalar(0) };
        let (library, identity) = (camera.library(), ModelBits(Vec::new()).library());
        let found = library.frustum().visibility(&sphere, &identity);
        // A negative radius counts as 0.
        let negative = Sphere { radius: scalar(-rng.log(1.0, f64::from(i32::MAX)) as i32), ..sphere };
        assert_eq!(library.frustum().visibility(&negative, &identity), found, "{camera:?} {negative:?}");
        let at = exact.view.apply(chain::fx3(world));
        let m = exact.projection;
        let plane: V4 = core::array::from_fn(|k| m[3][k] - m[0][k]);
        let inside = chain::dot([plane[0], plane[1], plane[2]], at) + plane[3];
        match found {
            Visibility::Outside => assert!(inside < 1e-10, "{inside}: {camera:?} {world:?}"),
            Visibility::Inside => assert!(inside > -1e-10, "{inside}: {camera:?} {world:?}"),
            Visibility::Partly => {}
        }
        tally.count(found);
    }
    println!("{tally:?}");
    tally.assert_each_above(1000);
}
