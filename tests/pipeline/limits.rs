//! Limits: the message of each error says what is wrong, with its numbers, and what to change; buffers whose lengths the library computes
//! have room for the mesh, whichever of its faces and edges are visible; arguments beyond their documented range count as its end.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, RgbColor};
use embedded_graphics::primitives::Rectangle;
use pinhole::raster::Span;
use pinhole::shading::{Barycentric, Varying};
use pinhole::{
    camera::CameraError, light::LightError, math::MathError, mesh::MeshError, prelude::*,
    target::BufferError, texture::TextureError, Angle,
};
use std::collections::HashSet;
use std::error::Error;

#[test]
fn each_message_names_the_fault_and_the_way_out() {
    macro_rules! cases {
        ($($error:expr => $($words:literal),+;)*) => { [$((Box::new($error) as Box<dyn Error>, &[$($words),+] as &[&str])),*] };
    }
    let cases = cases! {
        MathError::NotFinite => "NaN", "infinite", "computed";
        MathError::OutOfRange => "range", "unit";
        MathError::ZeroLength => "axis", "length zero", "direction", "(1, 0, 0, 0)";
        MathError::NotAffine => "last row", "0 0 0 1";
        MathError::Singular => "singular", "scale of zero";
        LightError::ZeroDirection => "direction", "light", "length zero", "give";
        LightError::NotRigid => "model transform", "stretches", "use Lambert";
        MeshError::TooManyVertices { vertices: 70_001 } => "70001", "65536", "split";
        MeshError::Index { of: "face", number: 31, used: "vertex", index: 77, count: 9 } => "face 31", "vertex 77", "are 9";
        MeshError::Index { of: "edge", number: 33, used: "face", index: 7, count: 6 } => "edge 33", "face 7", "are 6";
        MeshError::ListLength { one: "normal per face", given: 42, needed: 41 } => "42 entries", "41", "one normal per face";
        MeshError::Exponent { exponent: 16 } => "2^16", "2^-32 to 2^15", "2^-15 to 1", "unit";
        MeshError::Parent { node: 5, parent: 9 } => "node 5", "parent 9", "parents first";
        BufferError::Bins { needed: 301, given: 299 } => "299", "at least 301", "fork";
        BufferError::TooManyItems { items: 70_002 } => "70002", "65535", "split";
        BufferError::Full { parameter: "VERTICES", needed: 71, capacity: 70 } => "71", "70", "raise VERTICES";
        BufferError::Full { parameter: "VERTICES", needed: 65_537, capacity: 65_536 } => "65537", "65536", "fewer meshes";
        BufferError::Full { parameter: "FACES", needed: 81, capacity: 80 } => "81", "80", "raise FACES";
        BufferError::Full { parameter: "FACES", needed: 65_536, capacity: 65_535 } => "65536", "65535", "fewer meshes";
        BufferError::OtherViewport => "painter", "one viewport", "draw", "two painters";
        CameraError::BeforeNear => "before the near plane", "move";
        CameraError::BeyondFar => "beyond the far plane", "move";
        CameraError::OutsideGuardBand => "guard band", "8192", "move";
        CameraError::FieldOfView => "field of view", "0.09°", "179.9°";
        CameraError::NearNotPositive => "near plane", "greater than 0";
        CameraError::NearNotBeforeFar => "far plane", "beyond the near", "close", "depth", "apart";
        CameraError::EmptyWindow => "window", "left < right", "bottom < top", "too small", "enlarge";
        CameraError::NoViewPlane => "parallel to the view plane", "change", "reference point", "n > 0";
        CameraError::Matrix { row: 'y' } => "row y", "matrix", "finite";
        CameraError::OutOfRange => "2^30", "eye", "32768", "larger unit", "wider";
        CameraError::Direction => "viewing direction", "up vector", "length zero", "parallel", "another", "eye";
        CameraError::NotRigid => "not rigid", "orthonormal", "0 0 0 1";
        CameraError::NotFinite { row: 'z' } => "row z", "matrix", "NaN", "computed";
        CameraError::Viewport => "aspect ratio", "at least 1", "8192", "shrink";
        BufferError::Depth { needed: 640, given: 639 } => "640", "639", "`u16`";
        BufferError::Strip { of: "a strip of one row", needed: 480, given: 479 } => "479", "480", "strip of one row";
        TextureError::Side { side: 100 } => "100", "8, 16, 32, 64, 128 or 256", "resize";
        TextureError::Texels { needed: 64, given: 63 } => "63", "64", "needs";
        TextureError::Palette { needed: 16, given: 15 } => "15", "16", "append";
        TextureError::Exponent { exponent: 1 } => "2^1", "-15 to 0";
        BufferError::Picture { needed: 320, given: 319 } => "320", "319", "cells";
        BufferError::Full { parameter: "OBJECTS", needed: 13, capacity: 12 } => "13", "12", "raise OBJECTS";
        LightError::SlantedDepth => "depth", "VertexFog";
        LightError::TooFewFogSteps { steps: 4 } => "4 of 65535", "needs 8", "apart";
        CameraError::NoRadius => "no radius", "two different vertices";
        CameraError::TooNear => "touch the eye", "smaller unit", "narrower";
        CameraError::NoVertex => "no vertex", "indices begin at 0";
    };
    let mut messages = HashSet::new();
    for (error, words) in cases {
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{error:?}: {message}");
        assert!(messages.insert(message), "{error:?}: another error has this message");
    }
}

