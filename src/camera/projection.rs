//! View to clip: the shape of the view volume.

use crate::math::num::{excess, fraction, scale, SATURATED};
use crate::math::{Angle, Point3, Row, Scalar};
use crate::space::{Ndc, View};
use embedded_graphics_core::geometry::Size;

/// A rectangle of the near plane (perspective) or of any plane z = const (orthographic), in view
/// units: x from `left` to `right`, y from `bottom` to `top`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Smallest x.
    pub left: Scalar,
    /// Largest x.
    pub right: Scalar,
    /// Smallest y.
    pub bottom: Scalar,
    /// Largest y.
    pub top: Scalar,
}

#[cfg(feature = "defmt")]
impl defmt::Format for Window {
    fn format(&self, f: defmt::Formatter<'_>) {
        let [l, r, b, t] = [self.left, self.right, self.bottom, self.top].map(Scalar::to_bits);
        defmt::write!(f, "[{=i32}, {=i32}] x [{=i32}, {=i32}]/65536", l, r, b, t);
    }
}

/// A projective map from view to clip space: four linear forms x, y, z, w.
///
/// Visible points have −w ≤ x, y, z ≤ w; the near plane is z = −w, the far plane z = +w. Instead
/// of z the rows hold `d = (z + w)/2`, which is 0 on the near plane and w on the far one: the
/// near test is a sign, and d/w is the depth. Coefficients have 30 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projection {
    /// x, y, d, w over view coordinates.
    rows: [Row; 4],
}

/// Why there is no such view volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ProjectionError {
    /// The field of view is closer than 1/4096 turn to 0° or to 180°.
    FieldOfView,
    /// An aspect of zero width or height: pass the viewport's size, or a ratio such as 4 × 3.
    EmptyAspect,
    /// A perspective needs near > 0: move the near plane in front of the eye.
    NearNotPositive,
    /// Far must lie beyond near.
    NearNotBeforeFar,
    /// near·far/(far − near) must stay below 2³⁰ for depth to mean anything: move them apart.
    NearTooCloseToFar,
    /// The window needs left < right and bottom < top.
    EmptyWindow,
    /// The window is 2³⁰ times smaller than its distance from the axis: enlarge or centre it.
    WindowTooSmall,
}

impl core::fmt::Display for ProjectionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::FieldOfView => "the field of view must lie between 1/4096 and 2047/4096 turn",
            Self::EmptyAspect => "the aspect needs a width and a height",
            Self::NearNotPositive => "a perspective needs a near plane in front of the eye",
            Self::NearNotBeforeFar => "the far plane must lie beyond the near plane",
            Self::NearTooCloseToFar => "near and far are too close together for depth",
            Self::EmptyWindow => "the window needs left < right and bottom < top",
            Self::WindowTooSmall => "the window is too small for its distance from the axis",
        })
    }
}

impl core::error::Error for ProjectionError {}

/// `n / d` as `mantissa · 2^exponent` with a mantissa of 30 or 31 bits, rounded: within 2⁻³⁰ of
/// itself. Wants `d > 0`.
fn ratio(n: i64, d: u64) -> (i64, i32) {
    let magnitude = n.unsigned_abs();
    if magnitude == 0 {
        return (0, 0);
    }
    // Both to 62 bits: 62-bit over 62-bit is between ½ and 2, as `fraction` wants it.
    let (up_n, up_d) = (-excess(magnitude, 61), -excess(d, 61));
    let shifted = |v: u64, up: i32| if up >= 0 { v << up } else { v >> -up };
    let q = fraction(shifted(magnitude, up_n), shifted(d, up_d), 31);
    let q = q.div_ceil(2) as i64; // one guard bit
    (if n < 0 { -q } else { q }, up_d - up_n - 30)
}

/// `n / d` in 2⁻³², or `None` where it leaves ±2³⁰.
fn offset(n: i64, d: u64) -> Option<i64> {
    let (mantissa, exponent) = ratio(n, d);
    let value = scale(mantissa, exponent + 32);
    (value.abs() < SATURATED).then_some(value)
}

/// One coefficient as a whole row.
fn row(axis: usize, (mantissa, exponent): (i64, i32), offset: i64) -> Row {
    let mut linear = [0; 3];
    if let Some(coefficient) = linear.get_mut(axis) {
        *coefficient = mantissa;
    }
    Row::new(linear, exponent, offset)
}

/// `high − low` in 2⁻¹⁶ when positive.
fn extent(low: Scalar, high: Scalar) -> Option<u64> {
    let extent = i64::from(high.to_bits()) - i64::from(low.to_bits()); // 33 bits
    (extent > 0).then_some(extent.unsigned_abs())
}

