//! The way from triangles to a mesh.

use crate::edges::Sides;
use crate::grid::{extent, Grid};
use crate::materials::{self, Texture};
use crate::mesh::{ImportedMesh, Report};
use crate::model::Model;
use crate::normals::{cross, of_vertices, on_one_line, unit};
use crate::parts::Parts;
use crate::picture;
use crate::weld::{weld, Key, Numbered};
use crate::{clusters, decimate, order, Axis, Edges, Options, Preview, Problem, Step, Triangles, Warning};

/// Makes a mesh of triangles: welds, centres, quantises, derives edges and normals. Scales and orders nothing: it has the
/// default [`Options`], and y is up.
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
/// [`Problem::NotFinite`], [`Problem::NoFaces`], [`Problem::NoArea`], [`Problem::TooThin`],
/// [`Problem::NoSuchVertex`], [`Problem::TooManyVertices`], [`Problem::Extent`].
pub fn quantise(model: &Triangles) -> Result<ImportedMesh, Problem> {
    let model = Model { triangles: model.clone(), ..Model::default() };
    let made = make(model, Axis::Y, &Options::default(), &mut |_| ())?;
    Ok(ImportedMesh { warnings: made.warnings, ..made.mesh? })
}

/// Makes a mesh of a model as the options say; `up` is the axis of the file that becomes +y. The mesh is without the warnings.
pub(crate) fn make(
    model: Model,
    up: Axis,
    options: &Options,
    begins: &mut dyn FnMut(Step),
) -> Result<Preview, Problem> {
    options.check()?;
    let Model { triangles, places, mut warnings, lines, colors, texture, pictures, files } = model;
    let lines = if options.edges == Edges::None { Vec::new() } else { lines };
    let Triangles { positions: read, faces } = triangles;
    if faces.iter().flatten().any(|&i| i >= read.len()) {
        return Err(Problem::NoSuchVertex);
    }
    if read.iter().flatten().any(|c| !c.is_finite()) {
        return Err(Problem::NotFinite);
    }
    if faces.is_empty() && lines.is_empty() {
        return Err(Problem::NoFaces);
    }

    begins(Step::Weld);
    // Adding 0.0 makes one of the two zeros.
    let bits: Vec<Key> = read.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
    // Triangles without area must not influence the grid either.
    let position = |p: Key| p.map(f64::from_bits);
    let mut exact = weld(&bits, &faces, &position, &|corners| on_one_line(corners.map(position)));
    drop(bits);
    let vertices_read = read.len();
    if exact.faces.is_empty() && lines.is_empty() {
        return Err(Problem::NoArea(faces.len()));
    }
    let used = exact.vertices.iter().map(|&v| read[v]).chain(lines.into_iter().flatten()).collect();
    drop(read);
    let (mut positions, scale) = placed(used, up, options)?;
    let ends_of_lines = positions.split_off(exact.vertices.len());
    if options.flip {
        exact.faces.iter_mut().for_each(reverse);
    }
    let mut decimated = (0, 0.0);
    if let Some(wanted) = options.decimate.filter(|&wanted| wanted < exact.faces.len()) {
        begins(Step::Decimate);
        if options.fix_winding {
            // meshopt takes an edge between faces of opposite winding for a border, and keeps it.
            let grid = Grid::around(&positions, options)?;
            let rounded: Vec<[i16; 3]> = positions.iter().map(|p| grid.round(p)).collect();
            fix_winding(&mut exact.faces, &rounded);
        }
        decimated = decimate::decimate(&mut exact, &mut positions, wanted)?;
        if exact.faces.is_empty() {
            return Err(Problem::Options("decimation to so few triangles leaves none: allow more"));
        }
        if exact.faces.len() > wanted {
            warnings.push(Warning::DecimatedLess { faces: exact.faces.len() });
        }
    }

    begins(Step::Quantise);
    let of_faces = positions.len();
    positions.extend(ends_of_lines);
    let grid = Grid::around(&positions, options)?;
    let rounded: Vec<[i16; 3]> = positions.iter().map(|p| grid.round(p)).collect();
    let (rounded, ends_of_lines, positions) = (&rounded[..of_faces], &rounded[of_faces..], &positions);
    let position = |p: [i16; 3]| p.map(f64::from);
    let keys: Vec<Key> = rounded.iter().map(key).collect();
    let vertex = |key: Key| key.map(|c| c as i16); // that of the key
    let is_flat = |corners: [Key; 3]| cross(corners.map(vertex)) == [0, 0, 0];
    let mut last = weld(&keys, &exact.faces, &|key| position(vertex(key)), &is_flat);
    if last.faces.is_empty() && ends_of_lines.is_empty() {
        return Err(Problem::TooThin { faces: exact.faces.len(), finer: grid.finer });
    }
    let on_grid = exact.faces.iter().map(|face| face.map(|vertex| position(rounded[vertex])));
    let in_file = exact.faces.iter().map(|face| face.map(|vertex| grid.in_steps(&positions[vertex])));
    let area = area(on_grid) / area(in_file);
    let all_rounded = rounded.iter().chain(ends_of_lines);
    let error = positions.iter().zip(all_rounded).map(|(p, r)| grid.error(p, r)).fold(0.0, f64::max);
    let source = |place: usize| exact.sources[place];
    let degenerate: Vec<usize> =
        exact.degenerate.iter().copied().chain(last.degenerate.iter().map(|&face| source(face))).collect();
    let duplicate: Vec<usize> =
        exact.duplicate.iter().copied().chain(last.duplicate.iter().map(|&face| source(face))).collect();
    let mut vertices: Vec<[i16; 3]> = last.vertices.iter().map(|&v| rounded[v]).collect();
    let mut corners = std::mem::take(&mut last.faces);
    // For each face its number after welding.
    let mut numbers: Vec<usize> = (0..corners.len()).collect();

    let mut fetches = [order::fetches(&corners, vertices.len()); 2];
    if options.reorder && vertices.len() <= MOST_VERTICES {
        begins(Step::Order);
        fetches[1] = order::reorder(&mut corners, &mut numbers, &mut vertices);
    }
    let clusters = cfg!(feature = "clusters") && options.clusters;
    if clusters && vertices.len() <= MOST_VERTICES {
        let places = clusters::order(&corners, &vertices);
        order::put(&places, &mut corners, &mut numbers, &mut vertices);
        fetches[1] = order::fetches(&corners, vertices.len());
    }
    let lines = joined(ends_of_lines, &mut vertices);
    let too_many = (vertices.len() > MOST_VERTICES).then_some(Problem::TooManyVertices(vertices.len()));

    begins(Step::Derive);
    let mut sides = Sides::of(&corners);
    let mut parts = Parts::of(&corners, &vertices, &sides);
    let mut reversed = vec![false; corners.len()];
    let mut turned = 0;
    if options.fix_winding {
        for (face, corners) in corners.iter_mut().enumerate().filter(|(face, _)| parts.is_wrong(*face)) {
            reverse(corners);
            reversed[face] = true;
            turned += 1;
        }
        sides.reverse(|face| parts.is_wrong(face));
        parts.set_right();
    }
    let backs = if options.two_sided { parts.seen_from_behind() } else { Vec::new() };
    let place = |face: usize| source(last.sources[numbers[face]]);
    let (topology, faults) = sides.topology(place);

    let least = |list: &[usize]| list.iter().min().map(|&triangle| places.of(triangle));
    let at = |triangle: Option<usize>| triangle.map(|triangle| places.of(triangle));
    let no_area = |first| Warning::NoArea { count: degenerate.len(), first };
    let duplicates = |first| Warning::Duplicates { count: duplicate.len(), first };
    warnings.extend(least(&degenerate).map(no_area));
    warnings.extend(least(&duplicate).map(duplicates));
    let (lost, count) = (last.degenerate.len(), exact.faces.len());
    if count > 0 && (10 * lost >= count || !(0.9..=1.1).contains(&area)) {
        let area = (100.0 * area).round() as u32;
        warnings.push(Warning::Coarse { lost, faces: count, area, finer: grid.finer });
    }
    if !options.two_sided {
        let open = |first| Warning::OpenEdges { count: topology.open, first };
        let crowded = |first| Warning::CrowdedEdges { count: topology.crowded, first };
        let is_one_sided = parts.parts.iter().all(|part| part.is_one_sided == part.is_mixed);
        let twisted = |first| Warning::TwistedEdges { count: topology.twisted, first, is_one_sided };
        let (inside_out, first) = parts.inside_out();
        let inside_out = |first| Warning::InsideOut {
            count: inside_out,
            parts: parts.parts.len(),
            first,
            is_flipped: options.flip,
        };
        warnings.extend(at(faults.open).map(open));
        warnings.extend(at(faults.crowded).map(crowded));
        warnings.extend(at(faults.twisted).map(twisted));
        warnings.extend(at(first.map(place)).map(inside_out));
    }
    let is_whole = decimated.0 == 0; // otherwise there are other triangles than those of the file
    if !is_whole && (colors.is_some() || texture.is_some()) {
        warnings.push(Warning::DecimatedMaterials);
    }
    let (colors, texture) = (colors.filter(|_| is_whole), texture.filter(|_| is_whole));
    let of_mesh = || (0..corners.len()).chain(backs.iter().copied());
    let face_colors = match &colors {
        Some(colors) => of_mesh().map(|face| colors.faces[place(face)]).collect(),
        None => Vec::new(),
    };
    let mut uv: Vec<[[f64; 2]; 3]> = match &texture {
        Some(texture) => {
            let corners_of = |(number, face): (usize, usize)| {
                let mut values =
                    texture.faces[place(face)].map(|i| texture.coords.get(i).copied().unwrap_or_default());
                values = exact.values(last.sources[numbers[face]], values);
                if options.flip {
                    reverse(&mut values);
                }
                values = last.values(numbers[face], values);
                // Reversed as the face is, and once more where it is a back.
                if reversed[face] != (number >= corners.len()) {
                    reverse(&mut values);
                }
                values
            };
            of_mesh().enumerate().map(corners_of).collect()
        }
        None => Vec::new(),
    };
    let texture = materials::texture(&uv);
    let texture = texture.unwrap_or_else(|warning| {
        warnings.push(warning);
        Texture::default()
    });
    let mut picture = None;
    match &options.texture {
        Some(_) if texture.faces.is_empty() => {
            warnings.push(Warning::NoTextureCoords);
        }
        Some(format) => {
            picture = picture::read(&pictures, format, &mut warnings)?;
            for (uv, face) in uv.iter_mut().zip(of_mesh()).filter(|_| picture.is_some()) {
                if pictures.bare.get(place(face)) == Some(&true) {
                    *uv = [[f64::NAN; 2]; 3];
                }
            }
        }
        None => warnings.extend(pictures.names.first().map(|first| Warning::PicturesUnwanted {
            count: pictures.names.len(),
            first: first.clone(),
            has_coords: !texture.faces.is_empty(),
        })),
    }
    let shown = |of: &[[u8; 3]]| match of.is_empty() {
        true => Vec::new(),
        false => face_colors.iter().map(|&color| of[usize::from(color)]).collect(),
    };
    let (palette, emission) =
        colors.map_or_else(Default::default, |colors| (colors.palette, colors.emission));
    let mut triangles = Triangles {
        positions: vertices.iter().map(|v| up.turn_back(grid.position(v).map(|c| c / scale))).collect(),
        faces: corners.clone(),
    };
    let back = |&face: &usize| {
        let mut back = corners[face];
        reverse(&mut back);
        back
    };
    triangles.faces.extend(backs.iter().map(back));
    let made = Preview {
        triangles,
        colors: shown(&palette),
        emission: shown(&emission),
        texture: uv,
        backs: backs.len(),
        up,
        files: files.clone(),
        warnings,
        mesh: Err(Problem::NoFaces), // not made yet
    };
    if let Some(problem) = too_many {
        return Ok(Preview { mesh: Err(problem), ..made });
    }

    let crosses: Vec<_> = corners.iter().map(|f| cross(f.map(|i| vertices[i]))).collect();
    // In range: there are at most 65536 vertices.
    let mut corners: Vec<[u16; 3]> = corners.iter().map(|f| f.map(|i| i as u16)).collect();
    let selected = match sides.select(options, &lines, &crosses, &backs, &face_colors) {
        Ok(selected) => selected,
        Err(problem) => return Ok(Preview { mesh: Err(problem), ..made }),
    };
    let mut normals: Vec<[i16; 3]> =
        if options.normals { crosses.iter().map(|&c| unit(c)).collect() } else { Vec::new() };
    let mut vertex_normals =
        if options.vertex_normals { of_vertices(&vertices, &corners, &crosses) } else { Vec::new() };
    let ends = add_backs(&backs, &mut corners, &mut normals, &mut vertices, &mut vertex_normals);
    if let Err(problem) = ends {
        return Ok(Preview { mesh: Err(problem), ..made });
    }
    let mesh = ImportedMesh {
        vertices,
        exponent: grid.exponent,
        faces: corners,
        edges: selected.edges,
        creases: selected.creases,
        edge_faces: selected.beside,
        normals,
        planes: Vec::new(),
        vertex_normals,
        palette,
        emission,
        face_colors,
        texture_coords: texture.coords,
        texture_faces: texture.faces,
        texture_exponent: texture.exponent,
        picture,
        files,
        offset: grid.centre,
        report: Report {
            vertices_read,
            faces_read: faces.len(),
            welded: exact.welded,
            welded_by_quantising: last.welded,
            degenerate: degenerate.len(),
            duplicate: duplicate.len(),
            cut: exact.cut + last.cut,
            unused: exact.unused + last.unused,
            reversed: turned,
            backs: backs.len(),
            decimated: decimated.0,
            decimation_error: decimated.1,
            scale,
            extent: grid.extent,
            error,
            fetches,
        },
        warnings: Vec::new(),
    };
    let mut planes = if options.planes || clusters { mesh.find_planes() } else { Vec::new() };
    if clusters {
        let clusters = clusters::describe(&mesh.faces, &mesh.vertices, &mesh.normals, &planes);
        planes.extend(clusters.as_flattened());
    }
    let mesh = ImportedMesh { planes, ..mesh };
    let mut warnings = made.warnings;
    warnings.extend(mesh.large());
    warnings.extend(mesh.large_picture());
    warnings.extend(mesh.too_many_for_bands());
    warnings.extend(mesh.larger_than_the_world());
    Ok(Preview { mesh: Ok(mesh), warnings, ..made })
}

