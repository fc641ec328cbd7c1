//! Fewer triangles, by `meshopt`.

use crate::weld::Welded;
use crate::Problem;

/// Reduces the mesh to about `wanted` triangles and the vertices that they use. Returns the number of removed triangles, and an
/// estimate of how far the surface moved, in the positions' unit.
#[cfg(feature = "decimate")]
pub(crate) fn decimate(
    mesh: &mut Welded,
    positions: &mut Vec<[f64; 3]>,
    wanted: usize,
) -> Result<(usize, f64), Problem> {
    use crate::grid::extent;
    // meshopt takes f32: relative to the first vertex and within ±1, numbers keep 24 bits of the model.
    let (origin, size) = (positions[0], extent(positions));
    let near = |p: &[f64; 3]| [0, 1, 2].map(|axis| ((p[axis] - origin[axis]) / size) as f32);
    let bytes: Vec<u8> = positions.iter().flat_map(near).flat_map(f32::to_ne_bytes).collect();
    let vertices =
        meshopt::VertexDataAdapter::new(&bytes, 12, 0).map_err(|e| Problem::Format(e.to_string()))?;
    let index = |i: usize| u32::try_from(i).map_err(|_| Problem::TooManyVertices(positions.len()));
    let indices = mesh.faces.iter().flatten().map(|&i| index(i)).collect::<Result<Vec<u32>, _>>()?;
    let mut moved = 0.0;
    let options = meshopt::SimplifyOptions::None;
    let left = meshopt::simplify(&indices, &vertices, 3 * wanted, f32::MAX, options, Some(&mut moved));

    let before = mesh.faces.len();
    let (mut new, mut kept, mut old_of_kept) = (vec![None; positions.len()], Vec::new(), Vec::new());
    let mut renumber = |old: u32| {
        let old = old as usize;
        *new[old].get_or_insert_with(|| {
            kept.push(positions[old]);
            old_of_kept.push(mesh.vertices[old]);
            kept.len() - 1
        })
    };
    mesh.faces = left.chunks_exact(3).map(|f| [f[0], f[1], f[2]].map(&mut renumber)).collect();
    mesh.vertices = old_of_kept;
    mesh.sources = vec![crate::model::NOWHERE; mesh.faces.len()];
    mesh.pieces.clear();
    *positions = kept;
    Ok((before - mesh.faces.len(), f64::from(moved) * size))
}

/// Without the feature: an error that says how to get it.
#[cfg(not(feature = "decimate"))]
pub(crate) fn decimate(_: &mut Welded, _: &mut Vec<[f64; 3]>, _: usize) -> Result<(usize, f64), Problem> {
    Err(Problem::NoDecimation)
}
