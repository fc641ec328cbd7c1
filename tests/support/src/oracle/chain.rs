//! The whole vertex chain in f64, straight from docs/spec.md, sections 2–4 and 6, starting from the quantised inputs:
//! I16F16 numbers as their bits, angles as binary bits, i16 vertices with their exponent.
//!
//! f64 is accurate enough only if the eye is subtracted before anything is rotated. World
//! coordinates reach 2¹⁵, one unit in the last place is then 2⁻³⁷; at focal ÷ distance = 700 ÷ ¼ that
//! is 2·10⁻⁸ px.

pub type V3 = [f64; 3];
pub type V4 = [f64; 4];
pub type M3 = [[f64; 3]; 3];
pub type M4 = [[f64; 4]; 4];

/// The value of I16F16 bits.
pub fn fx(bits: i32) -> f64 {
    f64::from(bits) / 65536.0
}

pub fn fx3(bits: [i32; 3]) -> V3 {
    bits.map(fx)
}

/// The nearest I16F16 bits, or none.
pub fn to_fx(value: f64) -> Option<i32> {
    let bits = (value * 65536.0).round();
    (bits >= f64::from(i32::MIN) && bits <= f64::from(i32::MAX)).then_some(bits as i32)
}

pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: V3) -> f64 {
    dot(a, a).sqrt()
}

pub fn normalise(a: V3) -> V3 {
    let n = length(a);
    a.map(|c| c / n)
}

/// Sutherland and Hodgman: the part of a polygon where a distance is not negative. All numbers of a corner are linear along an edge.
pub fn cut<const N: usize>(polygon: &[[f64; N]], distance: impl Fn(&[f64; N]) -> f64) -> Vec<[f64; N]> {
    let mut kept = Vec::new();
    for (i, to) in polygon.iter().enumerate() {
        let from = &polygon[(i + polygon.len() - 1) % polygon.len()];
        let (d_from, d_to) = (distance(from), distance(to));
        if (d_from < 0.0) != (d_to < 0.0) {
            let t = d_from / (d_from - d_to);
            kept.push(core::array::from_fn(|k| from[k] + t * (to[k] - from[k])));
        }
        if d_to >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}

/// The area of a polygon whose corners run counter-clockwise with y upwards; of others it is negative.
pub fn area(polygon: &[[f64; 2]]) -> f64 {
    let after = polygon.iter().cycle().skip(1);
    polygon.iter().zip(after).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

pub fn mul3(m: &M3, v: V3) -> V3 {
    m.map(|row| dot(row, v))
}

pub fn mul4(m: &M4, v: V4) -> V4 {
    m.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * v[3])
}

pub fn matmul3(a: &M3, b: &M3) -> M3 {
    a.map(|r| core::array::from_fn(|j| (0..3).map(|k| r[k] * b[k][j]).sum()))
}

pub fn matmul4(a: &M4, b: &M4) -> M4 {
    a.map(|r| core::array::from_fn(|j| (0..4).map(|k| r[k] * b[k][j]).sum()))
}

/// Cross product of integers, exact (33-bit inputs at most), then rounded once.
pub fn cross_exact(a: [i64; 3], b: [i64; 3]) -> V3 {
    let c = |i: usize, j: usize| {
        (i128::from(a[i]) * i128::from(b[j]) - i128::from(a[j]) * i128::from(b[i])) as f64
    };
    [c(1, 2), c(2, 0), c(0, 1)]
}

/// (sin, cos) of a binary angle, exact at the quarter turns.
pub fn sin_cos(bits: u32) -> (f64, f64) {
    // The nearest quarter turn, and the rest within an eighth of a turn.
    let quarter = (bits.wrapping_add(1 << 29)) >> 30;
    let rest = bits.wrapping_sub(quarter << 30) as i32;
    let (s, c) = (f64::from(rest) * (core::f64::consts::TAU / 4_294_967_296.0)).sin_cos();
    match quarter {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// docs/spec.md, section 2: a linear part and a translation.
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    pub m: M3,
    pub t: V3,
}

pub const IDENTITY: Affine = Affine { m: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], t: [0.0; 3] };

impl Affine {
    pub fn translation(bits: [i32; 3]) -> Self {
        Affine { t: fx3(bits), ..IDENTITY }
    }

    pub fn scale(bits: [i32; 3]) -> Self {
        let [x, y, z] = fx3(bits);
        Affine { m: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], t: [0.0; 3] }
    }

    pub fn rotation_x(angle: u32) -> Self {
        let (s, c) = sin_cos(angle);
        Affine { m: [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]], t: [0.0; 3] }
    }

    pub fn rotation_y(angle: u32) -> Self {
        let (s, c) = sin_cos(angle);
        Affine { m: [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]], t: [0.0; 3] }
    }

    pub fn rotation_z(angle: u32) -> Self {
        let (s, c) = sin_cos(angle);
        Affine { m: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], t: [0.0; 3] }
    }

    /// First self, then next.
    pub fn then(&self, next: &Affine) -> Self {
        Affine {
            m: matmul3(&next.m, &self.m),
            t: core::array::from_fn(|i| dot(next.m[i], self.t) + next.t[i]),
        }
    }

    pub fn apply(&self, p: V3) -> V3 {
        core::array::from_fn(|i| dot(self.m[i], p) + self.t[i])
    }
}

/// The model coordinates of an i16 vertex.
pub fn vertex(v: [i16; 3], exponent: i8) -> V3 {
    v.map(|c| f64::from(c) * f64::from(exponent).exp2())
}

