//! The scenes of the firmware examples, drawn by the examples' code.

use embedded_graphics::pixelcolor::{Gray4, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{color::Color, draw::Statistics, Angle};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::ImportedMesh;
use show::{Display, Scratch, Screen, SolarSystem, FRAMES, SIZE, SOLAR_SYSTEM};
use std::cell::Cell;
use std::convert::Infallible;

pub(crate) use show::teapot;

#[path = "../../../examples/oled/show/mod.rs"]
mod show;

use pinhole_render::firmware::{FRAMES as FRAMES_OF_A_TURN, ROWS};

/// How many frames of the window show one frame of the OLED.
const PACE: u32 = 8;

/// Data sent to the display.
#[derive(Default)]
pub(crate) struct Sent {
    pub(crate) areas: Vec<Rectangle>,
    pub(crate) pixels: usize,
    pub(crate) bytes: usize,
}

/// The OLED's panel, magnified in the picture.
pub(crate) struct Oled {
    scratch: Box<Scratch>,
    nodes: Box<SolarSystem>,
    /// The frame on the panel.
    shown: Option<u32>,
}

impl Oled {
    pub(crate) fn new() -> Self {
        Self { scratch: Box::new(Scratch::new()), nodes: Box::new(SOLAR_SYSTEM), shown: None }
    }

    /// Draws the frame at `step`, unless the panel shows it already: only its difference from the frame before, as firmware sends
    /// it, or the whole frame if the panel shows any other frame.
    pub(crate) fn draw(&mut self, step: u32, rows: u32, picture: &mut Canvas<Rgb888>) -> Option<Sent> {
        let frame = step / PACE % FRAMES;
        if self.shown == Some(frame) {
            return None;
        }
        let mut sent = Sent::default();
        let on = Cell::new(false);
        let mut panel = Panel { picture, sent: &mut sent, on: &on };
        let rows = rows.min(SIZE.height) as usize;
        let mut colours = vec![0; SIZE.width as usize / 2 * rows];
        let mut depths = vec![0; SIZE.width as usize * rows];
        let mut bits = vec![0; SIZE.width as usize / 8 * rows];
        let mut screen = Screen::new(&mut panel, &mut colours, &mut depths, &mut bits);
        if let Some(before) = frame.checked_sub(1).filter(|before| self.shown == Some(*before)) {
            // Draws the frame on the panel again, so that the screen computes the difference from it.
            let Ok(()) = self.scratch.draw(before, &mut self.nodes, &mut screen);
        }
        on.set(true);
        let Ok(()) = self.scratch.draw(frame, &mut self.nodes, &mut screen);
        self.shown = Some(frame);
        Some(sent)
    }

    /// Forgets the panel's contents, because something else was shown.
    pub(crate) fn forget(&mut self) {
        self.shown = None;
    }
}

struct Panel<'a> {
    picture: &'a mut Canvas<Rgb888>,
    sent: &'a mut Sent,
    /// Whether data are sent to the panel or dropped.
    on: &'a Cell<bool>,
}

impl Display for Panel<'_> {
    type Error = Infallible;

    fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), Infallible> {
        if !self.on.get() {
            return Ok(());
        }
        let size = self.picture.size();
        let scale = (size.width / SIZE.width).min(size.height / SIZE.height).max(1);
        let left = size.width.saturating_sub(SIZE.width * scale) / 2;
        let top = size.height.saturating_sub(SIZE.height * scale) / 2;
        let place = |at: Point| Point::new(left as i32, top as i32) + at * scale as i32;
        let shades = pixels.iter().flat_map(|byte| [byte >> 4, byte & 15]);
        for (at, shade) in area.points().zip(shades) {
            let colour = Gray4::from_bits(shade.into());
            self.picture.fill_solid(&Rectangle::new(place(at), Size::new_equal(scale)), colour.into())?;
        }
        self.sent.areas.push(Rectangle::new(place(area.top_left), area.size * scale));
        self.sent.pixels += (area.size.width * area.size.height) as usize;
        self.sent.bytes += pixels.len();
        Ok(())
    }
}

/// The model as the firmware of the template draws it, at a point in time, and what was sent: all bands, one after the other.
pub(crate) fn template(
    model: &ImportedMesh,
    step: u32,
    picture: &mut Canvas<Rgb888>,
) -> Result<(Sent, Statistics), String> {
    let all = picture.bounding_box();
    let mut screen = Canvas::new(all.size, Rgb565::BLACK);
    let turn = Angle::turns((step % FRAMES_OF_A_TURN) as i32, FRAMES_OF_A_TURN);
    let statistics = pinhole_render::firmware::draw(model, turn, &mut screen)?;
    let Ok(()) = picture.fill_contiguous(&all, screen.pixels().iter().map(|&colour| colour.into()));
    let band = |top: u32| Rectangle::new(Point::new(0, top as i32), Size::new(all.size.width, ROWS));
    let areas = (0..all.size.height).step_by(ROWS as usize).map(|top| band(top).intersection(&all));
    let pixels = screen.pixels().len();
    Ok((Sent { areas: areas.collect(), pixels, bytes: pixels * 2 }, statistics))
}
