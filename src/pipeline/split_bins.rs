//! Binning on two cores: each culls half of a mesh's faces and links the visible ones. Then one core joins the bins.

use super::binned::Binned;
use super::binned_faces::BinnedFaces;
use super::bins::{BinPart, BinStorage};
use super::draw_region::pixels;
use super::face_source::PartOrder;
use super::split_transform::run_both;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::math::Coordinate;
use crate::surface::BufferError;
use core::ops::Range;

/// The bins of half of the faces.
struct Half {
    part: BinPart,
    statistics: Statistics,
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Divides [binning](Self::bin_faces) between two cores, with a result equal bit for bit. `storage` is as for `bin_faces`; `both` gets the
    /// halves, as [`MeshInstance::split_transform`](crate::draw::MeshInstance::split_transform), which has an example.
    ///
    /// # Errors
    ///
    /// The errors of [`bin_faces`](Self::bin_faces), for the same reasons.
    #[inline(never)] // the result is large
    pub fn split_bin_faces(
        &self,
        storage: &'a mut [u16],
        both: impl FnOnce(&mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send)),
    ) -> Result<BinnedFaces<'a, V, DEPTH>, BufferError> {
        let half = || Half { part: BinPart::EMPTY, statistics: Statistics::NONE };
        let (mut front, mut back) = (half(), half());
        let faces = self.instance.mesh().faces.len();
        let middle = faces / 2;
        let BinStorage { next, .. } = BinStorage::new(storage, faces, 1)?;
        let (front_next, back_next) = next.split_at_mut_checked(middle).unwrap_or_default();
        run_both(
            || self.bin_half(0..middle, front_next, &mut front),
            || self.bin_half(middle..faces, back_next, &mut back),
            both,
        );
        let bins = BinStorage::new(storage, faces, 1)?;
        let bins = bins.joined(&pixels(self.instance.area()), [&front.part, &back.part]);
        let statistics = (front.statistics + back.statistics).with_the_rest_culled(faces);
        Ok(Binned { transformed: *self, bins, statistics }.into())
    }

    /// Culls the faces of a half and puts the visible ones into bins, given the link of each face.
    #[inline(never)] // once for both halves
    fn bin_half(&self, faces: Range<usize>, next: &mut [u16], half: &mut Half) {
        let all = self.instance.mesh().faces.len();
        let mut fill = half.part.fill(next, faces.start, all, pixels(self.instance.area()));
        half.statistics = fill.add_faces(PartOrder(faces), *self);
        half.part.bounds = fill.bounds;
    }
}
