//! The library's number design in a bare loop: i16 vertices, rows of 30 bits with one exponent per object, the focal length
//! folded in, the eye subtracted first, high words, one reciprocal. Its forms are the library's; the way to divide is a
//! parameter.

use crate::chain::{Design, ScreenVertex};
use crate::divide::Divide;
use crate::form::{exponent, lifted, Form};
use crate::num::{exp2, nearest32, within};
use crate::Object;
use core::marker::PhantomData;

pub(crate) struct Thirty<D, const BITS: u32> {
    x: Form,
    y: Form,
    w: Form,
    /// The smallest w that is drawn.
    near: i32,
    /// |x|, |y| < w >> narrow lie within 1024 px of the centre.
    narrow: u32,
    /// x/w · 2^beyond is in pixels.
    beyond: i32,
    divide: PhantomData<D>,
}

impl<D: Divide, const BITS: u32> Thirty<D, BITS> {
    #[inline(always)]
    fn clip(&self, v: [i16; 3]) -> [i32; 3] {
        let v = lifted(v);
        [self.x.at(v), self.y.at(v), self.w.at(v)]
    }
}

impl<D: Divide, const S: u32> Design for Thirty<D, S> {
    type Vertex = [i16; 3];
    const BITS: u32 = S;

    fn new(object: &Object) -> Option<Self> {
        let ([x, y, w], [ox, oy, ow]) = (object.linear(), object.offset());
        let focal = object.focal;
        let (x, y, ox, oy) = (x.map(|c| c * focal), y.map(|c| c * focal), ox * focal, oy * focal);
        let e_w = exponent(w, ow);
        let e_xy = exponent(x, ox).max(exponent(y, oy)).max(e_w + object.half_picture());
        let beyond = e_xy - e_w;
        // The right shift of `along` is 29 − beyond − S − n ≥ 1.
        let zeros = 28 - beyond - S as i32;
        Some(Self {
            x: Form::new(x, ox, e_xy),
            y: Form::new(y, oy, e_xy),
            w: Form::new(w, ow, e_w),
            near: nearest32(object.near * exp2(-e_w)).max(1 << (30 - zeros.clamp(0, 15))),
            narrow: (beyond - 10).max(0) as u32,
            beyond,
            divide: PhantomData,
        })
    }

    #[inline(always)]
    fn corner(&self, v: [i16; 3]) -> ScreenVertex {
        let [x, y, w] = self.clip(v);
        let limit = w >> (self.narrow & 31);
        if w < self.near || !within(x, limit) || !within(y, limit) {
            return ScreenVertex::EMPTY;
        }
        let (by, n) = D::by(w);
        let right = (28 - self.beyond - S as i32 - n as i32) & 31; // by `near`
        let along = |v| ((D::high(v, by) >> right) + 1) >> 1;
        ScreenVertex { x: along(x), y: along(y) }
    }

    fn before_snap(&self, v: [i16; 3]) -> [f64; 2] {
        let [x, y, w] = self.clip(v);
        let (by, n) = D::by(w);
        [x, y].map(|v| D::before(v, by) * exp2(self.beyond + n as i32 - 29))
    }
}
