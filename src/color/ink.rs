//! What a shader or a sprite gives for a pixel.

use super::BlendMode;
use embedded_graphics_core::pixelcolor::PixelColor;

/// What a shader, a stroke or a sprite needs of a target: [`Writes`] or [`Reads`].
pub trait Access {
    /// Whether stored pixels are read.
    const READS: bool;
}

/// Sets pixels, which every target can. No value of this type exists.
pub enum Writes {}

/// Reads stored pixels, too, which a target can give if they lie in memory. No value of this type exists.
pub enum Reads {}

impl Access for Writes {
    const READS: bool = false;
}

impl Access for Reads {
    const READS: bool = true;
}

/// What a [`SpanShader`](crate::shading::SpanShader) gives for each pixel. The type says what may happen to the pixel:
///
/// | ink | pixel |
/// |---|---|
/// | `C`, the target's colour | is set to the colour |
/// | `Option<C>` | is set, or with `None` left out: what lies behind the face is seen there, and no depth is stored |
/// | [`Mixed<C, M>`](Mixed) | is set to what a [`BlendMode`] makes of the colour and the stored one |
/// | `Option<Mixed<C, M>>` | is mixed or left out |
///
/// Mixed inks read pixels, so they compile only for targets whose pixels lie in [memory](crate::target::Surface::memory): a
/// [`Picture`](crate::target::Picture)'s or a [`Band`](crate::bands::Band)'s `pixels()`, or a target of your own that has memory.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not an ink for pixels of `{C}`",
    label = "not an ink of `{C}`",
    note = "use `{C}`, `Option<{C}>`, `Mixed<{C}, _>` or `Option<Mixed<{C}, _>>`"
)]
pub trait Ink<C>: InkKind<C> {}

#[diagnostic::do_not_recommend]
impl<C, I: InkKind<C>> Ink<C> for I {}

/// What the library does with an [`Ink`].
pub trait InkKind<C>: Copy {
    /// What the ink needs of a target.
    type Access: Access;

    /// Whether stored pixels are read.
    const READS: bool = <Self::Access as Access>::READS;

    /// Whether pixels may be left out.
    const LEAVES_OUT: bool;

    /// Whether each pixel is set to the ink's own colour.
    const IS_OPAQUE: bool = !(Self::LEAVES_OUT || Self::READS);

    /// The ink's own colour, or `None` if the pixel is left out.
    fn own(self) -> Option<C>;

    /// The colour to store in a pixel whose stored colour is `stored`, or `None` if the pixel is left out.
    fn over(self, stored: impl FnOnce() -> C) -> Option<C>;

    /// This ink or none.
    type Optional: InkKind<C, Access = Self::Access>;

    /// This ink, or none if `is_drawn` is false.
    fn only_if(self, is_drawn: bool) -> Self::Optional;

    /// This ink with another colour of its own.
    fn map(self, change: impl FnOnce(C) -> C) -> Self;

    /// A function that returns inks as one that returns colours, if the inks are colours: only then loops may store pixels
    /// in blocks.
    #[inline(always)]
    fn opaque<A>(finder: impl Fn(A) -> Self + Copy) -> Option<impl Fn(A) -> C + Copy> {
        let _ = finder;
        None::<fn(A) -> C>
    }
}

/// A colour that a [`BlendMode`] mixes with the stored one.
///
/// [`Translucent`](crate::shading::Translucent) makes it of any shader's colours. A shader of your own can give light that is added to
/// what is stored:
///
/// ```
/// use embedded_graphics::pixelcolor::Rgb565;
/// use pinhole::color::{Color, Mixed};
/// let beam = Mixed::new(Rgb565::new(9, 0, 0), |own: Rgb565, stored: Rgb565| stored.emitting(own));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Mixed<C, M> {
    color: C,
    mode: M,
}

impl<C, M> Mixed<C, M> {
    /// A colour, and how it is mixed with the stored one.
    #[inline(always)]
    pub const fn new(color: C, mode: M) -> Self {
        Self { color, mode }
    }
}

/// An [`Ink`] that is not mixed with stored pixels yet: a colour, or an optional one.
#[diagnostic::on_unimplemented(
    message = "this shader or picture is translucent already",
    label = "its colors are mixed with the stored pixels",
    note = "wrap the opaque shader or picture in one `Translucent`"
)]
pub trait Unmixed<C>: Ink<C> + UnmixedInk<C> {}

#[diagnostic::do_not_recommend]
impl<C, I: UnmixedInk<C>> Unmixed<C> for I {}

