//! A texture, and a texture on a face.

use super::clamped::{span, ClampedTexels};
use super::texels::{Texels, TextureError};

/// The error bound of interpolated texture coordinates: how far the texel that a pixel shows may be from the exact one. A lower
/// bound divides rows into shorter runs. The discriminant is the binary logarithm of its inverse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Accuracy {
    /// 1/4 texel.
    #[default]
    Quarter = 2,
    /// 1/8 texel.
    Eighth = 3,
    /// 1/16 texel.
    Sixteenth = 4,
}

/// A texture: [`Texels`], the unit of texture coordinates, and how accurately they are interpolated.
///
/// **Space.** Texture coordinates are `[u, v]`, u to the right and v down: (0, 0) is the upper left corner of the picture, and
/// the centre of its first texel is half a texel from there. The picture repeats in all directions, or its edge continues
/// ([`clamped_at`](Self::clamped_at)). The unit is 1/16 texel unless [`with_exponent`](Self::with_exponent) sets another.
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::{prelude::*, Angle};
/// // A square that shows a picture of 8 × 8 texels once.
/// static PICTURE: [[Rgb565; 8]; 8] = [[Rgb565::RED, Rgb565::RED, Rgb565::RED, Rgb565::RED, Rgb565::BLUE, Rgb565::BLUE, Rgb565::BLUE, Rgb565::BLUE]; 8];
/// const UV: [[i16; 2]; 4] = [[0, 128], [128, 128], [128, 0], [0, 0]];
/// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], 0, &[[0, 1, 2], [0, 2, 3]])?;
/// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
/// let camera = Camera::new(
///     &ViewTransform::look_at(Point3::from_ints(0, 0, 3), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
///     &Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(9))?,
///     &viewport,
/// );
/// let instance = camera.place(&mesh, &Affine::identity());
/// let texture = Texture::new(&PICTURE);
/// let mut pixels = [Rgb565::BLACK; 32 * 32];
/// let mut picture = Picture::new(&mut pixels, viewport.size())?;
/// instance.faces(|face| texture.at(mesh.corners_of(face, &UV))).draw(&mut picture.pixels())?;
/// assert_eq!([pixels[16 * 32 + 12], pixels[16 * 32 + 20]], [Rgb565::RED, Rgb565::BLUE]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **Error.** A pixel shows the texel at the coordinates of a point within 1/64 pixel of its centre, off by at most the
/// [`Accuracy`] and the error of the planes. In a parallel projection, and where a face is seen at one distance, there is no error
/// of interpolation.
///
/// With barycentric weights λ, corners' coordinates uᵢ in a range of E texels, and qᵢ = 1/wᵢ between m and M, a point shows
/// u = Σλᵢqᵢuᵢ / Σλᵢqᵢ, and linear interpolation Σλᵢuᵢ. The difference is the covariance of q and u under λ, divided by the mean of
/// q. Standard deviations are at most E/2 for u and √((M − q̄)(q̄ − m)) for q (Bhatia and Davis, *A better bound on the variance*,
/// 2000), so it is at most E·(M − m)/(4·√(M·m)) ≤ E·(M − m)/(4·m).
///
/// - A triangle for which this is at most the [`Accuracy`] is interpolated linearly.
/// - A triangle each of whose rows meets the [`Accuracy`] is interpolated linearly along rows, by the tangent in the middle of
///   the triangle.
/// - Otherwise s = (u − u₀)·q and q are interpolated linearly, and divided at both ends of a run of pixels. Along a row they have
///   steps s' and q', and K = s'·q − s·q' is constant: over L pixels u changes by K·L/(q₀·q₁) and q by q'·L, so coordinates that
///   are linear in between are off by at most |K·q'|·L²/(4·m³), m the lesser q of both ends, always to one side. Moved by half of
///   that, they are off by at most |K·q'|·L²/(8·m³). Each pixel belongs to the longest run for which this is at most the [`Accuracy`]. Runs have 1 to 64 pixels, and begin and end at multiples of their length, so
///   that a pixel does not depend on where a span begins.
///
/// **Error of the planes.** u·q and q have 22 bits at the corners, and the error of
/// [`Triangle::gradient`](crate::raster::Triangle::gradient), relative to the farthest corner, where q is least. Where this is not a
/// shift of 1/64 pixel, a pixel may be off by up to 8·2⁻²⁴·E·r texels, E the face's range of coordinates in texels and r the
/// ratio of its largest w to its least: 1/128 texel at E = 64 and r = 256. E is the larger range of u and v in the texture's
/// units, because both are stored in one unit: a face with a long u has a coarser v, too. `tests/shading/textures.rs`
/// asserts this bound up to 4096 texels and r = 32767, and meets half of it on faces that reach far out of the picture with one
/// corner close to the eye. Most faces stay far below it: 0.02 texel is asserted there for floors of 1600
/// texels that reach a thousand times as far as the near plane, and for random triangles. Coordinates that are interpolated
/// linearly are kept between those of the corners, which adds at most 2⁻¹³ of their range, or 1/400 texel if that is more
/// (asserted there, in every unit). The range of coordinates of a picture that does not repeat includes 0.
///
/// **Error of packing.** Unless texels ask for 32 bits ([`Texels::WIDE`]), u and v share a word: at most 37·2⁻¹⁶ of a side more, 1/27 texel
/// of 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture<S> {
    pub(super) texels: S,
    /// One unit of u and of v is 2^`unit` of 2⁻³² of the side: 16 … 32.
    pub(super) unit: [u8; 2],
    pub(super) accuracy: Accuracy,
}

