//! docs/spec.md, section 5: outcodes, lines and triangles with attributes against an f64 clipper, equal cut points for both neighbors of an
//! edge, at most nine corners, and the visibility of bounding spheres.

use pinhole::clip::{self, ClipVertex};
use pinhole::space::View;
use pinhole::{ClipPoint, Cull, Mesh, Outcode, Projection, Sphere, Visibility};
use support::bridge;
use support::bridge::draw::Shader;
use support::bridge::pair::{bits, random_view, window, CameraBits, ModelBits, ProjectionBits, Step, ONE};
use support::bridge::{point, scalar};
use support::oracle::chain::{self, V4};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;
use support::oracle::volume::{self, distances, gap, largest};

fn projections() -> [Projection; 3] {
    let w = window([-ONE, ONE, -ONE, ONE]);
    [
        Projection::frustum(w, scalar(ONE), scalar(20 * ONE)).expect("a frustum"),
        Projection::orthographic(
            window([-5 * ONE, 5 * ONE, -5 * ONE, 5 * ONE]),
            scalar(ONE),
            scalar(20 * ONE),
        )
        .expect("a box"),
        Projection::frustum(window([-ONE / 8, ONE, -ONE, ONE / 4]), scalar(ONE / 4), scalar(1000 * ONE))
            .expect("a frustum"),
    ]
}

/// The exact value of a clip point.
fn real(p: &ClipPoint) -> V4 {
    let unit = f64::from(p.exponent()).exp2();
    p.xyzw().map(|c| f64::from(c) * unit)
}

fn random_point(rng: &mut Rng, projection: &Projection) -> ClipPoint {
    let reach = [3, 15, 60, 2000][rng.below(4)] * i64::from(ONE);
    let p = if rng.one_in(6) {
        // On planes and edges of the volumes.
        [rng.int(-5, 5), rng.int(-5, 5), -rng.int(-1, 21)].map(|c| c as i32 * ONE)
    } else {
        [rng.int(-reach, reach), rng.int(-reach, reach), rng.int(-2 * reach, reach / 4)].map(|c| c as i32)
    };
    projection.apply(point::<View>(p))
}

#[test]
fn s5_outcodes_are_the_six_inequalities() {
    let mut rng = Rng::new(0x501);
    let mut seen = std::collections::BTreeSet::new();
    for projection in projections() {
        for _ in 0..20_000 {
            let p = random_point(&mut rng, &projection);
            let code = p.outcode();
            // The integers are exact, so are their doubles.
            assert_eq!(code.bits(), chain::outcode(real(&p)), "{p:?}");
            seen.insert(code.bits());
        }
    }
    assert!(seen.len() > 30, "{seen:?}");
    assert_eq!(Outcode::LEFT.or(Outcode::NEAR).and(Outcode::NEAR), Outcode::NEAR);
    assert_eq!(Outcode::LEFT.and(Outcode::RIGHT), Outcode::INSIDE);
}

/// Whether the oracle leaves more of a line than one point.
fn inside(a: V4, b: V4) -> Option<(f64, f64)> {
    volume::inside(a, b, 0.0).filter(|(from, to)| from < to)
}

/// Each coordinate moved by 2⁻³⁰ of `size`, up or down by the bits of `k`.
fn nudged(p: V4, size: f64, k: usize) -> V4 {
    let step = size * 2f64.powi(-30);
    core::array::from_fn(|i| if k >> i & 1 == 0 { p[i] + step } else { p[i] - step })
}

