//! The way of a triangle: the library's files and functions whose code runs from the first instruction of the face loop to its last,
//! in the recorded frame of a cell. What runs before is set-up.

use crate::cells::Cell;
use crate::cycles;
use crate::elf::{self, Provenance};
use crate::record;
use crate::Result;
use serde_json::{json, Value};
use std::collections::{BTreeMap, BTreeSet};

const FACE_LOOP: &str = "pipeline/faces.rs";

/// A flat triangle, with depth, and textured with depth.
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<Vec<Value>> {
    let mut cells = cycles::recorded(&["S3", "plain", "z", "M3"], failures)?;
    cells.extend(cycles::recorded(&["X1", "z", "M3"], failures)?);
    cells.iter().map(row).collect()
}

fn row((cell, frame): &(Cell, record::Frame)) -> Result<Value> {
    let code = Provenance::of(&cell.image)?;
    let places: Vec<&[elf::Frame]> = frame.run.iter().filter_map(|executed| code.at(executed.at)).collect();
    let in_loop = |place: &&[elf::Frame]| place.iter().any(|frame| frame.file == FACE_LOOP);
    let (first, last) = (places.iter().position(in_loop), places.iter().rposition(in_loop));
    let none = || format!("{cell}: no face loop in {} instructions of {}", places.len(), frame.run.len());
    let way = places.get(first.ok_or_else(none)?..=last.unwrap_or(0)).unwrap_or_default();
    let (mut folders, mut functions) = (BTreeMap::<_, BTreeSet<_>>::new(), BTreeSet::new());
    for frame in way.iter().copied().flatten() {
        let (folder, file) = frame.file.split_once('/').unwrap_or(("", &frame.file));
        folders.entry(folder).or_default().insert(file.trim_end_matches(".rs"));
        // Instances of a generic function are one, and a closure is a part of the function around it.
        let name =
            frame.function.split('<').next().unwrap_or_default().rsplit("::").next().unwrap_or_default();
        if !name.starts_with('{') {
            functions.insert((&frame.file, name));
        }
    }
    let files: usize = folders.values().map(BTreeSet::len).sum();
    Ok(json!({"scene": cell.scene, "variant": cell.variant, "core": cell.core.name, "files": files,
        "functions": functions.len(), "folders": folders}))
}
