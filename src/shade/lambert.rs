//! Ambient and Lambert light per face.

use crate::math::num::{fraction, row_times, scale, sqrt};
use crate::math::unit::normalise;
use crate::math::{block, Affine, Vector3};
use crate::space::{Model, World};

/// One directional light and an ambient part, made ready for one object.
///
/// Normals go through the inverse transpose of the model transform. Where that is a rotation with
/// an even scale, the light is brought to the model instead, and a face costs three products.
/// (Lambert's law: Foley et al., *Computer Graphics*, 2nd ed., section 16.1; normals: section 5.6.)
///
/// ```
/// use pinhole::{space::{Model, World}, Affine, Lambert, LightError, Vector3};
/// let model = Affine::<Model, World>::identity();
/// let light = Lambert::new(&model, Vector3::from_ints(0, 0, 9), 64)?;
/// assert_eq!(light.level([0, 0, 32767]), 256); // faces the light
/// assert_eq!(light.level([32767, 0, 0]), 64); // grazed: ambient only
/// assert_eq!(Lambert::new(&model, Vector3::from_ints(0, 0, 0), 64), Err(LightError::ZeroDirection));
/// # Ok::<(), LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lambert {
    /// Towards the light, a unit vector in 2⁻¹⁵: of the model when the transform keeps angles, of
    /// the world otherwise.
    towards: [i16; 3],
    /// The normal transform in 2⁻¹⁴ of its largest coefficient, where it bends angles.
    bend: Option<[[i16; 3]; 3]>,
    ambient: u16,
}

/// Why there is no light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LightError {
    /// The direction towards the light has length zero: give any vector towards it.
    ZeroDirection,
}

impl core::fmt::Display for LightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the direction towards the light has length zero")
    }
}

impl core::error::Error for LightError {}

impl Lambert {
    /// Light from the direction `towards_light` (any length) on an object placed by `model`;
    /// `ambient`/256 of full light everywhere, at most 256.
    ///
    /// # Errors
    ///
    /// [`LightError::ZeroDirection`].
    pub fn new(
        model: &Affine<Model, World>,
        towards_light: Vector3<World>,
        ambient: u16,
    ) -> Result<Self, LightError> {
        let light = normalise(towards_light.bits().map(i64::from)).ok_or(LightError::ZeroDirection)?;
        let normals = cofactors(model.linear().0);
        // n·(Cᵀ·l) = (C·n)·l.
        let in_model = normalise(row_times(light, &normals)).unwrap_or([0; 3]);
        let even = keeps_angles(&normals);
        // 2⁻³⁰ to 2⁻¹⁵; +1 becomes 32767.
        let short = |v: [i32; 3]| v.map(|c| ((c + (1 << 14)) >> 15).min(32_767) as i16);
        // 30 bits to 14.
        let bend = normals.map(|row| row.map(|c| ((c + (1 << 15)) >> 16) as i16));
        Ok(Self {
            towards: short(if even { in_model } else { light }),
            bend: (!even).then_some(bend),
            ambient: ambient.min(256),
        })
    }

    /// The light on a face with this unit normal (model space, 2⁻¹⁵), 0 … 256: within 1 of
    /// `ambient + (256 − ambient) · max(0, cos)`.
    pub fn level(&self, normal: [i16; 3]) -> u16 {
        let normal = normal.map(i32::from);
        let cosine = match &self.bend {
            // |n|·|l| ≤ √3·2¹⁵ · 2¹⁵ bounds every partial sum below 2³¹.
            None => dot(normal, self.towards.map(i32::from)) >> 15,
            Some(bend) => self.bent(normal, bend),
        };
        let cosine = cosine.clamp(0, 1 << 15) as u32;
        let rest = u32::from(256 - self.ambient.min(256)); // ≤ 2⁸
        self.ambient + ((rest * cosine + (1 << 14)) >> 15) as u16
    }

    /// The cosine in 2⁻¹⁵ under a transform that bends angles.
    fn bent(&self, normal: [i32; 3], bend: &[[i16; 3]; 3]) -> i32 {
        // Coefficients ≤ 2¹⁴: sums below 3·2²⁹.
        let n = bend.map(|row| i64::from(dot(row.map(i32::from), normal)));
        let square = n.iter().map(|c| c.unsigned_abs().pow(2)).sum(); // < 3·2⁶¹·²
        let length = u64::from(sqrt(square)).max(1);
        let along: i64 = n.iter().zip(self.towards).map(|(&c, l)| c * i64::from(l)).sum(); // < 2⁴⁸
        if along <= 0 {
            return 0;
        }
        fraction(along.unsigned_abs(), length << 15, 15) as i32
    }
}

fn dot([a, b, c]: [i32; 3], [x, y, z]: [i32; 3]) -> i32 {
    a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z))
}

/// det(A)·A⁻ᵀ, with the sign turned where A mirrors so that normals keep pointing outwards: 30
/// bits, up to a positive factor.
fn cofactors(a: &[[i32; 3]; 3]) -> [[i32; 3]; 3] {
    let [x, y, z] = a;
    let cross = |a: &[i32; 3], b: &[i32; 3]| {
        // Products of at most 2⁶⁰.
        let part = |i: usize, j: usize| i64::from(a[i]) * i64::from(b[j]) - i64::from(a[j]) * i64::from(b[i]);
        [part(1, 2), part(2, 0), part(0, 1)]
    };
    let rows = [cross(y, z), cross(z, x), cross(x, y)];
    let (rows, _) = block(rows, 0);
    let determinant: i64 = rows[0].iter().zip(x).map(|(&a, &b)| i64::from(a) * i64::from(b)).sum();
    if determinant < 0 {
        rows.map(|row| row.map(|c| -c))
    } else {
        rows
    }
}

/// Whether the rows are orthogonal and equally long, to 2⁻¹⁰: then angles err by less than a step
/// of light.
fn keeps_angles(m: &[[i32; 3]; 3]) -> bool {
    let gram = |a: &[i32; 3], b: &[i32; 3]| -> i64 {
        a.iter().zip(b).map(|(&a, &b)| scale(i64::from(a) * i64::from(b), -2)).sum()
        // ≤ 3·2⁵⁸
    };
    let [x, y, z] = m;
    let length = gram(x, x);
    let near = |value: i64, wanted: i64| (value - wanted).abs() <= length >> 10;
    near(gram(y, y), length)
        && near(gram(z, z), length)
        && near(gram(x, y), 0)
        && near(gram(x, z), 0)
        && near(gram(y, z), 0)
}
