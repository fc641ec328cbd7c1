//! Where the texels of a sprite come from.

use crate::color::{BlendMode, Color, Ink, InkKind, Unmixed, UnmixedInk};
use crate::shading::{Fogged, Texels, Translucent};
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::PixelColor;

/// The picture of a [`Sprite`](crate::sprite::Sprite): a rectangle of texels, each a colour or transparent.
///
/// | picture | source |
/// |---|---|
/// | texels of a texture: 8 to 256 a side, powers of two | every [`Texels`], such as `&[[C; W]; H]`, [`IndexedTexels`](crate::texture::IndexedTexels) and, with transparent ones, [`ColorKeyed`](crate::texture::ColorKeyed) |
/// | an image of embedded-graphics of any size: `ImageRaw`, `Framebuffer`, tinybmp's `Bmp` | [`SpriteImage`](crate::sprite::SpriteImage) |
/// | one colour | [`SolidTexel`](crate::sprite::SolidTexel) |
/// | one of these, mixed with what is behind it | [`Translucent`](crate::shading::Translucent) |
/// | one of these, in fog | [`Fogged`](crate::fog::Fogged) |
/// | a formula | an implementation of your own |
///
/// ```
/// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
/// use pinhole::sprite::SpriteSource;
/// /// A disc that is bright in its middle.
/// struct Glow;
/// impl SpriteSource for Glow {
///     type Color = Gray8;
///     type Ink = Option<Gray8>;
///     fn picture_size(&self) -> Size {
///         Size::new(15, 15)
///     }
///     fn texel_at(&self, column: u32, row: u32) -> Option<Gray8> {
///         let away = column.abs_diff(7).pow(2) + row.abs_diff(7).pow(2);
///         (away <= 50).then(|| Gray8::new(255 - 5 * away as u8))
///     }
/// }
/// assert_eq!(Glow.texel_at(7, 7), Some(Gray8::WHITE));
/// assert_eq!(Glow.texel_at(0, 0), None);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a picture for a sprite",
    label = "not a `SpriteSource`",
    note = "pass `Texels`, `SpriteImage::new(&image)` of an embedded-graphics image, or `SolidTexel`, or implement `SpriteSource`"
)]
pub trait SpriteSource {
    /// The colour of a texel.
    type Color: PixelColor;

    /// A texel: its colour, `Option<Self::Color>` if some texels are transparent, or [`Mixed`](crate::color::Mixed) with the stored pixels.
    /// The depth of a sprite that is mixed is tested and not stored.
    type Ink: Ink<Self::Color>;

    /// The numbers of columns and rows. A picture without texels is not drawn.
    fn picture_size(&self) -> Size;

    /// The texel in a column, from the left, and a row, from the top. Both lie in the picture. May be called more than once for a
    /// pixel, and must return equal texels.
    fn texel_at(&self, column: u32, row: u32) -> Self::Ink;

    /// The opaque texel that all others equal, if there is one: pixels are then filled.
    #[inline(always)]
    fn solid_texel(&self) -> Option<Self::Ink> {
        None
    }

    /// Called with the depth of the sprite, 0 near to 65534 far, before it is drawn: for pictures whose colours depend on it. A picture
    /// that wraps another one has to pass the call on.
    #[inline(always)]
    fn set_depth(&mut self, depth: u16) {
        let _ = depth;
    }
}

impl<S: Texels> SpriteSource for S {
    type Color = S::Color;
    type Ink = S::Ink;

    fn picture_size(&self) -> Size {
        let [columns, rows] = self.size_bits().map(|bits| 1 << (bits & 31));
        Size::new(columns, rows)
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> S::Ink {
        // The left and the upper border of the texel, in 2⁻³² of a side: sides have 3 to 8 bits.
        let [w, h] = self.size_bits().map(|bits| 32u32.wrapping_sub(bits) & 31);
        self.texel(column << w, row << h)
    }
}

/// A picture of one texel, for squares and rectangles of one colour: what [`Sprite::square`](crate::sprite::Sprite::square) makes.
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::sprite::{SolidTexel, SpriteSource};
/// assert_eq!(SolidTexel::new(Rgb565::RED).picture_size(), Size::new(1, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SolidTexel<C>(C);

impl<C> SolidTexel<C> {
    /// A texel of one colour.
    pub const fn new(color: C) -> Self {
        Self(color)
    }
}

impl<C: PixelColor> SpriteSource for SolidTexel<C> {
    type Color = C;
    type Ink = C;

    fn picture_size(&self) -> Size {
        Size::new(1, 1)
    }

    #[inline(always)]
    fn texel_at(&self, _: u32, _: u32) -> C {
        self.0
    }

    #[inline(always)]
    fn solid_texel(&self) -> Option<C> {
        Some(self.0)
    }
}

impl<C: Color, S: SpriteSource<Color = C>> SpriteSource for Fogged<'_, S, C> {
    type Color = C;
    type Ink = S::Ink;

    fn picture_size(&self) -> Size {
        self.shader.picture_size()
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> S::Ink {
        self.shader.texel_at(column, row).map(|color| self.in_nearest_level(color))
    }

    #[inline(always)]
    fn solid_texel(&self) -> Option<S::Ink> {
        Some(self.shader.solid_texel()?.map(|color| self.in_nearest_level(color)))
    }

    fn set_depth(&mut self, depth: u16) {
        self.set_level_of(depth).set_depth(depth);
    }
}

impl<S: SpriteSource<Ink: Unmixed<S::Color>>, M: BlendMode<S::Color>> SpriteSource for Translucent<S, M> {
    type Color = S::Color;
    type Ink = <S::Ink as UnmixedInk<S::Color>>::Mixed<M>;

    fn picture_size(&self) -> Size {
        self.shader.picture_size()
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> Self::Ink {
        self.shader.texel_at(column, row).mixed(self.mode)
    }

    fn set_depth(&mut self, depth: u16) {
        self.shader.set_depth(depth);
    }
}