/// docs/spec.md, section 3: world → view. The rows are u, v, n.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub rows: M3,
    pub eye: V3,
}

impl View {
    /// View reference: VRP, VPN, VUP.
    pub fn from_reference(vrp: [i32; 3], vpn: [i32; 3], vup: [i32; 3]) -> Self {
        Self::along(vrp, vpn.map(i64::from), vup.map(i64::from))
    }

    /// Look-at: the camera at `eye` looks along −z towards `target`.
    pub fn look_at(eye: [i32; 3], target: [i32; 3], up: [i32; 3]) -> Self {
        let n = core::array::from_fn(|i| i64::from(eye[i]) - i64::from(target[i]));
        Self::along(eye, n, up.map(i64::from))
    }

    pub fn look_along(eye: [i32; 3], gaze: [i32; 3], up: [i32; 3]) -> Self {
        Self::along(eye, gaze.map(|g| -i64::from(g)), up.map(i64::from))
    }

    fn along(eye: [i32; 3], n: [i64; 3], up: [i64; 3]) -> Self {
        let u = normalise(cross_exact(up, n));
        let n = normalise(n.map(|c| c as f64));
        let v = cross(n, u);
        View { rows: [u, v, n], eye: fx3(eye) }
    }

    /// The eye first, then the rotation.
    pub fn apply(&self, world: V3) -> V3 {
        mul3(&self.rows, core::array::from_fn(|i| world[i] - self.eye[i]))
    }

    /// View coordinates of a model point: the translations are added before anything large is rotated.
    pub fn apply_placed(&self, model: &Affine, p: V3) -> V3 {
        let relative = Affine { m: model.m, t: core::array::from_fn(|i| model.t[i] - self.eye[i]) };
        mul3(&self.rows, relative.apply(p))
    }

    /// What [`apply`](Self::apply) brings here: the rows are orthonormal.
    pub fn back(&self, at: V3) -> V3 {
        core::array::from_fn(|i| self.eye[i] + (0..3).map(|k| self.rows[k][i] * at[k]).sum::<f64>())
    }
}

/// docs/spec.md, section 4: the frustum, near and far positive distances.
pub fn frustum(l: f64, r: f64, b: f64, t: f64, n: f64, f: f64) -> M4 {
    [
        [2.0 * n / (r - l), 0.0, (r + l) / (r - l), 0.0],
        [0.0, 2.0 * n / (t - b), (t + b) / (t - b), 0.0],
        [0.0, 0.0, -(f + n) / (f - n), -2.0 * f * n / (f - n)],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// By vertical field of view (a binary angle) and aspect.
pub fn perspective(fov_y: u32, width: u32, height: u32, n: f64, f: f64) -> M4 {
    let half = f64::from(fov_y) * (core::f64::consts::PI / 4_294_967_296.0);
    let t = n * half.tan();
    let r = t * f64::from(width) / f64::from(height);
    frustum(-r, r, -t, t, n, f)
}

/// The box to [−1, 1]³: the centre to the origin, then scaled; near at −1. near and far are
/// distances along −z.
pub fn orthographic(l: f64, r: f64, b: f64, t: f64, n: f64, f: f64) -> M4 {
    [
        [2.0 / (r - l), 0.0, 0.0, -(r + l) / (r - l)],
        [0.0, 2.0 / (t - b), 0.0, -(t + b) / (t - b)],
        [0.0, 0.0, -2.0 / (f - n), -(f + n) / (f - n)],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// docs/spec.md, section 6.
#[derive(Clone, Copy, Debug)]
pub struct Viewport {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl Viewport {
    pub fn new(x: i32, y: i32, width: u32, height: u32) -> Self {
        Viewport { x: f64::from(x), y: f64::from(y), width: f64::from(width), height: f64::from(height) }
    }

    pub fn apply(&self, ndc: V3) -> (f64, f64) {
        (self.x + (ndc[0] + 1.0) * self.width / 2.0, self.y + (1.0 - ndc[1]) * self.height / 2.0)
    }
}

/// docs/spec.md, section 7: the depth before it is rounded and clamped, 0 near … 65535 far.
pub fn depth(clip: V4) -> f64 {
    65535.0 * (clip[2] / clip[3] + 1.0) / 2.0
}

/// A camera: the three, in f64.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub view: View,
    pub projection: M4,
    pub viewport: Viewport,
}

impl Camera {
    pub fn clip(&self, model: &Affine, p: V3) -> V4 {
        let [x, y, z] = self.view.apply_placed(model, p);
        mul4(&self.projection, [x, y, z, 1.0])
    }

    pub fn screen(&self, clip: V4) -> (f64, f64) {
        let w = clip[3];
        self.viewport.apply([clip[0] / w, clip[1] / w, clip[2] / w])
    }

    /// Homogeneous screen coordinates (x·w, y·w, w), in pixels.
    pub fn homogeneous_screen(&self, clip: V4) -> V3 {
        let [x, y, _, w] = clip;
        let v = &self.viewport;
        [v.x * w + (x + w) * v.width / 2.0, v.y * w + (w - y) * v.height / 2.0, w]
    }
}

/// The snap to 24.8 by rounding.
pub fn snap(p: (f64, f64)) -> (i64, i64) {
    ((p.0 * 256.0).round() as i64, (p.1 * 256.0).round() as i64)
}
