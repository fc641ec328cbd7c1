//! f32, for which a core with an FPU is fast.

use crate::chain::{Design, ScreenVertex};
use crate::Object;

/// As other libraries do it: a 4 × 4 matrix, the product of model, view and projection in f32, with the world's absolute
/// translations in it; three divisions; the viewport.
pub(crate) struct Matrix {
    mvp: [[f32; 4]; 4],
    /// Half the viewport's size, in sub-pixels.
    half: [f32; 2],
}

fn product(a: &[[f32; 4]; 4], b: &[[f32; 4]; 4]) -> [[f32; 4]; 4] {
    a.map(|row| [0, 1, 2, 3].map(|j| (0..4).map(|k| row[k] * b[k][j]).sum()))
}

fn affine(linear: [[f32; 3]; 3], [tx, ty, tz]: [f32; 3]) -> [[f32; 4]; 4] {
    let [[a, b, c], [d, e, f], [g, h, i]] = linear;
    [[a, b, c, tx], [d, e, f, ty], [g, h, i, tz], [0.0, 0.0, 0.0, 1.0]]
}

impl Matrix {
    #[inline(always)]
    fn clip(&self, [x, y, z]: [f32; 3]) -> [f32; 4] {
        self.mvp.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// The corner before the snap, in sub-pixels.
    #[inline(always)]
    fn place(&self, [x, y, z, w]: [f32; 4]) -> [f32; 3] {
        let [half_width, half_height] = self.half;
        // Rows count downwards already. Depth is not stored, but other libraries divide it, too.
        [(x / w + 1.0) * half_width, (y / w + 1.0) * half_height, z / w]
    }
}

impl Design for Matrix {
    type Vertex = [f32; 3];
    const FROM_CENTRE: bool = false;

    fn new(object: &Object) -> Option<Self> {
        let narrow = |v: [f64; 3]| v.map(|c| c as f32);
        let (axes, eye) = (object.axes.map(narrow), narrow(object.eye));
        let model = affine(object.model.map(narrow), narrow(object.place));
        // −R·eye from the rounded rows.
        let view = affine(axes, axes.map(|[a, b, c]| -(a * eye[0] + b * eye[1] + c * eye[2])));
        let [cx, cy] = object.centre.map(|c| c as f32);
        let (focal, near, far) = (object.focal as f32, object.near as f32, object.far as f32);
        let (depth, constant) = ((far + near) / (far - near), -2.0 * far * near / (far - near));
        let projection = [
            [focal / cx, 0.0, 0.0, 0.0],
            [0.0, focal / cy, 0.0, 0.0],
            [0.0, 0.0, depth, constant],
            [0.0, 0.0, 1.0, 0.0],
        ];
        Some(Self { mvp: product(&projection, &product(&view, &model)), half: [cx * 256.0, cy * 256.0] })
    }

    #[inline(always)]
    fn corner(&self, v: [f32; 3]) -> ScreenVertex {
        let clip = self.clip(v);
        if clip[2] < -clip[3] {
            return ScreenVertex::EMPTY;
        }
        let [x, y, z] = self.place(clip);
        core::hint::black_box(z);
        ScreenVertex { x: (x + 0.5) as i32, y: (y + 0.5) as i32 }
    }

    fn before_snap(&self, v: [f32; 3]) -> [f64; 2] {
        let [x, y, _] = self.place(self.clip(v)).map(|c| f64::from(c) / 256.0);
        [x, y]
    }
}

/// The best that f32 can do: three rows from the eye, with the focal length in sub-pixels folded in, and one division.
pub(crate) struct EyeRelative {
    rows: [[f32; 4]; 3],
    near: f32,
}

/// Adding it leaves the nearest integer in the low bits of the sum.
const ROUND: f32 = 12_582_912.0; // 1.5·2²³

impl EyeRelative {
    #[inline(always)]
    fn place(&self, [x, y, z]: [f32; 3]) -> Option<[f32; 2]> {
        let [x, y, z] = self.rows.map(|[a, b, c, d]| a * x + b * y + c * z + d);
        if z < self.near {
            return None;
        }
        let r = 1.0 / z;
        Some([x * r, y * r])
    }
}

impl Design for EyeRelative {
    type Vertex = [f32; 3];

    fn new(object: &Object) -> Option<Self> {
        let (linear, offset) = (object.linear(), object.offset());
        let scale = [256.0 * object.focal, 256.0 * object.focal, 1.0];
        let row = |i: usize| {
            let [a, b, c] = linear[i];
            [a, b, c, offset[i]].map(|c| (c * scale[i]) as f32)
        };
        Some(Self { rows: [row(0), row(1), row(2)], near: object.near as f32 })
    }

    #[inline(always)]
    fn corner(&self, v: [f32; 3]) -> ScreenVertex {
        let Some(place) = self.place(v) else { return ScreenVertex::EMPTY };
        // Correct up to 2²² sub-pixels: twice the guard band.
        let [x, y] = place.map(|c| (c + ROUND).to_bits() as i32 - ROUND.to_bits() as i32);
        ScreenVertex { x, y }
    }

    fn before_snap(&self, v: [f32; 3]) -> [f64; 2] {
        self.place(v).unwrap_or_default().map(|c| f64::from(c) / 256.0)
    }
}
