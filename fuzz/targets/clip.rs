//! `clip::line` and `clip::triangle` against the six inequalities in f64, which holds their 31-bit integers
//! exactly. All is measured in the units that the points of one call share: their largest coordinate is at
//! least 2²⁹ of them.
//!
//! Lines: the new ends by their documented bound, both orders alike. Triangles carry their barycentric
//! weights as attributes: every new corner must be the point that its own weights name, and points of the
//! triangle must be in the result where they are in the volume, whatever way the clipper took.

use super::Bytes;
use pinhole::clip::{self, ClipVertex};
use pinhole::space::View;
use pinhole::{
    clip::{ClipPoint, Outcode},
    Projection,
};
use support::bridge::point;
use support::oracle::chain::{outcode, V4};
use support::oracle::volume::{distances, gap, inside, largest};

/// What six cuts may lose, in units of the distance from a plane: each rounds two coordinates by ½ and the
/// way there down by 2⁻³¹ of a distance of at most 2³¹; aligning the exponents rounds two by ½ before.
const LOST: f64 = 6.0 * 2.0 + 1.0;
/// What six cuts may lose in one coordinate.
const MOVED: f64 = 6.0 * 1.5 + 0.5;

fn number(b: &mut Bytes<'_>) -> i32 {
    match b.byte() {
        k @ 0..=79 => i32::from(k) - 40,
        k @ 80..=139 => {
            let power = 1 << ((k - 80) >> 1);
            (if k & 1 == 0 { power } else { -power }) + (b.i8() >> 5) as i32
        }
        140..=179 => i32::from(b.i16()),
        180..=199 => i32::from(b.i16()) << 13,
        _ => b.i32() >> 2,
    }
}

/// A matrix whose first column is the wanted point, applied to a vector along the first axis.
fn clip_point(b: &mut Bytes<'_>) -> Option<ClipPoint> {
    let w = number(b);
    let mut coordinate = || match b.byte() {
        k @ 0..=79 => (if k & 1 == 0 { w } else { -w }) + i32::from(k >> 4) - 2,
        80..=127 => number(b),
        k => (f64::from(w) * f64::from(k - 128) / 64.0) as i32 - w,
    };
    let column = [coordinate(), coordinate(), coordinate(), w].map(f64::from);
    let matrix: [V4; 4] = core::array::from_fn(|i| {
        let mut row = [column[i], 0.0, 0.0, 0.0];
        if i < 3 {
            row[i + 1] = 1.0;
        }
        row
    });
    let scale = match b.byte() {
        k @ 0..=31 => 1 << (k & 31).min(29),
        _ => 1 << 16,
    };
    let projection = Projection::from_matrix(&matrix).ok()?;
    let found = projection.apply(point::<View>([scale, 0, 0]));
    assert_eq!(found.outcode().bits(), outcode(found.xyzw().map(f64::from)));
    Some(found)
}

/// In units of 2^exponent.
fn real(p: &ClipPoint, exponent: i32) -> V4 {
    let unit = f64::from(p.exponent() - exponent).exp2();
    p.xyzw().map(|c| f64::from(c) * unit)
}

