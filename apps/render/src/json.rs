//! JSON values that know their place in the file, so that messages name the field.

use serde::de::{DeserializeOwned, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
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

/// Reads a file, which may begin with a byte order mark. The error names the file and the field, such as `triangles[3][2]`.
pub fn read<T: DeserializeOwned>(file: &Path) -> Result<T, String> {
    let text = std::fs::read(file).map_err(|e| format!("{}: cannot be read: {e}", file.display()))?;
    let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&text);
    // Structures could be read from arrays of their fields, too.
    if text.trim_ascii_start().first().is_some_and(|first| b"[nt\"".contains(first)) {
        return Err(format!("{}: is not an object", file.display()));
    }
    let mut json = serde_json::Deserializer::from_slice(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        let place = if path == "." { String::new() } else { format!("{path}: ") };
        let kind = if error.inner().is_data() { "" } else { "is not JSON: " };
        format!("{}: {place}{kind}{}", file.display(), error.inner())
    })?;
    json.end().map(|()| value).map_err(|error| format!("{}: is not JSON: {error}", file.display()))
}

/// A value. Numbers are the nearest f64; a repeated key is an error.
pub(crate) enum Json {
    Null,
    Bool,
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

/// Fields that describe a scene or mesh to people: texts, which are ignored.
const ABOUT: [&str; 3] = ["name", "source", "licence"];

/// A value and its place in the file, such as `triangles[3][2]`.
pub(crate) struct Field<'a> {
    place: String,
    value: &'a Json,
}

impl<'a> Field<'a> {
    /// The value that the file consists of.
    pub(crate) fn root(value: &'a Json) -> Self {
        Self { place: String::new(), value }
    }

    /// The message for a problem with this value.
    pub(crate) fn error(&self, problem: impl fmt::Display) -> String {
        if self.place.is_empty() {
            problem.to_string()
        } else {
            format!("{}: {problem}", self.place)
        }
    }

    fn is_no(&self, wanted: &str) -> String {
        let kind = match self.value {
            Json::Null => "null",
            Json::Bool => "a boolean",
            Json::Number(_) => "a number",
            Json::Text(_) => "a text",
            Json::List(_) => "an array",
            Json::Object(_) => "an object",
        };
        self.error(format_args!("is {kind} and should be {wanted}"))
    }

    /// The `known` fields of an object. Other fields are errors, except those in [`ABOUT`].
    pub(crate) fn fields<const N: usize>(&self, known: [&str; N]) -> Result<[Option<Field<'a>>; N], String> {
        let Json::Object(members) = self.value else { return Err(self.is_no("an object")) };
        let mut fields = [const { None }; N];
        for (name, value) in members {
            let place = if self.place.is_empty() { name.clone() } else { format!("{}.{name}", self.place) };
            let field = Field { place, value };
            match known.iter().position(|k| k == name) {
                Some(index) => fields[index] = Some(field),
                None if ABOUT.contains(&name.as_str()) => drop(field.text()?),
                None => return Err(field.error("is not a field of this format")),
            }
        }
        Ok(fields)
    }

    /// A field of this object that must be there.
    pub(crate) fn needed<'b>(&self, field: Option<Field<'b>>, name: &str) -> Result<Field<'b>, String> {
        field.ok_or_else(|| self.error(format_args!("{name}: is missing")))
    }

    /// Whether this is an object with a field of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        matches!(self.value, Json::Object(members) if members.iter().any(|(other, _)| other == name))
    }

    pub(crate) fn text(&self) -> Result<&'a str, String> {
        match self.value {
            Json::Text(text) => Ok(text),
            _ => Err(self.is_no("a text")),
        }
    }

    /// The value that a text stands for. The error lists the known texts.
    pub(crate) fn one_of<T: Copy>(&self, known: &[(&str, T)]) -> Result<T, String> {
        let text = self.text()?;
        if let Some((_, value)) = known.iter().find(|(name, _)| *name == text) {
            return Ok(*value);
        }
        let names: Vec<_> = known.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let (last, before) = names.split_last().map_or(("", [].as_slice()), |(last, before)| (last, before));
        Err(self.error(format_args!("is \"{text}\" and should be {} or {last}", before.join(", "))))
    }

    pub(crate) fn number(&self) -> Result<f64, String> {
        match self.value {
            Json::Number(number) => Ok(*number),
            _ => Err(self.is_no("a number")),
        }
    }

    /// A number from `low` to `high`.
    pub(crate) fn number_within(&self, low: f64, high: f64) -> Result<f64, String> {
        let number = self.number()?;
        match (low..=high).contains(&number) {
            true => Ok(number),
            false => Err(self.error(format_args!("{number} is not from {low} to {high}"))),
        }
    }

    /// Three numbers.
    pub(crate) fn vector(&self) -> Result<[f64; 3], String> {
        self.array(|number| number.number())
    }

    /// The red, green and blue of a colour.
    pub(crate) fn color(&self) -> Result<[u8; 3], String> {
        self.array(|channel| channel.integer(0, 255).map(|c| c as u8))
    }

    /// An integer from `low` to `high`, both within ±2⁵³, where f64 is exact.
    pub(crate) fn integer(&self, low: i64, high: i64) -> Result<i64, String> {
        let number = self.number()?;
        if number.fract() != 0.0 {
            return Err(self.error(format_args!("{number} is not a whole number")));
        }
        if number < low as f64 || number > high as f64 {
            return Err(self.error(format_args!("{number} is not from {low} to {high}")));
        }
        Ok(number as i64)
    }

    pub(crate) fn list(&self) -> Result<impl ExactSizeIterator<Item = Field<'a>> + use<'a, '_>, String> {
        let Json::List(items) = self.value else { return Err(self.is_no("an array")) };
        let item = |(index, value)| Field { place: format!("{}[{index}]", self.place), value };
        Ok(items.iter().enumerate().map(item))
    }

    /// An array of exactly N values.
    pub(crate) fn array<T, const N: usize>(
        &self,
        read: impl Fn(Field<'a>) -> Result<T, String>,
    ) -> Result<[T; N], String> {
        let list = self.list()?;
        let length = list.len();
        let items = list.map(read).collect::<Result<Vec<T>, String>>()?;
        items.try_into().map_err(|_| self.error(format_args!("has {length} entries and needs {N}")))
    }
}

impl Json {
    /// Parses the text of a file, which may begin with a byte order mark.
    pub(crate) fn parse(text: &[u8]) -> Result<Self, String> {
        let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(text);
        serde_json::from_slice(text).map_err(|error| {
            let prefix = if error.is_data() { "" } else { "is not JSON: " };
            format!("{prefix}{error}")
        })
    }
}

impl<'de> Deserialize<'de> for Json {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        json.deserialize_any(Reader)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Json, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Json, E> {
        Ok(Json::Bool)
    }

    fn visit_i64<E>(self, number: i64) -> Result<Json, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Json, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Json, E> {
        Ok(Json::Number(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Json, E> {
        Ok(Json::Text(text.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Json, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = list.next_element()? {
            items.push(item);
        }
        Ok(Json::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Json, A::Error> {
        let mut members: Vec<(String, Json)> = Vec::new();
        while let Some((name, value)) = map.next_entry::<String, Json>()? {
            if members.iter().any(|(other, _)| *other == name) {
                return Err(A::Error::custom(format_args!("{name}: is given twice")));
            }
            members.push((name, value));
        }
        Ok(Json::Object(members))
    }
}
