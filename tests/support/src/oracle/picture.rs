//! Complete pictures: what each pixel of a depth-tested scene may show, in f64.
//!
//! Every triangle becomes a polygon on the screen, cut at near and far in homogeneous coordinates. A
//! pixel that shows a triangle is explained by moving edges: the triangle's own outwards until it
//! covers the pixel's centre, and those of all nearer ones inwards until they do not. The smallest such
//! move is the picture's error at that pixel, in pixels, whatever its cause.

use super::chain::{area, cut, mul4, M4, V3, V4};

/// A scene in the terms of docs/spec.md, section 10.
#[derive(Clone, Debug)]
pub struct Scene {
    pub vertices: Vec<V3>,
    pub triangles: Vec<[usize; 3]>,
    pub model: M4,
    pub view: M4,
    pub projection: M4,
    pub width: usize,
    pub height: usize,
    pub viewport: [f64; 4],
    pub cull: bool,
}

/// A triangle on the screen, in pixels, y down.
struct Polygon {
    corners: Vec<[f64; 2]>,
    /// The depth plane of the triangle that it was cut from: depth = a·x + b·y + c, 0 … 65535.
    plane: V3,
    /// The smallest w of a corner.
    w: f64,
}

impl Scene {
    /// model, view, projection: the eye is far from where the numbers are small, so the matrices are
    /// not multiplied.
    pub fn clip(&self, v: V3) -> V4 {
        let p = [v[0], v[1], v[2], 1.0];
        mul4(&self.projection, mul4(&self.view, mul4(&self.model, p)))
    }

    fn screen(&self, [x, y, _, w]: V4) -> [f64; 2] {
        let [left, top, width, height] = self.viewport;
        [left + (x / w + 1.0) * width / 2.0, top + (1.0 - y / w) * height / 2.0]
    }

    fn polygon(&self, triangle: [usize; 3]) -> Option<Polygon> {
        let clip = triangle.map(|i| self.clip(self.vertices[i]));
        // w − near's distance would do for planes through the eye; here every point kept has w > 0.
        let planes: [fn(&V4) -> f64; 3] = [|p| p[2] + p[3], |p| p[3] - p[2], |p| p[3]];
        let corners = planes.iter().fold(clip.to_vec(), |corners, plane| cut(&corners, plane));
        if corners.len() < 3 || corners.iter().any(|c| c[3] <= 0.0) {
            return None;
        }
        // The plane of z/w over the screen, from the whole triangle: Σ weight·z over Σ weight·w.
        let [left, top, width, height] = self.viewport;
        let h: [V3; 3] =
            clip.map(|[x, y, _, w]| [left * w + (x + w) * width / 2.0, top * w + (w - y) * height / 2.0, w]);
        let cross = super::chain::cross;
        let det = super::chain::dot(h[0], cross(h[1], h[2]));
        let weights = [cross(h[1], h[2]), cross(h[2], h[0]), cross(h[0], h[1])];
        let z: V3 = core::array::from_fn(|k| (0..3).map(|i| weights[i][k] * clip[i][2]).sum::<f64>() / det);
        let plane = [z[0] * 32_767.5, z[1] * 32_767.5, (z[2] + 1.0) * 32_767.5];
        let w = corners.iter().map(|c| c[3]).fold(f64::INFINITY, f64::min);
        let corners: Vec<_> = corners.into_iter().map(|c| self.screen(c)).collect();
        if self.cull && area(&corners) > 0.0 {
            return None; // on the screen, whose y points down, front faces have a negative area
        }
        Some(Polygon { corners, plane, w })
    }

    /// What ARCHITECTURE.md, "Numbers", allows the depth of a corner with w = 1, in steps: the budget
    /// over the rows z and w, where |z/w| ≤ 1.
    fn depth_budget(&self) -> f64 {
        let norm = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        // The object's half extent about the origin that it is measured from: its own, or, where that is
        // more than 256 half extents away, one close to it.
        let along =
            |f: fn(f64, f64) -> f64, from: f64, i: usize| self.vertices.iter().map(|v| v[i]).fold(from, f);
        let half: V3 = core::array::from_fn(|i| {
            (along(f64::max, f64::NEG_INFINITY, i) - along(f64::min, f64::INFINITY, i)) / 2.0
        });
        let half = norm(&half);
        let farthest = self.vertices.iter().map(|v| norm(v)).fold(0.0, f64::max);
        let own = if farthest > 256.0 * half { 4.0 * half } else { farthest };
        let stretch =
            norm(&[norm(&self.model[0][..3]), norm(&self.model[1][..3]), norm(&self.model[2][..3])]);
        let away = self.vertices.iter().map(|&v| {
            let p = mul4(&self.view, mul4(&self.model, [v[0], v[1], v[2], 1.0]));
            norm(&p[..3])
        });
        let reach = own * stretch + away.fold(0.0, f64::max);
        let size = |row: &V4| (row[0].abs() + row[1].abs() + row[2].abs()) * reach + row[3].abs();
        12.0 * (-30f64).exp2() * 65_535.0 / 2.0 * (size(&self.projection[2]) + size(&self.projection[3]))
    }
}

