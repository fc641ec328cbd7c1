//! Every public constructor from arbitrary bytes: none panics; what is refused is refused for a reason that
//! holds, by the documentation and exact integers; what is accepted agrees with the f64 oracles within the
//! documented bound.
#![no_main]

use support::bridge;
#[path = "../bytes.rs"]
mod bytes;
use support::definition;
use support::oracle;

mod camera;
mod doors;
mod meshes;
mod projections;
mod shading;
mod transforms;
mod views;

use bytes::Bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes::new(data);
    match b.byte() {
        0..=31 => views::check(&mut b),
        32..=79 => projections::check(&mut b),
        80..=95 => projections::matrix(&mut b),
        96..=111 => projections::planar(&mut b),
        112..=119 => doors::check(&mut b),
        120..=127 => meshes::check(&mut b),
        128..=135 => meshes::hierarchy(&mut b),
        136..=147 => transforms::chain(&mut b),
        148..=155 => transforms::inverse(&mut b),
        156..=163 => transforms::rotation(&mut b),
        164..=171 => transforms::quaternion(&mut b),
        172..=175 => transforms::matrix(&mut b),
        176..=183 => shading::light(&mut b),
        184..=187 => shading::texture(&mut b),
        _ => camera::check(&mut b),
    }
});
