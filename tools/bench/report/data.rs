//! The data in `docs/data`: JSON files with a row for each measurement. A check compares new rows with them.

use crate::{core, Result};
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;

/// Columns with this prefix are limits of the column whose name follows. They are written by hand and kept.
const LIMIT: &str = "most_";
/// The compiler that built what was measured, and the last commit.
const COMPILER: &str = "compiler";
const COMMIT: &str = "commit";
/// Columns in bytes. Small functions come and go, so 64 bytes are allowed where 2 % are less.
const BYTES: [&str; 4] = ["flash", "ram", "variables", "stack"];

/// A file of measurements.
#[derive(Clone, Copy)]
pub(crate) struct Set {
    pub(crate) name: &'static str,
    /// The word of the command line that measures it.
    pub(crate) command: &'static str,
    /// The columns that together name a row.
    pub(crate) keys: &'static [&'static str],
}

/// How strictly measured rows are compared with the file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Strictness {
    /// Nothing may have grown: instructions by 2 %, bytes by 5 %.
    Growth,
    /// The file is current: also, nothing has shrunk by as much.
    Change,
}

pub(crate) fn path(name: &str) -> PathBuf {
    core::root().join("docs/data").join(name).with_extension("json")
}

/// The rows of a file.
pub(crate) fn read(name: &str) -> Result<Vec<Value>> {
    let path = path(name);
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let file: Value = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(serde_json::from_value(file["rows"].clone())?)
}

/// The columns of a row, and their values.
fn columns(row: &Value) -> impl Iterator<Item = (&String, &Value)> {
    row.as_object().into_iter().flatten()
}

impl Set {
    fn is_same(&self, a: &Value, b: &Value) -> bool {
        self.keys.iter().all(|key| a[*key] == b[*key])
    }

    fn named(&self, row: &Value) -> String {
        let keys = self.keys.iter().filter_map(|key| row.get(*key));
        keys.map(|key| key.to_string().replace('"', "")).collect::<Vec<_>>().join(" ")
    }

    /// Replaces the rows that were measured, with their limits kept, and leaves all others as they are.
    pub(crate) fn write(&self, measured: Vec<Value>) -> Result<()> {
        let (compiler, commit) = (core::compiler()?, core::commit()?);
        let mut rows = if path(self.name).exists() { read(self.name)? } else { Vec::new() };
        for mut new in measured {
            new[COMPILER] = compiler.as_str().into();
            new[COMMIT] = commit.as_str().into();
            match rows.iter_mut().find(|old| self.is_same(old, &new)) {
                Some(old) => {
                    for (column, limit) in columns(old).filter(|(column, _)| column.starts_with(LIMIT)) {
                        new[column] = limit.clone();
                    }
                    *old = new;
                }
                None => rows.push(new),
            }
        }
        let command = Value::from(format!("tools/bench/run {}", self.command));
        let mut text = format!("{{\n\"command\": {command},\n\"rows\": [\n");
        for (at, row) in rows.iter().enumerate() {
            let end = if at + 1 < rows.len() { "," } else { "" };
            // What names the row comes first.
            let others = columns(row).map(|of| of.0.as_str()).filter(|column| !self.keys.contains(column));
            let columns = self.keys.iter().copied().chain(others);
            let columns: Vec<_> = columns.map(|column| format!("\"{column}\":{}", row[column])).collect();
            writeln!(text, "{{{}}}{end}", columns.join(","))?;
        }
        text += "]\n}\n";
        std::fs::write(path(self.name), text)?;
        eprintln!("written: docs/data/{}.json", self.name);
        Ok(())
    }

    /// Fails where a picture is not the one of the same scene and variant in the file, on any core.
    pub(crate) fn check_pictures(&self, measured: &[Value], failures: &mut Vec<String>) -> Result<()> {
        let rows = read(self.name)?;
        for new in measured {
            let is_same = |old: &&Value| old["scene"] == new["scene"] && old["variant"] == new["variant"];
            let known = rows.iter().filter(is_same).find_map(|old| old.get("crc"));
            if known.is_some_and(|crc| *crc != new["crc"]) {
                failures.push(format!("{}: {} is another picture", self.named(new), new["crc"]));
            }
        }
        Ok(())
    }

    /// Compares measured rows with the file: with their limits and their checksums in any case, with the figures if the same
    /// compiler built them.
    pub(crate) fn check(
        &self,
        measured: &[Value],
        strictness: Strictness,
        failures: &mut Vec<String>,
    ) -> Result<()> {
        let (rows, compiler) = (read(self.name)?, core::compiler()?);
        let mut others = 0;
        for new in measured {
            let name = format!("{}: {}", self.name, self.named(new));
            let Some(old) = rows.iter().find(|old| self.is_same(old, new)) else {
                failures.push(format!("{name}: not in docs/data: tools/bench/run {}", self.command));
                continue;
            };
            let is_same_compiler = old.get(COMPILER).and_then(Value::as_str) == Some(&compiler);
            others += u32::from(!is_same_compiler);
            for (column, value) in columns(new) {
                let before = old.get(column).unwrap_or(&Value::Null);
                let limit = old.get(format!("{LIMIT}{column}")).and_then(Value::as_f64);
                let is_over = value.as_f64().zip(limit).is_some_and(|(value, limit)| value > limit);
                let is_changed = match column.as_str() {
                    "crc" => value != before,
                    _ => is_same_compiler && differs(column, before, value, strictness),
                };
                if is_over {
                    failures.push(format!("{name}: {column} {value}, beyond the limit {limit:?}"));
                }
                if is_changed {
                    failures.push(format!("{name}: {column} {value}, {before} before"));
                }
            }
        }
        if others > 0 {
            eprintln!(
                "{}: {others} rows are another compiler's than {compiler}: only limits count",
                self.name
            );
        }
        Ok(())
    }
}

fn differs(column: &str, before: &Value, now: &Value, strictness: Strictness) -> bool {
    match (before, now) {
        (Value::Array(before), Value::Array(now)) => {
            before.len() != now.len()
                || before.iter().zip(now).any(|(before, now)| differs(column, before, now, strictness))
        }
        (Value::Number(_), Value::Number(_)) => {
            let [before, now] = [before, now].map(|number| number.as_f64().unwrap_or_default());
            let is_bytes = BYTES.contains(&column);
            let (part, least) = match (is_bytes, strictness) {
                (true, Strictness::Growth) => (0.05, 0.0),
                (true, Strictness::Change) => (0.02, 64.0),
                // The last digit of a rounded figure.
                (false, _) => (0.02, 0.05),
            };
            let allowed = (part * before.abs()).max(least);
            now > before + allowed || strictness == Strictness::Change && now < before - allowed
        }
        _ => before != now,
    }
}
