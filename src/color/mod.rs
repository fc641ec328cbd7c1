//! A target's colour types: where their channels lie, how they are stored, and arithmetic on their channels.

mod color_type;
mod format;
mod mixer;
mod stored_pixel;
#[cfg(test)]
mod tests;

pub use color_type::Color;
pub use format::Format;
pub(crate) use mixer::Mixer;
pub use stored_pixel::StoredPixel;
#[cfg(test)]
pub(crate) use tests::Rgb444;
