//! docs/spec.md, section 8: ambient and Lambert light per face, within one level of 256; colours within half a step of a channel.

use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, GrayColor, Rgb565, Rgb888, RgbColor};
use pinhole::{Dim, Lambert, LightError, RigidLambert};
use support::bridge;
use support::bridge::pair::{ModelBits, Step, ONE};
use support::bridge::vector;
use support::oracle::chain::{self, Affine, V3};
use support::oracle::rng::Rng;

/// The normal through the inverse transpose: the cofactors, which are det · inverse transpose.
pub(crate) fn normal(model: &Affine, n: V3) -> V3 {
    let [a, b, c] = model.m;
    // Rows of the cofactor matrix.
    let cofactors = [chain::cross(b, c), chain::cross(c, a), chain::cross(a, b)];
    let det = chain::dot(a, cofactors[0]);
    chain::normalise(chain::mul3(&cofactors, n).map(|c| c * det.signum()))
}

/// Checks `Lambert`, and `RigidLambert` where it takes the model, which it must if it is `rigid`.
fn check(rng: &mut Rng, model: &ModelBits, rigid: bool) -> f64 {
    let ambient = rng.int(0, 256) as u16;
    let length = rng.log(0.001, 30000.0);
    let Some(light) = bridge::pair::bits(rng.direction().map(|c| c * length)) else {
        return 0.0;
    };
    if light.iter().map(|c| c.unsigned_abs()).max() < Some(40) {
        return 0.0;
    }
    let Ok(ours) = Lambert::new(&model.library(), vector(light), ambient) else {
        panic!("{light:?}");
    };
    let ours_rigid = RigidLambert::new(&model.library(), vector(light), ambient);
    assert!(
        ours_rigid.is_ok() || !rigid && ours_rigid == Err(LightError::NotRigid),
        "{ours_rigid:?}: {model:?}"
    );
    let exact = model.exact();
    let towards = chain::normalise(chain::fx3(light));
    let mut worst = 0.0f64;
    for _ in 0..5 {
        // A unit normal in 2⁻¹⁵; the oracle takes its rounded value.
        let n = rng.direction().map(|c| (c * 32767.0).round() as i16);
        let cosine = chain::dot(normal(&exact, n.map(f64::from)), towards);
        let level = f64::from(ambient) + f64::from(256 - ambient) * cosine.max(0.0);
        for ours in [Some(ours.level(n)), ours_rigid.ok().map(|light| light.level(n))].into_iter().flatten() {
            let error = (f64::from(ours) - level).abs();
            assert!(error <= 1.0, "{error} off: {model:?} light {light:?} normal {n:?} ambient {ambient}");
            worst = worst.max(error);
        }
    }
    worst
}

#[test]
fn light_levels_hold_under_rotations_and_even_scales() {
    let mut rng = Rng::new(0x8A);
    let mut worst = 0.0f64;
    for _ in 0..10_000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        if rng.one_in(2) {
            let s = rng.log(100.0, 6e8) as i32;
            model.0.push(Step::Scale([s; 3]));
        }
        worst = worst.max(check(&mut rng, &model, true));
    }
    println!("within {worst:.3} levels");
}

#[test]
fn light_levels_hold_under_uneven_scales() {
    let mut rng = Rng::new(0x8B);
    let mut worst = 0.0f64;
    for _ in 0..10_000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        let s = [0; 3].map(|_| (f64::from(ONE) * rng.log(0.2, 5.0)) as i32);
        model.0.push(Step::Scale(s));
        model.0.extend(ModelBits::random_rotation(&mut rng).0);
        worst = worst.max(check(&mut rng, &model, false));
    }
    println!("within {worst:.3} levels");
}

#[test]
fn light_levels_hold_under_mirrors() {
    // A mirrored object's normals still point outwards.
    let mut rng = Rng::new(0x8C);
    for _ in 0..10_000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        let s = [0; 3].map(|_| (f64::from(ONE) * rng.log(0.2, 5.0)) as i32 * [1, -1][rng.below(2)]);
        model.0.push(Step::Scale(s));
        check(&mut rng, &model, false);
        // An even scale that mirrors.
        let mut model = ModelBits::random_rotation(&mut rng);
        let signs = [0; 3].map(|_| [ONE, -ONE][rng.below(2)]);
        model.0.push(Step::Scale(signs));
        check(&mut rng, &model, true);
    }
}