impl Projection {
    /// A frustum by its vertical field of view, symmetric about the axis. `aspect` gives
    /// width : height as any pair, usually the viewport's size; `near` and `far` are distances.
    ///
    /// ```text
    ///     | cot(fov/2)·h/w  0           0             0           |
    ///     | 0               cot(fov/2)  0             0           |
    ///     | 0               0           −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0               0           −1            0           |
    /// ```
    ///
    /// (*OpenGL Programming Guide*, appendix on homogeneous coordinates; Marschner and Shirley,
    /// *Fundamentals of Computer Graphics*, section on perspective projection.)
    ///
    /// ```
    /// use embedded_graphics::geometry::Size;
    /// use pinhole::{Angle, Projection, ProjectionError, Scalar};
    /// let (near, far) = (Scalar::from_num(1), Scalar::from_num(20));
    /// let _ = Projection::perspective(Angle::degrees(60), Size::new(240, 240), near, far)?;
    /// let flat = Projection::perspective(Angle::degrees(180), Size::new(240, 240), near, far);
    /// assert_eq!(flat, Err(ProjectionError::FieldOfView));
    /// # Ok::<(), ProjectionError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`ProjectionError::FieldOfView`], [`EmptyAspect`](ProjectionError::EmptyAspect),
    /// [`NearNotPositive`](ProjectionError::NearNotPositive),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn perspective(
        fov_y: Angle,
        aspect: Size,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, ProjectionError> {
        const LEAST: u32 = 1 << 20; // 1/4096 turn
        if !(LEAST..=(1 << 31) - LEAST).contains(&fov_y.bits()) {
            return Err(ProjectionError::FieldOfView);
        }
        if aspect.width == 0 || aspect.height == 0 {
            return Err(ProjectionError::EmptyAspect);
        }
        let (sine, cosine) = Angle::from_bits(fov_y.bits() / 2).sin_cos();
        // Half angles of 1/8192 … 2047/8192 turn: both positive, 30 bits; times 32-bit sides.
        let (sine, cosine) = (i64::from(sine), i64::from(cosine));
        let across =
            ratio(cosine * i64::from(aspect.height), (sine * i64::from(aspect.width)).unsigned_abs());
        let up = ratio(cosine, sine.unsigned_abs());
        Self::by_distance(row(0, across, 0), row(1, up, 0), near, far)
    }

