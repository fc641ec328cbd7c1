//! Culling by face planes leaves the calls to the target and their order unchanged, except for faces that face away and
//! that the snap of their corners turns to the front.

#[allow(dead_code, unreachable_pub)]
use support::teapot;

use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Cull, DepthBuffer, FacePlanes, Mesh, MeshError, MeshInstance, Scalar, ScreenVertex, Statistics,
    WithPlanes,
};
use std::cell::RefCell;
use support::bridge::draw::Shader;
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder};

const WIDTH: u32 = 90;
const HEIGHT: u32 = 60;

/// The result of a draw call.
struct Drawing {
    calls: Vec<Call<Shader>>,
    depths: Vec<u16>,
    statistics: Statistics,
    /// The faces drawn, in order.
    faces: Vec<u16>,
}

fn draw(
    depth: bool,
    with: impl FnOnce(&dyn Fn(usize) -> Shader, Option<&mut DepthBuffer<'_>>, &mut Recorder<Shader>) -> Statistics,
) -> Drawing {
    let mut target = Recorder::sized(WIDTH, HEIGHT);
    let area = target.bounding_box();
    let mut depths = vec![0; (WIDTH * HEIGHT) as usize];
    let faces = RefCell::new(Vec::new());
    let shade = |face: usize| {
        faces.borrow_mut().push(face as u16);
        Shader(face as u16)
    };
    let statistics = if depth {
        let mut buffer = DepthBuffer::new(area, &mut depths).unwrap();
        with(&shade, Some(&mut buffer), &mut target)
    } else {
        with(&shade, None, &mut target)
    };
    Drawing { calls: target.calls, depths, statistics, faces: faces.into_inner() }
}

fn plain<V: pinhole::Coordinate>(instance: &MeshInstance<'_, V>, depth: bool) -> Drawing {
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
    draw(depth, |shade, depth, target| {
        match depth {
            Some(depth) => instance.depth_tested(shade, &mut cache, depth, target),
            None => instance.solid(shade, &mut cache, target),
        }
        .unwrap()
    })
}

/// `cache` is the vertex cache, filled with the vertices of another picture.
fn by_planes<V: pinhole::Coordinate>(
    instance: &MeshInstance<'_, V, WithPlanes>,
    depth: bool,
    cache: &mut [ScreenVertex],
) -> Drawing {
    draw(depth, |shade, depth, target| {
        match depth {
            Some(depth) => instance.depth_tested(shade, cache, depth, target),
            None => instance.solid(shade, cache, target),
        }
        .unwrap()
    })
}

/// Draws in bands of 7 rows; returns the calls and the counts. `transforms`: all vertices are transformed first.
fn in_bands<V: pinhole::Coordinate, P: FacePlanes>(
    instance: &MeshInstance<'_, V, P>,
    depth: bool,
    transforms: bool,
    corners: &mut [ScreenVertex],
) -> (Vec<Call<Shader>>, Statistics) {
    let count = instance.mesh().faces().len();
    let mut bin_storage = vec![0; count + count.div_ceil(16)];
    let mut calls = Vec::new();
    let rows = (0..HEIGHT as i32)
        .step_by(7)
        .map(|top| Recorder::<Shader>::new(Rectangle::new(Point::new(0, top), Size::new(WIDTH, 7))));
    let shade = |face| Shader(face as u16);
    let statistics = if depth {
        let transformed;
        let mut faces = if transforms {
            transformed = instance.transform_depth(corners);
            transformed.bin_faces(&mut bin_storage).unwrap()
        } else {
            instance.bin_faces_with_depth(corners, &mut bin_storage).unwrap()
        };
        for mut band in rows {
            let mut depths = vec![0; WIDTH as usize * 7];
            let mut buffer = DepthBuffer::new(band.bounding_box(), &mut depths).unwrap();
            faces.depth_tested(shade, &mut buffer, &mut band).unwrap();
            calls.extend(band.calls);
        }
        faces.statistics()
    } else {
        let transformed;
        let mut faces = if transforms {
            transformed = instance.transform(corners);
            transformed.bin_faces(&mut bin_storage).unwrap()
        } else {
            instance.bin_faces(corners, &mut bin_storage).unwrap()
        };
        for mut band in rows {
            faces.solid(shade, &mut band).unwrap();
            calls.extend(band.calls);
        }
        faces.statistics()
    };
    (calls, statistics)
}

#[derive(Default, Debug)]
struct Tally {
    drawn: u32,
    culled: u32,
    clipped: u32,
    /// Faces that are culled by their planes, and that rounding turns over.
    turned: usize,
}

/// Twice the area before corners are snapped, in 2⁻⁶⁴ pixels; positive for front faces.
fn exact_area<V: pinhole::Coordinate, P: FacePlanes>(
    instance: &MeshInstance<'_, V, P>,
    face: [u16; 3],
) -> Option<i128> {
    let [a, b, c] = face.map(|index| instance.project_unsnapped(index.into()).map(|p| p.map(i128::from)));
    let (a, b, c) = (a?, b?, c?);
    Some((c[0] - a[0]) * (b[1] - a[1]) - (b[0] - a[0]) * (c[1] - a[1]))
}

fn compare<V: pinhole::Coordinate>(
    instance: &MeshInstance<'_, V, WithPlanes>,
    cull: Cull,
    tally: &mut Tally,
) {
    let instance = &instance.with_cull(cull);
    let by_area = instance.without_planes();
    let (count, faces) = (instance.mesh().vertices().len(), instance.mesh().faces().len() as u32);
    // Vertices of a mesh with another model matrix.
    let mut stale = vec![ScreenVertex::EMPTY; count + 3];
    let _ = by_area.solid(|_| Shader(0), &mut stale, &mut Recorder::sized(9, 9));
    stale.rotate_right(5);
    for depth in [false, true] {
        let expected = plain(&by_area, depth);
        for length in [0, count / 2, count, count + 3] {
            let found = by_planes(instance, depth, &mut stale.clone()[..length]);
            let (e, f) = (expected.statistics, found.statistics);
            let missing: Vec<u16> =
                expected.faces.iter().copied().filter(|face| !found.faces.contains(face)).collect();
            for &face in &missing {
                let area = exact_area(instance, instance.mesh().faces()[usize::from(face)]);
                let is_culled =
                    area.is_some_and(|area| if cull == Cull::Front { area > 0 } else { area < 0 });
                assert!(is_culled, "face {face} is not culled: {area:?}");
            }
            tally.turned += missing.len();
            assert_eq!(f.drawn as usize + missing.len(), e.drawn as usize);
            // A face that its plane turns away counts as culled, even if it is also outside or degenerate.
            assert!(f.culled >= e.culled && f.degenerate <= e.degenerate && f.outside <= e.outside);
            assert_eq!(f.drawn + f.culled + f.degenerate + f.outside, faces);
            assert!(
                (e.clipped.saturating_sub(missing.len() as u32)..=e.clipped).contains(&f.clipped),
                "{f:?} {e:?}"
            );
            let others: Vec<u16> =
                expected.faces.iter().copied().filter(|face| !missing.contains(face)).collect();
            assert_eq!(found.faces, others);
            // In these views the missing faces cover no pixel.
            assert!(found.calls == expected.calls, "other spans");
            assert!(found.depths == expected.depths, "other depths");
        }
        let whole = by_planes(instance, depth, &mut stale.clone()).statistics;
        let (expected_calls, counted) = in_bands(&by_area, depth, true, &mut stale.clone());
        for (length, transforms) in
            [(count / 2, false), (count / 2, true), (count + 3, false), (count + 3, true)]
        {
            let (calls, statistics) = in_bands(instance, depth, transforms, &mut stale.clone()[..length]);
            assert!(calls == expected_calls, "other spans in bands");
            assert_eq!(statistics, whole);
            let (calls, statistics) = in_bands(&by_area, depth, transforms, &mut stale.clone()[..length]);
            assert!(calls == expected_calls, "other spans in bands without planes");
            assert_eq!(statistics, counted);
        }
        tally.drawn += expected.statistics.drawn;
        tally.culled += expected.statistics.culled;
        tally.clipped += expected.statistics.clipped;
    }
}

fn camera(rng: &mut Rng, distance: f64, parallel: bool) -> CameraBits {
    let eye = bits(rng.direction().map(|c| c * distance)).unwrap();
    let about = [0; 3].map(|_| rng.int(-i64::from(ONE) * 8, i64::from(ONE) * 8) as i32);
    let projection = if parallel {
        let w = 20 * ONE;
        ProjectionBits::Orthographic([-w, w, -w * 2 / 3, w * 2 / 3], ONE, 400 * ONE)
    } else {
        ProjectionBits::Perspective((1 << 31) / 3, (WIDTH, HEIGHT), ONE / 2, 1000 * ONE)
    };
    CameraBits {
        view: ViewBits::LookAt(eye, about, [ONE / 3, ONE, ONE / 5]),
        projection,
        viewport: (0, 0, WIDTH, HEIGHT),
    }
}

#[test]
fn culling_by_planes_draws_the_same_teapot() {
    let mesh = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES).unwrap();
    let mesh = mesh.with_normals(&teapot::NORMALS).unwrap();
    let planes: [i16; 992] = mesh.face_planes();
    let mesh = mesh.with_planes(&planes).unwrap();
    let fixed = teapot::VERTICES.map(|v| v.map(|c| Scalar::from_bits(i32::from(c) << 6)));
    let wide = Mesh::from_fixed(&fixed, &teapot::FACES).unwrap().with_normals(&teapot::NORMALS).unwrap();
    let wide_planes: [i16; 992] = wide.face_planes();
    assert_eq!(wide_planes, planes, "justified, they are the same numbers");
    let wide = wide.with_planes(&wide_planes).unwrap();
    let (mut rng, mut near, mut far) = (Rng::new(0xfac), Tally::default(), Tally::default());
    for i in 0..160 {
        // Inside, through near, in front of it, far away.
        let distance = [5.0, 17.0, 40.0, 300.0][i % 4];
        let camera = camera(&mut rng, distance, i % 5 == 0);
        let mut model = ModelBits::random_rotation(&mut rng);
        if i % 3 == 0 {
            // Mirrored, and flat.
            model.0.insert(0, Step::Scale([-ONE, ONE / 4, ONE]));
        }
        let tally = if i % 4 == 3 { &mut far } else { &mut near };
        let (camera, model) = (camera.library(), model.library());
        compare(&camera.place(&mesh, &model), Cull::Back, tally);
        if i % 8 == 0 {
            compare(&camera.place(&wide, &model), Cull::Back, tally);
            compare(&camera.place(&mesh, &model), Cull::None, tally);
            compare(&camera.place(&mesh, &model), Cull::Front, tally);
        }
    }
    for tally in [&near, &far] {
        assert!(tally.drawn > 30_000 && tally.culled > 30_000, "{tally:?}");
        assert!(0 < tally.turned && (tally.turned as u32) < tally.drawn / 50, "{tally:?}");
    }
    assert!(near.clipped > 5000, "{near:?}");
}

