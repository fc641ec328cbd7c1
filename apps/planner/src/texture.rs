//! The textures of faces, and their coordinates.

use crate::choice::Choice;
use crate::corners::corners;
use crate::palette::{Counts, Palette};
use crate::refused;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{mesh::TextureCoords, texture::IndexedTexels, Mesh};
use pinhole_import::{ImportedMesh, IndexedPicture};

/// What textured faces show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pattern {
    /// Squares in the chosen colour and in a quarter of it.
    Checker,
    /// A grid of lines.
    Grid,
    /// The loaded picture.
    File,
}

impl Pattern {
    pub(crate) const ALL: [(&'static str, Self); 3] =
        [("checker", Self::Checker), ("grid", Self::Grid), ("file", Self::File)];
}

/// The most colours of a palette.
const COLORS: usize = 256;

/// A texture: texels, row by row, as indices into a palette of at most 256 colours, as firmware stores them. Its sides are powers
/// of two, 8 … 256.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct TextureImage {
    texels: Vec<u8>,
    width: usize,
    /// 256 colours: black after those that are used.
    palette: Vec<Rgb888>,
    used: usize,
}

/// Texels on a side of a ready pattern.
const SIDE: usize = 32;

impl TextureImage {
    fn new(texels: Vec<u8>, width: usize, mut palette: Vec<Rgb888>) -> Self {
        let used = palette.len();
        palette.resize(COLORS, Rgb888::BLACK);
        Self { texels, width, palette, used }
    }

    /// From red, green, blue and opacity of each texel. Fails if a side is none that a texture can have.
    pub(crate) fn from_rgba(bytes: &[u8], width: usize) -> Result<Self, String> {
        let colors = || bytes.chunks_exact(4).filter_map(|texel| texel.first_chunk::<3>()).copied();
        let mut counts = Counts::default();
        counts.add(colors());
        let palette = Palette::of(counts);
        let texels = colors().map(|color| palette.index(color)).collect();
        let colors = palette.colours.iter().map(|&[r, g, b]| Rgb888::new(r, g, b));
        let image = Self::new(texels, width, colors.collect());
        image.texels().map(|_| ())?;
        Ok(image)
    }

    /// A ready pattern in the colour of a choice; `None` for the loaded picture.
    pub(crate) fn ready(choice: &Choice) -> Option<Self> {
        let colors = [1, 4].map(|part| {
            Rgb888::new(choice.color.r() / part, choice.color.g() / part, choice.color.b() / part)
        });
        let is_light: fn(usize, usize) -> bool = match choice.texture {
            Pattern::File => return None,
            Pattern::Checker => |x, y| (x ^ y) & (SIDE / 4) == 0,
            Pattern::Grid => |x, y| x % (SIDE / 2) >= 3 && y % (SIDE / 2) >= 3,
        };
        let texels = (0..SIDE * SIDE).map(|i| u8::from(!is_light(i % SIDE, i / SIDE)));
        Some(Self::new(texels.collect(), SIDE, colors.into()))
    }

    /// The numbers of columns and rows.
    pub(crate) fn sides(&self) -> [usize; 2] {
        [self.width, self.texels.len().checked_div(self.width).unwrap_or(0)]
    }

    /// The texels. Fails if no picture was loaded.
    pub(crate) fn texels(&self) -> Result<IndexedTexels<'_, Rgb888, 8>, String> {
        let [width, height] = self.sides();
        if width == 0 {
            return Err("no picture: drop a PNG, BMP or JPEG, or choose a pattern".into());
        }
        IndexedTexels::new(&self.texels, width, height, &self.palette).map_err(refused::texture)
    }

    /// The texture as firmware for a display in 16-bit colour stores it; `color` is the path of the colour type.
    pub(crate) fn picture(&self, color: String) -> IndexedPicture {
        let bits = [1, 2, 4].into_iter().find(|bits| 1 << bits >= self.used).unwrap_or(8);
        let [width, height] = self.sides();
        let pack = |texels: &[u8]| texels.iter().fold(0, |byte: u32, &texel| byte << bits | u32::from(texel));
        let palette = self.palette.iter().take(1 << bits).map(|color| [color.r(), color.g(), color.b()]);
        IndexedPicture {
            name: "texture".into(),
            width,
            height,
            mip_levels: false,
            palette: palette.collect(),
            texels: self.texels.chunks(8 / bits).map(|texels| pack(texels) as u8).collect(), // 8 bits in all
            color,
            error: 0,
        }
    }

    /// The bytes of flash that texels and palette take.
    pub(crate) fn flash_bytes(&self) -> usize {
        self.picture(String::from("Rgb565")).flash_bytes()
    }
}

/// The exponent of the coordinates' unit, in sides of the texture: a model of the largest size repeats the texture four times.
pub(crate) const UNIT: i8 = -14;

/// The warning about a model whose texture coordinates the planner makes.
pub(crate) const BY_SIDES: &str = "no texture coordinates: the picture is laid on from six sides; to choose, unwrap the model (UV) and export it as OBJ";

/// Where the texture coordinates of faces come from.
#[derive(Clone, Copy)]
pub(crate) enum Coordinates<'a> {
    OfFile(TextureCoords<'a>),
    /// Computed from two of each corner's coordinates.
    BySides(&'a Mesh<'a>),
}

impl<'a> Coordinates<'a> {
    pub(crate) fn of(model: &'a ImportedMesh, mesh: &'a Mesh<'a>) -> Result<Self, String> {
        let of_file = model.texture().map_err(refused::mesh)?;
        Ok(of_file.map_or(Self::BySides(mesh), Self::OfFile))
    }

    /// The exponent of the unit of coordinates, in sides of the texture.
    pub(crate) fn exponent(&self) -> i8 {
        match self {
            Self::OfFile(coords) => coords.exponent(),
            Self::BySides(_) => UNIT,
        }
    }

    pub(crate) fn corners(&self, face: usize) -> [[i16; 2]; 3] {
        match self {
            Self::OfFile(coords) => coords.corners(face),
            Self::BySides(mesh) => corners(mesh, face),
        }
    }
}
