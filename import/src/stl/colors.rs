//! Colours in the last two bytes of the facets of a binary STL file, five bits a channel, by either of two conventions.

use super::{COUNT, HEADER, TRIANGLE};

/// The highest bit of a facet's two bytes.
const TOP: u16 = 1 << 15;

/// The colour of each facet, or nothing where none has one.
///
/// VisCAM and SolidView write red above green above blue, and set the highest bit where these are a colour. Materialise Magics
/// writes `COLOR=` and the colour of the whole, red, green, blue and opacity, into the header, and in each facet blue above green
/// above red, unless the highest bit is set, with which a facet has the colour of the whole. Where no facet says anything, all
/// have that colour.
pub(super) fn of_facets(stl: &[u8]) -> Vec<Option<[u8; 3]>> {
    let facets = stl.get(HEADER + COUNT..).unwrap_or_default().chunks_exact(TRIANGLE);
    let values: Vec<u16> =
        facets.map(|facet| facet.last_chunk().map_or(0, |bytes| u16::from_le_bytes(*bytes))).collect();
    let channels = |value: u16| [0, 5, 10].map(|bit| level(value >> bit & 31));
    match of_the_whole(stl) {
        Some(whole) if values.iter().all(|&value| value == 0) => vec![Some(whole); values.len()],
        Some(whole) => {
            values.iter().map(|&value| Some(if value & TOP == 0 { channels(value) } else { whole })).collect()
        }
        None if values.iter().all(|value| value & TOP == 0) => Vec::new(),
        None => {
            let color = |&value: &u16| {
                let [blue, green, red] = channels(value);
                (value & TOP != 0).then_some([red, green, blue])
            };
            values.iter().map(color).collect()
        }
    }
}

/// The nearest of 256 levels to one of 32.
fn level(of_32: u16) -> u8 {
    ((u32::from(of_32) * 255 + 15) / 31) as u8 // at most 255
}

/// The colour in the header, without its opacity.
fn of_the_whole(stl: &[u8]) -> Option<[u8; 3]> {
    const KEY: &[u8] = b"COLOR=";
    let header = stl.get(..HEADER)?;
    let place = header.windows(KEY.len()).position(|bytes| bytes == KEY)? + KEY.len();
    header.get(place..place + 4)?.first_chunk().copied()
}
