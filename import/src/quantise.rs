//! The way from triangles to a mesh.

use crate::edges::Sides;
use crate::grid::{extent, Grid};
use crate::mesh::{ImportedMesh, Report, Topology};
use crate::model::{Model, Warning};
use crate::normals::{cross, of_vertices, on_one_line, unit};
use crate::weld::weld;
use crate::{decimate, order, Options, Problem, Step, Triangles};

/// Makes a mesh of triangles: welds, centres, quantises, derives edges and normals. Turns, scales and orders nothing: it
/// has the default [`Options`].
///
/// **Error.** Let E be the largest extent and h = E/2 the largest distance of a coordinate from the centre. The exponent
/// is the least with `round(h / 2^exponent) <= 32767`, so one less would have given `h / 2^(exponent-1) >= 32767.5`, that
/// is `2^exponent <= 2h / 32767.5 = E / 32767.5`. Rounding errs by half a step: **E / 65535 for each coordinate**. The
/// centre is first rounded to 2⁻¹⁶ model units, so that an `I16F16` holds exactly what was subtracted; that moves it by
/// at most 2⁻¹⁷ and makes h larger by as much. It is only done where E ≥ 2⁻⁶: the error stays below
/// `(E + 2⁻¹⁶) / 65535 <= E / 65471`, less than E / 65000. (All this up to the 53 bits of `f64`.)
///
/// About the file's origin ([`Centre::Origin`](crate::Centre::Origin)) h is the largest coordinate, and the error below
/// h / 32767.5.
///
/// # Errors
///
/// [`Problem::NotFinite`], [`Problem::NoFaces`], [`Problem::NoArea`], [`Problem::NoSuchVertex`],
/// [`Problem::TooManyVertices`], [`Problem::Extent`].
pub fn quantise(model: &Triangles) -> Result<ImportedMesh, Problem> {
    let model = Model { triangles: model.clone(), ..Model::default() };
    make(model, &Options::default(), &mut |_| ())
}

