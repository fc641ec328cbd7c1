//! Doubtful parts of a model that could be read, as data.

use crate::beside::Unread;
use crate::remedy::{for_finer_grid, messages, said, Remedy, Said};
use std::fmt;

const DROPPED: &str = "dropped, which changes no picture";

messages! {
    /// Something doubtful about a model that was imported all the same. Its `Display` is one line, which says what to do by the options
    /// of the command line; [`worded`](Self::worded) says it by those of another program.
    ///
    /// `count` is how many there are, `first` where the first is, or its name; `name` is that of a file, as the model or its library has it.
    #[derive(Debug, Clone, PartialEq, Eq)]
    #[allow(missing_docs)] // of fields: said with each variant, or above
    #[non_exhaustive]
    pub enum Warning {
        /// Faces that have no area, or none on the grid, were dropped.
        NoArea { count: usize, first: Place } => [some("faces without area", count, first, DROPPED)]
        /// Faces that are there twice, with one winding, were dropped.
        Duplicates { count: usize, first: Place } => [some("duplicate faces", count, first, DROPPED)]
        /// The grid is too coarse for the shape: `lost` of the `faces`, a tenth or more, have no area on it, or the area of all, `area`
        /// percent of that in the file, changes by a tenth. `finer`: the option that gives a finer grid, if one does.
        Coarse { lost: usize, faces: usize, area: u32, finer: Option<Remedy> } => {
            let what = format!(
                "rounding to a grid of at most 65535 steps a side changes the shape: {lost} of {faces} faces have no area on it, all together {area} % of \
                 that in the file: "
            );
            Said::new(what, for_finer_grid(*finer))
        }
        /// Polygons that cross themselves, so that some of their triangles lie upon others.
        Crossing { count: usize, first: Place } => [
            some("faces that cross themselves", count, first, "their triangles overlap: "), ExportTriangles
        ]
        /// Edges of one face: the rim of a sheet or of a hole.
        OpenEdges { count: usize, first: Place } => [
            some("open edges", count, first, "faces show nothing from behind: "), CloseSurface, TwoSided
        ]
        /// Edges of more than two faces.
        CrowdedEdges { count: usize, first: Place } => [
            some("edges of more than two faces", count, first, "inside and outside are unclear there: "), SeparateBodies, TwoSided
        ]
        /// Edges between faces of opposite winding. `is_one_sided`: no winding is right, as of a Möbius strip.
        TwistedEdges { count: usize, first: Place, is_one_sided: bool } => {
            let (then, remedy) = match is_one_sided {
                true => ("the surface is one-sided, like a Möbius strip: ", TwoSided),
                false => ("some faces will be culled: ", FixWinding),
            };
            Said::new(some("edges between faces of opposite winding", count, first, then), [remedy])
        }
        /// Connected parts, `count` of all `parts`, whose faces point inwards. `is_flipped`: [`Options::flip`](crate::Options::flip)
        /// reversed all faces.
        InsideOut { count: usize, parts: usize, first: Place, is_flipped: bool } => {
            let (outside, remedy, then) = match (count == parts, is_flipped) {
                (true, false) => ("the", Flip, ", unless it is a room seen from inside"),
                (true, true) => ("the", NotFlip, ", unless it is a room seen from inside"),
                (false, false) => ("their", FixWinding, ""),
                (false, true) => ("their", FixWindingNotFlip, ""),
            };
            let outside = format!("{outside} outside shows nothing: ");
            let what = some("parts inside out", format!("{count} of {parts}"), first, &outside);
            Said { then, ..Said::new(what, [remedy]) }
        }
        /// Decimation left so many triangles, more than were wanted.
        DecimatedLess { faces: usize } => ["{faces} triangles are left: the shape allows no fewer"]
        /// Decimation made other faces, which have neither colours nor texture coordinates.
        DecimatedMaterials => ["decimation leaves out colours and texture coordinates"]
        /// An ASCII STL, whose last line this is, has no `endsolid`.
        NoEndsolid { line: usize } => ["no `endsolid` after line {line}: perhaps the file was cut short"]
        /// Bytes after the last triangle of a binary STL.
        BytesAfter { count: u64 } => ["{count} bytes after the last triangle are passed over"]
        /// Materials that are transparent in their library; their faces are opaque.
        Transparent { count: usize, first: String } => ["transparent materials: {count}, the first {first}; their faces are opaque"]
        /// Materials name pictures, and none is wanted ([`Options::texture`](crate::Options::texture)). `has_coords`: the model has texture
        /// coordinates, without which a picture cannot be shown.
        PicturesUnwanted { count: usize, first: String, has_coords: bool } => {
            let what = format!("pictures of materials: {count}, the first {first}; left out");
            match has_coords {
                true => Said::new(what + ": ", [TextureColors(16)]),
                false => Said::new(what + ", as there are no texture coordinates", []),
            }
        }
        /// Something that a mesh has no place for was left out.
        LeftOut { what: Element, count: usize, first: Place } => {
            let (what, then, remedies) = match what {
                Element::Points => ("points (`p`)", "left out", vec![]),
                Element::Lines => ("lines (`l`) to vertices that do not exist", "left out: ", vec![ExportAgain]),
                Element::Curves => ("curves and surfaces", "left out: ", vec![ExportMesh]),
                Element::CoveredColors => {
                    ("faces with a material and colours of vertices", "these colours are left out", vec![])
                }
                Element::TextColors => ("`color` lines", "left out", vec![]),
            };
            Said::new(some(what, count, first, then), remedies)
        }
        /// Faces have materials, but no library of materials is named.
        NoLibrary => ["no material library (mtllib): faces have no colours"]
        /// A material library is not read.
        Library { name: String, why: Unread } => {
            Said::new(format!("material library {name}: {why}; its materials are grey: "), why.remedies())
        }
        /// Lines of a material library that cannot be understood were passed over: `first` is the number of the first, from 1, and
        /// `problem` is why that one cannot be understood.
        LibraryLines { name: String, count: usize, first: usize, problem: &'static str } => [
            "material library {name}: lines passed over: {count}, the first at line {first}: {problem}"
        ]
        /// Materials that no library has.
        UnknownMaterials { count: usize, first: String } => [
            "materials that no library has: {count}, the first {first}; their faces are grey"
        ]
        /// More colours than a palette holds, of which `kept` are in it.
        Colors { count: usize, kept: usize } => [
            "colours: {count}, of which a palette holds {kept}; the others become the nearest of these"
        ]
        /// Texture coordinates that cannot be understood, because of `problem`, the first in `line`, were left out.
        TextureCoords { problem: &'static str, line: Option<usize> } => [
            "no texture coordinates: {problem}; they are left out: ", ExportAgain
        ]
        /// Texture coordinates too far from the picture were left out.
        TextureCoordsFar => ["no texture coordinates: they go beyond 32767 sides of the texture: ", RepeatLess]
        /// More texture coordinates than a mesh has, 65 536, were left out.
        TextureCoordsMany => ["no texture coordinates: there are more than 65536: ", Decimate(MOST_FACES), SplitModel]
        /// Faces without texture coordinates, in a file where others have some.
        BareFaces { count: usize, first: Place } => [
            some("faces without texture coordinates", count, first, "they get those of the face before")
        ]
        /// A picture is wanted, but the model has no texture coordinates.
        NoTextureCoords => ["no texture: the model has no texture coordinates"]
        /// A picture is wanted, but no material names one.
        NoPicture => ["no texture: no material names a picture (map_Kd)"]
        /// Materials name several pictures, of which one is `written`; `other` is another one.
        Pictures { count: usize, written: String, other: String } => [
            "pictures of materials: {count}; only {written} is written, and faces that should show {other} show it, too: ", OnePicture
        ]
        /// Faces whose material names no picture, where others do.
        NoPictureFaces { count: usize } => ["faces whose material names no picture: {count}; ", DrawColors]
        /// The picture that the materials name is not read.
        PictureUnread { name: String, why: Unread } => { Said::new(format!("no texture: picture {name} {why}: "), why.remedies()) }
        /// The picture cannot be understood.
        Picture { name: String, problem: String } => ["no texture: picture {name}: {problem}"]
        /// The picture has transparent pixels, which were written as if they were opaque.
        PictureTransparent { name: String, pixels: usize } => [
            "picture {name}: transparent pixels: {pixels}, written as if they were not"
        ]
        /// The picture was resized: columns and rows of the file, and of the texture.
        PictureResized { name: String, from: [usize; 2], to: [usize; 2] } => {
            let ([from_x, from_y], [x, y]) = (from, to);
            let what = format!("{from_x} x {from_y} pixels become {x} x {y}, as a side is a power of two of 8 to 256, with mip levels of at most 128 rows");
            Said::new(format!("picture {name}: {what}: "), [ResizePicture])
        }
        /// The picture has `count` colours, more than the `kept` ones of the palette; `error` is the largest difference of a channel, of 255.
        PictureColors { name: String, count: usize, kept: usize, error: u8 } => [
            "picture {name}: {count} colours become {kept}, a channel off by up to {error} of 255"
        ]
        /// The mesh takes more flash than many microcontrollers have: so many bytes, `edges` of them for edges. The rest would fit with so
        /// many triangles as `faces`.
        Flash { bytes: usize, edges: usize, faces: usize } => {
            let what = format!("size in flash: {bytes} bytes, {edges} of them for edges; if that is too much, ");
            let without_edges = (*edges > 0).then_some(NoEdges);
            Said::new(what, without_edges.into_iter().chain([Decimate(*faces)]).collect::<Vec<_>>())
        }
        /// The picture, of so many columns and rows, takes more flash than a small microcontroller can spare.
        PictureFlash { size: [usize; 2], bytes: usize } => {
            let [width, height] = size;
            let what = format!("texture of {width} x {height} texels: {bytes} bytes of flash; if that is too much, ");
            Said::new(what, [ReducePicture, TextureColors(16)])
        }
        /// No mesh can hold the model: it can be shown, but not be put into firmware. `problem` is why, with the punctuation that
        /// `remedies`, which are alternatives, follow.
        NotForFirmware { problem: String, remedies: Vec<Remedy> } => {
            Said::new(format!("not for firmware: {problem}"), remedies.clone())
        }
        /// The longest side, in model units, is longer than all coordinates of the world, 65 536.
        Extent { extent: u64 } => ["extent {extent}, above a world's 65536 units: ", OtherUnit, Fit]
        /// More faces than can be drawn in bands.
        ManyFaces { count: usize } => [
            "{count} faces, more than the 65535 that can be drawn in bands: ", Decimate(MOST_FACES), SplitModel
        ]
    }
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
