//! The options of an import.

use crate::grid::power_of_two;
use crate::Problem;
use std::path::{Path, PathBuf};

/// How a model becomes a mesh. The default is what [`read`](crate::read) does: y up, scaled and ordered as in the file, centred,
/// with all edges and face normals.
///
/// ```
/// use pinhole_import::{Edges, Options};
/// // A part for hidden lines: one unit long, with the edges one sees.
/// let options = Options {
///     fit: Some(1.0),
///     edges: Edges::Feature { degrees: 30.0 },
///     edge_faces: true,
///     ..Options::default()
/// };
/// assert!(!options.vertex_normals);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The axis of the file that points upwards: the model is turned so that it becomes +y. `None` is the axis that such
    /// files mostly have, [`Axis::of_file`]: z of STL, y of OBJ.
    pub up: Option<Axis>,
    /// Reverses all faces, for a file that has them clockwise seen from outside.
    pub flip: bool,
    /// Reverses the faces that are wound otherwise than their neighbours, and then all of each connected part whose faces
    /// point inwards. Closed parts within a closed part may point inwards: they are cavities.
    pub fix_winding: bool,
    /// Adds the back of each face that can be seen from behind: of all connected parts but those that are closed and whose
    /// faces all point outwards. A back is a face with the same corners, reversed, so it is culled and lit as any other, and
    /// the mesh is drawn by the same code. Costs 6 bytes a back, and 6 more for its normal.
    pub two_sided: bool,
    /// Scales the model so that the longest side of its bounding box has this length. Decimation comes after that, and may
    /// leave it shorter; [`Report::extent`](crate::Report::extent) has what is left.
    pub fit: Option<f64>,
    /// The most triangles there may be, after an edge-collapse simplification by
    /// [meshopt](https://docs.rs/meshopt) (Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics",
    /// 1997). Only with the feature `decimate`, which needs a C++ compiler.
    pub decimate: Option<usize>,
    /// What becomes the mesh's origin.
    pub centre: Centre,
    /// Orders faces so that neighbours follow each other (Sander, Nehab and Barczak, "Fast Triangle Reordering for Vertex
    /// Locality and Reduced Overdraw", 2007, section 3), unless the file's order is better, and vertices by first use.
    pub reorder: bool,
    /// The step of the grid, in the mesh's units, a power of two; `None` is the finest that the model fits. Parts of one step lie on
    /// one grid, whatever their centres: corners that they share in the file have equal positions, `vertex · step + offset`.
    pub step: Option<f64>,
    /// The objects and groups of an OBJ file (`o`, `g`) that are imported, by their names; empty for all.
    pub objects: Vec<String>,
    /// Leaves out the colours of an OBJ file's vertices and of an STL file's facets. Otherwise a face whose material has no colour
    /// has the mean of those of its corners, or that of its facet.
    pub materials_only: bool,
    /// Which edges the mesh gets.
    pub edges: Edges,
    /// The two faces beside each edge, which hidden lines and smooth edges need. An edge of more faces is then listed once for every two.
    /// Wants `edges`.
    pub edge_faces: bool,
    /// A normal for each face.
    pub normals: bool,
    /// The plane of each face, 2 bytes, by which back faces are culled early: see [`pinhole::Mesh::with_planes`]. Needs
    /// `normals`.
    pub planes: bool,
    /// Orders faces into clusters of 32 that lie close together and are turned alike, and adds planes and clusters, 2.5 bytes a face: what
    /// is out of view or turned away then takes one test a cluster. See [`pinhole::Mesh::with_planes`]. Needs `normals`, and the
    /// feature `clusters`.
    pub clusters: bool,
    /// A normal for each vertex: the mean of its faces' normals, each weighted by the face's angle there (Thürmer and
    /// Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998), so that it does not depend on how a surface was
    /// cut into triangles.
    pub vertex_normals: bool,
    /// The picture that the file's materials name (`map_Kd`), as a palette and texels: see
    /// [`ImportedMesh::picture`](crate::ImportedMesh::picture). `None` reads no picture.
    pub texture: Option<TextureFormat>,
    /// A folder whose files the model may name as its material libraries and pictures. `None` permits those in the model's own
    /// folder and below alone. Symbolic links are followed first, so that none leads out of these folders.
    pub root: Option<PathBuf>,
}

/// The format of a material's picture. Only with the feature `textures`.
///
/// ```
/// use pinhole_import::{Options, TextureFormat};
/// // 16 colours of a display in 16-bit colour: half a byte a texel.
/// let texture = TextureFormat { colors: 16, ..TextureFormat::default() };
/// assert_eq!(texture.color, "embedded_graphics::pixelcolor::Rgb565");
/// let options = Options { texture: Some(texture), ..Options::default() };
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextureFormat {
    /// The most colours of the palette: 2, 4, 16 or 256, of 1, 2, 4 or 8 bits a texel.
    pub colors: usize,
    /// The type of the palette's colours in the Rust source, with its path: a colour type of embedded-graphics of three channels
    /// or of grey. Texels then need no conversion on the display that has this type.
    pub color: String,
    /// Adds mip levels, which take as many bytes as the picture, for `pinhole::texture::MipTexels`: box-filtered means of the file's
    /// levels, not of linear light, as `pinhole::texture::MipPicture` makes them. The picture has at most 128 rows then, and
    /// picture and levels share the palette, which so needs more colours.
    pub mip_levels: bool,
}

