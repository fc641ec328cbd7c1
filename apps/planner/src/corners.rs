//! Texture coordinates that the planner makes. Firmware has the function, too: `firmware::texture`.

use pinhole::Mesh;

/// Texture coordinates of a face's corners in a mesh that has none: the picture is laid on from that of six sides to which the face is
/// turned. Model coordinates are within ±32767, so that none of the signs overflows.
pub(crate) fn corners(mesh: &Mesh<'_>, face: usize) -> [[i16; 2]; 3] {
    let normal = mesh.normals().get(face).copied().unwrap_or_default();
    let [x, y, z] = normal.map(i16::unsigned_abs);
    // v runs down, so that the picture stands upright on the sides.
    mesh.corners_of(face, mesh.vertices()).map(|[px, py, pz]| match (x >= y && x >= z, y >= z) {
        (true, _) => [if normal[0] > 0 { -pz } else { pz }, -py],
        (_, true) => [px, if normal[1] > 0 { pz } else { -pz }],
        _ => [if normal[2] > 0 { px } else { -px }, -py],
    })
}
