//! Picking without drawing: the face that a depth-tested drawing shows at a pixel.

use super::draw_region::DrawRegion;
use super::face_source::{FaceSource, MeshOrder, PlaneOrder};
use super::face_triangles::FaceTriangles;
use super::faces::each_face;
use super::instance::MeshInstance;
use super::vertex_cache::{LazyCache, TransformedMesh, VertexCache};
use crate::camera::{Camera, ScreenVertex};
use crate::fast;
use crate::math::{Coordinate, Point3};
use crate::raster::ScreenPoint;
use crate::scene::FacePlanes;
use crate::space::World;
use crate::surface::DepthBuffer;
use core::convert::Infallible;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The visible point in a pixel: the answer of [`MeshInstance::pick`] and [`PlacedScene::pick`](crate::PlacedScene::pick).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Picked {
    /// The object's index in its scene; 0 for a single instance.
    pub object: usize,
    /// The face's index in its mesh.
    pub face: usize,
    /// The centre of the pixel.
    pub at: ScreenPoint,
    /// The depth of the face there, as a depth buffer stores it: 0 near to 65534 far.
    pub depth: u16,
}

impl Picked {
    /// The world point under the pixel's centre, or `None`: see [`Camera::unproject`] for its error, and for when there is none.
    pub fn point(&self, camera: &Camera) -> Option<Point3<World>> {
        camera.unproject(self.at, self.depth)
    }
}

impl<V: Coordinate, P: FacePlanes> MeshInstance<'_, V, P> {
    /// The face that is seen in a pixel of the target, for touch screens and cursors. It is the face that
    /// [`depth_tested`](Self::depth_tested) shows there, by equal rules of coverage, culling, clipping and depth. Nothing is drawn,
    /// and no depth buffer is needed. `None` if no face covers the pixel, or if it lies outside of the viewport or beyond 8192
    /// pixels.
    ///
    /// `cache` is as in [`wireframe`](Self::wireframe); it may be empty. If the vertices are transformed already, call
    /// [`TransformedMesh::pick`].
    ///
    /// ```
    /// # use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{Affine, Angle, Camera, Mesh, Picked, Scalar, Viewport};
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO)?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let picked = instance.pick(Point::new(24, 24), &mut []).ok_or("background")?;
    /// assert_eq!(picked.face, 2); // the corners at the upper right, upper left and lower left
    /// let point = picked.point(&camera).ok_or("far away")?;
    /// assert!(point.x() < Scalar::ZERO && point.y() > Scalar::ZERO && point.z() > -Scalar::ONE);
    /// assert_eq!(instance.pick(Point::new(0, 0), &mut []), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pick(&self, pixel: Point, cache: &mut [ScreenVertex]) -> Option<Picked> {
        self.pick_before(pixel, cache, DepthBuffer::NOTHING)
    }

    /// [`pick`](Self::pick) among the faces that are nearer than `depth`.
    pub(super) fn pick_before(&self, pixel: Point, cache: &mut [ScreenVertex], depth: u16) -> Option<Picked> {
        if P::CULL {
            let source = PlaneOrder::new(&self.any);
            pick(source, LazyCache::new(&self.any, true, cache), pixel, depth)
        } else {
            pick(MeshOrder, TransformedMesh::new(&self.any, cache), pixel, depth)
        }
    }
}

impl<V: Coordinate, P: FacePlanes> TransformedMesh<'_, V, true, P> {
    /// The face that is seen in a pixel of the target: see [`MeshInstance::pick`].
    pub fn pick(&self, pixel: Point) -> Option<Picked> {
        if P::CULL {
            pick(PlaneOrder::new(self.instance), self.any(), pixel, DepthBuffer::NOTHING)
        } else {
            pick(MeshOrder, self.any(), pixel, DepthBuffer::NOTHING)
        }
    }
}

/// The face of a source that is seen in a pixel, among the faces that are nearer than `depth`.
fn pick<'a, V: Coordinate + 'a>(
    source: impl FaceSource,
    mut cache: impl VertexCache<'a, V, true>,
    pixel: Point,
    depth: u16,
) -> Option<Picked> {
    let at = pixel_centre(pixel)?;
    let (area, mut storage) = (Rectangle::new(pixel, Size::new(1, 1)), [0]);
    // A depth buffer of one pixel.
    let mut buffer = DepthBuffer::new(area, &mut storage).ok()?;
    buffer.values_mut().fill(depth);
    let region = DrawRegion::shared(&area, cache.instance().area(), Some(&buffer));
    if region.scissor.is_empty() {
        return None;
    }
    let mut nearest = None;
    let Ok(_) =
        each_face(source, &mut cache, &region.viewport, |face, _, triangles: &mut FaceTriangles<'_, ()>| {
            loop {
                let triangle = triangles.fan.triangle();
                let mut spans = fast::spans(&triangle.triangle, &region.scissor);
                if !spans.is_empty() {
                    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
                    let Ok(()) = spans.try_for_each(|span| {
                        buffer.test(span, &gradient, |_| {
                            nearest = Some(face);
                            Ok::<(), Infallible>(())
                        })
                    });
                }
                if !V::CLIPS || !triangles.fan.advance() {
                    return Ok::<bool, Infallible>(true);
                }
            }
        });
    let depth = buffer.at(pixel)?;
    nearest.map(|face| Picked { object: 0, face, at, depth })
}

/// The centre of a pixel; `None` beyond the guard band.
fn pixel_centre(Point { x, y }: Point) -> Option<ScreenPoint> {
    let centre = |c: i32| c.checked_mul(256).map(|c| c.saturating_add(128));
    ScreenPoint::from_subpixels(centre(x)?, centre(y)?)
}
