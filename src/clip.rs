//! Clipping of lines and polygons against planes in homogeneous coordinates, before the perspective divide.
//!
//! The pipeline clips against the near plane, the guard band and, on request, the far plane; the rasteriser's scissor does the
//! rest. For callers who need clipped geometry, [`line()`] and [`triangle`] clip against all six planes of the view volume and
//! interpolate attributes.
//!
//! ```
//! use pinhole::{camera::Window, clip, prelude::*, space::View};
//! let one = Scalar::from_int(1);
//! let window = Window { left: -one, right: one, bottom: -one, top: one };
//! let view = Projection::orthographic(window, one, Scalar::from_int(3))?;
//! let inside = view.apply(Point3::<View>::from_ints(0, 0, -2));
//! let right = view.apply(Point3::<View>::from_ints(2, 0, -2));
//! assert_eq!(right.outcode(), pinhole::clip::Outcode::RIGHT);
//! let (_, end) = clip::line(inside, right).unwrap();
//! assert_eq!(end.ndc(), Some(Point3::from_ints(1, 0, 0)));
//! # Ok::<(), pinhole::camera::CameraError>(())
//! ```

pub use crate::math::clip_point::{ClipPoint, Outcode};

use crate::math::hints::{keep_rolled, opaque_next};
use crate::math::num::{fraction, proper_fraction};
use crate::math::ClipCoords;
use heapless::Vec;

/// The most clip planes.
const PLANES: usize = 6;

/// The most corners of a triangle clipped against six planes: 3 + 6.
pub const CORNERS: usize = 9;

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

    /// The planes that the corner in slot `at` lies outside of, one bit each.
    fn planes_outside(&self, at: usize) -> u32;

    /// Stores the point at parameter `t`·2⁻³¹ from corner `inside` to corner `outside` in slot `at`, which may be the slot of either.
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

/// Linear interpolation `a + (b − a)·t·2⁻³¹`, rounded to nearest, for 0 ≤ t < 2³¹.
#[inline(never)] // rare path: code size counts, speed does not
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
/// use pinhole::clip::{Barycentric, Varying};
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
#[inline(never)] // rare path: code size counts, speed does not
fn intersect_edge(corners: &mut impl ClipCorners, plane: usize, at: usize, inside: usize, outside: usize) {
    // 0 ≤ `within`, outside < 0, `within` + |outside| < 2⁶²: t in 2⁻³¹, below 1.
    let within = corners.distance(plane, inside);
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

/// An input or output vertex of [`triangle`]: a point in clip space with `A` attributes that vary linearly over a face, such as
/// colours or texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipVertex<const A: usize> {
    /// The position.
    pub point: ClipPoint,
    /// The attributes, in any unit, in the full range of `i32`. They are interpolated linearly in clip space, hence linearly in
    /// space, with a parameter of 31 bits, and rounded to nearest: within 1 of the exact value if the two ends differ by less
    /// than 2³¹.
    pub attributes: [i32; A],
}

/// x, y, z, w with an exponent common to all points of a line or triangle, and attributes.
#[derive(Clone, Copy)]
struct AlignedVertex<const A: usize> {
    xyzw: [i32; 4],
    attributes: [i32; A],
}

impl<const A: usize> AlignedVertex<A> {
    fn new(point: &ClipPoint, exponent: i32, attributes: [i32; A]) -> Self {
        Self { xyzw: point.in_units(exponent), attributes }
    }

    fn towards(mut self, other: &Self, t: i32) -> Self {
        let ends = self.xyzw.iter_mut().zip(&other.xyzw);
        for (a, &b) in ends.chain(self.attributes.iter_mut().zip(&other.attributes)) {
            *a = lerp(*a, b, t);
        }
        self
    }
}

/// Distances from the six planes of the view volume, in the order of the bits of [`Outcode`](crate::clip::Outcode).
impl<const A: usize, const N: usize> ClipCorners for [AlignedVertex<A>; N] {
    fn distance(&self, plane: usize, at: usize) -> i64 {
        let [x, y, z, w] = self.get(at).map_or([0; 4], |p| p.xyzw.map(i64::from));
        match plane {
            0 => w + x,
            1 => w - x,
            2 => w + y,
            3 => w - y,
            4 => w + z,
            _ => w - z,
        }
    }

