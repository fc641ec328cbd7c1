//! The tables of a generated page.

use crate::grouped::SPACE;

/// The table rows of a page, each with its section and header.
pub(crate) struct Page {
    path: &'static str,
    text: String,
    rows: Vec<Row>,
}

/// A row of a table.
pub(crate) struct Row {
    section: String,
    header: Vec<String>,
    cells: Vec<String>,
}

impl Page {
    pub(crate) fn read(path: &'static str) -> Result<Self, String> {
        let text = super::read(path)?;
        let (mut section, mut header, mut rows) = (String::new(), Vec::new(), Vec::new());
        for line in text.lines() {
            if let Some(title) = line.strip_prefix("## ") {
                section = title.to_string();
            }
            if !line.starts_with('|') {
                header.clear();
            } else if header.is_empty() {
                header = cells(line);
            } else if !line.starts_with("|--") {
                rows.push(Row { section: section.clone(), header: header.clone(), cells: cells(line) });
            }
        }
        Ok(Self { path, text, rows })
    }

    /// The row of a section that begins with these cells.
    pub(crate) fn row(&self, section: &str, start: &[&str]) -> Result<&Row, String> {
        let found = self.rows.iter().find(|row| row.section == section && row.begins(start));
        found.ok_or_else(|| format!("{}: {section}: no row {start:?}", self.path))
    }

    /// The cell in a column of the first row that begins with these cells and has the column.
    pub(crate) fn cell(&self, start: &[&str], column: &str) -> Result<&str, String> {
        let mut rows = self.rows.iter().filter(|row| row.begins(start));
        let found = rows.find_map(|row| row.get(column).ok());
        found.ok_or_else(|| format!("{}: no row {start:?} with {column}", self.path))
    }

    /// The text of a section, up to the next title.
    pub(crate) fn section(&self, title: &str) -> Result<&str, String> {
        let heading = format!("\n## {title}\n");
        let (_, rest) =
            self.text.split_once(&heading).ok_or_else(|| format!("{}: no section {title}", self.path))?;
        Ok(rest.split_once("\n## ").map_or(rest, |(section, _)| section).trim())
    }
}

impl Row {
    fn begins(&self, start: &[&str]) -> bool {
        self.cells.len() >= start.len() && self.cells.iter().zip(start).all(|(a, b)| a == b)
    }

    /// The cell in a column.
    pub(crate) fn get(&self, column: &str) -> Result<&str, String> {
        self.at(column, 0)
    }

    /// The cell to the right of a column.
    pub(crate) fn after(&self, column: &str) -> Result<&str, String> {
        self.at(column, 1)
    }

    fn at(&self, column: &str, further: usize) -> Result<&str, String> {
        let place = self.header.iter().position(|name| name == column);
        let cell = place.and_then(|at| self.cells.get(at + further));
        cell.map(String::as_str).ok_or_else(|| format!("no column {column}"))
    }
}

fn cells(line: &str) -> Vec<String> {
    line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect()
}

/// Parses a count as the pages format it.
pub(crate) fn number(text: &str) -> Result<u64, String> {
    text.replace(SPACE, "").parse().map_err(|_| format!("{text} is not a count"))
}