/// What the library does with an [`Unmixed`] ink.
pub trait UnmixedInk<C>: InkKind<C, Access = Writes> {
    /// The ink with a blend mode.
    type Mixed<M: BlendMode<C>>: InkKind<C, Access = Reads>;

    /// This ink with a blend mode.
    fn mixed<M: BlendMode<C>>(self, mode: M) -> Self::Mixed<M>;
}

impl<C: PixelColor> InkKind<C> for C {
    type Access = Writes;
    const LEAVES_OUT: bool = false;
    type Optional = Option<C>;

    #[inline(always)]
    fn own(self) -> Option<C> {
        Some(self)
    }

    #[inline(always)]
    fn over(self, _: impl FnOnce() -> C) -> Option<C> {
        Some(self)
    }

    #[inline(always)]
    fn only_if(self, is_drawn: bool) -> Option<C> {
        is_drawn.then_some(self)
    }

    #[inline(always)]
    fn map(self, change: impl FnOnce(C) -> C) -> C {
        change(self)
    }

    #[inline(always)]
    fn opaque<A>(finder: impl Fn(A) -> C + Copy) -> Option<impl Fn(A) -> C + Copy> {
        Some(finder)
    }
}

impl<C: PixelColor> UnmixedInk<C> for C {
    type Mixed<M: BlendMode<C>> = Mixed<C, M>;

    #[inline(always)]
    fn mixed<M: BlendMode<C>>(self, mode: M) -> Mixed<C, M> {
        Mixed::new(self, mode)
    }
}

impl<C: PixelColor, M: BlendMode<C>> InkKind<C> for Mixed<C, M> {
    type Access = Reads;
    const LEAVES_OUT: bool = false;
    type Optional = Option<Self>;

    #[inline(always)]
    fn own(self) -> Option<C> {
        Some(self.color)
    }

    #[inline(always)]
    fn over(self, stored: impl FnOnce() -> C) -> Option<C> {
        Some(self.mode.blend(self.color, stored()))
    }

    #[inline(always)]
    fn only_if(self, is_drawn: bool) -> Option<Self> {
        is_drawn.then_some(self)
    }

    #[inline(always)]
    fn map(self, change: impl FnOnce(C) -> C) -> Self {
        Self { color: change(self.color), ..self }
    }
}

/// An ink that may be missing.
macro_rules! optional {
    ([$($parameter:tt)*] $ink:ty, $color:ty, $access:ty) => {
        impl<$($parameter)*> InkKind<$color> for Option<$ink> {
            type Access = $access;
            const LEAVES_OUT: bool = true;
            type Optional = Self;

            #[inline(always)]
            fn own(self) -> Option<$color> {
                self.and_then(InkKind::own)
            }

            #[inline(always)]
            fn over(self, stored: impl FnOnce() -> $color) -> Option<$color> {
                self.and_then(|ink| ink.over(stored))
            }

            #[inline(always)]
            fn only_if(self, is_drawn: bool) -> Self {
                self.filter(|_| is_drawn)
            }

            #[inline(always)]
            fn map(self, change: impl FnOnce($color) -> $color) -> Self {
                self.map(|ink| InkKind::map(ink, change))
            }
        }
    };
}

// Two implementations in place of one for every ink: for the compiler, an `Option` may be a `PixelColor`, too.
optional!([C: PixelColor] C, C, Writes);
optional!([C: PixelColor, M: BlendMode<C>] Mixed<C, M>, C, Reads);

impl<C: PixelColor> UnmixedInk<C> for Option<C> {
    type Mixed<M: BlendMode<C>> = Option<Mixed<C, M>>;

    #[inline(always)]
    fn mixed<M: BlendMode<C>>(self, mode: M) -> Option<Mixed<C, M>> {
        self.map(|color| Mixed::new(color, mode))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Color, Half};
    use embedded_graphics_core::pixelcolor::{Gray8, Rgb565};

    #[test]
    fn inks_cover_leave_out_or_mix() {
        let stored = || Gray8::new(60);
        assert_eq!(InkKind::over(Gray8::new(40), stored), Some(Gray8::new(40)));
        assert_eq!(None::<Gray8>.over(stored), None);
        assert_eq!(Mixed::new(Gray8::new(40), Half).over(stored), Some(Gray8::new(50)));
        let beam = Mixed::new(Rgb565::new(9, 0, 0), |own: Rgb565, stored: Rgb565| stored.emitting(own));
        assert_eq!(beam.over(|| Rgb565::new(30, 5, 5)), Some(Rgb565::new(31, 5, 5)));
    }
}
