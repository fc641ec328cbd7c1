//! The vertex stage on two cores: each transforms half of a mesh's vertices into its half of the vertex cache.

use super::instance::MeshInstance;
use super::vertex_cache::{transform_all, TransformedMesh};
use crate::camera::ScreenVertex;
use crate::math::Coordinate;
use core::mem::replace;

/// Both halves of a stage, to be run by two cores at the same time, or one after the other. A half that is not run is run afterwards.
pub(super) fn run_both(
    mut ours: impl FnMut() + Send,
    mut theirs: impl FnMut() + Send,
    both: impl FnOnce(&mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send)),
) {
    let mut done = [false; 2];
    let [ours_done, theirs_done] = &mut done;
    let (mut ours, mut theirs) = (|| once(ours_done, &mut ours), || once(theirs_done, &mut theirs));
    both(&mut ours, &mut theirs);
    ours();
    theirs();
}

/// Runs a half, unless it was run before.
fn once(is_done: &mut bool, half: &mut impl FnMut()) {
    if !replace(is_done, true) {
        half();
    }
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Divides the [transform](Self::transform) of the mesh's vertices between two cores, with a result equal bit for bit. `both` gets the
    /// halves, and calls them at the same time, each on one core; a half that it does not call is run afterwards.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// fn both(ours: &mut (dyn FnMut() + Send), theirs: &mut (dyn FnMut() + Send)) {
    ///     std::thread::scope(|scope| {
    ///         scope.spawn(theirs);
    ///         ours();
    ///     });
    /// }
    ///
    /// let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 3], [0; 3]);
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let transformed = instance.split_transform(&mut cache, both);
    /// let mut faces = transformed.split_bin_faces(&mut bins, both)?;
    /// faces.draw(|_face| Gray8::WHITE, &mut display)?;
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn split_transform<'a>(
        &'a self,
        cache: &'a mut [ScreenVertex],
        both: impl FnOnce(&mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send)),
    ) -> TransformedMesh<'a, V, false> {
        self.transform_halves(cache, both)
    }

    /// Divides the [transform with depth](Self::transform_depth) of the mesh's vertices between two cores, as
    /// [`split_transform`](Self::split_transform) does without depth.
    pub fn split_transform_depth<'a>(
        &'a self,
        cache: &'a mut [ScreenVertex],
        both: impl FnOnce(&mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send)),
    ) -> TransformedMesh<'a, V, true> {
        self.transform_halves(cache, both)
    }

    fn transform_halves<'a, const DEPTH: bool>(
        &'a self,
        cache: &'a mut [ScreenVertex],
        both: impl FnOnce(&mut (dyn FnMut() + Send), &mut (dyn FnMut() + Send)),
    ) -> TransformedMesh<'a, V, DEPTH> {
        let middle = cache.len().min(self.mesh().vertices.len()) / 2; // at most the length of the cache
        let (front, back) = cache.split_at_mut_checked(middle).unwrap_or_default();
        run_both(
            || self.transform_from::<DEPTH>(0, front),
            || self.transform_from::<DEPTH>(middle, back),
            both,
        );
        TransformedMesh::of_full_cache(self, cache)
    }

    /// Transforms vertices from a first one on, as many as fit into a cache.
    #[inline(never)] // once for both halves
    fn transform_from<const DEPTH: bool>(&self, first: usize, cache: &mut [ScreenVertex]) {
        let vertices = self.mesh().vertices.get(first..).unwrap_or_default();
        let transform = self.vertex_transform();
        let far = DEPTH || transform.clips_at_far();
        transform_all::<V, DEPTH>(transform, far, vertices, cache);
    }
}
