//! Depth, or a channel of colour, over a triangle: the plane through its corners' values, stepped in
//! 32 bits.
//!
//! At the centre of a covered pixel the plane lies between the values of the corners, so only its value
//! modulo 2²⁴ units has to be carried: all sums here wrap, and no gradient is too steep.
//!
//! With corners a, b, c and differences from a, the plane climbs by
//!
//! ```text
//!     ∂z/∂x = (dz₁·dy₂ − dz₂·dy₁) / den,   ∂z/∂y = (dx₁·dz₂ − dx₂·dz₁) / den,   den = dx₁·dy₂ − dx₂·dy₁
//! ```
//!
//! (Pineda, *A parallel algorithm for polygon rasterization*, 1988, section 3.4.)

use super::{ScreenPoint, Triangle};
use crate::math::num::{leading_zeros, mul_high, mul_wide, reciprocal_of_positive};
use core::hint::black_box;

/// What varies linearly over a triangle on the screen, for the centres of the pixels that it covers:
/// depth, or a channel of colour. Values are 24 bits at the corners, 32 bits at the pixels: in 2⁻⁸ of the corners' unit.
/// [`SpanShader`](crate::SpanShader) has an example.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gradient {
    /// At pixel (0, 0), in 2⁻⁸ of the corners' unit, wrapping, as are the steps.
    pub(crate) origin: u32,
    pub(crate) right: u32,
    pub(crate) down: u32,
}

impl Gradient {
    /// At the centre of a covered pixel, column `x` and row `y`, in 2⁻⁸ of the corners' unit: between their
    /// values, and within `(w + h)/2 + 34 + 2¹⁰·⁶` of these units, w columns and h rows from the first corner's
    /// pixel. Elsewhere it wraps.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// From a pixel to the one below, to be added wrapping.
    #[inline(always)]
    pub(crate) fn down(&self) -> u32 {
        self.down
    }

    /// Where columns are counted from so many pixels farther left in every row than in the one above.
    #[inline(always)]
    pub(crate) fn sheared(self, by: usize) -> Self {
        Self { down: self.down.wrapping_sub(self.right.wrapping_mul(by as u32)), ..self }
    }

    /// The change from a pixel to its right neighbour, in 2⁻⁸ of the corners' unit; add it wrapping.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.right
    }
}

/// What all planes over a triangle share.
///
/// In 2⁻⁸ of the corners' unit and per pixel a plane climbs by `v · 2¹⁶ / den`, v the numerator for x or y. So
/// it does by `v·2ᵏ · mantissa >> (places + k)`: the numerators are made of differences of values times 2ᵏ, so
/// that they have 31 bits, or for most triangles of a fine mesh by a k that fits [all of them](GradientSetup::through_near), and of the
/// product only the upper word counts.
pub(crate) struct GradientSetup<'t> {
    triangle: &'t Triangle<'t>,
    /// The reciprocal of the area, with its sign turned: 2¹⁶/den = mantissa · 2^−places.
    mantissa: i32,
    /// Forced far too small beyond 512 pixels, so that the long way is taken.
    places: i32,
    extent: Extent,
    /// The area's magnitude, cut to 31 bits beyond 128 pixels.
    area: i32,
}

/// Below this many places the upper word is too little of the product.
const FLATTEST: i32 = 34;

/// How far apart the corners are.
#[derive(Clone, Copy)]
pub(crate) struct Extent(u32);

impl Extent {
    #[inline(always)]
    pub(crate) fn of(Triangle { corners: [a, b, c], .. }: &Triangle<'_>) -> Self {
        Self(magnitude(b.x - a.x) | magnitude(b.y - a.y) | magnitude(c.x - a.x) | magnitude(c.y - a.y))
    }

    /// All differences from the first corner are below 128 pixels, or 128 to one side.
    #[inline(always)]
    fn is_small(self) -> bool {
        self.0 >> 15 == 0
    }

    /// The same of 32 pixels.
    #[inline(always)]
    fn is_tiny(self) -> bool {
        self.0 >> 13 == 0
    }

