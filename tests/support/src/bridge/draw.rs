//! Draws scenes with the library onto recorders, in a colour type of the tests.

use super::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use crate::oracle::target::{Recorder, Refused};
use embedded_graphics_core::pixelcolor::raw::RawU16;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{mesh::Coordinate, meshes, prelude::*};

/// A colour that names what was drawn, such as the index of the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shader(pub u16);

impl PixelColor for Shader {
    type Raw = RawU16;
}

/// The cube −1 … 1 in i16: vertex k has x, y, z = ±1 by bits 0, 1, 2.
pub const CUBE: [[i16; 3]; 8] =
    [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]];

/// The faces, counter-clockwise from outside: +x, −x, +y, −y, +z, −z, two each. The ready cube numbers its vertices so, too.
pub const CUBE_FACES: [[u16; 3]; 12] = match meshes::CUBE.faces().first_chunk() {
    Some(faces) => *faces,
    None => panic!("12 faces"),
};
pub const CUBE_EDGES: [[u16; 2]; 12] = match meshes::CUBE.edges().first_chunk() {
    Some(edges) => *edges,
    None => panic!("12 edges"),
};

/// The faces of the cube as seen from inside.
pub fn room_faces() -> [[u16; 3]; 12] {
    CUBE_FACES.map(|[a, b, c]| [a, c, b])
}

/// Draws front faces in mesh order; face k in Shader(k).
pub fn solid<V: Coordinate>(
    instance: &MeshInstance<'_, V>,
    target: &mut Recorder<Shader>,
) -> Result<Statistics, Refused> {
    let mut cache = [ScreenVertex::default(); 64];
    instance.faces(|face| Shader(face as u16)).cached(&mut cache).draw(target)
}

pub fn wireframe(instance: &MeshInstance<'_>, target: &mut Recorder<Shader>) -> Result<Statistics, Refused> {
    let mut cache = [ScreenVertex::default(); 64];
    instance.edges(|_| Shader(7)).cached(&mut cache).draw(target)
}

/// A camera in front of a turned cube, looking down at it.
pub fn cube_camera(viewport: (i32, i32, u32, u32)) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, ONE, 3 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective((1 << 31) / 3, (viewport.2, viewport.3), ONE / 2, 50 * ONE),
        viewport,
    }
}

/// A camera that looks at the plane z = 0, with `units` units to a pixel and the lower left corner at the origin: vertices are exact on
/// the screen. The planes near and far lie `depth` units before and behind the plane.
pub fn flat_camera((width, height): (u32, u32), units: i32, depth: i32) -> CameraBits {
    let [right, top] = [width, height].map(|pixels| pixels as i32 * units * ONE);
    let window = [0, right, 0, top];
    CameraBits::ahead(ProjectionBits::Orthographic(window, -depth * ONE, depth * ONE), (width, height))
}

/// A way to draw a mesh.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    Solid(Cull),
    Depth(Cull),
    Wireframe,
    /// Lines that are tested against the depth of the faces.
    DepthLines,
    HiddenLines,
    Painter,
}

pub const WAYS: [Way; 8] = [
    Way::Solid(Cull::Back),
    Way::Solid(Cull::None),
    Way::Depth(Cull::Back),
    Way::Depth(Cull::None),
    Way::Wireframe,
    Way::DepthLines,
    Way::HiddenLines,
    Way::Painter,
];

/// Draws a mesh in one piece, with depths of the pixels of `area` and a vertex cache of so many entries, onto a target that is not the
/// library's.
pub fn in_one_piece<C: PixelColor>(
    way: Way,
    instance: &MeshInstance<'_>,
    (area, cache): (Rectangle, usize),
    face: &dyn Fn(usize) -> C,
    line: C,
    target: &mut Recorder<C>,
) -> Result<Statistics, Refused> {
    let mut cache = vec![ScreenVertex::EMPTY; cache];
    let mut storage = vec![0; (area.size.width * area.size.height) as usize];
    let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
    if matches!(way, Way::DepthLines | Way::HiddenLines) {
        instance.depth_only(&mut cache, &mut depth);
    }
    match way {
        Way::Wireframe => instance.edges(|_| line).cached(&mut cache).draw(target),
        Way::DepthLines => {
            instance.edges(|_| line).cached(&mut cache).draw(&mut target.depth_tested(&mut depth))
        }
        Way::HiddenLines => {
            instance.edges(|_| line).cached(&mut cache).hidden_line(&mut target.depth_tested(&mut depth))
        }
        Way::Solid(cull) => instance.with_cull(cull).faces(face).cached(&mut cache).draw(target),
        Way::Depth(cull) => {
            let instance = instance.with_cull(cull);
            instance.faces(face).cached(&mut cache).draw(&mut target.depth_tested(&mut depth))
        }
        Way::Painter => {
            let mut painter = Box::new(Painter::<C, 128, 64>::new());
            instance.faces(face).sorted(&mut painter).expect("room");
            painter.draw(target)
        }
    }
}

/// Draws a turned cube in one of the ways onto a target.
pub fn turned_cube(
    way: Way,
    camera: &CameraBits,
    target: &mut Recorder<Shader>,
) -> Result<Statistics, Refused> {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
    let model = ModelBits(vec![Step::Y(1 << 29), Step::X(1 << 28)]).library();
    let instance = camera.library().place(&mesh, &model);
    in_one_piece(way, &instance, (camera.area(), 8), &|face| Shader(face as u16), Shader(7), target)
}
