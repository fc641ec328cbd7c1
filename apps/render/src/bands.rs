//! Bands of a picture, in colours of any display, as firmware draws them.

use crate::sprite_paint::Sprites;
use crate::style::Style;
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb666, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{draw::SmoothEdges, prelude::*, target::Pixels};

/// The colour type of a pixel format.
pub(crate) trait Colour: Color + From<Rgb888> + Into<Rgb888> + 'static {
    /// Smooths the edges of faces that are drawn. Without effect in two colours, which have no mean.
    fn smooth(
        pixels: &mut Pixels<'_, Self>,
        depth: &mut DepthBuffer<'_>,
        edges: &mut [SmoothEdges<'_, Scalar>],
    );
}

macro_rules! smoothed_colours {
    ($($type:ty)*) => {$(
        impl Colour for $type {
            fn smooth(
                pixels: &mut Pixels<'_, Self>,
                depth: &mut DepthBuffer<'_>,
                edges: &mut [SmoothEdges<'_, Scalar>],
            ) {
                pixels.depth_tested(depth).smooth(|pass| edges.iter_mut().for_each(|edges| edges.draw(pass)));
            }
        }
    )*};
}
smoothed_colours!(Rgb888 Rgb666 Rgb565 Gray8 Gray4 Gray2);

impl Colour for BinaryColor {
    fn smooth(_: &mut Pixels<'_, Self>, _: &mut DepthBuffer<'_>, _: &mut [SmoothEdges<'_, Scalar>]) {}
}

/// Chooses the areas to send, given the area that will be drawn.
pub type Plan<'a> = &'a mut dyn FnMut(Rectangle) -> Vec<Rectangle>;

/// Takes the area of a band that is drawn, and the colours in it, row by row.
pub type Send<'a> = &'a mut dyn FnMut(Rectangle, &mut dyn Iterator<Item = Rgb888>);

/// Statistics of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Statistics of faces, or of edges where the mode draws edges.
    pub statistics: Statistics,
    /// Statistics of the scene's sprites.
    pub sprites: Statistics,
    pub bands: usize,
    /// Bytes of the pixels in the display's format.
    pub bytes: usize,
    pub pixels: usize,
}

/// The destination of bands.
pub(crate) struct Out<'a, C> {
    pub(crate) size: Size,
    pub(crate) style: &'a Style,
    pub(crate) rows: u32,
    pub(crate) plan: Plan<'a>,
    pub(crate) send: Send<'a>,
    /// The sprites, drawn after faces or edges.
    pub(crate) sprites: Sprites<'a, C>,
}

impl<C: Colour> Out<'_, C> {
    /// Draws the picture in one band, which is not sent, and returns its pixels.
    pub(crate) fn in_one_piece(
        &self,
        draw: impl FnOnce(&mut Band<'_, C>, &mut DepthBuffer<'_>),
    ) -> Result<Vec<C>, String> {
        let (Size { width, height }, area) = (self.size, Rectangle::new(Point::zero(), self.size));
        let mut strip = vec![0; Frame::<C>::strip_bytes(width, height)];
        let mut depths = vec![0; width as usize * height as usize];
        let mut frame = Frame::new(area, C::from(self.style.background));
        let mut depth = DepthBuffer::new(area, &mut depths).map_err(|e| e.to_string())?;
        let Some(mut band) = frame.next_band(&mut strip).map_err(|e| e.to_string())? else {
            return Ok(Vec::new());
        };
        draw(&mut band, &mut depth);
        Ok(band.colors().collect())
    }

    /// Draws the bands of the areas that are planned for `drawn`, and for a pixel more around it `with_border`: smooth lines and
    /// edges reach one pixel beyond those that are not.
    pub(crate) fn bands(
        self,
        statistics: Statistics,
        drawn: Rectangle,
        with_border: bool,
        mut draw: impl FnMut(&mut Band<'_, C>, &mut DepthBuffer<'_>),
    ) -> Result<Report, String> {
        let mut report = Report { statistics, sprites: self.sprites.statistics, ..Report::default() };
        let mut strip = vec![0; Frame::<C>::strip_bytes(self.size.width, self.rows)];
        // A strip holds more rows of a narrower area; a row may take up to seven pixels more.
        let mut depths = vec![0; (self.size.width as usize + 7) * self.rows as usize];
        let drawn = match with_border && !drawn.is_zero_sized() {
            true => drawn.offset(1).intersection(&Rectangle::new(Point::zero(), self.size)),
            false => drawn,
        };
        for area in (self.plan)(around([drawn, self.sprites.bounds].into_iter())) {
            let mut frame = Frame::new(area, C::from(self.style.background));
            while let Some(mut band) = frame.next_band(&mut strip).map_err(|e| e.to_string())? {
                let mut depth = DepthBuffer::new(band.area(), &mut depths).map_err(|e| e.to_string())?;
                draw(&mut band, &mut depth);
                self.sprites.draw(&mut band, &mut depth);
                report.bands += 1;
                report.bytes += band.bytes().len();
                report.pixels += (band.area().size.width * band.area().size.height) as usize;
                (self.send)(band.area(), &mut band.colors().map(Into::into));
            }
        }
        Ok(report)
    }
}

/// The bounding rectangle of all rectangles.
pub(crate) fn around(areas: impl Iterator<Item = Rectangle>) -> Rectangle {
    let both = |a: Rectangle, b: Rectangle| {
        let corners = a.bottom_right().zip(b.bottom_right());
        corners.map_or(a, |(c, d)| {
            Rectangle::with_corners(a.top_left.component_min(b.top_left), c.component_max(d))
        })
    };
    areas.filter(|area| !area.is_zero_sized()).reduce(both).unwrap_or_default()
}

/// Draws a band's pixels in memory, which shaders and lines can read, whatever the format.
pub(crate) fn in_memory<C: Colour>(band: &mut Band<'_, C>, draw: impl FnOnce(&mut Pixels<'_, C>)) {
    let area = band.area();
    let mut cells: Vec<C> = band.colors().collect();
    if let Ok(mut pixels) = Pixels::new(&mut cells, area) {
        draw(&mut pixels);
    }
    let _ = band.fill_contiguous(&area, cells); // a band takes all
}
