//! A light at a point, which fades out at its range.

use super::normal_space::{dot_words, NormalSpace};
use crate::math::num::{divide, evaluate, mul_high, mul_wide, reciprocal, sqrt, sqrt_word, transposed};
use crate::math::row::block_scaled;
use crate::math::unit::normalise;
use crate::math::unrolled::map3;
use crate::math::{Affine, Point3, Scalar};
use crate::space::{Model, World};

/// A light at a point of the world, set up for one object: it lights vertices and faces by their position and normal, and
/// nothing beyond its range. Not a [`Light`](crate::light::Light), which needs no position.
///
/// At distance r of a position to the light, with unit normal n and unit vector l towards the light, a level is `strength ·
/// max(0, n·l) · (1 − r²/range²)²`, and 0 beyond the range: light falls to nothing at the range, without an edge. (Akenine-Möller
/// et al., *Real-Time Rendering*, 4th ed., section 5.2.2, windowing functions.) A point light has no ambient part: add its level
/// to the level of a [`Lambert`](crate::light::Lambert) or of [`Lights`](crate::light::Lights). Sums may exceed 256: shaders count more than
/// 256 as 256.
///
/// **Error.** A level is within 5/8 + κ·2⁻²² + 2⁻¹⁵·range/r of the exact one for objects at most 64 times as large as the range,
/// where κ is the largest scale factor of the model transform divided by its smallest. At the light's own position the level is
/// 0, because no direction leads to it.
///
/// ```
/// use pinhole::{light::PointLight, prelude::*};
/// // A mesh in steps of 2⁻⁴ world units, and a lamp 2 above its origin that reaches 4 units far.
/// let (model, lamp) = (Affine::<Model, World>::identity(), Point3::from_ints(0, 2, 0));
/// let light = PointLight::new(&model, -4, lamp, Scalar::from_int(4), 256);
/// let up = [0, 32767, 0];
/// assert_eq!(light.level([0, 0, 0], up), 144); // (1 − ¼)² of 256
/// assert_eq!(light.level([0, 16, 0], up), 225); // one unit nearer: (1 − 1/16)²
/// assert_eq!(light.level([16 * 4, 0, 0], up), 0); // beyond its range
/// assert_eq!(light.level([0, 0, 0], [0, -32767, 0]), 0); // turned away
/// // With another light, the sum of both, at most 256:
/// let sun = Lambert::new(&model, Vector3::from_ints(1, 0, 0), 40)?;
/// assert_eq!((sun.level(up) + light.level([0, 0, 0], up)).min(256), 184);
/// # Ok::<(), pinhole::light::LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PointLight {
    space: NormalSpace,
    /// The light's position minus that of the mesh's origin, in the space of normals, in 2⁻²⁴ of the range.
    position: [i64; 3],
    /// One unit of the mesh along each axis, in 2⁻²⁴ of the range times 2^`shift`: 30 bits. If the model transform is conformal, the
    /// first number is the length of each.
    steps: [[i32; 3]; 3],
    /// The right shift from `steps` times a coordinate to 2⁻²⁴ of the range: 0 … 62.
    shift: u32,
    /// 0 … 256.
    strength: u16,
}

/// The range in units of [`PointLight`]'s positions.
const RANGE: i64 = 1 << 24;

