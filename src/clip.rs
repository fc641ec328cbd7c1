//! Cutting lines and polygons at planes in homogeneous coordinates, before the divide.
//!
//! The pipeline cuts at the near plane, the guard band and, on request, the far plane, and leaves
//! the sides to the rasteriser. For those who want the clipped geometry itself, [`line()`] and
//! [`triangle`] cut at all six planes of the view volume, attributes and all.
//!
//! ```
//! use pinhole::{clip, space::View, Point3, Projection, Scalar, Window};
//! let one = Scalar::from_num(1);
//! let window = Window { left: -one, right: one, bottom: -one, top: one };
//! let view = Projection::orthographic(window, one, Scalar::from_num(3))?;
//! let inside = view.apply(Point3::<View>::from_ints(0, 0, -2));
//! let right = view.apply(Point3::<View>::from_ints(2, 0, -2));
//! assert_eq!(right.outcode(), pinhole::Outcode::RIGHT);
//! let (_, end) = clip::line(inside, right).unwrap();
//! assert_eq!(end.ndc(), Some(Point3::from_ints(1, 0, 0)));
//! # Ok::<(), pinhole::ProjectionError>(())
//! ```

use crate::math::num::{after, fraction};
use crate::math::{ClipPoint, Homogeneous};
use heapless::Vec;

/// A triangle cut by six planes has at most 3 + 6 corners.
pub const CORNERS: usize = 9;

/// Places for the corners of a polygon while a plane cuts it: it finds at most `CORNERS − 1`, and adds two before it takes
/// away any.
pub(crate) const PLACES: usize = CORNERS + 1;

/// The places of a polygon's corners, in their order.
pub(crate) type Order = Vec<u8, CORNERS>;

/// Corners in numbered places, before planes. They may be any points that vary linearly along an edge: the
/// clipper knows no more of them than this.
pub(crate) trait Cut {
    /// How far corner `at` lies from a plane, negative outside. Two ends of an edge that is cut are less than 2⁶²
    /// apart.
    fn distance(&self, plane: usize, at: usize) -> i64;

    /// Puts the point `t`·2⁻³¹ of the way from one corner to another into place `at`, which may be one of theirs.
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

/// `a + (b − a)·t·2⁻³¹`, rounded to nearest.
fn between(a: i32, b: i32, t: i32) -> i32 {
    let way = i64::from(b) - i64::from(a); // 33 bits signed, times 31: below 2⁶³
    let moved = (way * i64::from(t) + (1 << 30)) >> 31;
    a.wrapping_add(moved as i32) // between a and b
}

impl Homogeneous {
    /// For places not yet taken.
    pub(crate) const ZERO: Self = Self { xydw: [0; 4] };

    /// Puts the point `t`·2⁻³¹ of the way from one of the places to another into a third, or one of the two: number by
    /// number, each read before it is written.
    pub(crate) fn put(places: &mut [Self], at: usize, inside: usize, outside: usize, t: i32) {
        let mut i = 0;
        let number = |places: &[Self], place: usize, i: usize| places.get(place)?.xydw.get(i).copied();
        while let (Some(a), Some(b)) = (number(places, inside, i), number(places, outside, i)) {
            let Some(number) = places.get_mut(at).and_then(|place| place.xydw.get_mut(i)) else { return };
            *number = between(a, b, t);
            i = after(i);
        }
    }
}

/// What a corner of a face keeps when the face is clipped: any value that is linear in space, such as a colour.
/// Only custom [`Ink`](crate::Ink)s need it; most take [`Barycentric`].
///
/// ```
/// use pinhole::clip::{Barycentric, Carried};
/// let (a, b) = (Barycentric::of(0), Barycentric::of(1));
/// assert_eq!(a.towards(&b, 1 << 29).weights(), [3 << 28, 1 << 28, 0]); // a quarter of the way
/// ```
pub trait Carried: Copy {
    /// What corner 0, 1 or 2 of the whole face carries.
    fn of(corner: usize) -> Self;

    /// The value of the point that lies `t`·2⁻³¹ of the way to `other`. The clipper passes 0 ≤ t < 2³¹.
    #[must_use]
    fn towards(&self, other: &Self, t: i64) -> Self;
}

impl Carried for () {
    fn of(_: usize) {}

    fn towards(&self, (): &(), _: i64) {}
}

/// Barycentric coordinates of a point of a face, in 2⁻³⁰: linear in space, not on the screen. Each cut rounds the first
/// two to nearest; the third is what they leave of 1, so that it may be off by twice as much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Barycentric([i32; 2]);

impl Barycentric {
    /// One weight per corner, together 2³⁰: 0 … 2³⁰, and of the third −6 … 2³⁰ + 6, a unit for each plane that may cut.
    pub const fn weights(self) -> [i32; 3] {
        let [a, b] = self.0;
        [a, b, (1 << 30) - a - b] // a, b: 0 … 2³⁰
    }
}

impl Carried for Barycentric {
    fn of(corner: usize) -> Self {
        Self([0, 1].map(|i| i32::from(i == corner) << 30))
    }

