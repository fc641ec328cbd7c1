//! Materials: diffuse and emissive colours as a palette, the names of their pictures, and texture coordinates on a grid.

use crate::model::{Colors, TextureFaces};
use crate::Warning;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The diffuse colour of a material that has none.
const GREY: [u8; 3] = [204; 3];

const BLACK: [u8; 3] = [0; 3];

/// A diffuse colour, and the colour of emitted light.
type Shade = [[u8; 3]; 2];

/// What a library says of a material.
#[derive(Clone, Default)]
struct Material {
    color: [u8; 3],
    /// The colour of the light that it emits.
    emission: [u8; 3],
    /// The picture of the diffuse colour, as `map_Kd` names it.
    picture: Option<String>,
}

/// The pictures of the materials that triangles use.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    /// As `map_Kd` names them, in the order of their first use.
    pub(crate) names: Vec<String>,
    /// How many triangles have a material without a picture, or none.
    pub(crate) bare: usize,
}

/// The colour of each triangle, by its material, and the pictures that the materials name. No colours where no triangle has a
/// material, or no library can be read. Libraries lie beside the model: as files that were given with it, or in its folder.
pub(crate) fn read(
    names: &[String],
    of_triangles: Vec<Option<usize>>,
    libraries: &[String],
    (file, beside): (&Path, &[(String, Vec<u8>)]),
    warnings: &mut Vec<Warning>,
) -> (Option<Colors>, Pictures) {
    let mut pictures = Pictures::default();
    if names.is_empty() {
        return (None, pictures);
    }
    let mut known = HashMap::new();
    for name in libraries {
        match library(name, file, beside) {
            Ok(materials) => known.extend(materials),
            Err(problem) => warnings.push(Warning::Library { name: name.clone(), problem }),
        }
    }
    if known.is_empty() {
        if libraries.is_empty() {
            warnings.push(Warning::NoLibrary);
        }
        return (None, pictures);
    }
    let unknown: Vec<&String> = names.iter().filter(|name| !known.contains_key(*name)).collect();
    if let Some(first) = unknown.first() {
        warnings.push(Warning::UnknownMaterials { count: unknown.len(), first: first.to_string() });
    }
    let material = |number: Option<usize>| number.and_then(|number| known.get(names.get(number)?));
    for &number in &of_triangles {
        match material(number).and_then(|material| material.picture.as_ref()) {
            Some(name) if !pictures.names.contains(name) => pictures.names.push(name.clone()),
            Some(_) => {}
            None => pictures.bare += 1,
        }
    }
    let shade = |number: Option<usize>| {
        material(number).map_or([GREY, BLACK], |material| [material.color, material.emission])
    };
    let of_triangles: Vec<Shade> = of_triangles.into_iter().map(shade).collect();
    let (colors, count) = palette(&of_triangles);
    if count > colors.palette.len() {
        warnings.push(Warning::Colors { count, kept: colors.palette.len() });
    }
    (Some(colors), pictures)
}

/// The file of a material library or a picture, beside the model, if it is there.
pub(crate) fn find(name: &str, model: &Path) -> Option<PathBuf> {
    let folder = model.parent().unwrap_or(Path::new(""));
    // A name may be written with the separators of another system.
    let paths = [folder.join(name), folder.join(name.replace('\\', "/"))];
    paths.into_iter().find(|path| path.is_file())
}

/// The materials of a library, by their names.
fn library(
    name: &str,
    model: &Path,
    beside: &[(String, Vec<u8>)],
) -> Result<HashMap<String, Material>, String> {
    let last = name.rsplit(['/', '\\']).next();
    let bytes = match beside.iter().find(|(other, _)| Some(&other[..]) == last) {
        Some((_, bytes)) => Cow::Borrowed(&bytes[..]),
        None => {
            let path = find(name, model).ok_or("is not there")?;
            Cow::Owned(crate::bytes(&path).map_err(|error| error.problem.to_string())?)
        }
    };
    // Other lines of a material are ignored, so errors in them do no harm.
    let is_used =
        |line: &&str| matches!(line.split_whitespace().next(), Some("newmtl" | "Kd" | "Ke" | "map_Kd"));
    // A `map_Kd` without a name counts as no picture; tobj would refuse the whole library.
    let is_named = |line: &&str| line.split_whitespace().nth(1).is_some();
    let text: String = crate::text::text(&bytes)
        .lines()
        .filter(is_used)
        .filter(|line| is_named(line) || !line.trim_start().starts_with("map_Kd"))
        .flat_map(|line| [line, "\n"])
        .collect();
    let (materials, _) = tobj::load_mtl_buf(&mut text.as_bytes())
        .map_err(|_| "cannot be understood: newmtl has a name, Kd and Ke have three numbers")?;
    let material = |material: tobj::Material| {
        let channels = |color: [f64; 3]| color.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8); // NaN becomes 0
        let color = material.diffuse.map_or(GREY, channels);
        let emission = material.emissive.map_or(BLACK, channels);
        let picture = material.diffuse_texture.map(|text| file_name(&text));
        (material.name, Material { color, emission, picture })
    };
    Ok(materials.into_iter().map(material).collect())
}

