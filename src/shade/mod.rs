//! Light and colour: what a face looks like. The rasteriser knows nothing of it.

mod channels;
mod dim;
mod dither;
mod flat;
mod gouraud;
mod lambert;
mod levels;
mod lit;
mod table;

pub use channels::Channels;
pub use dim::Dim;
pub use dither::Dithered;
pub(crate) use dither::{Bayer, Even};
pub use flat::Flat;
pub use gouraud::Gouraud;
pub(crate) use gouraud::{Nearest, Ramps};
pub use lambert::{Lambert, LightError};
pub use lit::Lit;
pub use table::{ShadeTable, Shaded};
