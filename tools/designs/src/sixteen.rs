//! Q16.16 throughout, with a 64-bit division for each coordinate.

use crate::chain::{Design, ScreenVertex};
use crate::num::{dot, exp2, nearest, nearest32};
use crate::vertex::InWorld;
use crate::Object;

/// A view coordinate divided by depth, in 2⁻¹⁶ px.
#[inline(always)]
fn quotient(v: i32, focal: i32, z: i32) -> i32 {
    (i64::from(v) * i64::from(focal)).checked_div(z.into()).unwrap_or(0) as i32
}

/// The position of a view point on the screen.
#[inline(always)]
fn corner([x, y, z]: [i32; 3], near: i32, focal: i32) -> ScreenVertex {
    if z < near {
        return ScreenVertex::EMPTY;
    }
    let along = |v| (quotient(v, focal, z) + 128) >> 8;
    ScreenVertex { x: along(x), y: along(y) }
}

fn before_snap([x, y, z]: [i32; 3], focal: i32) -> [f64; 2] {
    [x, y].map(|v| f64::from(quotient(v, focal, z)) / 65536.0)
}

fn q16(v: f64) -> i32 {
    nearest32(v * 65536.0)
}

/// `a · b`, rounded down after each product.
#[inline(always)]
fn times(a: i32, b: i32) -> i32 {
    ((i64::from(a) * i64::from(b)) >> 16) as i32
}

/// A view matrix with an absolute translation, which is what most people write first.
pub(crate) struct Naive {
    rows: [[i32; 3]; 3],
    translation: [i32; 3],
    focal: i32,
    near: i32,
}

impl Naive {
    #[inline(always)]
    fn view(&self, InWorld([x, y, z]): InWorld) -> [i32; 3] {
        [0, 1, 2].map(|i| {
            let [a, b, c] = self.rows[i];
            times(a, x).wrapping_add(times(b, y)).wrapping_add(times(c, z)).wrapping_add(self.translation[i])
        })
    }
}

impl Design for Naive {
    type Vertex = InWorld;

    fn new(object: &Object) -> Option<Self> {
        let rows = object.axes.map(|row| row.map(q16));
        let [x, y, z] = object.eye.map(q16);
        // From the rounded rows.
        let translation = rows
            .map(|[a, b, c]| times(a, x).wrapping_add(times(b, y)).wrapping_add(times(c, z)).wrapping_neg());
        Some(Self { rows, translation, focal: q16(object.focal), near: q16(object.near) })
    }

    #[inline(always)]
    fn corner(&self, v: InWorld) -> ScreenVertex {
        corner(self.view(v), self.near, self.focal)
    }

    fn before_snap(&self, v: InWorld) -> [f64; 2] {
        before_snap(self.view(v), self.focal)
    }
}

/// Sums of 64 bits, but a translation from the exact rotation, which does not fit the rounded rows.
pub(crate) struct Mismatched {
    rows: [[i32; 3]; 3],
    /// The translation in 2⁻³².
    translation: [i64; 3],
    focal: i32,
    near: i32,
}

impl Mismatched {
    #[inline(always)]
    fn view(&self, InWorld(v): InWorld) -> [i32; 3] {
        [0, 1, 2].map(|i| {
            let sum = |sum: i64, (&c, v): (&i32, i32)| sum.wrapping_add(i64::from(c) * i64::from(v));
            (self.rows[i].iter().zip(v).fold(self.translation[i], sum) >> 16) as i32
        })
    }
}

impl Design for Mismatched {
    type Vertex = InWorld;

    fn new(object: &Object) -> Option<Self> {
        let translation = object.axes.map(|row| nearest(-dot(row, object.eye) * exp2(32)) + (1 << 15));
        let rows = object.axes.map(|row| row.map(q16));
        Some(Self { rows, translation, focal: q16(object.focal), near: q16(object.near) })
    }

    #[inline(always)]
    fn corner(&self, v: InWorld) -> ScreenVertex {
        corner(self.view(v), self.near, self.focal)
    }

    fn before_snap(&self, v: InWorld) -> [f64; 2] {
        before_snap(self.view(v), self.focal)
    }
}

/// Subtracts the eye first; then rows of a given number of fractional bits with sums of 64 bits, rounded to Q16.16.
pub(crate) struct EyeFirst<const FRACTION: u32> {
    rows: [[i32; 3]; 3],
    eye: [i32; 3],
    focal: i32,
    near: i32,
}

impl<const FRACTION: u32> EyeFirst<FRACTION> {
    #[inline(always)]
    fn view(&self, InWorld(v): InWorld) -> [i32; 3] {
        let from_eye = [0, 1, 2].map(|i| v[i].wrapping_sub(self.eye[i]));
        self.rows.map(|row| {
            let sum = |sum: i64, (c, v): (i32, i32)| sum.wrapping_add(i64::from(c) * i64::from(v));
            (row.into_iter().zip(from_eye).fold(1 << (FRACTION - 1), sum) >> FRACTION) as i32
        })
    }
}

impl<const FRACTION: u32> Design for EyeFirst<FRACTION> {
    type Vertex = InWorld;

    fn new(object: &Object) -> Option<Self> {
        let rows = object.axes.map(|row| row.map(|c| nearest32(c * exp2(FRACTION as i32))));
        Some(Self { rows, eye: object.eye.map(q16), focal: q16(object.focal), near: q16(object.near) })
    }

    #[inline(always)]
    fn corner(&self, v: InWorld) -> ScreenVertex {
        corner(self.view(v), self.near, self.focal)
    }

    fn before_snap(&self, v: InWorld) -> [f64; 2] {
        before_snap(self.view(v), self.focal)
    }
}
