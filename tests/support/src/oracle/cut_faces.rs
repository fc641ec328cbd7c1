//! Colours of a face that planes of the view volume cut, in f64: the clipped polygon in clip space, its fan of triangles
//! on the screen, and the level of each channel at a pixel's center.
//!
//! A channel at a cut corner is the linear interpolation in clip space of the channel at the ends of the cut edge, which
//! is perspective-correct along that edge. Over each triangle of the fan a channel is linear on the screen. (Sutherland
//! and Hodgman, *Reentrant polygon clipping*, 1974; Gouraud, *Continuous shading of curved surfaces*, 1971.)

use super::chain::{self, Camera, V4};

/// A position on the screen in pixels, y down.
type Screen = (f64, f64);

/// The guard band in pixels, about the origin of the screen.
const GUARD_BAND: f64 = 8192.0;

/// A corner in clip space, and the levels of up to three channels.
pub type Corner = [f64; 7];

/// A triangle of the fan.
#[derive(Clone, Debug)]
pub struct Piece {
    pub screen: [Screen; 3],
    corners: [Corner; 3],
}

/// Twice the signed area of a triangle on the screen.
fn doubled_area(a: Screen, b: Screen, c: Screen) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// Signed distances from the planes near, left, right, top and bottom of the guard band, and far: negative outside.
fn distances(camera: &Camera, clip: V4) -> [f64; 6] {
    let [x, y, w] = camera.homogeneous_screen(clip);
    let near = clip[2] + clip[3];
    let far = clip[3] - clip[2];
    [near, GUARD_BAND * w + x, GUARD_BAND * w - x, GUARD_BAND * w + y, GUARD_BAND * w - y, far]
}

/// The part of a face inside the near plane, the guard band and, on request, the far plane, as a fan of triangles about
/// the polygon's first corner. Seen from behind, the polygon is walked backwards. The second value says whether the
/// planes left the corners as they were.
pub fn pieces(camera: &Camera, corners: &[Corner; 3], far: bool) -> (Vec<Piece>, bool) {
    let clip = |&[x, y, z, w, ..]: &Corner| [x, y, z, w];
    let planes = 0..5 + usize::from(far);
    let cut = |all: Vec<_>, plane| chain::cut(&all, |corner| distances(camera, clip(corner))[plane]);
    let mut polygon = planes.fold(corners.to_vec(), cut);
    let whole = polygon == corners;
    let screen = |corner: &Corner| camera.screen(clip(corner));
    let area = |k: usize| doubled_area(screen(&polygon[0]), screen(&polygon[k - 1]), screen(&polygon[k]));
    // y points down: counter-clockwise is negative.
    if (2..polygon.len()).map(area).sum::<f64>() > 0.0 {
        polygon.reverse();
    }
    let triangle = |k: usize| {
        let corners = [polygon[0], polygon[k - 1], polygon[k]];
        Piece { screen: corners.each_ref().map(screen), corners }
    };
    ((2..polygon.len()).map(triangle).collect(), whole)
}

impl Piece {
    /// How far a point lies inside the triangle, in pixels.
    pub fn inside(&self, p: Screen) -> f64 {
        let [a, b, c] = self.screen;
        let side = doubled_area(a, b, c).signum();
        let from = |a: Screen, b: Screen| side * doubled_area(a, b, p) / (b.0 - a.0).hypot(b.1 - a.1);
        from(a, b).min(from(b, c)).min(from(c, a))
    }

    /// The level of a channel at a point.
    pub fn level(&self, channel: usize, p: Screen) -> f64 {
        let ([a, b, c], of) = (self.screen, |i: usize| self.corners[i][4 + channel]);
        let weights = [doubled_area(p, b, c), doubled_area(a, p, c), doubled_area(a, b, p)];
        (weights[0] * of(0) + weights[1] * of(1) + weights[2] * of(2)) / doubled_area(a, b, c)
    }

    /// The largest change of a channel's level if each corner moves by `distance` pixels and the levels move along: by
    /// the gradient times that distance for each corner.
    pub fn change(&self, channel: usize, distance: f64) -> f64 {
        let (t, of) = (self.screen, |i: usize| self.corners[i][4 + channel]);
        let slope = |of_x: bool| {
            let c = |i: usize| if of_x { t[i].1 } else { t[i].0 };
            let (u, v) = (c(1) - c(0), c(2) - c(0));
            ((of(1) - of(0)) * v - (of(2) - of(0)) * u) / doubled_area(t[0], t[1], t[2])
        };
        3.0 * distance * slope(true).hypot(slope(false))
    }
}
