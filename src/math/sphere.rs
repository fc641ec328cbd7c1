//! Bounding spheres.

use super::num::{mul_translation, sqrt};
use super::{Affine, Point3, Scalar};
use crate::space::{Model, World};

/// A bounding sphere of a mesh, in model coordinates; [transformed](Self::transformed), or of a scene, it is in world coordinates.
///
/// ```
/// use pinhole::{math::Sphere, Mesh, Scalar};
/// const VERTICES: [[i16; 3]; 2] = [[-3, 0, 0], [1, 0, 0]];
/// let mesh = Mesh::new(&VERTICES, 0, &[]).unwrap();
/// let sphere: Sphere = mesh.bounding_sphere();
/// assert!(sphere.radius >= Scalar::from_int(2) && sphere.radius < Scalar::from_ratio(201, 100));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sphere {
    /// The centre, in model units. World coordinates are stored in this type, too: convert a point `p` by
    /// `Point3::new(p.x(), p.y(), p.z())`.
    pub centre: Point3<Model>,
    /// The radius, in the same units. A negative radius counts as zero. `Scalar::MAX` stands for a radius beyond the range of
    /// [`Scalar`]: such a sphere is always [`Partly`](crate::camera::Visibility::Partly) visible.
    pub radius: Scalar,
}

impl Sphere {
    /// A sphere around several, all in the same coordinates: about the centre of the box around them. Its radius is at most √3
    /// times the smallest possible, rounded up by at most 7·2⁻¹⁶; `Scalar::MAX` if it does not fit [`Scalar`], or if one of the
    /// spheres has that radius. Around no spheres it is the origin, with no radius. For the objects of a scene there is
    /// [`Scene::bounding_sphere`](crate::draw::Scene::bounding_sphere).
    ///
    /// ```
    /// use pinhole::{math::Sphere, Point3, Scalar};
    /// let [left, right] = [-4, 6].map(|x| Sphere { centre: Point3::from_ints(x, 0, 0), radius: Scalar::ONE });
    /// let both = Sphere::around([left, right]); // from -5 to 7
    /// assert_eq!(both.centre, Point3::from_ints(1, 0, 0));
    /// assert!(both.radius >= Scalar::from_int(6) && both.radius < Scalar::from_ratio(6001, 1000));
    /// ```
    #[inline(never)] // set-up: code size counts
    pub fn around<I: IntoIterator<Item = Self>>(spheres: I) -> Self
    where
        I::IntoIter: Clone,
    {
        let spheres = spheres.into_iter();
        let reach = |sphere: &Self| i64::from(sphere.radius.to_bits().max(0));
        // In 2⁻¹⁶. Ends are below 2³², centres of boxes between centres of spheres: they fit 32 bits.
        let mut ends = [(i64::MAX, i64::MIN); 3];
        for sphere in spheres.clone() {
            for ((low, high), c) in ends.iter_mut().zip(sphere.centre.bits()) {
                *low = (*low).min(i64::from(c) - reach(&sphere));
                *high = (*high).max(i64::from(c) + reach(&sphere));
            }
        }
        let middle = ends.map(|(low, high)| if low <= high { (low + high) >> 1 } else { 0 });
        let mut radius = 0;
        for sphere in spheres {
            let mut square = 0u64;
            for (c, middle) in sphere.centre.bits().into_iter().zip(middle) {
                // Differences below 2³², halved: three squares below 2⁶⁴.
                square += (i64::from(c) - middle).unsigned_abs().div_ceil(2).pow(2);
            }
            // `sqrt` rounds to nearest: one more is an upper bound. The factor 2 undoes the halving.
            let distance = if square == 0 { 0 } else { 2 * (i64::from(sqrt(square)) + 1) };
            let is_endless = sphere.radius == Scalar::MAX;
            radius = radius.max(if is_endless { i64::MAX } else { distance + reach(&sphere) });
        }
        let radius = i32::try_from(radius).unwrap_or(i32::MAX);
        Self { centre: Point3::from_bits(middle.map(|c| c as i32)), radius: Scalar::from_bits(radius) }
    }

