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

use crate::math::num::fraction;
use crate::math::{ClipPoint, Homogeneous};
use heapless::Vec;

/// A triangle cut by six planes has at most 3 + 6 corners.
pub const CORNERS: usize = 9;

/// A convex polygon.
pub(crate) type Polygon<P> = Vec<P, CORNERS>;

/// What can be cut: a point with all that varies linearly with it.
pub(crate) trait Cut: Copy {
    /// The point `t`·2⁻³¹ of the way to `other`.
    fn towards(&self, other: &Self, t: i64) -> Self;
}

/// `a + (b − a)·t·2⁻³¹`, rounded to nearest.
fn between(a: i32, b: i32, t: i64) -> i32 {
    let way = i64::from(b) - i64::from(a); // 33 bits signed, times 31: below 2⁶³
    let moved = (((way * t) >> 30) + 1) >> 1;
    (i64::from(a) + moved) as i32 // between a and b
}

impl Cut for Homogeneous {
    fn towards(&self, other: &Self, t: i64) -> Self {
        Self {
            x: between(self.x, other.x, t),
            y: between(self.y, other.y, t),
            d: between(self.d, other.d, t),
            w: between(self.w, other.w, t),
        }
    }
}

/// What a corner of a face carries through the cut.
pub trait Carried: Copy {
    /// What corner 0, 1 or 2 of the whole face carries.
    fn of(corner: usize) -> Self;

    /// `t`·2⁻³¹ of the way to `other`.
    #[must_use]
    fn towards(&self, other: &Self, t: i64) -> Self;
}

impl Carried for () {
    fn of(_: usize) {}

    fn towards(&self, (): &(), _: i64) {}
}

/// How much of each of a face's corners a point of it is, in 2⁻³⁰.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Barycentric(pub(crate) [i32; 3]);

impl Barycentric {
    /// Of each corner, in 2⁻³⁰: 2³⁰ together, but for rounding.
    pub const fn weights(self) -> [i32; 3] {
        self.0
    }
}

impl Carried for Barycentric {
    fn of(corner: usize) -> Self {
        Self([0, 1, 2].map(|i| i32::from(i == corner) << 30))
    }

    fn towards(&self, other: &Self, t: i64) -> Self {
        let ([a, b, c], [p, q, r]) = (self.0, other.0);
        Self([between(a, p, t), between(b, q, t), between(c, r, t)])
    }
}

impl<K: Carried> Cut for (Homogeneous, K) {
    fn towards(&self, other: &Self, t: i64) -> Self {
        (self.0.towards(&other.0, t), self.1.towards(&other.1, t))
    }
}

/// Where the edge from `inside` to `outside` passes the plane. Always computed from the inner
/// end, so that both neighbours of an edge get the same point. The parameter has 31 bits and each
/// coordinate is rounded to nearest: within one unit and 2⁻³¹ of the edge's extent.
fn cut<P: Cut>(inside: &P, outside: &P, d_in: i64, d_out: i64) -> P {
    // 0 ≤ d_in, d_out < 0, both below 2⁵⁵: t in 2⁻³¹, below 1.
    let t = fraction(d_in.unsigned_abs(), d_in.abs_diff(d_out), 31) as i64;
    inside.towards(outside, t)
}

/// The six-bit outcode: bit i is set outside plane i. (Cohen and Sutherland; Newman and Sproull,
/// *Principles of Interactive Computer Graphics*, 2nd ed., section 5.1.)
pub(crate) fn outcode<P>(p: &P, planes: usize, distance: impl Fn(usize, &P) -> i64) -> u32 {
    (0..planes).filter(|&i| distance(i, p) < 0).map(|i| 1 << i).sum()
}

/// The part of the line inside all planes, or `None`: Cohen–Sutherland in homogeneous coordinates.
pub(crate) fn line_at<P: Cut>(
    mut a: P,
    mut b: P,
    planes: usize,
    distance: impl Fn(usize, &P) -> i64,
) -> Option<(P, P)> {
    if outcode(&a, planes, &distance) & outcode(&b, planes, &distance) != 0 {
        return None;
    }
    for plane in 0..planes {
        let (da, db) = (distance(plane, &a), distance(plane, &b));
        match (da < 0, db < 0) {
            (false, false) => {}
            (true, true) => return None,
            (false, true) => b = cut(&a, &b, da, db),
            (true, false) => a = cut(&b, &a, db, da),
        }
    }
    Some((a, b))
}

/// A convex polygon grows by at most one corner a plane, so there is room; if rounding should bend
/// one, the corner too many is left out.
fn add<P>(polygon: &mut Polygon<P>, corner: P) {
    let _ = polygon.push(corner);
}

