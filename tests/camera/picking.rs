//! Picking: `unproject(project(p))` returns p within the change that half a sub-pixel and half a step of depth explain, the
//! ray through a pixel meets the point visible there, and each reason to be hidden is reported. That `project` agrees with
//! f64 for every projection is tested in `vertex_chain.rs`.

use embedded_graphics::geometry::Point;
use pinhole::raster::ScreenPoint;
use pinhole::{
    camera::{CameraError, Projected, Rotation},
    prelude::*,
};
use support::bridge::pair::{bits, random_view, ProjectionBits, ONE};
use support::bridge::{point, reals, vector, viewport};
use support::definition::{Picture, Projectors};
use support::oracle::chain::{self, length, V3};
use support::oracle::rng::Rng;

const SIZE: f64 = 400.0;

fn camera(view: ViewTransform, family: &ProjectionBits) -> Camera {
    let viewport = viewport(0, 0, 400, 400);
    // Some pictures are turned: the bounds hold for each rotation.
    let viewport = match family {
        ProjectionBits::Frustum(..) => viewport.rotated(Rotation::Deg90),
        ProjectionBits::Oblique(..) => viewport.rotated(Rotation::Deg180),
        ProjectionBits::Reference(..) => viewport.rotated(Rotation::Deg270),
        _ => viewport,
    };
    Camera::new(&view, &family.library().expect("a projection"), &viewport)
}

/// A family member of each kind, about a scene of this size.
fn random_family(rng: &mut Rng, size: f64) -> Option<ProjectionBits> {
    let f = |v: f64| chain::to_fx(v);
    let w = size * rng.log(0.3, 3.0);
    let (x, y) = (w * rng.real(-0.5, 0.5), w * rng.real(-0.5, 0.5));
    let window = [f(x - w / 2.0)?, f(x + w / 2.0)?, f(y - w / 2.0)?, f(y + w / 2.0)?];
    let (near, far) = (f(size)?, f(size * rng.log(1.5, 50.0))?);
    let prp = bits([w * rng.real(-1.0, 1.0), w * rng.real(-1.0, 1.0), size])?;
    Some(match rng.below(7) {
        0 => ProjectionBits::Perspective(rng.int(1 << 26, 3 << 29) as u32, (400, 400), near, far),
        1 => ProjectionBits::Frustum(window, near, far),
        2 => ProjectionBits::Orthographic(window, near, far),
        3 => ProjectionBits::Oblique(window, near, far, rng.bits(), ONE / 2),
        4 => ProjectionBits::Reference(prp, window, prp[2].checked_sub(near)?, prp[2].checked_sub(far)?),
        5 => ProjectionBits::ReferenceParallel(prp, window, near, near.checked_sub(far)?),
        _ => ProjectionBits::OriginInPlane(-near, window, 0, far.checked_sub(near)?),
    })
}

/// How far a view point moves when its image moves by `px` pixels and its depth by `steps`.
fn sensitivity(picture: &Picture, at: V3, px: f64, steps: f64) -> f64 {
    let (l, r) = (picture.window[0], picture.window[1]);
    let w = picture.distance(at[2]) / picture.distance(picture.plane);
    let across = px * (r - l) / SIZE * w.abs();
    // d depth/d n by the definition.
    let h = 1e-6 * picture.distance(at[2]).max(1e-3);
    let slope =
        (picture.depth([at[0], at[1], at[2] - h]) - picture.depth([at[0], at[1], at[2] + h])) / (2.0 * h);
    let along = steps / slope;
    // Along the projector.
    let slant = match picture.projectors {
        Projectors::From(c) => length(core::array::from_fn(|i| at[i] - c[i])) / (c[2] - at[2]),
        Projectors::Along(d) => length(d) / d[2].abs(),
    };
    across * 2f64.sqrt() + along * slant
}