fn mix(a: V4, b: V4, t: f64) -> V4 {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

fn check_line(ca: ClipPoint, cb: ClipPoint) -> Option<(ClipPoint, ClipPoint)> {
    let got = clip::line(ca, cb);
    assert_eq!(clip::line(cb, ca), got.map(|(p, q)| (q, p)), "the order of the ends: {ca:?} {cb:?}");
    let unit = ca.exponent().max(cb.exponent());
    let (a, b) = (real(&ca, unit), real(&cb, unit));
    let size = largest(a).max(largest(b));
    let documented = size * 2f64.powi(-27);
    let Some((p, q)) = got else {
        assert!(inside(a, b, -LOST).is_none(), "lost: {ca:?} {cb:?}");
        return None;
    };
    let ends = [real(&p, unit), real(&q, unit)];
    for end in ends {
        let least = distances(end).into_iter().fold(f64::INFINITY, f64::min);
        assert!(least >= -documented, "{least} units outside: {ca:?} {cb:?} {end:?}");
        // On the line: where its longest coordinate says.
        let along = (0..4).fold(0, |m, i| if (b[i] - a[i]).abs() > (b[m] - a[m]).abs() { i } else { m });
        let extent = b[along] - a[along];
        let t = if extent == 0.0 { 0.0 } else { (end[along] - a[along]) / extent };
        assert!(gap(end, mix(a, b, t)) <= 2.0 * documented, "off the line: {ca:?} {cb:?} {end:?}");
        assert!(
            t * extent.abs() >= -MOVED && (t - 1.0) * extent.abs() <= MOVED,
            "beyond an end: {ca:?} {cb:?}"
        );
    }
    match inside(a, b, 0.0) {
        None => {
            // It touches within the rounding, and is no longer than what the grown volume holds.
            let (s, t) = inside(a, b, LOST).unwrap_or_else(|| panic!("nothing is inside: {ca:?} {cb:?}"));
            assert!(gap(ends[0], ends[1]) <= gap(mix(a, b, s), mix(a, b, t)) + 2.0 * MOVED, "{ca:?} {cb:?}");
        }
        Some((s, t)) => {
            // Moving the ends by 2⁻³⁰ of the size moves a distance by twice that.
            let nudge = size * 2f64.powi(-29);
            let nudged = [inside(a, b, nudge), inside(a, b, -nudge)];
            for (k, end) in ends.into_iter().enumerate() {
                let want = mix(a, b, if k == 0 { s } else { t });
                let moved = nudged
                    .map(|n| {
                        n.map_or(f64::INFINITY, |(s, t)| gap(mix(a, b, if k == 0 { s } else { t }), want))
                    })
                    .into_iter()
                    .fold(0.0, f64::max);
                let error = gap(end, want);
                assert!(
                    error <= documented.max(8.0 * moved),
                    "{error} units off, {documented} documented, {moved} by nudging: {ca:?} {cb:?} {end:?} {want:?}"
                );
            }
        }
    }
    // What lies inside stays as it is.
    if ca.exponent() == cb.exponent() && ca.outcode() == Outcode::INSIDE && cb.outcode() == Outcode::INSIDE {
        assert_eq!((p, q), (ca, cb));
    }
    // Again: unchanged, or what rounding left outside comes back along the line.
    match clip::line(p, q) {
        again if p.outcode().or(q.outcode()) == Outcode::INSIDE => assert_eq!(again, got),
        None => {}
        Some((r, s)) => {
            for end in [real(&r, unit), real(&s, unit)] {
                for i in 0..4 {
                    let (low, high) = (ends[0][i].min(ends[1][i]), ends[0][i].max(ends[1][i]));
                    assert!(low <= end[i] && end[i] <= high, "{ca:?} {cb:?} {p:?} {q:?} {r:?} {s:?}");
                }
            }
        }
    }
    got
}

/// Weights 0 … 1 as attributes: all of i32.
const SPAN: f64 = u32::MAX as f64;

fn weights(v: &ClipVertex<3>) -> [f64; 3] {
    let [u, v] = [0, 1].map(|i| (f64::from(v.attributes[i]) + 2f64.powi(31)) / SPAN);
    [1.0 - u - v, u, v]
}

fn check_triangle(points: [ClipPoint; 3], extra: [i32; 3], sample: [f64; 3]) -> Vec<ClipVertex<3>> {
    let corner = |i: usize| {
        let weight = |k: usize| if i == k { i32::MAX } else { i32::MIN };
        ClipVertex { point: points[i], attributes: [weight(1), weight(2), extra[i]] }
    };
    let got = clip::triangle([corner(0), corner(1), corner(2)]);
    assert!(got.is_empty() || (3..=9).contains(&got.len()));
    let unit = points.iter().map(ClipPoint::exponent).max().unwrap_or(0);
    let corners = points.map(|p| real(&p, unit));
    let size = corners.map(largest).into_iter().fold(0.0, f64::max);
    let blend = |w: [f64; 3]| -> V4 { core::array::from_fn(|k| (0..3).map(|i| w[i] * corners[i][k]).sum()) };
    for v in &got {
        let (at, w) = (real(&v.point, unit), weights(v));
        let least = distances(at).into_iter().fold(f64::INFINITY, f64::min);
        assert!(least >= -size * 2f64.powi(-27), "{least} units outside: {points:?}");
        // Up to six cuts round point and weights by ½ each; a weight's step of 2⁻³² is up to half a unit.
        assert!(gap(at, blend(w)) <= 3.5 + 2.0 * 3.0 * 0.5, "not where its weights say: {points:?} {v:?}");
        assert!(w.iter().all(|w| w * SPAN >= -6.5), "outside the triangle: {points:?} {v:?}");
        let carried: f64 = (0..3).map(|i| w[i] * f64::from(extra[i])).sum();
        let step = extra.iter().map(|e| f64::from(*e).abs()).fold(0.0, f64::max) * 2f64.powi(-31);
        assert!((f64::from(v.attributes[2]) - carried).abs() <= 3.5 + 12.0 * step, "{points:?} {v:?}");
        let range = extra.iter().min()..=extra.iter().max();
        assert!(
            range.contains(&Some(&v.attributes[2])),
            "beyond all three values: {points:?} {extra:?} {v:?}"
        );
    }
    // A point of the triangle, by the planes and by the polygon. Its corners may be up to 3.5 steps of 2⁻³² off:
    // how far left of each side the point is, and what that makes of it, more beyond a short side's ends.
    const OFF: f64 = 3.5;
    let (u, v) = (sample[1] * SPAN, sample[2] * SPAN);
    let place = |c: &ClipVertex<3>| [0, 1].map(|i| f64::from(c.attributes[i]) + 2f64.powi(31));
    let sides = (0..got.len()).filter_map(|i| {
        let ([ax, ay], [bx, by]) = (place(&got[i]), place(&got[(i + 1) % got.len()]));
        let (dx, dy, away) = (bx - ax, by - ay, (u - ax).abs() + (v - ay).abs());
        let length = dx.abs() + dy.abs();
        // None where two corners coincide.
        (length > 0.0)
            .then(|| ((dx * (v - ay) - dy * (u - ax)) / length, 2.0 * OFF * (1.0 + 2.0 * away / length)))
    });
    let sides: Vec<(f64, f64)> = sides.collect();
    // The polygon's own steps are up to half a unit each, and there are two weights: at most 2·OFF in a distance.
    let least = distances(blend(sample)).into_iter().fold(f64::INFINITY, f64::min);
    if least >= LOST + 2.0 * OFF {
        let missing = got.is_empty() || sides.iter().any(|(side, slack)| *side < -slack);
        assert!(!missing, "a point inside is missing: {points:?} {sample:?} {got:?}");
    } else if least <= -LOST - 2.0 * OFF {
        let there = !sides.is_empty() && sides.iter().all(|(side, slack)| side > slack);
        assert!(!there, "a point outside is there: {points:?} {sample:?} {got:?}");
    }
    // Pieces that lie inside stay as they are.
    for pair in got.windows(2).skip(1) {
        let piece = [got[0], pair[0], pair[1]];
        if piece.iter().all(|v| v.point.outcode() == Outcode::INSIDE) {
            assert_eq!(clip::triangle(piece).as_slice(), piece);
        }
    }
    got.to_vec()
}

/// Both triangles have the shared edge's ends, with the same attributes.
fn check_shared(a: ClipPoint, b: ClipPoint, others: [ClipPoint; 2], ends: (ClipPoint, ClipPoint)) {
    let unit = a.exponent().max(b.exponent());
    if others.iter().any(|p| p.exponent() > unit) {
        return; // other units, other roundings
    }
    let vertex = |point, attributes| ClipVertex { point, attributes };
    let (a, b) = (vertex(a, [i32::MIN, 77]), vertex(b, [i32::MAX, -1 << 20]));
    let [c, d] = others.map(|p| vertex(p, [0, 0]));
    let (one, two) = (clip::triangle([a, b, c]), clip::triangle([b, a, d]));
    for end in [ends.0, ends.1] {
        let carried = |polygon: &[ClipVertex<2>]| -> Vec<[i32; 2]> {
            polygon.iter().filter(|v| v.point == end).map(|v| v.attributes).collect()
        };
        let (x, y) = (carried(&one), carried(&two));
        assert!(
            x.iter().any(|x| y.contains(x)),
            "neighbours differ at {end:?}: {x:?} {y:?} of {a:?} {b:?} {c:?} {d:?}"
        );
    }
}

pub(super) fn check(data: &[u8]) {
    let mut b = Bytes::new(data);
    let kind = b.byte();
    let (Some(p), Some(q)) = (clip_point(&mut b), clip_point(&mut b)) else { return };
    let ends = check_line(p, q);
    if kind & 3 == 0 {
        return;
    }
    let (Some(r), Some(s)) = (clip_point(&mut b), clip_point(&mut b)) else { return };
    if let Some(ends) = ends {
        check_shared(p, q, [r, s], ends);
    }
    let extra = [b.wild(), b.wild(), b.wild()];
    let (mut u, mut v) = (f64::from(b.u16()) / 65535.0, f64::from(b.u16()) / 65535.0);
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    check_triangle([p, q, r], extra, [1.0 - u - v, u, v]);
}
