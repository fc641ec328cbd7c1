//! The planner's library: draws a model on the display of a microcontroller, as firmware would. The page in `page` runs it as
//! WebAssembly; tests run it on the host, where it draws equal pixels.
//!
//! A [`Choice`] is everything that the user chose; its text form is the end of the page's address.

mod chip;
mod choice;
mod corners;
mod cost;
mod display;
mod draw;
#[allow(unsafe_code)] // an export has `#[unsafe(no_mangle)]`; there is no other unsafe code
mod exports;
mod figures;
mod film;
mod firmware;
mod json;
mod lens;
mod paint;
mod planner;
mod ready;
mod refused;
mod texture;
mod tricolor;
mod warning;
mod ways;

use pinhole_apps_support::{palette, projections};

pub use choice::{Choice, Style};
pub use display::{Format, DISPLAYS};
pub use planner::Planner;
pub use ready::READY;
pub use tricolor::Tricolor;
pub use warning::Refusal;