    /// Whether any of them is 512 pixels or more.
    #[inline(always)]
    pub(crate) fn is_large(self) -> bool {
        self.0 >> 17 != 0
    }

    /// 32 less the bits of the largest difference between corners; −64 beyond 128 pixels.
    #[inline(always)]
    fn room(self) -> i32 {
        if self.is_small() {
            leading_zeros(self.0)
        } else {
            -64
        }
    }
}

/// The numerators times 2ᵏ, with 31 bits or less: that of y with its sign turned.
#[derive(Clone, Copy)]
struct Numerators {
    across: i32,
    against: i32,
    k: i32,
}

impl Numerators {
    #[inline(always)]
    fn new(triangle: &Triangle<'_>, room: i32, values: &[i32; 3]) -> Self {
        Self::short(triangle, room, values).unwrap_or_else(|| long(triangle, values))
    }

    /// `None` where 32 bits are too few.
    #[inline(always)]
    fn short(triangle: &Triangle<'_>, room: i32, values: &[i32; 3]) -> Option<Self> {
        let (dz1, dz2) = differences(values);
        // 2 + k: bits of the extent and of dz, and k, are 30 in all.
        let room = room + leading_zeros(magnitude(dz1) | magnitude(dz2)) - 32;
        if room < 0 {
            return None;
        }
        // Fewer than 32, as the extent is not 0.
        let scale = |dz: i32| (dz << (room & 31)) >> 2;
        // The products are at most 2³⁰, not both.
        Some(Self::times(triangle, scale(dz1), scale(dz2), room - 2))
    }

    /// Of differences times 2ᵏ.
    #[inline(always)]
    fn times(Triangle { corners: [a, b, c], .. }: &Triangle<'_>, dz1: i32, dz2: i32, k: i32) -> Self {
        Self {
            across: (dz1 * (c.y - a.y)).wrapping_add(dz2 * (b.y - a.y)),
            against: (dz1 * (c.x - a.x)).wrapping_add(dz2 * (b.x - a.x)),
            k,
        }
    }
}

/// From the first value to the second, and from the third to the first: 24 bits and the sign.
#[inline(always)]
fn differences(&[za, zb, zc]: &[i32; 3]) -> (i32, i32) {
    (zb - za, za - zc)
}

impl<'t> GradientSetup<'t> {
    /// Over a triangle.
    #[inline(always)]
    pub(crate) fn new(triangle: &'t Triangle<'t>) -> Self {
        Self::of_extent(triangle, Extent::of(triangle))
    }

    /// The same, given its extent.
    #[inline(always)]
    pub(crate) fn of_extent(triangle: &'t Triangle<'t>, extent: Extent) -> Self {
        let turn = (triangle.area >> 63) as i32;
        // |area| < 2·2³⁰ within 128 pixels: not all differences are to the side of the 128 that they may be.
        let (area, cut) = match extent.is_small() {
            true => ((triangle.area as i32 ^ turn).wrapping_sub(turn), 0),
            false => large(triangle, extent),
        };
        debug_assert!(area > 0, "{triangle:?}");
        let r = reciprocal_of_positive(area); // 1/area = mantissa · 2^(shift − 61)
        Self {
            triangle,
            mantissa: (r.mantissa ^ !turn).wrapping_sub(!turn),
            places: 61 - 16 - r.shift as i32 + cut,
            extent,
            area,
        }
    }

