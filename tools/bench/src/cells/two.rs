//! S5 to S7: lines and triangles in the picture's plane.

use super::{count, Counted, Frame};
use crate::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use crate::scene::LINE;
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565};
use pinhole::raster::{Pixel, ScreenPoint};
use pinhole::{draw_line, fill_triangle, AntiAliased};

pub fn s5(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let Ok(()) = fill_triangle(corners(black_box(&SCREEN))?, black_box(LINE), &mut picture.pixels());
        Some(())
    })
}

pub fn s6(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let (colour, mut pixels) = (black_box(LINE), picture.pixels());
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            let Ok(()) = draw_line(Pixel { x: x0, y: y0 }, Pixel { x: x1, y: y1 }, colour, &mut pixels);
        }
        Some(())
    })
}

pub fn s6_smooth(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let (stroke, mut pixels) = (AntiAliased(black_box(LINE)), picture.pixels());
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            let Ok(()) = draw_line(Pixel { x: x0, y: y0 }, Pixel { x: x1, y: y1 }, stroke, &mut pixels);
        }
        Some(())
    })
}

pub fn s7(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let mut pixels = picture.pixels();
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            let colour = Rgb565::from(RawU16::new(colour));
            let Ok(()) = fill_triangle(corners(triangle)?, colour, &mut pixels);
        }
        Some(())
    })
}

#[inline(always)]
pub(super) fn corners(&[ax, ay, bx, by, cx, cy]: &[i16; 6]) -> Option<[ScreenPoint; 3]> {
    let at = |x: i16, y: i16| ScreenPoint::from_subpixels(i32::from(x) << 8, i32::from(y) << 8);
    Some([at(ax, ay)?, at(bx, by)?, at(cx, cy)?])
}
