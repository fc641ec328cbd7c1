//! Strokes: what lines are drawn with.

use crate::color::{Access, Color, Mixer, Reads, Writes};
use crate::raster::{line_table, rests_of, LineRests};
use embedded_graphics_core::pixelcolor::PixelColor;

/// What a line is drawn with: a colour, [`AntiAliased`] with a colour, or [`AntiAliasedBy`] a function. Every call that draws lines takes one.
///
/// Every `PixelColor` is a stroke: the pixels of a Bresenham line get the colour, on any target. A stroke that reads the stored pixels compiles
/// only for targets whose pixels lie in [memory](crate::target::Surface::memory): a [`Picture`](crate::target::Picture)'s or a
/// [`Band`](crate::bands::Band)'s `pixels()`, or a target of your own that has memory.
#[diagnostic::on_unimplemented(
    message = "lines of a target of `{C}` cannot be drawn with `{Self}`",
    label = "not `{C}` or a stroke of it",
    note = "pass `{C}`, the target's color type, or `AntiAliased` of it"
)]
pub trait Stroke<C: PixelColor>: StrokeKind<C> {}

#[diagnostic::do_not_recommend]
impl<C: PixelColor, K: StrokeKind<C>> Stroke<C> for K {}

/// What the library does with a [`Stroke`].
pub trait StrokeKind<C: PixelColor>: Copy {
    /// [`Reads`] if lines are anti-aliased, else [`Writes`].
    type Access: Access;

    /// The colour of a pixel that the line covers.
    fn color(&self) -> C;

    /// The colour to store in a pixel of which the line covers `coverage`/256, and in which `below` is stored. Called only of
    /// anti-aliased lines.
    #[inline(always)]
    fn covering(&self, below: C, coverage: u16) -> C {
        let _ = (below, coverage);
        self.color()
    }

    /// Whether a pixel that the line covers in full gets [`color`](Self::color), whatever is stored in it. If this is `true`, ends of edges
    /// are drawn faster. `false` is right for every stroke: a translucent one, or one that is not known to be opaque.
    const IS_OPAQUE: bool = false;

    /// The number of bits of a share that [`mixer`](Self::mixer) takes: 8 or fewer.
    const SHARE_BITS: u32 = 8;

    /// Whether areas are taken from a table, as of [`AntiAliasedByTable`]. Only for opaque strokes.
    const BY_TABLE: bool = false;

    /// [`covering`](Self::covering) as a function for loops. Its arguments are the stored colour and its share in 2^−`SHARE_BITS`: the
    /// part of the pixel that the line does not cover. Override both where what all pixels of a line need can be computed once.
    #[inline(always)]
    fn mixer(self) -> impl Fn(C, u32) -> C + Copy {
        // 0 … 256
        move |below, rest| self.covering(below, 256_u32.wrapping_sub(rest) as u16)
    }
}

impl<C: PixelColor> StrokeKind<C> for C {
    type Access = Writes;

    #[inline(always)]
    fn color(&self) -> C {
        *self
    }
}

/// A stroke for anti-aliased lines, one pixel wide in every direction: each pixel is mixed with the colour by the area of it that
/// the line covers.
///
/// A line in 2D, by [`draw_line`](crate::draw::draw_line), is the parallelogram of the points within ½ pixel of the straight line through
/// both ends, between two pixel borders: from before the first pixel to behind the last one along the major axis (x or y, whichever
/// changes more). (Area sampling by a box filter: Foley et al., *Computer Graphics: Principles and Practice*, 2nd ed., section 3.17.2.)
///
/// The edges of a mesh end at their vertices, in 1/256 pixel. Around a vertex a pixel belongs in part to
/// each of the lines that meet there. A line that covers the area A of a pixel, of which the part w belongs to it, leaves (1 − A)ʷ of
/// the stored colour, so two lines that go straight on leave what one line leaves, and no pixel is drawn twice. Joints come out as
/// the union of the strokes with **round joints**: a regular polygon with 64 sides of 1.8 pixels is within 0.045 of the exact area in
/// every pixel, one with 16 sides within 0.08, a hexagon within 0.18, a square within 0.22; two lines at any angle miss at most 0.25 of
/// a pixel, and cover up to 0.35 too much where they run side by side. A stroke that keeps a part of the stored colour where it covers
/// all, such as a translucent one of [`AntiAliasedBy`], has its shares added: with half of the colour, all these polygons are within 0.14.
///
/// The area is within 2⁻¹² pixel of the exact one, asserted against polygons cut in f64. The share is rounded once: to 1/32, which is
/// at most 1/64 off, for colours of 15 and 16 bits, and to 1/256 for other colours; [`Color::over`] then mixes, each channel rounded to
/// nearest. A clipped line has exactly those pixels of the whole line that lie inside, so a frame in bands equals a frame in one
/// piece. A line beside the viewport covers its part of the outermost pixels. Where lines cross, the later one is mixed over the
/// earlier one: the order matters, unless both have one colour.
///
/// [`by_table`](Self::by_table) makes wireframes two to three times as fast, and less exact.
///
/// ```
/// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
/// use pinhole::{draw::draw_line, shading::AntiAliased, target::Picture};
/// let mut pixels = [Gray8::BLACK; 5 * 3];
/// let mut picture = Picture::new(&mut pixels, Size::new(5, 3))?;
/// let stroke = AntiAliased(Gray8::WHITE);
/// let Ok(()) = draw_line(Point::zero(), Point::new(4, 2), stroke, &mut picture.pixels());
/// // In column 2 the upper edge rises from 0.69 to 1.19 pixels: a triangle of 0.309 · 0.618 / 2 lies above row 1.
/// let column = [2, 7, 12].map(|i| picture.colors()[i].luma());
/// assert_eq!(column, [24, 236, 24]);
/// # Ok::<(), pinhole::target::BufferError>(())
/// ```
///
/// A target whose pixels cannot be read, such as a display's driver, does not compile:
///
/// ```compile_fail,E0277
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// # use pinhole::{draw::draw_line, shading::AntiAliased};
/// let mut display = MockDisplay::<Gray8>::new();
/// draw_line(Point::zero(), Point::new(4, 2), AntiAliased(Gray8::WHITE), &mut display).unwrap();
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AntiAliased<C>(
    /// The colour of the line.
    pub C,
);

