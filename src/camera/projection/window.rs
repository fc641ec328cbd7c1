//! The window of a projection.

use crate::math::Scalar;

/// A rectangle of the near plane (perspective) or of any plane z = const (orthographic), in view
/// units: x from `left` to `right`, y from `bottom` to `top`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Smallest x.
    pub left: Scalar,
    /// Largest x.
    pub right: Scalar,
    /// Smallest y.
    pub bottom: Scalar,
    /// Largest y.
    pub top: Scalar,
}

#[cfg(feature = "defmt")]
impl defmt::Format for Window {
    fn format(&self, f: defmt::Formatter<'_>) {
        let [l, r, b, t] = [self.left, self.right, self.bottom, self.top].map(Scalar::to_bits);
        defmt::write!(f, "[{=i32}, {=i32}] x [{=i32}, {=i32}]/65536", l, r, b, t);
    }
}
