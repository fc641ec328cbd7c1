//! OBJ text to triangles: positions, faces, texture coordinates, and the names of materials.

use crate::beside::Beside;
use crate::materials;
use crate::model::{Model, Places, TextureFaces};
use crate::polygon::{self, Triangulated};
use crate::text::{a_vertex_needs_numbers, before_comment, is_utf16, text, without_end};
use crate::{ImportError, Place, Problem, Warning};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// Reads OBJ text of a file, which is named in errors, and the material libraries beside it.
pub(crate) fn read(bytes: &[u8], beside: &Beside<'_>) -> Result<Model, ImportError> {
    let file = beside.model;
    let zero = without_end(bytes).iter().position(|&byte| byte == 0);
    if let Some(byte) = zero.filter(|_| !is_utf16(bytes)) {
        return Err(Problem::NotText { byte }.at(file, None));
    }
    let text = text(bytes);
    let read = Statements::of(&text).map_err(|(problem, line)| problem.at(file, Some(line)))?;
    let mut model = Model::default();
    let mut lines = Vec::new();
    let mut of_materials = Vec::new();
    let mut crossing = Vec::new();
    let mut texture = TextureFaces::default();
    let mut bare_faces = None;
    // The vertices of the model are those that faces use, in the order of their first use.
    let mut numbers = vec![None; read.positions.len()];
    let mut last_coord = 0;
    for Face { line, corners, material } in &read.faces {
        let corners = read.corners.get(corners.clone()).unwrap_or_default();
        let mut polygon = Vec::with_capacity(corners.len());
        for corner in corners {
            let (Some(&(position, position_line)), Some(number)) =
                (read.positions.get(corner.vertex), numbers.get_mut(corner.vertex))
            else {
                return Err(Problem::NoSuchVertex.at(file, Some(*line as usize)));
            };
            if !position.iter().all(|c| c.is_finite()) {
                return Err(Problem::NotFinite.at(file, Some(position_line as usize)));
            }
            polygon.push(*number.get_or_insert_with(|| {
                model.triangles.positions.push(position);
                model.triangles.positions.len() - 1
            }));
        }
        if corners.iter().any(|corner| corner.coord.is_none()) {
            bare_faces.get_or_insert((*line, 0)).1 += 1;
        }
        let coords = corners.iter().map(|corner| {
            last_coord = corner.coord.unwrap_or(last_coord);
            last_coord
        });
        let coords: Vec<usize> = coords.collect();
        let positions: Vec<_> = polygon.iter().map(|&vertex| model.triangles.positions[vertex]).collect();
        let Triangulated { triangles, overlap } = polygon::triangulate(&positions);
        if overlap {
            crossing.push(*line);
        }
        lines.extend(std::iter::repeat_n(*line, triangles.len()));
        of_materials.extend(std::iter::repeat_n(*material, triangles.len()));
        model.triangles.faces.extend(triangles.iter().map(|places| places.map(|place| polygon[place])));
        texture.faces.extend(triangles.iter().map(|places| places.map(|place| coords[place])));
    }
    if let Some((line, problem)) = read.wrong_coords() {
        // The mesh needs no texture coordinates.
        model.warnings.push(Warning::TextureCoords { problem, line: Some(line) });
    } else {
        texture.coords = read.coords;
        let is_finite = |&i: &usize| texture.coords.get(i).is_some_and(|c| c.iter().all(|c| c.is_finite()));
        let is_used = bare_faces.is_none_or(|(_, count)| count < read.faces.len());
        if is_used && texture.faces.iter().flatten().all(is_finite) {
            if let Some((line, count)) = bare_faces {
                model.warnings.push(Warning::BareFaces { count, first: Place::Line(line as usize) });
            }
            model.texture = Some(texture);
        }
    }
    if let Some(&line) = crossing.iter().min() {
        model.warnings.push(Warning::Crossing { count: crossing.len(), first: Place::Line(line as usize) });
    }
    (model.colors, model.pictures, model.libraries) =
        materials::read(&read.materials, of_materials, &read.libraries, beside, &mut model.warnings);
    model.places = Places::Lines(lines);
    Ok(model)
}

/// A problem, and the number of its line.
type Refusal = (Problem, usize);

/// What a mesh uses of a text. Other lines are passed over, so nothing in them can be wrong.
#[derive(Default)]
struct Statements {
    /// Positions, and their lines.
    positions: Vec<([f64; 3], u32)>,
    /// Texture coordinates, v down.
    coords: Vec<[f64; 2]>,
    /// The first line of a texture coordinate that is none.
    no_coord: Option<usize>,
    faces: Vec<Face>,
    /// The corners of all faces.
    corners: Vec<Corner>,
    /// The names of the materials, in the order of their first use.
    materials: Vec<String>,
    /// The material libraries, as they are named.
    libraries: Vec<String>,
}

struct Face {
    line: u32,
    corners: Range<usize>,
    /// The number of the material, if the face has one.
    material: Option<usize>,
}

