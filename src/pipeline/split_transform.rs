//! The vertex stage on two cores: each transforms half of a mesh's vertices into its half of the vertex cache.

use super::instance::MeshInstance;
use super::vertex_cache::{transform_all, TransformedMesh};
use crate::camera::ScreenVertex;
use crate::math::Coordinate;

/// A vertex cache that two cores fill. [`MeshInstance::split_transform`] makes it and has an example;
/// [`split_transform_depth`](MeshInstance::split_transform_depth) makes it with depth.
#[derive(Debug)]
pub struct SplitTransform<'a, V: Coordinate = i16, const DEPTH: bool = false> {
    instance: &'a MeshInstance<'a, V>,
    cache: &'a mut [ScreenVertex],
    /// Whether each half is transformed.
    done: [bool; 2],
}

/// Half of a mesh's vertices, to be transformed into half of a vertex cache: [`SplitTransform::halves`] makes two.
#[derive(Debug)]
pub struct HalfTransform<'a, V: Coordinate = i16, const DEPTH: bool = false> {
    instance: &'a MeshInstance<'a, V>,
    /// The index of the first vertex.
    first: usize,
    cache: &'a mut [ScreenVertex],
    done: &'a mut bool,
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Divides the [transform](Self::transform) of the mesh's vertices between two cores: what
    /// [`finish`](SplitTransform::finish) returns is what `transform` returns, bit for bit.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// # let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
    /// # let mut display = MockDisplay::<Gray8>::new();
    /// # let viewport = Viewport::new(Point::zero(), display.size())?;
    /// # let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 3], [0; 3]);
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let mut split = instance.split_transform(&mut cache);
    /// let [ours, theirs] = split.halves();
    /// std::thread::scope(|scope| {
    ///     scope.spawn(|| theirs.transform());
    ///     ours.transform();
    /// });
    /// let mut split = split.finish().split_bin_faces(&mut bins);
    /// let [ours, theirs] = split.halves();
    /// std::thread::scope(|scope| {
    ///     scope.spawn(|| theirs.bin());
    ///     ours.bin();
    /// });
    /// let mut faces = split.finish()?;
    /// faces.draw(|_face| Gray8::WHITE, &mut display)?;
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn split_transform<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> SplitTransform<'a, V> {
        SplitTransform { instance: self, cache, done: [false; 2] }
    }

    /// Divides the [transform with depth](Self::transform_depth) of the mesh's vertices between two cores, as
    /// [`split_transform`](Self::split_transform) does without depth.
    pub fn split_transform_depth<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> SplitTransform<'a, V, true> {
        SplitTransform { instance: self, cache, done: [false; 2] }
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> SplitTransform<'a, V, DEPTH> {
    /// Both halves of the vertices, equally many or one more in the second. Send one to the other core.
    pub fn halves(&mut self) -> [HalfTransform<'_, V, DEPTH>; 2] {
        let Self { instance, ref mut cache, ref mut done } = *self;
        let middle = cache.len().min(instance.mesh().vertices.len()) / 2; // at most the length of the cache
        let (front, back) = cache.split_at_mut_checked(middle).unwrap_or_default();
        let [front_done, back_done] = done;
        [
            HalfTransform { instance, first: 0, cache: front, done: front_done },
            HalfTransform { instance, first: middle, cache: back, done: back_done },
        ]
    }

    /// The mesh with all vertices transformed: a half that no core has transformed is transformed here.
    pub fn finish(mut self) -> TransformedMesh<'a, V, DEPTH> {
        let [front, back] = self.halves();
        for half in [front, back] {
            if !*half.done {
                half.transform();
            }
        }
        TransformedMesh::of_full_cache(self.instance, self.cache)
    }
}

impl<V: Coordinate, const DEPTH: bool> HalfTransform<'_, V, DEPTH> {
    /// Transforms the vertices of this half.
    pub fn transform(self) {
        let vertices = self.instance.mesh().vertices.get(self.first..).unwrap_or_default();
        let transform = self.instance.vertex_transform();
        let far = DEPTH || transform.clips_at_far();
        transform_all::<V, DEPTH>(transform, far, vertices, self.cache);
        *self.done = true;
    }
}

defmt_format!(
    [V: Coordinate, const DEPTH: bool] SplitTransform<'_, V, DEPTH>, self,
    "{}, halves transformed: {=bool}, {=bool}", self.instance, self.done[0], self.done[1]
);

defmt_format!(
    [V: Coordinate, const DEPTH: bool] HalfTransform<'_, V, DEPTH>, self,
    "vertices from {=usize} of {}", self.first, self.instance
);
