//! Flat faces with depth in bands, before a camera that frames the mesh, as the templates make it.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::bands::{bytes, pixels};
use bench::image::{Sink, Turntable, BIN_STORAGE, CORNERS, ROWS};
use bench::scene::Model;
use bench::{image, scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::{Angle, Camera, DepthBuffer, Frame, MeshInstance, ScreenVertex, Viewport};

/// In a function of its own: the camera is off the stack when it returns.
#[inline(never)]
fn place(cube: &'static Model) -> Option<MeshInstance<'static>> {
    let viewport = Viewport::new(Point::zero(), black_box(Size::new(scene::SIZE, scene::SIZE))).ok()?;
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    let camera = Camera::framing(&cube.mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch);
    Some(camera.as_ref().ok()?.place(&cube.mesh, &cube.turned()))
}

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    bin_storage: [u16; BIN_STORAGE] = [0; BIN_STORAGE],
    strip: [u8; bytes(ROWS)] = [0; bytes(ROWS)],
    storage: [u16; pixels(ROWS)] = [0; pixels(ROWS)],
    {
        let light = Turntable::new().light();
        let light = light.as_ref()?;
        let instance = place(cube)?;
        let mut faces = instance.transform_depth(corners).bin_faces(bin_storage);
        let faces = faces.as_mut().ok()?;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            faces.depth_tested(scene::flat(&cube.mesh, light), &mut depth, &mut band.pixels()).ok()?;
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
