//! Polygons of any number of corners to triangles.
//!
//! Seen along its normal (Newell's), a polygon is cut in integers, so nothing is lost to rounding: its corners are put on a grid of
//! 2⁻³⁹ of its longest side first.
//!
//! **No triangles overlap** unless sides cross. Triangles whose sides add up to the polygon's sides, others being run along in both
//! directions, cover each point as often as the polygon winds around it: once, if all are counter-clockwise and no sides cross. Of a polygon
//! that winds around its first corner more than once that is noticed; of one that returns over itself elsewhere, as a spiral ramp seen from
//! above, it is not.

use crate::boxes::{flat, Bounds, Boxes};

/// A polygon in triangles.
pub(crate) struct Triangulated {
    /// The numbers of each triangle's corners in the polygon.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// Whether triangles lie upon each other, as the polygon crosses itself.
    pub(crate) overlap: bool,
}

/// Cuts a polygon into triangles: the fan about its first corner where no triangle of that is turned over, as in a convex polygon,
/// otherwise ears (Meisters, "Polygons have ears", 1975). Holes may be part of the polygon, by a cut to them and back.
///
/// Corners on a straight side stay corners of triangles. Fewer than three corners become a triangle without area.
pub(crate) fn triangulate(corners: &[[f64; 3]]) -> Triangulated {
    let fan = || match corners.len() {
        0 => Vec::new(),
        1 => vec![[0; 3]],
        2 => vec![[0, 1, 1]],
        count => (2..count).map(|corner| [0, corner - 1, corner]).collect(),
    };
    if corners.len() <= 3 {
        return Triangulated { triangles: fan(), overlap: false };
    }
    let points = projected(corners);
    let is_turned = |corner: usize| turn([points[0], points[corner - 1], points[corner]]) < -ROUNDING;
    if !(2..points.len()).any(is_turned) {
        // More than once around the first corner: beyond the first side, and then before it again.
        let mut beyond = false;
        let overlap = points.iter().any(|&point| {
            let side = turn([points[0], points[1], point]);
            beyond |= side < -ROUNDING;
            beyond && side > ROUNDING
        });
        return Triangulated { triangles: fan(), overlap };
    }
    match Ring::of(&points).ears() {
        Some(triangles) => Triangulated { triangles, overlap: false },
        None => Triangulated { triangles: fan(), overlap: true },
    }
}

type Point = [i64; 2];

/// The most by which rounding to the grid changes what [`turn`] finds: coordinates by 2¹⁶, their differences of 58 bits by 2¹⁷. So a
/// corner on a straight side stays there.
const ROUNDING: i128 = 1 << 77;

/// Twice the area of a polygon, seen along each axis: its normal.
#[inline(never)] // the page of the planner loads this code
fn newell(corners: &[[i64; 3]]) -> [i128; 3] {
    let next = corners.iter().cycle().skip(1);
    // Below 2⁸¹ for each of at most 2³⁰ corners.
    corners.iter().zip(next).fold([0; 3], |sums, (a, b)| {
        let product =
            |i: usize, j: usize| i128::from(a[i]) * i128::from(b[j]) - i128::from(a[j]) * i128::from(b[i]);
        [sums[0] + product(1, 2), sums[1] + product(2, 0), sums[2] + product(0, 1)]
    })
}

