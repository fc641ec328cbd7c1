//! The tables by their names: macros of `tables.jinja` over the rows of `docs/data`.

use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Kwargs, Value};
use minijinja::{Environment, Error, ErrorKind, UndefinedBehavior};
use pinhole_apps_support::grouped;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A file of `docs/data`.
#[derive(Deserialize)]
struct Data {
    rows: Vec<Value>,
}

pub(super) struct Tables(Environment<'static>);

impl Tables {
    pub(super) fn read() -> Result<Self, String> {
        let folder = std::fs::read_dir(super::root().join("docs/data")).map_err(|e| e.to_string())?;
        let mut data = BTreeMap::<String, _>::new();
        for entry in folder.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let Some(table) = name.strip_suffix(".json") else { continue }; // logs of boards are no tables
            let text = super::read(&format!("docs/data/{name}"))?;
            let file: Data = serde_json::from_str(&text).map_err(|e| format!("docs/data/{name}: {e}"))?;
            data.insert(table.into(), file.rows);
        }
        let mut macros = Environment::new();
        let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build();
        macros.set_syntax(syntax.map_err(|e| e.to_string())?);
        // A row that is missing has no columns, and what is missing is shown.
        macros.set_undefined_behavior(UndefinedBehavior::Chainable);
        macros.set_formatter(|out, _, value| Ok(out.write_str(&shown(value))?));
        macros.add_filter("where", with);
        macros.add_filter("row", row);
        macros.add_filter("decimal", decimal);
        let added = macros.add_template("tables.jinja", include_str!("tables.jinja"));
        added.map_err(|e| e.to_string())?;
        macros.add_global("data", Value::from(data));
        Ok(Self(macros))
    }

    pub(super) fn table(&self, name: &str) -> Result<String, String> {
        let table = || -> Result<String, Error> {
            let mut captured = self.0.get_template("tables.jinja")?.render_captured(())?;
            captured.with_state_mut(|state| state.call_macro(&name.replace(' ', "_"), &[]))
        };
        table().map_err(|e| format!("{e:#}"))
    }
}

/// The rows with these values.
fn with(rows: Vec<Value>, keys: Kwargs) -> Result<Vec<Value>, Error> {
    let wanted: Vec<(&str, Value)> =
        keys.args().map(|key| Ok((key, keys.get(key)?))).collect::<Result<_, Error>>()?;
    let has = |row: &Value| wanted.iter().all(|(key, value)| row.get_attr(key).is_ok_and(|is| is == *value));
    Ok(rows.into_iter().filter(has).collect())
}

/// The row with these values.
fn row(rows: Vec<Value>, keys: Kwargs) -> Result<Value, Error> {
    let found = with(rows, keys.clone())?.into_iter().next();
    found.ok_or_else(|| Error::new(ErrorKind::InvalidOperation, format!("no row with {}", Value::from(keys))))
}

/// A text as it is, a number grouped, nothing as a dash.
fn shown(value: &Value) -> String {
    match value.as_i64().filter(|_| value.is_integer()) {
        Some(number) if number < 0 => format!("−{}", grouped(number.unsigned_abs())),
        Some(number) => grouped(number.unsigned_abs()),
        None if value.is_none() || value.is_undefined() => "–".into(),
        None => value.to_string(),
    }
}

/// A number as three digits and a power of ten.
fn decimal(number: f64) -> String {
    let text = format!("{number:.2e}");
    let raised = |c: char| "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip("-0123456789".chars()).find(|(_, plain)| *plain == c);
    match text.split_once('e') {
        Some((digits, "0")) => digits.to_string(),
        Some((digits, power)) => {
            format!("{digits}·10{}", power.chars().filter_map(raised).map(|(c, _)| c).collect::<String>())
        }
        None => text,
    }
}
