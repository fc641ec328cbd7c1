//! The mesh that an import makes, and the report about it.

use crate::edges::Sides;
use crate::exact::Exact;
use crate::grid::power_of_two;
use crate::rounded::Rounded;
use crate::warning::MOST_FACES;
use crate::winding::Winding;
use crate::{IndexedPicture, Warning};
#[cfg(feature = "mesh")]
use pinhole::{
    mesh::{FaceColors, MeshError, TextureCoords},
    Mesh,
};
use std::path::PathBuf;

/// A mesh as `pinhole` draws it, owned, with a report about the import.
///
/// A position in model units is `vertex * 2^exponent + offset`; model units are those of the file, times
/// [`Report::scale`], and turned as [`Options::up`](crate::Options::up) says.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMesh {
    /// The vertices, each position once, within ±32767.
    pub vertices: Vec<[i16; 3]>,
    /// The power of two that is the step of the vertices, in model units.
    pub exponent: i8,
    /// The triangles, counter-clockwise seen from outside if they are so in the file. Indices are `u16`, as
    /// [`pinhole::Mesh`] takes no smaller ones.
    pub faces: Vec<[u16; 3]>,
    /// The edges, the lower index first, in ascending order (creases and borders before all others if
    /// [asked for](crate::Edges::CreasesFirst)); each once, but with `edge_faces` once for every two faces.
    pub edges: Vec<[u16; 2]>,
    /// The number of edges that [come first](crate::Edges::CreasesFirst), as creases and borders; or nothing.
    pub creases: Option<usize>,
    /// The two faces beside each edge, [`Mesh::NO_FACE`] for one that is not there; or nothing.
    pub edge_faces: Vec<[u16; 2]>,
    /// The unit normal of each face, 32767 = 1, computed from the quantised vertices; it points to where the face is
    /// seen counter-clockwise. Or nothing.
    pub normals: Vec<[i16; 3]>,
    /// Where the plane of each face lies along its normal, as [`Mesh::face_planes`] finds it, and then eight numbers for each of the
    /// [clusters](crate::Options::clusters); or nothing.
    pub planes: Vec<i16>,
    /// The unit normal of each vertex, likewise; or nothing.
    pub vertex_normals: Vec<[i16; 3]>,
    /// The colours of faces, at most 256, `[red, green, blue]`; or nothing, where the file has no materials.
    pub palette: Vec<[u8; 3]>,
    /// The light that a face of each colour of the palette emits, black for none; or nothing, where no face emits any.
    pub emission: Vec<[u8; 3]>,
    /// The index of each face's colour; or nothing.
    pub face_colors: Vec<u8>,
    /// Texture coordinates, u to the right and v down, each pair once, in units of 2^`texture_exponent` of a texture's side, as
    /// [`pinhole::mesh::TextureCoords`] has them; or nothing.
    pub texture_coords: Vec<[i16; 2]>,
    /// The indices of the coordinates of each face's corners; or nothing.
    pub texture_faces: Vec<[u16; 3]>,
    /// The power of two that is the unit of the texture coordinates, in sides of a texture.
    pub texture_exponent: i8,
    /// The picture that the materials name, if [`Options::texture`](crate::Options::texture) asks for it and the model has
    /// texture coordinates.
    pub picture: Option<IndexedPicture>,
    /// Files beside the model: material libraries and, with the feature `textures`, the pictures that its materials name.
    pub files: Vec<PathBuf>,
    /// What was subtracted from all vertices, in model units: the centre of the bounding box, or nothing. Where `I16F16`
    /// can hold the centre, it is rounded to that (see [`quantise`](crate::quantise)).
    pub offset: [f64; 3],
    /// What was done to the model.
    pub report: Report,
    /// Doubtful parts of the model that were imported all the same.
    pub warnings: Vec<Warning>,
}

