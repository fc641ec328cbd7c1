//! S5 to S7: lines and triangles in the picture's plane.

use super::{count, Counted, Frame, Picture};
use crate::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use crate::scene::LINE;
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::{self, Pixel, Scissor, ScreenPoint, Span};

pub fn s5(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| fill(corners(black_box(&SCREEN))?, black_box(LINE), picture))
}

pub fn s6(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let colour = black_box(LINE);
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            draw(Pixel { x: x0, y: y0 }, Pixel { x: x1, y: y1 }, colour, picture);
        }
        Some(())
    })
}

pub fn s7(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            fill(corners(triangle)?, RawU16::new(colour).into(), picture)?;
        }
        Some(())
    })
}

#[inline(always)]
fn corners(&[ax, ay, bx, by, cx, cy]: &[i16; 6]) -> Option<[ScreenPoint; 3]> {
    let at = |x: i16, y: i16| ScreenPoint::from_subpixels(i32::from(x) << 8, i32::from(y) << 8);
    Some([at(ax, ay)?, at(bx, by)?, at(cx, cy)?])
}

#[inline(always)]
fn fill(corners: [ScreenPoint; 3], colour: Rgb565, picture: &mut Picture<'_>) -> Option<()> {
    let Ok(()) = raster::triangle(corners, &scissor(picture), |span| send(span, colour, picture));
    Some(())
}

#[inline(always)]
fn draw(from: Pixel, to: Pixel, colour: Rgb565, picture: &mut Picture<'_>) {
    let Ok(()) = raster::line(from, to, &scissor(picture), |span| send(span, colour, picture));
}

#[inline(always)]
fn scissor(picture: &Picture<'_>) -> Scissor {
    let Size { width, height } = picture.size();
    Scissor::new(0, 0, width as i32, height as i32)
}

#[inline(always)]
fn send(span: Span, colour: Rgb565, picture: &mut Picture<'_>) -> Result<(), Infallible> {
    let size = Size::new(span.width as u32, span.height as u32);
    picture.fill_solid(&Rectangle::new(Point::new(span.x, span.y), size), colour)
}
