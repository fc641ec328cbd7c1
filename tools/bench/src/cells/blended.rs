//! S5 blended: one triangle over half of the picture, mixed with what is stored, in equal parts and by 13/32.

use super::two::corners;
use super::{count, Counted, Frame};
use crate::lists::SCREEN;
use crate::scene::LINE;
use core::hint::black_box;
use pinhole::{fill_triangle, Blended, HalfBlended};

pub fn s5_half(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let glass = HalfBlended::new(black_box(LINE));
        let Ok(()) = fill_triangle(corners(black_box(&SCREEN))?, glass, &mut picture.pixels());
        Some(())
    })
}

pub fn s5_alpha(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |picture| {
        let glass = Blended::new(black_box(LINE), black_box(13));
        let Ok(()) = fill_triangle(corners(black_box(&SCREEN))?, glass, &mut picture.pixels());
        Some(())
    })
}