/// The implementation of a stroke of anti-aliased lines.
macro_rules! anti_aliased {
    ($stroke:ident, $by_table:literal) => {
        impl<C: Color> StrokeKind<C> for $stroke<C> {
            type Access = Reads;

            #[inline(always)]
            fn color(&self) -> C {
                self.0
            }

            #[inline(always)]
            fn covering(&self, below: C, coverage: u16) -> C {
                self.0.over(below, coverage)
            }

            const IS_OPAQUE: bool = true;
            const SHARE_BITS: u32 = <C as Mixer>::SHARE_BITS;
            const BY_TABLE: bool = $by_table;

            #[inline(always)]
            fn mixer(self) -> impl Fn(C, u32) -> C + Copy {
                Mixer::mixer(self.0)
            }
        }
    };
}

anti_aliased!(AntiAliased, false);
anti_aliased!(AntiAliasedByTable, true);

/// [`rests_of`] a slope in the table for a stroke.
#[inline(always)]
pub(crate) fn rests_of_line<C: PixelColor, K: StrokeKind<C>>(slope: u32) -> [&'static LineRests; 2] {
    rests_of(const { &line_table(K::SHARE_BITS) }, slope)
}

impl<C> AntiAliased<C> {
    /// These lines with areas from a table of 2.5 KB: less exact, but wireframes take 37 to 55 % of the instructions.
    ///
    /// An area is within 0.03 of the exact one, and within 0.04 for colours of 15 and 16 bits, whose shares are multiples of 1/32; asserted
    /// against polygons cut in f64. (Gupta and Sproull, *Filtering edges for gray-scale displays*, 1981, take intensities from a table.)
    ///
    /// Edges end at pixel borders across their major axis, without round joints: a column of pixels whose middle
    /// is at most ¼ pixel from the end is drawn in half. Lines that go straight on are drawn as one line. Regular polygons are within 0.6 of the
    /// exact area in every pixel, those of 16 or 64 sides of 1.8 pixels or more within 0.35; two lines at any angle miss at most 0.65 of a pixel,
    /// and cover up to 0.4 too much.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{draw::draw_line, shading::AntiAliased, target::Picture};
    /// let mut pixels = [Gray8::BLACK; 5 * 3];
    /// let mut picture = Picture::new(&mut pixels, Size::new(5, 3))?;
    /// let stroke = AntiAliased(Gray8::WHITE).by_table();
    /// let Ok(()) = draw_line(Point::zero(), Point::new(4, 2), stroke, &mut picture.pixels());
    /// let column = [2, 7, 12].map(|i| picture.colors()[i].luma());
    /// assert_eq!(column, [24, 236, 29]); // the exact areas are 24, 236 and 24
    /// # Ok::<(), pinhole::target::BufferError>(())
    /// ```
    pub fn by_table(self) -> AntiAliasedByTable<C> {
        AntiAliasedByTable(self.0)
    }
}

/// What [`AntiAliased::by_table`] returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AntiAliasedByTable<C>(C);

/// A stroke for anti-aliased lines, as [`AntiAliased`], whose pixels are mixed by a function: of the line's colour, the stored one, and
/// the part of the pixel that the line covers, 1 … 256 of 256.
///
/// ```
/// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
/// use pinhole::{color::Color, draw::draw_line, shading::AntiAliasedBy, target::Picture};
/// let mut pixels = [Gray8::BLACK; 5 * 3];
/// let mut picture = Picture::new(&mut pixels, Size::new(5, 3))?;
/// // A pixel keeps half of what is stored.
/// let half = |color: Gray8, below, coverage| color.over(below, coverage / 2);
/// let [from, to] = [0, 4].map(|x| Point::new(x, 1));
/// let Ok(()) = draw_line(from, to, AntiAliasedBy::new(Gray8::WHITE, half), &mut picture.pixels());
/// assert_eq!(picture.colors()[7], Gray8::new(128));
/// # Ok::<(), pinhole::target::BufferError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AntiAliasedBy<C, F> {
    color: C,
    mix: F,
}

impl<C, F> AntiAliasedBy<C, F> {
    /// Lines of a colour, and how it is mixed with a stored one by the part of a pixel that is covered.
    pub const fn new(color: C, mix: F) -> Self {
        Self { color, mix }
    }
}

impl<C: PixelColor, F: Fn(C, C, u16) -> C + Copy> StrokeKind<C> for AntiAliasedBy<C, F> {
    type Access = Reads;

    #[inline(always)]
    fn color(&self) -> C {
        self.color
    }

    #[inline(always)]
    fn covering(&self, below: C, coverage: u16) -> C {
        // Loops visit pixels of which the line covers nothing, too; which ones depends on the band.
        match coverage {
            0 => below,
            _ => (self.mix)(self.color, below, coverage),
        }
    }
}

defmt_format!([C, F] AntiAliasedBy<C, F>, self, "anti-aliased stroke");
