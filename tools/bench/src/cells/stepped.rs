//! Textures as other libraries draw them, for comparison: coordinates are divided at every pixel, or at every sixteenth of a span and
//! at its end, and are linear in between, whatever the error (the inner loop of *Quake*: Abrash, *Graphics Programming Black Book*,
//! chapter 68). All else is the library's: the same triangles, the same rows, the same loop over pixels in memory.
//!
//! `tools/measure` measures the error of this file, and `tools/bench/run cells X1 X2 X3 X4` its instructions.

use core::iter::successors;
use pinhole::clip::Barycentric;
use pinhole::raster::{Gradient, Span, Triangle};
use pinhole::{CornerValues, Shader, SpanShader, Texels};

/// Fractional bits of a coordinate's unit of 1/16 texel.
const FRACTION: u32 = 8;

/// A texture on a face, sampled at every `STEP`th pixel of a span.
#[derive(Clone, Copy)]
pub(crate) struct Stepped<S, const STEP: i32> {
    texels: S,
    /// Texture coordinates of the corners: 24 bits with the sign.
    uv: [[i32; 2]; 3],
    /// Proportional to 1/w, below 2²⁴.
    q: [i32; 3],
}

impl<S: Texels, const STEP: i32> Stepped<S, STEP> {
    /// From the coordinates of the corners in 1/16 texel.
    #[inline]
    pub(crate) fn new(texels: S, corners: [[i16; 2]; 3]) -> Self {
        Self { texels, uv: corners.map(|uv| uv.map(|c| i32::from(c) << FRACTION)), q: [1 << 23; 3] }
    }
}

impl<S: Texels, const STEP: i32> Shader for Stepped<S, STEP> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let [a, b, c] = self.uv;
        let uv = corners.map(|corner| {
            let [k, l, m] = corner.weights().map(i64::from);
            let mean = |a: i32, b: i32, c: i32| {
                let sum = k * i64::from(a) + l * i64::from(b) + m * i64::from(c); // 24 + 31 bits each
                (((sum + (1 << 29)) >> 30) as i32).clamp(a.min(b).min(c), a.max(b).max(c))
            };
            [mean(a[0], b[0], c[0]), mean(a[1], b[1], c[1])]
        });
        Self { uv, ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { q: corners.inverse_w().map(|q| (q >> 7).max(1)), ..*self }
    }
}

/// u − u₀ and v − v₀ times q, and q, which are linear on the screen.
#[derive(Clone, Copy)]
pub(crate) struct Planes<S> {
    texels: S,
    q: Gradient,
    st: [Gradient; 2],
    /// The coordinates of the corner with the least of each, in 2⁻³² of the sides.
    origin: [u32; 2],
    /// The left shift from (u − u₀) in 2⁻³¹ of a power of two that holds its range to 2⁻³² of the side; a right shift below 0.
    shift: [i32; 2],
}

/// s/q and t/q in 2⁻³¹, by one division of 32 bits: the reciprocal has 16 bits.
#[inline(always)]
fn divided(q: u32, st: [u32; 2]) -> [i32; 2] {
    let q = q | 1;
    let zeros = q.leading_zeros();
    let reciprocal = 0x7fff_ffff / ((q << zeros) >> 16); // the divisor is 2¹⁵ or more
    st.map(|s| {
        // s/q is below 1, and what is rounded off or lies beside the triangle is cut.
        ((u64::from(s.min(q) << zeros) * u64::from(reciprocal)) >> 16).min(0x7fff_ffff) as i32
    })
}

impl<S> Planes<S> {
    /// (u − u₀) and (v − v₀) at a pixel.
    #[inline(always)]
    fn sample(&self, x: i32, y: i32) -> [i32; 2] {
        let [s, t] = &self.st;
        divided(self.q.at(x, y), [s.at(x, y), t.at(x, y)])
    }

