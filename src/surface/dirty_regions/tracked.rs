//! An object with the state and the rectangle that the display shows of it.

use super::DirtyRegions;
use embedded_graphics_core::primitives::Rectangle;

/// An object that [`DirtyRegions`] follows from frame to frame: its rectangle is sent when its picture has changed, and otherwise
/// not. `S` is all that its picture depends on, such as an angle, a number or a text.
///
/// In every frame, call [`show`](Self::show) for each object, then draw all objects in each rectangle of [`DirtyRegions::take`].
/// When nothing has changed, there are no rectangles. A `Tracked` takes the memory of `S` and 16 to 20 bytes.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, pixelcolor::BinaryColor, primitives::Rectangle};
/// use pinhole::{bands::{DirtyRegions, Tracked, TransferCost}, color::Color};
/// let screen = Rectangle::new(Point::zero(), Size::new(128, 64));
/// let mut dirty = DirtyRegions::<4>::new(screen, TransferCost::new(BinaryColor::FORMAT.bits(), 6));
/// let (mut needle, mut label) = (Tracked::new(), Tracked::new());
/// let at = |x, width| Rectangle::new(Point::new(x, 8), Size::new(width, 16));
///
/// let sent = [20, 20, 21, 21].map(|angle| {
///     needle.show(angle, at(angle, 30), &mut dirty); // for a mesh: `BinnedFaces::bounds`
///     label.show("rpm", at(90, 24), &mut dirty);
///     dirty.take()
/// });
/// assert_eq!(sent[0], [screen]); // a new display shows anything
/// assert_eq!(sent[1], []);
/// assert_eq!(sent[2], [at(20, 31)]); // the old and the new rectangle of the needle
/// assert_eq!(sent[3], []);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tracked<S> {
    shown: Option<(S, Rectangle)>,
}

impl<S> Tracked<S> {
    /// An object that the display does not show yet.
    pub const fn new() -> Self {
        Self { shown: None }
    }
}

impl<S> Default for Tracked<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: PartialEq> Tracked<S> {
    /// The object is drawn in this frame, in this rectangle. If its state or its rectangle differs from what was drawn last, the
    /// old and the new rectangle are dirty.
    pub fn show<const N: usize>(&mut self, state: S, rectangle: Rectangle, dirty: &mut DirtyRegions<N>) {
        if let Some((last, old)) = &self.shown {
            if *last == state && *old == rectangle {
                return;
            }
            dirty.mark_changed(*old);
        }
        dirty.mark_changed(rectangle);
        self.shown = Some((state, rectangle));
    }

    /// The object is not drawn in this frame: the rectangle where it was is dirty.
    pub fn hide<const N: usize>(&mut self, dirty: &mut DirtyRegions<N>) {
        if let Some((_, old)) = self.shown.take() {
            dirty.mark_changed(old);
        }
    }
}

#[cfg(feature = "defmt")]
impl<S> defmt::Format for Tracked<S> {
    fn format(&self, f: defmt::Formatter<'_>) {
        match &self.shown {
            Some((_, Rectangle { top_left, size })) => defmt::write!(f, "shown in {} at {}", size, top_left),
            None => defmt::write!(f, "not shown"),
        }
    }
}
