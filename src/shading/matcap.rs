//! Material captures: a picture of a lit ball, looked up by the normal.

use super::lambert::is_conformal;
use super::normal_space::{dot_words, to_words};
use super::Texels;
use crate::camera::ViewTransform;
use crate::math::unit::normalise;
use crate::math::{Affine, NormalMatrix};
use crate::space::{Model, View, World};

/// A material capture: the picture of a ball, with all light and reflections on it, looked up by the normal in view space. It is
/// the cheapest shiny look: a face costs six multiplications and one texel, a vertex six multiplications.
///
/// The ball fills the picture. A face whose normal points to the viewer shows its middle; one whose normal points up shows its
/// upper rim. The picture turns with the camera, not with the object. (Sloan et al., *The lit sphere: a model for capturing
/// NPR shading from art*, 2001.)
///
/// [`color`](Self::color) is the colour of a flat face. For smooth faces, [`coords`](Self::coords) gives texture coordinates of
/// vertices, by which [`Texture::at`](crate::texture::Texture::at) draws the picture; its exponent is [`EXPONENT`](Self::EXPONENT).
///
/// **Error.** Coordinates are within 2⁻¹⁴ of the picture's side of `½ + 127/256 · (x, −y)` for the exact unit normal (x, y, z)
/// in view space; κ, the largest scale factor of the model transform divided by its smallest, adds κ·2⁻³⁰. The rim lies 1/256 of a
/// side inside the picture, so that interpolated coordinates do not leave it.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray8, GrayColor};
/// use pinhole::{light::Matcap, prelude::*, Angle};
/// // A ball of 8 × 8 texels, lit from above.
/// const BALL: [[Gray8; 8]; 8] = [[Gray8::WHITE; 8], [Gray8::new(224); 8], [Gray8::new(192); 8], [Gray8::new(160); 8],
///     [Gray8::new(128); 8], [Gray8::new(96); 8], [Gray8::new(64); 8], [Gray8::new(32); 8]];
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::ONE, Angle::ZERO, Angle::ZERO); // from the front
/// let matcap = Matcap::new(&view, &Affine::identity());
/// assert_eq!(matcap.coords([0, 0, 32767]), [16384, 16384]); // the middle
/// assert_eq!(matcap.color(&BALL, [0, 32767, 0]), Gray8::WHITE);
/// assert_eq!(matcap.color(&BALL, [0, -32767, 0]), Gray8::new(32));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Matcap {
    normals: NormalMatrix<Model, View>,
    /// If the transform is conformal: the x and y axes of view space in model space, in 2⁻¹⁵.
    axes: Option<[[i16; 3]; 2]>,
}

impl Matcap {
    /// The exponent of the unit of [`coords`](Self::coords), for [`Texture::with_exponent`](crate::texture::Texture::with_exponent).
    pub const EXPONENT: i8 = -15;

    /// Sets up the look-up for one view and one object with the transform `model`.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(view: &ViewTransform, model: &Affine<Model, World>) -> Self {
        let normals = view.normals(model);
        let rows = normals.rows();
        let [x, y, _] = rows;
        let axes = is_conformal(rows).then(|| [x, y].map(|row| to_words(normalise(&row.map(i64::from)))));
        Self { normals, axes }
    }

    /// The point of the picture for this unit normal (model space, in 2⁻¹⁵), `[u, v]` in 2⁻¹⁵ of the picture's sides: u to the
    /// right, v down, 128 … 32640. The [type](Self) has the formula and the error.
    #[inline(always)]
    pub fn coords(&self, normal: [i16; 3]) -> [i16; 2] {
        let [x, y] = match self.axes {
            // In 2⁻³⁰, below 2³¹; the half of a unit rounds.
            Some(axes) => axes.map(|axis| (dot_words(normal, axis).saturating_add(1 << 14)) >> 15),
            None => self.transformed(normal),
        };
        // The clamp is for normals longer than 1; all others have |c| ≤ 2¹⁵.
        let part = |c: i32| ((1 << 14) + ((c.clamp(-32_768, 32_768) * 127 + 128) >> 8)) as i16; // 128 … 32640
        [part(x), part(-y)]
    }

    #[cold]
    #[inline(never)]
    fn transformed(&self, normal: [i16; 3]) -> [i32; 2] {
        let [x, y, _] = self.normals.apply(normal).map(i32::from);
        [x, y]
    }

    /// The colour of a flat face with this unit normal (model space, in 2⁻¹⁵): the texel at [`coords`](Self::coords).
    #[inline(always)]
    pub fn color<T: Texels>(&self, ball: T, normal: [i16; 3]) -> T::Ink {
        let [u, v] = self.coords(normal).map(|c| (c as u32) << 17); // not negative, 15 bits
        ball.texel(u, v)
    }
}
