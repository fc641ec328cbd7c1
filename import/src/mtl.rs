//! Material libraries (MTL), line by line: a line that is not understood costs that line alone.

use crate::text::{before_comment, number};

/// What a library says of a material. What it does not say is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Material {
    /// The diffuse colour.
    pub(crate) color: Option<[u8; 3]>,
    /// The colour of the light that it emits.
    pub(crate) emission: Option<[u8; 3]>,
    /// The picture of the diffuse colour, as `map_Kd` names it.
    pub(crate) picture: Option<String>,
    /// Whether its opacity (`d`), or else its transparency (`Tr`), makes it transparent.
    pub(crate) is_transparent: Option<bool>,
}

/// A library: its materials by their names, and what was not understood.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Library {
    pub(crate) materials: Vec<(String, Material)>,
    /// The lines, from 1, and why each is passed over.
    pub(crate) doubts: Vec<(usize, &'static str)>,
}

/// Reads the text of a library.
pub(crate) fn read(text: &str) -> Library {
    let mut library = Library::default();
    for (number, line) in (1..).zip(text.lines()) {
        if let Err(doubt) = statement(line.trim(), &mut library.materials) {
            library.doubts.push((number, doubt));
        }
    }
    library
}

/// Takes what a line says, unless it is of no interest here; or says why it cannot be understood.
fn statement(line: &str, materials: &mut Vec<(String, Material)>) -> Result<(), &'static str> {
    let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let word = word.to_ascii_lowercase();
    if word == "newmtl" {
        // A `#` belongs to the name, as in `Material #1`. What follows a material without a name is not of the material before.
        materials.push((rest.trim().to_owned(), Material::default()));
        return if rest.is_empty() { Err("`newmtl` needs a name") } else { Ok(()) };
    }
    let material = materials.last_mut().map(|(_, material)| material).ok_or("no `newmtl` stands before it");
    match &word[..] {
        "kd" => material?.color = Some(color(rest)?),
        "ke" => material?.emission = Some(color(rest)?),
        "map_kd" => material?.picture = picture(rest).map(str::to_owned),
        "d" => {
            let is_transparent = &mut material?.is_transparent;
            *is_transparent = last_number(rest).map(|opacity| opacity < 1.0).or(*is_transparent);
        }
        // Some programs write both, and mean the opacity by both.
        "tr" => {
            let is_transparent = &mut material?.is_transparent;
            *is_transparent = is_transparent.or(last_number(rest).map(|transparency| transparency > 0.0));
        }
        _ => {}
    }
    Ok(())
}

/// The last number of a line: `d -halo 0.5` has an option before it.
fn last_number(text: &str) -> Option<f64> {
    before_comment(text).split_whitespace().next_back().and_then(number)
}

/// A colour of three numbers up to 1, or of one for all channels. What follows them is passed over.
fn color(text: &str) -> Result<[u8; 3], &'static str> {
    let channel = |word: &str| {
        let level: f64 =
            number(word).ok_or("`Kd` and `Ke` need one number, or three: red, green and blue")?;
        Ok((level * 255.0).round().clamp(0.0, 255.0) as u8) // NaN becomes 0
    };
    let mut words = before_comment(text).split_whitespace();
    let red = channel(words.next().unwrap_or_default())?;
    let mut other = || words.next().map_or(Ok(red), channel);
    Ok([red, other()?, other()?])
}

/// The file that `map_Kd` names: the rest of the line behind options, because names may have spaces. Without one there is no
/// picture.
fn picture(text: &str) -> Option<&str> {
    let mut name = text.trim();
    // Options begin with `-` and have numbers, `on` or `off`, or the letter of a channel.
    let is_option =
        |word: &str| word.starts_with('-') || word == "on" || word == "off" || number(word).is_some();
    if name.starts_with('-') {
        while let Some((word, rest)) =
            name.split_once(char::is_whitespace).filter(|(word, _)| is_option(word))
        {
            name = rest.trim_start();
            if word == "-imfchan" || word == "-type" {
                name = name.split_once(char::is_whitespace).map_or(name, |(_, rest)| rest.trim_start());
            }
        }
    }
    Some(name).filter(|name| !name.is_empty())
}