/// The file that `map_Kd` names: the rest of the line, because names may have spaces, or only its last word if options come
/// first.
fn file_name(text: &str) -> String {
    let name = match text.starts_with('-') {
        true => text.split_whitespace().next_back().unwrap_or_default(),
        false => text.trim(),
    };
    name.to_string()
}

/// A palette of the colours, those that are used most if there are more than 256, in the order of their first use, and how
/// many colours there are. Two that differ in the light that they emit are two colours.
fn palette(of_triangles: &[Shade]) -> (Colors, usize) {
    const MOST: usize = 256;
    let mut uses = HashMap::<Shade, usize>::new();
    for &color in of_triangles {
        *uses.entry(color).or_default() += 1;
    }
    let count = uses.len();
    let mut by_use: Vec<(Shade, usize)> = uses.into_iter().collect();
    by_use.sort_unstable_by_key(|&(color, uses)| (std::cmp::Reverse(uses), color));
    by_use.truncate(MOST);
    let kept: HashMap<Shade, usize> = by_use.into_iter().collect();
    let distance = |a: Shade, b: Shade| -> u32 {
        let channels = a.into_iter().flatten().zip(b.into_iter().flatten());
        channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let nearest = |color: Shade| {
        kept.keys().copied().min_by_key(|&other| (distance(color, other), other)).unwrap_or(color)
    };
    let mut shown = Vec::<Shade>::new();
    let mut numbers = HashMap::<Shade, usize>::new();
    let mut faces = Vec::new();
    for &color in of_triangles {
        let number = *numbers.entry(color).or_insert_with(|| {
            let color = if kept.contains_key(&color) { color } else { nearest(color) };
            let place = shown.iter().position(|&other| other == color);
            if place.is_none() {
                shown.push(color);
            }
            place.unwrap_or(shown.len() - 1)
        });
        faces.push(number as u8); // at most 256 different ones are shown
    }
    let mut emission: Vec<_> = shown.iter().map(|&[_, emission]| emission).collect();
    if emission.iter().all(|&emission| emission == BLACK) {
        emission.clear();
    }
    (Colors { palette: shown.into_iter().map(|[color, _]| color).collect(), emission, faces }, count)
}

/// Texture coordinates of a mesh.
#[derive(Default)]
pub(crate) struct Texture {
    pub(crate) coords: Vec<[i16; 2]>,
    pub(crate) faces: Vec<[u16; 3]>,
    /// The unit is 2 to this power of a texture's side.
    pub(crate) exponent: i8,
}

/// Rounds texture coordinates to the finest power-of-two grid on which they fit `i16`, up half way, so that equal
/// distances round to equal ones below zero, too; each pair once. The error of a coordinate is half a unit.
///
/// # Errors
///
/// The warning where they do not fit.
pub(crate) fn texture(
    texture: &TextureFaces,
    faces: impl Iterator<Item = [usize; 3]>,
) -> Result<Texture, Warning> {
    let faces: Vec<[usize; 3]> = faces.collect();
    let used = || faces.iter().flatten().filter_map(|&i| texture.coords.get(i));
    let on_grid = |c: f64, exponent: i8| (c * crate::grid::power_of_two(-exponent) + 0.5).floor();
    let fits =
        |exponent: &i8| used().flatten().all(|&c| (-32768.0..=32767.0).contains(&on_grid(c, *exponent)));
    let exponent = (-15..=0).find(fits).ok_or(Warning::TextureCoordsFar)?;
    let mut numbers = HashMap::new();
    let mut out = Texture { exponent, ..Texture::default() };
    for face in &faces {
        let mut corners = [0; 3];
        for (corner, &index) in corners.iter_mut().zip(face) {
            let coord = texture.coords.get(index).copied().unwrap_or_default();
            let coord = coord.map(|c| on_grid(c, exponent) as i16); // it fits
            let number = *numbers.entry(coord).or_insert_with(|| {
                out.coords.push(coord);
                out.coords.len() - 1
            });
            *corner = u16::try_from(number).map_err(|_| Warning::TextureCoordsMany)?;
        }
        out.faces.push(corners);
    }
    Ok(out)
}
