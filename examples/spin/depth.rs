//! The picture with a depth buffer, to compare painter's order with. Each face has its own colour, which identifies it in every
//! pixel.

use embedded_graphics::pixelcolor::raw::RawU24;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::raster::{area, triangle, Scissor};
use pinhole::{MeshInstance, Projected};
use pinhole_apps_support::canvas::Canvas;
use std::convert::Infallible;

/// The colour of the background, which no face has.
pub(crate) const NOTHING: Rgb888 = Rgb888::WHITE;

/// The colour of a face: its index.
pub(crate) fn face_colour(face: usize) -> Rgb888 {
    RawU24::new(face as u32).into()
}

/// The nearest front face of each pixel. Indices of the second mesh follow those of the first.
///
/// Depth is the exact plane through the three screen points with their depths, at the pixel's
/// centre, in `f64`; of faces with equal depths the first one wins. `None` if a vertex cannot be projected,
/// since faces are not clipped here.
pub(crate) fn nearest_faces(instances: &[MeshInstance<'_>; 2], size: Size) -> Option<Canvas<Rgb888>> {
    let scissor = Scissor::new(0, 0, size.width as i32, size.height as i32);
    let mut nearest = Canvas::new(size, f64::INFINITY);
    let mut shown = Canvas::new(size, NOTHING);
    let faces = instances.iter().flat_map(|p| p.mesh().faces().iter().map(move |face| (p, face)));
    for (number, (instance, face)) in faces.enumerate() {
        let [a, b, c] = face.map(|vertex| instance.project(vertex.into()));
        let face = [a.ok()?, b.ok()?, c.ok()?];
        let points = face.map(|corner| corner.point);
        if area(&points) <= 0 {
            continue;
        }
        let depth = plane(face);
        let covered: Result<(), Infallible> = triangle(points, &scissor, |span| {
            let size = Size::new(span.width as u32, span.height as u32);
            for pixel in Rectangle::new(Point::new(span.x, span.y), size).points() {
                let here = depth(f64::from(pixel.x) + 0.5, f64::from(pixel.y) + 0.5);
                if here < *nearest.pixel(pixel) {
                    *nearest.pixel(pixel) = here;
                    *shown.pixel(pixel) = face_colour(number);
                }
            }
            Ok(())
        });
        covered.unwrap_or_else(|never| match never {});
    }
    Some(shown)
}

/// Depth as a function of screen coordinates in pixels.
fn plane(corners: [Projected; 3]) -> impl Fn(f64, f64) -> f64 {
    let [a, b, c] = corners.map(|Projected { point: p, depth }| {
        [f64::from(p.x()) / 256.0, f64::from(p.y()) / 256.0, f64::from(depth)]
    });
    let [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let determinant = ux * vy - uy * vx;
    let along_x = (uz * vy - uy * vz) / determinant;
    let along_y = (ux * vz - uz * vx) / determinant;
    move |x, y| a[2] + (x - a[0]) * along_x + (y - a[1]) * along_y
}

/// How many pixels show different faces, and how many show one at all.
pub(crate) fn compare(painted: &Canvas<Rgb888>, nearest: &Canvas<Rgb888>) -> (usize, usize) {
    let pairs = || painted.pixels().iter().zip(nearest.pixels());
    let differing = pairs().filter(|(shown, nearest)| shown != nearest).count();
    (differing, pairs().filter(|(_, nearest)| **nearest != NOTHING).count())
}