/// The corners on a grid, seen against the normal: counter-clockwise. Nothing for a polygon that is a point.
fn projected(corners: &[[f64; 3]]) -> Vec<Point> {
    // Halves, as sides may be too long for f64.
    let least =
        |axis: usize| corners.iter().fold(f64::INFINITY, |least, corner| least.min(corner[axis] / 2.0));
    let low = [0, 1, 2].map(least);
    let from_low = |corner: &[f64; 3]| [0, 1, 2].map(|axis| corner[axis] / 2.0 - low[axis]);
    let side = corners.iter().flat_map(from_low).fold(0.0, f64::max);
    let power = f64::from_bits(side.to_bits() & f64::INFINITY.to_bits()); // of two: without the mantissa
    if !power.is_normal() {
        return Vec::new();
    }
    let on_grid = |c: f64| (c / power * 2f64.powi(39)).round() as i64; // at most 2⁴⁰
    let corners: Vec<[i64; 3]> = corners.iter().map(|corner| from_low(corner).map(on_grid)).collect();
    // The areas of a bow tie cancel but for the rounding to the grid: it is seen along the normal of a triangle of the fan.
    let mut normal = newell(&corners);
    for side in corners.windows(2) {
        if normal.iter().any(|c| c.unsigned_abs() >> 48 > 0) {
            break;
        }
        normal = newell(&[corners[0], side[0], side[1]]);
    }
    let largest = normal.iter().map(|c| c.unsigned_abs()).max().unwrap_or_default();
    // 16 bits are enough to tell front from back.
    let normal = normal.map(|c| (c >> (128 - 16u32).saturating_sub(largest.leading_zeros())) as i64);
    let axis = (0..3).max_by_key(|&axis| normal[axis].abs()).unwrap_or_default();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let (i, j) = if normal[axis] < 0 { (j, i) } else { (i, j) };
    // Along the normal to where the coordinate of this axis is 0, times the normal's: 57 bits.
    let along = |corner: &[i64; 3], i: usize| corner[i] * normal[axis] - corner[axis] * normal[i];
    corners.iter().map(|corner| [along(corner, i), along(corner, j)]).collect()
}

/// Twice the area of a triangle: positive if it is counter-clockwise.
fn turn([[ax, ay], [bx, by], [cx, cy]]: [Point; 3]) -> i128 {
    i128::from(bx - ax) * i128::from(cy - ay) - i128::from(by - ay) * i128::from(cx - ax)
}

/// A polygon from which corners are cut.
struct Ring<'p> {
    points: &'p [Point],
    /// For each corner the ones before and after it.
    beside: Vec<[usize; 2]>,
    is_left: Vec<bool>,
    tree: Boxes,
}

impl<'p> Ring<'p> {
    fn of(points: &'p [Point]) -> Self {
        let count = points.len();
        let boxes: Vec<Bounds> = points.iter().map(|&point| flat([point; 2])).collect();
        Self {
            points,
            beside: (0..count).map(|i| [(i + count - 1) % count, (i + 1) % count]).collect(),
            is_left: vec![true; count],
            tree: Boxes::new(&boxes),
        }
    }

    /// The triangles, if the polygon can be cut into such that are counter-clockwise.
    fn ears(mut self) -> Option<Vec<[usize; 3]>> {
        let count = self.points.len();
        let mut triangles = Vec::with_capacity(count - 2);
        let mut left = count;
        // Corners that may be ears: to cut one changes only the two beside it.
        let mut maybe: Vec<usize> = (0..count).rev().collect();
        let mut cut_since = false;
        while left > 2 {
            let Some(corner) = maybe.pop() else {
                if !std::mem::take(&mut cut_since) {
                    return None;
                }
                maybe.extend((0..count).rev().filter(|&corner| self.is_left[corner]));
                continue;
            };
            if !self.is_left[corner] {
                continue;
            }
            let [a, c] = self.beside[corner];
            let is_spike = self.points[a] == self.points[corner]
                || self.points[corner] == self.points[c]
                || self.points[a] == self.points[c];
            if !is_spike && !self.is_ear([a, corner, c]) {
                continue;
            }
            // A spike covers nothing, and runs along its sides in both directions.
            triangles.extend((!is_spike).then_some([a, corner, c]));
            (self.beside[a][1], self.beside[c][0]) = (c, a);
            self.is_left[corner] = false;
            left -= 1;
            cut_since = true;
            maybe.extend([a, c]);
        }
        Some(triangles)
    }