    /// Through values 0 … 2²⁴ − 1 at the corners.
    ///
    /// **Error.** In 2⁻⁸ of the corners' unit, a pixel w columns and h rows from the corner's pixel, and
    /// not more than they span from it, is off by less than `(w + h)·½` for the rounding of the steps, 34
    /// for that of the origin, and, but for slivers and beyond 512 pixels, 2¹⁰·⁶ for what follows.
    ///
    /// No step is larger than 2²⁸. Within 128 pixels the reciprocal is off by 2⁻²⁸ of itself: 2⁸ at most.
    /// Differences of values may lose two bits, which is as if corners had been up to 4 units lower: 2¹⁰.
    /// Within 512 pixels area and numerator are cut to 31 bits, by 2⁻³⁰ each, in all less than 2⁻²⁷·⁴ of
    /// the step: 2⁹·⁶ for x and for y.
    // Part of its caller where there is but one.
    pub(crate) fn through(&self, values: &[i32; 3]) -> Gradient {
        let numerators = Numerators::new(self.triangle, self.extent.room(), values);
        match self.slope(&numerators, values) {
            Some(slope) => slope.plane(),
            // A copy, so that the fast way has it in registers.
            None => Self { ..*self }.steep(values, &numerators),
        }
    }

    /// Over a triangle within 32 pixels.
    #[inline(always)]
    pub(crate) fn tiny(triangle: &'t Triangle<'t>, extent: Extent) -> Option<Self> {
        extent.is_tiny().then(|| Self::of_extent(triangle, extent))
    }

    /// Over a triangle within 128 pixels.
    #[inline(always)]
    pub(crate) fn small(triangle: &'t Triangle<'t>, extent: Extent) -> Option<Self> {
        extent.is_small().then(|| Self::of_extent(triangle, extent))
    }

    /// [`through`](Self::through), with the same error, for most triangles of a fine mesh: [tiny](Self::tiny), not thin, and
    /// with values less than 2¹⁹ apart. It need not ask how large the numbers are. `None` for all others.
    ///
    /// With E the largest difference between corners and |den| ≥ 32·(E + 1), no step reaches 2³¹. **Error.** Differences of
    /// values lose two bits, up to 3 units, 768 for the plane. A step is rounded down to a multiple of 2^more < 2²⁰/|den|, or
    /// to a whole one, for (E + 1)/256 pixels each way: 2⁸, or w + h, which is at most 64. That to the centre takes steps less
    /// 8 bits: 2⁸. And 1 is the reciprocal's: 1281 in all, which is less than 2¹⁰·⁶.
    #[inline(always)]
    pub(crate) fn through_near(&self, values: &[i32; 3]) -> Option<Gradient> {
        debug_assert!(self.extent.is_tiny());
        let (dz1, dz2) = differences(values);
        let bits = magnitude(dz1) | magnitude(dz2);
        // Four less than 2¹⁹, so that a quarter of any is less than 2¹⁷.
        let are_near = (bits + 4) >> 19 == 0;
        if !are_near || (self.area >> 5) as u32 <= self.extent.0 {
            return None;
        }
        // Products below 2³⁰: both are less than 2³¹.
        let Numerators { across, against, k } = Numerators::times(self.triangle, dz1 >> 2, dz2 >> 2, -2);
        let (across, along) = (mul_high(across, self.mantissa), mul_high(-against, self.mantissa));
        let more = 32 - (self.places + k); // −7 … 10, as 2⁹ ≤ |den| < 2²⁷
        let (right, down) = match more >= 0 {
            true => (across << (more & 31), along << (more & 31)),
            false => (across >> (-more & 31), along >> (-more & 31)),
        };
        let [value, ..] = values;
        let [a, ..] = &self.triangle.corners;
        let at = (right >> 8) * to_centre(a.x) + (down >> 8) * to_centre(a.y); // two products of 2³⁰
        Some(Slope::new(a, (value << 8).wrapping_add(at), right, down).plane())
    }

    /// [`through`](Self::through) where 32 bits are enough and nothing is lost of the differences: then a pixel is off by less
    /// than `(w + h)·½ + 35`. `None` for all others.
    #[inline(always)]
    pub(crate) fn exact(&self, values: &[i32; 3]) -> Option<Gradient> {
        let numerators = Numerators::short(self.triangle, self.extent.room(), values).filter(|n| n.k >= 0)?;
        Some(self.slope(&numerators, values)?.plane())
    }