#[test]
fn unproject_gives_the_projected_point_back() {
    let mut rng = Rng::new(0x61);
    let (mut compared, mut worst) = (0, 0f64);
    while compared < 60_000 {
        let size = rng.log(0.25, 600.0);
        let Some(family) = random_family(&mut rng, size) else { continue };
        let view_bits = random_view(&mut rng);
        let view = view_bits.exact();
        let picture = family.picture();
        let n = picture.front + (picture.back - picture.front) * rng.real(0.001, 0.999);
        let at = picture.back_to([rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)], n);
        let Some(world) = bits(view.back(at)) else { continue };
        let at = view.apply(chain::fx3(world));
        let camera = camera(view_bits.library().expect("a view"), &family);
        let Ok(projected) = camera.project(point(world)) else {
            panic!("hidden: {view_bits:?} {family:?} {world:?}");
        };
        let Projected { point: screen, depth } = projected;
        // A label goes into the pixel that contains the point.
        assert_eq!(
            Point::from(projected),
            Point::new(screen.x().div_euclid(256), screen.y().div_euclid(256))
        );
        if depth == 65_534 {
            continue; // clamped
        }
        compared += 1;
        let back = camera.unproject(screen, depth).expect("inside the world");
        let gap = length(core::array::from_fn(|i| reals(back)[i] - chain::fx(world[i])));
        // Half a sub-pixel and half a step, what `project` itself may add to each (1/256 px and one
        // step in all), and 2⁻¹⁷ a coordinate.
        let allowed =
            sensitivity(&picture, at, 1.0 / 256.0, 1.0) + 2f64.sqrt().max(3f64.sqrt()) * 2f64.powi(-17) * 1.1;
        worst = worst.max(gap / allowed);
        assert!(
            gap <= allowed,
            "{gap} for {allowed}: {view_bits:?} {family:?} {world:?} {screen:?} {depth} {back:?}"
        );
    }
    println!("{compared} points: at most {worst:.3} of what is allowed");
}

#[test]
fn project_reports_why_a_point_is_hidden() {
    let view =
        ViewTransform::look_at(point([0, 0, 5 * ONE]), point([0; 3]), vector([0, ONE, 0])).expect("a view");
    let family = ProjectionBits::Perspective(1 << 30, (400, 400), ONE, 10 * ONE);
    let plain = camera(view, &family);
    let far = plain.with_far_clip(true);
    let at = |x: i32, y: i32, z: i32| point([x, y, z]);
    // Near is at z = 4: exactly on it is seen, one step before it is not.
    assert!(plain.project(at(0, 0, 4 * ONE)).is_ok_and(|seen| seen.depth == 0));
    assert_eq!(plain.project(at(0, 0, 4 * ONE + 1)), Err(CameraError::BeforeNear));
    assert_eq!(plain.project(at(0, 0, 5 * ONE)), Err(CameraError::BeforeNear));
    assert_eq!(plain.project(at(0, 0, 9 * ONE)), Err(CameraError::BeforeNear));
    // Far is at z = −5, to the rounding of the projection's coefficients.
    assert!(far.project(at(0, 0, -5 * ONE + 1)).is_ok());
    assert_eq!(far.project(at(0, 0, -5 * ONE - 1)), Err(CameraError::BeyondFar));
    assert!(plain.project(at(0, 0, -6 * ONE)).is_ok_and(|seen| seen.depth == 65_534));
    // 200 px a unit at distance 1: the guard band is 8192 px from the origin, the centre at 200.
    let edge = |px: f64| ((px - 200.0) / 200.0 * 65536.0) as i32;
    assert!(plain.project(at(edge(8191.9), 0, 4 * ONE)).is_ok());
    assert_eq!(plain.project(at(edge(8192.2), 0, 4 * ONE)), Err(CameraError::OutsideGuardBand));
    assert_eq!(plain.project(at(0, edge(8593.0), 4 * ONE)), Err(CameraError::OutsideGuardBand));
    let mesh = Mesh::new(&[[0, 0, 0]], 0, &[]).expect("a mesh");
    assert_eq!(plain.place(&mesh, &Affine::identity()).project(1), Err(CameraError::NoVertex));
    // A point outside the viewport has screen coordinates too.
    let p = plain.project(at(-2 * ONE, 0, 4 * ONE)).expect("a place").point;
    assert_eq!((p.x(), p.y()), (-200 * 256, 200 * 256));
    // The reasons differ in words.
    let words = [CameraError::BeforeNear, CameraError::BeyondFar, CameraError::OutsideGuardBand]
        .map(|h| h.to_string());
    assert!(words[0] != words[1] && words[1] != words[2]);
}

#[test]
fn unprojecting_beyond_the_number_range_returns_none() {
    // Orthographic, a window wider than the world: its corners lie outside.
    let view = ViewTransform::look_at(
        point([30_000 * ONE, 0, 0]),
        point([30_000 * ONE, 0, -ONE]),
        vector([0, ONE, 0]),
    );
    let family = ProjectionBits::Orthographic([-10_000 * ONE, 10_000 * ONE, -ONE, ONE], 0, ONE);
    let camera = camera(view.expect("a view"), &family);
    let at = |x: i32| ScreenPoint::from_subpixels(x * 256, 200 * 256).expect("inside");
    assert!(camera.unproject(at(200), 0).is_some());
    assert_eq!(camera.unproject(at(400), 0), None);
}