const VERTICES: [[i16; 3]; 3] = [[-9, -9, 0], [9, -9, 0], [0, 9, 0]];

/// A mesh of this many equal faces, and as many edges.
macro_rules! repeated {
    ($count:literal) => {
        match Mesh::new(&VERTICES, 0, &[[0, 1, 2]; $count]) {
            Ok(mesh) => match mesh.with_edges(&[[0, 1]; $count]) {
                Ok(mesh) => mesh,
                Err(_) => panic!("edges"),
            },
            Err(_) => panic!("faces"),
        }
    };
}

const FEW: Mesh<'static> = repeated!(16);
const MANY: Mesh<'static> = repeated!(17);

fn camera() -> Camera {
    let viewport = Viewport::new(Point::zero(), Size::new(40, 40)).expect("a viewport");
    let sphere = MANY.bounding_sphere();
    Camera::framing(&sphere, &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO).expect("a sphere")
}

#[test]
fn bins_have_room_for_all_faces_and_no_more() {
    let (mut buffers, camera) = (mesh_buffers!(FEW, MANY), camera());
    assert_eq!((buffers.cache.len(), buffers.bins.len(), buffers.edge_bins.len()), (3, 17 + 2 + 8, 0));
    assert_eq!(mesh_buffers!(FEW).bins.len(), 16 + 1 + 8);
    let instance = camera.place(&MANY, &Affine::identity()).with_cull(Cull::None);
    let projected = instance.transform(&mut buffers.cache);
    assert!(projected.bin_faces(&mut buffers.bins).is_ok());
    let short = projected.bin_faces(&mut buffers.bins[..26]).err();
    assert_eq!(short, Some(BufferError::Bins { needed: 27, given: 26 }));
}

#[test]
fn bins_have_room_for_all_edges_and_no_more() {
    let (mut buffers, camera) = (mesh_buffers!(edges: MANY), camera());
    assert_eq!((buffers.cache.len(), buffers.bins.len(), buffers.edge_bins.len()), (3, 0, 17 + 2 + 8));
    let both = mesh_buffers!(faces, edges: MANY);
    assert_eq!((both.cache.len(), both.bins.len(), both.edge_bins.len()), (3, 27, 27));
    let instance = camera.place(&MANY, &Affine::identity());
    let projected = instance.transform(&mut buffers.cache);
    assert!(projected.bin_edges(&mut buffers.edge_bins).is_ok());
    assert!(projected.bin_edges(&mut buffers.edge_bins[..26]).is_err());
}

#[test]
fn strips_have_room_for_their_rows_and_no_more() {
    let mut strip = strip_buffers!(BinaryColor, 13, 5);
    let area = Rectangle::new(Point::zero(), Size::new(13, 100));
    let rows = |bytes: &mut [u8]| {
        let band = Frame::new(area, BinaryColor::Off).next_band(bytes).ok().flatten();
        band.map(|band| band.area().size.height)
    };
    assert_eq!(rows(&mut strip.colors), Some(5));
    assert_eq!(rows(&mut strip.colors[..9]), Some(4));
    assert_eq!(strip.depths.len(), 13 * 5);
    const WIDTH: usize = 240; // a length of any integer type
    assert_eq!(strip_buffers!(Rgb565, WIDTH, 8, no depth).colors.len(), 3840);
}

