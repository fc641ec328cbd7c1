//! Firmware that draws nothing: `flash_empty` has the start, the end and the cube, which every image has; `flash_place` also places the
//! mesh; `flash_camera` also makes the camera at run time.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: usize = position(env!("CARGO_BIN_NAME"), &["flash_empty", "flash_place", "flash_camera"]);

image!(cube, {
    match IMAGE {
        0 => {
            black_box(cube);
        }
        1 => {
            black_box(Turntable::new().place(cube));
        }
        _ => {
            let (camera, model) = (cube.camera(), cube.turned());
            black_box(&camera.as_ref()?.place(&cube.mesh, &model));
        }
    }
    Some(())
});
