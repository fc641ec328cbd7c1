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
    /// A face or an edge uses something that is not in its list.
    Index {
        /// What uses it: "face" or "edge".
        of: &'static str,
        /// The index of that.
        number: usize,
        /// What it uses: "vertex", "face", "colour" or "texture coordinate".
        used: &'static str,
        /// The index that it uses.
        index: u16,
        /// How many there are.
        count: usize,
    },
    /// A list is too short or too long.
    ListLength {
        /// What each entry is for, such as "normal per face".
        one: &'static str,
        /// How many entries were given.
        given: usize,
        /// How many are needed.
        needed: usize,
    },
    /// The exponent of a unit is out of range, −32 … 15 for vertices and −15 … 0 for texture coordinates: choose another unit.
    Exponent {
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
            Self::Index { of, number, used, index, count } => {
                write!(f, "{of} {number} uses {used} {index}, but there are {count}: indices begin at 0")
            }
            Self::ListLength { one, given, needed } => {
                write!(f, "a list of {given} entries where {needed} are needed: give one {one}")
            }
            Self::Exponent { exponent } => {
                write!(f, "unit 2^{exponent}: choose one of 2^-32 to 2^15 for vertices, or of 2^-15 to 1 for texture coordinates")
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
