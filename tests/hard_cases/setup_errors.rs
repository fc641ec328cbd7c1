//! Bad meshes, lights and numbers have their own errors. That set-ups which cannot show a picture are refused for their own reason alone,
//! that others are accurate, and that none panics with overflow checks, is shown by `fuzz/targets/set_up`.

use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, World};
use pinhole::{light::LightError, math::MathError, mesh::MeshError, prelude::*, Angle};
use support::bridge::vector;

/// The error of an index that is none of `count` vertices.
fn index(of: &'static str, number: usize, index: u16, count: usize) -> MeshError {
    MeshError::Index { of, number, used: "vertex", index, count }
}

#[test]
fn invalid_meshes_are_refused_with_the_offending_index() {
    let vertices = [[0i16; 3]; 3];
    assert!(Mesh::new(&vertices, 0, &[[0, 1, 2]]).is_ok());
    assert!(Mesh::new(&[], 0, &[]).is_ok());
    assert_eq!(Mesh::new(&vertices, 0, &[[0, 1, 2], [0, 3, 1]]), Err(index("face", 1, 3, 3)));
    assert_eq!(Mesh::new(&[], 0, &[[0, 0, 0]]), Err(index("face", 0, 0, 0)));
    let mesh = Mesh::new(&vertices, 0, &[[0, 1, 2]]).expect("a mesh");
    assert!(mesh.with_edges(&[[0, 1], [2, 2]]).is_ok());
    assert_eq!(mesh.with_edges(&[[0, 1], [1, 2], [65535, 0]]), Err(index("edge", 2, 65535, 3)));
    assert!(mesh.with_normals(&[[0, 0, 1]]).is_ok());
    assert_eq!(
        mesh.with_normals(&[]),
        Err(MeshError::ListLength { one: "normal per face", given: 0, needed: 1 })
    );
    let wrong = MeshError::ListLength { one: "normal per vertex", given: 1, needed: 3 };
    assert_eq!(mesh.with_vertex_normals(&[[0, 0, 1]]), Err(wrong));
    let normals = vec![[0, 0, 32767]; mesh.vertices().len()];
    assert_eq!(mesh.with_vertex_normals(&normals).expect("one each").vertex_normals(), normals);
    // Lists that are looked up by `corners_of`.
    assert_eq!(mesh.corners_of(0, &[7]).iter().filter(|&&c| c == 7).count(), 1);
    assert_eq!(mesh.corners_of(1, &[7; 9]), [0; 3]); // no such face

    // As many vertices as a u16 can name, and one more.
    let many = vec![[1i16, 2, 3]; 65537];
    assert!(Mesh::new(&many[..65536], 0, &[[0, 65535, 9]]).is_ok());
    assert!(matches!(Mesh::new(&many, 0, &[]), Err(MeshError::TooManyVertices { .. })));
    // −32 … 15
    for exponent in i8::MIN..=i8::MAX {
        let error = Mesh::new(&vertices, exponent, &[]).err();
        assert_eq!(error, (!(-32..=15).contains(&exponent)).then_some(MeshError::Exponent { exponent }));
    }
    let fixed = [[Scalar::ZERO; 3]; 2];
    assert_eq!(Mesh::from_fixed(&fixed, &[[0, 1, 2]]), Err(index("face", 0, 2, 2)));
}

#[test]
fn a_light_without_direction_is_refused() {
    let model = Affine::<Model, World>::identity();
    assert!(matches!(Lambert::new(&model, Vector3::from_ints(0, 0, 0), 64), Err(LightError::ZeroDirection)));
    for l in [[1, 0, 0], [i32::MIN; 3], [i32::MAX, 1, -1]] {
        assert!(Lambert::new(&model, vector(l), 300).is_ok());
    }
}

