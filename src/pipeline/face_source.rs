//! Where faces come from: a source pushes them, with their indices, into the face loop.
//!
//! Sources push and are not iterators: pulled through an iterator, a frame of S3 takes 6 % more instructions.

use super::instance::MeshInstance;
use crate::camera::PlaneEye;
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;

/// Pushes faces of a mesh into the face loop.
pub(super) trait FaceSource {
    /// Calls `visit` with the index and the vertices of each face. `visit` returns whether the face is finished: a
    /// binned source does not offer a finished face again.
    ///
    /// # Errors
    ///
    /// The first error of `visit`, which ends the loop.
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E>;
}

/// All faces in the order of the mesh.
pub(super) struct MeshOrder;

impl FaceSource for MeshOrder {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        // The index is computed from the number of faces that are left: so culled faces take no instruction to count it.
        let mut left = faces;
        while let [face, rest @ ..] = left {
            visit(faces.len() - left.len(), face)?;
            left = rest;
        }
        Ok(())
    }
}

/// The faces of a mesh, in its order, without those whose planes show that they are back faces: early back-face culling,
/// before a vertex is transformed.
pub(super) struct PlaneOrder<'a, V: Coordinate> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    pub(super) eye: PlaneEye,
}

/// The number of faces whose planes are tested together: one bit of a word for each.
const BATCH: usize = 32;

impl<V: Coordinate> FaceSource for PlaneOrder<'_, V> {
    #[inline(always)]
    fn push<E>(
        self,
        faces: &[[u16; 3]],
        mut visit: impl FnMut(usize, &[u16; 3]) -> Result<bool, E>,
    ) -> Result<(), E> {
        let (mut left, mut first) = (faces, 0);
        while !left.is_empty() {
            let (batch, others) = left.split_at_checked(BATCH).unwrap_or((left, &[]));
            let mut visible = self.visible(first, batch.len());
            while visible != 0 {
                let at = visible.trailing_zeros() as usize;
                visible &= visible - 1; // clears the lowest bit
                let Some(face) = batch.get(at) else { break };
                visit(first + at, face)?;
            }
            (left, first) = (others, first + BATCH);
        }
        Ok(())
    }
}

impl<V: Coordinate> PlaneOrder<'_, V> {
    /// One bit for each of `count` faces (at most [`BATCH`]), the lowest for face `first`: 0 if the face's plane shows that it
    /// is a back face.
    #[inline(never)] // the loop gets all registers; one copy for all draw calls
    pub(super) fn visible(&self, first: usize, count: usize) -> u32 {
        let (mesh, range, eye) = (self.instance.mesh_ref(), first..first + count, self.eye);
        let (Some(normals), Some(planes)) = (mesh.normals().get(range.clone()), mesh.planes().get(range))
        else {
            return u32::MAX; // the mesh has no planes
        };
        let mut visible = 0;
        for (&normal, &plane) in normals.iter().zip(planes) {
            keep_rolled();
            // The sign bit.
            visible = visible >> 1 | eye.behind(normal, plane) as u32 & 1 << 31;
        }
        visible >> ((BATCH - count) & 31)
    }
}