struct Corner {
    /// The number of the position, from 0; `NOWHERE` if it is out of range whatever follows.
    vertex: usize,
    /// The number of the texture coordinate, if the corner names one.
    coord: Option<usize>,
}

const NOWHERE: usize = usize::MAX;

impl Statements {
    /// Reads all lines. A face may name vertices further down, so its indices are not compared with the number of vertices.
    fn of(text: &str) -> Result<Self, Refusal> {
        let mut read = Self::default();
        let mut numbers = HashMap::new();
        let mut material = None;
        let mut lines = (1..).zip(text.lines());
        while let Some((number, line)) = lines.next() {
            let line = line.trim_start();
            let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
            match word {
                "v" => {
                    let rest = continued(rest, &mut lines);
                    let position = position(&rest).map_err(|problem| (problem, number))?;
                    read.positions.push((position, number as u32));
                }
                "vt" => match coord(&continued(rest, &mut lines)) {
                    Some(coord) => read.coords.push(coord),
                    None => _ = read.no_coord.get_or_insert(number),
                },
                "f" => {
                    let first = read.corners.len();
                    let above = [read.positions.len(), read.coords.len()];
                    for word in continued(rest, &mut lines).split_whitespace() {
                        read.corners.push(corner(word, above).ok_or((Problem::Syntax(FACE), number))?);
                    }
                    let corners = first..read.corners.len();
                    if corners.is_empty() {
                        return Err((Problem::Syntax("the face has no corners"), number));
                    }
                    read.faces.push(Face { line: number as u32, corners, material });
                }
                "usemtl" => {
                    material = Some(*numbers.entry(rest.trim()).or_insert_with_key(|name| {
                        read.materials.push((*name).to_owned());
                        read.materials.len() - 1
                    }));
                }
                "mtllib" => read.libraries.push(rest.trim().to_owned()),
                _ => {}
            }
        }
        Ok(read)
    }

    /// What is wrong with the texture coordinates, and the first line where it is.
    fn wrong_coords(&self) -> Option<(usize, &'static str)> {
        if let Some(line) = self.no_coord {
            return Some((line, "a texture coordinate needs two numbers"));
        }
        let is_stray = |corner: &Corner| corner.coord.is_some_and(|coord| coord >= self.coords.len());
        let first = self.corners.iter().position(is_stray).filter(|_| !self.coords.is_empty())?;
        let face = self.faces.iter().find(|face| face.corners.contains(&first))?;
        Some((face.line as usize, "a face names a texture coordinate that does not exist"))
    }
}

const FACE: &str = "a face is a list of indices v, v/vt, v//vn or v/vt/vn";

/// The words of a statement without comments, and with the lines that it continues on, each after a backslash.
fn continued<'t>(first: &'t str, lines: &mut impl Iterator<Item = (usize, &'t str)>) -> Cow<'t, str> {
    let mut words = Cow::from(before_comment(first));
    while let Some(line) = words.strip_suffix('\\') {
        let next = lines.next().map_or("", |(_, next)| before_comment(next));
        words = format!("{line} {next}").into();
    }
    words
}

/// Three coordinates; a w divides them, and a colour is passed over.
fn position(text: &str) -> Result<[f64; 3], Problem> {
    let mut words = text.split_whitespace();
    let number = |word: Option<&str>| {
        word.and_then(|word| word.parse().ok()).ok_or_else(|| a_vertex_needs_numbers(text))
    };
    let position: [f64; 3] = [number(words.next())?, number(words.next())?, number(words.next())?];
    match (words.next(), words.count()) {
        (None, _) | (Some(_), 2) => Ok(position),
        (w, 0) => match number(w)? {
            0.0 => Err(Problem::Syntax("the w of the vertex is zero")),
            w => Ok(position.map(|c| c / w)),
        },
        _ => Err(Problem::Syntax("a vertex is x y z, x y z w or x y z r g b")),
    }
}

/// A texture coordinate. The origin of a picture is its upper left corner, so v changes its direction.
fn coord(text: &str) -> Option<[f64; 2]> {
    let mut words = text.split_whitespace();
    let [u, v]: [f64; 2] = [words.next()?.parse().ok()?, words.next()?.parse().ok()?];
    Some([u, 1.0 - v])
}

/// A corner of a face, below so many positions and texture coordinates. Its normal is passed over.
fn corner(word: &str, above: [usize; 2]) -> Option<Corner> {
    let place = |index: &str, above: usize| {
        let index: i64 = index.parse().ok()?;
        let place = if index < 0 { above as i64 + index } else { index - 1 };
        Some(usize::try_from(place).unwrap_or(NOWHERE))
    };
    let mut indices = word.split('/');
    let vertex = place(indices.next()?, above[0])?;
    let coord = match indices.next() {
        None | Some("" | "0") => None, // some programs write 0 for none
        Some(index) => Some(place(index, above[1])?),
    };
    Some(Corner { vertex, coord })
}
