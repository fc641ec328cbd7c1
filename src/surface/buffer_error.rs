//! A buffer of the caller's that is too short, or full.

use embedded_graphics_core::geometry::Size;

/// A buffer of the caller's is too short, or full. After an error it holds nothing new.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BufferError {
    /// A buffer has fewer cells than the picture needs.
    Picture {
        /// Cells that the picture needs: one for each pixel, and those between rows.
        needed: u64,
        /// Cells in the buffer.
        given: usize,
    },
    /// A buffer for depths has fewer elements than the area has pixels.
    Depth {
        /// Elements that the depth buffer needs: one for each pixel of the area.
        needed: u64,
        /// Elements in the buffer.
        given: usize,
    },
    /// A strip, or the buffer of the rows that a [`SmoothFrame`](crate::bands::SmoothFrame) keeps, is too short.
    Strip {
        /// The buffer that is needed, in words: "a strip of one row" for a [`Frame`](crate::bands::Frame); "a strip of six rows", or of seven, or "`kept` of two
        /// rows" for a `SmoothFrame`.
        of: &'static str,
        /// Bytes of these rows.
        needed: usize,
        /// Bytes of the buffer.
        given: usize,
    },
    /// The bin storage is too short: provide at least `needed` numbers.
    Bins {
        /// [`face_bins_len`](crate::Mesh::face_bins_len), [`edge_bins_len`](crate::Mesh::edge_bins_len) or
        /// [`smooth_bins_len`](crate::Mesh::smooth_bins_len), summed over a scene; one per 16 faces or edges for the second cursor of a
        /// [fork](crate::draw::BinnedFaces::fork).
        needed: usize,
        /// The length of the bin storage.
        given: usize,
    },
    /// A mesh has more faces or edges than bins can count: split it.
    TooManyItems {
        /// The number of faces or edges. At most 65535 can be binned.
        items: usize,
    },
    /// A painter has no room for the vertices or the faces of a mesh, or a scene none for another object: raise the type's parameter, a
    /// painter's `VERTICES` to 65536 at most, its `FACES` to 65535. Every vertex of a mesh takes one, and every corner of a clipped face's
    /// triangles; every visible face takes one, and every triangle of a clipped face.
    Full {
        /// The parameter: "VERTICES", "FACES" or "OBJECTS".
        parameter: &'static str,
        /// How many there would be.
        needed: usize,
        /// How many there is room for.
        capacity: usize,
    },
    /// A painter's stored faces belong to another viewport: draw them first, or use two painters.
    OtherViewport,
}

impl core::fmt::Display for BufferError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Picture { needed, given } => {
                write!(f, "a picture needs {needed} cells, but the buffer has {given}")
            }
            Self::Depth { needed, given } => {
                write!(f, "a depth buffer needs {needed} `u16`, one a pixel, but the buffer has {given}")
            }
            Self::Strip { of, needed, given } => {
                write!(f, "{of} needs {needed} bytes, but the buffer has {given}")
            }
            Self::Bins { needed, given } => {
                write!(f, "bins or a fork's cursor of {given} numbers: provide at least {needed}")
            }
            Self::TooManyItems { items } => {
                write!(f, "{items} faces or edges, but bins hold at most 65535: split the mesh")
            }
            Self::Full { parameter, needed, capacity } => {
                write!(f, "{parameter}: {needed} are needed, but there is room for {capacity}: ")?;
                match (*parameter, *capacity) {
                    ("VERTICES", 65_536) | ("FACES", 65_535) => {
                        f.write_str("a painter has no more, so add fewer meshes, or smaller ones")
                    }
                    _ => write!(f, "raise {parameter}"),
                }
            }
            Self::OtherViewport => {
                f.write_str("one viewport at a time: draw what the painter holds first, or use two painters")
            }
        }
    }
}

impl core::error::Error for BufferError {}

impl BufferError {
    /// Checks that `given` cells are enough for a picture of `size`.
    #[inline(always)]
    pub(super) fn check_picture(size: Size, given: usize) -> Result<(), Self> {
        let needed = u64::from(size.width) * u64::from(size.height);
        if needed <= given as u64 {
            Ok(())
        } else {
            Err(Self::Picture { needed, given })
        }
    }
}
