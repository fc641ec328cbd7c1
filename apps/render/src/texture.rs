//! Textures of scenes: coordinates, and a size or a picture.

use crate::json::{self, Whole};
use crate::picture;
use embedded_graphics::pixelcolor::Rgb888;
use pinhole_import::{Preview, Triangles};
use serde::Deserialize;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A texture on the triangles of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneTexture {
    /// The coordinates of each triangle's corners in texels: u to the right, v down, from the upper left corner.
    pub uv: Vec<[[f64; 2]; 3]>,
    /// Whether each triangle shows its own colour instead; or nothing, where all show the texture.
    pub bare: Vec<bool>,
    /// Columns and rows: powers of two from 8 to 256.
    pub size: [usize; 2],
    /// Whether the edge of the picture continues beyond it, in place of another copy of the picture.
    pub clamped: bool,
    /// The texels row by row, if the scene names a picture; and its file.
    pub picture: Option<(Vec<[u8; 3]>, PathBuf)>,
}

/// Texture coordinates in the library's format: in 2^exponent of the texture's sides.
#[derive(Clone, Debug)]
pub struct QuantisedTexture {
    pub uv: Vec<[[i16; 2]; 3]>,
    pub exponent: i8,
}

/// The fields of a scene file.
pub(crate) struct Fields {
    pub(crate) uv: Option<Value>,
    pub(crate) texture: Option<Value>,
    pub(crate) wrap: Option<Wrap>,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Wrap {
    Repeat,
    Clamp,
}

/// The texture of a scene file in this folder. The error names the field.
pub(crate) fn read(fields: Fields, folder: &Path, mesh: &Triangles) -> Result<Option<SceneTexture>, String> {
    let (uv, texture, clamped) = match fields {
        Fields { uv: None, texture: None, wrap: None } => return Ok(None),
        Fields { uv: Some(uv), texture: Some(texture), wrap } => (uv, texture, wrap == Some(Wrap::Clamp)),
        Fields { uv: Some(_), .. } => return Err("texture: is missing, and uv is given".into()),
        Fields { uv: None, .. } => return Err("uv: is missing, and texture or wrap is given".into()),
    };
    let (size, picture) = match texture.as_str() {
        Some(name) => {
            let path = folder.join(name);
            let (size, pixels) =
                picture::read_file(&path, 256).map_err(|problem| format!("texture: {problem}"))?;
            (size, Some((pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect(), path)))
        }
        None => {
            let size: [Whole<1, 65_536>; 2] = json::field(texture, "texture")?;
            (size.map(|side| side.0 as usize), None)
        }
    };
    if let Some(side) = size.into_iter().find(|side| !side.is_power_of_two() || *side < 8 || *side > 256) {
        return Err(format!("texture: has a side of {side}, which is none of 8, 16, 32, 64, 128, 256"));
    }
    Ok(Some(SceneTexture { uv: read_uv(uv, mesh)?, bare: Vec::new(), size, clamped, picture }))
}

/// A pair for each vertex, or three for each triangle.
fn read_uv(uv: Value, mesh: &Triangles) -> Result<Vec<[[f64; 2]; 3]>, String> {
    let counted = |given: usize, count: usize, what: &str| match given == count {
        true => Ok(()),
        false => Err(format!("uv: has {given} entries, but there are {count} {what}")),
    };
    if uv[0][0].is_array() {
        let corners: Vec<[[f64; 2]; 3]> = json::field(uv, "uv")?;
        return counted(corners.len(), mesh.faces.len(), "triangles").map(|()| corners);
    }
    let pairs: Vec<[f64; 2]> = json::field(uv, "uv")?;
    counted(pairs.len(), mesh.positions.len(), "vertices")?;
    Ok(mesh.faces.iter().map(|face| face.map(|vertex| pairs[vertex])).collect())
}

/// The texture of an imported model, if it has a picture.
pub fn of_model(model: &Preview) -> Option<SceneTexture> {
    let picture = model.mesh.as_ref().ok()?.picture.as_ref()?;
    let size = [picture.width, picture.height];
    let bare: Vec<_> = model.texture.iter().map(|corners| corners[0][0].is_nan()).collect();
    let scale = |[u, v]: [f64; 2]| [u * size[0] as f64, v * size[1] as f64];
    let all_scaled = |(corners, &bare): (&[[f64; 2]; 3], &bool)| match bare {
        true => [[0.0; 2]; 3],
        false => corners.map(scale),
    };
    let texels =
        (0..size[0] * size[1]).map(|i| picture.color(i % picture.width, i / picture.width)).collect();
    let uv = model.texture.iter().zip(&bare).map(all_scaled).collect();
    let picture = Some((texels, PathBuf::from(&picture.name)));
    Some(SceneTexture { uv, bare, size, clamped: false, picture })
}

impl SceneTexture {
    /// Rounds coordinates to the finest unit of 2⁻¹⁵ to 1 of a side in which all fit `i16`.
    pub fn quantised(&self) -> Result<QuantisedTexture, String> {
        let on_grid = |uv: [f64; 2], exponent: i8| {
            [0, 1].map(|i| (uv[i] / self.size[i] as f64 * 2f64.powi(-i32::from(exponent)) + 0.5).floor())
        };
        let all = || self.uv.iter().flatten();
        let fits = |&exponent: &i8| {
            all().flat_map(|&uv| on_grid(uv, exponent)).all(|c| (-32_768.0..=32_767.0).contains(&c))
        };
        let exponent = (-15..=0).find(fits).ok_or("uv: goes beyond 32767 sides of the texture")?;
        let round = |uv: [f64; 2]| on_grid(uv, exponent).map(|c| c as i16); // it fits
        Ok(QuantisedTexture { uv: self.uv.iter().map(|corners| corners.map(round)).collect(), exponent })
    }

    /// The texture with these coordinates instead.
    pub fn with(&self, quantised: &QuantisedTexture) -> Self {
        let unit = 2f64.powi(i32::from(quantised.exponent));
        let number = |uv: [i16; 2]| [0, 1].map(|i| f64::from(uv[i]) * unit * self.size[i] as f64);
        Self { uv: quantised.uv.iter().map(|corners| corners.map(number)).collect(), ..self.clone() }
    }

    /// The texels in a display's colours.
    pub fn colours<C: From<Rgb888>>(&self) -> Option<Vec<C>> {
        let (texels, _) = self.picture.as_ref()?;
        Some(texels.iter().map(|&[r, g, b]| Rgb888::new(r, g, b).into()).collect())
    }
}
