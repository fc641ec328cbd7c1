//! A camera made at run time, and a mesh instance that is not drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image;
use core::hint::black_box;

image!(cube, {
    let (camera, model) = (cube.camera(), cube.turned());
    black_box(&camera.as_ref()?.place(&cube.mesh, &model));
    Some(())
});
