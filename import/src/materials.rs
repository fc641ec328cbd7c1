//! Materials: diffuse and emissive colours as a palette, the names of their pictures, and texture coordinates on a grid.

use crate::beside::{Beside, Unread};
use crate::model::Colors;
use crate::mtl::{self, Material};
use crate::text::{before_comment, text};
use crate::weld::{Names, Numbered};
use crate::{Element, Place, Warning};
use std::path::PathBuf;

/// The diffuse colour of a material that has none.
const GREY: [u8; 3] = [204; 3];

const BLACK: [u8; 3] = [0; 3];

/// A diffuse colour, and the colour of emitted light.
type Shade = [[u8; 3]; 2];

/// The pictures of the materials that triangles use.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    /// As `map_Kd` names them, in the order of their first use.
    pub(crate) names: Vec<String>,
    /// Whether each triangle has no material, or one without a picture; in builds that read pictures.
    pub(crate) bare: Vec<bool>,
    /// The first one's file and its bytes, if pictures are wanted.
    pub(crate) first: Option<Result<(PathBuf, Vec<u8>), Unread>>,
}

/// The colour of each triangle, by its material or, where that has none, its own, as long as `own` has any; the pictures that the
/// materials name; and the files of these and of libraries. No colours where no triangle has a material or a colour, or no library a
/// material.
pub(crate) fn read(
    (names, of_triangles): (&[String], &[Option<usize>]),
    own: Vec<Option<[u8; 3]>>,
    libraries: &[String],
    beside: &Beside<'_>,
    warnings: &mut Vec<Warning>,
) -> (Option<Colors>, Pictures, Vec<PathBuf>) {
    let (mut pictures, mut paths) = (Pictures::default(), Vec::new());
    let mut known: Vec<(String, Material)> = Vec::new();
    if !names.is_empty() && libraries.is_empty() && own.is_empty() {
        warnings.push(Warning::NoLibrary);
    }
    let mut are_read = !libraries.is_empty();
    let mut seen = Names::default();
    let libraries = libraries.iter().map(|library| &library[..]);
    let libraries = libraries.filter(|library| seen.insert(library, 0).is_none());
    for (name, found) in libraries.flat_map(|names| beside.find_all(names)) {
        if names.is_empty() {
            paths.extend(found.ok().map(|found| found.path)); // no face has a material
            continue;
        }
        let name = name.to_owned();
        match found.and_then(|found| Ok((beside.read(&found)?, found.path))) {
            Ok((bytes, path)) => {
                paths.push(path);
                let library = mtl::read(&text(&bytes));
                if let [(first, problem), ..] = library.doubts[..] {
                    let count = library.doubts.len();
                    warnings.push(Warning::LibraryLines { name, count, first, problem });
                }
                known.extend(library.materials);
            }
            Err(why) => {
                are_read = false;
                warnings.push(Warning::Library { name, why });
            }
        }
    }
    // A `#` may belong to a name, or begin a comment.
    let places: Names<'_> = known.iter().enumerate().map(|(place, (name, _))| (&name[..], place)).collect();
    let place = |name: &String| places.get(&name[..]).or_else(|| places.get(before_comment(name)));
    let named_material = |name: &String| place(name).map(|&place| &known[place].1);
    let unknown: Vec<&String> = names.iter().filter(|name| named_material(name).is_none()).collect();
    if let Some(&first) = unknown.first().filter(|_| are_read || !known.is_empty()) {
        warnings.push(Warning::UnknownMaterials { count: unknown.len(), first: first.clone() });
    }
    if known.is_empty() {
        return (of_faces(own, warnings), pictures, paths);
    }
    let material = |number: Option<usize>| number.and_then(|number| named_material(names.get(number)?));
    let mut named = Names::default();
    for &number in of_triangles {
        let picture = material(number).and_then(|material| material.picture.as_ref());
        if let Some(name) = picture.filter(|name| named.insert(name, 0).is_none()) {
            pictures.names.push(name.clone());
        }
        if cfg!(feature = "textures") {
            pictures.bare.push(picture.is_none());
        }
    }
    let looked_for = pictures.names.iter().filter(|_| cfg!(feature = "textures"));
    for (number, found) in looked_for.map(|name| beside.find(name)).enumerate() {
        paths.extend(found.as_ref().ok().map(|found| found.path.clone()));
        if number == 0 && beside.options.texture.is_some() {
            pictures.first = Some(found.and_then(|found| {
                let bytes = beside.read(&found)?.into_owned();
                Ok((found.path, bytes))
            }));
        }
    }
    let mut covered = 0;
    let shade = |(triangle, &number): (usize, &Option<usize>)| {
        let material = material(number);
        let color = material.and_then(|material| material.color);
        let own = own.get(triangle).copied().flatten();
        covered += usize::from(color.is_some() && own.is_some());
        let color = color.or(own).unwrap_or(GREY);
        [color, material.and_then(|material| material.emission).unwrap_or(BLACK)]
    };
    let shades: Vec<Shade> = of_triangles.iter().enumerate().map(shade).collect();
    let is_transparent = |material: &Material| material.is_transparent == Some(true);
    let transparent: Vec<&String> =
        names.iter().filter(|name| named_material(name).is_some_and(is_transparent)).collect();
    if let [first, ..] = transparent[..] {
        warnings.push(Warning::Transparent { count: transparent.len(), first: first.clone() });
    }
    if covered > 0 {
        let first = Place::Unknown;
        warnings.push(Warning::LeftOut { what: Element::CoveredColors, count: covered, first });
    }
    (Some(colors(&shades, warnings)), pictures, paths)
}