#[test]
fn floats_beyond_the_numbers_are_an_error() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(Point3::<World>::from_f32(0.0, bad, 0.0), Err(MathError::NotFinite));
        assert_eq!(Vector3::<World>::from_f32(bad, 0.0, 0.0), Err(MathError::NotFinite));
        assert_eq!(Angle::from_degrees_f32(bad), Err(MathError::NotFinite));
    }
    for bad in [32768.0, -32769.0, 1e30, f32::MAX, f32::MIN] {
        assert_eq!(Point3::<World>::from_f32(0.0, 0.0, bad), Err(MathError::OutOfRange));
    }
    assert_eq!([1e9, 1e30].map(Angle::from_degrees_f32), [Err(MathError::OutOfRange); 2]);
}

/// Cameras built at compile time, with every `const` constructor.
mod constant {
    use super::*;
    use pinhole::{camera::Window, Camera, Projection};

    const SIZE: Size = Size::new(320, 240);
    const UPWARDS: Vector3<World> = Vector3::from_ints(1, 9, 2);
    const EYE: Point3<World> = Point3::from_ints(7, -3, 11);
    const NEAR: Scalar = Scalar::from_bits(45_678);
    const FAR: Scalar = Scalar::from_int(77);
    const BORDERS: Window = Window {
        left: Scalar::from_bits(-33_333),
        right: Scalar::from_bits(44_444),
        bottom: Scalar::from_bits(-22_222),
        top: Scalar::from_bits(55_555),
    };

    /// Built at run time, by every `const` constructor.
    macro_rules! cameras {
        ($eye:expr) => {{
            let eye = $eye;
            let viewings = [
                ViewTransform::look_at(eye, Point3::from_ints(0, 1, 0), UPWARDS),
                ViewTransform::from_reference(eye, Vector3::from_ints(3, -1, -4), UPWARDS),
                ViewTransform::from_reference(eye, Vector3::from_ints(1, 2, 3), UPWARDS),
            ];
            let projections = [
                Projection::perspective(Angle::degrees(50), SIZE, NEAR, FAR),
                Projection::frustum(BORDERS, NEAR, FAR),
                Projection::orthographic(BORDERS, NEAR, FAR),
            ];
            let viewport = Viewport::new(Point::new(5, -7), SIZE);
            let (mut cameras, mut i) = ([None; 9], 0);
            while i < 9 {
                if let (Ok(viewing), Ok(projection), Ok(viewport)) =
                    (&viewings[i / 3], &projections[i % 3], &viewport)
                {
                    cameras[i] = Some(Camera::new(viewing, projection, viewport));
                }
                i += 1;
            }
            cameras
        }};
    }

    const CAMERAS: [Option<Camera>; 9] = cameras!(EYE);

    #[test]
    fn is_what_the_program_makes() {
        assert!(CAMERAS.iter().all(Option::is_some));
        assert_eq!(CAMERAS, cameras!(core::hint::black_box(EYE)));
        const TURN: Affine<Model, World> = Affine::rotation_y(Angle::degrees(33));
        assert_eq!(TURN, Affine::rotation_y(core::hint::black_box(Angle::degrees(33))));
    }
}

/// The faces adjacent to edges belong to the edges that the mesh had when they were set.
#[test]
fn other_edges_have_no_faces_beside_them_yet() {
    let (vertices, faces) = ([[0; 3], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 2, 3]]);
    let mesh = Mesh::new(&vertices, 0, &faces)
        .and_then(|mesh| mesh.with_edges(&[[0, 2]]))
        .and_then(|mesh| mesh.with_edge_faces(&[[0, 1]]))
        .expect("a mesh");
    assert_eq!(mesh.edge_faces(), [[0, 1]]);
    let other = mesh.with_edges(&[[0, 1], [1, 2]]).expect("edges");
    assert_eq!(other.edge_faces(), [[0; 2]; 0]);
    let one = "pair of faces per edge";
    let error = other.with_edge_faces(&[[0, 1]]).map(drop);
    assert_eq!(error, Err(MeshError::ListLength { one, given: 1, needed: 2 }));
    let error = other.with_edge_faces(&[[0, Mesh::<i16>::NO_FACE], [2, 1]]).map(drop);
    assert_eq!(error, Err(MeshError::Index { of: "edge", number: 1, used: "face", index: 2, count: 2 }));
}
