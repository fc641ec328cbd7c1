//! Meshes that need no file.

use crate::choice::place;
use pinhole::{meshes, Mesh};
use pinhole_import::Axis;

/// A mesh of the library, or the triangles of a file.
pub enum Ready {
    /// With y up.
    Mesh(Mesh<'static>),
    /// Vertices and faces of an STL file, with z up.
    Triangles(&'static [[f32; 3]], &'static [[u16; 3]]),
}

// The constants GEAR_VERTICES and GEAR_FACES, made from the templates' model, whose file is four times as large.
include!(concat!(env!("OUT_DIR"), "/gear.rs"));

/// Vertices and faces only: without the edges and normals of the ready meshes, the page is 10 KB smaller.
const fn bare(vertices: &'static [[i16; 3]], exponent: i8, faces: &'static [[u16; 3]]) -> Ready {
    match Mesh::new(vertices, exponent, faces) {
        Ok(mesh) => Ready::Mesh(mesh),
        Err(_) => panic!("faces of these vertices"),
    }
}

macro_rules! bare {
    ($mesh:ident) => {{
        const BARE: Ready = bare(meshes::$mesh.vertices(), meshes::$mesh.exponent(), meshes::$mesh.faces());
        BARE
    }};
}

/// The ready meshes by their names, the usual one first.
pub const READY: [(&str, Ready); 8] = [
    ("gear", Ready::Triangles(&GEAR_VERTICES, &GEAR_FACES)),
    ("torus", bare!(TORUS)),
    ("teapot", bare(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES)),
    ("cube", bare!(CUBE)),
    ("sphere", bare!(SPHERE)),
    ("cylinder", bare!(CYLINDER)),
    ("arrow", bare!(ARROW)),
    ("floor", bare!(GRID)),
];

/// The name by which a choice names the loaded file as its mesh.
pub(crate) const FILE: &str = "file";

/// Checks the name of a mesh.
pub(crate) fn named(name: &str) -> Result<&'static str, String> {
    let names: Vec<_> = READY.iter().map(|(name, _)| *name).chain([FILE]).collect();
    Ok(names[place(&names, name)?])
}

/// The axis that is up in a ready mesh, if its STL file does not imply it.
pub(crate) fn up(name: &str) -> Option<Axis> {
    READY.iter().any(|(other, ready)| *other == name && matches!(ready, Ready::Mesh(_))).then_some(Axis::Y)
}

/// The STL file of a ready mesh, and its name.
pub(crate) fn file(name: &str) -> Option<(String, Vec<u8>)> {
    let (name, ready) = READY.iter().find(|(other, _)| *other == name)?;
    let bytes = match ready {
        Ready::Triangles(vertices, faces) => stl(vertices, faces),
        Ready::Mesh(mesh) => {
            // Coordinates of 16 bits are exact in f32.
            let unit = 2.0f32.powi(mesh.exponent().into());
            let vertices: Vec<_> = mesh.vertices().iter().map(|v| v.map(|c| f32::from(c) * unit)).collect();
            stl(&vertices, mesh.faces())
        }
    };
    Some((format!("{name}.stl"), bytes))
}

/// A binary STL file.
fn stl(vertices: &[[f32; 3]], faces: &[[u16; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((faces.len() as u32).to_le_bytes()); // at most 65 536
    for face in faces {
        bytes.extend([0; 12]); // no normal: readers derive it
        for vertex in face.iter().filter_map(|&index| vertices.get(usize::from(index))) {
            vertex.iter().for_each(|&c| bytes.extend(c.to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}
