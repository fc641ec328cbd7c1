//! A checkered floor that is clipped at the near plane, a wall in fog, and a pane of glass in front of both.

use super::shaders::{Checkerboard, Fog, Glass};
use embedded_graphics::{pixelcolor::Rgb888, prelude::*, primitives::Rectangle};
use pinhole::{prelude::*, Angle};
use std::error::Error;

pub(crate) const SIZE: Size = Size::new(320, 240);
pub(crate) const EYE: [i16; 3] = [1, 2, 6];
pub(crate) const TOWARDS: [i16; 3] = [0, 1, -4];
pub(crate) const FIELD_OF_VIEW: u16 = 60;
pub(crate) const NEAR_FAR: [i32; 2] = [1, 40];

/// Corners in the order (0, 0), (1, 0), (1, 1), (0, 1) of the quad, counter-clockwise from its front.
pub(crate) const FLOOR: [[i16; 3]; 4] = [[-8, 0, 8], [8, 0, 8], [8, 0, -16], [-8, 0, -16]];
pub(crate) const WALL: [[i16; 3]; 4] = [[-5, 0, 4], [-5, 0, -16], [-5, 6, -16], [-5, 6, 4]];
pub(crate) const PANE: [[i16; 3]; 4] = [[-3, 0, -3], [3, 0, -3], [3, 3, -3], [-3, 3, -3]];
pub(crate) const QUAD: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

pub(crate) const TILES: u32 = 12;
pub(crate) const BOARD: [Rgb888; 2] = [Rgb888::new(235, 235, 225), Rgb888::new(60, 70, 90)];
pub(crate) const WALL_COLOR: Rgb888 = Rgb888::new(190, 90, 60);
pub(crate) const FOG_COLOR: Rgb888 = Rgb888::new(200, 215, 230);
/// The depths at which fog begins and at which it hides the wall, in steps of the depth buffer.
pub(crate) const FOG_RANGE: [u16; 2] = [50_000, 64_000];
pub(crate) const GLASS: Rgb888 = Rgb888::new(40, 160, 120);
pub(crate) const SKY: Rgb888 = Rgb888::new(120, 160, 210);

/// The checkerboard of a face of the floor.
pub(crate) fn board(face: usize) -> Checkerboard {
    let uv = [[0, 0], [1 << 16, 0], [1 << 16, 1 << 16], [0, 1 << 16]];
    Checkerboard::new(QUAD[face].map(|vertex| uv[usize::from(vertex)]), TILES, BOARD)
}

/// The fog on a face of the wall.
pub(crate) fn fog(_face: usize) -> Fog {
    Fog::new(WALL_COLOR, FOG_COLOR, FOG_RANGE)
}

pub(crate) fn camera() -> Result<(ViewTransform, Projection, Viewport), Box<dyn Error>> {
    let [eye, towards] = [EYE, TOWARDS].map(|[x, y, z]| Point3::from_ints(x, y, z));
    let view = ViewTransform::look_at(eye, towards, Vector3::from_ints(0, 1, 0))?;
    let [near, far] = NEAR_FAR.map(Scalar::from_int);
    let projection = Projection::perspective(Angle::degrees(FIELD_OF_VIEW.into()), SIZE, near, far)?;
    Ok((view, projection, Viewport::new(Point::zero(), SIZE)?))
}

pub(crate) fn draw() -> Result<Vec<Rgb888>, Box<dyn Error>> {
    let mut pixels = vec![SKY; (SIZE.width * SIZE.height) as usize];
    let mut depths = vec![0; pixels.len()];
    let mut picture = Picture::new(&mut pixels, SIZE)?;
    let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), SIZE), &mut depths)?;

    let (view, projection, viewport) = camera()?;
    let camera = Camera::new(&view, &projection, &viewport);
    let model = Affine::identity();
    let [floor, wall, pane] = [&FLOOR, &WALL, &PANE].map(|quad| Mesh::new(quad, 0, &QUAD));
    let (floor, wall, pane) = (floor?, wall?, pane?);
    camera.place(&floor, &model).faces(board).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    camera.place(&wall, &model).faces(fog).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    // Draw glass last: it blends with the pixels that are stored when it is drawn.
    camera
        .place(&pane, &model)
        .faces(|_| Glass(GLASS))
        .draw(&mut picture.pixels().depth_tested(&mut depth))?;
    Ok(pixels)
}