/// The objects of a scene are binned at the same time: each has its own part of both buffers.
#[test]
fn a_scene_has_room_for_all_its_objects_and_no_more() {
    const OBJECTS: usize = 3;
    let mut buffers = mesh_buffers!([FEW; OBJECTS], [MANY; 1]);
    assert_eq!((buffers.cache.len(), buffers.bins.len()), (4 * 3, 3 * (16 + 1 + 8) + 17 + 2 + 8));
    let mut scene = Scene::<(), 4>::new();
    for mesh in [&FEW, &FEW, &FEW, &MANY] {
        let mut object = Object::new(mesh, Affine::identity(), ());
        object.cull = Cull::None;
        scene.add(object).expect("room for four");
    }
    let camera = camera();
    let placed = scene.place(&camera);
    assert!(placed.bin_faces(&mut buffers.cache, &mut buffers.bins).is_ok());
    assert!(placed.bin_faces(&mut buffers.cache, &mut buffers.bins[1..]).is_err());
    static SCENE: MeshBuffers!([FEW; OBJECTS], [MANY; 1]) = mesh_buffers!([FEW; OBJECTS], [MANY; 1]);
    assert_eq!(SCENE.cache.len(), mesh_buffers!([FEW; 4]).cache.len());
}

/// A parameter beyond its range counts as the nearer end of the range.
#[test]
fn weights_stay_between_both_ends_whatever_the_parameter() {
    let (from, to) = (Barycentric::of(0), Barycentric::of(1));
    for below in [-1, -(1 << 31), i64::MIN] {
        assert_eq!(from.towards(&to, below).weights(), [1 << 30, 0, 0], "{below}");
    }
    let last = from.towards(&to, (1 << 31) - 1);
    for beyond in [1 << 31, 1 << 32, (1 << 32) + (1 << 30), i64::MAX] {
        assert_eq!(from.towards(&to, beyond), last, "{beyond}");
    }
}

/// Repeated steps beyond the range neither leave it nor overflow.
#[test]
fn weights_of_many_steps_stay_in_range() {
    let corners = [0, 1, 2].map(Barycentric::of);
    for step in [i64::MIN, -(1 << 32), -1, 1 << 31, 3 << 31, i64::MAX] {
        let mut point = corners[0];
        for turn in 0..200 {
            point = point.towards(&corners[turn % 3], step);
            let weights = point.weights();
            assert_eq!(weights.iter().map(|&weight| i64::from(weight)).sum::<i64>(), 1 << 30);
            // Half a unit for each rounding of two weights.
            let slack = turn as i32 + 1;
            assert!(
                weights.iter().all(|weight| (-slack..=(1 << 30) + slack).contains(weight)),
                "{weights:?}"
            );
        }
    }
}

/// The rows of a span that lie outside of the picture are left out, however many there are: this test would take minutes
/// if they were visited, and with 32-bit indices a row far outside could be taken for one inside.
#[test]
fn a_span_higher_than_the_picture_fills_its_rows_alone() {
    let fill = |span: Span| {
        let mut memory = [Rgb565::BLACK; 4 * 3];
        let mut picture = Picture::new(&mut memory, Size::new(4, 3)).unwrap();
        let mut pixels = picture.pixels();
        (0..1000).for_each(|_| pixels.fill(span, Rgb565::WHITE).unwrap());
        memory.map(|pixel| i32::from(pixel == Rgb565::WHITE))
    };
    let column = [0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0];
    let high = [(0, i32::MAX), (0, 3), (-5, i32::MAX), (i32::MIN, i32::MAX), (i32::MIN + 3, i32::MAX)];
    let drawn = high.map(|(y, height)| fill(Span { x: 1, y, width: 1, height }));
    // Rows up to −1 + i32::MIN + i32::MAX = −2, and with three more up to 1.
    assert_eq!(drawn, [column, column, column, [0; 12], [0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(fill(Span { x: 1, y: 2, width: 2, height: i32::MAX }), [0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0]);
    assert_eq!(fill(Span { x: 1, y: 3, width: 2, height: i32::MAX }), [0; 12]);
    assert_eq!(fill(Span { x: 1, y: 1, width: 2, height: -5 }), [0; 12]);
}
