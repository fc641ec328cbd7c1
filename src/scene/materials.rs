//! What a model's materials say about its faces, beside the mesh: colours, the light that they emit, and texture coordinates. A
//! mesh has no reference to them, so firmware that does not draw them does not have them in flash.

use super::mesh::check_indices;
use crate::scene::MeshError;
use embedded_graphics_core::pixelcolor::Rgb888;

/// The colour of each face of a mesh: a palette of at most 256 colours, 3 bytes each, and an index into it for each face, 1
/// byte; and, if they are given, the colours of the light that faces emit, 3 bytes for each colour of the palette. `pinhole-import`
/// makes one of an OBJ model's diffuse and emissive colours.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
/// use pinhole::mesh::FaceColors;
/// const COLORS: FaceColors<'static> = match FaceColors::new(&[[255, 0, 0], [0, 0, 255]], &[0, 1, 1]) {
///     Ok(colors) => colors,
///     Err(_) => panic!("indices of the palette"),
/// };
/// assert_eq!(COLORS.color::<Rgb888>(2), Rgb888::BLUE);
/// // In the display's format, for `instance.faces(|face| COLORS.color(face))`.
/// assert_eq!(COLORS.color::<Rgb565>(0), Rgb565::RED);
/// // At half of the light, for `|face| COLORS.lit(face, light.level(normals[face]))`.
/// assert_eq!(COLORS.lit::<Rgb565>(0, 128), Rgb565::new(16, 0, 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceColors<'a> {
    palette: &'a [[u8; 3]],
    /// One for each colour of the palette, or none.
    emission: &'a [[u8; 3]],
    faces: &'a [u8],
}

impl<'a> FaceColors<'a> {
    /// Colours `[red, green, blue]`, 255 is full, and the index of the colour of each face.
    ///
    /// # Errors
    ///
    /// [`MeshError::Index`] if a face uses an index that the palette does not have.
    pub const fn new(palette: &'a [[u8; 3]], faces: &'a [u8]) -> Result<Self, MeshError> {
        let (count, mut face) = (palette.len(), 0);
        while face < faces.len() {
            let index = faces[face] as u16;
            if index as usize >= count {
                return Err(MeshError::Index { of: "face", number: face, used: "colour", index, count });
            }
            face += 1;
        }
        Ok(Self { palette, emission: &[], faces })
    }

    /// These colours, and the light that faces emit: one colour `[red, green, blue]` for each colour of the palette, black for
    /// none. An index stands for a colour and its emission, so the palette may have a colour twice.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Rgb888;
    /// use pinhole::{mesh::FaceColors, shading::Flat};
    /// // A grey case, and a red lamp.
    /// let colors = FaceColors::new(&[[90, 90, 90], [60, 0, 0]], &[0, 1])?.with_emission(&[[0, 0, 0], [180, 20, 0]])?;
    /// assert_eq!(colors.emission::<Rgb888>(1), Rgb888::new(180, 20, 0));
    /// // In the dark, and in full light.
    /// let [dark, bright] = [0, 256].map(|level| colors.lit::<Rgb888>(1, level));
    /// assert_eq!([dark, bright], [Rgb888::new(180, 20, 0), Rgb888::new(240, 20, 0)]);
    /// // With fractions of a level, for `Dithered` and `Gouraud::new`.
    /// let face = Flat::lit(colors.color(1), 100).emitting(colors.emission(1));
    /// # Ok::<(), pinhole::mesh::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::ListLength`] if the list is not as long as the palette.
    pub const fn with_emission(self, emission: &'a [[u8; 3]]) -> Result<Self, MeshError> {
        if emission.len() != self.palette.len() {
            let (given, needed) = (emission.len(), self.palette.len());
            return Err(MeshError::ListLength {
                one: "emitted colour per colour, black for none",
                given,
                needed,
            });
        }
        Ok(Self { emission, ..self })
    }