#[test]
fn light_does_not_depend_on_the_translation() {
    let mut rng = Rng::new(0x8D);
    for _ in 0..500 {
        let model = ModelBits::random_rotation(&mut rng);
        let mut moved = model.clone();
        moved.0.push(Step::Move([0; 3].map(|_| rng.bits() as i32)));
        let (a, b) = (model.library(), moved.library());
        let light = vector([3, -2 * ONE, ONE]);
        let (a, b) = (Lambert::new(&a, light, 9).expect("light"), Lambert::new(&b, light, 9).expect("light"));
        let n = rng.direction().map(|c| (c * 32767.0) as i16);
        assert_eq!(a.level(n), b.level(n));
    }
}

#[test]
fn dimmed_colors_round_each_channel() {
    let wanted = |channel: u8, level: u16| {
        let exact = f64::from(channel) * f64::from(level.min(256)) / 256.0;
        (exact - 0.5, exact + 0.5)
    };
    let within = |ours: u8, (low, high): (f64, f64)| f64::from(ours) >= low && f64::from(ours) <= high;
    for level in (0..=256).chain([257, 1000, u16::MAX]) {
        for v in 0..=255u8 {
            assert!(within(Gray8::new(v).dim(level).luma(), wanted(v, level)));
            let ours = Rgb888::new(v, 255 - v, v / 2).dim(level);
            assert!(within(ours.r(), wanted(v, level)));
            assert!(within(ours.g(), wanted(255 - v, level)));
            assert!(within(ours.b(), wanted(v / 2, level)));
            let (r, g) = (v & 31, v & 63);
            let ours = Rgb565::new(r, g, 31 - r).dim(level);
            assert!(within(ours.r(), wanted(r, level)));
            assert!(within(ours.g(), wanted(g, level)));
            assert!(within(ours.b(), wanted(31 - r, level)));
        }
    }
    assert_eq!(BinaryColor::On.dim(256), BinaryColor::On);
    assert_eq!(BinaryColor::On.dim(0), BinaryColor::Off);
    assert_eq!(BinaryColor::Off.dim(256), BinaryColor::Off);
}

#[test]
fn light_levels_hold_under_nearly_even_scales() {
    let mut rng = Rng::new(0x8E);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        let bend = rng.log(1e-4, 0.1);
        model.0.push(Step::Scale([0; 3].map(|_| (f64::from(ONE) * (1.0 + rng.real(-bend, bend))) as i32)));
        model.0.extend(ModelBits::random_rotation(&mut rng).0);
        worst = worst.max(check(&mut rng, &model, false));
    }
    println!("within {worst:.3} levels");
}

#[test]
fn light_levels_hold_under_scales_up_to_10_000_to_1() {
    let mut rng = Rng::new(0x8F);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        model.0.push(Step::Scale([0; 3].map(|_| (f64::from(ONE) * rng.log(0.01, 100.0)) as i32)));
        model.0.extend(ModelBits::random_rotation(&mut rng).0);
        worst = worst.max(check(&mut rng, &model, false));
    }
    println!("within {worst:.3} levels");
}

/// The levels of a list of normals equal the levels of each normal, up to the end of the shorter list.
#[test]
fn light_levels_of_a_list_equal_light_levels_one_by_one() {
    let mut rng = Rng::new(0x90);
    for _ in 0..200 {
        let mut model = ModelBits::random_rotation(&mut rng);
        if rng.one_in(2) {
            model.0.push(Step::Scale([ONE, ONE / 3, 2 * ONE]));
        }
        let light = Lambert::new(&model.library(), vector([ONE, -ONE / 5, 3 * ONE]), 40).expect("a light");
        let normals: Vec<_> =
            (0..rng.below(9)).map(|_| rng.direction().map(|c| (c * 32767.0) as i16)).collect();
        let mut levels = vec![999; rng.below(9)];
        light.levels(&normals, &mut levels);
        for (i, level) in levels.into_iter().enumerate() {
            assert_eq!(level, normals.get(i).map_or(999, |&normal| light.level(normal)));
        }
    }
}