/// The part of the triangle inside all planes; fewer than three corners when nothing is left.
/// (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
pub(crate) fn triangle_at<P: Cut>(
    corners: [P; 3],
    planes: usize,
    distance: impl Fn(usize, &P) -> i64,
) -> Polygon<P> {
    let mut polygon = Polygon::new();
    let mut common = !0;
    for corner in corners {
        common &= outcode(&corner, planes, &distance);
        add(&mut polygon, corner);
    }
    if common != 0 {
        return Polygon::new();
    }
    for plane in 0..planes {
        let Some(&last) = polygon.last() else { break };
        let (mut from, mut d_from) = (last, distance(plane, &last));
        let mut kept = Polygon::new();
        for &to in &polygon {
            let d_to = distance(plane, &to);
            match (d_from < 0, d_to < 0) {
                (false, true) => add(&mut kept, cut(&from, &to, d_from, d_to)),
                (true, false) => add(&mut kept, cut(&to, &from, d_to, d_from)),
                _ => {}
            }
            if d_to >= 0 {
                add(&mut kept, to);
            }
            (from, d_from) = (to, d_to);
        }
        polygon = kept;
    }
    polygon
}

/// A corner in clip space with what varies over a face: colours, texture coordinates, ….
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipVertex<const A: usize> {
    /// Where it is.
    pub point: ClipPoint,
    /// What it carries; interpolated linearly in clip space, rounded to nearest.
    pub attributes: [i32; A],
}

/// x, y, z, w in units that all points of a line or triangle share, and attributes.
#[derive(Clone, Copy)]
struct Aligned<const A: usize> {
    xyzw: [i32; 4],
    attributes: [i32; A],
}

impl<const A: usize> Cut for Aligned<A> {
    fn towards(&self, other: &Self, t: i64) -> Self {
        let mut result = *self;
        for (a, b) in result.xyzw.iter_mut().zip(other.xyzw) {
            *a = between(*a, b, t);
        }
        for (a, b) in result.attributes.iter_mut().zip(other.attributes) {
            *a = between(*a, b, t);
        }
        result
    }
}

/// The distances from the six planes of the view volume, in the order of
/// [`Outcode`](crate::Outcode)'s bits.
fn side<const A: usize>(plane: usize, p: &Aligned<A>) -> i64 {
    let [x, y, z, w] = p.xyzw.map(i64::from);
    match plane {
        0 => w + x,
        1 => w - x,
        2 => w + y,
        3 => w - y,
        4 => w + z,
        _ => w - z,
    }
}

/// The part of a line inside the view volume −w ≤ x, y, z ≤ w, or `None`. Its new ends are within
/// 2⁻²⁷ of the larger end's coordinates, or, where the line runs nearly along a plane, within eight
/// times what moving its ends by 2⁻³⁰ does; the order of the ends changes neither.
/// (Cohen–Sutherland in homogeneous coordinates: Foley et al., *Computer Graphics*, 2nd ed.,
/// section 6.5.4.)
pub fn line(a: ClipPoint, b: ClipPoint) -> Option<(ClipPoint, ClipPoint)> {
    let exponent = a.exponent().max(b.exponent());
    let align = |p: &ClipPoint| Aligned { xyzw: p.in_units(exponent), attributes: [] };
    let (a, b) = line_at(align(&a), align(&b), 6, side)?;
    Some((ClipPoint::from_units(a.xyzw, exponent), ClipPoint::from_units(b.xyzw, exponent)))
}

/// The part of a triangle inside the view volume −w ≤ x, y, z ≤ w: a convex polygon of up to nine
/// corners in the triangle's order, empty where nothing is inside. New corners are within 2⁻²⁷ of
/// the largest corner's coordinates but where edges run nearly along planes, and neighbours that share an edge get the same ones.
/// (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
pub fn triangle<const A: usize>(corners: [ClipVertex<A>; 3]) -> Vec<ClipVertex<A>, CORNERS> {
    let exponent = corners.iter().map(|c| c.point.exponent()).max().unwrap_or(0);
    let aligned = corners.map(|c| Aligned { xyzw: c.point.in_units(exponent), attributes: c.attributes });
    let polygon = triangle_at(aligned, 6, side);
    let back = |p: &Aligned<A>| ClipVertex {
        point: ClipPoint::from_units(p.xyzw, exponent),
        attributes: p.attributes,
    };
    let mut result = Vec::new();
    if polygon.len() >= 3 {
        for corner in &polygon {
            let _ = result.push(back(corner)); // as many as the polygon can have
        }
    }
    result
}
