//! docs/spec.md, section 8: ambient and Lambert light per face, within one level of 256.

use pinhole::{Lambert, LightError, RigidLambert};
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

/// A mirrored object's normals still point outwards.
#[test]
fn light_levels_hold_under_models_of_every_kind() {
    let one = f64::from(ONE);
    let any = |rng: &mut Rng, low, high| [(); 3].map(|()| (one * rng.log(low, high)) as i32);
    // The scale, and whether the model stays rigid but for its size.
    type Kind<'a> = (&'a str, &'a dyn Fn(&mut Rng) -> [i32; 3], bool);
    let kinds: [Kind<'_>; 7] = [
        ("rotations", &|_| [ONE; 3], true),
        ("even scales", &|rng| [rng.log(100.0, 6e8) as i32; 3], true),
        ("even scales that mirror", &|rng| [(); 3].map(|()| [ONE, -ONE][rng.below(2)]), true),
        ("uneven scales", &|rng| any(rng, 0.2, 5.0), false),
        ("scales that mirror", &|rng| any(rng, 0.2, 5.0).map(|c| c * [1, -1][rng.below(2)]), false),
        (
            "nearly even scales",
            &|rng| {
                let bend = rng.log(1e-4, 0.1);
                [(); 3].map(|()| (one * (1.0 + rng.real(-bend, bend))) as i32)
            },
            false,
        ),
        ("scales of up to 10 000 to 1", &|rng| any(rng, 0.01, 100.0), false),
    ];
    let mut rng = Rng::new(0x8A);
    for (name, scale, rigid) in kinds {
        let mut worst = 0.0f64;
        for _ in 0..15_000 {
            let mut model = ModelBits::random_rotation(&mut rng);
            model.0.push(Step::Scale(scale(&mut rng)));
            model.0.extend(ModelBits::random_rotation(&mut rng).0);
            // Light does not depend on the translation.
            model.0.push(Step::Move([(); 3].map(|()| rng.bits() as i32)));
            worst = worst.max(check(&mut rng, &model, rigid));
        }
        println!("{name}: within {worst:.3} levels");
    }
}
