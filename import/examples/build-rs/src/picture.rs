//! What a firmware would do each frame.

use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::prelude::*;
use pinhole::{prelude::*, Angle};

include!(concat!(env!("OUT_DIR"), "/block.rs"));

/// Draws the block as seen from (3, 2, 4), two units long about the origin.
pub(crate) fn draw<D: DrawTarget<Color = Gray8>>(display: &mut D) -> Result<(), D::Error> {
    let screen = display.bounding_box();
    let viewport = Viewport::new(screen.top_left, screen.size).expect("at most 8192 pixels away");
    let [eye, origin] = [Point3::from_ints(3, 2, 4), Point3::from_ints(0, 0, 0)];
    let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0)).expect("not straight up");
    let [near, far] = [1, 12].map(Scalar::from_int);
    let lens = Projection::perspective(Angle::degrees(26), screen.size, near, far).expect("near before far");
    let model = Affine::identity();
    let light = Lambert::new(&model, Vector3::from_ints(2, 4, 1), 40).expect("a direction");

    let mut buffers = mesh_buffers!(BLOCK);
    let instance = Camera::new(&view, &lens, &viewport).place(&BLOCK, &model);
    let faces = instance.transform(&mut buffers.cache).bin_faces(&mut buffers.bins);
    let mut faces = faces.expect("room for the faces");
    let level = |face: usize| BLOCK.normals().get(face).map_or(0, |&normal| light.level(normal));
    faces.solid(|face| Gray8::new((level(face) * 255 / 256) as u8), display).map(|_| ())
}
