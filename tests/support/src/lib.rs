//! Code that the tests, the fuzz targets and the measuring programs share.
//!
//! * [`oracle`]: expected results, computed slowly from the specification. No oracle imports the library.
//! * [`bridge`]: passes an oracle's plain numbers to the library and the library's answers back.
//! * [`definition`]: every projection by its geometric definition, in f64.
//! * [`firmware`]: builds firmware, from copies of the templates too.
//! * [`solids`]: meshes that hide and cut each other.
//! * [`teapot`]: the Utah teapot as a constant mesh.
//! * `panel` (feature `panel`): a model of a display controller behind its bus, and films to send to it.
// Test code: its types are made by the tests alone, and tests end at the first error.
#![allow(clippy::new_without_default, clippy::result_unit_err, clippy::should_implement_trait)]

/// The repository's folder.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

pub mod bridge;
pub mod definition;
pub mod firmware;
pub mod oracle;
#[cfg(feature = "panel")]
pub mod panel;
pub mod solids;
pub use teapot;
