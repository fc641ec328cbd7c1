//! Why lists of a model do not fit together.

/// Why a mesh, its materials or a hierarchy cannot be made of the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MeshError {
    /// There are more vertices than `u16` indices can address: split the mesh.
    TooManyVertices {
        /// The number of vertices; the limit is 65536.
        vertices: usize,
    },
    /// A face uses a vertex index that is out of range.
    FaceIndex {
        /// The face's index.
        face: usize,
        /// The vertex index that the face uses.
        index: u16,
    },
    /// An edge uses a vertex index that is out of range.
    EdgeIndex {
        /// The edge's index.
        edge: usize,
        /// The vertex index that the edge uses.
        index: u16,
    },
    /// An edge lacks its pair of adjacent faces, or a face index is neither in range nor [`Mesh::NO_FACE`](crate::Mesh::NO_FACE).
    EdgeFaces {
        /// The edge's index or, if there is not one pair of faces per edge, the number of pairs.
        edge: usize,
    },
    /// The number of face normals differs from the number of faces.
    NormalCount {
        /// How many faces there are.
        faces: usize,
        /// How many normals were given.
        normals: usize,
    },
    /// The number of face planes differs from the number of faces.
    PlaneCount {
        /// How many faces there are.
        faces: usize,
        /// How many planes were given.
        planes: usize,
    },
    /// The number of vertex normals differs from the number of vertices.
    VertexNormalCount {
        /// How many vertices there are.
        vertices: usize,
        /// How many normals were given.
        normals: usize,
    },
    /// A list does not have one entry for each vertex.
    VertexListCount {
        /// How many vertices there are.
        vertices: usize,
        /// How many entries were given.
        entries: usize,
    },
    /// A list does not have one entry for each face.
    FaceListCount {
        /// How many faces there are.
        faces: usize,
        /// How many entries were given.
        entries: usize,
    },
    /// The exponent of the vertices' unit is outside of −32 … 15: choose another unit.
    Exponent {
        /// The given exponent.
        exponent: i8,
    },
    /// A face uses a colour or a texture coordinate that is not in the list.
    MaterialIndex {
        /// The face's index.
        face: usize,
        /// The index that the face uses.
        index: u16,
        /// How many colours or coordinates there are.
        count: usize,
    },
    /// The list of emitted colours is not as long as the palette: give one for each colour, black for a colour that emits
    /// nothing.
    EmissionCount {
        /// How many emitted colours there are.
        emission: usize,
        /// How many colours the palette has.
        palette: usize,
    },
    /// The exponent of the texture coordinates' unit is outside of −15 … 0: choose another unit.
    TextureExponent {
        /// The given exponent.
        exponent: i8,
    },
    /// A node of a hierarchy has a parent that does not come before it. Order the list so that parents come first, which also
    /// excludes cycles.
    Parent {
        /// The node's index.
        node: usize,
        /// The index of its parent.
        parent: u16,
    },
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooManyVertices { vertices } => {
                write!(f, "{vertices} vertices, but u16 indices address 65536: split the mesh")
            }
            Self::FaceIndex { face, index } => {
                write!(f, "face {face} uses vertex {index}, which the mesh does not have: indices begin at 0")
            }
            Self::EdgeIndex { edge, index } => {
                write!(f, "edge {edge} uses vertex {index}, which the mesh does not have: indices begin at 0")
            }
            Self::EdgeFaces { edge } => {
                write!(f, "edge {edge} has no pair of faces, or uses a face that the mesh does not have")
            }
            Self::NormalCount { faces, normals } => {
                write!(f, "{normals} normals for {faces} faces: give one per face")
            }
            Self::PlaneCount { faces, planes } => {
                write!(f, "{planes} planes for {faces} faces: give one per face")
            }
            Self::VertexNormalCount { vertices, normals } => {
                write!(f, "{normals} vertex normals for {vertices} vertices: give one per vertex")
            }
            Self::VertexListCount { vertices, entries } => {
                write!(f, "a list of {entries} entries for {vertices} vertices: give one per vertex")
            }
            Self::FaceListCount { faces, entries } => {
                write!(f, "a list of {entries} entries for {faces} faces: give one per face")
            }
            Self::Exponent { exponent } => {
                write!(f, "exponent {exponent} is not -32 to 15: choose another unit")
            }
            Self::MaterialIndex { face, index, count } => {
                write!(f, "face {face} uses colour or texture coordinate {index}, but the list has {count}")
            }
            Self::EmissionCount { emission, palette } => {
                write!(f, "{emission} emitted colours for a palette of {palette}: give one for each, black for none")
            }
            Self::TextureExponent { exponent } => {
                write!(
                    f,
                    "texture coordinates in 2^{exponent} of a texture, but the exponent must be -15 to 0"
                )
            }
            Self::Parent { node, parent } => {
                write!(
                    f,
                    "node {node} has parent {parent}, which does not come before it: order parents first"
                )
            }
        }
    }
}

impl core::error::Error for MeshError {}