#[test]
fn s5_clipped_lines_match_f64() {
    let mut rng = Rng::new(0x502);
    let (mut cut, mut gone, mut ill, mut worst) = (0, 0, 0, 0f64);
    for projection in projections() {
        for _ in 0..12_000 {
            let (a, b) = (random_point(&mut rng, &projection), random_point(&mut rng, &projection));
            let (ra, rb) = (real(&a), real(&b));
            let size = largest(ra).max(largest(rb));
            let got = clip::line(a, b);
            // The order of the ends changes nothing.
            assert_eq!(clip::line(b, a), got.map(|(p, q)| (q, p)));
            // The clipped part lies inside the volume, and clipping it again changes nothing.
            if let Some((p, q)) = got {
                assert_eq!((p.outcode(), q.outcode()), (Outcode::INSIDE, Outcode::INSIDE), "{a:?} {b:?}");
                let (r, s) = clip::line(p, q).expect("inside");
                assert_eq!((real(&r), real(&s)), (real(&p), real(&q)));
            }
            match (got, inside(ra, rb)) {
                (None, None) => gone += 1,
                (None, Some((s, t))) => {
                    assert!((t - s) * size < 4.0 * size * 2f64.powi(-28), "lost {s} … {t} of {a:?} {b:?}")
                }
                (Some((p, q)), None) => {
                    // It touches a corner or an edge within the rounding.
                    let length: f64 = (0..4).map(|i| (real(&p)[i] - real(&q)[i]).abs()).sum();
                    assert!(length < 16.0 * size * 2f64.powi(-28), "{a:?} {b:?}");
                }
                (Some((p, q)), Some((s, t))) => {
                    cut += usize::from(s > 0.0 || t < 1.0);
                    for (first, end, t) in [(true, p, s), (false, q, t)] {
                        let want: V4 = core::array::from_fn(|i| ra[i] + (rb[i] - ra[i]) * t);
                        let error = gap(real(&end), want) / size;
                        // Where an edge runs along a plane the cut is known less well: what moving the
                        // ends by 2⁻³⁰ does to it in f64.
                        let mut moved = 0f64;
                        for k in 0..256 {
                            let (a, b) = (nudged(ra, size, k), nudged(rb, size, k >> 4));
                            let there = inside(a, b).map_or(f64::INFINITY, |(from, to)| {
                                let t = if first { from } else { to };
                                gap(core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t), want) / size
                            });
                            moved = moved.max(there);
                        }
                        if moved > 2f64.powi(-28) {
                            ill += 1;
                            assert!(error <= 8.0 * moved, "2^{}: {a:?} {b:?}", error.log2());
                        } else {
                            worst = worst.max(error);
                        }
                    }
                }
            }
        }
    }
    println!(
        "{cut} cut ({ill} ends along a plane), {gone} gone; new ends within 2^{:.2} of the larger end",
        worst.log2()
    );
    assert!(cut > 10_000 && gone > 8_000);
    assert!(worst <= 2f64.powi(-27), "2^{}", worst.log2());
}

/// The part of a triangle in the volume, in f64, with attributes.
fn polygon(corners: [(V4, [f64; 2]); 3]) -> Vec<(V4, [f64; 2])> {
    let corners = corners.map(|([x, y, z, w], [a, b])| [x, y, z, w, a, b]);
    let cut =
        |all: Vec<[f64; 6]>, plane| chain::cut(&all, |&[x, y, z, w, ..]| distances([x, y, z, w])[plane]);
    let all = (0..6).fold(corners.to_vec(), cut);
    all.into_iter().map(|[x, y, z, w, a, b]| ([x, y, z, w], [a, b])).collect()
}

fn vertex(p: ClipPoint, attributes: [i32; 2]) -> ClipVertex<2> {
    ClipVertex { point: p, attributes }
}