    /// Whether a corner can be cut: it is convex, and no other corner lies in the triangle with its neighbours.
    fn is_ear(&self, [a, b, c]: [usize; 3]) -> bool {
        let triangle = [a, b, c].map(|corner| self.points[corner]);
        if turn(triangle) <= 0 {
            return false;
        }
        let sides = [0, 1, 2].map(|i| [triangle[i], triangle[(i + 1) % 3]]);
        // A box is beyond a side if its corner that is farthest to the side's left is to its right.
        let mut meets = |&[[left, _, _, low], [right, _, _, high]]: &Bounds| {
            sides.iter().all(|&[from, to]| {
                let x = if to[1] < from[1] { right } else { left };
                let y = if to[0] > from[0] { high } else { low };
                turn([from, to, [x, y]]) >= 0
            })
        };
        let mut blocks = |corner: usize| {
            let point = self.points[corner];
            self.is_left[corner]
                && !triangle.contains(&point)
                && sides.iter().all(|&[from, to]| turn([from, to, point]) >= 0)
        };
        self.tree.first(&mut meets, &mut blocks).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::{triangulate, turn, Point, Triangulated};
    use std::collections::HashMap;
    use support::oracle::rng::Rng;

    /// Whether two segments have a point in common.
    fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
        let side = |a, b, c| turn([a, b, c]).signum();
        let is_on = |a: Point, b: Point, p: Point| {
            side(a, b, p) == 0 && (0..2).all(|i| (a[i].min(b[i])..=a[i].max(b[i])).contains(&p[i]))
        };
        side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0
            || is_on(a, b, c)
            || is_on(a, b, d)
            || is_on(c, d, a)
            || is_on(c, d, b)
    }

