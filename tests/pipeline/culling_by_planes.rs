//! Culling by face planes leaves every picture and the order of faces unchanged, except for faces that face away and that the snap of
//! their corners turns to the front.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Coordinate, Cull, FacePlanes, Mesh, MeshError, MeshInstance, Scalar, Statistics, WithPlanes};
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::ways::{by_every_call, screen, Drawn};
use support::oracle::rng::Rng;
use support::teapot;

const WIDTH: u32 = 90;
const HEIGHT: u32 = 60;
const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(WIDTH, HEIGHT));

/// The pictures of all draw calls, the faces that were shaded at once without depth, in order, and the counts.
type Drawing = (Drawn<Rgb565>, Vec<u16>, Statistics);

fn draw<V: Coordinate, P: FacePlanes>(instance: &MeshInstance<'_, V, P>) -> Drawing {
    let color = |face: usize| Rgb565::from(RawU16::new(face as u16 + 1));
    let (drawn, counted) = by_every_call(instance, AREA, Rgb565::BLACK, &[7, HEIGHT], &color);
    let mut faces = Vec::new();
    screen(AREA, &mut |target, _| {
        let Ok(_) = instance.solid(
            |face| {
                faces.push(face as u16);
                color(face)
            },
            &mut [],
            target,
        );
    });
    (drawn, faces, counted)
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
fn exact_area<V: Coordinate, P: FacePlanes>(
    instance: &MeshInstance<'_, V, P>,
    face: [u16; 3],
) -> Option<i128> {
    let [a, b, c] = face.map(|index| instance.project_unsnapped(index.into()).map(|p| p.map(i128::from)));
    let (a, b, c) = (a?, b?, c?);
    Some((c[0] - a[0]) * (b[1] - a[1]) - (b[0] - a[0]) * (c[1] - a[1]))
}

fn compare<V: Coordinate>(instance: &MeshInstance<'_, V, WithPlanes>, cull: Cull, tally: &mut Tally) {
    let instance = &instance.with_cull(cull);
    let count = instance.mesh().faces().len() as u32;
    let (expected, faces, e) = draw(&instance.without_planes());
    let (found, others, f) = draw(instance);
    let missing: Vec<u16> = faces.iter().copied().filter(|face| !others.contains(face)).collect();
    for &face in &missing {
        let area = exact_area(instance, instance.mesh().faces()[usize::from(face)]);
        let is_culled = area.is_some_and(|area| if cull == Cull::Front { area > 0 } else { area < 0 });
        assert!(is_culled, "face {face} is not culled: {area:?}");
    }
    assert!(faces.iter().filter(|face| !missing.contains(face)).eq(&others));
    assert_eq!(f.drawn as usize + missing.len(), e.drawn as usize);
    // A face that its plane turns away counts as culled, even if it is also outside or degenerate.
    assert!(f.culled >= e.culled && f.degenerate <= e.degenerate && f.outside <= e.outside);
    assert_eq!(f.drawn + f.culled + f.degenerate + f.outside, count);
    let clipped = e.clipped.saturating_sub(missing.len() as u32)..=e.clipped;
    assert!(clipped.contains(&f.clipped), "{f:?} {e:?}");
    // In these views the missing faces cover no pixel.
    assert!(found == expected, "other pixels");
    tally.turned += missing.len();
    tally.drawn += e.drawn;
    tally.culled += e.culled;
    tally.clipped += e.clipped;
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
        assert!(tally.drawn > 15_000 && tally.culled > 15_000, "{tally:?}");
        assert!(0 < tally.turned && (tally.turned as u32) < tally.drawn / 50, "{tally:?}");
    }
    assert!(near.clipped > 2500, "{near:?}");
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
        let found = draw(&instance);
        assert!(found == draw(&instance.without_planes()));
        drawn += found.2.drawn;
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
