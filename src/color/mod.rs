//! A target's colour types: where their channels lie, how they are stored, and arithmetic on their channels.

mod blend_mode;
mod color_type;
mod format;
mod ink;
mod mixer;
mod stored_pixel;

pub use blend_mode::{Alpha, BlendMode, Half};
pub use color_type::Color;
pub use format::Format;
pub(crate) use ink::{Access, InkKind, Reads, UnmixedInk, Writes};
pub use ink::{Ink, Mixed, Unmixed};
pub(crate) use mixer::Mixer;
pub use stored_pixel::StoredPixel;