impl Default for TextureFormat {
    /// 256 colours, of type `embedded_graphics::pixelcolor::Rgb565`, without mip levels.
    fn default() -> Self {
        Self { colors: 256, color: "embedded_graphics::pixelcolor::Rgb565".into(), mip_levels: false }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            up: None,
            flip: false,
            fix_winding: false,
            two_sided: false,
            fit: None,
            decimate: None,
            centre: Centre::Box,
            step: None,
            objects: Vec::new(),
            materials_only: false,
            reorder: false,
            edges: Edges::All,
            edge_faces: false,
            normals: true,
            planes: false,
            clusters: false,
            vertex_normals: false,
            texture: None,
            root: None,
        }
    }
}

impl Options {
    /// The power of two that is the step, if one is given that a mesh may have.
    pub(crate) fn exponent(&self) -> Option<i8> {
        (-32..=15).find(|&exponent| self.step == Some(power_of_two(exponent)))
    }

    /// Refuses numbers out of range and options that exclude each other.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        let refuse = |is_wrong: bool, what| if is_wrong { Err(Problem::Options(what)) } else { Ok(()) };
        let is_length = |side: f64| side.is_finite() && side > 0.0;
        refuse(!self.fit.is_none_or(is_length), "the length to fit is not a positive number")?;
        let has_no_exponent = self.step.is_some() && self.exponent().is_none();
        refuse(has_no_exponent, "the step is not a power of two from 2^-32 to 2^15")?;
        if let Edges::Feature { degrees } | Edges::CreasesFirst { degrees } = self.edges {
            let is_angle = (0.0..=180.0).contains(&degrees);
            refuse(!is_angle, "the feature angle is not between 0 and 180 degrees")?;
        }
        refuse(self.decimate == Some(0), "no triangles would be left")?;
        if self.clusters && !cfg!(feature = "clusters") {
            return Err(Problem::NoClusters);
        }
        let lack_normals = (self.planes || self.clusters) && !self.normals;
        refuse(lack_normals, "planes belong to the normals of faces: ask for these too")?;
        if let Some(TextureFormat { colors, color, .. }) = &self.texture {
            refuse(!matches!(colors, 2 | 4 | 16 | 256), "a texture has 2, 4, 16 or 256 colours")?;
            refuse(crate::picture::channels(color).is_none(), "the colour type of a texture is none of Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888, Gray2, Gray4, Gray8")?;
        }
        let lack_edges = self.edge_faces && self.edges == Edges::None;
        refuse(lack_edges, "the faces beside edges belong to edges: ask for these too")
    }
}

/// An axis of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// +x.
    X,
    /// +y.
    Y,
    /// +z.
    Z,
    /// −x.
    MinusX,
    /// −y.
    MinusY,
    /// −z.
    MinusZ,
}

impl Axis {
    /// All axes, by the names of `--up`.
    pub const ALL: [(&'static str, Axis); 6] = [
        ("x", Axis::X),
        ("y", Axis::Y),
        ("z", Axis::Z),
        ("-x", Axis::MinusX),
        ("-y", Axis::MinusY),
        ("-z", Axis::MinusZ),
    ];

    /// The axis that points upwards in most files of this extension: z in STL, which CAD programs write, and y in all others.
    pub fn of_file(file: &Path) -> Self {
        match file.extension() {
            Some(extension) if extension.eq_ignore_ascii_case("stl") => Axis::Z,
            _ => Axis::Y,
        }
    }

    /// Turns a point so that this axis becomes +y: about z if it is ±x, about x otherwise. Exact.
    pub fn to_y(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Axis::X => [-y, x, z],
            Axis::Y => [x, y, z],
            Axis::Z => [x, z, -y],
            Axis::MinusX => [y, -x, z],
            Axis::MinusY => [x, -y, -z],
            Axis::MinusZ => [x, -z, y],
        }
    }

    /// Turns a point back: the inverse of [`to_y`](Self::to_y).
    pub(crate) fn turn_back(self, point: [f64; 3]) -> [f64; 3] {
        let inverse = match self {
            Axis::X => Axis::MinusX,
            Axis::MinusX => Axis::X,
            Axis::Z => Axis::MinusZ,
            Axis::MinusZ => Axis::Z,
            Axis::Y | Axis::MinusY => self,
        };
        inverse.to_y(point)
    }
}

/// The point of a model that becomes the origin of its mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Centre {
    /// The centre of the bounding box: the finest grid.
    Box,
    /// The origin of the file: a model far from it gets a coarser grid.
    Origin,
}

/// Which edges a mesh gets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edges {
    /// Each edge of each face.
    All,
    /// Creases and borders only: edges where the angle between the normals of both faces is larger than this, edges of one face, and
    /// edges that are not part of a proper surface (three faces, or two of opposite winding). Angles are measured after quantising.
    Feature {
        /// 0 … 180.
        degrees: f64,
    },
    /// Each edge of each face, first the edges of [`Feature`](Self::Feature) and those between faces of two colours: for faces with smooth
    /// edges, which `pinhole::draw::TransformedMesh::bin_smooth_edges` takes with [`Options::edge_faces`]. Its `is_crease` is
    /// `|edge| edge < MESH_CREASES`: [`ImportedMesh::creases`](crate::ImportedMesh::creases). 0 degrees suit faces in one light each: only
    /// the diagonals of flat surfaces then come later. Smooth shading has a crease where it ends.
    CreasesFirst {
        /// 0 … 180.
        degrees: f64,
    },
    /// None.
    None,
}
