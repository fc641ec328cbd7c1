//! Doubtful parts of a model that could be read, as data.

use crate::beside::Unread;
use crate::remedy::{Remedy, Said};
use std::fmt;

/// Something doubtful about a model that was imported all the same. Its `Display` is one line, which says what to do by the options
/// of the command line; [`worded`](Self::worded) says it by those of another program.
///
/// `count` is how many there are, `first` where the first is, or its name; `name` is that of a file, as the model or its library has it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs)] // of fields: said with each variant, or above
#[non_exhaustive]
pub enum Warning {
    /// Faces that have no area, or none on the grid, were dropped.
    NoArea { count: usize, first: Place },
    /// Faces that are there twice, with one winding, were dropped.
    Duplicates { count: usize, first: Place },
    /// The grid is too coarse for the shape: `lost` of the `faces`, a tenth or more, have no area on it, or the area of all, `area`
    /// percent of that in the file, changes by a tenth.
    Coarse { lost: usize, faces: usize, area: u32 },
    /// Polygons that cross themselves, so that some of their triangles lie upon others.
    Crossing { count: usize, first: Place },
    /// Edges of one face: the rim of a sheet or of a hole.
    OpenEdges { count: usize, first: Place },
    /// Edges of more than two faces.
    CrowdedEdges { count: usize, first: Place },
    /// Edges between faces of opposite winding. `is_one_sided`: no winding is right, as of a Möbius strip.
    TwistedEdges { count: usize, first: Place, is_one_sided: bool },
    /// Connected parts, `count` of all `parts`, whose faces point inwards. `is_flipped`: [`Options::flip`](crate::Options::flip)
    /// reversed all faces.
    InsideOut { count: usize, parts: usize, first: Place, is_flipped: bool },
    /// Decimation left so many triangles, more than were wanted.
    DecimatedLess { faces: usize },
    /// Decimation made other faces, which have neither colours nor texture coordinates.
    DecimatedMaterials,
    /// An ASCII STL, whose last line this is, has no `endsolid`.
    NoEndsolid { line: usize },
    /// Bytes after the last triangle of a binary STL.
    BytesAfter { count: u64 },
    /// Materials that are transparent in their library; their faces are opaque.
    Transparent { count: usize, first: String },
    /// Materials name pictures, and none is wanted ([`Options::texture`](crate::Options::texture)). `has_coords`: the model has texture
    /// coordinates, without which a picture cannot be shown.
    PicturesUnwanted { count: usize, first: String, has_coords: bool },
    /// Something that a mesh has no place for was left out.
    LeftOut { what: Element, count: usize, first: Place },
    /// Faces have materials, but no library of materials is named.
    NoLibrary,
    /// A material library is not read.
    Library { name: String, why: Unread },
    /// Lines of a material library that cannot be understood were passed over: `first` is the number of the first, from 1, and
    /// `problem` is why that one cannot be understood.
    LibraryLines { name: String, count: usize, first: usize, problem: &'static str },
    /// Materials that no library has.
    UnknownMaterials { count: usize, first: String },
    /// More colours than a palette holds, of which `kept` are in it.
    Colors { count: usize, kept: usize },
    /// Texture coordinates that cannot be understood, because of `problem`, the first in `line`, were left out.
    TextureCoords { problem: &'static str, line: Option<usize> },
    /// Texture coordinates too far from the picture were left out.
    TextureCoordsFar,
    /// More texture coordinates than a mesh has, 65 536, were left out.
    TextureCoordsMany,
    /// Faces without texture coordinates, in a file where others have some.
    BareFaces { count: usize, first: Place },
    /// A picture is wanted, but the model has no texture coordinates.
    NoTextureCoords,
    /// A picture is wanted, but no material names one.
    NoPicture,
    /// Materials name several pictures, of which one is `written`; `other` is another one.
    Pictures { count: usize, written: String, other: String },
    /// Faces whose material names no picture, where others do.
    NoPictureFaces { count: usize },
    /// The picture that the materials name is not read.
    PictureUnread { name: String, why: Unread },
    /// The picture cannot be understood.
    Picture { name: String, problem: String },
    /// The picture has transparent pixels, which were written as if they were opaque.
    PictureTransparent { name: String, pixels: usize },
    /// The picture was resized: columns and rows of the file, and of the texture.
    PictureResized { name: String, from: [usize; 2], to: [usize; 2] },
    /// The picture has `count` colours, more than the `kept` ones of the palette; `error` is the largest difference of a channel, of 255.
    PictureColors { name: String, count: usize, kept: usize, error: u8 },
    /// The mesh takes more flash than many microcontrollers have: so many bytes, `edges` of them for edges. The rest would fit with so
    /// many triangles as `faces`.
    Flash { bytes: usize, edges: usize, faces: usize },
    /// The picture, of so many columns and rows, takes more flash than a small microcontroller can spare.
    PictureFlash { size: [usize; 2], bytes: usize },
    /// No mesh can hold the model: it can be shown, but not be put into firmware. `problem` is why, with the punctuation that
    /// `remedies`, which are alternatives, follow.
    NotForFirmware { problem: String, remedies: Vec<Remedy> },
    /// More faces than can be drawn in bands.
    ManyFaces { count: usize },
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
        let first = match self {
            Self::NoEndsolid { line } => return Some(*line),
            Self::TextureCoords { line, .. } => return *line,
            Self::NoArea { first, .. } | Self::Duplicates { first, .. } | Self::Crossing { first, .. } => {
                first
            }
            Self::OpenEdges { first, .. } | Self::CrowdedEdges { first, .. } => first,
            Self::TwistedEdges { first, .. } | Self::InsideOut { first, .. } => first,
            Self::BareFaces { first, .. } | Self::LeftOut { first, .. } => first,
            _ => return None,
        };
        match first {
            Place::Line(line) => Some(*line),
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
            Self::NoArea { count, first } => some("faces without area", count, first, DROPPED).into(),
            Self::Duplicates { count, first } => some("duplicate faces", count, first, DROPPED).into(),
            Self::Coarse { lost, faces, area } => Said::new(
                format!(
                    "rounding to a grid of at most 65535 steps along the longest side changes the shape: {lost} of {faces} faces \
                     have no area on it, and the area of all is {area} % of that in the file: "
                ),
                [R::SplitModel, R::LeaveOutFar],
            ),
            Self::Crossing { count, first } => {
                let what = some("faces that cross themselves", count, first, "their triangles overlap: ");
                Said::new(what, [R::ExportTriangles])
            }
            Self::OpenEdges { count, first } => {
                let what = some("open edges", count, first, "faces show nothing from behind: ");
                Said::new(what, [R::CloseSurface, R::TwoSided])
            }
            Self::CrowdedEdges { count, first } => {
                let then = "inside and outside are unclear there: ";
                let what = some("edges of more than two faces", count, first, then);
                Said::new(what, [R::SeparateBodies, R::TwoSided])
            }
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
                let outside = format!("{outside} outside shows nothing: ");
                let what = some("parts inside out", format!("{count} of {parts}"), first, &outside);
                Said { then, ..Said::new(what, [remedy]) }
            }
            Self::DecimatedLess { faces } => {
                format!("{faces} triangles are left: the shape allows no fewer").into()
            }
            Self::DecimatedMaterials => {
                "decimation leaves out colours and texture coordinates: their faces are others now".into()
            }
            Self::NoEndsolid { line } => {
                format!("no `endsolid` after line {line}: perhaps the file was cut short").into()
            }
            Self::BytesAfter { count } => {
                format!("{count} bytes after the last triangle are passed over").into()
            }
            Self::Transparent { count, first } => {
                format!("transparent materials: {count}, the first {first}; their faces are opaque").into()
            }
            Self::PicturesUnwanted { count, first, has_coords } => {
                let what = format!("pictures of materials: {count}, the first {first}; left out");
                match has_coords {
                    true => Said::new(what + ": ", [R::TextureColors(16)]),
                    false => (what + ", as there are no texture coordinates").into(),
                }
            }
            Self::LeftOut { what, count, first } => {
                let (what, then, remedies) = match what {
                    Element::Points => ("points (`p`)", "left out", vec![]),
                    Element::Lines => {
                        ("lines (`l`) to vertices that do not exist", "left out: ", vec![R::ExportAgain])
                    }
                    Element::Curves => ("curves and surfaces", "left out: ", vec![R::ExportMesh]),
                    Element::CoveredColors => {
                        ("faces with a material and colours of vertices", "these colours are left out", vec![])
                    }
                    Element::TextColors => ("`color` lines", "left out", vec![]),
                };
                Said::new(some(what, count, first, then), remedies)
            }
            Self::NoLibrary => "no material library (mtllib): faces have no colours".into(),
            Self::Library { name, why } => {
                let what = format!("material library {name}: {why}; its materials are grey: ");
                Said::new(what, why.remedies())
            }
            Self::LibraryLines { name, count, first, problem } => format!(
                "material library {name}: lines passed over: {count}, the first at line {first}: {problem}"
            )
            .into(),
            Self::UnknownMaterials { count, first } => {
                format!("materials that no library has: {count}, the first {first}; their faces are grey").into()
            }
            Self::Colors { count, kept } => format!(
                "colours: {count}, of which a palette holds {kept}; the others become the nearest of these"
            )
            .into(),
            Self::TextureCoords { problem, .. } => {
                let what = format!("no texture coordinates: {problem}; they are left out: ");
                Said::new(what, [R::ExportAgain])
            }
            Self::TextureCoordsFar => {
                let what = "no texture coordinates: they go beyond 32767 sides of the texture: ";
                Said::new(what, [R::RepeatLess])
            }
            Self::TextureCoordsMany => {
                let what = "no texture coordinates: there are more than 65536: ";
                Said::new(what, [R::Decimate(MOST_FACES), R::SplitModel])
            }
            Self::BareFaces { count, first } => {
                let then = "they get those of the face before";
                some("faces without texture coordinates", count, first, then).into()
            }
            Self::NoTextureCoords => "no texture: the model has no texture coordinates".into(),
            Self::NoPicture => "no texture: no material names a picture (map_Kd)".into(),
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
            Self::Picture { name, problem } => format!("no texture: picture {name}: {problem}").into(),
            Self::PictureTransparent { name, pixels } => {
                format!("picture {name}: transparent pixels: {pixels}, written as if they were not").into()
            }
            Self::PictureResized { name, from: [from_x, from_y], to: [x, y] } => Said::new(
                format!(
                    "picture {name}: {from_x} x {from_y} pixels become {x} x {y}, as a side is a power of two of 8 to 256: "
                ),
                [R::ResizePicture],
            ),
            Self::PictureColors { name, count, kept, error } => {
                format!("picture {name}: {count} colours become {kept}, a channel off by up to {error} of 255").into()
            }
            Self::Flash { bytes, edges, faces } => {
                let what = format!("size in flash: {bytes} bytes, {edges} of them for edges; if that is too much, ");
                let without_edges = (*edges > 0).then_some(R::NoEdges);
                Said::new(what, without_edges.into_iter().chain([R::Decimate(*faces)]).collect::<Vec<_>>())
            }
            Self::PictureFlash { size: [width, height], bytes } => {
                let what =
                    format!("texture of {width} x {height} texels: {bytes} bytes of flash; if that is too much, ");
                Said::new(what, [R::ReducePicture, R::TextureColors(16)])
            }
            Self::NotForFirmware { problem, remedies } => {
                Said::new(format!("not for firmware: {problem}"), remedies.clone())
            }
            Self::ManyFaces { count } => {
                let what = format!("{count} faces, more than the 65535 that can be drawn in bands: ");
                Said::new(what, [R::Decimate(MOST_FACES), R::SplitModel])
            }
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
