//! A picture on the panel, and how the host draws the expected one.
#![allow(dead_code)] // example and test each take what they need

use crate::show::{Display, Scratch, Screen, SIZE, SOLAR_SYSTEM};
use embedded_graphics::pixelcolor::{Gray4, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use std::convert::Infallible;
use std::fmt;

const WIDTH: usize = SIZE.width as usize;
const HEIGHT: usize = SIZE.height as usize;

/// The levels of all pixels, row by row.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Picture {
    levels: Vec<u8>,
}

/// A difference: the number of pixels, and the first of them with its actual and its expected level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Difference {
    pub(crate) pixels: usize,
    pub(crate) first: (usize, usize),
    pub(crate) levels: (u8, u8),
}

impl Picture {
    /// From a level, 0 to 15, per pixel. `None` if the number of levels or a level is wrong.
    pub(crate) fn new(levels: Vec<u8>) -> Option<Self> {
        let sound = levels.len() == WIDTH * HEIGHT && levels.iter().all(|level| *level < 16);
        sound.then_some(Self { levels })
    }

    /// A frame drawn by the host in one piece, without bands and without the frame before it.
    pub(crate) fn of_frame(frame: u32) -> Self {
        // A level that no display has, so that a pixel that is not sent shows.
        let mut picture = Self { levels: vec![0xff; WIDTH * HEIGHT] };
        let (mut colours, mut depths) = (vec![0; WIDTH * HEIGHT / 2], vec![0; WIDTH * HEIGHT]);
        let mut bits = vec![0; WIDTH * HEIGHT / 8];
        let mut screen = Screen::new(&mut picture, &mut colours, &mut depths, &mut bits);
        let Ok(()) = Scratch::new().draw(frame, &mut { SOLAR_SYSTEM }, &mut screen);
        picture
    }

    /// The difference from the expected picture.
    pub(crate) fn difference(&self, wanted: &Self) -> Option<Difference> {
        let pairs = || self.levels.iter().copied().zip(wanted.levels.iter().copied());
        let (first, levels) = pairs().enumerate().find(|(_, (a, b))| a != b)?;
        let pixels = pairs().filter(|(a, b)| a != b).count();
        Some(Difference { pixels, first: (first % WIDTH, first / WIDTH), levels })
    }

    /// The levels, row by row.
    pub(crate) fn levels(&self) -> &[u8] {
        &self.levels
    }

    /// The picture magnified by `scale`, and its size.
    pub(crate) fn enlarged(&self, scale: u32) -> (Size, Vec<Rgb888>) {
        let scale = scale as usize;
        let pixels =
            (0..HEIGHT * scale).flat_map(|y| (0..WIDTH * scale).map(move |x| (x / scale, y / scale)));
        let pixels = pixels.map(|(x, y)| Gray4::new(self.levels[y * WIDTH + x]).into()).collect();
        (SIZE * scale as u32, pixels)
    }
}

impl Display for Picture {
    type Error = Infallible;

    fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), Infallible> {
        let levels = pixels.iter().flat_map(|byte| [byte >> 4, byte & 15]);
        for (at, level) in area.points().zip(levels) {
            self.levels[at.y as usize * WIDTH + at.x as usize] = level;
        }
        Ok(())
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { pixels, first, levels: (is, should) } = self;
        write!(f, "{pixels} pixels differ, the first at {first:?}: {is}, not {should}")
    }
}
