//! Faces in bands, with depth, one firmware each: flat, smooth, dithered, textured, and flat before another camera, into a band as into
//! any DrawTarget and into its pixels.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: &str = env!("CARGO_BIN_NAME");

/// Before a camera that frames the mesh, as the templates make it. In a function of its own: the camera is off the stack when it returns.
#[inline(never)]
fn framed(cube: &'static Model) -> Option<MeshInstance<'static>> {
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
        let turntable = Turntable::turned();
        let instance = if is_equal(IMAGE, "flash_framing") { framed(cube)? } else { turntable.place(cube) };
        let light = turntable.light();
        let light = light.as_ref()?;
        let mut faces = instance.transform_depth(corners).bin_faces(bin_storage);
        let faces = faces.as_mut().ok()?;
        let mesh = &cube.mesh;
        let mut frame = Frame::new(scene::area(), scene::BACKGROUND);
        while let Some(mut band) = frame.next_band(strip).ok()? {
            let mut depth = DepthBuffer::new(band.area(), storage).ok()?;
            match IMAGE {
    "flash_depth_bands" => faces.draw(scene::flat(mesh, |normal| light.level(normal)), &mut band.depth_tested(&mut depth)).ok()?,
    "flash_depth_pixels" | "flash_framing" => faces.draw(scene::flat(mesh, |normal| light.level(normal)), &mut band.pixels().depth_tested(&mut depth)).ok()?,
    "flash_gouraud_pixels" => faces.draw(scene::smooth(mesh, light), &mut band.pixels().depth_tested(&mut depth)).ok()?,
    "flash_dither" =>
        faces.draw(|face| Dithered(scene::smooth(mesh, light)(face)), &mut band.depth_tested(&mut depth)).ok()?,
    "flash_dither_pixels" => faces
        .draw(|face| Dithered(scene::smooth(mesh, light)(face)), &mut band.pixels().depth_tested(&mut depth))
        .ok()?,
    "flash_flat_dither_pixels" => faces
        .draw(scene::flat_dithered(mesh.normals(), light), &mut band.pixels().depth_tested(&mut depth))
        .ok()?,
    "flash_textured_bands" => faces.draw(image::textured(mesh, light), &mut band.depth_tested(&mut depth)).ok()?,
    "flash_textured_pixels" => faces.draw(image::textured(mesh, light), &mut band.pixels().depth_tested(&mut depth)).ok()?,
    _ => return None,
};
            band.send(&mut Sink).ok()?;
        }
        Some(())
    }
);
