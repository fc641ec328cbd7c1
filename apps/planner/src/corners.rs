//! Texture coordinates that the planner computes. `firmware::texture` copies this function into the firmware.

use pinhole::Mesh;

/// Texture coordinates of a face's corners in a mesh that has none: the picture is projected onto the mesh from six sides, and a
/// face takes it from the side to which it is turned most. Model coordinates are within ±32767, so that no negation overflows.
pub(crate) fn corners(mesh: &Mesh<'_>, face: usize) -> [[i16; 2]; 3] {
    let normal = mesh.normals().get(face).copied().unwrap_or_default();
    let [x, y, z] = normal.map(i16::unsigned_abs);
    // v runs down, so that the picture is upright on the four walls.
    mesh.corners_of(face, mesh.vertices()).map(|[px, py, pz]| match (x >= y && x >= z, y >= z) {
        (true, _) => [if normal[0] > 0 { -pz } else { pz }, -py],
        (_, true) => [px, if normal[1] > 0 { pz } else { -pz }],
        _ => [if normal[2] > 0 { px } else { -px }, -py],
    })
}
