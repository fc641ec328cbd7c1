//! What `firmware::texture` copies into firmware.

use pinhole::Mesh;

/// Texture coordinates of a face's corners: the picture lies on the mesh from six sides, and a face takes it from that to
/// which it is turned most. Model coordinates are within ±32767: no negation overflows.
pub(crate) fn corners(mesh: &Mesh<'_>, face: usize) -> [[i16; 2]; 3] {
    let normal = mesh.normals().get(face).copied().unwrap_or_default();
    let [x, y, z] = normal.map(i16::unsigned_abs);
    // v runs down: the picture is upright on walls.
    mesh.corners_of(face, mesh.vertices()).map(|[px, py, pz]| match (x >= y && x >= z, y >= z) {
        (true, _) => [if normal[0] > 0 { -pz } else { pz }, -py],
        (_, true) => [px, if normal[1] > 0 { pz } else { -pz }],
        _ => [if normal[2] > 0 { px } else { -px }, -py],
    })
}
