//! Light and colour: what a face looks like. The rasteriser knows nothing of it.

mod dim;
mod lambert;

pub use dim::Dim;
pub use lambert::{Lambert, LightError};
