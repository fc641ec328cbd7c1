//! Doubtful parts of a model that could be read, as data.

use crate::beside::Unread;
use crate::remedy::{Remedy, Said};
use std::fmt;

/// Something doubtful about a model that was imported all the same. Its `Display` is one line, which says what to do by the options
/// of the command line; [`worded`](Self::worded) says it by those of another program.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Warning {
    /// Faces that have no area, or none on the grid, were dropped.
    NoArea {
        /// How many.
        count: usize,
        /// The first.
        first: Place,
    },
    /// Faces that are there twice, with one winding, were dropped.
    Duplicates {
        /// How many.
        count: usize,
        /// The first.
        first: Place,
    },
    /// The grid is too coarse for the shape: a tenth of the faces have no area on it, or the area changes by a tenth.
    Coarse {
        /// How many faces have no area on the grid.
        lost: usize,
        /// How many have one in the file.
        faces: usize,
        /// The area on the grid in percent of that in the file.
        area: u32,
    },
    /// Polygons that cross themselves, so that some of their triangles lie upon others.
    Crossing {
        /// How many.
        count: usize,
        /// The first.
        first: Place,
    },
    /// Edges of one face: the rim of a sheet or of a hole.
    OpenEdges {
        /// How many.
        count: usize,
        /// The face of the first.
        first: Place,
    },
    /// Edges of more than two faces.
    CrowdedEdges {
        /// How many.
        count: usize,
        /// A face of the first.
        first: Place,
    },
    /// Edges between faces of opposite winding.
    TwistedEdges {
        /// How many.
        count: usize,
        /// A face of the first.
        first: Place,
        /// Whether no winding is right, as of a Möbius strip.
        is_one_sided: bool,
    },
    /// Connected parts whose faces point inwards.
    InsideOut {
        /// How many.
        count: usize,
        /// Of how many parts.
        parts: usize,
        /// A face of the first.
        first: Place,
        /// Whether [`Options::flip`](crate::Options::flip) reversed all faces.
        is_flipped: bool,
    },
    /// Decimation left more triangles than were wanted.
    DecimatedLess {
        /// How many are left.
        faces: usize,
    },
    /// Decimation made other faces, which have neither colours nor texture coordinates.
    DecimatedMaterials,
    /// An ASCII STL has no `endsolid`.
    NoEndsolid {
        /// Its last line.
        line: usize,
    },
    /// Bytes after the last triangle of a binary STL.
    BytesAfter {
        /// How many.
        count: u64,
    },
    /// Materials that are transparent in their library; their faces are opaque.
    Transparent {
        /// How many.
        count: usize,
        /// The name of the first.
        first: String,
    },
    /// Materials name pictures, and none is wanted ([`Options::texture`](crate::Options::texture)).
    PicturesUnwanted {
        /// How many.
        count: usize,
        /// The first.
        first: String,
        /// Whether the model has texture coordinates, without which a picture cannot be shown.
        has_coords: bool,
    },
    /// Something that a mesh has no place for was left out.
    LeftOut {
        /// What.
        what: Element,
        /// How many.
        count: usize,
        /// The first.
        first: Place,
    },
    /// Faces have materials, but no library of materials is named.
    NoLibrary,
    /// A material library is not read.
    Library {
        /// Its name in the model.
        name: String,
        /// Why.
        why: Unread,
    },
    /// Lines of a material library that cannot be understood were passed over.
    LibraryLines {
        /// Its name in the model.
        name: String,
        /// How many.
        count: usize,
        /// The first, counted from 1.
        first: usize,
        /// Why the first cannot be understood.
        problem: &'static str,
    },
    /// Materials that no library has.
    UnknownMaterials {
        /// How many.
        count: usize,
        /// The name of the first.
        first: String,
    },
    /// More colours than a palette holds.
    Colors {
        /// How many.
        count: usize,
        /// How many the palette holds.
        kept: usize,
    },
    /// Texture coordinates that cannot be understood were left out.
    TextureCoords {
        /// Why.
        problem: &'static str,
        /// The line of the first, counted from 1.
        line: Option<usize>,
    },
    /// Texture coordinates too far from the picture were left out.
    TextureCoordsFar,
    /// More texture coordinates than a mesh has, 65 536, were left out.
    TextureCoordsMany,
    /// Faces without texture coordinates, in a file where others have some.
    BareFaces {
        /// How many.
        count: usize,
        /// The line of the first.
        first: Place,
    },
    /// A picture is wanted, but the model has no texture coordinates.
    NoTextureCoords,
    /// A picture is wanted, but no material names one.
    NoPicture,
    /// Materials name several pictures, of which one is written.
    Pictures {
        /// How many.
        count: usize,
        /// The one that is written.
        written: String,
        /// Another one.
        other: String,
    },
    /// Faces whose material names no picture, where others do.
    NoPictureFaces {
        /// How many.
        count: usize,
    },
    /// The picture that the materials name is not read.
    PictureUnread {
        /// Its name in the library.
        name: String,
        /// Why.
        why: Unread,
    },
    /// The picture cannot be understood.
    Picture {
        /// Its name in the library.
        name: String,
        /// Why.
        problem: String,
    },
    /// The picture has transparent pixels, which were written as if they were opaque.
    PictureTransparent {
        /// Its name in the library.
        name: String,
        /// How many pixels.
        pixels: usize,
    },
    /// The picture was resized.
    PictureResized {
        /// Its name in the library.
        name: String,
        /// Columns and rows of the file.
        from: [usize; 2],
        /// Columns and rows of the texture.
        to: [usize; 2],
    },
    /// The picture has more colours than the palette.
    PictureColors {
        /// Its name in the library.
        name: String,
        /// How many it has.
        count: usize,
        /// How many the palette has.
        kept: usize,
        /// The largest difference of a channel, of 255.
        error: u8,
    },
    /// The mesh takes more flash than many microcontrollers have.
    Flash {
        /// How many bytes.
        bytes: usize,
        /// How many of them are for edges.
        edges: usize,
        /// The number of triangles with which the rest would fit.
        faces: usize,
    },
    /// The picture takes more flash than a small microcontroller can spare.
    PictureFlash {
        /// Columns and rows.
        size: [usize; 2],
        /// How many bytes.
        bytes: usize,
    },
    /// No mesh can hold the model: it can be shown, but not be put into firmware.
    NotForFirmware {
        /// Why, with the punctuation that remedies follow.
        problem: String,
        /// What to do about it: alternatives.
        remedies: Vec<Remedy>,
    },
    /// More faces than can be drawn in bands.
    ManyFaces {
        /// How many.
        count: usize,
    },
}

