//! What textured faces show, and where on them.

use crate::choice::Choice;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::TexelSlice;
use pinhole_import::{ImportedMesh, Warning};
use std::collections::HashMap;

/// What textured faces show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pattern {
    /// Squares of the choice's colour and of a quarter of it.
    Checker,
    /// A grid of lines.
    Grid,
    /// The picture that was loaded.
    File,
}

impl Pattern {
    pub(crate) const ALL: [(&'static str, Self); 3] =
        [("checker", Self::Checker), ("grid", Self::Grid), ("file", Self::File)];
}

/// The texels of a picture, row by row. Its sides are powers of two, 8 … 256.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct TextureImage {
    texels: Vec<Rgb888>,
    width: usize,
}

/// Texels on a side of a ready pattern.
const SIDE: usize = 32;

impl TextureImage {
    /// From red, green, blue and opacity of each texel.
    ///
    /// # Errors
    ///
    /// Sides that a texture cannot have.
    pub(crate) fn from_rgba(bytes: &[u8], width: usize) -> Result<Self, String> {
        let texel = |texel: &[u8]| match texel {
            [r, g, b, ..] => Rgb888::new(*r, *g, *b),
            _ => Rgb888::BLACK,
        };
        let image = Self { texels: bytes.chunks_exact(4).map(texel).collect(), width };
        image.slice().map(|_| ())?;
        Ok(image)
    }

    /// A ready pattern in the colour of a choice. `None` for the picture that was loaded.
    pub(crate) fn ready(choice: &Choice) -> Option<Self> {
        let [light, dark] = [1, 4].map(|part| {
            Rgb888::new(choice.color.r() / part, choice.color.g() / part, choice.color.b() / part)
        });
        let is_light: fn(usize, usize) -> bool = match choice.texture {
            Pattern::File => return None,
            Pattern::Checker => |x, y| (x ^ y) & (SIDE / 4) == 0,
            Pattern::Grid => |x, y| x % (SIDE / 2) >= 3 && y % (SIDE / 2) >= 3,
        };
        let texels = (0..SIDE * SIDE).map(|i| if is_light(i % SIDE, i / SIDE) { light } else { dark });
        Some(Self { texels: texels.collect(), width: SIDE })
    }

    /// Columns and rows.
    pub(crate) fn sides(&self) -> [usize; 2] {
        [self.width, self.texels.len().checked_div(self.width).unwrap_or(0)]
    }

    fn slice(&self) -> Result<TexelSlice<'_, Rgb888>, String> {
        let [width, height] = self.sides();
        TexelSlice::new(&self.texels, width, height).map_err(|e| e.to_string())
    }

    /// The texels.
    ///
    /// # Errors
    ///
    /// Where no picture was loaded.
    pub(crate) fn texels(&self) -> Result<TexelSlice<'_, Rgb888>, String> {
        if self.texels.is_empty() {
            return Err("no picture: drop a PNG, BMP or JPEG file, or choose a ready pattern".into());
        }
        self.slice()
    }
}

/// Units of a coordinate that the texture's side takes: a model that is as large as coordinates allow shows it four times.
const UNIT: i8 = -14;

/// Texture coordinates for a mesh that has none, with a warning: each face takes them from the two axes that it faces least.
pub(crate) fn map_by_axes(mesh: &mut ImportedMesh) {
    let mut numbers = HashMap::new();
    let (mut coords, mut faces) = (Vec::new(), Vec::with_capacity(mesh.faces.len()));
    for (face, corners) in mesh.faces.iter().enumerate() {
        let normal = mesh.normals.get(face).copied().unwrap_or_default();
        let [x, y, z] = normal.map(i16::unsigned_abs);
        let mut numbered = [0; 3];
        for (number, &vertex) in numbered.iter_mut().zip(corners) {
            let [px, py, pz] = mesh.vertices.get(usize::from(vertex)).copied().unwrap_or_default();
            // v runs down, so that the picture stands upright on the sides. Coordinates are within ±32767.
            let coord = match (x >= y && x >= z, y >= z) {
                (true, _) => [if normal[0] > 0 { -pz } else { pz }, -py],
                (_, true) => [px, if normal[1] > 0 { pz } else { -pz }],
                _ => [if normal[2] > 0 { px } else { -px }, -py],
            };
            *number = *numbers.entry(coord).or_insert_with(|| {
                coords.push(coord);
                coords.len() - 1
            });
        }
        faces.push(numbered);
    }
    let message = if coords.len() > 1 << 16 {
        "no texture coordinates, and too many corners to make some: use pinhole-import --decimate N"
    } else {
        (mesh.texture_coords, mesh.texture_exponent) = (coords, UNIT);
        // Below 65 536.
        mesh.texture_faces = faces.iter().map(|face| face.map(|number| number as u16)).collect();
        "no texture coordinates: the picture is laid on from six sides; for coordinates of your own, unwrap the model (UV) in the program that made it and export an OBJ file with `vt` lines"
    };
    mesh.warnings.push(Warning { line: None, message: message.into() });
}
