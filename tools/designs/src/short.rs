//! Designs whose products all fit 32 bits.

use crate::chain::{Design, ScreenVertex};
use crate::divide::{normalised, sixteen_bits, Interpolated, OneStep, Reciprocal, TwoSteps, LEAST};
use crate::form::exponent;
use crate::num::{exp2, log2_above, mul_middle, nearest, nearest32, sum_of, within};
use crate::vertex::Coarse;
use crate::{Object, Vertex};

/// The part that these designs share, from x, y and w on. `WIDE`: quotients by products of 32 × 16 bits instead of 16 × 16.
struct Screen<const WIDE: bool> {
    near: i32,
    narrow: u32,
    /// x/w · 2^beyond is in pixels.
    beyond: i32,
}

/// x/w and y/w in 2^(n − 30), and n.
type Quotients = ([i32; 2], u32);

impl<const WIDE: bool> Screen<WIDE> {
    fn new(object: &Object, e_xy: i32, e_w: i32) -> Self {
        let beyond = e_xy - e_w;
        let least = LEAST.max(1 << (30 - (20 - beyond).clamp(0, 15))); // for the shift of `corner`
        let near = nearest32(object.near * exp2(-e_w)).max(least);
        Self { near, narrow: (beyond - 10).max(0) as u32, beyond }
    }

    #[inline(always)]
    fn quotients<R: Reciprocal>(&self, [x, y, w]: [i32; 3]) -> Option<Quotients> {
        // A little less than w, so that rounding to 16 bits stays inside.
        let limit = (w - (w >> 12)) >> (self.narrow & 31);
        if w < self.near || !within(x, limit) || !within(y, limit) {
            return None;
        }
        let (m, n) = normalised(w);
        let r = sixteen_bits::<R>(m);
        Some(if WIDE {
            ([x, y].map(|v| mul_middle(v, r)), n)
        } else {
            ([x, y].map(|v| (((v << n) + (1 << 15)) >> 16) * r), 0)
        })
    }

    #[inline(always)]
    fn corner(&self, quotients: Option<Quotients>) -> ScreenVertex {
        let Some((quotients, n)) = quotients else { return ScreenVertex::EMPTY };
        let right = (21 - self.beyond - n as i32) & 31; // by `near`
        let [x, y] = quotients.map(|q| ((q >> right) + 1) >> 1);
        ScreenVertex { x, y }
    }

    fn before_snap(&self, quotients: Option<Quotients>) -> [f64; 2] {
        let (quotients, n) = quotients.unwrap_or_default();
        quotients.map(|q| f64::from(q) * exp2(self.beyond + n as i32 - 30))
    }
}

/// Rows in units of x, y and w, the exponents of these units, and the offsets.
fn rows(object: &Object, exponent: impl Fn([f64; 3], f64) -> i32) -> ([[f64; 3]; 3], [f64; 3], i32, i32) {
    let ([x, y, w], [ox, oy, ow]) = (object.linear(), object.offset());
    let focal = object.focal;
    let (x, y, ox, oy) = (x.map(|c| c * focal), y.map(|c| c * focal), ox * focal, oy * focal);
    let e_w = exponent(w, ow);
    let e_xy = exponent(x, ox).max(exponent(y, oy)).max(e_w + object.half_picture());
    let scaled = |row: [f64; 3], e: i32| row.map(|c| c * exp2(-e));
    let offsets = [ox * exp2(-e_xy), oy * exp2(-e_xy), ow * exp2(-e_w)];
    ([scaled(x, e_xy), scaled(y, e_xy), scaled(w, e_w)], offsets, e_xy, e_w)
}

/// One 32-bit product for each coefficient, which has as many bits more as a vertex has fewer than 16.
pub(crate) struct OneProduct<const KEPT: u32, T, const WIDE: bool> {
    rows: [[i32; 3]; 3],
    offsets: [i32; 3],
    screen: Screen<WIDE>,
    vertex: core::marker::PhantomData<T>,
}

