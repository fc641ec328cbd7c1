//! Clipping of lines and polygons against planes in homogeneous coordinates, before the perspective divide.
//!
//! The pipeline clips against the near plane, the guard band and, on request, the far plane; the rasteriser's scissor does the rest.

use crate::math::hints::{keep_rolled, opaque_next};
use crate::math::num::{fraction, proper_fraction};
use crate::math::ClipCoords;
use heapless::Vec;

/// The most clip planes.
const PLANES: usize = 6;

/// The most corners of a triangle clipped against six planes: 3 + 6.
const CORNERS: usize = 9;

/// Slots for a polygon's corners while it is clipped by one plane: it has at most `CORNERS − 1` corners before, and two are
/// added before any is removed.
pub(crate) const CLIP_SLOTS: usize = CORNERS + 1;

/// The corners of a polygon, in order, by slot number.
pub(crate) type SlotOrder = Vec<u8, CORNERS>;

/// What the clipper needs of its corners, which it knows by slot number: their distances from clip planes, and points between
/// two of them. Corners may be anything that varies linearly along an edge.
pub(crate) trait ClipCorners {
    /// The signed distance of the corner in slot `at` from a plane, negative outside. The distances of the two ends of an
    /// intersected edge differ by less than 2⁶².
    fn distance(&self, plane: usize, at: usize) -> i64;

    /// The planes that the corner in slot `at` lies outside of, one bit each. Distances from others may be negative, too.
    fn planes_outside(&self, at: usize) -> u32;

    /// Stores the point at parameter `t`·2⁻³¹ from corner `inside` to corner `outside` in slot `at`, which may be the slot of either.
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

/// Linear interpolation `a + (b − a)·t·2⁻³¹`, rounded to nearest, for 0 ≤ t < 2³¹.
#[inline(never)] // rare path: code size counts
fn lerp(a: i32, b: i32, t: i32) -> i32 {
    let difference = i64::from(b) - i64::from(a); // 33 bits signed, times 31: below 2⁶³
    let moved = (difference * i64::from(t) + (1 << 30)) >> 31;
    a.wrapping_add(moved as i32) // between a and b
}

impl ClipCoords {
    /// The initial value of free slots.
    pub(crate) const ZERO: Self = Self { xydw: [0; 4] };

    /// Writes to slot `at` the point at `t`·2⁻³¹ of the way from slot `inside` to slot `outside`; `at` may be either of them.
    pub(crate) fn put(slots: &mut [Self], at: usize, inside: usize, outside: usize, t: i32) {
        let (Some(&Self { xydw: a }), Some(&Self { xydw: b })) = (slots.get(inside), slots.get(outside))
        else {
            return;
        };
        if let Some(Self { xydw }) = slots.get_mut(at) {
            let ([x, y, d, w], [p, q, r, s]) = (a, b);
            *xydw = [lerp(x, p, t), lerp(y, q, t), lerp(d, r, t), lerp(w, s, t)];
        }
    }
}

/// A varying: a per-corner value that is linear in space, such as a colour or a texture coordinate, and is interpolated when a
/// face is clipped. Custom [`Shader`](crate::shading::Shader)s name one; most use [`Barycentric`].
///
/// ```
/// use pinhole::shading::{Barycentric, Varying};
/// let (a, b) = (Barycentric::of(0), Barycentric::of(1));
/// assert_eq!(a.towards(&b, 1 << 29).weights(), [3 << 28, 1 << 28, 0]); // a quarter of the way
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be interpolated where a face is clipped",
    label = "not a `Varying`",
    note = "use `()` if nothing varies over a face, `Barycentric` for the weights of the corners, or implement `Varying`"
)]
pub trait Varying: Copy {
    /// The value at corner 0, 1 or 2 of the unclipped face.
    fn of(corner: usize) -> Self;

    /// The value at parameter `t`·2⁻³¹ from this point to `other`. The clipper passes 0 ≤ t < 2³¹.
    #[must_use]
    fn towards(&self, other: &Self, t: i64) -> Self;
}

