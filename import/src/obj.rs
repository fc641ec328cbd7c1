//! OBJ text to triangles, by `tobj`: positions, faces, texture coordinates, and the names of materials.

use crate::materials;
use crate::model::{Model, Places, TextureFaces};
use crate::text::{a_vertex_needs_numbers, text};
use crate::{ImportError, Place, Problem, Warning};
use std::collections::HashMap;
use std::path::Path;

/// Reads OBJ text; `file` is only named in errors.
pub(crate) fn read(bytes: &[u8], file: &Path, beside: &[(String, Vec<u8>)]) -> Result<Model, ImportError> {
    if let Some(byte) = bytes.iter().position(|&byte| byte == 0) {
        return Err(Problem::NotText { byte }.at(file, None));
    }
    let whole = text(bytes);
    let mut kept = what_a_mesh_uses(&whole, true);
    let mut model = Model::default();
    let mut loaded = load(&kept.text);
    if let Err((Problem::Syntax(problem @ (TEXTURE | TEXTURE_INDEX)), line)) = loaded {
        // The mesh needs no texture coordinates.
        model.warnings.push(Warning::TextureCoords { problem, line });
        kept = what_a_mesh_uses(&whole, false);
        loaded = load(&kept.text);
    }
    let Kept { text, face_lines, materials, libraries, bare_faces } = kept;
    let models = loaded.map_err(|(problem, line)| problem.at(file, line))?;
    let lines_of_faces = face_lines.len();
    let mut lines = Vec::new();
    let mut of_materials = Vec::new();
    let mut faces_of_lines = face_lines.into_iter().zip(materials.of_faces);
    let mut concave = Vec::new();
    let mut texture = TextureFaces::default();
    for tobj::Model { mesh, .. } in models {
        let first = model.triangles.positions.len();
        let first_coord = texture.coords.len();
        // v changes its direction: the origin of a picture is its upper left corner.
        texture.coords.extend(mesh.texcoords.chunks_exact(2).map(|uv| [uv[0], 1.0 - uv[1]]));
        let mut texture_indices = mesh.texcoord_indices.iter().map(|&i| first_coord + i as usize);
        model.triangles.positions.extend(mesh.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]]));
        let mut indices = mesh.indices.iter().map(|&i| first + i as usize);
        // If all faces are triangles, tobj gives no list of their numbers of corners.
        let triangles =
            std::iter::repeat_n(3, mesh.indices.len() / 3 * usize::from(mesh.face_arities.is_empty()));
        for corners in mesh.face_arities.iter().copied().chain(triangles) {
            let (line, material) = faces_of_lines.next().unwrap_or_default();
            let coords: Vec<usize> = texture_indices.by_ref().take(corners as usize).collect();
            let polygon: Vec<usize> = indices.by_ref().take(corners as usize).collect();
            let before = model.triangles.faces.len();
            match polygon[..] {
                [] => {
                    let problem = Problem::Syntax("the face has no corners");
                    return Err(problem.at(file, Some(line as usize)));
                }
                // No area: dropped, and counted, as such.
                [a] => model.triangles.faces.push([a; 3]),
                [a, b] => model.triangles.faces.push([a, b, b]),
                [a, ..] => {
                    model.triangles.faces.extend(polygon[1..].windows(2).map(|side| [a, side[0], side[1]]));
                }
            }
            let fan = &model.triangles.faces[before..];
            if fan.len() > 1 && overlaps(fan, &model.triangles.positions) {
                concave.push(line);
            }
            lines.extend(std::iter::repeat_n(line, fan.len()));
            of_materials.extend(std::iter::repeat_n(material, fan.len()));
            // Of a face with an area; others are dropped.
            let corner = |i: usize| coords.get(i).copied().unwrap_or_default();
            texture.faces.extend((0..fan.len()).map(|i| [corner(0), corner(i + 1), corner(i + 2)]));
        }
    }
    let is_used = bare_faces.is_none_or(|(_, count)| count < lines_of_faces);
    if is_used && !texture.coords.is_empty() && texture.coords.iter().flatten().all(|c| c.is_finite()) {
        if let Some((line, count)) = bare_faces {
            model.warnings.push(Warning::BareFaces { count, first: Place::Line(line as usize) });
        }
        model.texture = Some(texture);
    }
    if model.triangles.positions.iter().flatten().any(|c| !c.is_finite()) {
        let line =
            line_of(&text, |words, _| words[0] == "v" && words[1..].iter().take(3).any(|w| !is_finite(w)));
        return Err(Problem::NotFinite.at(file, line));
    }
    if let Some(&line) = concave.iter().min() {
        model.warnings.push(Warning::Concave { count: concave.len(), first: Place::Line(line as usize) });
    }
    (model.colors, model.pictures) =
        materials::read(&materials.names, of_materials, &libraries, (file, beside), &mut model.warnings);
    model.file = file.to_path_buf();
    model.libraries = libraries.iter().filter_map(|name| materials::find(name, file)).collect();
    model.places = Places::Lines(lines);
    Ok(model)
}

