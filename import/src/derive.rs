//! The last stage: edges, normals and planes are derived.

use crate::attributes::Attributes;
use crate::grid::Grid;
use crate::mesh::{ImportedMesh, Report};
use crate::normals::{cross, of_vertices, unit};
use crate::surface::{Surface, MOST_VERTICES};
use crate::winding::Winding;
use crate::{clusters, Options, Problem};

/// The mesh of a surface with the lists that the options ask for; without files and warnings.
pub(crate) fn mesh(
    surface: Surface,
    winding: &Winding,
    Attributes { colors, texture, picture }: Attributes,
    grid: &Grid,
    report: Report,
    options: &Options,
) -> Result<ImportedMesh, Problem> {
    let Surface { mut vertices, mut faces, lines, .. } = surface;
    if vertices.len() > MOST_VERTICES {
        return Err(Problem::TooManyVertices(vertices.len()));
    }
    let crosses: Vec<_> = faces.iter().map(|f| cross(f.map(|i| vertices[i]))).collect();
    let (fronts, backs) = faces.split_at_mut(crosses.len() - winding.backs.len());
    let of_fronts = &crosses[..fronts.len()];
    let selected = winding.sides.select(options, &lines, of_fronts, &winding.backs, &colors.faces)?;
    // A back has the opposite cross product, and so the opposite normal.
    let normals = if options.normals { crosses.iter().map(|&c| unit(c)).collect() } else { Vec::new() };
    let mut vertex_normals = Vec::new();
    if options.vertex_normals {
        vertex_normals = of_vertices(&vertices, fronts, of_fronts);
        separate(backs, &mut vertices, &mut vertex_normals)?;
    }
    // In range: there are at most 65536 vertices.
    let faces: Vec<[u16; 3]> = faces.iter().map(|f| f.map(|i| i as u16)).collect();
    let has_clusters = cfg!(feature = "clusters") && options.clusters;
    let has_planes = options.planes || has_clusters;
    let mut planes = if has_planes { planes_of(&vertices, &faces, &normals) } else { Vec::new() };
    if has_clusters {
        planes.extend(clusters::describe(&faces, &vertices, &normals, &planes).as_flattened());
    }
    Ok(ImportedMesh {
        vertices,
        exponent: grid.exponent,
        faces,
        edges: selected.edges,
        creases: selected.creases,
        edge_faces: selected.beside,
        normals,
        planes,
        vertex_normals,
        palette: colors.palette,
        emission: colors.emission,
        face_colors: colors.faces,
        texture_coords: texture.coords,
        texture_faces: texture.faces,
        texture_exponent: texture.exponent,
        picture,
        files: Vec::new(),
        offset: grid.centre,
        report,
        warnings: Vec::new(),
    })
}

/// Gives backs vertices of their own, whose normals are opposite.
fn separate(
    backs: &mut [[usize; 3]],
    vertices: &mut Vec<[i16; 3]>,
    normals: &mut Vec<[i16; 3]>,
) -> Result<(), Problem> {
    let mut of_backs = vec![None; vertices.len()];
    for [a, c, b] in backs {
        for vertex in [a, b, c] {
            *vertex = *of_backs[*vertex].get_or_insert_with(|| {
                vertices.push(vertices[*vertex]);
                normals.push(normals[*vertex].map(|c| -c)); // from −32767
                vertices.len() - 1
            });
        }
    }
    match vertices.len() {
        0..=MOST_VERTICES => Ok(()),
        count => Err(Problem::TooManyVertices(count)),
    }
}

/// The plane of each face: n·v for its normal n and a vertex v, in 2⁻¹⁴ of the power of two that bounds the coordinates, rounded
/// to nearest. It is what `pinhole::Mesh::face_planes` finds; a build script does without that crate.
fn planes_of(vertices: &[[i16; 3]], faces: &[[u16; 3]], normals: &[[i16; 3]]) -> Vec<i16> {
    let bits = |c: i16| (c ^ (c >> 15)) as u16;
    let bound = vertices.iter().flatten().fold(0, |all, &c| all | bits(c));
    // Brings coordinates to the top of 32 bits: a product with a normal of 2¹⁵ is at most 2⁴⁶.
    let shift = u32::from(bound).leading_zeros() - 1;
    let plane = |(face, normal): (&[u16; 3], &[i16; 3])| {
        let corner = vertices[usize::from(face[0])];
        let along: i64 = corner.iter().zip(normal).map(|(&c, &n)| i64::from(c) * i64::from(n)).sum();
        let rounded = ((along << shift) + (1 << 31)) >> 32;
        rounded.clamp(i64::from(i16::MIN), i64::from(i16::MAX)) as i16
    };
    faces.iter().zip(normals).map(plane).collect()
}