impl Varying for () {
    fn of(_: usize) {}

    fn towards(&self, (): &(), _: i64) {}
}

/// Barycentric coordinates of a point of a face, in 2⁻³⁰: linear in space, not on the screen. Each clip plane rounds the first
/// two to nearest; the third is 1 minus their sum, so its error is up to twice as large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Barycentric([i32; 2]);

impl Barycentric {
    /// One weight per corner of the face; their sum is 2³⁰. The first two are 0 … 2³⁰. The third is −6 … 2³⁰ + 6, because each
    /// of six clip planes may add an error of 1.
    pub const fn weights(self) -> [i32; 3] {
        let [a, b] = self.0;
        [a, b, (1 << 30) - a - b] // a, b: 0 … 2³⁰
    }
}

impl Varying for Barycentric {
    fn of(corner: usize) -> Self {
        Self([0, 1].map(|i| i32::from(i == corner) << 30))
    }

    fn towards(&self, other: &Self, t: i64) -> Self {
        // A `t` outside of 0 … 2³¹ − 1 counts as the nearer end of that range, so the weights stay between both ends.
        let t = t.clamp(0, i64::from(i32::MAX)) as i32;
        let ([a, b], [p, q]) = (self.0, other.0);
        Self([lerp(a, p, t), lerp(b, q, t)])
    }
}

/// Stores the intersection of an edge with a plane in slot `at`. It is computed from the inside end, so that both faces at an
/// edge get the same point. The parameter has 31 bits and each coordinate is rounded to nearest: within one unit plus 2⁻³¹ of
/// the edge's extent.
#[inline(never)] // rare path: code size counts
fn intersect_edge(corners: &mut impl ClipCorners, plane: usize, at: usize, inside: usize, outside: usize) {
    // 0 ≤ `within`, outside < 0, `within` + |outside| < 2⁶²: t in 2⁻³¹, below 1. A corner on the screen may lie up to half a sub-pixel
    // outside of the guard band: its distance counts as 0.
    let within = corners.distance(plane, inside).max(0);
    let across = within - corners.distance(plane, outside);
    let t = match u32::try_from(across) {
        Ok(across) => proper_fraction(within as u32, across), // always for the near plane
        Err(_) => fraction(within as u64, across as u64, 31) as i32,
    };
    corners.put(at, inside, outside, t);
}

/// Clips the line from corner 0 to corner 1 against all planes. Returns whether it was clipped, or `None` if nothing is left:
/// Cohen–Sutherland in homogeneous coordinates. (Newman and Sproull, *Principles of Interactive Computer Graphics*, 2nd ed.,
/// section 5.1.)
pub(crate) fn clip_line(corners: &mut impl ClipCorners) -> Option<bool> {
    let mut outside = [corners.planes_outside(0), corners.planes_outside(1)];
    let (both, any) = (outside[0] & outside[1], outside[0] | outside[1]);
    if both != 0 {
        return None;
    }
    let mut plane = 0;
    while plane < PLANES && any != 0 {
        match outside.map(|planes| planes >> plane & 1) {
            [0, 0] => {}
            [1, 1] => return None,
            [first, _] => {
                let (inside, cut) = if first == 0 { (0, 1) } else { (1, 0) };
                intersect_edge(corners, plane, cut, inside, cut);
                // A new end may be rounded to the outside of a plane that is still to come.
                if let Some(planes) = outside.get_mut(cut) {
                    *planes = corners.planes_outside(cut);
                }
            }
        }
        plane = opaque_next(plane);
    }
    Some(any != 0)
}

/// Appends a corner. A convex polygon gains at most one corner per plane, so there is room; should rounding make it concave,
/// excess corners are dropped.
fn push_corner(polygon: &mut SlotOrder, corner: u8) {
    let _ = polygon.push(corner); // one of `CLIP_SLOTS`
}