/// Elements of a file that a mesh has no place for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Element {
    /// Points of an OBJ file (`p`).
    Points,
    /// Lines of an OBJ file (`l`) that cannot be understood, or that name a vertex that does not exist.
    Lines,
    /// Curves and surfaces of an OBJ file (`curv`, `surf` and others).
    Curves,
    /// Colours of the corners of faces whose material has a colour.
    CoveredColors,
    /// Colours of an ASCII STL file (`color`).
    TextColors,
}

/// Where in a file something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// It is not known, or the model comes from no file.
    Unknown,
    /// In the line of this number, counted from 1.
    Line(usize),
    /// In the triangle of this number of a binary STL, counted from 1.
    Triangle(usize),
}

impl Warning {
    /// The line of the file, counted from 1, where it is seen first, if that is known.
    pub fn line(&self) -> Option<usize> {
        match *self {
            Self::NoArea { first: Place::Line(line), .. }
            | Self::Duplicates { first: Place::Line(line), .. }
            | Self::Crossing { first: Place::Line(line), .. }
            | Self::OpenEdges { first: Place::Line(line), .. }
            | Self::CrowdedEdges { first: Place::Line(line), .. }
            | Self::TwistedEdges { first: Place::Line(line), .. }
            | Self::InsideOut { first: Place::Line(line), .. }
            | Self::BareFaces { first: Place::Line(line), .. }
            | Self::LeftOut { first: Place::Line(line), .. }
            | Self::NoEndsolid { line } => Some(line),
            Self::TextureCoords { line, .. } => line,
            _ => None,
        }
    }

    /// What to do about it: alternatives.
    pub fn remedies(&self) -> Vec<Remedy> {
        self.said().remedies
    }

