//! A scene on every kind of target: memory and a DrawTarget, in one piece and in bands, with a depth buffer and without. All must be
//! equal.
#![allow(dead_code)] // not every target draws on every kind

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use embedded_graphics_core::Pixel;
use pinhole::{
    Band, DepthBuffer, Frame, MeshInstance, PixelFormat, Pixels, ScreenVertex, SpanShader, StoredPixel,
};

/// A DrawTarget that is not the library's, around any point.
pub(crate) struct Display<C> {
    pub(crate) area: Rectangle,
    pub(crate) pixels: Vec<C>,
}

impl<C> Dimensions for Display<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelFormat> DrawTarget for Display<C> {
    type Color = C;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(point, color) in pixels {
            assert!(self.area.contains(point), "{point:?} outside of {:?}", self.area);
            let Point { x, y } = point - self.area.top_left;
            self.pixels[y as usize * self.area.size.width as usize + x as usize] = color;
        }
        Ok(())
    }
}

/// The pictures without depth and with depth, and the depth buffer.
#[derive(Debug, PartialEq)]
pub(crate) struct Drawn<C> {
    pub(crate) solid: Vec<C>,
    pub(crate) deep: Vec<C>,
    pub(crate) depths: Vec<u16>,
}

/// Where scenes are drawn, before which colour, and in bands of how many rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<C> {
    pub(crate) area: Rectangle,
    pub(crate) sky: C,
    pub(crate) rows: u32,
}

impl<C: PixelFormat + core::fmt::Debug> Place<C> {
    fn pixels(&self) -> usize {
        (self.area.size.width * self.area.size.height) as usize
    }

    pub(crate) fn blank(&self) -> Vec<C> {
        vec![self.sky; self.pixels()]
    }

    pub(crate) fn memory(&self, draw: impl FnOnce(&mut Pixels<'_, C>)) -> Vec<C> {
        let mut cells = self.blank();
        draw(&mut Pixels::new(&mut cells, self.area).expect("cells"));
        cells
    }

    fn display(&self, draw: impl FnOnce(&mut Display<C>)) -> Vec<C> {
        let mut display = Display { area: self.area, pixels: self.blank() };
        draw(&mut display);
        display.pixels
    }

    /// A depth buffer for one drawing: a wider one has another layout.
    pub(crate) fn depth(&self, wider: bool, draw: impl FnOnce(&mut DepthBuffer<'_>)) -> Vec<u16> {
        let mut area = self.area;
        if wider {
            area.top_left -= Point::new(3, 1);
            area.size += embedded_graphics_core::geometry::Size::new(5, 2);
        }
        let mut storage = vec![0; (area.size.width * area.size.height) as usize];
        let mut depth = DepthBuffer::new(area, &mut storage).expect("depths");
        draw(&mut depth);
        self.area.points().map(|point| depth.at(point).expect("a pixel of it")).collect()
    }

    /// Draws each band, and returns the picture of all.
    pub(crate) fn bands(&self, mut draw: impl FnMut(&mut Band<'_, C>, &mut DepthBuffer<'_>)) -> Vec<C> {
        let mut strip = vec![0; Frame::<C>::strip_bytes(self.area.size.width, self.rows)];
        let mut depths = vec![0; (self.area.size.width * self.rows) as usize];
        let (mut frame, mut colors) = (Frame::new(self.area, self.sky), Vec::new());
        while let Some(mut band) = frame.next_band(&mut strip).expect("a strip") {
            let mut depth = DepthBuffer::new(band.area(), &mut depths).expect("depths");
            draw(&mut band, &mut depth);
            colors.extend(band.colors());
        }
        colors
    }

    /// Draws into memory, in one piece and in bands.
    pub(crate) fn in_memory<const N: usize, S: SpanShader<C>>(
        &self,
        instance: &MeshInstance<'_>,
        shade: impl Fn(usize) -> S,
    ) -> Drawn<C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
        let mut bins = [0; 64]; // more than a scene has
        let solid = self.memory(|target| {
            let Ok(_) = instance.solid(&shade, &mut cache, target);
        });
        let (mut deep, mut other) = (Vec::new(), Vec::new());
        let depths = self.depth(false, |depth| {
            deep = self.memory(|target| {
                let Ok(_) = instance.depth_tested(&shade, &mut [], depth, target);
            });
        });
        let wider = self.depth(true, |depth| {
            other = self.memory(|target| {
                let Ok(_) = instance.depth_tested(&shade, &mut cache, depth, target);
            });
        });
        assert!(other == deep && wider == depths, "the depth buffer's layout shows");
        let mut faces = instance.transform(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = self.bands(|band, _| {
            let Ok(()) = faces.solid(&shade, &mut band.pixels());
        });
        assert!(banded == solid, "bands of {} rows", self.rows);
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = self.bands(|band, depth| {
            let Ok(()) = faces.depth_tested(&shade, depth, &mut band.pixels());
        });
        assert!(banded == deep, "bands of {} rows, with depth", self.rows);
        Drawn { solid, deep, depths }
    }

    /// Draws into memory and into DrawTargets, in one piece and in bands.
    pub(crate) fn on_every_target<const N: usize, S: SpanShader<C>>(
        &self,
        instance: &MeshInstance<'_>,
        shade: impl Fn(usize) -> S,
    ) -> Drawn<C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let drawn = self.in_memory(instance, &shade);
        let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
        let mut bins = [0; 64];
        let solid = self.display(|target| {
            let Ok(_) = instance.solid(&shade, &mut cache, target);
        });
        assert!(solid == drawn.solid, "memory differs from a DrawTarget");
        let mut deep = Vec::new();
        let depths = self.depth(false, |depth| {
            deep = self.display(|target| {
                let Ok(_) = instance.depth_tested(&shade, &mut cache, depth, target);
            });
        });
        assert!(deep == drawn.deep && depths == drawn.depths, "memory differs from a DrawTarget, with depth");
        let mut faces = instance.transform(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = self.bands(|band, _| {
            faces.solid(&shade, band).expect("a band refuses nothing");
        });
        assert!(banded == drawn.solid, "bands of {} rows, not as memory", self.rows);
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = self.bands(|band, depth| {
            faces.depth_tested(&shade, depth, band).expect("a band refuses nothing");
        });
        assert!(banded == drawn.deep, "bands of {} rows, not as memory, with depth", self.rows);
        drawn
    }
}
