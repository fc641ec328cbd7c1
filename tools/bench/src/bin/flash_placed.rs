//! Firmware that draws nothing: `flash_empty` has the start, the end and the cube, which every image has; `flash_place` also places the
//! mesh; `flash_camera` also makes the camera at run time.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: &str = env!("CARGO_BIN_NAME");

image!(cube, {
    match IMAGE {
        "flash_empty" => {
            black_box(cube);
        }
        "flash_place" => {
            black_box(Turntable::turned().place(cube));
        }
        "flash_camera" => {
            let (camera, model) = (cube.camera(), cube.turned());
            black_box(&camera.as_ref()?.place(&cube.mesh, &model));
        }
        _ => return None,
    }
    Some(())
});
