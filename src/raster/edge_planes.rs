//! The planes of the faces beside an edge: how far from the viewer the surface is in the pixels of the edge.
//!
//! The centre of an edge's pixel lies up to a pixel beside the edge, where a steep face is much nearer or farther than the edge itself,
//! and often outside of the faces beside the edge: beyond a vertex, or beyond a face that is seen almost edge-on. The face that
//! covers the centre there may be any other face of the object. On a convex object it never lies in front of the plane of a
//! front face, however far the plane is continued. So the plane tells the object's own faces from one that hides the edge.

use super::{LineDepth, ScreenPoint};
use crate::math::num::mul_called;

/// The planes through an edge, at most one on each side of it on the screen.
///
/// With S(p) = [`area`](super::area) of the edge's ends and a point p, and a point c of a face, the face's plane has the depth
///
/// ```text
///     line(p) + S(p) · (z(c) − line(c)) / S(c)
/// ```
///
/// at p, where line is the depth along the edge without its ends. All planes on one side pass through the edge, so the
/// nearest one has the least of these quotients, and is the only one stored.
pub(crate) struct EdgePlanes {
    /// Whether the edge's major axis is y.
    tall: bool,
    /// The first end's coordinate along the major axis, the depth there in 16.8, and its change per pixel in 16.16.
    from: i32,
    depth: i32,
    step: i32,
    /// S at the centre of the pixel in column 0 and row 0, which wraps, and its change per pixel along the major and the minor axis.
    side: i32,
    by_major: i32,
    by_minor: i32,
    /// S of a point 1/64 pixel from the edge along the minor axis. Vertices are rounded to 1/256 pixel, so a plane is uncertain by about
    /// as much.
    margin: i32,
    /// The planes where S is positive, and where it is negative.
    planes: [Option<Plane>; 2],
}

/// A plane through an edge, by the quotient of z(c) − line(c) in 16.8 and |S(c)|, at least the margin.
#[derive(Clone, Copy)]
struct Plane {
    rise: i32,
    run: i32,
}

impl Plane {
    /// Shifts both numbers down until they have 31 bits; most have. A run has more only if the face is hundreds of pixels high: then 1/256 step less counts for nothing.
    #[inline(always)]
    fn new(rise: i64, run: i64) -> Self {
        let bits = rise.unsigned_abs() | run as u64;
        if bits >> 31 == 0 {
            return Self { rise: rise as i32, run: run as i32 };
        }
        let excess = 33_u32.saturating_sub(bits.leading_zeros());
        Self { rise: (rise >> excess) as i32, run: (run >> excess) as i32 }
    }
}

impl EdgePlanes {
    /// An edge without faces, with the depths of its ends in 16.8 and the depth along the line between them.
    #[inline(always)]
    pub(crate) fn new(ends: &[ScreenPoint; 2], depths: [i32; 2], line: &LineDepth) -> Self {
        let ([from, to], [first, last]) = (ends, depths);
        let (tall, step) = line.step();
        // An edge in one pixel has the depth of its nearer end everywhere, as `LineDepth` has it.
        let depth = if step == 0 { first.min(last) } else { first };
        let [dx, dy] = [to.x - from.x, to.y - from.y]; // at most 2²²
        let margin = 4 * dx.abs().max(dy.abs());
        // S = dy · (x − from.x) − dx · (y − from.y), modulo 2³².
        let side = dy.wrapping_mul(128 - from.x).wrapping_sub(dx.wrapping_mul(128 - from.y));
        let [by_x, by_y] = [dy << 8, dx.wrapping_neg() << 8];
        let (from, by_major, by_minor) = if tall { (from.y, by_y, by_x) } else { (from.x, by_x, by_y) };
        Self { tall, from, depth, step, side, by_major, by_minor, margin, planes: [None; 2] }
    }

    /// Stores [`new`](Self::new): a returned value would be copied.
    #[inline(never)]
    pub(crate) fn set(to: &mut Option<Self>, ends: &[ScreenPoint; 2], depths: [i32; 2], line: &LineDepth) {
        *to = Some(Self::new(ends, depths, line));
    }