impl<S: Texels> Texture<S> {
    /// A texture whose coordinates are in 1/16 texel. Each side of the picture is 8, 16, 32, 64, 128 or 256 texels; another does not build.
    pub fn new(texels: S) -> Self {
        let unit = texels.size_bits().map(|bits| 28u32.saturating_sub(bits).max(16) as u8);
        Self { texels, unit, accuracy: Accuracy::Quarter }
    }

    /// Sets the unit of coordinates to 2^`exponent` of the picture's width and height, as
    /// [`TextureCoords`](crate::mesh::TextureCoords) have it.
    ///
    /// # Errors
    ///
    /// [`TextureError::Exponent`] if the exponent is outside of −15 … 0.
    pub const fn with_exponent(self, exponent: i8) -> Result<Self, TextureError> {
        if exponent < -15 || exponent > 0 {
            return Err(TextureError::Exponent { exponent });
        }
        Ok(Self { unit: [(32 + exponent) as u8; 2], ..self })
    }

    /// Sets the error of interpolation; the default is [`Accuracy::Quarter`].
    #[must_use]
    pub const fn with_accuracy(self, accuracy: Accuracy) -> Self {
        Self { accuracy, ..self }
    }

    /// The shader of a face, from the texture coordinates `[u, v]` of its corners, in the order of the face's vertices and in 1/16 texel
    /// or the unit that [`with_exponent`](Self::with_exponent) sets.
    #[inline]
    pub fn at(&self, corners: [[i16; 2]; 3]) -> Textured<S> {
        let uv = corners.map(|uv| uv.map(|c| i32::from(c) << FRACTION));
        let Self { texels, unit, accuracy } = *self;
        Textured { texels, coords: FaceCoords { uv, w: [1 << 30; 3], unit, accuracy } }
    }

    /// [`at`](Self::at) for a picture that does not repeat: coordinates beyond it, on either side, show the nearest texel of its
    /// edge.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
    /// use pinhole::{camera::Window, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let (one, two) = (Scalar::from_int(1), Scalar::from_int(2));
    /// let window = Window { left: -two, right: two, bottom: -two, top: two };
    /// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), two, Angle::ZERO, Angle::ZERO);
    /// let camera = Camera::new(&view, &Projection::orthographic(window, one, Scalar::from_int(9))?, &viewport);
    /// // A square that fills a picture of 64 pixels: from one width left of the texture to two widths right of it.
    /// const UV: [[i16; 2]; 4] = [[-128, 128], [384, 128], [384, 0], [-128, 0]];
    /// let mesh = Mesh::new(&[[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], 0, &[[0, 1, 2], [0, 2, 3]])?;
    /// let columns = [[0, 1, 2, 3, 4, 5, 6, 7].map(Gray8::new); 8];
    /// let texture = Texture::new(&columns);
    /// let mut pixels = [Gray8::WHITE; 64 * 64];
    /// let mut picture = Picture::new(&mut pixels, viewport.size())?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// instance.faces(|face| texture.clamped_at(mesh.corners_of(face, &UV))).draw(&mut picture.pixels())?;
    /// assert_eq!([0, 15, 16, 18, 31, 32, 63].map(|x: usize| pixels[x].luma()), [0, 0, 0, 1, 7, 7, 7]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn clamped_at(&self, corners: [[i16; 2]; 3]) -> Textured<ClampedTexels<S>> {
        let [[ua, va], [ub, vb], [uc, vc]] = corners;
        let [u, v] = self.unit;
        let sides @ [w, h] = [span([ua, ub, uc], u), span([va, vb, vc], v)];
        // In units twice as large: the span, up to 2¹⁷ of the texture's units, is then 2¹⁶ of them.
        let uv = corners.map(|uv| uv.map(|c| i32::from(c) << (FRACTION - 1)));
        let unit = [(u + 1).saturating_sub(w), (v + 1).saturating_sub(h)];
        Textured {
            texels: ClampedTexels::new(self.texels, sides),
            coords: FaceCoords { uv, w: [1 << 30; 3], unit, accuracy: self.accuracy },
        }
    }
}

/// A [`Texture`] on a face: [`Texture::at`] makes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Textured<S> {
    pub(super) texels: S,
    pub(super) coords: FaceCoords,
}

/// Texture coordinates of a face, without the texels that they are for: gradients are set up by code that is there once for all formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FaceCoords {
    /// Of the corners, with [`FRACTION`] fractional bits: 24 bits with the sign.
    pub(super) uv: [[i32; 2]; 3],
    /// w of the corners, in any unit: equal, so that coordinates are linear on the screen, until a draw call passes the corners'
    /// own.
    pub(super) w: [i32; 3],
    /// As of a [`Texture`].
    pub(super) unit: [u8; 2],
    pub(super) accuracy: Accuracy,
}

/// The fractional bits of a corner's coordinates: clipping rounds the coordinates of new corners to 2⁻⁸ of the texture's unit.
pub(super) const FRACTION: u32 = 8;

defmt_format!(
    [S] Texture<S>, self,
    "texture in 2^{=i8} and 2^{=i8} of its sides, to {}",
    self.unit[0] as i8 - 32, self.unit[1] as i8 - 32, self.accuracy
);

defmt_format!(
    [S] Textured<S>, self,
    "texture in 2^{=i8} and 2^{=i8} of its sides, to {} at {}",
    self.coords.unit[0] as i8 - 32, self.coords.unit[1] as i8 - 32, self.coords.accuracy,
    self.coords.uv.map(|uv| uv.map(|c| c >> FRACTION))
);