impl<const KEPT: u32, T: Copy + Into<i32>, const WIDE: bool> OneProduct<KEPT, T, WIDE> {
    #[inline(always)]
    fn quotients(&self, v: Coarse<KEPT, T>) -> Option<Quotients> {
        let v = v.integers();
        let at = |i: usize| {
            let ([a, b, c], [x, y, z]) = (self.rows[i], v);
            self.offsets[i].wrapping_add(a * x).wrapping_add(b * y).wrapping_add(c * z)
        };
        let clip = [at(0), at(1), at(2)];
        if WIDE {
            self.screen.quotients::<TwoSteps>(clip)
        } else {
            self.screen.quotients::<OneStep>(clip)
        }
    }
}

impl<const KEPT: u32, T, const WIDE: bool> Design for OneProduct<KEPT, T, WIDE>
where
    T: Copy + Into<i32>,
    Coarse<KEPT, T>: Vertex,
{
    type Vertex = Coarse<KEPT, T>;

    fn new(object: &Object) -> Option<Self> {
        let sum = |row: [f64; 3], offset: f64| {
            log2_above((sum_of(row) * Object::REACH + offset.abs()) * (1.0 + exp2(-12))) - 31
        };
        let (rows, offsets, e_xy, e_w) = rows(object, sum);
        let dropped = f64::from(1 << Coarse::<KEPT, T>::DROPPED);
        Some(Self {
            rows: rows.map(|row| row.map(|c| nearest32(c * dropped))),
            offsets: offsets.map(nearest32),
            screen: Screen::new(object, e_xy, e_w),
            vertex: core::marker::PhantomData,
        })
    }

    #[inline(always)]
    fn corner(&self, v: Coarse<KEPT, T>) -> ScreenVertex {
        self.screen.corner(self.quotients(v))
    }

    fn before_snap(&self, v: Coarse<KEPT, T>) -> [f64; 2] {
        self.screen.before_snap(self.quotients(v))
    }
}

/// Coefficients of 29 bits in pieces of 15 and 14.
pub(crate) struct TwoProducts {
    high: [[i32; 3]; 3],
    low: [[i32; 3]; 3],
    whole: [i32; 3],
    /// In 2⁻¹⁴.
    rest: [i32; 3],
    screen: Screen<false>,
}

impl TwoProducts {
    #[inline(always)]
    fn quotients(&self, v: [i16; 3]) -> Option<Quotients> {
        let [x, y, z] = v.map(i32::from);
        let at = |i: usize| {
            let dot = |start: i32, [a, b, c]: [i32; 3]| {
                start.wrapping_add(a * x).wrapping_add(b * y).wrapping_add(c * z)
            };
            dot(self.whole[i], self.high[i]).wrapping_add(dot(self.rest[i], self.low[i]) >> 14)
        };
        self.screen.quotients::<Interpolated>([at(0), at(1), at(2)])
    }
}

impl Design for TwoProducts {
    type Vertex = [i16; 3];

    fn new(object: &Object) -> Option<Self> {
        let (rows, offsets, e_xy, e_w) = rows(object, exponent);
        let rows = rows.map(|row| row.map(|c| nearest32(c * 16384.0)));
        let offsets = offsets.map(|c| nearest(c * 16384.0));
        let low = rows.map(|row| row.map(|c| (c << 18) >> 18));
        Some(Self {
            high: [0, 1, 2].map(|i| [0, 1, 2].map(|j| (rows[i][j] - low[i][j]) >> 14)),
            low,
            whole: offsets.map(|c| (c >> 14) as i32),
            rest: offsets.map(|c| (c & 0x3fff) as i32),
            screen: Screen::new(object, e_xy, e_w),
        })
    }

    #[inline(always)]
    fn corner(&self, v: [i16; 3]) -> ScreenVertex {
        self.screen.corner(self.quotients(v))
    }

    fn before_snap(&self, v: [i16; 3]) -> [f64; 2] {
        self.screen.before_snap(self.quotients(v))
    }
}
