//! What is not drawn, a firmware each: the parts that every other image has too, which are the start, the end and the cube; a mesh
//! instance; and one before a camera made at run time.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::Turntable;
use bench::{image, position};
use core::hint::black_box;

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
