//! The same picture with a depth buffer: what painter's order should look like.

use crate::canvas::Canvas;
use embedded_graphics::pixelcolor::raw::RawU24;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::raster::{area, triangle, Scissor, ScreenPoint, Span};
use pinhole::Placed;
use std::convert::Infallible;

/// No face.
pub(crate) const NOTHING: u32 = 0xFF_FFFF;

/// The face that each pixel shows by depth, row by row.
///
/// The exact plane through the three screen points with their depths, at the pixel's centre, in `f64`; of equal depths
/// the first face stays. `None` if a vertex cannot be projected, since faces are not clipped here.
pub(crate) fn nearest_faces(placed: &Placed<'_>, size: Size) -> Option<Vec<u32>> {
    let mesh = placed.mesh();
    let corners: Vec<(ScreenPoint, u16)> =
        (0..mesh.vertices().len()).map(|vertex| placed.project(vertex)).collect::<Option<_>>()?;
    let (width, height) = (size.width as i32, size.height as i32);
    let scissor = Scissor::new(0, 0, width, height);
    let mut nearest = vec![(f64::INFINITY, NOTHING); (width * height) as usize];
    for (index, face) in mesh.faces().iter().enumerate() {
        let [a, b, c] = face.map(|vertex| corners[usize::from(vertex)]);
        let points = [a.0, b.0, c.0];
        if area(&points) <= 0 {
            continue;
        }
        let depth = plane([a, b, c]);
        let covered: Result<(), Infallible> = triangle(points, &scissor, |span: Span| {
            for y in span.y..span.y + span.height {
                for x in span.x..span.x + span.width {
                    let here = depth(f64::from(x) + 0.5, f64::from(y) + 0.5);
                    let pixel = &mut nearest[(y * width + x) as usize];
                    if here < pixel.0 {
                        *pixel = (here, index as u32);
                    }
                }
            }
            Ok(())
        });
        covered.unwrap_or_else(|never| match never {});
    }
    Some(nearest.into_iter().map(|(_, face)| face).collect())
}

/// Depth as a function of the place on the screen, in pixels.
fn plane(corners: [(ScreenPoint, u16); 3]) -> impl Fn(f64, f64) -> f64 {
    let [a, b, c] =
        corners.map(|(p, depth)| [f64::from(p.x()) / 256.0, f64::from(p.y()) / 256.0, f64::from(depth)]);
    let [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let determinant = ux * vy - uy * vx;
    let along_x = (uz * vy - uy * vz) / determinant;
    let along_y = (ux * vz - uz * vx) / determinant;
    move |x, y| a[2] + (x - a[0]) * along_x + (y - a[1]) * along_y
}

/// A face's number as a colour, to see which face a pixel shows.
pub(crate) fn face_colour(face: usize) -> Rgb888 {
    Rgb888::from(RawU24::new(face as u32))
}

/// The number back.
fn face_of(colour: Rgb888) -> u32 {
    RawU24::from(colour).into_inner()
}

/// The pixels that show another face than the nearest.
pub(crate) fn differing(painted: &Canvas<Rgb888>, nearest: &[u32]) -> usize {
    let shown = painted.pixels().iter().map(|&colour| face_of(colour));
    shown.zip(nearest).filter(|(shown, nearest)| shown != *nearest).count()
}
