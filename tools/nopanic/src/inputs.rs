//! Inputs that the compiler knows nothing about.

use crate::any;
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::World;
use pinhole::{
    camera::{Rotation, Window},
    color::StoredPixel,
    prelude::*,
};

pub(crate) fn scalar() -> Scalar {
    Scalar::from_bits(any())
}

pub(crate) fn point<S>() -> Point3<S> {
    Point3::new(scalar(), scalar(), scalar())
}

pub(crate) fn vector() -> Vector3<World> {
    Vector3::new(scalar(), scalar(), scalar())
}

pub(crate) fn window() -> Window {
    Window { left: scalar(), right: scalar(), bottom: scalar(), top: scalar() }
}

pub(crate) fn rotation() -> Rotation {
    match any() & 3 {
        0 => Rotation::Deg0,
        1 => Rotation::Deg90,
        2 => Rotation::Deg180,
        _ => Rotation::Deg270,
    }
}

pub(crate) fn pixel() -> Point {
    Point::new(any(), any())
}

pub(crate) fn size() -> Size {
    Size::new(any() as u32, any() as u32)
}

pub(crate) fn area() -> Rectangle {
    Rectangle::new(pixel(), size())
}

pub(crate) fn color() -> Rgb565 {
    Rgb565::load(any() as u16)
}

pub(crate) fn wide_color() -> Rgb888 {
    Rgb888::new(any() as u8, any() as u8, any() as u8)
}

/// Three levels of light.
pub(crate) fn levels() -> [u16; 3] {
    [any() as u16, any() as u16, any() as u16]
}

/// Texture coordinates of a face.
pub(crate) fn corners() -> [[i16; 2]; 3] {
    [[any() as i16, any() as i16]; 3]
}

/// Uses a value, because otherwise the compiler might leave its computation out.
pub(crate) fn report<T>(value: T) {
    drop(black_box(Some(value)));
}
