//! A placed mesh, of which nothing is drawn.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{firmware, image::Turntable};
use core::hint::black_box;

firmware!({
    black_box(Turntable::new().place());
    Some(())
});