/// Twice the area of triangles.
fn area(triangles: impl Iterator<Item = [[f64; 3]; 3]>) -> f64 {
    let area = |[a, b, c]: [[f64; 3]; 3]| {
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let ([ux, uy, uz], [vx, vy, vz]) = (side(b), side(c));
        (uy * vz - uz * vy).hypot(uz * vx - ux * vz).hypot(ux * vy - uy * vx)
    };
    triangles.map(area).sum()
}

/// The key of a vertex.
fn key(vertex: &[i16; 3]) -> Key {
    vertex.map(|c| c as u64) // as many as there are
}

/// The vertices of lines between grid points, each line once, in ascending order; vertices where none is are added.
fn joined(ends: &[[i16; 3]], vertices: &mut Vec<[i16; 3]>) -> Vec<[usize; 2]> {
    if ends.is_empty() {
        return Vec::new();
    }
    let mut numbers: Numbered =
        vertices.iter().enumerate().map(|(number, vertex)| (key(vertex), number)).collect();
    let mut number = |end: [i16; 3]| {
        *numbers.entry(key(&end)).or_insert_with(|| {
            vertices.push(end);
            vertices.len() - 1
        })
    };
    let lines = ends.chunks_exact(2).filter(|ends| ends[0] != ends[1]);
    let lines = lines.map(|ends| [number(ends[0]), number(ends[1])]).map(|[a, b]| [a.min(b), a.max(b)]);
    let mut lines: Vec<_> = lines.collect();
    lines.sort_unstable();
    lines.dedup();
    lines
}