/// The planes through a pixel far beside a viewport of one pixel have coefficients beyond 2²², the largest that there are.
#[test]
fn unproject_gives_back_a_point_far_beside_a_tiny_viewport() {
    let lens = Projection::from_matrix(&[
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, -1.0],
        [0.0, 0.0, -1.0, 1.0],
    ]);
    let view = ViewTransform::look_at(point([0; 3]), point([0, 0, -ONE]), vector([0, ONE, 0]));
    let camera = Camera::new(&view.expect("a view"), &lens.expect("a projection"), &viewport(0, 0, 1, 1));
    let world = [20_000 * ONE, -9000 * ONE, -ONE / 2];
    let Projected { point: screen, depth } = camera.project(point(world)).expect("in the guard band");
    let back = reals(camera.unproject(screen, depth).expect("inside the world"));
    // w = 3/2: half a sub-pixel is 3/512 units wide there, half a step of depth 2⁻¹⁷ · w² units deep, and x = 13 333 w.
    for (i, allowed) in [(0, 0.5), (1, 0.25), (2, 2f64.powi(-15))] {
        assert!((back[i] - chain::fx(world[i])).abs() <= allowed, "{back:?} {screen:?} {depth}");
    }
}

/// The near plane cuts at its distance for any near and far: to 2⁻²⁸ of far's distance and 2⁻¹⁵
/// (depth in a parallel projection resolves 2⁻³⁰ of its range).
#[test]
fn near_cuts_at_its_distance_for_any_near_and_far() {
    let mut rng = Rng::new(0x62);
    let mut exactly = [0; 2];
    for _ in 0..20_000 {
        let near = rng.log(0.01, 1000.0);
        let Some(n) = chain::to_fx(near) else { continue };
        let Some(f) = chain::to_fx(near * rng.log(1.01, 1000.0) + 0.01) else { continue };
        let w = [-n, n, -n, n];
        let prp = [0, 0, n];
        for family in [
            ProjectionBits::Perspective(1 << 29, (400, 400), n, f),
            ProjectionBits::Frustum(w, n, f),
            ProjectionBits::Orthographic(w, n, f),
            ProjectionBits::Oblique(w, n, f, rng.bits(), ONE / 2),
            ProjectionBits::Reference(prp, w, 0, n.saturating_sub(f)),
            ProjectionBits::ReferenceParallel(prp, w, -n, -f),
            ProjectionBits::EyeAtOrigin(-n, w, n, f),
        ] {
            let eye = [0; 3].map(|_| rng.int(-10_000 << 16, 10_000 << 16) as i32);
            let view = ViewTransform::from_reference(point(eye), vector([0, 0, ONE]), vector([0, ONE, 0]))
                .expect("a view");
            let at = if matches!(family, ProjectionBits::Reference(..)) { 0 } else { n };
            let camera = camera(view, &family);
            let found = |beyond: i32| camera.project(point([eye[0], eye[1], eye[2] - at - beyond]));
            assert!(found(2 + (f >> 28)).is_ok(), "{family:?} {eye:?}");
            assert_eq!(found(-2 - (f >> 28)), Err(CameraError::BeforeNear), "{family:?} {eye:?}");
            exactly[usize::from(found(0).is_ok())] += 1;
        }
    }
    println!("exactly on near: {} seen, {} not", exactly[1], exactly[0]);
}

/// In a mirror image, the planes through a pixel meet in the opposite order.
#[test]
fn unproject_gives_back_a_point_of_a_mirror_image() {
    let viewport = viewport(0, 0, 400, 400);
    let view = ViewTransform::look_at(point([0; 3]), point([0, 0, -ONE]), vector([0, ONE, 0]));
    let world = [ONE / 4, ONE / 3, -2 * ONE];
    for side in [1.0, -1.0] {
        let lens = Projection::from_matrix(&[
            [side, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, -1.0],
            [0.0, 0.0, -1.0, 1.0],
        ]);
        let camera = Camera::new(&view.expect("a view"), &lens.expect("a projection"), &viewport);
        let seen = camera.project(point(world)).expect("in sight");
        let back = reals(camera.unproject(seen.point, seen.depth).expect("inside the world"));
        // Half a sub-pixel is 3/51200 units wide there, and half a step of depth 1/16384 deep.
        assert!(length(core::array::from_fn(|i| back[i] - chain::fx(world[i]))) < 2e-4, "{back:?}");
    }
}
