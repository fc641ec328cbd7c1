//! Picking without drawing: the face that a depth-tested drawing shows at a pixel.

use super::draw_region::DrawRegion;
use super::face_source::{ClusterOrder, FaceSource, MeshOrder, PlaneOrder};
use super::faces::{draw_triangles, each_face, Faces, NOTHING, PLANES};
use super::fill::kept_pixels;
use super::instance::MeshInstance;
use super::vertex_cache::{LazyCache, TransformedMesh, VertexCache};
use crate::camera::ScreenVertex;
use crate::color::InkKind;
use crate::fast;
use crate::math::Coordinate;
use crate::raster::ScreenPoint;
use crate::shading::SpanShader;
use crate::surface::DepthBuffer;
use core::convert::Infallible;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// The visible point in a pixel: the answer of [`Faces::pick`] and [`PlacedScene::pick`](crate::draw::PlacedScene::pick). Its point in the
/// world is [`Camera::unproject`](crate::Camera::unproject)`(at, depth)`.
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

impl<V: Coordinate, F, const CULLED_BY: u8> Faces<'_, V, F, CULLED_BY> {
    /// The face that is seen in a pixel of the target, for touch screens and cursors. It is the face that
    /// [`draw`](Self::draw) shows there with a depth test, by equal rules of coverage, culling, clipping and depth. Nothing is drawn,
    /// and no depth buffer is needed. `None` if no face covers the pixel, or if it lies outside of the viewport or beyond 8192
    /// pixels.
    ///
    /// A face whose shader leaves the pixel out, by a transparent texel or a [`ScreenDoor`](crate::shading::ScreenDoor), is not seen there.
    /// Where no shader leaves out pixels, shade with any colour. A translucent face is seen like an opaque one.
    ///
    /// ```
    /// use embedded_graphics::{geometry::{Point, Size}, pixelcolor::BinaryColor};
    /// use pinhole::{prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    /// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    /// let mesh = Mesh::new(&VERTICES, 0, &FACES)?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO)?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let opaque = |_face| BinaryColor::On;
    /// let picked = instance.faces(opaque).pick(Point::new(24, 24)).ok_or("background")?;
    /// assert_eq!(picked.face, 2); // the corners at the upper right, upper left and lower left
    /// let point = camera.unproject(picked.at, picked.depth).ok_or("far away")?;
    /// assert!(point.x() < Scalar::ZERO && point.y() > Scalar::ZERO && point.z() > -Scalar::ONE);
    /// assert_eq!(instance.faces(opaque).pick(Point::new(0, 0)), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pick<C: PixelColor, S: SpanShader<C>>(self, pixel: Point) -> Option<Picked>
    where
        F: FnMut(usize) -> S,
    {
        let Self { instance, shade, cache } = self;
        pick_at(pixel, |depth| Some((0, instance.pick_nearer::<_, _, CULLED_BY>(depth, shade, cache)?)))
    }
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// The face that is seen in the one pixel of the depth buffer, if one is nearer than its depth, which it replaces.
    pub(super) fn pick_nearer<C: PixelColor, S: SpanShader<C>, const CULLED_BY: u8>(
        &self,
        depth: &mut DepthBuffer<'_>,
        shade: impl FnMut(usize) -> S,
        cache: &mut [ScreenVertex],
    ) -> Option<usize> {
        match CULLED_BY {
            NOTHING => pick_nearer(MeshOrder, TransformedMesh::new(self, cache), depth, shade),
            PLANES => {
                let source = PlaneOrder::new(self);
                pick_nearer(source, LazyCache::new(self, true, cache), depth, shade)
            }
            _ => {
                let source = ClusterOrder::new(self);
                pick_nearer(source, LazyCache::new(self, true, cache), depth, shade)
            }
        }
    }
}

/// The visible point in a pixel: `nearest` gets a depth buffer of this pixel and returns the nearest face, with its object's index.
pub(super) fn pick_at(
    pixel: Point,
    nearest: impl FnOnce(&mut DepthBuffer<'_>) -> Option<(usize, usize)>,
) -> Option<Picked> {
    let at = pixel_centre(pixel)?;
    let mut storage = [0];
    let mut depth = DepthBuffer::new(Rectangle::new(pixel, Size::new(1, 1)), &mut storage).ok()?;
    let (object, face) = nearest(&mut depth)?;
    Some(Picked { object, face, at, depth: depth.at(pixel)? })
}

/// The last face of a source that passes the depth test in the one pixel of the depth buffer, and whose shader does not leave
/// the pixel out. Its depth is stored, also where the shader is translucent and a drawing would not store it.
fn pick_nearer<'a, V: Coordinate + 'a, C: PixelColor, S: SpanShader<C>>(
    source: impl FaceSource,
    mut cache: impl VertexCache<'a, V, true>,
    depth: &mut DepthBuffer<'_>,
    mut shade: impl FnMut(usize) -> S,
) -> Option<usize> {
    let instance = cache.instance();
    let region = DrawRegion::shared(&depth.area(), instance.area(), None);
    if region.scissor.is_empty() {
        return None;
    }
    let mut nearest = None;
    let Ok(_) = each_face(source, &mut cache, &region.viewport, |index, face, triangles| {
        let shader = shade(index);
        let Ok(()) = draw_triangles(instance, face, triangles, &shader, |triangle, shader| {
            let mut spans = fast::spans(&triangle.triangle, &region.scissor);
            if spans.is_empty() {
                return Ok(()); // the gradient is not set up
            }
            let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
            let setup = <S::Ink as InkKind<C>>::LEAVES_OUT.then(|| shader.set_up(&triangle.triangle));
            spans.try_for_each(|span| {
                let is_kept = || setup.as_ref().is_none_or(|setup| kept_pixels::<C, S>(setup, span)());
                depth.test_kept(span, &gradient, is_kept, true, |_| {
                    nearest = Some(index);
                    Ok::<(), Infallible>(())
                })
            })
        });
        Ok::<bool, Infallible>(true)
    });
    nearest
}

/// The centre of a pixel; `None` beyond the guard band.
fn pixel_centre(Point { x, y }: Point) -> Option<ScreenPoint> {
    let centre = |c: i32| c.checked_mul(256).map(|c| c.saturating_add(128));
    ScreenPoint::from_subpixels(centre(x)?, centre(y)?)
}