    fn towards(&self, other: &Self, t: i64) -> Self {
        // A `t` outside of 0 … 2³¹ − 1 counts as the nearer end of that range, so the weights stay between both ends.
        let t = t.clamp(0, i64::from(i32::MAX)) as i32;
        let ([a, b], [p, q]) = (self.0, other.0);
        Self([between(a, p, t), between(b, q, t)])
    }
}

/// Puts into place `at` where the edge between two corners passes a plane. Always computed from the inner
/// end, so that both neighbours of an edge get the same point. The parameter has 31 bits and each
/// coordinate is rounded to nearest: within one unit and 2⁻³¹ of the edge's extent.
#[inline(never)] // rare: small is better
fn cut(corners: &mut impl Cut, plane: usize, at: usize, inside: usize, outside: usize) {
    // 0 ≤ `within`, outside < 0, `within` + |outside| < 2⁶²: t in 2⁻³¹, below 1.
    let within = corners.distance(plane, inside);
    let way = within - corners.distance(plane, outside);
    let t = fraction(within as u64, way as u64, 31) as i32;
    corners.put(at, inside, outside, t);
}

/// Whether a corner lies outside of a plane: 1, or 0.
fn is_outside(corners: &impl Cut, plane: usize, at: usize) -> u32 {
    (corners.distance(plane, at) < 0).into()
}

/// Leaves of the line from corner 0 to corner 1 the part inside all planes, and tells whether they took any of it, or
/// `None` if they took it all: Cohen–Sutherland in homogeneous coordinates. (Newman and Sproull, *Principles of
/// Interactive Computer Graphics*, 2nd ed., section 5.1.)
pub(crate) fn line_at(corners: &mut impl Cut, planes: usize) -> Option<bool> {
    let (mut crosses, mut cuts, mut plane) = (false, false, 0);
    loop {
        if plane >= planes {
            // Nothing is cut before it is known that no plane has both ends beyond it.
            if cuts || !crosses {
                return Some(crosses);
            }
            (cuts, plane) = (true, 0);
        }
        match is_outside(corners, plane, 0) | is_outside(corners, plane, 1) << 1 {
            0 => {}
            3 => return None,
            sides => {
                crosses = true;
                if cuts {
                    let (inside, outside) = (2 - sides as usize, sides as usize - 1);
                    cut(corners, plane, outside, inside, outside);
                }
            }
        }
        plane = after(plane);
    }
}

/// A convex polygon grows by at most one corner a plane, so there is room; if rounding should bend
/// one, the corner too many is left out, here or where there is no place for it.
fn add(polygon: &mut Order, corner: u8) {
    let _ = polygon.push(corner); // one of `PLACES`
}

/// Which corners of a polygon lie outside of a plane: a bit for each place.
#[inline(never)] // rare: small is better
fn beyond(corners: &impl Cut, polygon: &[u8], plane: usize) -> u32 {
    polygon.iter().fold(0, |bits, &at| bits | is_outside(corners, plane, at.into()) << (at & 31))
}

/// Makes `polygon` the part of the triangle of corners 0, 1 and 2 inside all planes, and tells whether they took any of it;
/// fewer than three corners when nothing is left. (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
pub(crate) fn triangle_at(corners: &mut impl Cut, planes: usize, polygon: &mut Order) -> bool {
    polygon.clear();
    (0..3).for_each(|corner| add(polygon, corner));
    let mut taken = 0b111u32; // places, a bit each
    let mut crossed = false;
    // Nothing is cut before it is known that no plane has all of it beyond.
    let mut plane = 0;
    while plane < planes {
        let beyond = beyond(corners, polygon, plane);
        crossed |= beyond != 0;
        if beyond == taken {
            polygon.clear();
            return true;
        }
        plane = after(plane);
    }
    let mut plane = if crossed { 0 } else { planes };
    while plane < planes {
        let beyond = beyond(corners, polygon, plane);
        let is_beyond = |at: u8| beyond >> (at & 31) & 1 != 0;
        let Some(&(mut from)) = polygon.last() else { break };
        let mut kept = Order::new();
        for &to in polygon.iter() {
            if is_beyond(from) != is_beyond(to) {
                let free = taken.trailing_ones() as usize;
                if free < PLACES {
                    taken |= 1 << free;
                    let (inside, outside) = if is_beyond(to) { (from, to) } else { (to, from) };
                    cut(corners, plane, free, inside.into(), outside.into());
                    add(&mut kept, free as u8);
                }
            }
            if !is_beyond(to) {
                add(&mut kept, to);
            }
            from = to;
        }
        (*polygon, taken) = (kept, taken & !beyond);
        plane = after(plane);
    }
    crossed
}

/// A corner in clip space with what varies over a face: colours, texture coordinates, …. For [`triangle`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipVertex<const A: usize> {
    /// Where it is.
    pub point: ClipPoint,
    /// What it carries, in any unit: all of an `i32`. Interpolated linearly in clip space, hence linearly in
    /// space; rounded to nearest, from a place on the edge of 31 bits: within 1 of the edge's own where its ends are less than
    /// 2³¹ apart.
    pub attributes: [i32; A],
}