    /// The sphere where a model transform puts it, around the transformed one: in world units, as
    /// [`Camera::framing`](crate::Camera::framing) takes it. The radius grows by the transform's largest stretch: for a rotation, and
    /// for scales along the axes, by no more than that; for others by at most 1.32 times that. It is rounded up by 2⁻²⁵ of itself
    /// and 3·2⁻¹⁶. `Scalar::MAX` where centre or radius do not fit [`Scalar`].
    ///
    /// ```
    /// use pinhole::{math::Sphere, prelude::*, Angle};
    /// let sphere = Sphere { centre: Point3::from_ints(1, 0, 0), radius: Scalar::ONE };
    /// let model = Affine::<Model, World>::scale(Scalar::from_int(2)).rotate_z(Angle::degrees(90));
    /// let placed = sphere.transformed(&model.translate(Vector3::from_ints(0, 0, -7)));
    /// assert_eq!(placed.centre, Point3::from_ints(0, 2, -7));
    /// assert!(placed.radius >= Scalar::from_int(2) && placed.radius < Scalar::from_ratio(2001, 1000));
    /// ```
    #[inline(never)] // set-up: code size counts
    pub fn transformed(&self, model: &Affine<Model, World>) -> Self {
        let (m, exponent) = model.linear();
        let radius = stretched(m, exponent, i64::from(self.radius.to_bits().max(0)) << 16);
        // Two units of 2⁻¹⁶ more: one rounds up, one is for the rounding of the centre, at most 0.87 + 2⁻¹⁶ unit.
        let radius = i32::try_from((radius >> 16) + 2).unwrap_or(i32::MAX);
        let centre = model.apply(self.centre).bits();
        let is_outside =
            self.radius == Scalar::MAX || centre.iter().any(|c| [i32::MIN, i32::MAX].contains(c));
        let radius = if is_outside { i32::MAX } else { radius };
        Self { centre: Point3::from_bits(centre), radius: Scalar::from_bits(radius) }
    }
}

/// `length` times an upper bound of the largest stretch of a transform, at most 1.32 times that stretch: in the unit of `length`, rounded to nearest,
/// so that half a unit may be missing. The coefficients are in 2^(`exponent` − 30), at most 2³⁰.
#[inline(never)] // set-up: code size counts
pub(crate) fn stretched(m: &[[i32; 3]; 3], exponent: i32, length: i64) -> i64 {
    // The largest stretch is the root of the largest eigenvalue of mᵀ·m, and that is at most its largest sum of a row's
    // absolute values, which is at most √3 times as large (Golub and Van Loan, Matrix Computations, 4th ed., section 2.3).
    let [[a, b, c], [d, e, f], [g, h, i]] = m.map(|row| row.map(|c| i64::from(c >> 1))); // 2²⁹
    let dot = |[x, y, z]: [i64; 3], [u, v, w]: [i64; 3]| (x * u + y * v + z * w).unsigned_abs(); // ≤ 3·2⁵⁸
    let (x, y, z) = ([a, d, g], [b, e, h], [c, f, i]);
    let (xy, yz, zx) = (dot(x, y), dot(y, z), dot(z, x));
    let squares = (dot(x, x) + xy + zx).max(dot(y, y) + xy + yz).max(dot(z, z) + yz + zx); // ≤ 9·2⁵⁸

    // In 2^(exponent − 28): the 4 covers the bits that the coefficients and the root lost, and the root's rounding.
    let stretch = (sqrt(squares) >> 1) as i32 + 4; // ≤ 3·2²⁸ + 4
    mul_translation(stretch, exponent - 28, length)
}

defmt_format!([] Sphere, self, "{} radius {}", self.centre, self.radius);