/// A mesh without planes in the type of those with planes: only the order differs in which vertices are transformed.
#[test]
fn a_mesh_without_planes_is_not_culled_by_planes() {
    let (mut rng, mut drawn) = (Rng::new(0xfad), 0);
    let mesh = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES).unwrap();
    let mesh = mesh.with_normals(&teapot::NORMALS).unwrap();
    // New normals remove the planes, which belonged to the old normals.
    let zeros = [0; 992];
    let replaced = mesh.with_planes(&zeros).unwrap().with_normals(&teapot::NORMALS).unwrap();
    assert_eq!((mesh.planes(), replaced), (&[][..], mesh));
    assert_eq!(mesh.with_planes(&zeros).unwrap().without_planes(), mesh);
    assert_eq!(mesh.with_planes(&zeros).unwrap().with_planes_if_any().planes(), zeros);
    let of_both = mesh.with_planes_if_any();
    for i in 0..24 {
        let camera = camera(&mut rng, [5.0, 17.0, 300.0][i % 3], false).library();
        let instance = camera.place(&of_both, &ModelBits::random_rotation(&mut rng).library());
        let mut corners = vec![ScreenVertex::EMPTY; 400];
        let expected = plain(&instance.without_planes(), true);
        let found = by_planes(&instance, true, &mut corners);
        assert_eq!(found.statistics, expected.statistics);
        assert_eq!(found.faces, expected.faces);
        assert!(found.calls == expected.calls && found.depths == expected.depths);
        drawn += found.statistics.drawn;
    }
    assert!(drawn > 5000, "{drawn}");
}

