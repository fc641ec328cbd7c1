//! Binning on two cores: each culls half of a mesh's faces and links the visible ones. Then one core joins the bins.

use super::binned::Binned;
use super::binned_faces::BinnedFaces;
use super::bins::{BinPart, BinStorage};
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

/// Half of a mesh's faces, to be culled and binned: [`SplitBins::halves`] makes two.
#[derive(Debug)]
pub struct HalfBins<'a, V: Coordinate = i16, const DEPTH: bool = false> {
    transformed: TransformedMesh<'a, V, DEPTH>,
    /// The faces of this half.
    faces: Range<usize>,
    /// The link of each of them.
    next: &'a mut [u16],
    half: &'a mut Half,
}

/// The bins of half of the faces.
#[derive(Debug)]
struct Half {
    /// Whether the faces were binned.
    done: bool,
    part: BinPart,
    statistics: Statistics,
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Divides [binning](Self::bin_faces) between two cores: what [`finish`](SplitBins::finish) returns draws what `bin_faces`
    /// draws, bit for bit. `storage` is as for `bin_faces`.
    /// [`MeshInstance::split_transform`](crate::draw::MeshInstance::split_transform) has an example.
    pub fn split_bin_faces(&self, storage: &'a mut [u16]) -> SplitBins<'a, V, DEPTH> {
        let half = || Half { done: false, part: BinPart::EMPTY, statistics: Statistics::NONE };
        SplitBins { transformed: *self, storage, halves: [half(), half()] }
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> SplitBins<'a, V, DEPTH> {
    /// Both halves of the faces. Send one to the other core.
    pub fn halves(&mut self) -> [HalfBins<'_, V, DEPTH>; 2] {
        let Self { transformed, ref mut storage, ref mut halves } = *self;
        let faces = transformed.instance.mesh().faces.len();
        // `finish` reports storage that is too short.
        let BinStorage { next, .. } = BinStorage::new(storage, faces, 1).unwrap_or_default();
        let middle = faces / 2;
        let (front, back) = next.split_at_mut_checked(middle).unwrap_or_default();
        let [front_half, back_half] = halves;
        [
            HalfBins { transformed, faces: 0..middle, next: front, half: front_half },
            HalfBins { transformed, faces: middle..faces, next: back, half: back_half },
        ]
    }

    /// Joins the halves. A half that no core has binned is binned here.
    ///
    /// # Errors
    ///
    /// The errors of [`TransformedMesh::bin_faces`], for the same reasons.
    #[inline(never)] // the result is large
    pub fn finish(mut self) -> Result<BinnedFaces<'a, V, DEPTH>, BufferError> {
        for half in self.halves() {
            if !half.half.done {
                half.bin();
            }
        }
        let Self { transformed, storage, halves: [front, back] } = self;
        let (faces, viewport) =
            (transformed.instance.mesh().faces.len(), pixels(transformed.instance.area()));
        let bins = BinStorage::new(storage, faces, 1)?.joined(&viewport, [&front.part, &back.part]);
        let statistics = (front.statistics + back.statistics).with_the_rest_culled(faces);
        Ok(BinnedFaces(Binned { transformed, bins, statistics }))
    }
}

impl<V: Coordinate, const DEPTH: bool> HalfBins<'_, V, DEPTH> {
    /// Culls the faces of this half and puts the visible ones into bins.
    pub fn bin(self) {
        let Self { transformed, faces, next, half } = self;
        let all = transformed.instance.mesh().faces.len();
        let mut fill = half.part.fill(next, faces.start, all, pixels(transformed.instance.area()));
        half.statistics = fill.add_faces(PartOrder(faces), transformed);
        half.part.bounds = fill.bounds;
        half.done = true;
    }
}

defmt_format!(
    [V: Coordinate, const DEPTH: bool] SplitBins<'_, V, DEPTH>, self,
    "{}, halves binned: {=bool}, {=bool}", self.transformed, self.halves[0].done, self.halves[1].done
);

defmt_format!(
    [V: Coordinate, const DEPTH: bool] HalfBins<'_, V, DEPTH>, self,
    "{=usize} faces from {=usize}", self.faces.len(), self.faces.start
);
