//! Lines, at once.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::{Sink, Turntable, CORNERS};
use bench::{firmware, scene};
use pinhole::Corner;

firmware!(corners: [Corner; CORNERS] = [Corner::EMPTY; CORNERS], {
    Turntable::new().place().wireframe(scene::LINE, corners, &mut Sink).ok()?;
    Some(())
});