/// What importing a model did to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Vertices that the file's faces name.
    pub vertices_read: usize,
    /// Triangles of the file, after polygons were cut into triangles.
    pub faces_read: usize,
    /// Vertices dropped because they stood exactly where another one stands.
    pub welded: usize,
    /// Vertices dropped because quantising put them where another one stands.
    pub welded_by_quantising: usize,
    /// Faces dropped because their corners are fewer than three positions, or lie on a line.
    pub degenerate: usize,
    /// Faces dropped because the same face, with the same winding, is there already, unless that would open a closed surface.
    pub duplicate: usize,
    /// Faces that there are more because the neighbours of dropped faces were cut at the corners of these, so that a closed
    /// surface stays closed.
    pub cut: usize,
    /// Vertices dropped because only dropped faces named them.
    pub unused: usize,
    /// Faces that [`Options::fix_winding`](crate::Options::fix_winding) reversed.
    pub reversed: usize,
    /// Faces at the end of the list that are the backs of others, by [`Options::two_sided`](crate::Options::two_sided).
    pub backs: usize,
    /// Faces taken away by decimation.
    pub decimated: usize,
    /// How far decimation moved the surface, in model units, as `meshopt` estimates it.
    pub decimation_error: f64,
    /// By what the file's units were multiplied.
    pub scale: f64,
    /// The longest side of the bounding box, in model units.
    pub extent: f64,
    /// The largest error of a coordinate by quantising, in model units; at most `extent / 65000` about the centre.
    pub error: f64,
    /// Vertices that a face fetches on average through a first-in-first-out cache of 16 (3 at worst, about ½ at best):
    /// in the file's order (or as decimation left it), and in that of the mesh.
    pub fetches: [f64; 2],
}

impl Report {
    /// What was done up to the winding of faces; `fetches` are those before and after faces were ordered.
    pub(crate) fn of(exact: &Exact, rounded: &Rounded, winding: &Winding, fetches: [f64; 2]) -> Self {
        let (before, after) = (&exact.welded, &rounded.welded);
        let (decimated, decimation_error) = exact.decimated.unwrap_or_default();
        Report {
            vertices_read: exact.read[0],
            faces_read: exact.read[1],
            welded: before.welded,
            welded_by_quantising: after.welded,
            degenerate: before.degenerate.len() + after.degenerate.len(),
            duplicate: before.duplicate.len() + after.duplicate.len(),
            cut: before.cut + after.cut,
            unused: before.unused + after.unused,
            reversed: winding.reversed,
            backs: winding.backs.len(),
            decimated,
            decimation_error,
            scale: exact.scale,
            extent: rounded.grid.extent,
            error: rounded.error,
            fetches,
        }
    }
}

/// How the faces hang together: an edge belongs to two faces that run along it in opposite directions where a surface is
/// closed and oriented.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Topology {
    /// Edges of one face: the rim of a hole.
    pub open: usize,
    /// Edges of three and more faces.
    pub crowded: usize,
    /// Edges along which two faces run in the same direction: one of them is seen from its back.
    pub twisted: usize,
}

/// As types of `pinhole`.
#[cfg(feature = "mesh")]
impl ImportedMesh {
    /// The mesh, borrowed, with all lists that the options asked for.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the exponent is beyond what a mesh may have (a model that is very large or very small in its
    /// units), or if the fields were changed to something that is no mesh.
    pub fn mesh(&self) -> Result<Mesh<'_>, MeshError> {
        let mut mesh = Mesh::new(&self.vertices, self.exponent, &self.faces)?.with_edges(&self.edges)?;
        if !self.edge_faces.is_empty() {
            mesh = mesh.with_edge_faces(&self.edge_faces)?;
        }
        if !self.normals.is_empty() {
            mesh = mesh.with_normals(&self.normals)?;
        }
        if !self.planes.is_empty() {
            mesh = mesh.with_planes(&self.planes)?;
        }
        if !self.vertex_normals.is_empty() {
            mesh = mesh.with_vertex_normals(&self.vertex_normals)?;
        }
        Ok(mesh)
    }

    /// The colours of its faces, borrowed, if it has any.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the fields were changed.
    pub fn colors(&self) -> Result<Option<FaceColors<'_>>, MeshError> {
        if self.face_colors.is_empty() {
            return Ok(None);
        }
        let colors = FaceColors::new(&self.palette, &self.face_colors)?;
        match self.emission.is_empty() {
            true => Ok(Some(colors)),
            false => colors.with_emission(&self.emission).map(Some),
        }
    }

    /// The texture coordinates of its faces, borrowed, if it has any.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if the fields were changed.
    pub fn texture(&self) -> Result<Option<TextureCoords<'_>>, MeshError> {
        let coords = || TextureCoords::new(&self.texture_coords, &self.texture_faces, self.texture_exponent);
        (!self.texture_faces.is_empty()).then(coords).transpose()
    }
}

