//! The message of each error says what is wrong, with its numbers, and what to change.

use pinhole::{
    AxisError, BandError, BinError, DepthBufferError, HierarchyError, InverseError, LightError,
    MaterialError, MatrixError, MeshError, NumberError, PainterError, PictureError, ProjectError,
    ProjectionError, QuaternionError, TextureError, ViewTransformError, ViewportError,
};
use std::collections::HashSet;
use std::error::Error;

#[test]
fn each_message_names_the_fault_and_the_way_out() {
    let cases: Vec<(Box<dyn Error>, &[&str])> = vec![
        (Box::new(NumberError::NotFinite), &["NaN", "infinite", "computed"]),
        (Box::new(NumberError::OutOfRange), &["range", "unit"]),
        (Box::new(QuaternionError::Zero), &["length zero", "(1, 0, 0, 0)"]),
        (Box::new(AxisError::ZeroAxis), &["axis", "length zero", "direction"]),
        (Box::new(MatrixError::NotAffine), &["last row", "0 0 0 1"]),
        (Box::new(MatrixError::NotFinite), &["matrix", "NaN"]),
        (Box::new(MatrixError::OutOfRange), &["translation", "2^30", "unit"]),
        (Box::new(InverseError::Singular), &["singular", "scale is zero"]),
        (Box::new(InverseError::NotRigid), &["not rigid", "`inverse`"]),
        (Box::new(LightError::ZeroDirection), &["direction", "light", "length zero", "give"]),
        (Box::new(LightError::NotRigid), &["model transform", "stretches", "use Lambert"]),
        (Box::new(MeshError::TooManyVertices { vertices: 70_001 }), &["70001", "65536", "split"]),
        (Box::new(MeshError::FaceIndex { face: 31, index: 77 }), &["face 31", "vertex 77"]),
        (Box::new(MeshError::EdgeIndex { edge: 32, index: 78 }), &["edge 32", "vertex 78"]),
        (Box::new(MeshError::EdgeFaces { edge: 33 }), &["edge 33", "face"]),
        (
            Box::new(MeshError::NormalCount { faces: 41, normals: 42 }),
            &["42 normals", "41 faces", "per face"],
        ),
        (Box::new(MeshError::PlaneCount { faces: 43, planes: 44 }), &["44 planes", "43 faces", "per face"]),
        (
            Box::new(MeshError::VertexNormalCount { vertices: 45, normals: 46 }),
            &["46 vertex normals", "45 vertices", "per vertex"],
        ),
        (
            Box::new(MeshError::VertexListCount { vertices: 47, entries: 48 }),
            &["48 entries", "47 vertices", "one per vertex"],
        ),
        (
            Box::new(MeshError::FaceListCount { faces: 49, entries: 50 }),
            &["50 entries", "49 faces", "one per face"],
        ),
        (Box::new(MeshError::Exponent { exponent: 16 }), &["16", "-32 to 15", "unit"]),
        (Box::new(HierarchyError { node: 5, parent: 9 }), &["node 5", "parent 9", "parents first"]),
        (Box::new(BinError::Storage { needed: 301, given: 299 }), &["299", "at least 301"]),
        (Box::new(BinError::TooMany { items: 70_002 }), &["70002", "65535", "split"]),
        (Box::new(PainterError::Vertices { needed: 71, capacity: 70 }), &["71", "70", "raise VERTICES"]),
        (
            Box::new(PainterError::Vertices { needed: 65_537, capacity: 65_536 }),
            &["65537", "65536", "fewer meshes"],
        ),
        (Box::new(PainterError::Faces { needed: 81, capacity: 80 }), &["81", "80", "raise FACES"]),
        (
            Box::new(PainterError::Faces { needed: 65_536, capacity: 65_535 }),
            &["65536", "65535", "fewer meshes"],
        ),
        (Box::new(PainterError::OtherViewport), &["painter", "one viewport"]),
        (Box::new(ProjectError::BeforeNear), &["before the near plane", "move"]),
        (Box::new(ProjectError::BeyondFar), &["beyond the far plane", "move"]),
        (Box::new(ProjectError::OutsideGuardBand), &["guard band", "8192"]),
        (Box::new(ProjectionError::FieldOfView), &["field of view", "0.09°", "179.9°"]),
        (Box::new(ProjectionError::EmptyAspect), &["aspect ratio", "zero", "viewport's size"]),
        (Box::new(ProjectionError::NearNotPositive), &["near plane", "greater than 0"]),
        (Box::new(ProjectionError::NearNotBeforeFar), &["far plane", "beyond the near"]),
        (Box::new(ProjectionError::NearTooCloseToFar), &["close", "depth", "apart"]),
        (Box::new(ProjectionError::EmptyWindow), &["window", "left < right", "bottom < top"]),
        (Box::new(ProjectionError::WindowTooSmall), &["window", "too small", "enlarge"]),
        (Box::new(ProjectionError::NoViewPlane), &["parallel to the view plane", "change"]),
        (Box::new(ProjectionError::ReferenceBehindPlane), &["reference point", "n > 0"]),
        (Box::new(ProjectionError::Matrix { row: 'y' }), &["row y", "matrix", "finite"]),
        (Box::new(ProjectionError::OutOfRange), &["2^30", "unit"]),
        (Box::new(ViewTransformError::ZeroDirection), &["viewing direction", "length zero", "eye"]),
        (Box::new(ViewTransformError::ZeroUp), &["up vector", "length zero"]),
        (Box::new(ViewTransformError::ParallelUp), &["up vector", "parallel", "another"]),
        (Box::new(ViewTransformError::NotAxonometric), &["normal", "non-zero", "trimetric"]),
        (Box::new(ViewTransformError::NotRigid), &["not rigid", "orthonormal", "0 0 0 1"]),
        (Box::new(ViewTransformError::EyeOutside), &["eye", "32768", "unit"]),
        (Box::new(ViewportError::Empty), &["no pixels", "at least 1"]),
        (Box::new(ViewportError::OutsideGuardBand), &["8192", "shrink"]),
        (Box::new(DepthBufferError { needed: 640, given: 639 }), &["640", "639", "`u16`"]),
        (Box::new(BandError { needed: 480, given: 479 }), &["479", "480", "row"]),
        (Box::new(TextureError::Side { side: 100 }), &["100", "8, 16, 32, 64, 128 or 256", "resize"]),
        (Box::new(TextureError::Texels { needed: 64, given: 63 }), &["63", "64", "needs"]),
        (Box::new(TextureError::Palette { needed: 16, given: 15 }), &["15", "16", "append"]),
        (Box::new(TextureError::Exponent { exponent: 1 }), &["2^1", "-15 to 0"]),
        (Box::new(MaterialError::Index { face: 3, index: 9, count: 8 }), &["face 3", "9", "has 8"]),
        (Box::new(MaterialError::Exponent { exponent: -16 }), &["2^-16", "-15 to 0"]),
        (Box::new(PictureError { needed: 320, given: 319 }), &["320", "319", "cells"]),
    ];
    let mut messages = HashSet::new();
    for (error, words) in &cases {
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{error:?}: {message}");
        assert!(messages.insert(message), "{error:?}: another error has this message");
    }
    let inner = NumberError::OutOfRange;
    assert_eq!(QuaternionError::Number(inner).to_string(), inner.to_string());
}