    /// The same as a slope, with the same error; `None` where it is too steep.
    #[inline(always)]
    pub(crate) fn slope_through(&self, values: &[i32; 3]) -> Option<Slope> {
        self.slope(&Numerators::new(self.triangle, self.extent.room(), values), values)
    }

    #[inline(always)]
    fn slope(&self, Numerators { across, against, k }: &Numerators, [value, ..]: &[i32; 3]) -> Option<Slope> {
        let Triangle { corners: [a, ..], .. } = self.triangle;
        let places = self.places + k;
        if places < FLATTEST {
            return None;
        }
        // The upper word and the rest of the places, to nearest. There are 60 at most.
        let step = |v: i32, by: i32| ((mul_high(v, by) >> ((places - 33) & 31)) + 1) >> 1;
        let (right, down) = (step(*across, self.mantissa), step(*against, -self.mantissa)); // ≤ 2²⁸

        let at = ((right >> 5) * to_centre(a.x) + (down >> 5) * to_centre(a.y)) >> 3; // two products of 2³⁰
        Some(Slope::new(a, (value << 8).wrapping_add(at), right, down))
    }

    /// Where steps are large, from a pixel near those that are asked for: the error grows with the way. Not
    /// nearer than the viewport, so that every band computes the same.
    #[cold]
    #[inline(never)]
    fn steep(&self, values: &[i32; 3], &Numerators { across, against, k }: &Numerators) -> Gradient {
        let places = self.places + k;
        let Triangle { corners, area, viewport } = self.triangle;
        let [a, ..] = corners;
        let column = (a.x >> 8).clamp(viewport.left, viewport.right.max(viewport.left));
        let row = (a.y >> 8).clamp(viewport.top, viewport.bottom.max(viewport.top));
        // Per sub-pixel: 24 bits of the values, and 40 more. The products lie below 2⁶²: a step is at most
        // 2^(62 − places), and 2⁻²⁸ of it times the extent, 2^(24 − room) pixels, less than 2⁹ for x and for y.
        let (across, along) = if places >= 49 - self.extent.room() && places >= 24 {
            let by_reciprocal = |v: i32| mul_wide(v, self.mantissa) >> ((places - 24) & 63);
            (by_reciprocal(across), -by_reciprocal(against))
        } else {
            // Turned so that they go with den's magnitude.
            let turn = |dz: i32| if *area < 0 { dz } else { -dz };
            let (dz1, dz2) = differences(values);
            let (across, against) = wide(corners, turn(dz1), turn(dz2));
            (quotient(across, area.unsigned_abs()), quotient(-against, area.unsigned_abs()))
        };
        // To that pixel's centre: up to 2²³ sub-pixels.
        let (x, y) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let [value, ..] = *values;
        let at = ((value as u64) << 40)
            .wrapping_add((across as u64).wrapping_mul(i64::from(x) as u64))
            .wrapping_add((along as u64).wrapping_mul(i64::from(y) as u64));
        // A pixel is 256 sub-pixels; from 24.40 to 24.8, to nearest.
        let step = |g: i64| (g.wrapping_add(1 << 23) >> 24) as i32;
        Slope { at: (at >> 32) as i32, right: step(across), down: step(along), pixel: (column, row) }.plane()
    }
}

/// A plane by its value at one pixel, and its steps.
#[derive(Clone, Copy)]
pub(crate) struct Slope {
    /// In 2⁻⁸ of the corners' unit, as are the steps. But for those [`through_near`](GradientSetup::through_near) it is not wrapped,
    /// less than 2²⁹ from the corner's value.
    at: i32,
    right: i32,
    down: i32,
    pixel: (i32, i32),
}

/// To the centre of the pixel: 128 sub-pixels at most.
#[inline(always)]
fn to_centre(p: i32) -> i32 {
    128 - (p & 255)
}

impl Slope {
    /// From the pixel of a corner.
    #[inline(always)]
    fn new(corner: &ScreenPoint, at: i32, right: i32, down: i32) -> Self {
        Self { at, right, down, pixel: (corner.x >> 8, corner.y >> 8) }
    }

