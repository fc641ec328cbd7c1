//! Points and polylines, for plots, tool paths and the anchors of labels.

use super::anti_aliased;
use super::draw_region::DrawRegion;
use super::drawable::StrokeFor;
use super::hidden_line::draw_nearer;
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::color::Access;
use crate::math::Coordinate;
use crate::raster::{self, Pixel, Scissor, Span};
use crate::surface::{DepthBuffer, Surface, Target};

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Draws each vertex as one pixel. [`polyline`](Self::polyline) has an example. Into a target [with a depth
    /// buffer](crate::target::Surface::depth_tested) it draws those that are as near as the buffer or nearer, and stores their depth.
    ///
    /// # Errors
    ///
    /// The target's error, at the first pixel that it refuses.
    #[inline(never)] // its stack frame is gone when it returns
    pub fn points<T: Target>(&self, color: T::Color, target: &mut T) -> Result<Statistics, T::Error> {
        target.dispatch(
            color,
            |color, surface| {
                let DrawRegion { scissor, .. } = DrawRegion::new(surface, self.area());
                self.each_point(false, &scissor, |pixel, _| surface.fill(pixel, color))
            },
            |color, surface, depth| {
                let DrawRegion { scissor, .. } =
                    DrawRegion::shared(&surface.area(), self.area(), Some(depth));
                self.each_point(true, &scissor, |pixel, own| match depth.row(pixel.x, pixel.y, 1) {
                    Some([stored]) if own <= *stored => {
                        *stored = own;
                        surface.fill(pixel, color)
                    }
                    _ => Ok(()),
                })
            },
        )
    }

    /// Calls `draw` with the pixel of each vertex that lies in the scissor, and its depth. `far`: whether the far plane clips.
    #[inline(always)]
    fn each_point<E>(
        &self,
        far: bool,
        scissor: &Scissor,
        mut draw: impl FnMut(Span, u16) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        let mut statistics = Statistics::default();
        let mesh = TransformedMesh::<V, true>::with_cache(self, far, &[]);
        for index in 0..self.mesh().vertices.len() {
            // `index as u16` is exact: a mesh has at most 65536 vertices.
            match mesh.vertex(index as u16) {
                Some(vertex) => {
                    statistics.drawn += 1;
                    let Pixel { x, y } = vertex.point.pixel();
                    let (x, y) = (i32::from(x), i32::from(y));
                    if scissor.rows().contains(&y) && scissor.columns().contains(&x) {
                        draw(Span { x, y, width: 1, height: 1 }, vertex.step())?;
                    }
                }
                None => statistics.outside += 1,
            }
        }
        Ok(statistics)
    }

    /// Draws lines from each vertex to the next as one polyline. It is closed if the last vertex equals the first. The pixel at
    /// a joint of two lines is drawn once, with the line that ends there; [`AntiAliased`](crate::shading::AntiAliased) says what anti-aliased
    /// lines cover there. Lines are clipped, and tested in a target with a depth buffer, as in [`Edges::draw`](crate::draw::Edges::draw); then each
    /// line draws its pixel at a joint.
    ///
    /// ```
    /// use embedded_graphics::{geometry::{Point, Size}, mock_display::MockDisplay, pixelcolor::BinaryColor};
    /// use pinhole::{camera::Window, prelude::*};
    /// // A plot: a mesh without faces is a list of points.
    /// let mesh = Mesh::new(&[[0, 0, 0], [2, 3, 0], [4, 1, 0]], 0, &[])?;
    /// let [zero, one, four, five] = [0, 1, 4, 5].map(Scalar::from_int);
    /// let viewport = Viewport::new(Point::zero(), Size::new(5, 4))?;
    /// let window = Window { left: zero, right: five, bottom: zero, top: four };
    /// let (front, up) = (Vector3::from_ints(0, 0, 1), Vector3::from_ints(0, 1, 0));
    /// let view = ViewTransform::from_reference(Point3::from_f32(-0.5, -0.5, 0.0)?, front, up)?; // to pixel centres
    /// let camera = Camera::new(&view, &Projection::orthographic(window, -one, one)?, &viewport);
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let mut display = MockDisplay::new(); // which refuses a pixel that is drawn twice
    /// instance.polyline(BinaryColor::On, &mut display)?;
    /// display.assert_pattern(&["  #  ", " # # ", " #  #", "#    "]); // up by 3 in 2 columns, and down by 2 in 2
    /// let mut display = MockDisplay::new();
    /// instance.points(BinaryColor::On, &mut display)?;
    /// display.assert_pattern(&["  #  ", "     ", "    #", "#    "]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn polyline<T: Target, K: StrokeFor<T::Surface>>(
        &self,
        stroke: K,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        target.dispatch(
            stroke,
            |stroke, surface| self.polyline_untested(stroke, surface),
            |stroke, surface, depth| self.polyline_depth_tested(stroke, depth, surface),
        )
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn polyline_depth_tested<T: Surface, K: StrokeFor<T>>(
        &self,
        stroke: K,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let region = DrawRegion::shared(&target.area(), self.area(), Some(depth));
        let mesh = TransformedMesh::<V, true>::with_cache(self, true, &[]);
        let (count, mut statistics) = (self.mesh().vertices.len(), Statistics::default());
        for index in 1..count {
            // `index as u16` is exact: a mesh has at most 65536 vertices.
            if let Some(ends) = mesh.edge([(index - 1) as u16, index as u16], &mut statistics) {
                draw_nearer(&ends, stroke, &region, depth, target)?;
            }
        }
        Ok(statistics.with_the_rest_drawn(count.saturating_sub(1)))
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn polyline_untested<T: Surface, K: StrokeFor<T>>(
        &self,
        stroke: K,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let DrawRegion { scissor, viewport } = DrawRegion::new(target, self.area());
        let mut statistics = Statistics::default();
        let vertices = self.mesh().vertices;
        // `index as u16` is exact: a mesh has at most 65536 vertices.
        let mesh = TransformedMesh::<V, false>::with_cache(self, false, &[]);
        let pixel = |index: usize| mesh.vertex(index as u16).map(|vertex| vertex.point.pixel());
        let count = vertices.len();
        let first = if count == 0 { None } else { pixel(0) };
        // If all vertices lie in one pixel, no later line returns to it: not closed.
        let closed = count > 2
            && first.is_some()
            && pixel(count - 1) == first
            && (1..count).any(|index| pixel(index) != first);
        // The pixel not to draw again: where the previous line ended or, for the first line, where the last one will end.
        let mut joint = if closed { first } else { None };
        for index in 1..count {
            if <K::Access as Access>::READS {
                // Each line draws its part of a joint.
                if let Some(ends) = mesh.edge([(index - 1) as u16, index as u16], &mut statistics) {
                    anti_aliased::edge(&ends, &viewport, &scissor, stroke, target);
                }
                continue;
            }
            // An end that is clipped is no joint.
            let is_joint = pixel(index).is_some();
            match mesh.edge([(index - 1) as u16, index as u16], &mut statistics) {
                Some([a, b]) => {
                    let (a, b) = (a.point.pixel(), b.point.pixel());
                    raster::line(a, b, &scissor, |span| match without(span, joint) {
                        Some(span) => target.fill(span, stroke.color()),
                        None => Ok(()),
                    })?;
                    joint = Some(b).filter(|_| is_joint);
                }
                None => joint = None,
            }
        }
        Ok(statistics.with_the_rest_drawn(count.saturating_sub(1)))
    }
}

/// The span without a pixel, if that is at one of its ends.
fn without(span: Span, pixel: Option<Pixel>) -> Option<Span> {
    let Some(pixel) = pixel else { return Some(span) };
    let (x, y) = (i32::from(pixel.x), i32::from(pixel.y));
    let Span { width, height, .. } = span;
    let first = (x, y) == (span.x, span.y);
    let last = (x, y) == (span.x + width - 1, span.y + height - 1);
    let tall = height > 1;
    let (dx, dy) = if tall { (0, 1) } else { (1, 0) };
    match (first, last) {
        (false, false) => Some(span),
        (true, true) => None,
        (true, false) => Some(Span { x: x + dx, y: y + dy, width: width - dx, height: height - dy }),
        (false, true) => Some(Span { width: width - dx, height: height - dy, ..span }),
    }
}
