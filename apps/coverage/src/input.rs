//! The input file. It is parsed as a stream, so that a million triangles take no more memory than they need. Numbers are
//! parsed from their text, so that none is rounded first.

use pinhole::raster::{Pixel, ScreenPoint, GUARD_BAND};
use serde::de::{DeserializeSeed, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::Deserializer;
use serde_json::value::RawValue;
use std::cell::Cell;
use std::fmt;

const LARGEST: i64 = 4096;
const LIMIT: i64 = GUARD_BAND as i64 * 256;
/// The documented range is symmetric; `Pixel` could hold -32768 too.
const FARTHEST: i64 = 32_767;

pub(crate) struct Input {
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) triangles: Vec<[ScreenPoint; 3]>,
    pub(crate) lines: Vec<[Pixel; 2]>,
}

impl Input {
    /// Parses the file. The error names the field and what is wrong with it.
    pub(crate) fn parse(text: &[u8]) -> Result<Self, String> {
        let text = str::from_utf8(text).map_err(|e| format!("is not JSON: {e}"))?;
        let place = Cell::new(Place::default());
        let mut json = serde_json::Deserializer::from_str(text);
        let whole = json.deserialize_map(Whole(&place)).and_then(|input| json.end().map(|()| input));
        whole.map_err(|error| {
            let prefix = if error.is_data() { "" } else { "is not JSON: " };
            format!("{}{prefix}{error}", place.get())
        })
    }
}

/// The field being read, for messages.
#[derive(Clone, Copy, Default)]
struct Place {
    field: Option<&'static str>,
    item: Option<usize>,
    number: Option<usize>,
}

impl Place {
    fn field(field: &'static str) -> Self {
        Self { field: Some(field), ..Self::default() }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(field) = self.field else { return Ok(()) };
        f.write_str(field)?;
        for index in [self.item, self.number].into_iter().flatten() {
            write!(f, "[{index}]")?;
        }
        f.write_str(": ")
    }
}

/// The root object.
struct Whole<'a>(&'a Cell<Place>);

impl<'de> Visitor<'de> for Whole<'_> {
    type Value = Input;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with width, height, triangles and lines")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Input, A::Error> {
        let place = self.0;
        let (mut width, mut height) = (None, None);
        let (mut triangles, mut lines) = (None, None);
        while let Some(key) = map.next_key::<String>()? {
            let field = match key.as_str() {
                "width" => "width",
                "height" => "height",
                "triangles" => "triangles",
                "lines" => "lines",
                _ => return Err(Error::custom(format_args!("{key}: is not a field of this format"))),
            };
            place.set(Place::field(field));
            let twice = match field {
                "width" => width.is_some(),
                "height" => height.is_some(),
                "triangles" => triangles.is_some(),
                _ => lines.is_some(),
            };
            if twice {
                return Err(Error::custom("is given twice"));
            }
            match field {
                "width" => width = Some(map.next_value_seed(Number(1, LARGEST))?),
                "height" => height = Some(map.next_value_seed(Number(1, LARGEST))?),
                "triangles" => triangles = Some(map.next_value_seed(List(place, triangle))?),
                _ => lines = Some(map.next_value_seed(List(place, line))?),
            }
            place.set(Place::default());
        }
        let needed = |field: &'static str, value: Option<i64>| {
            place.set(Place::field(field));
            value.ok_or(Error::custom("is missing"))
        };
        let (width, height) = (needed("width", width)?, needed("height", height)?);
        place.set(Place::default());
        Ok(Input {
            width: width as u16, // at most 4096
            height: height as u16,
            triangles: triangles.unwrap_or_default(),
            lines: lines.unwrap_or_default(),
        })
    }
}

/// A triangle of numbers in ±`LIMIT`.
fn triangle([x0, y0, x1, y1, x2, y2]: [i64; 6]) -> Option<[ScreenPoint; 3]> {
    let point = |x: i64, y: i64| ScreenPoint::from_subpixels(x.try_into().ok()?, y.try_into().ok()?);
    Some([point(x0, y0)?, point(x1, y1)?, point(x2, y2)?])
}

fn line([x0, y0, x1, y1]: [i64; 4]) -> Option<[Pixel; 2]> {
    let pixel = |x: i64, y: i64| Some(Pixel { x: x.try_into().ok()?, y: y.try_into().ok()? });
    Some([pixel(x0, y0)?, pixel(x1, y1)?])
}

/// An array of triangles or lines of N numbers.
struct List<'a, T, const N: usize>(&'a Cell<Place>, fn([i64; N]) -> Option<T>);

impl<'de, T, const N: usize> DeserializeSeed<'de> for List<'_, T, N> {
    type Value = Vec<T>;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Vec<T>, D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de, T, const N: usize> Visitor<'de> for List<'_, T, N> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of arrays of {N} integers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
        let mut items = Vec::new();
        loop {
            let place = self.0;
            place.set(Place { item: Some(items.len()), number: None, ..place.get() });
            match list.next_element_seed(Item(place, self.1))? {
                Some(item) => items.push(item),
                None => return Ok(items),
            }
        }
    }
}

/// One triangle or line of N numbers.
struct Item<'a, T, const N: usize>(&'a Cell<Place>, fn([i64; N]) -> Option<T>);

impl<'de, T, const N: usize> DeserializeSeed<'de> for Item<'_, T, N> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<T, D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de, T, const N: usize> Visitor<'de> for Item<'_, T, N> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of {N} integers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut item: A) -> Result<T, A::Error> {
        let limit = if N == 6 { LIMIT } else { FARTHEST };
        let place = self.0.get();
        let mut numbers = [0; N];
        for (index, number) in numbers.iter_mut().enumerate() {
            self.0.set(Place { number: Some(index), ..place });
            let next = item.next_element_seed(Number(-limit, limit))?;
            *number = next.ok_or_else(|| {
                self.0.set(place);
                A::Error::custom(format_args!("has {index} numbers and needs {N}"))
            })?;
        }
        self.0.set(place);
        if item.next_element::<IgnoredAny>()?.is_some() {
            return Err(Error::custom(format_args!("has more than {N} numbers")));
        }
        (self.1)(numbers).ok_or(Error::custom("is out of range"))
    }
}

/// An integer in an inclusive range.
struct Number(i64, i64);

impl<'de> DeserializeSeed<'de> for Number {
    type Value = i64;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<i64, D::Error> {
        let Self(low, high) = self;
        let text = <&RawValue as serde::Deserialize>::deserialize(json)?.get();
        match whole(text) {
            Some(number) if (low..=high).contains(&number) => Ok(number),
            // Out of range, or even of 64 bits.
            _ if is_integer(text) => {
                Err(Error::custom(format_args!("{} is not from {low} to {high}", Short(text))))
            }
            _ => Err(Error::custom(format_args!("{} is not an integer", Short(text)))),
        }
    }
}

/// The value of JSON text that is an integer, also if it is written as 8.0 or 8e2.
fn whole(text: &str) -> Option<i64> {
    let float = || text.parse::<f64>().ok().filter(|v| v.fract() == 0.0 && v.abs() < 1e15);
    text.parse().ok().or_else(|| Some(float()? as i64)) // exact below 2⁵³
}

/// Whether JSON text is a number with neither fraction nor exponent.
fn is_integer(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    digits.bytes().all(|b| b.is_ascii_digit())
}

/// A text of at most 30 characters; the rest is replaced by dots.
struct Short<'a>(&'a str);

impl fmt::Display for Short<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.char_indices().nth(30) {
            Some((end, _)) => write!(f, "{}...", &self.0[..end]),
            None => f.write_str(self.0),
        }
    }
}