/// Makes a mesh of a model as the options say.
pub(crate) fn make(
    model: Model,
    options: &Options,
    begins: &mut dyn FnMut(Step),
) -> Result<ImportedMesh, Problem> {
    options.check()?;
    let Model { triangles: Triangles { positions: read, faces }, places, mut warnings } = model;
    if faces.iter().flatten().any(|&i| i >= read.len()) {
        return Err(Problem::NoSuchVertex);
    }
    if read.iter().flatten().any(|c| !c.is_finite()) {
        return Err(Problem::NotFinite);
    }
    if faces.is_empty() {
        return Err(Problem::NoFaces);
    }

    begins(Step::Weld);
    // Adding 0.0 makes one of the two zeros.
    let bits: Vec<_> = read.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
    // What has no area must not decide about the grid either.
    let mut exact = weld(&bits, &faces, |corners| on_one_line(corners.map(|p| p.map(f64::from_bits))));
    drop(bits);
    let vertices_read = read.len();
    if exact.faces.is_empty() {
        return Err(Problem::NoArea(faces.len()));
    }
    let used = exact.vertices.iter().map(|&v| read[v]).collect();
    drop(read);
    let (mut positions, scale) = placed(used, options)?;
    if options.flip {
        for [_, b, c] in &mut exact.faces {
            std::mem::swap(b, c);
        }
    }
    let mut decimated = (0, 0.0);
    if let Some(wanted) = options.decimate.filter(|&wanted| wanted < exact.faces.len()) {
        begins(Step::Decimate);
        decimated = decimate::decimate(&mut exact, &mut positions, wanted)?;
        if exact.faces.is_empty() {
            return Err(Problem::Options("decimation to so few triangles leaves none: allow more"));
        }
        if exact.faces.len() > wanted {
            let message = format!("{} triangles are left: the shape allows no fewer", exact.faces.len());
            warnings.push(Warning { line: None, message });
        }
    }

    begins(Step::Quantise);
    let grid = Grid::around(&positions, options.centre)?;
    let rounded: Vec<[i16; 3]> = positions.iter().map(|p| grid.round(p)).collect();
    let last = weld(&rounded, &exact.faces, |corners| cross(corners) == [0, 0, 0]);
    if last.faces.is_empty() {
        return Err(Problem::NoArea(faces.len()));
    }
    if last.vertices.len() > 1 << 16 {
        return Err(Problem::TooManyVertices(last.vertices.len()));
    }
    let error = positions.iter().zip(&rounded).map(|(p, r)| grid.error(p, r)).fold(0.0, f64::max);
    let source = |place: &usize| exact.sources[*place];
    let merged = |first: &[usize], then: &[usize]| -> Vec<usize> {
        first.iter().copied().chain(then.iter().map(source)).collect()
    };
    let degenerate = merged(&exact.degenerate, &last.degenerate);
    let duplicate = merged(&exact.duplicate, &last.duplicate);
    let mut vertices: Vec<[i16; 3]> = last.vertices.iter().map(|&v| rounded[v]).collect();
    // In range: there are at most 65536 vertices.
    let mut corners: Vec<[u16; 3]> = last.faces.iter().map(|f| f.map(|i| i as u16)).collect();
    let mut sources: Vec<usize> = last.sources.iter().map(source).collect();

    let mut fetches = [order::fetches(&corners, vertices.len()); 2];
    if options.reorder {
        begins(Step::Order);
        fetches[1] = order::reorder(&mut corners, &mut sources, &mut vertices);
    }

    begins(Step::Derive);
    let crosses: Vec<_> = corners.iter().map(|f| cross(f.map(|i| vertices[usize::from(i)]))).collect();
    let sides = Sides::of(&corners);
    let selected = sides.select(options.edges, options.edge_faces, &crosses)?;
    let normals = if options.normals { crosses.iter().map(|&c| unit(c)).collect() } else { Vec::new() };
    let vertex_normals =
        if options.vertex_normals { of_vertices(&vertices, &corners, &crosses) } else { Vec::new() };
    let mesh = ImportedMesh {
        vertices,
        exponent: grid.exponent,
        faces: corners,
        edges: selected.edges,
        edge_faces: selected.beside,
        normals,
        planes: Vec::new(),
        vertex_normals,
        offset: grid.centre,
        report: Report {
            vertices_read,
            faces_read: faces.len(),
            welded: exact.welded,
            welded_by_quantising: last.welded,
            degenerate: degenerate.len(),
            duplicate: duplicate.len(),
            unused: exact.unused + last.unused,
            decimated: decimated.0,
            decimation_error: decimated.1,
            scale,
            extent: grid.extent,
            error,
            fetches,
        },
        warnings: Vec::new(),
    };
    let planes = if options.planes { mesh.find_planes() } else { Vec::new() };

    let mut warn = |count: usize, what: &str, first: Option<usize>| {
        if let Some(first) = first {
            warnings.push(Warning::at(format!("{what}: {count}"), &places, first));
        }
    };
    let least = |places: &[usize]| places.iter().min().copied();
    warn(degenerate.len(), "faces without area dropped", least(&degenerate));
    warn(duplicate.len(), "faces dropped that were there already", least(&duplicate));
    let (topology, faults) = sides.topology(|face| sources[face]);
    warn(topology.open, "edges of one face only (the surface is not closed)", faults.open);
    warn(topology.crowded, "edges of three or more faces (not a surface)", faults.crowded);
    warn(topology.twisted, "edges between faces of opposite winding", faults.twisted);
    if topology == Topology::default() && mesh.volume() < 0.0 {
        let message =
            "the surface is inside out: its faces run clockwise seen from outside (flip turns them)";
        warnings.push(Warning { line: None, message: message.into() });
    }
    Ok(ImportedMesh { planes, warnings, ..mesh })
}

/// The positions turned and scaled, and by what they were scaled.
fn placed(mut positions: Vec<[f64; 3]>, options: &Options) -> Result<(Vec<[f64; 3]>, f64), Problem> {
    let scale = options.fit.map_or(1.0, |side| side / extent(&positions));
    for position in &mut positions {
        *position = options.up.to_y(*position).map(|c| c * scale);
    }
    if scale == 0.0 || positions.iter().flatten().any(|c| !c.is_finite()) {
        return Err(Problem::Options("the length to fit and the model's are too far apart"));
    }
    Ok((positions, scale))
}
