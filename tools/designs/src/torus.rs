//! The torus of the benchmark's scene S3: 500 vertices and 1000 faces before a camera of 240 × 240 pixels.

use crate::Object;

include!(concat!(env!("OUT_DIR"), "/torus.rs"));

pub const SIZE: u32 = 240;
/// The field of view from top to bottom.
pub const DEGREES: i32 = 60;
/// The near plane's distance in 2⁻¹⁶.
pub const NEAR: i32 = 1 << 15;
pub const FAR: i32 = 20 << 16;

/// The torus, with the camera `times` as far away as in the scene.
pub fn object(times: i32) -> Object {
    let q16 = |bits: i32| f64::from(bits) / 65536.0;
    let unit = crate::num::exp2(EXPONENT.into());
    Object {
        model: ROTATION.map(|row| row.map(|c| q16(c) * unit)),
        place: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]],
        eye: [0.0, 0.0, q16(times * DISTANCE)],
        focal: 120.0 * 1.732_050_807_568_877_2, // cot 30°
        centre: [120.0; 2],
        near: q16(NEAR),
        far: q16(FAR),
    }
}