/// x, y, z, w in units that all points of a line or triangle share, and attributes.
#[derive(Clone, Copy)]
struct Aligned<const A: usize> {
    xyzw: [i32; 4],
    attributes: [i32; A],
}

impl<const A: usize> Aligned<A> {
    fn new(point: &ClipPoint, exponent: i32, attributes: [i32; A]) -> Self {
        Self { xyzw: point.in_units(exponent), attributes }
    }

    fn towards(mut self, other: &Self, t: i32) -> Self {
        let ends = self.xyzw.iter_mut().zip(&other.xyzw);
        for (a, &b) in ends.chain(self.attributes.iter_mut().zip(&other.attributes)) {
            *a = between(*a, b, t);
        }
        self
    }
}

/// Corners before the six planes of the view volume, in the order of [`Outcode`](crate::Outcode)'s bits.
impl<const A: usize, const N: usize> Cut for [Aligned<A>; N] {
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

    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        if let (Some(a), Some(b)) = (self.get(inside), self.get(outside)) {
            let point = a.towards(b, t);
            if let Some(place) = self.get_mut(at) {
                *place = point;
            }
        }
    }
}

/// The part of a line inside the view volume −w ≤ x, y, z ≤ w, or `None`. Its new ends are within
/// 2⁻²⁷ of the larger end's coordinates, or, where the line runs nearly along a plane, within eight
/// times what moving its ends by 2⁻³⁰ does; the order of the ends changes neither.
/// (Cohen–Sutherland in homogeneous coordinates: Foley et al., *Computer Graphics*, 2nd ed.,
/// section 6.5.4.)
pub fn line(a: ClipPoint, b: ClipPoint) -> Option<(ClipPoint, ClipPoint)> {
    let exponent = a.exponent().max(b.exponent());
    let mut ends = [a, b].map(|p| Aligned::new(&p, exponent, []));
    let inside = line_at(&mut ends, 6).is_some();
    let [a, b] = ends.map(|p| ClipPoint::from_units(p.xyzw, exponent));
    inside.then_some((a, b))
}

/// The part of a triangle inside the view volume −w ≤ x, y, z ≤ w: a convex polygon of up to nine
/// corners in the triangle's order, empty where nothing is inside. New corners are within 2⁻²⁷ of
/// the largest corner's coordinates but where edges run nearly along planes, and neighbours that share an edge get the
/// same ones.
/// (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
///
/// ```
/// use pinhole::{clip::{self, ClipVertex}, space::View, Point3, Projection, Scalar, Window};
/// let one = Scalar::from_num(1);
/// let window = Window { left: -one, right: one, bottom: -one, top: one };
/// let view = Projection::orthographic(window, one, Scalar::from_num(3))?;
/// // Twice as wide as the window, and what it carries runs from 0 to 200.
/// let corner = |x, y, light| {
///     ClipVertex { point: view.apply(Point3::<View>::from_ints(x, y, -2)), attributes: [light] }
/// };
/// let part = clip::triangle([corner(-2, 0, 0), corner(2, 0, 200), corner(0, 1, 100)]);
/// // Its sharp ends are gone, at heights of ½.
/// let corners: Vec<_> = part.iter().map(|c| (c.point.ndc().unwrap(), c.attributes[0])).collect();
/// assert_eq!(corners.len(), 5);
/// assert!(corners.contains(&(Point3::from_ints(-1, 0, 0), 50)));
/// assert!(corners.contains(&(Point3::from_f32(1.0, 0.5, 0.0).unwrap(), 150)));
/// # Ok::<(), pinhole::ProjectionError>(())
/// ```
pub fn triangle<const A: usize>(corners: [ClipVertex<A>; 3]) -> Vec<ClipVertex<A>, CORNERS> {
    let exponent = corners.iter().map(|c| c.point.exponent()).max().unwrap_or(0);
    let [a, b, c] = corners.map(|c| Aligned::new(&c.point, exponent, c.attributes));
    let mut places = [a; PLACES];
    (places[1], places[2]) = (b, c);
    let mut result = Vec::new();
    let mut polygon = Order::new();
    triangle_at(&mut places, 6, &mut polygon);
    if polygon.len() < 3 {
        return result;
    }
    for corner in polygon.iter().filter_map(|&at| places.get(usize::from(at))) {
        // As many as the polygon can have.
        let _ = result.push(ClipVertex {
            point: ClipPoint::from_units(corner.xyzw, exponent),
            attributes: corner.attributes,
        });
    }
    result
}
