//! Binning on two cores: each culls and counts half of a mesh's faces. Then one core sorts the visible ones.

use super::binned::Binned;
use super::binned_faces::{count_faces, BinnedFaces};
use super::bins::{Bins, Counts};
use super::draw_region::pixels;
use super::face_source::PartOrder;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::math::Coordinate;
use crate::surface::BufferError;
use core::ops::Range;

/// Bin storage that two cores fill. [`TransformedMesh::split_bin_faces`] makes it.
#[derive(Debug)]
pub struct SplitBins<'a, V: Coordinate = i16, const DEPTH: bool = false> {
    transformed: TransformedMesh<'a, V, DEPTH>,
    storage: &'a mut [u16],
    halves: [Half; 2],
}

/// Half of a mesh's faces, to be culled and counted: [`SplitBins::halves`] makes two.
#[derive(Debug)]
pub struct HalfBins<'a, V: Coordinate = i16, const DEPTH: bool = false> {
    transformed: TransformedMesh<'a, V, DEPTH>,
    /// The faces of this half. The first one's index is a multiple of 16.
    faces: Range<usize>,
    /// A bit for each of them.
    bits: &'a mut [u16],
    half: &'a mut Half,
}

/// What was counted in half of the faces.
#[derive(Debug)]
struct Half {
    /// Whether the faces were counted.
    done: bool,
    counts: Counts,
    statistics: Statistics,
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Divides [binning](Self::bin_faces) between two cores: what [`finish`](SplitBins::finish) returns is what `bin_faces`
    /// returns, bit for bit. `storage` is as for `bin_faces`.
    /// [`MeshInstance::split_transform`](crate::draw::MeshInstance::split_transform) has an example.
    pub fn split_bin_faces(&self, storage: &'a mut [u16]) -> SplitBins<'a, V, DEPTH> {
        let half = || Half { done: false, counts: Counts::NONE, statistics: Statistics::NONE };
        SplitBins { transformed: *self, storage, halves: [half(), half()] }
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> SplitBins<'a, V, DEPTH> {
    /// Both halves of the faces, which differ by up to 16 faces. Send one to the other core.
    pub fn halves(&mut self) -> [HalfBins<'_, V, DEPTH>; 2] {
        let Self { transformed, ref mut storage, ref mut halves } = *self;
        let faces = transformed.instance.mesh().faces.len();
        let middle = faces / 2 / 16; // in words of 16 faces
        let words = faces.div_ceil(16).min(storage.len());
        let bits = storage.get_mut(..words).unwrap_or_default();
        // `finish` reports storage that is too short for the bits.
        let (front, back) = bits.split_at_mut_checked(middle.min(words)).unwrap_or_default();
        let [front_half, back_half] = halves;
        [
            HalfBins { transformed, faces: 0..16 * middle, bits: front, half: front_half },
            HalfBins { transformed, faces: 16 * middle..faces, bits: back, half: back_half },
        ]
    }

    /// Sorts the visible faces. A half that no core has counted is counted here.
    ///
    /// # Errors
    ///
    /// The errors of [`TransformedMesh::bin_faces`], for the same reasons.
    #[inline(never)] // the result is large
    pub fn finish(mut self) -> Result<BinnedFaces<'a, V, DEPTH>, BufferError> {
        for half in self.halves() {
            if !half.half.done {
                half.count();
            }
        }
        let Self { transformed, storage, halves: [front, back] } = self;
        let faces = transformed.instance.mesh().faces.len();
        let mut bins = Bins::over(storage, pixels(transformed.instance.area()));
        let mut sort = bins.sort_counted([&front.counts, &back.counts]);
        sort.finish(faces, |index| transformed.first_row(index))?;
        let statistics = front.statistics.and(back.statistics).with_the_rest_culled(faces);
        Ok(BinnedFaces(Binned { transformed, bins, statistics }))
    }
}

impl<V: Coordinate, const DEPTH: bool> HalfBins<'_, V, DEPTH> {
    /// Culls and counts the faces of this half.
    pub fn count(self) {
        let Self { transformed, faces, bits, half } = self;
        let mut bins = Bins::new(bits, faces.len(), pixels(transformed.instance.area()));
        let mut sort = bins.sort();
        half.statistics = count_faces(PartOrder(faces), &transformed, &mut sort);
        half.counts = sort.into_counts();
        half.done = true;
    }
}

defmt_format!(
    [V: Coordinate, const DEPTH: bool] SplitBins<'_, V, DEPTH>, self,
    "{}, halves counted: {=bool}, {=bool}", self.transformed, self.halves[0].done, self.halves[1].done
);

defmt_format!(
    [V: Coordinate, const DEPTH: bool] HalfBins<'_, V, DEPTH>, self,
    "{=usize} faces from {=usize}", self.faces.len(), self.faces.start
);
