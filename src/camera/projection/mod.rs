//! Projections: from view space to clip space, for view volumes of all shapes.

mod matrix;
mod oblique;
mod parts;
mod planar;
#[allow(clippy::module_inception)] // the type has the folder's name
mod projection;
mod reference;
mod volume;
mod window;

pub(super) use parts::ratio;
pub use projection::Projection;
pub use window::Window;