#[test]
fn a_list_of_planes_of_the_wrong_length_is_refused() {
    let mesh = Mesh::new(&teapot::VERTICES, 0, &teapot::FACES).unwrap();
    assert_eq!(mesh.with_planes(&[0; 992]), Err(MeshError::NormalCount { faces: 992, normals: 0 }));
    let mesh = mesh.with_normals(&teapot::NORMALS).unwrap();
    let error = mesh.with_planes(&[0; 991]).unwrap_err();
    assert_eq!(error, MeshError::PlaneCount { faces: 992, planes: 991 });
    assert_eq!(error.to_string(), "991 planes for 992 faces: give one per face");
    // Fewer planes and more planes than faces; planes of normals longer than 1.
    assert_eq!(mesh.face_planes::<3>(), mesh.face_planes::<992>()[..3]);
    assert_eq!(mesh.face_planes::<993>()[992], 0);
    let vertices = [[i16::MAX; 3], [i16::MIN; 3], [0, 0, 1]];
    let mesh = Mesh::new(&vertices, 0, &[[0, 1, 2], [1, 2, 0], [2, 1, 0]]).unwrap();
    let normals = [[i16::MAX; 3]; 3];
    assert_eq!(mesh.with_normals(&normals).unwrap().face_planes(), [i16::MAX, i16::MIN, 0]);
}