    /// A frustum by the window that it cuts out of the near plane; it may lie off the axis.
    ///
    /// ```text
    ///     | 2n/(r−l)  0         (r+l)/(r−l)   0           |
    ///     | 0         2n/(t−b)  (t+b)/(t−b)   0           |
    ///     | 0         0         −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0         0         −1            0           |
    /// ```
    ///
    /// (OpenGL 1.x, `glFrustum`; *OpenGL Programming Guide*, appendix on homogeneous coordinates.)
    ///
    /// # Errors
    ///
    /// [`ProjectionError::EmptyWindow`], [`NearNotPositive`](ProjectionError::NearNotPositive),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn frustum(window: Window, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        let form = |axis: usize, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(ProjectionError::EmptyWindow)?;
            let (low, high) = (i64::from(low.to_bits()), i64::from(high.to_bits()));
            // Both coefficients over one denominator: the numerators, 33 bits, are exact.
            let (numerator, shear) = (2 * i64::from(near.to_bits()), high + low);
            let (_, e) = ratio(numerator.abs().max(shear.abs()).max(1), extent);
            // Both in the larger one's unit.
            let small = |n: i64| {
                let (m, own) = ratio(n, extent);
                scale(m, own - e)
            };
            let mut linear = [0, 0, small(shear)];
            if let Some(focal) = linear.get_mut(axis) {
                *focal = small(numerator);
            }
            Ok(Row::new(linear, e, 0))
        };
        let x = form(0, window.left, window.right)?;
        let y = form(1, window.bottom, window.top)?;
        Self::by_distance(x, y, near, far)
    }

    /// The rows d and w of a frustum: `d = (f·(−z) − f·n)/(f − n)`, `w = −z`.
    fn by_distance(x: Row, y: Row, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        if near <= Scalar::ZERO {
            return Err(ProjectionError::NearNotPositive);
        }
        let depth = extent(near, far).ok_or(ProjectionError::NearNotBeforeFar)?;
        let (n, f) = (i64::from(near.to_bits()), i64::from(far.to_bits()));
        let at_eye = match offset(-n * f, depth << 16) {
            Some(value) => value,
            None => return Err(ProjectionError::NearTooCloseToFar),
        };
        let d = row(2, ratio(-f, depth), at_eye);
        let w = row(2, (-1, 0), 0);
        Ok(Self { rows: [x, y, d, w] })
    }

    /// A box in view space, seen along −z: no size change with distance. `near` and `far` are
    /// distances along −z and may be negative (behind the eye point).
    ///
    /// ```text
    ///     | 2/(r−l)  0        0         −(r+l)/(r−l) |
    ///     | 0        2/(t−b)  0         −(t+b)/(t−b) |
    ///     | 0        0        −2/(f−n)  −(f+n)/(f−n) |
    ///     | 0        0        0         1            |
    /// ```
    ///
    /// (OpenGL 1.x, `glOrtho`.)
    ///
    /// # Errors
    ///
    /// [`ProjectionError::EmptyWindow`], [`WindowTooSmall`](ProjectionError::WindowTooSmall),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn orthographic(window: Window, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        let form = |axis: usize, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(ProjectionError::EmptyWindow)?;
            let sum = i64::from(low.to_bits()) + i64::from(high.to_bits());
            let centre = offset(-sum, extent).ok_or(ProjectionError::WindowTooSmall)?;
            Ok(row(axis, ratio(2 << 16, extent), centre))
        };
        let x = form(0, window.left, window.right)?;
        let y = form(1, window.bottom, window.top)?;
        let depth = extent(near, far).ok_or(ProjectionError::NearNotBeforeFar)?;
        let at_eye = offset(-i64::from(near.to_bits()), depth);
        let d = row(2, ratio(-1 << 16, depth), at_eye.ok_or(ProjectionError::NearTooCloseToFar)?);
        let w = Row { offset: 1 << 32, ..Row::ZERO };
        Ok(Self { rows: [x, y, d, w] })
    }

    /// A view point in clip space.
    pub fn apply(&self, p: Point3<View>) -> ClipPoint {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let [x, y, d, w] = self.rows.map(|row| row.apply(p));
        // z = 2d − w; d and w are below 2⁶², so halve all four before they meet.
        let sums = [x >> 2, y >> 2, (d >> 1) - (w >> 2), w >> 2];
        let largest = sums.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        let shift = excess(largest, 30);
        let [x, y, z, w] = sums.map(|c| scale(c, -shift) as i32); // 30 bits
        ClipPoint { x, y, z, w, exponent: shift - 30 }
    }

    pub(super) const fn rows(&self) -> &[Row; 4] {
        &self.rows
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for Projection {
    fn format(&self, f: defmt::Formatter<'_>) {
        for row in &self.rows {
            let (linear, exponent, offset) = (row.linear, row.exponent, row.offset);
            defmt::write!(f, "[{} * 2^({=i32} - 30), {=i64}/2^32]", linear, exponent, offset);
        }
    }
}

/// A point of clip space: homogeneous, stands for (x/w, y/w, z/w). 30-bit integers with one
/// exponent: each value is `integer · 2^exponent`. Only a [`Projection`] makes one.
///
/// ```
/// use pinhole::{Projection, Window, Scalar, Point3, space::View};
/// let one = Scalar::from_num(1);
/// let window = Window { left: -one, right: one, bottom: -one, top: one };
/// let frustum = Projection::frustum(window, one, Scalar::from_num(3))?;
/// let clip = frustum.apply(Point3::<View>::from_ints(0, 0, -3));
/// assert_eq!(clip.ndc(), Some(Point3::from_ints(0, 0, 1)));
/// # Ok::<(), pinhole::ProjectionError>(())
/// ```
///
/// ```compile_fail,E0451
/// let forged = pinhole::ClipPoint { x: 0, y: 0, z: 0, w: 1, exponent: 0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipPoint {
    x: i32,
    y: i32,
    z: i32,
    w: i32,
    exponent: i32,
}

impl ClipPoint {
    /// x, y, z, w in units of 2^[`exponent`](Self::exponent).
    pub const fn xyzw(&self) -> [i32; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// The exponent that the four numbers share.
    pub const fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The quotients, rounded to the nearest 2⁻¹⁶ and saturated. `None` where w ≤ 0: such a point
    /// lies in the plane of the eye or behind it and has no image.
    pub fn ndc(&self) -> Option<Point3<Ndc>> {
        if self.w <= 0 {
            return None;
        }
        let w = self.w.unsigned_abs();
        Some(Point3::from_bits([self.x, self.y, self.z].map(|c| {
            // (|c| < 2³¹) · 2¹⁶ + w/2 stays below 2⁴⁸.
            let n = (u64::from(c.unsigned_abs()) << 16) + u64::from(w / 2);
            let (q, _) = crate::math::num::divide(n, w);
            let q = q.min(i32::MAX as u64) as i32;
            if c < 0 {
                -q
            } else {
                q
            }
        })))
    }
}
