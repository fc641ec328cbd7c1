//! Light, and textures.

use super::transforms;
use super::views::triple;
use crate::bridge::pair::{ModelBits, Step};
use crate::bridge::vector;
use crate::bytes::Bytes;
use crate::oracle::chain::{self, V3};
use embedded_graphics_core::pixelcolor::Gray8;
use pinhole::{IndexedTexels, Lambert, LightError, TexelSlice, Texels, Texture, TextureError};

/// Light: within one level of Lambert's law, by the inverse transpose in f64.
pub(crate) fn light(b: &mut Bytes<'_>) {
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

fn side(b: &mut Bytes<'_>) -> usize {
    match b.byte() {
        k @ 0..=191 => 1 << (k % 12),
        k @ 192..=207 => usize::MAX - usize::from(k & 15),
        _ => b.u16().into(),
    }
}

/// What must be said of a size, of the length of its texels, and of its palette's.
fn wrong(sides: [usize; 2], bits: usize, given: usize, colors: Option<usize>) -> Option<TextureError> {
    let known = |side: usize| [8, 16, 32, 64, 128, 256].contains(&side);
    if let Some(side) = sides.into_iter().find(|&side| !known(side)) {
        return Some(TextureError::Side { side });
    }
    let needed = sides[0] * sides[1] * bits / 8;
    if given < needed {
        return Some(TextureError::Texels { needed, given });
    }
    let needed = 1 << bits;
    colors.filter(|&given| given < needed).map(|given| TextureError::Palette { needed, given })
}

fn indexed<const BITS: u32>(sides: [usize; 2], bytes: &[u8], palette: &[Gray8], exponent: i8) {
    let [width, height] = sides;
    let wrong = wrong(sides, BITS as usize, bytes.len(), Some(palette.len()));
    match IndexedTexels::<_, BITS>::new(bytes, width, height, palette) {
        Err(error) => assert_eq!(Some(error), wrong),
        Ok(texels) => {
            assert_eq!(wrong, None);
            assert_eq!(texels.size_bits().map(|bits| 1 << bits), sides);
            let shorter = &palette[..(1 << BITS) - 1];
            let (needed, given) = (1 << BITS, shorter.len());
            assert_eq!(texels.with_palette(shorter), Err(TextureError::Palette { needed, given }));
            let unit = Texture::new(texels).with_exponent(exponent).err();
            assert_eq!(unit, (!(-15..=0).contains(&exponent)).then_some(TextureError::Exponent { exponent }));
        }
    }
}

/// Textures of any size, from slices of any length.
pub(crate) fn texture(b: &mut Bytes<'_>) {
    let sides = [side(b), side(b)];
    let bits = b.of(&[1, 2, 4, 8]);
    // About as long as it should be, or of any length.
    let needed = sides[0].wrapping_mul(sides[1]).wrapping_mul(bits) / 8;
    let length = match b.byte() {
        k @ 0..=127 if needed <= 1 << 16 => (needed + usize::from(k & 3)).saturating_sub(1),
        _ => b.u16().into(),
    };
    let colors = ((1 << bits) + b.below(4)).saturating_sub(1);
    let (bytes, palette) = (vec![b.byte(); length], vec![Gray8::new(7); colors]);
    let exponent = b.i8() as i8 >> 2;
    match bits {
        1 => indexed::<1>(sides, &bytes, &palette, exponent),
        2 => indexed::<2>(sides, &bytes, &palette, exponent),
        4 => indexed::<4>(sides, &bytes, &palette, exponent),
        _ => indexed::<8>(sides, &bytes, &palette, exponent),
    }
    let colors = vec![Gray8::new(9); length];
    let wrong = wrong(sides, 8, length, None);
    assert_eq!(TexelSlice::new(&colors, sides[0], sides[1]).err(), wrong);
}