    fn planes_outside(&self, at: usize) -> u32 {
        (0..PLANES).fold(0, |planes, plane| planes | u32::from(self.distance(plane, at) < 0) << (plane & 31))
    }

    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        if let (Some(a), Some(b)) = (self.get(inside), self.get(outside)) {
            let point = a.towards(b, t);
            if let Some(slot) = self.get_mut(at) {
                *slot = point;
            }
        }
    }
}

/// Clips a line against the view volume −w ≤ x, y, z ≤ w; `None` if it is outside. New ends are within 2⁻²⁷ of the larger end's
/// coordinates or, if the line is nearly parallel to a plane, within eight times the displacement that an error of 2⁻³⁰ in its
/// ends causes. Exchanging the ends gives the same points. (Cohen–Sutherland in homogeneous coordinates: Foley et al.,
/// *Computer Graphics*, 2nd ed., section 6.5.4.)
pub fn line(a: ClipPoint, b: ClipPoint) -> Option<(ClipPoint, ClipPoint)> {
    let exponent = a.exponent().max(b.exponent());
    let mut ends = [a, b].map(|p| AlignedVertex::new(&p, exponent, []));
    let inside = clip_line(&mut ends).is_some();
    let [a, b] = ends.map(|p| ClipPoint::from_units(p.xyzw, exponent));
    inside.then_some((a, b))
}

/// Clips a triangle against the view volume −w ≤ x, y, z ≤ w: the result is a convex polygon of up to nine vertices in the
/// triangle's order, empty if the triangle is outside. New vertices are within 2⁻²⁷ of the largest vertex's coordinates, except
/// on edges nearly parallel to a plane. Triangles that share an edge get the same new vertices on it. (Sutherland and Hodgman,
/// *Reentrant polygon clipping*, 1974.)
///
/// ```
/// use pinhole::{camera::Window, clip::{self, ClipVertex}, prelude::*, space::View};
/// let one = Scalar::from_int(1);
/// let window = Window { left: -one, right: one, bottom: -one, top: one };
/// let view = Projection::orthographic(window, one, Scalar::from_int(3))?;
/// // Twice as wide as the window, with an attribute from 0 to 200.
/// let corner = |x, y, light| {
///     ClipVertex { point: view.apply(Point3::<View>::from_ints(x, y, -2)), attributes: [light] }
/// };
/// let part = clip::triangle([corner(-2, 0, 0), corner(2, 0, 200), corner(0, 1, 100)]);
/// // Its left and right ends are clipped, at a height of ½.
/// let corners: Vec<_> = part.iter().map(|c| (c.point.ndc().unwrap(), c.attributes[0])).collect();
/// assert_eq!(corners.len(), 5);
/// assert!(corners.contains(&(Point3::from_ints(-1, 0, 0), 50)));
/// assert!(corners.contains(&(Point3::from_f32(1.0, 0.5, 0.0).unwrap(), 150)));
/// # Ok::<(), pinhole::camera::CameraError>(())
/// ```
pub fn triangle<const A: usize>(corners: [ClipVertex<A>; 3]) -> Vec<ClipVertex<A>, CORNERS> {
    let exponent = corners.iter().map(|c| c.point.exponent()).max().unwrap_or(0);
    let [a, b, c] = corners.map(|c| AlignedVertex::new(&c.point, exponent, c.attributes));
    let mut slots = [a; CLIP_SLOTS];
    (slots[1], slots[2]) = (b, c);
    let mut result = Vec::new();
    let mut polygon = SlotOrder::new();
    clip_triangle(&mut slots, &mut polygon);
    if polygon.len() < 3 {
        return result;
    }
    for corner in polygon.iter().filter_map(|&at| slots.get(usize::from(at))) {
        // A polygon has at most `CORNERS` vertices.
        let _ = result.push(ClipVertex {
            point: ClipPoint::from_units(corner.xyzw, exponent),
            attributes: corner.attributes,
        });
    }
    result
}
