//! Colours, texture coordinates and the picture of a mesh.

use crate::materials::{self, Texture};
use crate::model::{Colors, Model};
use crate::picture::{self, IndexedPicture};
use crate::surface::Surface;
use crate::{Options, Problem, Warning};

/// What the faces show.
pub(crate) struct Attributes {
    pub(crate) colors: Colors,
    pub(crate) texture: Texture,
    pub(crate) picture: Option<IndexedPicture>,
}

impl Attributes {
    /// Finds the attributes of a surface, whose texture coordinates become NaN for faces without a picture, where others have one.
    pub(crate) fn of(surface: &mut Surface, model: &mut Model, options: &Options) -> Result<Self, Problem> {
        let colors = model.colors.take().map_or_else(Colors::default, |colors| {
            let faces = surface.triangles.iter().map(|&triangle| colors.faces[triangle]).collect();
            Colors { faces, ..colors }
        });
        let Model { pictures, warnings, .. } = model;
        let texture = materials::texture(&surface.coords).unwrap_or_else(|warning| {
            warnings.push(warning);
            Texture::default()
        });
        let has_coords = !texture.faces.is_empty();
        let mut picture = None;
        match &options.texture {
            Some(format) if has_coords => picture = picture::read(pictures, format, warnings)?,
            Some(_) => warnings.push(Warning::NoTextureCoords),
            None => warnings.extend(pictures.names.first().map(|first| Warning::PicturesUnwanted {
                count: pictures.names.len(),
                first: first.clone(),
                has_coords,
            })),
        }
        for (corners, &triangle) in surface.coords.iter_mut().zip(&surface.triangles) {
            if picture.is_some() && pictures.bare.get(triangle) == Some(&true) {
                *corners = [[f64::NAN; 2]; 3];
            }
        }
        Ok(Attributes { colors, texture, picture })
    }
}