/// The most vertices that indices of `u16` can name.
const MOST_VERTICES: usize = 1 << 16;

/// Turns a triangle over; its first corner stays.
fn reverse<T: Copy>(corners: &mut [T; 3]) {
    let [a, b, c] = *corners;
    *corners = [a, c, b];
}

/// Winds the faces of welded vertices as [`Options::fix_winding`] says.
fn fix_winding(faces: &mut [[usize; 3]], vertices: &[[i16; 3]]) {
    let parts = Parts::of(faces, vertices, &Sides::of(faces));
    for (face, corners) in faces.iter_mut().enumerate() {
        if parts.is_wrong(face) {
            reverse(corners);
        }
    }
}

/// Adds faces a second time, reversed, with their normals. Where vertices have normals, the backs get vertices of their own.
fn add_backs(
    backs: &[usize],
    faces: &mut Vec<[u16; 3]>,
    normals: &mut Vec<[i16; 3]>,
    vertices: &mut Vec<[i16; 3]>,
    vertex_normals: &mut Vec<[i16; 3]>,
) -> Result<(), Problem> {
    let mut of_back: Vec<u16> = (0..=u16::MAX).collect();
    if !vertex_normals.is_empty() {
        let mut is_done = vec![false; vertices.len()];
        for vertex in backs.iter().flat_map(|&face| faces[face]).map(usize::from) {
            if !std::mem::replace(&mut is_done[vertex], true) {
                of_back[vertex] = vertices.len() as u16; // or refused below
                vertices.push(vertices[vertex]);
                vertex_normals.push(vertex_normals[vertex].map(|c| -c)); // from −32767
            }
        }
        if vertices.len() > 1 << 16 {
            return Err(Problem::TooManyVertices(vertices.len()));
        }
    }
    for &face in backs {
        let mut back = faces[face].map(|vertex| of_back[usize::from(vertex)]);
        reverse(&mut back);
        faces.push(back);
        if let Some(normal) = normals.get(face) {
            normals.push(normal.map(|c| -c)); // from −32767
        }
    }
    Ok(())
}

/// The positions, turned and scaled, and the factor of the scale.
fn placed(
    mut positions: Vec<[f64; 3]>,
    up: Axis,
    options: &Options,
) -> Result<(Vec<[f64; 3]>, f64), Problem> {
    let scale = options.fit.map_or(1.0, |side| side / extent(&positions));
    for position in &mut positions {
        *position = up.to_y(*position).map(|c| c * scale);
    }
    if scale == 0.0 || positions.iter().flatten().any(|c| !c.is_finite()) {
        return Err(Problem::Options("the length to fit and the model's are too far apart"));
    }
    Ok((positions, scale))
}
