//! OBJ text to triangles, by `tobj`. Only positions and faces are read.

use crate::{ImportError, Problem, Triangles};
use std::path::Path;

/// Reads OBJ text; `file` is only named in errors.
pub(crate) fn read(text: &[u8], file: &Path) -> Result<Triangles, ImportError> {
    let text = String::from_utf8_lossy(text);
    let text = text.trim_start_matches('\u{feff}');
    let kept = positions_and_faces(text);
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let mut rest = kept.as_bytes();
    let loaded = tobj::load_obj_buf(&mut rest, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    let models = match loaded {
        Ok((models, _)) => models,
        Err(error) => {
            // tobj reads line by line and stops at the one it does not understand.
            let read = kept[..kept.len() - rest.len()].lines().count();
            let (problem, line) = match error {
                tobj::LoadError::PositionParseError => {
                    (Problem::Syntax("a vertex needs three numbers"), Some(read))
                }
                tobj::LoadError::ScalingByZeroError => {
                    (Problem::Syntax("the w of the vertex is zero"), Some(read))
                }
                tobj::LoadError::ColorParseError => {
                    (Problem::Syntax("a vertex is x y z, x y z w or x y z r g b"), Some(read))
                }
                tobj::LoadError::FaceParseError => {
                    (Problem::Syntax("a face is a list of indices v, v/vt, v//vn or v/vt/vn"), Some(read))
                }
                tobj::LoadError::InvalidPolygon => (
                    Problem::Syntax("the face has no corners"),
                    line_of(text, |words, _| words.len() == 1 && words[0] == "f"),
                ),
                tobj::LoadError::FaceVertexOutOfBounds => (Problem::NoSuchVertex, line_of_stray_index(text)),
                _ => (Problem::Syntax("is not an OBJ file"), None),
            };
            return Err(problem.at(file, line));
        }
    };
    let mut triangles = Triangles::default();
    for model in models {
        let first = triangles.positions.len();
        let positions = model.mesh.positions.chunks_exact(3);
        let faces = model.mesh.indices.chunks_exact(3);
        triangles.positions.extend(positions.map(|p| [p[0], p[1], p[2]]));
        triangles.faces.extend(faces.map(|f| [f[0], f[1], f[2]].map(|i| first + i as usize)));
    }
    if triangles.positions.iter().flatten().any(|c| !c.is_finite()) {
        let line =
            line_of(text, |words, _| words[0] == "v" && words[1..].iter().take(3).any(|w| !is_finite(w)));
        return Err(Problem::NotFinite.at(file, line));
    }
    Ok(triangles)
}

/// The text with all lines emptied but vertices and faces, and vertices without colours.
///
/// What a mesh does not use cannot be wrong then (a missing material library, a colour on some vertices only, a texture
/// index out of range), and the objects and groups of a file are one mesh.
fn positions_and_faces(text: &str) -> String {
    let mut kept = String::with_capacity(text.len() + 1);
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or_default(); // without what is a comment
        let mut words = line.split_whitespace();
        match words.next() {
            Some("f") => kept.push_str(line),
            Some("v") if words.clone().count() == 6 => {
                kept.push('v');
                for word in words.take(3) {
                    kept.push(' ');
                    kept.push_str(word);
                }
            }
            Some("v") => kept.push_str(line),
            _ => {}
        }
        kept.push('\n');
    }
    kept
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