impl ImportedMesh {
    /// Whether clusters follow the planes.
    pub(crate) fn has_clusters(&self) -> bool {
        self.planes.len() > self.faces.len()
    }

    /// The bytes that the mesh's lists take in flash: 6 for a vertex, face or normal, 4 for an edge or its pair of faces, 2 for a
    /// plane, 16 for a cluster. Colours and texture coordinates do not count: only firmware that uses them has them in flash.
    pub fn flash_bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.faces[..])
            + size_of_val(&self.edges[..])
            + size_of_val(&self.edge_faces[..])
            + size_of_val(&self.normals[..])
            + size_of_val(&self.planes[..])
            + size_of_val(&self.vertex_normals[..])
    }

    /// The size of the mesh as a message: vertices, faces, edges, and bytes of flash.
    pub fn size(&self) -> String {
        let [vertices, faces, edges] = [self.vertices.len(), self.faces.len(), self.edges.len()];
        format!("{vertices} vertices, {faces} faces, {edges} edges; {} bytes of flash", self.flash_bytes())
    }

    /// Warnings, if the mesh is larger than microcontrollers, draw calls or worlds are.
    pub(crate) fn doubts(&self) -> Vec<Warning> {
        // More flash than many microcontrollers have, and, for the picture, more than a small one can spare.
        const MANY: usize = 128 << 10;
        const MANY_OF_PICTURE: usize = 16 << 10;
        let (bytes, count, extent) = (self.flash_bytes(), self.faces.len(), self.report.extent as u64);
        let edges = size_of_val(&self.edges[..]) + size_of_val(&self.edge_faces[..]);
        let faces = MANY / ((bytes - edges).max(1) / count.max(1)).max(1);
        let picture =
            self.picture.as_ref().map(|picture| ([picture.width, picture.height], picture.flash_bytes()));
        let picture = picture.filter(|&(_, bytes)| bytes > MANY_OF_PICTURE);
        let warnings = vec![
            (bytes > MANY).then_some(Warning::Flash { bytes, edges, faces }),
            picture.map(|(size, bytes)| Warning::PictureFlash { size, bytes }),
            // More than `pinhole::draw::TransformedMesh::bin_faces` takes.
            (count > MOST_FACES).then_some(Warning::ManyFaces { count }),
            // A mesh with larger steps is refused, with a message of its own.
            (extent > 1 << 16 && self.exponent <= 15).then_some(Warning::Extent { extent }),
        ];
        warnings.into_iter().flatten().collect()
    }

    /// The faces without the backs of others.
    fn fronts(&self) -> &[[u16; 3]] {
        &self.faces[..self.faces.len().saturating_sub(self.report.backs)]
    }

    /// Counts the edges at which the surface is not closed or not oriented. Backs by
    /// [`Options::two_sided`](crate::Options::two_sided) do not count.
    pub fn topology(&self) -> Topology {
        Sides::of(self.fronts()).topology(|face| face).0
    }

    /// The volume that the faces enclose, in model units: positive if a closed surface is counter-clockwise seen from
    /// outside, negative if it is turned inside out. Backs do not count.
    pub fn volume(&self) -> f64 {
        let corner = |i: u16| self.vertices[usize::from(i)].map(i128::from);
        let six_volumes = |&[a, b, c]: &[u16; 3]| {
            let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (corner(a), corner(b), corner(c));
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        };
        let sum: i128 = self.fronts().iter().map(six_volumes).sum();
        sum as f64 / 6.0 * power_of_two(self.exponent).powi(3)
    }
}
