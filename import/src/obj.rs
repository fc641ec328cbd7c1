//! OBJ text to triangles and lines: positions, colours of vertices, texture coordinates, and the names of materials.

use crate::beside::Beside;
use crate::materials;
use crate::model::{Model, Places, TextureFaces, NOWHERE};
use crate::polygon::{self, Triangulated};
use crate::text::{self, a_vertex_needs_numbers, before_comment, is_utf16, text, without_end};
use crate::weld::Names;
use crate::{Element, ImportError, Place, Problem, Warning};
use std::borrow::Cow;
use std::ops::Range;

/// Reads OBJ text of a file, which is named in errors, and the material libraries beside it.
pub(crate) fn read(bytes: &[u8], beside: &Beside<'_>) -> Result<Model, ImportError> {
    let (file, options) = (beside.model, beside.options);
    let zero = without_end(bytes).iter().position(|&byte| byte == 0);
    if let Some(byte) = zero.filter(|_| !is_utf16(bytes)) {
        return Err(Problem::NotText { byte }.at(file, None));
    }
    let text = text(bytes);
    let mut read =
        Statements::of(&text, &options.objects).map_err(|(problem, line)| problem.at(file, Some(line)))?;
    if let Some(name) = options.objects.iter().find(|name| !read.names.contains(name)) {
        return Err(Problem::NoSuchObject { name: name.clone(), names: read.names }.at(file, None));
    }
    let mut model = Model { lines: read.lines(), ..Model::default() };
    let mut lines = Vec::new();
    let mut of_materials = Vec::new();
    let mut crossing = Vec::new();
    let mut texture = TextureFaces::default();
    let mut bare_faces = None;
    // The vertices of the model are those that faces use, in the order of their first use.
    let mut numbers = vec![None; read.positions.len()];
    let mut colors = Vec::new();
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
                colors.push(read.colors.get(corner.vertex).copied().flatten());
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
    let own = if options.materials_only { Vec::new() } else { means(&colors, &model.triangles.faces) };
    let of_materials = (&read.materials[..], &of_materials[..]);
    (model.colors, model.pictures, model.files) =
        materials::read(of_materials, own, &read.libraries, beside, &mut model.warnings);
    for (what, (count, line)) in read.left_out {
        model.warnings.push(Warning::LeftOut { what, count, first: Place::Line(line) });
    }
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
    /// The colours of the first positions: up to the last one that has any.
    colors: Vec<Option<[f32; 3]>>,
    /// Texture coordinates, v down.
    coords: Vec<[f64; 2]>,
    /// The first line of a texture coordinate that is none.
    no_coord: Option<usize>,
    faces: Vec<Face>,
    /// The corners of all faces and polylines.
    corners: Vec<Corner>,
    /// The lines of polylines, and their corners.
    polylines: Vec<(u32, Range<usize>)>,
    /// The names of objects and groups.
    names: Vec<String>,
    /// What the model has no place for: how many statements, and the line of the first.
    left_out: Vec<(Element, (usize, usize))>,
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

impl Statements {
    /// Reads all lines. A face may name vertices further down, so its indices are not compared with the number of vertices.
    /// Of objects and groups only those are read that are wanted, all of them if `wanted` is empty.
    fn of(text: &str, wanted: &[String]) -> Result<Self, Refusal> {
        let mut read = Self::default();
        let mut numbers = Names::default();
        let (mut material, mut object) = (None, "");
        let mut names = Names::default();
        let mut is_wanted = wanted.is_empty();
        let mut lines = (1..).zip(text.lines());
        while let Some((number, line)) = lines.next() {
            let line = line.trim_start();
            let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
            match word {
                "v" => {
                    let rest = continued(rest, &mut lines);
                    let (position, color) = position(&rest).map_err(|problem| (problem, number))?;
                    if color.is_some() {
                        read.colors.resize(read.positions.len(), None);
                        read.colors.push(color);
                    }
                    read.positions.push((position, number as u32));
                }
                "o" | "g" => {
                    let name = rest.trim();
                    object = if word == "o" { name } else { object };
                    // A face may be in several groups.
                    let groups = if word == "g" { name } else { "" };
                    let all = || [object, name].into_iter().chain(groups.split_whitespace());
                    is_wanted =
                        wanted.is_empty() || all().any(|name| wanted.iter().any(|other| other == name));
                    for name in all().filter(|name| !name.is_empty()) {
                        if names.insert(name, number).is_none() {
                            read.names.push(name.to_owned());
                        }
                    }
                }
                "vt" => match coord(&continued(rest, &mut lines)) {
                    Some(coord) => read.coords.push(coord),
                    None => _ = read.no_coord.get_or_insert(number),
                },
                "f" if is_wanted => {
                    let corners =
                        read.corners(&continued(rest, &mut lines)).ok_or((Problem::Syntax(FACE), number))?;
                    if corners.is_empty() {
                        return Err((Problem::Syntax("the face has no corners"), number));
                    }
                    let material = material.map(|name| {
                        *numbers.entry(name).or_insert_with_key(|name: &&str| {
                            read.materials.push((*name).to_owned());
                            read.materials.len() - 1
                        })
                    });
                    read.faces.push(Face { line: number as u32, corners, material });
                }
                "l" if is_wanted => match read.corners(&continued(rest, &mut lines)) {
                    Some(corners) => read.polylines.push((number as u32, corners)),
                    None => read.leave_out(Element::Lines, number),
                },
                "p" if is_wanted => read.leave_out(Element::Points, number),
                "curv" | "curv2" | "surf" | "bzp" | "bsp" | "cdc" | "cdp" if is_wanted => {
                    read.leave_out(Element::Curves, number);
                }
                "usemtl" => material = Some(rest.trim()),
                "mtllib" => read.libraries.push(rest.trim().to_owned()),
                _ => {}
            }
        }
        Ok(read)
    }

    /// Adds corners, and returns where they are; or `None` where one of them cannot be understood.
    fn corners(&mut self, text: &str) -> Option<Range<usize>> {
        let first = self.corners.len();
        let above = [self.positions.len(), self.coords.len()];
        for word in text.split_whitespace() {
            self.corners.push(corner(word, above)?);
        }
        Some(first..self.corners.len())
    }

    fn leave_out(&mut self, what: Element, line: usize) {
        let place = self.left_out.partition_point(|(other, _)| *other < what);
        match self.left_out.get_mut(place).filter(|(other, _)| *other == what) {
            Some((_, (count, first))) => (*count, *first) = (*count + 1, line.min(*first)),
            None => self.left_out.insert(place, (what, (1, line))),
        }
    }

    /// The two ends of each line. A line to a vertex that does not exist is left out.
    fn lines(&mut self) -> Vec<[[f64; 3]; 2]> {
        let mut lines = Vec::new();
        for (line, corners) in std::mem::take(&mut self.polylines) {
            let corners = self.corners.get(corners).unwrap_or_default();
            let position = |corner: &Corner| {
                let (position, _) = *self.positions.get(corner.vertex)?;
                position.iter().all(|c| c.is_finite()).then_some(position)
            };
            match corners.iter().map(position).collect::<Option<Vec<_>>>() {
                Some(ends) => lines.extend(ends.windows(2).map(|ends| [ends[0], ends[1]])),
                None => self.leave_out(Element::Lines, line as usize),
            }
        }
        lines
    }

    /// The fault of the texture coordinates, and its first line.
    fn wrong_coords(&self) -> Option<(usize, &'static str)> {
        if let Some(line) = self.no_coord {
            return Some((line, "a texture coordinate needs two numbers"));
        }
        let is_stray = |corner: &Corner| corner.coord.is_some_and(|coord| coord >= self.coords.len());
        let corners = |face: &Face| self.corners.get(face.corners.clone()).unwrap_or_default();
        let mut faces = self.faces.iter().filter(|_| !self.coords.is_empty());
        let face = faces.find(|face| corners(face).iter().any(is_stray))?;
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

/// Three coordinates, which a w divides, or which a colour follows.
fn position(text: &str) -> Result<([f64; 3], Option<[f32; 3]>), Problem> {
    let mut words = text.split_whitespace();
    let number = |word: Option<&str>| word.and_then(text::number).ok_or_else(|| a_vertex_needs_numbers(text));
    let position: [f64; 3] = [number(words.next())?, number(words.next())?, number(words.next())?];
    let rest: Vec<&str> = words.collect();
    match rest[..] {
        [] => Ok((position, None)),
        [w] => match number(Some(w))? {
            0.0 => Err(Problem::Syntax("the w of the vertex is zero")),
            w => Ok((position.map(|c| c / w), None)),
        },
        [r, g, b] => {
            let [r, g, b] = [r, g, b].map(|word| text::number(word).map(|level| level as f32));
            Ok((position, r.zip(g).zip(b).map(|((r, g), b)| [r, g, b])))
        }
        _ => Err(Problem::Syntax("a vertex is x y z, x y z w or x y z r g b")),
    }
}

/// The colour of each face, the mean of those of its corners, of at most 1; or of at most 255, where one is larger than 2: slightly more
/// than 1 is a rounding error, or a light. Nothing where no corner has a colour.
fn means(colors: &[Option<[f32; 3]>], faces: &[[usize; 3]]) -> Vec<Option<[u8; 3]>> {
    let largest = colors.iter().flatten().flatten().copied().reduce(f32::max);
    let Some(largest) = largest else { return Vec::new() };
    let unit = if largest > 2.0 { 1.0 } else { 255.0 };
    let mean = |face: &[usize; 3]| {
        let corners: Vec<[f32; 3]> = face.iter().filter_map(|&vertex| *colors.get(vertex)?).collect();
        let channel = |channel: usize| {
            let sum: f32 = corners.iter().map(|color| color[channel]).sum();
            (sum / corners.len() as f32 * unit).round() as u8 // saturates, and NaN becomes 0
        };
        (!corners.is_empty()).then(|| [0, 1, 2].map(channel))
    };
    faces.iter().map(mean).collect()
}

/// A texture coordinate. The origin of a picture is its upper left corner, so v changes its direction.
fn coord(text: &str) -> Option<[f64; 2]> {
    let mut words = text.split_whitespace();
    let [u, v] = [words.next().and_then(text::number)?, words.next().and_then(text::number)?];
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
