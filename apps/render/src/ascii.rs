//! A picture as text, one character for 2 × 4 pixels: characters are about twice as high as wide, so these pixels are square.

use crate::bands::Report;
use crate::json::Names;
use crate::paint::Subject;
use crate::picture::{luma, picture, Format};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::style::Style;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Characters {
    /// Characters of growing weight.
    Ramp,
    /// Braille patterns: one dot for each pixel.
    Braille,
}

impl Characters {
    pub(crate) const ALL: [(&'static str, Self); 2] = [("ramp", Self::Ramp), ("braille", Self::Braille)];
}

impl Names for Characters {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter()
    }
}

/// The characters from black to white.
const RAMP: &[u8] = b" .:-=+*#%@";
const CELL: [usize; 2] = [2, 4];
/// The bit of each dot in a braille pattern, row by row.
const DOTS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

/// The picture as lines of equal length, bright on a dark terminal, and the statistics of the frame.
pub(crate) fn text(
    subject: &Subject,
    scene: (&Scene, &Quantised),
    style: &Style,
    characters: Characters,
) -> Result<(String, Report), String> {
    let braille = characters == Characters::Braille;
    let style = Style {
        colour: Rgb888::WHITE,
        own_colours: false, // characters show light alone
        background: Rgb888::BLACK,
        dither: braille,
        smooth_faces: false,
        ..*style
    };
    let format = if braille { Format::Mono } else { Format::Gray8 };
    let (pixels, report) = picture(subject, scene, &style, format)?;
    let (width, height) = (scene.0.width as usize, scene.0.height as usize);
    let [across, down] = CELL;
    let mut text = String::new();
    for top in (0..height).step_by(down) {
        for left in (0..width).step_by(across) {
            let light = |x: usize, y: usize| {
                let inside = left + x < width && top + y < height;
                if inside {
                    luma(pixels[(top + y) * width + left + x])
                } else {
                    0
                }
            };
            let cell = (0..down).flat_map(|y| (0..across).map(move |x| (x, y)));
            if braille {
                let dots: u32 = cell.filter(|&(x, y)| light(x, y) > 127).map(|(x, y)| DOTS[y][x]).sum();
                text.extend(char::from_u32(0x2800 + dots));
            } else {
                // At most 255. A character with any covered pixel is not blank.
                let mean = cell.map(|(x, y)| light(x, y)).sum::<u32>() / (across * down) as u32;
                let weight = (mean as usize * RAMP.len() / 256).max(usize::from(mean > 0));
                text.push(RAMP[weight].into());
            }
        }
        text.push('\n');
    }
    Ok((text, report))
}
