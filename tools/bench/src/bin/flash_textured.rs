//! Faces at once, into a picture in memory: some rows of one. A firmware each: in one colour and textured, without depth, with it, and
//! one frame of each.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::pixels;
use bench::image::{Turntable, CORNERS, ROWS};
use bench::{image, position, scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{DepthBuffer, Picture, ScreenVertex, SpanShader, Texture};

/// The firmware that is built.
const IMAGE: usize = position(
    env!("CARGO_BIN_NAME"),
    &[
        "flash_color",
        "flash_color_depth",
        "flash_color_both",
        "flash_textured",
        "flash_textured_depth",
        "flash_textured_both",
    ],
);
const TEXTURED: bool = matches!(IMAGE, 3..=5);
const PLAIN: bool = IMAGE % 3 != 1;
const DEPTH: bool = matches!(IMAGE % 3, 1 | 2);

/// 128 bytes, which count.
static TEXELS: [[Rgb565; 8]; 8] = {
    let mut texels = [[Rgb565::RED; 8]; 8];
    texels[2] = [Rgb565::GREEN; 8];
    texels
};

/// The coordinates of the corners of both faces of a side.
const UV: [[[i16; 2]; 3]; 2] = [[[0, 128], [128, 128], [128, 0]], [[0, 128], [128, 0], [0, 0]]];

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    {
        let texture = Texture::new(black_box(&TEXELS));
        match TEXTURED {
            true => draw(cube, |face| texture.at(UV[face & 1]), corners, memory, storage),
            false => draw(cube, |face| if face & 1 == 0 { Rgb565::RED } else { scene::BACKGROUND }, corners, memory, storage),
        }
    }
);

#[inline(always)]
fn draw<S: SpanShader<Rgb565>>(
    cube: &'static scene::Model,
    shade: impl Fn(usize) -> S,
    corners: &mut [ScreenVertex],
    memory: &mut [Rgb565],
    storage: &mut [u16],
) -> Option<()> {
    let scene = Turntable::new();
    let instance = scene.place(cube);
    let size = black_box(Size::new(scene::SIZE, ROWS));
    let mut picture = Picture::new(memory, size).ok()?;
    if PLAIN {
        let Ok(_) = instance.solid(&shade, corners, &mut picture.pixels());
    }
    if DEPTH {
        let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), storage).ok()?;
        let Ok(_) = instance.depth_tested(&shade, corners, &mut depth, &mut picture.pixels());
    }
    black_box(picture.colors());
    Some(())
}
