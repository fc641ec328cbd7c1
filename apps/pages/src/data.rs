//! The rows of `docs/data`, and tables of them.

use pinhole_apps_support::grouped::grouped;
use serde_json::{Map, Value};

/// Columns and their values.
pub(crate) type Row = Map<String, Value>;

/// The rows of a file.
pub(crate) fn rows(file: &str) -> Result<Vec<Row>, String> {
    let path = format!("docs/data/{file}.json");
    let parsed = serde_json::from_str::<Value>(&super::read(&path)?).map_err(|e| format!("{path}: {e}"))?;
    serde_json::from_value(parsed["rows"].clone()).map_err(|e| format!("{path}: {e}"))
}

/// The row with these values.
pub(crate) fn row<'a>(rows: &'a [Row], values: &[(&str, &str)]) -> Result<&'a Row, String> {
    let is_it =
        |row: &&Row| values.iter().all(|(column, value)| row.get(*column) == Some(&Value::from(*value)));
    rows.iter().find(is_it).ok_or_else(|| format!("no row {values:?}"))
}

pub(crate) fn number(row: &Row, column: &str) -> Result<f64, String> {
    row.get(column).and_then(Value::as_f64).ok_or_else(|| format!("no {column} in {row:?}"))
}

/// A cell of a table: a text as it is, a number grouped, nothing as a dash.
pub(crate) fn shown(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "–".into(),
        Some(Value::String(text)) => text.clone(),
        Some(number) => match number.as_i64() {
            Some(whole) => signed(whole),
            None => number.to_string(),
        },
    }
}

pub(crate) fn signed(number: i64) -> String {
    format!("{}{}", if number < 0 { "−" } else { "" }, grouped(number.unsigned_abs()))
}

/// A table of Markdown; columns but the first are aligned to the right.
pub(crate) fn table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|---|{}\n", header.join(" | "), "--:|".repeat(header.len() - 1));
    for row in rows {
        text += &format!("| {} |\n", row.join(" | "));
    }
    text
}