/// The colours of triangles that have no materials; nothing where none has a colour.
pub(crate) fn of_faces(own: Vec<Option<[u8; 3]>>, warnings: &mut Vec<Warning>) -> Option<Colors> {
    let shades: Vec<Shade> = own.into_iter().map(|color| [color.unwrap_or(GREY), BLACK]).collect();
    (!shades.is_empty()).then(|| colors(&shades, warnings))
}

/// Colours with a palette. What it does not hold is a warning.
fn colors(shades: &[Shade], warnings: &mut Vec<Warning>) -> Colors {
    let (colors, count) = palette(shades);
    if count > colors.palette.len() {
        warnings.push(Warning::Colors { count, kept: colors.palette.len() });
    }
    colors
}

/// A palette of the colours, those that are used most if there are more than 256, in the order of their first use, and how
/// many colours there are. Two that differ in the light that they emit are two colours.
fn palette(of_triangles: &[Shade]) -> (Colors, usize) {
    const MOST: usize = 256;
    let (mut numbers, mut uses) = (Numbered::default(), Vec::<(Shade, usize)>::new());
    let mut number_of = |shade: Shade| {
        let [color, emission] = shade.map(|[r, g, b]| u32::from_be_bytes([0, r, g, b]).into());
        let number = *numbers.entry([color, emission, 0]).or_insert(uses.len());
        if number == uses.len() {
            uses.push((shade, 0));
        }
        uses[number].1 += 1;
        number
    };
    let of_triangles: Vec<usize> = of_triangles.iter().map(|&color| number_of(color)).collect();
    let count = uses.len();
    let mut kept = uses.clone();
    kept.sort_unstable_by_key(|&(color, uses)| (std::cmp::Reverse(uses), color));
    kept.truncate(MOST);
    let distance = |a: Shade, b: Shade| -> u32 {
        let channels = a.into_iter().flatten().zip(b.into_iter().flatten());
        channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let mut shown = Vec::<Shade>::new();
    let mut place_of = |&(color, _): &(Shade, usize)| {
        // The nearest of a colour that is kept is itself.
        let nearest = kept.iter().map(|kept| kept.0).min_by_key(|&other| (distance(color, other), other));
        let color = nearest.unwrap_or(color);
        let place = shown.iter().position(|&other| other == color);
        if place.is_none() {
            shown.push(color);
        }
        place.unwrap_or(shown.len() - 1) as u8 // at most 256 different ones are shown
    };
    // The first uses of colours are in this order.
    let places: Vec<u8> = uses.iter().map(&mut place_of).collect();
    let faces = of_triangles.into_iter().map(|number| places[number]).collect();
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
pub(crate) fn texture(faces: &[[[f64; 2]; 3]]) -> Result<Texture, Warning> {
    let on_grid = |c: f64, exponent: i8| (c * crate::grid::power_of_two(-exponent) + 0.5).floor();
    let fits = |c: &f64, exponent: i8| (-32768.0..=32767.0).contains(&on_grid(*c, exponent));
    let all_fit = |exponent: &i8| faces.iter().flatten().flatten().all(|c| fits(c, *exponent));
    let exponent = (-15..=0).find(all_fit).ok_or(Warning::TextureCoordsFar)?;
    let mut numbers = Numbered::default();
    let mut out = Texture { exponent, ..Texture::default() };
    for face in faces {
        let mut corners = [0; 3];
        for (corner, coord) in corners.iter_mut().zip(face) {
            let coord = coord.map(|c| on_grid(c, exponent) as i16); // it fits
            let [u, v] = coord.map(|c| c as u64); // as many as there are
            let number = *numbers.entry([u, v, 0]).or_insert_with(|| {
                out.coords.push(coord);
                out.coords.len() - 1
            });
            *corner = u16::try_from(number).map_err(|_| Warning::TextureCoordsMany)?;
        }
        out.faces.push(corners);
    }
    Ok(out)
}
