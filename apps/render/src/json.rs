//! JSON files, whose errors name the field, such as `triangles[3][2]`.

use crate::projections::Named;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::path::Path;

/// A whole number from `LOW` to `HIGH`, which may be written as 8.0, too.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(try_from = "f64")]
pub struct Whole<const LOW: i32, const HIGH: i32>(pub i32);

impl<const LOW: i32, const HIGH: i32> TryFrom<f64> for Whole<LOW, HIGH> {
    type Error = String;

    fn try_from(number: f64) -> Result<Self, String> {
        if number.fract() != 0.0 {
            return Err(format!("{number} is not a whole number"));
        }
        match (f64::from(LOW)..=f64::from(HIGH)).contains(&number) {
            true => Ok(Self(number as i32)),
            false => Err(format!("{number} is not from {LOW} to {HIGH}")),
        }
    }
}

/// Red, green and blue.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(from = "[Whole<0, 255>; 3]")]
pub(crate) struct Color(pub(crate) [u8; 3]);

impl From<[Whole<0, 255>; 3]> for Color {
    fn from(channels: [Whole<0, 255>; 3]) -> Self {
        Self(channels.map(|channel| channel.0 as u8))
    }
}

/// A value that a text stands for.
pub trait Names: Copy {
    /// The texts and their values.
    fn names() -> impl Iterator<Item = (&'static str, Self)>;

    /// The value of a text. The error lists the known texts.
    fn named(text: &str) -> Result<Self, String> {
        let known = Self::names().find(|(name, _)| *name == text).map(|(_, value)| value);
        known.ok_or_else(|| format!("{text} is not one of {}", Self::list()))
    }

    /// The texts with commas between them.
    fn list() -> String {
        Self::names().map(|(name, _)| name).collect::<Vec<_>>().join(", ")
    }
}

impl Names for Named {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter().map(|named| (named.name, named))
    }
}

/// For `deserialize_with`: a value by its text.
pub(crate) fn name<'de, D: Deserializer<'de>, T: Names>(json: D) -> Result<Option<T>, D::Error> {
    T::named(&String::deserialize(json)?).map(Some).map_err(serde::de::Error::custom)
}

/// Reads a file, which may begin with a byte order mark. The error names the file and the field.
pub fn read<T: DeserializeOwned>(file: &Path) -> Result<T, String> {
    let problem = |problem: String| format!("{}: {problem}", file.display());
    let text = std::fs::read(file).map_err(|e| problem(format!("cannot be read: {e}")))?;
    let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&text);
    // Structures could be read from arrays of their fields, too.
    if text.trim_ascii_start().first().is_some_and(|first| b"[nt\"".contains(first)) {
        return Err(problem("is not an object".into()));
    }
    let mut json = serde_json::Deserializer::from_slice(text);
    let value = located(&mut json, "").map_err(problem)?;
    json.end().map(|()| value).map_err(|error| problem(format!("is not JSON: {error}")))
}

/// Reads the value of a field that has several forms. The error names the field.
pub(crate) fn field<T: DeserializeOwned>(value: Value, place: &str) -> Result<T, String> {
    located(value, place)
}

fn located<'de, T: Deserialize<'de>>(
    json: impl Deserializer<'de, Error = serde_json::Error>,
    place: &str,
) -> Result<T, String> {
    serde_path_to_error::deserialize(json).map_err(|error| {
        let path = error.path().to_string();
        // `?` for a key that ends too soon.
        let path = if [".", "?"].contains(&path.as_str()) { "" } else { &path };
        let is_data = error.inner().is_data();
        let problem = format!("{}{}", if is_data { "" } else { "is not JSON: " }, error.inner());
        let place = if path.starts_with('[') { format!("{place}{path}") } else { at(place, path) };
        if place.is_empty() {
            problem
        } else {
            format!("{place}: {problem}")
        }
    })
}

/// The place of a field in a file.
pub(crate) fn at(place: &str, field: &str) -> String {
    let dot = if place.is_empty() || field.is_empty() { "" } else { "." };
    format!("{place}{dot}{field}")
}

/// A distance of the field `place`, if it is more than 0.
pub(crate) fn positive(number: f64, place: &str) -> Result<f64, String> {
    match number > 0.0 {
        true => Ok(number),
        false => Err(format!("{place}: {number} is not more than 0")),
    }
}

/// A number of the field `place`, if it is from `low` to `high`.
pub(crate) fn within(number: f64, low: f64, high: f64, place: &str) -> Result<f64, String> {
    match (low..=high).contains(&number) {
        true => Ok(number),
        false => Err(format!("{place}: {number} is not from {low} to {high}")),
    }
}