impl Polygon {
    /// How far inside the point lies, or, negative, how far from the polygon.
    fn depth_inside(&self, x: f64, y: f64) -> f64 {
        let turn = area(&self.corners).signum();
        let (mut nearest, mut inside) = (f64::INFINITY, turn != 0.0);
        for (i, a) in self.corners.iter().enumerate() {
            let b = self.corners[(i + 1) % self.corners.len()];
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let (px, py) = (x - a[0], y - a[1]);
            let length = dx * dx + dy * dy;
            if length == 0.0 {
                nearest = nearest.min(px.hypot(py));
                continue;
            }
            inside &= turn * (dx * py - dy * px) >= 0.0;
            let t = ((px * dx + py * dy) / length).clamp(0.0, 1.0);
            nearest = nearest.min((px - t * dx).hypot(py - t * dy));
        }
        if inside {
            nearest
        } else {
            -nearest
        }
    }

    fn z(&self, x: f64, y: f64) -> f64 {
        self.plane[0] * x + self.plane[1] * y + self.plane[2]
    }

    /// Whether a corner lies in the last step but half a one before the far plane.
    fn reaches_far(&self) -> bool {
        self.corners.iter().any(|c| self.z(c[0], c[1]) > 65_534.4)
    }

    /// How much the depth may change with a move of the edges by `px`.
    fn slack(&self, px: f64) -> f64 {
        px * (self.plane[0].abs() + self.plane[1].abs())
    }
}

/// The result of comparing a picture with the oracle.
#[derive(Debug, Default)]
pub struct Comparison {
    /// The smallest move of edges that explains all pixels, in px.
    pub shift: f64,
    /// Pixels whose centre shows something else than the exact scene: they need the move.
    pub moved: usize,
    /// Moved pixels that show a triangle instead of the background, or the background instead of a triangle.
    pub background: usize,
    /// The largest distance of a stored depth from the exact one, in steps, beyond what a move of the
    /// edges by `SNAP` changes and what the chain may do to the corners' depths.
    pub depth: f64,
    /// The tolerance for triangles that reach the far plane.
    pub depth_at_far: f64,
    pub pixels: usize,
    pub covered: usize,
}

/// Half a sub-pixel along both axes, and as much again for the chain.
const SNAP: f64 = 0.003;
/// Depths closer than this tie: both are rounded by less than one step.
const TIE: f64 = 2.0;

impl Comparison {
    pub fn add(&mut self, other: &Comparison) {
        self.shift = self.shift.max(other.shift);
        self.depth = self.depth.max(other.depth);
        self.depth_at_far = self.depth_at_far.max(other.depth_at_far);
        self.moved += other.moved;
        self.background += other.background;
        self.pixels += other.pixels;
        self.covered += other.covered;
    }
}

/// Compares a picture of triangle indices (−1: none) and depths with the scene.
pub fn compare(scene: &Scene, ids: &[i32], depths: &[u16]) -> Comparison {
    assert_eq!((ids.len(), depths.len()), (scene.width * scene.height, scene.width * scene.height));
    let polygons: Vec<_> = scene.triangles.iter().map(|&t| scene.polygon(t)).collect();
    // Rows of candidates: only polygons whose bounding box is near.
    let boxes: Vec<_> = polygons
        .iter()
        .enumerate()
        .filter_map(|(i, p)| {
            let p = p.as_ref()?;
            let along = |k: usize, f: fn(f64, f64) -> f64, from| p.corners.iter().map(|c| c[k]).fold(from, f);
            let low = [0, 1].map(|k| along(k, f64::min, f64::INFINITY));
            let high = [0, 1].map(|k| along(k, f64::max, f64::NEG_INFINITY));
            Some((i, low, high))
        })
        .collect();
    let budget = scene.depth_budget();
    let mut result = Comparison::default();
    let [left, top, width, height] = scene.viewport;
    for row in 0..scene.height {
        let y = row as f64 + 0.5;
        let near_row: Vec<_> =
            boxes.iter().filter(|(_, low, high)| low[1] - 1.0 < y && y < high[1] + 1.0).collect();
        for column in 0..scene.width {
            let x = column as f64 + 0.5;
            let (id, stored) = (ids[row * scene.width + column], depths[row * scene.width + column]);
            assert_eq!(id == -1, stored == u16::MAX, "({column}, {row})");
            if x < left || x > left + width || y < top || y > top + height {
                assert_eq!(id, -1, "({column}, {row}) lies outside the viewport");
                continue;
            }
            result.pixels += 1;
            let mut shift = 0f64;
            let mut limit = f64::INFINITY;
            if id >= 0 {
                result.covered += 1;
                let shown = polygons[id as usize].as_ref();
                let shown =
                    shown.unwrap_or_else(|| panic!("({column}, {row}) shows {id}, which is not there"));
                shift = shift.max(-shown.depth_inside(x, y));
                let z = shown.z(x, y);
                limit = z - TIE - shown.slack(SNAP);
                let beyond = (f64::from(stored) - z.clamp(0.0, 65_534.0)).abs() - shown.slack(SNAP);
                let beyond = beyond - budget / shown.w;
                let largest = if shown.reaches_far() { &mut result.depth_at_far } else { &mut result.depth };
                *largest = largest.max(beyond);
            }
            for (i, low, high) in &near_row {
                if *i as i32 == id || x <= low[0] || x >= high[0] {
                    continue;
                }
                let Some(polygon) = &polygons[*i] else { continue };
                let inside = polygon.depth_inside(x, y);
                if inside > shift && polygon.z(x, y) + polygon.slack(SNAP) < limit {
                    shift = inside;
                }
            }
            if shift > 0.0 {
                result.moved += 1;
                let covered = near_row.iter().any(|(i, ..)| {
                    polygons[*i].as_ref().is_some_and(|polygon| polygon.depth_inside(x, y) > 0.0)
                });
                result.background += usize::from(covered == (id == -1));
            }
            result.shift = result.shift.max(shift);
        }
    }
    result
}
