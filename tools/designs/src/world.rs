//! Vertices in world coordinates of 32 bits: the eye is subtracted first, rows are Q2.30 with the focal length folded in, and
//! each vertex is scaled to 31 bits.

use crate::chain::{Design, ScreenVertex};
use crate::divide::Divide;
use crate::num::{exp2, log2_above, mul_wide, nearest32, within};
use crate::vertex::InWorld;
use crate::Object;
use core::marker::PhantomData;

pub(crate) struct BlockScaled<D> {
    rows: [[i32; 3]; 3],
    eye: [i32; 3],
    /// The near plane's distance in 2⁻¹⁴.
    near: i32,
    /// The smallest w, scaled.
    least: i32,
    narrow: u32,
    beyond: i32,
    divide: PhantomData<D>,
}

impl<D: Divide> BlockScaled<D> {
    /// x, y and w in 2⁻¹⁴ · 2⁻ⁿ, and n.
    #[inline(always)]
    fn clip(&self, InWorld(v): InWorld) -> ([i32; 3], u32) {
        let from_eye = [0, 1, 2].map(|i| v[i].wrapping_sub(self.eye[i]));
        let bits = from_eye.iter().fold(0, |bits, &c| bits | (c ^ (c >> 31)));
        let n = (bits.leading_zeros() - 1) & 31;
        let scaled = from_eye.map(|c| c << n);
        let at = |row: [i32; 3]| {
            let sum = |sum: i64, (c, v): (i32, i32)| sum.wrapping_add(mul_wide(c, v));
            (row.into_iter().zip(scaled).fold(1 << 31, sum) >> 32) as i32
        };
        (self.rows.map(at), n)
    }
}

impl<D: Divide> Design for BlockScaled<D> {
    type Vertex = InWorld;

    fn new(object: &Object) -> Option<Self> {
        let beyond = log2_above(object.focal).max(object.half_picture());
        let [x, y, w] = object.axes;
        let to_xy = object.focal * exp2(30 - beyond);
        let row = |row: [f64; 3], factor: f64| row.map(|c| nearest32(c * factor));
        let zeros = 28 - beyond - 8;
        Some(Self {
            rows: [row(x, to_xy), row(y, to_xy), row(w, exp2(30))],
            eye: object.eye.map(|c| nearest32(c * 65536.0)),
            near: nearest32(object.near * 16384.0),
            least: 1 << (30 - zeros.clamp(0, 15)),
            narrow: (beyond - 10).max(0) as u32,
            beyond,
            divide: PhantomData,
        })
    }

    #[inline(always)]
    fn corner(&self, v: InWorld) -> ScreenVertex {
        let ([x, y, w], scaled) = self.clip(v);
        let limit = w >> (self.narrow & 31);
        if (w >> scaled) < self.near || w < self.least || !within(x, limit) || !within(y, limit) {
            return ScreenVertex::EMPTY;
        }
        let (by, n) = D::by(w);
        let right = (20 - self.beyond - n as i32) & 31; // by `least`
        let along = |v| ((D::high(v, by) >> right) + 1) >> 1;
        ScreenVertex { x: along(x), y: along(y) }
    }

    fn before_snap(&self, v: InWorld) -> [f64; 2] {
        let ([x, y, w], _) = self.clip(v);
        let (by, n) = D::by(w);
        [x, y].map(|v| D::before(v, by) * exp2(self.beyond + n as i32 - 29))
    }
}