/// Clips the triangle of corners 0, 1 and 2 against all planes, into `polygon`, which has fewer than three corners if nothing
/// is left. Returns whether it was clipped. (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
pub(crate) fn clip_triangle(corners: &mut impl ClipCorners, polygon: &mut SlotOrder) -> bool {
    polygon.clear();
    // The planes that the corner in each slot lies outside of.
    let mut outside = [0u8; CLIP_SLOTS];
    let (mut all, mut any) = (u32::MAX, 0);
    for (at, planes) in outside.iter_mut().enumerate().take(3) {
        keep_rolled();
        push_corner(polygon, at as u8);
        let own = corners.planes_outside(at);
        (all, any, *planes) = (all & own, any | own, own as u8); // six bits
    }
    if all != 0 {
        polygon.clear();
    }
    let crossed = any != 0;
    let planes_of = |outside: &[u8], at: u8| u32::from(outside.get(usize::from(at)).copied().unwrap_or(0));
    let (mut taken, mut plane) = (0b111u32, 0); // occupied slots, one bit each
    while any >> plane != 0 && plane < PLANES {
        let is_beyond = |planes: u32| planes >> plane & 1 != 0;
        let Some(&(mut from)) = polygon.last() else { break };
        if is_beyond(any) {
            let (mut clipped, mut removed) = (SlotOrder::new(), 0);
            any = 0;
            for &to in polygon.iter() {
                let [first, second] = [from, to].map(|at| planes_of(&outside, at));
                if is_beyond(first) != is_beyond(second) {
                    let free = taken.trailing_ones() as usize;
                    if let Some(planes) = outside.get_mut(free) {
                        taken |= 1 << (free & 31);
                        let (inside, beyond) = if is_beyond(second) { (from, to) } else { (to, from) };
                        intersect_edge(corners, plane, free, inside.into(), beyond.into());
                        push_corner(&mut clipped, free as u8);
                        // The new corner counts as inside this plane, even if rounding puts it just outside.
                        let own = corners.planes_outside(free) & !(1 << plane);
                        (any, *planes) = (any | own, own as u8);
                    }
                }
                if is_beyond(second) {
                    removed |= 1 << (to & 31);
                } else {
                    push_corner(&mut clipped, to);
                    any |= second;
                }
                from = to;
            }
            (*polygon, taken) = (clipped, taken & !removed);
        }
        plane = opaque_next(plane);
    }
    crossed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed;

    /// Corners with x, y, z, w, and two weights in 2⁻³⁰, clipped against −w ≤ x, y, z ≤ w; and whether corner 0 counts as inside.
    #[derive(Clone, Copy)]
    struct Volume([[i32; 6]; CLIP_SLOTS], bool);

    fn distances([x, y, z, w, ..]: [i32; 6]) -> [i64; PLANES] {
        let [x, y, z, w] = [x, y, z, w].map(i64::from);
        [w + x, w - x, w + y, w - y, w + z, w - z]
    }

    impl ClipCorners for Volume {
        fn distance(&self, plane: usize, at: usize) -> i64 {
            distances(self.0[at])[plane]
        }

        fn planes_outside(&self, at: usize) -> u32 {
            if self.1 && at == 0 {
                return 0;
            }
            distances(self.0[at]).iter().rev().fold(0, |planes, &d| planes << 1 | u32::from(d < 0))
        }

        fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
            let (a, b) = (self.0[inside], self.0[outside]);
            self.0[at] = core::array::from_fn(|i| lerp(a[i], b[i], t));
        }
    }

    /// The most that six cuts move a coordinate: a half for each cut, and a step of a weight is up to half a unit.
    const OFF: f64 = 6.0;

    /// Points of 30 bits and fewer, on planes and edges of the volume, or anywhere.
    fn point(state: &mut u64) -> [i32; 4] {
        let down = (mixed(state) % 12) as u32;
        let mut any = || match mixed(state) % 8 {
            0 => 0,
            1 => (1 << 29) >> down,
            2 => -((1 << 29) >> down),
            _ => mixed(state) as i32 >> (2 + down),
        };
        [any(), any(), any(), any()]
    }

    fn volume(points: [[i32; 4]; 3]) -> Volume {
        let mut slots = [[0; 6]; CLIP_SLOTS];
        for (i, [x, y, z, w]) in points.into_iter().enumerate() {
            slots[i] = [x, y, z, w, i32::from(i == 1) << 30, i32::from(i == 2) << 30];
        }
        Volume(slots, false)
    }

    /// The part of a segment that lies in the volume, as parameters, by Liang and Barsky's algorithm in f64.
    fn part_inside(a: [i32; 6], b: [i32; 6], margin: f64) -> Option<(f64, f64)> {
        let (mut first, mut last) = (0f64, 1f64);
        for (from, to) in distances(a).into_iter().zip(distances(b)) {
            let (from, to) = (from as f64 + margin, to as f64 + margin);
            match (from < 0.0, to < 0.0) {
                (true, true) => return None,
                (true, false) => first = first.max(from / (from - to)),
                (false, true) => last = last.min(from / (from - to)),
                (false, false) => {}
            }
        }
        (first <= last).then_some((first, last))
    }

    /// A corner on the screen may be rounded to there from outside: what is cut off from it begins there.
    #[test]
    fn what_leaves_from_just_outside_is_cut_there() {
        for beyond in [0, 1, 3] {
            let corner = [(1 << 20) + beyond, 5, 7, 1 << 20];
            let slots = volume([corner, [1 << 23, 1, 2, 1 << 21], [1 << 22, 900, -4, 1 << 20]]).0;
            let (mut line, mut triangle) = (Volume(slots, true), Volume(slots, true));
            assert_eq!(clip_line(&mut line), Some(true));
            assert_eq!(line.0[1][..4], corner);
            let mut order = SlotOrder::new();
            assert!(clip_triangle(&mut triangle, &mut order));
            assert!(order.iter().all(|&at| triangle.0[usize::from(at)][..4] == corner), "{order:?}");
        }
    }

    /// Where a segment is clipped, and that the order of its ends does not matter.
    #[test]
    fn lines_end_where_they_leave_the_volume() {
        let (mut state, mut cut) = (5u64, 0);
        for _ in 0..200_000 {
            let ends = [point(&mut state), point(&mut state)];
            let (mut slots, mut other) =
                (volume([ends[0], ends[1], [0; 4]]), volume([ends[1], ends[0], [0; 4]]));
            let (a, b) = (slots.0[0], slots.0[1]);
            let (got, back) = (clip_line(&mut slots), clip_line(&mut other));
            assert_eq!(got, back, "{ends:?}");
            let Some(clipped) = got else {
                assert_eq!(part_inside(a, b, -OFF), None, "{ends:?} is lost");
                continue;
            };
            cut += usize::from(clipped);
            let (p, q) = (slots.0[0], slots.0[1]);
            assert_eq!([&p[..4], &q[..4]], [&other.0[1][..4], &other.0[0][..4]], "{ends:?}");
            assert!(clipped || (p, q) == (a, b));
            assert!([p, q].iter().all(|&end| distances(end).iter().all(|&d| d as f64 >= -OFF)), "{ends:?}");
            assert!(part_inside(a, b, OFF).is_some(), "{ends:?}: nothing is inside");
            // Each end lies on the segment, at the parameter that its weight says.
            for end in [p, q] {
                let t = f64::from(end[4]) / f64::from(1 << 30);
                for i in 0..4 {
                    let exact = f64::from(a[i]) + (f64::from(b[i]) - f64::from(a[i])) * t;
                    assert!((f64::from(end[i]) - exact).abs() <= OFF, "{ends:?}: {end:?}");
                }
            }
        }
        assert!(cut > 10_000, "{cut}");
    }

    /// Corners of a polygon lie where their weights say, inside the volume; a point of the triangle is in the polygon if it is in the volume;
    /// and triangles that share an edge get equal corners on it.
    #[test]
    fn polygons_are_what_a_triangle_has_in_the_volume() {
        let (mut state, mut cut, mut sampled) = (6u64, 0, [0; 2]);
        for _ in 0..100_000 {
            let [a, b, c, d] = [(); 4].map(|()| point(&mut state));
            let (mut one, mut two) = (volume([a, b, c]), volume([b, a, d]));
            let (corners, mut order, mut other) = (one, SlotOrder::new(), SlotOrder::new());
            cut += usize::from(clip_triangle(&mut one, &mut order) && order.len() >= 3);
            clip_triangle(&mut two, &mut other);
            let polygon: Vec<[i32; 6], CORNERS> = order.iter().map(|&at| one.0[usize::from(at)]).collect();
            let blend = |u: f64, v: f64| -> [f64; 4] {
                core::array::from_fn(|i| {
                    let [a, b, c] = [0, 1, 2].map(|k| f64::from(corners.0[k][i]));
                    a + (b - a) * u + (c - a) * v
                })
            };
            for corner in &polygon {
                let [u, v] = [4, 5].map(|i| f64::from(corner[i]) / f64::from(1 << 30));
                let gaps =
                    blend(u, v).into_iter().zip(corner).map(|(exact, &c)| (exact - f64::from(c)).abs());
                assert!(gaps.fold(0.0, f64::max) <= 2.0 * OFF, "{a:?} {b:?} {c:?}: {corner:?}");
                assert!(
                    distances(*corner).iter().all(|&d| d as f64 >= -OFF),
                    "{a:?} {b:?} {c:?}: {corner:?}"
                );
            }
            // The ends of the shared edge, where it is clipped, are corners of both.
            let mut line = volume([a, b, [0; 4]]);
            if clip_line(&mut line).is_some() && order.len() >= 3 && other.len() >= 3 {
                let has = |slots: &Volume, order: &SlotOrder, end: [i32; 6]| {
                    order.iter().any(|&at| slots.0[usize::from(at)][..4] == end[..4])
                };
                for end in [line.0[0], line.0[1]] {
                    assert!(has(&one, &order, end) && has(&two, &other, end), "{a:?} {b:?} {c:?} {d:?}");
                }
            }
            // A point of the triangle, by the planes and by the polygon's sides, in steps of its weights.
            let mut share = || (mixed(&mut state) >> 33) as f64 / 2f64.powi(31);
            let (u, v) = (share(), share());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let [x, y, z, w] = blend(u, v);
            let least = [w + x, w - x, w + y, w - y, w + z, w - z].into_iter().fold(f64::MAX, f64::min);
            let (u, v) = (u * f64::from(1 << 30), v * f64::from(1 << 30));
            let is_beside = |slack: f64| {
                (0..polygon.len()).all(|i| {
                    let (from, to) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                    let [ax, ay, bx, by] = [from[4], from[5], to[4], to[5]].map(f64::from);
                    let (dx, dy) = (bx - ax, by - ay);
                    let room = slack * ((dx.abs() + dy.abs()) + 2.0 * ((u - ax).abs() + (v - ay).abs()));
                    dx * (v - ay) - dy * (u - ax) >= -room
                })
            };
            if least >= 4.0 * OFF {
                sampled[0] += 1;
                assert!(polygon.len() >= 3 && is_beside(2.0 * OFF), "{a:?} {b:?} {c:?}: {u} {v} is missing");
            } else if least <= -4.0 * OFF && polygon.len() >= 3 {
                sampled[1] += 1;
                assert!(!is_beside(-2.0 * OFF), "{a:?} {b:?} {c:?}: {u} {v} is there");
            }
        }
        assert!(cut > 10_000 && sampled.iter().all(|&n| n > 1000), "{cut} {sampled:?}");
    }
}
