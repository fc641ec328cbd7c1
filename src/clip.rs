//! Cutting lines and polygons at planes in homogeneous coordinates, before the divide.
//!
//! What the planes are is the caller's: a plane is a function that gives the signed distance of a
//! point up to a positive factor, negative outside. It is linear, so the cut of an edge divides
//! it in the ratio of the distances at its ends.

use crate::math::num::fraction;
use crate::math::Homogeneous;
use heapless::Vec;

/// A triangle cut by six planes has at most 3 + 6 corners.
pub(crate) const CORNERS: usize = 9;

/// A convex polygon in clip space.
pub(crate) type Polygon = Vec<Homogeneous, CORNERS>;

/// Where the edge from `inside` to `outside` passes the plane. Always computed from the inner
/// end, so that both neighbours of an edge get the same point. The parameter has 31 bits and each
/// coordinate is rounded to nearest: within one unit and 2⁻³¹ of the edge's extent.
fn cut(inside: &Homogeneous, outside: &Homogeneous, d_in: i64, d_out: i64) -> Homogeneous {
    // 0 ≤ d_in, d_out < 0, both below 2⁵⁵: t in 2⁻³¹, below 1.
    let t = fraction(d_in.unsigned_abs(), d_in.abs_diff(d_out), 31) as i64;
    let between = |a: i32, b: i32| {
        let way = i64::from(b) - i64::from(a); // 33 bits signed, times 31: below 2⁶³
        let moved = (((way * t) >> 30) + 1) >> 1;
        (i64::from(a) + moved) as i32 // between a and b
    };
    Homogeneous {
        x: between(inside.x, outside.x),
        y: between(inside.y, outside.y),
        d: between(inside.d, outside.d),
        w: between(inside.w, outside.w),
    }
}

/// The six-bit outcode: bit i is set outside plane i. (Cohen and Sutherland; Newman and Sproull,
/// *Principles of Interactive Computer Graphics*, 2nd ed., section 5.1.)
fn outcode(p: &Homogeneous, planes: usize, distance: impl Fn(usize, &Homogeneous) -> i64) -> u32 {
    (0..planes).filter(|&i| distance(i, p) < 0).map(|i| 1 << i).sum()
}

/// The part of the line inside all planes, or `None`: Cohen–Sutherland in homogeneous coordinates.
pub(crate) fn line(
    mut a: Homogeneous,
    mut b: Homogeneous,
    planes: usize,
    distance: impl Fn(usize, &Homogeneous) -> i64,
) -> Option<(Homogeneous, Homogeneous)> {
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
fn add(polygon: &mut Polygon, corner: Homogeneous) {
    let _ = polygon.push(corner);
}

/// The part of the triangle inside all planes; fewer than three corners when nothing is left.
/// (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974.)
pub(crate) fn triangle(
    corners: [Homogeneous; 3],
    planes: usize,
    distance: impl Fn(usize, &Homogeneous) -> i64,
) -> Polygon {
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
