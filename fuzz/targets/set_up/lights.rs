//! Light: within one level of Lambert's law, by the inverse transpose in f64.

use super::transforms;
use super::views::triple;
use crate::bridge::pair::{ModelBits, Step};
use crate::bridge::vector;
use crate::bytes::Bytes;
use crate::oracle::chain::{self, V3};
use pinhole::{Lambert, LightError};

pub(crate) fn check(b: &mut Bytes<'_>) {
    let any = b.byte() & 1 == 0;
    let model = if any {
        transforms::steps(b, 3)
    } else {
        // Scales up to 10 000 : 1 between rotations.
        let scale = Step::Scale([0; 3].map(|_| match b.u16() {
            k @ 0..=0x7fff => 655 + (i32::from(k as i16) << 6),
            k => -655 - (i32::from((k & 0x7fff) as i16) << 6),
        }));
        ModelBits(vec![transforms::turn(b), scale, transforms::turn(b)])
    };
    let towards = triple(b, [1 << 16; 3]);
    let ambient = match b.byte() {
        k @ 0..=127 => 2 * u16::from(k),
        _ => b.u16(),
    };
    let normal = [b.i16(), b.i16(), b.i16()];
    let light = match Lambert::new(&model.library(), vector(towards), ambient) {
        Err(error) => return assert!(error == LightError::ZeroDirection && towards == [0; 3]),
        Ok(light) => light,
    };
    assert!(towards != [0; 3]);
    let level = f64::from(light.level(normal));
    let ambient = f64::from(ambient.min(256));
    assert!((ambient..=256.0).contains(&level), "{level}");
    // The bound is for unit normals: brought to the nearest one.
    let length = chain::length(normal.map(f64::from));
    if any || length == 0.0 {
        return;
    }
    let unit = normal.map(|c| (f64::from(c) / length * 32_767.0).round());
    let m = model.exact().m;
    let cofactors = [chain::cross(m[1], m[2]), chain::cross(m[2], m[0]), chain::cross(m[0], m[1])];
    let image: V3 = chain::mul3(&cofactors, unit).map(|c| c * chain::dot(m[0], cofactors[0]).signum());
    let cosine = chain::dot(chain::normalise(image), chain::normalise(towards.map(f64::from)));
    let wanted = ambient + (256.0 - ambient) * cosine.max(0.0);
    let level = f64::from(light.level(unit.map(|c| c as i16)));
    assert!((level - wanted).abs() <= 1.0, "{level} for {wanted}: {model:?} {towards:?} {unit:?} {ambient}");
}