    /// The message in one line, with the remedies in a program's own words: imperatives such as "use --flip".
    pub fn worded(&self, words: impl Fn(Remedy) -> String) -> String {
        self.said().worded(words)
    }

    pub(crate) fn said(&self) -> Said {
        use Remedy as R;
        const DROPPED: &str = "dropped, which changes no picture";
        match self {
            Self::NoArea { count, first } => Said::new(some("faces without area", count, first, DROPPED), []),
            Self::Duplicates { count, first } => Said::new(some("duplicate faces", count, first, DROPPED), []),
            Self::Coarse { lost, faces, area } => Said::new(
                format!(
                    "rounding to a grid of at most 65535 steps along the longest side changes the shape: {lost} of {faces} faces \
                     have no area on it, and the area of all is {area} % of that in the file: "
                ),
                [R::SplitModel, R::LeaveOutFar],
            ),
            Self::Crossing { count, first } => {
                Said::new(some("faces that cross themselves", count, first, "their triangles overlap: "), [R::ExportTriangles])
            }
            Self::OpenEdges { count, first } => Said::new(
                some("open edges", count, first, "faces show nothing from behind: "),
                [R::CloseSurface, R::TwoSided],
            ),
            Self::CrowdedEdges { count, first } => Said::new(
                some("edges of more than two faces", count, first, "inside and outside are unclear there: "),
                [R::SeparateBodies, R::TwoSided],
            ),
            Self::TwistedEdges { count, first, is_one_sided } => {
                let (then, remedy) = match is_one_sided {
                    true => ("the surface is one-sided, like a Möbius strip: ", R::TwoSided),
                    false => ("some faces will be culled: ", R::FixWinding),
                };
                Said::new(some("edges between faces of opposite winding", count, first, then), [remedy])
            }
            Self::InsideOut { count, parts, first, is_flipped } => {
                let (outside, remedy, then) = match (count == parts, is_flipped) {
                    (true, false) => ("the", R::Flip, ", unless it is a room seen from inside"),
                    (true, true) => ("the", R::NotFlip, ", unless it is a room seen from inside"),
                    (false, false) => ("their", R::FixWinding, ""),
                    (false, true) => ("their", R::FixWindingNotFlip, ""),
                };
                let of_parts = format!("{count} of {parts}");
                let what = some("parts inside out", &of_parts, first, &format!("{outside} outside shows nothing: "));
                Said { then, ..Said::new(what, [remedy]) }
            }
            Self::DecimatedLess { faces } => {
                Said::new(format!("{faces} triangles are left: the shape allows no fewer"), [])
            }
            Self::DecimatedMaterials => Said::new(
                "decimation leaves out colours and texture coordinates: their faces are others now",
                [],
            ),
            Self::NoEndsolid { line } => {
                Said::new(format!("no `endsolid` after line {line}: perhaps the file was cut short"), [])
            }
            Self::BytesAfter { count } => {
                Said::new(format!("{count} bytes after the last triangle are passed over"), [])
            }
            Self::Transparent { count, first } => {
                Said::new(format!("transparent materials: {count}, the first {first}; their faces are opaque"), [])
            }
            Self::PicturesUnwanted { count, first, has_coords: false } => Said::new(
                format!("pictures of materials: {count}, the first {first}; left out, as there are no texture coordinates"),
                [],
            ),
            Self::PicturesUnwanted { count, first, .. } => Said::new(
                format!("pictures of materials: {count}, the first {first}; left out: "),
                [R::TextureColors(16)],
            ),
            Self::LeftOut { what, count, first } => {
                let (what, then, remedies) = match what {
                    Element::Points => ("points (`p`)", "left out", vec![]),
                    Element::Lines => ("lines (`l`) to vertices that do not exist", "left out: ", vec![R::ExportAgain]),
                    Element::Curves => ("curves and surfaces", "left out: ", vec![R::ExportMesh]),
                    Element::CoveredColors => {
                        ("faces with a material and colours of vertices", "these colours are left out", vec![])
                    }
                    Element::TextColors => ("`color` lines", "left out", vec![]),
                };
                Said::new(some(what, count, first, then), remedies)
            }
            Self::NoLibrary => Said::new("no material library (mtllib): faces have no colours", []),
            Self::Library { name, why } => {
                Said::new(format!("material library {name}: {why}; its materials are grey: "), why.remedies())
            }
            Self::LibraryLines { name, count, first, problem } => Said::new(
                format!("material library {name}: lines passed over: {count}, the first at line {first}: {problem}"),
                [],
            ),
            Self::UnknownMaterials { count, first } => Said::new(
                format!("materials that no library has: {count}, the first {first}; their faces are grey"),
                [],
            ),
            Self::Colors { count, kept } => Said::new(
                format!("colours: {count}, of which a palette holds {kept}; the others become the nearest of these"),
                [],
            ),
            Self::TextureCoords { problem, .. } => Said::new(
                format!("no texture coordinates: {problem}; they are left out: "),
                [R::ExportAgain],
            ),
            Self::TextureCoordsFar => Said::new(
                "no texture coordinates: they go beyond 32767 sides of the texture: ",
                [R::RepeatLess],
            ),
            Self::TextureCoordsMany => Said::new(
                "no texture coordinates: there are more than 65536: ",
                [R::Decimate(MOST_FACES), R::SplitModel],
            ),
            Self::BareFaces { count, first } => Said::new(
                some("faces without texture coordinates", count, first, "they get those of the face before"),
                [],
            ),
            Self::NoTextureCoords => Said::new("no texture: the model has no texture coordinates", []),
            Self::NoPicture => Said::new("no texture: no material names a picture (map_Kd)", []),
            Self::Pictures { count, written, other } => Said::new(
                format!(
                    "pictures of materials: {count}; only {written} is written, and faces that should show {other} show it, too: "
                ),
                [R::OnePicture],
            ),
            Self::NoPictureFaces { count } => {
                Said::new(format!("faces whose material names no picture: {count}; "), [R::DrawColors])
            }
            Self::PictureUnread { name, why } => {
                Said::new(format!("no texture: picture {name} {why}: "), why.remedies())
            }
            Self::Picture { name, problem } => Said::new(format!("no texture: picture {name}: {problem}"), []),
            Self::PictureTransparent { name, pixels } => Said::new(
                format!("picture {name}: transparent pixels: {pixels}, written as if they were not"),
                [],
            ),
            Self::PictureResized { name, from: [from_x, from_y], to: [x, y] } => Said::new(
                format!(
                    "picture {name}: {from_x} x {from_y} pixels become {x} x {y}, as a side is a power of two of 8 to 256: "
                ),
                [R::ResizePicture],
            ),
            Self::PictureColors { name, count, kept, error } => Said::new(
                format!("picture {name}: {count} colours become {kept}, a channel off by up to {error} of 255"),
                [],
            ),
            Self::Flash { bytes, edges, faces } => {
                let what = format!(
                    "size in flash: {bytes} bytes, {edges} of them for edges; if that is too much, "
                );
                let without_edges = (*edges > 0).then_some(R::NoEdges);
                Said::new(what, without_edges.into_iter().chain([R::Decimate(*faces)]).collect::<Vec<_>>())
            }
            Self::PictureFlash { size: [width, height], bytes } => Said::new(
                format!("texture of {width} x {height} texels: {bytes} bytes of flash; if that is too much, "),
                [R::ReducePicture, R::TextureColors(16)],
            ),
            Self::NotForFirmware { problem, remedies } => {
                Said::new(format!("not for firmware: {problem}"), remedies.clone())
            }
            Self::ManyFaces { count } => Said::new(
                format!("{count} faces, more than the 65535 that can be drawn in bands: "),
                [R::Decimate(MOST_FACES), R::SplitModel],
            ),
        }
    }
}

/// Something of which there are several: how many, where the first is, and what follows from it.
fn some(what: &str, count: impl fmt::Display, first: &Place, then: &str) -> String {
    let place = match first {
        Place::Unknown => String::new(),
        Place::Line(line) => format!(", the first at line {line}"),
        Place::Triangle(number) => format!(", the first at triangle {number}"),
    };
    format!("{what}: {count}{place}; {then}")
}

/// The most triangles that a frame in bands can hold.
pub(crate) const MOST_FACES: usize = u16::MAX as usize;

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.worded(|remedy| remedy.to_string()))
    }
}