    /// Adds the plane of a face with this corner, at a depth in 16.8, and its S.
    #[inline(never)] // code size: it has two callers
    pub(crate) fn add(&mut self, corner: ScreenPoint, depth: i32, side: i64) {
        let run = side.abs().max(self.margin.max(1).into()); // at most 2⁴⁵
        let rise = i64::from(depth) - self.line(corner); // at most 2³¹ · 2²² · 2⁻¹⁶
        let plane = Plane::new(rise, run);
        let [positive, negative] = &mut self.planes;
        let nearest = if side > 0 { positive } else { negative };
        let is_nearer = |other: Plane| mul_called(plane.rise, other.run) < mul_called(other.rise, plane.run);
        if nearest.is_none_or(is_nearer) {
            *nearest = Some(plane);
        }
    }

    /// Depth along the edge without its ends, in 16.8, by a coordinate along the major axis.
    #[inline(always)]
    fn line_at(&self, major: i32) -> i64 {
        i64::from(self.depth) + (mul_called(self.step, major - self.from) >> 16)
    }

    /// Depth along the edge without its ends, in 16.8.
    fn line(&self, p: ScreenPoint) -> i64 {
        self.line_at(if self.tall { p.y } else { p.x })
    }

    /// Whether a plane on the side of a pixel's centre is at least as near there as a stored depth, or less than a step behind it:
    /// both are rounded. The pixel, by its coordinates along the major and the minor axis, is one of the edge as a line, anti-aliased or not.
    #[inline(never)] // the loop over pixels keeps its registers
    pub(crate) fn are_in_front(&self, stored: u16, [major, minor]: [i32; 2]) -> bool {
        // The centre lies within 1.71 pixels of the edge along the minor axis, and the edge is at most 2²² units long: S and the
        // margin are below 2³¹ together, and sums that wrap give S.
        let by_minor = self.by_minor.wrapping_mul(minor);
        let side = self.side.wrapping_add(self.by_major.wrapping_mul(major)).wrapping_add(by_minor);
        // Below 2²⁶: the centre is less than a pixel beyond the ends.
        let behind = ((i32::from(stored) + 1) << 8).wrapping_sub(self.line_at(major * 256 + 128) as i32);
        let [positive, negative] = &self.planes;
        [(positive, side), (negative, side.wrapping_neg())].into_iter().any(|(plane, side)| {
            let Some(Plane { rise, run }) = *plane else { return false };
            // Where the plane is nearest within the margin.
            let [less, more] = [side.wrapping_sub(self.margin), side.wrapping_add(self.margin)];
            more >= 0 && mul_called(behind, run) >= mul_called(rise, if rise < 0 { more } else { less })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, FARTHEST};

    /// Edges from a pixel to the width of the guard band, faces from slivers to as large, and pixels beside the edge and beyond its
    /// ends: a plane is in front exactly if it is so in rationals, except within the rounding of depths to 1/256 step and of steps
    /// along the edge to 2⁻¹⁷.
    #[test]
    fn a_plane_is_in_front_as_in_rationals() {
        let mut random = Random(5);
        let mut counts = [0; 2];
        for i in 0..300_000 {
            let reach = [400, 3_000, 40_000, 1 << 21][i % 4];
            let mut point = || [0; 2].map(|_| random.within(reach));
            let [a, b, mut c] = [point(), point(), point()];
            let mut z = || random.below(i64::from(FARTHEST) + 1) as i32;
            let depths = [z(), z(), z()];
            if i % 3 == 0 {
                // A sliver beside the edge.
                let t = random.below(257);
                c = [0, 1].map(|k| a[k] + ((i64::from(b[k] - a[k]) * t) >> 8) as i32 + random.within(200));
            }
            let [from, to, corner] = [a, b, c].map(|p| ScreenPoint::inside(p[0], p[1]));
            let [p, q] = [from.pixel(), to.pixel()];
            let tall = (i32::from(p.y) - i32::from(q.y)).abs() > (i32::from(p.x) - i32::from(q.x)).abs();
            let major = usize::from(tall);
            let length = i128::from(b[major] - a[major]);
            if length.abs() < 1024 {
                continue; // depth may change by more than half of its range within a pixel
            }
            let (ends, depths_of_ends) = ([from, to], [depths[0], depths[1]]);
            let mut planes = EdgePlanes::new(&ends, depths_of_ends, &LineDepth::new(ends, depths_of_ends));
            let side = area(&[from, to, corner]);
            planes.add(corner, depths[2], side);
            // A pixel on the line, within 1.7 pixels along the minor axis.
            let t = random.below(260) - 2;
            let on = [0, 1].map(|k| a[k] + ((i64::from(b[k] - a[k]) * t) >> 8) as i32);
            let mut pixel = on.map(|v| v >> 8);
            pixel[1 - major] += random.within(2);
            let centre = pixel.map(|v| 256 * v + 128);
            let s = i128::from(area(&[from, to, ScreenPoint::clamped(centre[0], centre[1])]));
            if s.abs() > length.abs() * 435 || centre.iter().any(|v| v.abs() > 1 << 21) {
                continue;
            }
            // In 2⁻⁸ step over length and run.
            let line = |p: [i32; 2]| {
                i128::from(depths[0]) * length
                    + i128::from(depths[1] - depths[0]) * i128::from(p[major] - a[major])
            };
            let margin = i128::from(planes.margin);
            let run = i128::from(side).abs().max(margin);
            let rise = i128::from(depths[2]) * length - line(c);
            let s = if side > 0 { s } else { -s };
            let at = |s: i128| line(centre) * run + rise * s;
            let whole = length * run;
            let nearest = if (rise < 0) == (length > 0) { at(s + margin) } else { at(s - margin) };
            let (nearest, whole) = if whole < 0 { (-nearest, -whole) } else { (nearest, whole) };
            let exact = nearest as f64 / whole as f64 / 256.0;
            let reach = (s.abs() + margin) as f64 / run as f64;
            let pixels = |p: [i32; 2]| f64::from((p[major] - a[major]).abs()) / 256.0;
            let error = (pixels(centre) + pixels(c) * reach) / 131_072.0 + (2.0 + reach) / 256.0;
            for by in [-2.0, -error, error, 2.0] {
                let stored = (exact - 1.0 + by).floor();
                if !(0.0..65_535.0).contains(&stored) {
                    continue;
                }
                let is_in_front = planes.are_in_front(stored as u16, [pixel[major], pixel[1 - major]]);
                let ahead = stored + 1.0 - exact;
                if s + margin < 0 {
                    assert!(!is_in_front);
                } else if ahead.abs() > error {
                    assert_eq!(
                        is_in_front,
                        ahead > 0.0,
                        "{a:?} {b:?} {c:?} {depths:?} {pixel:?} {ahead} {error}"
                    );
                    counts[usize::from(is_in_front)] += 1;
                }
            }
        }
        assert!(counts.iter().all(|&count| count > 50_000), "{counts:?}");
    }

    /// Of the faces on one side of an edge the nearest one decides, in any order of adding.
    #[test]
    fn the_nearest_plane_of_a_side_decides() {
        let point = |x: i32, y: i32| ScreenPoint::inside(x << 8, y << 8);
        let mut random = Random(6);
        let none = EdgePlanes::new(&[point(0, 0); 2], [0; 2], &LineDepth::new([point(0, 0); 2], [0; 2]));
        assert!(!none.are_in_front(9, [0, 0]));
        for _ in 0..10_000 {
            let mut face =
                || (point(random.within(30), 1 + random.below(40) as i32), random.below(3_000_000) as i32);
            let (faces, stored) = ([face(), face(), face()], random.below(12_000) as u16);
            let ends = ([point(-20, 0), point(20, 0)], [1_500_000; 2]);
            let of = |faces: &[(ScreenPoint, i32)]| {
                let mut planes = EdgePlanes::new(&ends.0, ends.1, &LineDepth::new(ends.0, ends.1));
                for &(corner, depth) in faces {
                    let side = area(&[ends.0[0], ends.0[1], corner]);
                    planes.add(corner, depth, side);
                }
                [0, -1].map(|y| planes.are_in_front(stored, [3, y]))
            };
            let each = faces.map(|face| of(&[face])[0]);
            let [a, b, c] = faces;
            for order in [[a, b, c], [c, b, a], [b, a, c]] {
                assert_eq!(of(&order), [each.contains(&true), false]);
            }
        }
    }
}
