//! View-frustum culling of whole objects, by bounding spheres.

use super::Camera;
use crate::math::num::{add, mul_translation, sqrt};
use crate::math::{matrix_product, stretched, Affine, Row, Scalar, Sphere};
use crate::space::{Model, World};

/// How much of an object lies inside the view volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Visibility {
    /// No part: the object need not be drawn.
    Outside,
    /// Perhaps a part, perhaps nothing: the object must be drawn.
    Partly,
    /// All of the object.
    Inside,
}

impl Camera {
    /// The view volume, for tests of bounding spheres. An object that is [`Outside`](Visibility::Outside) need not be drawn: only vertices
    /// within 1/512 pixel of the border could show, rounded to 1/256 pixel. An object that is `Inside` is not clipped. The far plane counts
    /// even if the camera does not [clip there](Self::with_far_clip); then objects beyond it would be drawn without a depth buffer, and
    /// culling them changes the picture.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{camera::Visibility, meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(240, 240))?;
    /// let sphere = CUBE.bounding_sphere();
    /// let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let frustum = camera.frustum(); // once, for all objects
    /// let at = |x, y, z| frustum.visibility(&sphere, &Affine::translation(Vector3::from_ints(x, y, z)));
    /// assert_eq!(at(0, 0, 0), Visibility::Inside);
    /// assert_eq!(at(0, 0, 1), Visibility::Partly); // through the near plane
    /// assert_eq!(at(0, 0, 9), Visibility::Outside); // behind the camera
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(never)] // set-up: code size counts
    pub fn frustum(&self) -> Frustum {
        // The planes: half·w ± x, half·w ± y, d, w − d.
        let [x, y, d, w] = &self.rows;
        let unit = self.screen.unit;
        let size = self.screen.area.size;
        let half = |extent: u32| (i64::from(extent) * 128, -unit); // 22 bits
        let (plus, minus) = ((1 << 30, -30), (-(1 << 30), -30));
        let (across, down) = (half(size.width), half(size.height));
        let planes = [
            w.linear_combination(across, x, plus),
            w.linear_combination(across, x, minus),
            w.linear_combination(down, y, plus),
            w.linear_combination(down, y, minus),
            *d,
            // d is stored times 65535/65536.
            w.linear_combination((65_535, -16), d, minus),
        ];
        let planes = planes.map(|row| (row, Length::of(&row)));
        Frustum { axes: self.axes, eye: self.eye, planes, w: Length::of(w) }
    }
}

/// A camera's view volume: its six planes, for tests of bounding spheres. [`Camera::frustum`] makes it and has an example. It takes
/// 264 bytes.
#[derive(Clone, Copy, Debug)]
pub struct Frustum {
    axes: [[i32; 3]; 3],
    eye: [i64; 3],
    /// Linear forms of view coordinates that are negative outside, and the lengths of their normals.
    planes: [(Row, Length); 6],
    /// The length of the normal of the form w.
    w: Length,
}

/// The length of a form's normal, rounded up.
#[derive(Clone, Copy, Debug)]
struct Length {
    /// In 2^(exponent − 30): at most 2²⁹·⁸ + 1.
    mantissa: i32,
    exponent: i32,
}

impl Length {
    fn of(row: &Row) -> Self {
        let squares: u64 = row.linear.iter().map(|c| u64::from(c.unsigned_abs()).pow(2)).sum(); // ≤ 3·2⁶⁰
        let length = sqrt(squares); // ≤ 2³⁰·⁸, in 2^(row.exponent − 30)
        Self { mantissa: (length >> 1) as i32 + 1, exponent: row.exponent + 1 }
    }

    /// `v` times the length, times 2^−`shift`.
    fn times(self, v: i64, shift: i32) -> i64 {
        mul_translation(self.mantissa, self.exponent - 30 - shift, v)
    }
}

impl Frustum {
    /// Tests a bounding sphere, placed by `model` as [`transformed`](Sphere::transformed) places it, against the six planes. `Outside` and
    /// `Inside` are certain: the margin is less than 2⁻²⁰ of the sphere's size and distance, and at the far plane of a perspective
    /// 2⁻²⁸·far/near of that distance more. A sphere of radius `Scalar::MAX`, too large to represent, is `Partly` visible.
    #[inline(never)] // set-up: code size counts
    pub fn visibility(&self, sphere: &Sphere, model: &Affine<Model, World>) -> Visibility {
        if sphere.radius == Scalar::MAX {
            return Visibility::Partly;
        }
        // The centre in view coordinates, and the radius.
        let centre = sphere.centre.bits().map(|c| i64::from(c) << 16);
        let (m, exponent) = model.linear();
        let away = model.offset_from(&self.eye);
        let mut linear = [[0; 3]; 3];
        let view_exponent = matrix_product(&self.axes, 0, m, exponent, &mut linear);
        let coordinate = |i: usize| {
            let axis = Row { linear: self.axes[i], ..Row::ZERO };
            Row { linear: linear[i], exponent: view_exponent, offset: axis.apply(&away) }.apply(&centre)
        };
        let centre = [coordinate(0), coordinate(1), coordinate(2)];
        let radius = stretched(m, exponent, i64::from(sphere.radius.to_bits().max(0)) << 16);
        let mut visibility = Visibility::Inside;
        let far_out = centre.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        let away = 64 - far_out.leading_zeros() as i32;
        // An upper bound of the distance of the sphere's points from the eye; saturates.
        let all = add(i64::try_from(far_out).unwrap_or(i64::MAX), radius);
        // The error of rounded coefficients grows with the distance from the eye. At the far plane w and d nearly cancel, so
        // their errors are added.
        let of_rows = add(self.w.times(all, 28), 16);
        for (plane, length) in &self.planes {
            if plane.overflow(away) > 0 {
                visibility = Visibility::Partly; // out of range of the arithmetic
                continue;
            }
            let distance = plane.apply(&centre);
            let reach = add(length.times(radius, 0), add(length.times(all, 20), of_rows));
            if distance < -reach {
                return Visibility::Outside;
            }
            if distance < reach {
                visibility = Visibility::Partly;
            }
        }
        visibility
    }
}

defmt_format!([] Frustum, self, "frustum, axes {}/2^30, eye {}/2^32", self.axes, self.eye);