#[test]
fn s5_clipped_triangles_and_attributes_match_f64() {
    let mut rng = Rng::new(0x503);
    let (mut compared, mut ill, mut worst, mut most) = (0, 0, 0f64, 0);
    for projection in projections() {
        for _ in 0..20_000 {
            let corners = [(); 3].map(|()| {
                vertex(
                    random_point(&mut rng, &projection),
                    [rng.int(-255, 255) as i32 * 65_536, rng.bits() as i32 >> 1],
                )
            });
            let got = clip::triangle(corners);
            assert!(got.len() <= 9);
            most = most.max(got.len());
            let size = corners.iter().map(|c| largest(real(&c.point))).fold(0.0, f64::max);
            // Inside, to the rounding.
            for v in &got {
                assert!(
                    distances(real(&v.point)).iter().all(|&d| d >= -size * 2f64.powi(-27)),
                    "{corners:?}"
                );
                // Interpolated, never beyond the three values.
                for k in 0..2 {
                    let values = corners.map(|c| c.attributes[k]);
                    let range = values.iter().min()..=values.iter().max();
                    assert!(range.contains(&Some(&v.attributes[k])), "{corners:?} {v:?}");
                }
            }
            // Each triangle of the fan that is inside stays to the bit.
            for k in 2..got.len() {
                let part = [got[0], got[k - 1], got[k]];
                if part.iter().all(|v| v.point.outcode() == Outcode::INSIDE) {
                    assert_eq!(&clip::triangle(part)[..], &part);
                }
            }
            let want = polygon(corners.map(|c| (real(&c.point), c.attributes.map(f64::from))));
            // Not where a corner lies so near to a plane that rounding decides; those are few.
            let near_tie = corners
                .iter()
                .flat_map(|c| distances(real(&c.point)))
                .any(|d| d.abs() < size * 1e-6 && d != 0.0)
                || want
                    .iter()
                    .any(|(p, _)| distances(*p).iter().filter(|d| d.abs() < size * 1e-6).count() > 2)
                || (1..want.len()).any(|i| {
                    (0..i)
                        .any(|j| largest(core::array::from_fn(|k| want[i].0[k] - want[j].0[k])) < size * 1e-5)
                });
            if near_tie {
                continue;
            }
            // Edges along a plane: what moving the corners by 2⁻³⁰ does in f64.
            let mut moved = 0f64;
            for k in [0x000, 0xfff, 0x12e, 0x7a5, 0xb34, 0x4d9, 0xc63, 0x8f0, 0x369, 0xa5a] {
                let again = polygon(core::array::from_fn(|j| {
                    let c = &corners[j];
                    (nudged(real(&c.point), size, k >> (4 * j)), c.attributes.map(f64::from))
                }));
                if again.len() != want.len() {
                    moved = f64::INFINITY;
                    break;
                }
                for (a, b) in again.iter().zip(&want) {
                    moved = moved.max(gap(a.0, b.0) / size);
                }
            }
            if moved > 2f64.powi(-28) {
                ill += 1;
                continue;
            }
            compared += 1;
            assert_eq!(got.len(), if want.len() < 3 { 0 } else { want.len() }, "{corners:?}");
            for (v, (p, attributes)) in got.iter().zip(&want) {
                let error = largest(core::array::from_fn(|k| real(&v.point)[k] - p[k])) / size;
                worst = worst.max(error);
                for k in 0..2 {
                    // The attribute is taken at the point's position along the edge, which is less accurate if the
                    // edge is short compared with its coordinates.
                    let range = corners.iter().map(|c| f64::from(c.attributes[k]).abs()).fold(0.0, f64::max);
                    let shortest = (0..3)
                        .map(|i| {
                            largest(core::array::from_fn(|j| {
                                real(&corners[i].point)[j] - real(&corners[(i + 1) % 3].point)[j]
                            }))
                        })
                        .fold(f64::INFINITY, f64::min);
                    let room = 1.0 + range * 2f64.powi(-24) * (size / shortest);
                    if shortest > size * 1e-3 && want.len() == 3 {
                        assert!(
                            (f64::from(v.attributes[k]) - attributes[k]).abs() <= room,
                            "{corners:?} {v:?} {attributes:?}"
                        );
                    }
                }
            }
        }
    }
    println!("{compared} triangles ({ill} with edges along a plane), up to {most} corners: within 2^{:.2} of the largest corner", worst.log2());
    assert!(compared > 10_000 && most >= 7);
    assert!(worst <= 2f64.powi(-27), "2^{}", worst.log2());
}

