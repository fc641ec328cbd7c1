//! Code that the tests, the fuzz targets and the measuring programs share.
//!
//! * [`oracle`]: expected results, computed slowly from the specification. No oracle imports the library.
//! * [`bridge`]: passes an oracle's plain numbers to the library and the library's answers back.
//! * [`definition`]: every projection by its geometric definition, in f64.
//! * [`firmware`]: builds firmware, from copies of the templates too.
//! * [`smooth_scenes`]: scenes whose edges are smoothed, and their supersampled pictures.
//! * [`solids`]: meshes that hide and cut each other.
//! * [`teapot`]: the Utah teapot as a constant mesh.
//! * `panel` (feature `panel`): a model of a display controller behind its bus, and films to send to it.
// Test code: its types are made by the tests alone, and tests end at the first error.
#![allow(clippy::new_without_default, clippy::result_unit_err, clippy::should_implement_trait)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The repository's folder.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The text of each file of the library, by its path from `src`.
pub fn sources() -> BTreeMap<String, String> {
    let src = Path::new(ROOT).join("src");
    let (mut found, mut folders) = (BTreeMap::new(), vec![src.clone()]);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let name = path.strip_prefix(&src).expect("below src").to_string_lossy().replace('\\', "/");
                found.insert(name, fs::read_to_string(&path).expect("a source"));
            }
        }
    }
    found
}

pub mod bridge;
pub mod definition;
pub mod firmware;
pub mod oracle;
#[cfg(feature = "panel")]
pub mod panel;
pub mod smooth_scenes;
pub mod solids;
pub use teapot;
