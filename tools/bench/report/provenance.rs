//! Which source file each byte of an image's code comes from, functions that vanished by inlining included: from the
//! line table, which `llvm-dwarfdump` prints.

use crate::{cross, Result};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Bytes of code by file, for the files of the library, as `raster/line.rs`.
pub(crate) fn of(image: &Path) -> Result<BTreeMap<String, u64>> {
    let output = Command::new("llvm-dwarfdump").arg("--debug-line").arg(image).output();
    let output = output.map_err(|error| format!("llvm-dwarfdump (Debian: llvm): {error}"))?;
    let text = String::from_utf8(output.stdout)?;
    let library = cross::root().join("src");
    let mut bytes = BTreeMap::new();
    for (file, length) in files(&text) {
        if let Ok(file) = Path::new(&file).strip_prefix(&library) {
            *bytes.entry(file.display().to_string()).or_default() += length;
        }
    }
    Ok(bytes)
}

/// Code starts behind the vector table. What the linker has thrown away seems to lie at zero.
const CODE: u64 = 0x400;

/// Every row of the line table: its file, and the bytes to the next row.
fn files(text: &str) -> Vec<(String, u64)> {
    let mut result = Vec::new();
    let (mut folders, mut names) = (BTreeMap::new(), BTreeMap::new());
    let mut file = 0;
    let mut row: Option<(u64, usize)> = None;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let index = |rest: &str| rest.split(']').next().and_then(|n| n.trim().parse::<usize>().ok());
        let quoted = || line.split('"').nth(1).unwrap_or_default().to_string();
        if line.starts_with("debug_line[") {
            (folders, names, row) = (BTreeMap::new(), BTreeMap::new(), None);
        } else if let Some(folder) = line.strip_prefix("include_directories[").and_then(index) {
            folders.insert(folder, quoted());
        } else if let Some(number) = line.strip_prefix("file_names[").and_then(index) {
            file = number;
        } else if words.first() == Some(&"name:") {
            names.insert(file, (quoted(), 0));
        } else if let ["dir_index:", folder] = words[..] {
            if let (Some(name), Ok(folder)) = (names.get_mut(&file), folder.parse()) {
                name.1 = folder;
            }
        } else if let [address, _, _, file, ..] = words[..] {
            let address = address.strip_prefix("0x").and_then(|hex| u64::from_str_radix(hex, 16).ok());
            let (Some(address), Ok(file)) = (address, file.parse()) else { continue };
            if let Some((from, file)) = row.filter(|&(from, _)| from >= CODE) {
                let (name, folder) = names.get(&file).cloned().unwrap_or_default();
                let folder = folders.get(&folder).cloned().unwrap_or_default();
                result.push((format!("{folder}/{name}"), address.saturating_sub(from)));
            }
            row = (!words.contains(&"end_sequence")).then_some((address, file));
        }
    }
    result
}