    #[inline(always)]
    fn coordinate(&self, axis: usize, sample: i32) -> u32 {
        let shift = self.shift[axis & 1];
        let moved =
            if shift < 0 { (sample >> (-shift & 31)) as u32 } else { (sample as u32) << (shift & 31) };
        self.origin[axis & 1].wrapping_add(moved)
    }

    #[inline(always)]
    fn coordinates(&self, [u, v]: [i32; 2]) -> [u32; 2] {
        [self.coordinate(0, u), self.coordinate(1, v)]
    }
}

impl<S: Texels, const STEP: i32> SpanShader<S::Color> for Stepped<S, STEP> {
    type Setup = Planes<S>;

    fn set_up(&self, triangle: &Triangle<'_>) -> Planes<S> {
        let sides = self.texels.size_bits();
        let [(u, u_origin, u_shift), (v, v_origin, v_shift)] = [0, 1].map(|axis: usize| {
            let values = self.uv.map(|uv| uv[axis & 1]);
            let least = values[0].min(values[1]).min(values[2]);
            let range = (values[0].max(values[1]).max(values[2]) - least) as u32; // below 2²⁴
            let bits = 32 - range.leading_zeros(); // 0 … 24
            let over_w = |i: usize| {
                let product = u64::from((values[i % 3] - least) as u32) * u64::from(self.q[i % 3] as u32);
                (product >> bits) as u32 // below q
            };
            // One of 1/16 texel is 2^(28 − side) of 2⁻³² of the side.
            let unit = 28 - sides[axis & 1] as i32 - FRACTION as i32;
            let gradient = triangle.gradient([over_w(0), over_w(1), over_w(2)]);
            (gradient, (least as u32) << unit, bits as i32 - 31 + unit)
        });
        let q = triangle.gradient(self.q.map(|q| q as u32));
        Planes { texels: self.texels, q, st: [u, v], origin: [u_origin, v_origin], shift: [u_shift, v_shift] }
    }

    fn span(setup: &Planes<S>, span: Span) -> impl Iterator<Item = S::Color> {
        Self::runs(setup, span).flat_map(|(width, colors)| colors.take(width as usize))
    }

    #[inline(always)]
    fn runs(setup: &Planes<S>, span: Span) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Color>)> {
        let last = span.x + span.width - 1;
        // With a division for each pixel, a span is one run.
        let reach = if STEP > 1 { STEP } else { last + 1 - span.x };
        let sample = move |x: i32| (x, setup.sample(x, span.y));
        // The begin of a run, and that of the next; at the end of the span the next is its last pixel.
        let run = move |from: (i32, [i32; 2])| {
            (from, if STEP > 1 { sample((from.0 + STEP).min(last)) } else { from })
        };
        let runs = successors(Some(run(sample(span.x))), move |&(from, to)| {
            (from.0 + reach <= last).then(|| run(to))
        });
        runs.map(move |((x, from), (to, end))| {
            let width = reach.min(last + 1 - x);
            let texels = setup.texels;
            let mut at = setup.coordinates(from);
            let pixels = to - x; // 0 … STEP
            let step = [0, 1].map(|axis: usize| {
                let apart = end[axis & 1] - from[axis & 1];
                let each = if STEP > 1 && pixels == STEP { apart / STEP } else { apart / pixels.max(1) };
                setup.coordinate(axis, each).wrapping_sub(setup.origin[axis & 1])
            });
            let [s, t] = &setup.st;
            let (mut planes, steps) = (
                [setup.q.at(x, span.y), s.at(x, span.y), t.at(x, span.y)],
                [setup.q.step(), s.step(), t.step()],
            );
            let colors = core::iter::repeat_with(move || {
                if STEP > 1 {
                    let [u, v] = at;
                    at = [u.wrapping_add(step[0]), v.wrapping_add(step[1])];
                    return texels.texel(u, v);
                }
                let [q, s, t] = planes;
                planes = [q.wrapping_add(steps[0]), s.wrapping_add(steps[1]), t.wrapping_add(steps[2])];
                let [u, v] = setup.coordinates(divided(q, [s, t]));
                texels.texel(u, v)
            });
            (width, colors)
        })
    }
}
