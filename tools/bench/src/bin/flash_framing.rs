//! A camera that frames the mesh, as the templates make it, and a mesh instance that is not drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image;
use bench::scene::SIZE;
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::{Angle, Camera, Viewport};

image!(cube, {
    let viewport = Viewport::new(Point::zero(), black_box(Size::new(SIZE, SIZE)));
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(|degrees| Angle::degrees(black_box(degrees)));
    let sphere = cube.mesh.bounding_sphere();
    let camera = Camera::framing(&sphere, viewport.as_ref().ok()?, field_of_view, yaw, pitch);
    black_box(&camera.as_ref().ok()?.place(&cube.mesh, &cube.turned()));
    Some(())
});