    /// A polygon through random points that does not touch itself, counter-clockwise. Corners may lie on straight sides.
    fn simple(random: &mut Rng, count: usize) -> Vec<Point> {
        let at = |points: &[Point], i: usize| points[i % points.len()];
        'again: loop {
            let mut points = Vec::new();
            while points.len() < count {
                let point = [0; 2].map(|_: i64| random.below(count + 2) as i64);
                points.extend((!points.contains(&point)).then_some(point));
            }
            // To turn round the part between two crossing sides makes the polygon shorter.
            'uncross: for _ in 0..500 {
                for (i, j) in (0..count).flat_map(|i| (i + 2..count).map(move |j| (i, j))) {
                    let sides = [i, j].map(|i| [at(&points, i), at(&points, i + 1)]);
                    if (j + 1) % count != i && meet(sides[0], sides[1]) {
                        points[i + 1..=j].reverse();
                        continue 'uncross;
                    }
                }
                // Sides may still run back upon the one before.
                for i in 0..count {
                    let [a, b, c] = [0, 1, 2].map(|k| at(&points, i + k));
                    let along = (0..2).map(|k| (b[k] - a[k]) * (c[k] - b[k])).sum::<i64>();
                    if turn([a, b, c]) == 0 && along < 0 {
                        continue 'again;
                    }
                }
                let area: i128 = (0..count).map(|i| turn([[0; 2], points[i], at(&points, i + 1)])).sum();
                if area < 0 {
                    points.reverse();
                }
                return points;
            }
        }
    }

    /// A frame around holes side by side, each cut open towards the one to its left, the first towards the frame's corner.
    fn with_holes(random: &mut Rng, count: usize) -> Vec<Point> {
        let right = 100 * count as i64 + 100;
        let (mut there, mut back) =
            (vec![[0, -300], [right, -300], [right, 300], [0, 300], [0, -300]], Vec::new());
        for hole in 1..=count as i64 {
            let corners = 4 + random.below(9);
            let mut points = simple(random, corners);
            points.reverse();
            points.iter_mut().for_each(|[x, y]| (*x, *y) = (*x + 100 * hole, *y - 5));
            let leftmost = (0..corners).min_by_key(|&i| points[i]).unwrap();
            points.rotate_left(leftmost);
            let rightmost = (0..corners).max_by_key(|&i| points[i]).unwrap();
            there.extend(&points[..=rightmost]);
            points.push(points[0]);
            back.push(points[rightmost..].to_vec());
        }
        there.extend(back.into_iter().rev().flatten());
        there
    }

    /// How often sides run from one point to another more than back.
    fn sides(polygons: impl Iterator<Item = Vec<Point>>) -> HashMap<[Point; 2], i32> {
        let mut sides = HashMap::new();
        for polygon in polygons {
            for (i, &a) in polygon.iter().enumerate() {
                let b = polygon[(i + 1) % polygon.len()];
                *sides.entry([a.min(b), a.max(b)]).or_default() += (a < b) as i32 - (b < a) as i32;
            }
        }
        sides.retain(|_, count| *count != 0);
        sides
    }

    /// Triangles that are all counter-clockwise and have the polygon's sides, and no others but in both directions, cover each point
    /// as often as the polygon winds around it: once inside, and not at all outside.
    fn check(points: &[Point], triangles: &[[usize; 3]]) {
        let of = |triangle: &[usize; 3]| triangle.map(|corner| points[corner]);
        assert!(triangles.iter().all(|triangle| turn(of(triangle)) >= 0), "{points:?}");
        let found = sides(triangles.iter().map(|triangle| of(triangle).to_vec()));
        assert_eq!(found, sides(std::iter::once(points.to_vec())), "{points:?}");
    }

    /// Points in a plane in space that has this normal.
    fn in_space(points: &[Point], [a, b, c]: [f64; 3]) -> Vec<[f64; 3]> {
        let (u, v) = if c == 0.0 {
            ([-b, a, 0.0], [0.0, 0.0, a * a + b * b])
        } else {
            ([c, 0.0, -a], [-a * b, a * a + c * c, -b * c])
        };
        let sign = if c < 0.0 { -1.0 } else { 1.0 };
        let at = |&[x, y]: &Point| [0, 1, 2].map(|i| 7.0 + sign * x as f64 * u[i] + y as f64 * v[i]);
        points.iter().map(at).collect()
    }

    #[test]
    fn polygons_are_covered_once_however_they_lie() {
        let mut random = Rng::new(3);
        let normals =
            [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [2.0, -1.0, 0.5], [-1.0, 3.0, -2.0], [1.0, 1.0, 0.0]];
        let (mut ears, mut straight) = (0, 0);
        for number in 0..1500 {
            let count = 4 + random.below(16);
            let mut points = match number % 3 {
                0 => with_holes(&mut random, 1 + count % 4),
                _ => simple(&mut random, count),
            };
            if number % 4 == 0 {
                points.push(points[0]);
            }
            let rotation = random.below(points.len());
            points.rotate_left(rotation);
            let Triangulated { triangles, overlap } = triangulate(&in_space(&points, normals[number % 5]));
            assert!(!overlap, "{points:?}");
            check(&points, &triangles);
            ears += usize::from(triangles.iter().any(|triangle| triangle[0] != 0));
            let is_straight = |i: usize| turn([0, 1, 2].map(|k| points[(i + k) % points.len()])) == 0;
            straight += (0..points.len()).filter(|&i| is_straight(i)).count();
        }
        assert!(ears > 1000 && straight > 1000, "{ears} {straight}");
    }

    #[test]
    fn polygons_without_a_turned_triangle_are_fans() {
        let circle = |i: i32| [f64::from(i).cos(), f64::from(i).sin(), 5.0];
        let fan = |count: usize| (2..count).map(|i| [0, i - 1, i]).collect::<Vec<_>>();
        for count in 3..7 {
            let corners: Vec<_> = (0..count).map(circle).collect();
            assert_eq!(triangulate(&corners).triangles, fan(count as usize));
        }
        // A bent quadrangle, corners on straight sides, and a concave one from the corner that sees all of it.
        for corners in [
            vec![[0.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 2.0, 0.0], [0.0, 2.0, 1.0]],
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 2.0, 0.0]],
            vec![[0.0, 0.0, 1e200], [2e200, 1e200, 0.0], [0.5e200, 0.5e200, 0.0], [1e200, 2e200, 0.0]],
        ] {
            assert_eq!(triangulate(&corners).triangles, fan(corners.len()));
        }
        assert_eq!(triangulate(&[]).triangles, fan(0));
        assert_eq!(triangulate(&[[1.0; 3]]).triangles, [[0; 3]]);
        assert_eq!(triangulate(&[[1.0; 3], [2.0; 3]]).triangles, [[0, 1, 1]]);
    }

    #[test]
    fn polygons_that_cross_themselves_are_fans_and_said_to_be() {
        // The areas of the second and third one cancel; the corners of the third are rounded.
        let tilted = |[x, y]: [f64; 2]| [x + 0.1 * y, 0.7 * y - 0.3 * x, 0.3 * x];
        for bow in [
            [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.1, 0.0]],
            [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[0.1, 0.1], [0.7, 0.8], [0.7, 0.1], [0.1, 0.8]].map(tilted),
        ] {
            let Triangulated { triangles, overlap } = triangulate(&bow);
            assert_eq!((triangles, overlap), (vec![[0, 1, 2], [0, 2, 3]], true));
        }
        // There and back on a line is no crossing.
        let line = [0.1, 0.4, 0.7, 0.3].map(|x| tilted([x, x]));
        assert!(!triangulate(&line).overlap);
    }
}