    /// The colour of a face in a display's format, rounded as `embedded-graphics` converts from [`Rgb888`]; black for a face
    /// that is not in the list.
    pub fn color<C: From<Rgb888>>(&self, face: usize) -> C {
        let [red, green, blue] = self.of(face, self.palette).unwrap_or_default();
        Rgb888::new(red, green, blue).into()
    }

    /// The light that a face emits, converted like [`color`](Self::color); black if it emits none.
    pub fn emission<C: From<Rgb888>>(&self, face: usize) -> C {
        let [red, green, blue] = self.of(face, self.emission).unwrap_or_default();
        Rgb888::new(red, green, blue).into()
    }

    /// The colour of a face in a list that has one for each colour of the palette.
    fn of(&self, face: usize, colors: &[[u8; 3]]) -> Option<[u8; 3]> {
        colors.get(usize::from(*self.faces.get(face)?)).copied()
    }

    /// The light that a face of each colour of the palette emits; empty if none was given.
    pub(crate) const fn emissions(&self) -> &'a [[u8; 3]] {
        self.emission
    }
}

defmt_format!(
    [] FaceColors<'_>, self,
    "{=usize} colours of {=usize} faces", self.palette.len(), self.faces.len()
);

/// Texture coordinates of the corners of a mesh's faces: each different pair once, 4 bytes, and three indices a face, 6 bytes.
/// `pinhole-import` makes them from an OBJ model.
///
/// A coordinate is `[u, v]` in units of 2^exponent of a texture's side. u grows to the right and v downwards, like the rows of a
/// picture in memory. The origin is the upper left corner of the texel in column 0 and row 0; the centre of this texel is half a
/// texel from there. In a texture of 2ʷ texels a side, a coordinate c lies in the texel `(c << w) >> -exponent`, rounded down
/// also where c is negative, modulo 2ʷ where the texture repeats.
///
/// ```
/// use pinhole::mesh::TextureCoords;
/// // A square of two faces, with all of a texture on it, in quarters of its side.
/// let coords = TextureCoords::new(&[[0, 4], [4, 4], [4, 0], [0, 0]], &[[0, 1, 2], [0, 2, 3]], -2)?;
/// assert_eq!(coords.corners(1), [[0, 4], [4, 0], [0, 0]]);
/// // The middle of the texture is texel 32 of 64.
/// assert_eq!((2i32 << 6) >> -coords.exponent(), 32);
/// # Ok::<(), pinhole::mesh::MeshError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureCoords<'a> {
    coords: &'a [[i16; 2]],
    faces: &'a [[u16; 3]],
    exponent: i8,
}

impl<'a> TextureCoords<'a> {
    /// From coordinates in units of 2^exponent of a texture's side, and for each face the indices of its corners' coordinates.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if a face uses an index that the list does not have, or the exponent is outside of −15 … 0.
    pub const fn new(coords: &'a [[i16; 2]], faces: &'a [[u16; 3]], exponent: i8) -> Result<Self, MeshError> {
        if exponent < -15 || exponent > 0 {
            return Err(MeshError::Exponent { exponent });
        }
        if let Err(error) = check_indices("face", faces, "texture coordinate", coords.len()) {
            return Err(error);
        }
        Ok(Self { coords, faces, exponent })
    }

    /// The coordinates of a face's corners, in the order of [`Mesh::faces`](crate::Mesh::faces); zeros for a face that is not
    /// in the list.
    pub fn corners(&self, face: usize) -> [[i16; 2]; 3] {
        let at = |index: u16| self.coords.get(usize::from(index)).copied().unwrap_or_default();
        self.faces.get(face).map_or([[0; 2]; 3], |corners| corners.map(at))
    }

    /// The exponent of the unit: coordinate = number · 2^exponent of a texture's side.
    pub const fn exponent(&self) -> i8 {
        self.exponent
    }
}

defmt_format!(
    [] TextureCoords<'_>, self,
    "{=usize} texture coordinates of {=usize} faces", self.coords.len(), self.faces.len()
);
