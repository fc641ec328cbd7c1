//! STL to triangles; ASCII is turned into binary first. Normals are passed over.

mod ascii;

use crate::materials;
use crate::model::{Model, Places};
use crate::text::{is_utf16, text};
use crate::weld::Numbered;
use crate::{Element, ImportError, Options, Place, Problem, Triangles, Warning, LARGEST_FILE};
use std::path::Path;

/// Header, count and triangles of a binary file.
const HEADER: usize = 80;
const COUNT: usize = 4;
const TRIANGLE: usize = 50;

/// Reads STL; `file` is only named in errors. Vertices with the same bits are one.
pub(crate) fn read(bytes: Vec<u8>, file: &Path, options: &Options) -> Result<Model, ImportError> {
    let as_it_is = |problem: Problem| problem.at(file, None);
    if let Some(name) = options.objects.first() {
        return Err(as_it_is(Problem::NoSuchObject { name: name.clone(), names: Vec::new() }));
    }
    if is_text(&bytes) || is_utf16(&bytes) && is_text(text(&bytes).as_bytes()) {
        let ascii::Text { binary, lines, unended, colors } =
            ascii::to_binary(&text(&bytes)).map_err(|(problem, line)| problem.at(file, line))?;
        let triangles = triangles(&binary);
        let cut = unended.map(|line| Warning::NoEndsolid { line });
        let what = Element::TextColors;
        let left = colors.map(|(count, line)| Warning::LeftOut { what, count, first: Place::Line(line) });
        let warnings = cut.into_iter().chain(left).collect();
        return Ok(Model { triangles, places: Places::Lines(lines), warnings, ..Model::default() });
    }
    let given = bytes.len() as u64;
    let needed = declared_length(&bytes).unwrap_or((HEADER + COUNT) as u64);
    if given < needed {
        // Four bytes of ASCII text are larger than any count of triangles in a file that is small enough to be read.
        let is_text = bytes.get(..HEADER + COUNT).is_some_and(|head| !head.contains(&0));
        return Err(as_it_is(match is_text {
            true => Problem::Syntax(
                "is text, but no ASCII STL, which begins with `solid`: if it is an OBJ file, name it .obj, otherwise download or export it again",
            ),
            false if needed > LARGEST_FILE => Problem::Syntax(
                "is not an STL file, as it would have more than 1 GiB by its count of triangles: export .obj or .stl",
            ),
            false => Problem::Truncated { needed, given },
        }));
    }
    let mut warnings = Vec::new();
    if given > needed {
        warnings.push(Warning::BytesAfter { count: given - needed });
    }
    let bytes = &bytes[..needed as usize];
    if let Some(byte) = first_not_finite(bytes) {
        return Err(as_it_is(Problem::NotFiniteAt { byte }));
    }
    let triangles = triangles(bytes);
    let own = if options.materials_only { Vec::new() } else { self::colors(bytes) };
    let colors = materials::of_faces(own, &mut warnings);
    Ok(Model { triangles, places: Places::Records, warnings, colors, ..Model::default() })
}

/// Whether the file is one of text, with a solid or, without that line, a facet, below comments. A binary one may begin with
/// "solid" too, but then it has its length, or a zero in its header or its count.
fn is_text(bytes: &[u8]) -> bool {
    let mut start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    while start.starts_with(b"#") {
        let end = start.iter().position(|byte| b"\r\n".contains(byte)).unwrap_or(start.len());
        start = start.get(end..).unwrap_or_default().trim_ascii_start();
    }
    let begins = |word: &[u8]| start.get(..5).is_some_and(|start| start.eq_ignore_ascii_case(word));
    let head = &bytes[..bytes.len().min(HEADER + COUNT)];
    (begins(b"solid") || begins(b"facet"))
        && declared_length(bytes) != Some(bytes.len() as u64)
        && !head.contains(&0)
}

/// How long a binary file with this start must be.
fn declared_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER..HEADER + COUNT)?;
    let count = u32::from_le_bytes(count.try_into().ok()?);
    Some((HEADER + COUNT) as u64 + u64::from(count) * TRIANGLE as u64)
}

/// The place of the first coordinate of a binary file that is not a finite number. Normals are not looked at.
fn first_not_finite(bytes: &[u8]) -> Option<usize> {
    (HEADER + COUNT..bytes.len()).step_by(TRIANGLE).find_map(|triangle| {
        (triangle + 12..triangle + 48).step_by(4).find(|&at| {
            let number = bytes.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
            !number.is_some_and(|number| f32::from_le_bytes(number).is_finite())
        })
    })
}

/// The triangles of a binary file. Not by `stl_io`: of that, ten lines would be used, which brought in its reader of text, 18 KB of the
/// planner's page.
fn triangles(stl: &[u8]) -> Triangles {
    let (mut numbers, mut out) = (Numbered::default(), Triangles::default());
    for record in stl.get(HEADER + COUNT..).unwrap_or_default().chunks_exact(TRIANGLE) {
        // The normal, and behind the corners two bytes that mean nothing.
        let mut words = record.chunks_exact(4).skip(3).filter_map(|word| word.first_chunk().copied());
        let mut number = || f32::from_le_bytes(words.next().unwrap_or_default());
        out.faces.push([(); 3].map(|()| {
            let vertex = [number(), number(), number()];
            *numbers.entry(vertex.map(|c| c.to_bits().into())).or_insert_with(|| {
                out.positions.push(vertex.map(f64::from));
                out.positions.len() - 1
            })
        }));
    }
    out
}

/// The highest bit of a facet's two bytes.
const TOP: u16 = 1 << 15;

/// The colour of each facet, by either of two conventions for its last two bytes, five bits a channel; or nothing where none has one.
///
/// VisCAM and SolidView write red above green above blue, and set the highest bit where these are a colour. Materialise Magics
/// writes `COLOR=` and the colour of the whole, red, green, blue and opacity, into the header, and in each facet blue above green
/// above red, unless the highest bit is set, with which a facet has the colour of the whole. Where no facet says anything, all
/// have that colour.
fn colors(stl: &[u8]) -> Vec<Option<[u8; 3]>> {
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