const TEXTURE: &str = "a texture coordinate needs two numbers";
const TEXTURE_INDEX: &str = "a face names a texture coordinate that does not exist";

/// The polygons of the text, or what is wrong with it and in which line.
fn load(text: &str) -> Result<Vec<tobj::Model>, (Problem, Option<usize>)> {
    let mut rest = text.as_bytes();
    let options = tobj::LoadOptions::default();
    let loaded = tobj::load_obj_buf(&mut rest, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    loaded.map(|(models, _)| models).map_err(|error| {
        // tobj reads line by line and stops at the one it does not understand.
        let read_text = &text[..text.len() - rest.len()];
        let read = Some(read_text.lines().count());
        match error {
            tobj::LoadError::PositionParseError => {
                (a_vertex_needs_numbers(read_text.lines().last().unwrap_or_default()), read)
            }
            tobj::LoadError::ScalingByZeroError => (Problem::Syntax("the w of the vertex is zero"), read),
            tobj::LoadError::ColorParseError => {
                (Problem::Syntax("a vertex is x y z, x y z w or x y z r g b"), read)
            }
            tobj::LoadError::FaceParseError => {
                (Problem::Syntax("a face is a list of indices v, v/vt, v//vn or v/vt/vn"), read)
            }
            tobj::LoadError::FaceVertexOutOfBounds => (Problem::NoSuchVertex, line_of_stray_index(text)),
            tobj::LoadError::TexcoordParseError => (Problem::Syntax(TEXTURE), read),
            tobj::LoadError::FaceTexCoordOutOfBounds => (Problem::Syntax(TEXTURE_INDEX), None),
            _ => (Problem::Syntax("is not an OBJ file"), None),
        }
    })
}

/// The parts of the text that a mesh uses.
struct Kept {
    text: String,
    /// The number of each face's line.
    face_lines: Vec<u32>,
    materials: Materials,
    /// The material libraries, as they are named.
    libraries: Vec<String>,
    /// The first line of a face with a corner without a texture coordinate, and how many such faces there are.
    bare_faces: Option<(u32, usize)>,
}

/// The materials that faces use.
#[derive(Default)]
struct Materials {
    names: Vec<String>,
    /// For each face the material, if it has one.
    of_faces: Vec<Option<usize>>,
}

/// The text with all lines emptied but vertices, faces and, if wanted, texture coordinates, and vertices without colours; what a
/// line continues on the next, by a backslash at its end, stands in the first.
///
/// What a mesh does not use cannot be wrong then (a colour on some vertices only, a normal's index out of range), and the
/// objects and groups of a file are one mesh.
fn what_a_mesh_uses(text: &str, with_texture: bool) -> Kept {
    let mut kept = Kept {
        text: String::with_capacity(text.len() + 1),
        face_lines: Vec::new(),
        materials: Materials::default(),
        libraries: Vec::new(),
        bare_faces: None,
    };
    let mut numbers = HashMap::new();
    let mut material = None;
    let mut lines = (1..).zip(text.lines());
    while let Some((number, line)) = lines.next() {
        let line = line.split('#').next().unwrap_or_default(); // without what is a comment
        let word = line.split_whitespace().next().unwrap_or_default();
        let rest = || line.trim_start().strip_prefix(word).unwrap_or_default().trim().to_string();
        let mut added = 0;
        match word {
            "usemtl" => {
                let names = &mut kept.materials.names;
                material = Some(*numbers.entry(rest()).or_insert_with_key(|name| {
                    names.push(name.clone());
                    names.len() - 1
                }));
            }
            "mtllib" => kept.libraries.push(rest()),
            "f" | "v" | "vt" if word != "vt" || with_texture => {
                let mut whole = line.trim_end().to_string();
                while whole.ends_with('\\') {
                    whole.pop();
                    let Some((_, next)) = lines.next() else { break };
                    whole.push(' ');
                    whole.push_str(next.split('#').next().unwrap_or_default().trim());
                    added += 1;
                }
                if word == "f" {
                    kept.face_lines.push(number);
                    kept.materials.of_faces.push(material);
                    let is_bare =
                        |corner: &str| corner.split('/').nth(1).is_none_or(|coord| coord.is_empty());
                    if whole.split_whitespace().skip(1).any(is_bare) {
                        kept.bare_faces.get_or_insert((number, 0)).1 += 1;
                    }
                }
                if word == "v" && whole.split_whitespace().count() == 7 {
                    let position: Vec<&str> = whole.split_whitespace().take(4).collect();
                    kept.text.push_str(&position.join(" "));
                } else {
                    kept.text.push_str(&whole);
                }
            }
            _ => {}
        }
        kept.text.extend(std::iter::repeat_n('\n', 1 + added));
    }
    kept
}

/// Whether a triangle of a polygon's fan lies against the whole, by its area vector (Newell's normal is their sum): so it
/// overlaps others. A concave polygon whose fan does not is cut rightly.
fn overlaps(fan: &[[usize; 3]], positions: &[[f64; 3]]) -> bool {
    let area = |&[a, b, c]: &[usize; 3]| {
        let side = |to: usize| [0, 1, 2].map(|axis| positions[to][axis] - positions[a][axis]);
        let (p, q) = (side(b), side(c));
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| p[i] * q[j] - p[j] * q[i])
    };
    let areas: Vec<[f64; 3]> = fan.iter().map(area).collect();
    let whole = [0, 1, 2].map(|axis| areas.iter().map(|a| a[axis]).sum::<f64>());
    let dot = |a: &[f64; 3]| a[0] * whole[0] + a[1] * whole[1] + a[2] * whole[2];
    // A corner on a straight side makes a triangle of nothing but rounding.
    areas.iter().any(|a| dot(a) < -1e-9 * dot(&whole))
}

/// The number of the first line whose words (at least one), with the number of vertices before it, meet the condition.
fn line_of(text: &str, mut wanted: impl FnMut(&[&str], usize) -> bool) -> Option<usize> {
    let mut vertices = 0;
    for (number, line) in (1..).zip(text.lines()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if !words.is_empty() && wanted(&words, vertices) {
            return Some(number);
        }
        vertices += usize::from(words.first() == Some(&"v"));
    }
    None
}

/// The line of the first face with a vertex index out of range. A positive index may name a vertex further down.
fn line_of_stray_index(text: &str) -> Option<usize> {
    let is_vertex = |line: &&str| line.split_whitespace().next() == Some("v");
    let all = text.lines().filter(is_vertex).count();
    line_of(text, |words, before| {
        words[0] == "f"
            && words[1..].iter().any(|word| {
                let index = word.split('/').next().and_then(|v| v.parse::<i64>().ok());
                !index.is_some_and(|v| (1..=all as i64).contains(&v) || (-(before as i64)..0).contains(&v))
            })
    })
}

fn is_finite(word: &str) -> bool {
    word.parse::<f64>().is_ok_and(f64::is_finite)
}
