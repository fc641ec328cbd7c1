//! Points, for plots and the anchors of labels.

use super::draw_region::DrawRegion;
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::math::Coordinate;
use crate::raster::{Pixel, Scissor, Span};
use crate::surface::{Surface, Target};

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Draws each vertex as one pixel. Into a target [with a depth buffer](crate::target::Surface::depth_tested) it draws those that
    /// are as near as the buffer or nearer, and stores their depth.
    ///
    /// ```
    /// use embedded_graphics::{geometry::{Point, Size}, mock_display::MockDisplay, pixelcolor::BinaryColor};
    /// use pinhole::{camera::Window, prelude::*};
    /// // A plot: a mesh without faces is a list of points, which edges connect.
    /// const PATH: [[u16; 2]; 2] = [[0, 1], [1, 2]];
    /// let mesh = Mesh::new(&[[0, 0, 0], [2, 3, 0], [4, 1, 0]], 0, &[])?.with_edges(&PATH)?;
    /// let [zero, one, four, five] = [0, 1, 4, 5].map(Scalar::from_int);
    /// let viewport = Viewport::new(Point::zero(), Size::new(5, 4))?;
    /// let window = Window { left: zero, right: five, bottom: zero, top: four };
    /// let (front, up) = (Vector3::from_ints(0, 0, 1), Vector3::from_ints(0, 1, 0));
    /// let view = ViewTransform::from_reference(Point3::from_f32(-0.5, -0.5, 0.0)?, front, up)?; // to pixel centres
    /// let camera = Camera::new(&view, &Projection::orthographic(window, -one, one)?, &viewport);
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let mut display = MockDisplay::new();
    /// instance.points(BinaryColor::On, &mut display)?;
    /// display.assert_pattern(&["  #  ", "     ", "    #", "#    "]);
    /// display.set_allow_overdraw(true);
    /// instance.edges(|_| BinaryColor::On).draw(&mut display)?;
    /// display.assert_pattern(&["  #  ", " # # ", " #  #", "#    "]); // up by 3 in 2 columns, and down by 2 in 2
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
}