    #[inline(always)]
    pub(crate) fn plane(&self) -> Gradient {
        let Self { at, right, down, pixel: (column, row) } = *self;
        let origin = at.wrapping_sub(right.wrapping_mul(column)).wrapping_sub(down.wrapping_mul(row));
        Gradient { origin: origin as u32, right: right as u32, down: down as u32 }
    }

    /// The plane of values `factor / 2^cut` times as large, modulo 2³²; for values up to 2²²·⁵ at the corners, factors below
    /// 2¹⁶ and cuts from 1 to 16. The value at the corner's pixel and the steps are rounded down.
    #[inline(always)]
    pub(crate) fn times(&self, factor: i32, cut: u32) -> Gradient {
        let times = |v: i32| {
            // In two products: |high| ≤ 2¹⁵, 0 ≤ low < 2¹⁶.
            let (high, low) = (v >> 16, v & 0xffff);
            let low = (low as u32).wrapping_mul(factor as u32) >> cut;
            (high * factor).wrapping_shl(16 - cut).wrapping_add(low as i32)
        };
        Self { at: times(self.at), right: times(self.right), down: times(self.down), ..*self }.plane()
    }
}

/// Has the bits of v without its sign: |v| or |v| − 1.
#[inline(always)]
fn magnitude(v: i32) -> u32 {
    (v ^ (v >> 31)) as u32
}

/// The magnitude of an area beyond 128 pixels cut to 31 bits, and by how many; beyond 512 pixels by so many
/// that no plane is flat enough.
#[inline(never)]
fn large(triangle: &Triangle<'_>, extent: Extent) -> (i32, i32) {
    let area = triangle.area.unsigned_abs();
    let cut = (33 - area.leading_zeros() as i32).max(0); // ≤ 15
    ((area >> (cut & 31)) as i32, if extent.is_large() { -64 } else { cut })
}

/// Both numerators without loss, that of y with its sign turned.
#[inline(never)] // on a Cortex-M0 its products are long
fn wide([a, b, c]: &[ScreenPoint; 3], dz1: i32, dz2: i32) -> (i64, i64) {
    // |dx|, |dy| ≤ 2²², |dz| < 2²⁴: below 2⁴⁷ each.
    let across = mul_wide(dz1, c.y - a.y) + mul_wide(dz2, b.y - a.y);
    let against = mul_wide(dz1, c.x - a.x) + mul_wide(dz2, b.x - a.x);
    (across, against)
}

/// Cut to 31 bits.
#[inline(never)]
fn long(triangle: &Triangle<'_>, values: &[i32; 3]) -> Numerators {
    let (dz1, dz2) = differences(values);
    let (across, against) = wide(&triangle.corners, dz1, dz2);
    let high = |v: i64| (v ^ (v >> 63)) as u64;
    let cut = (33 - (high(across) | high(against)).leading_zeros() as i32).max(0); // ≤ 16
    let shift = cut & 31;
    Numerators { across: (across >> shift) as i32, against: (against >> shift) as i32, k: -cut }
}

/// `⌊v · 2⁴⁰ / area⌋` modulo 2⁶⁴ for |v| < 2⁴⁷ and 0 < area < 2⁴⁶, by long division: 87 steps, for
/// slivers and for triangles beyond 512 pixels.
#[cold]
#[inline(never)]
fn quotient(v: i64, area: u64) -> i64 {
    let mut digits = v.unsigned_abs() << 17;
    let (mut quotient, mut rest) = (0u64, 0u64);
    for _ in 0..87 {
        black_box(()); // not unrolled
        rest = (rest << 1) | (digits >> 63); // rest < 2·area
        (digits, quotient) = (digits << 1, quotient << 1);
        if rest >= area {
            rest = rest.wrapping_sub(area);
            quotient |= 1;
        }
    }
    let quotient = quotient as i64;
    if v < 0 {
        quotient.wrapping_neg().wrapping_sub(i64::from(rest > 0))
    } else {
        quotient
    }
}