#[test]
fn s5_neighbours_get_the_same_cut_points_whichever_way_they_walk() {
    let mut rng = Rng::new(0x504);
    let (mut shared, mut lost) = (0, 0);
    for projection in projections() {
        for _ in 0..20_000 {
            let [a, b, c, d] =
                [(); 4].map(|()| vertex(random_point(&mut rng, &projection), [rng.bits() as i32 >> 1; 2]));
            // Same units for both, as all corners of a mesh have: the largest is in the shared edge.
            let exponent = a.point.exponent().max(b.point.exponent());
            if c.point.exponent().max(d.point.exponent()) > exponent {
                continue;
            }
            // Cut points on the shared edge, from the line clipper with the same ends.
            let Some((p, q)) = clip::line(a.point, b.point) else { continue };
            for (one, two) in [([a, b, c], [b, a, d]), ([c, a, b], [d, b, a]), ([b, c, a], [a, d, b])] {
                let (one, two) = (clip::triangle(one), clip::triangle(two));
                for end in [p, q] {
                    let has = |polygon: &[ClipVertex<2>]| -> Vec<[i32; 2]> {
                        polygon.iter().filter(|v| v.point == end).map(|v| v.attributes).collect()
                    };
                    let (x, y) = (has(&one), has(&two));
                    if one.len() >= 3 && two.len() >= 3 {
                        // Both have it, with one attribute in common; or a sliver lost it.
                        lost += usize::from(x.is_empty() || y.is_empty());
                        if !x.is_empty() && !y.is_empty() {
                            assert!(x.iter().any(|x| y.contains(x)), "{x:?} {y:?}");
                            shared += 1;
                        }
                    }
                }
            }
        }
    }
    println!("{shared} shared ends, {lost} lost");
    assert!(shared > 20_000 && lost * 1000 < shared);
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
    let found = library.visibility(&sphere, &placed);
    // One frustum for many objects gives the camera's answer for each.
    assert_eq!(library.frustum().visibility(&sphere, &placed), found, "{camera:?} {model:?}");
    // The largest radius stands for no bound, also where a model makes it small.
    let boundless = Sphere { radius: scalar(i32::MAX), ..sphere };
    let shrunk = ModelBits([vec![Step::Scale([1; 3])], model.0.clone()].concat()).library();
    for placed in [&placed, &shrunk] {
        assert_eq!(library.visibility(&boundless, placed), Visibility::Partly, "{camera:?} {model:?}");
    }
    let (exact, exact_model) = (camera.exact(), model.exact());
    let margin = |&v: &[i16; 3]| {
        let clip = exact.clip(&exact_model, chain::vertex(v, exponent));
        distances(clip).into_iter().fold(f64::INFINITY, f64::min) / clip[3].abs().max(1.0)
    };
    let draw = || {
        let mut target = Recorder::<Shader>::sized(320, 200);
        let instance = library.place(&mesh, &placed).with_cull(Cull::None);
        (instance.solid(|_| Shader(1), &mut [], &mut target).expect("no error"), target.pixels.is_empty())
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
    assert_eq!(size_of::<pinhole::Frustum>(), 264, "its documentation says so");
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
            // The radius is stretched by at most √3 under a rotation (the root of the squares' sum).
            let is_undecided = found == Visibility::Partly && least.abs() < 1.75;
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
        let found = library.visibility(&mesh.bounding_sphere(), &model);
        tally.count(found);
        let Ok(pinhole::Projected { point: at, .. }) = library.place(&mesh, &model).project(0) else {
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
        let found = library.visibility(&sphere, &identity);
        // A negative radius counts as 0.
        let negative = Sphere { radius: scalar(-rng.log(1.0, f64::from(i32::MAX)) as i32), ..sphere };
        assert_eq!(library.visibility(&negative, &identity), found, "{camera:?} {negative:?}");
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
