//! Textured faces: every size and format, repeated and clamped, keyed and lit.
//!
//! - A pixel shows the coordinates of a ray, within the documented bound, up to the ends of `i16` and with w in a ratio of 65536.
//! - Memory, other targets and bands of any height show equal pixels, with a depth buffer and without.
//! - Every format shows the texel at these coordinates; a transparent texel leaves its pixel and its depth alone; light is that of a
//!   shade table.
#![no_main]

use support::bridge;
#[path = "../bytes.rs"]
mod bytes;
#[path = "../everywhere.rs"]
mod everywhere;
mod formats;
#[allow(dead_code)] // faces alone are drawn here
#[path = "../scene/input.rs"]
mod input;
mod numbered;
mod rays;
use support::oracle;

use bytes::Bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes::new(data);
    match b.byte() & 1 {
        0 => rays::check(&mut b),
        _ => formats::check(data.get(1..).unwrap_or_default()),
    }
});