impl PointLight {
    /// Sets up the light on an object with the transform `model` and a mesh whose vertices are in 2^`exponent` model units, as
    /// [`Mesh::exponent`](crate::Mesh::exponent) says. `position` is in world units, and so is `range`: one of zero or less
    /// lights nothing. `strength` is the level right before the light: 0 … 256, more counts as 256.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(
        model: &Affine<Model, World>,
        exponent: i8,
        position: Point3<World>,
        range: Scalar,
        strength: u16,
    ) -> Self {
        let space = NormalSpace::new(model);
        let (rows, row_exponent) = model.linear();
        // The range in 2⁻¹⁶; at least 1, so that a light without a range can be set up, too.
        let (lights, range) = (range > Scalar::ZERO, range.to_bits().max(1) as u32);
        // From the origin of the mesh to the light: in 2⁻³² world units, at most 2⁶².
        let away = model.offset_from(&position.bits().map(|c| i64::from(c) << 16)).map(|c| -c);
        // In 2⁻²⁴ of the range. Clamped to 2²¹ world units, which is beyond every range.
        let mut position = away.map(|c| divided(c.clamp(-(1 << 53), 1 << 53) << 8, range));
        let mut steps = [[0; 3]; 3];
        let scaled; // the exponent of the steps in 2⁻²⁴ of the range
        let unit_exponent = row_exponent + i32::from(exponent) - 20;
        if space.conformal {
            // The rows of a rotation times one factor: its transpose turns to model space.
            let [a, ..] = rows;
            let square: u64 = a.iter().map(|&c| mul_wide(c, c) as u64).sum(); // ≤ 3·2⁶⁰
            let length = i64::from(sqrt(square)); // ≤ 2³⁰·⁸
            let turned = transposed(&rows.map(|row| normalise(&row.map(i64::from))));
            position = turned.map(|row| evaluate(&row, 0, &position, 0));
            let step = [divided(length << 30, range)];
            scaled = block_scaled(&step, unit_exponent, steps.as_flattened_mut());
        } else {
            let step = rows.map(|row| row.map(|c| divided(i64::from(c) << 30, range)));
            scaled = block_scaled(step.as_flattened(), unit_exponent, steps.as_flattened_mut());
        }
        // More than 2³⁰ in 2⁻²⁴: one step of the mesh is longer than 64 ranges.
        let lights = lights && scaled <= 0;
        Self {
            space,
            position,
            steps,
            shift: (-scaled).clamp(0, 62) as u32,
            strength: if lights { strength.min(256) } else { 0 },
        }
    }

    /// The light level, 0 … 256, of a vertex, or of a face around this point, with this unit normal (model space, in 2⁻¹⁵).
    /// `position` is in the mesh's units, as [`Mesh::vertices`](crate::Mesh::vertices) has them. The [type](Self) has the formula and the error.
    pub fn level(&self, position: [i16; 3], normal: [i16; 3]) -> u16 {
        let p = map3(position, i32::from);
        let [x, y, z] = if self.space.conformal {
            let [[step, ..], ..] = self.steps;
            map3(p, |c| mul_wide(step, c)) // below 2⁴⁶
        } else {
            self.stretched(p)
        };
        let [a, b, c] = self.position;
        let half = (1i64 << self.shift) >> 1;
        // |position| ≤ 2⁶² and products are below 2⁴⁸: neither the sums nor the differences wrap.
        let [x, y, z] = [
            a.wrapping_sub((x + half) >> self.shift),
            b.wrapping_sub((y + half) >> self.shift),
            c.wrapping_sub((z + half) >> self.shift),
        ];
        let is_near = |c: i64| c > -RANGE && c < RANGE;
        if !(is_near(x) && is_near(y) && is_near(z)) {
            return 0;
        }
        // Below `RANGE`: 25 bits with the sign.
        self.level_from([x as i32, y as i32, z as i32], self.space.normal(normal))
    }

    /// A vertex relative to the mesh's origin, times 2^shift: below 2³⁰ · 2¹⁵ · 3.
    #[cold]
    #[inline(never)]
    fn stretched(&self, [a, b, c]: [i32; 3]) -> [i64; 3] {
        map3(self.steps, |[x, y, z]| mul_wide(x, a) + mul_wide(y, b) + mul_wide(z, c))
    }

    /// The level with the light at `towards`, in 2⁻²⁴ of the range, less than that along each axis.
    fn level_from(&self, towards: [i32; 3], normal: [i16; 3]) -> u16 {
        let [x, y, z] = towards;
        let bits = (x.unsigned_abs() | y.unsigned_abs() | z.unsigned_abs()) | 1;
        // 0 … 23: the largest component has 24 bits.
        let up = bits.leading_zeros() - 8;
        // 15 bits and the sign, rounded; 2¹⁵ itself becomes less by one.
        let near = map3(towards, |c| (((c << up) + (1 << 8)) >> 9).min(32_767) as i16);
        // At most 3·2³⁰.
        let square = near.iter().map(|&c| (i32::from(c) * i32::from(c)) as u32).sum::<u32>();
        // r² in 2⁻¹⁶ of the range's square: `square` is in 2^(−30 − 2·up) of it.
        let down = 14 + 2 * up; // 14 … 60
        let ratio = square.checked_shr(down).unwrap_or(0);
        let cosine = dot_words(normal, near); // times |near|, in 2⁻³⁰: below 2³¹
        if ratio >= 1 << 16 || cosine <= 0 {
            return 0;
        }
        // |near| is 2¹⁴ … 2¹⁵·⁸, not 0: the cosine is positive.
        let root = reciprocal(sqrt_word(square) as i32);
        // cosine/|near| in 2⁻¹⁵: the reciprocal is mantissa · 2^(shift − 61), with a shift of 15 or 16.
        let cosine = mul_high(cosine, root.mantissa) >> (29u32.wrapping_sub(root.shift) & 31);
        let rest = ((1 << 16) - ratio).min(0xffff);
        let fade = (rest * rest) >> 16; // in 2⁻¹⁶, below 1
        let part = ((cosine as u32).min(1 << 15) * fade) >> 15; // in 2⁻¹⁶
        ((part * u32::from(self.strength) + (1 << 15)) >> 16) as u16
    }
}

/// `n / d`, rounded to nearest, for |n| ≤ 2⁶¹ and d ≥ 1.
#[inline(never)] // set-up: code size counts
fn divided(n: i64, d: u32) -> i64 {
    let (quotient, _) = divide(n.unsigned_abs() + u64::from(d / 2), d);
    let quotient = quotient as i64; // at most 2⁶¹
    if n < 0 {
        quotient.wrapping_neg()
    } else {
        quotient
    }
}
