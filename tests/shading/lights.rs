//! docs/spec.md, section 8: ambient and Lambert light per face, several lights, highlights, point lights and material captures against
//! f64, each within its documented bound, which is at most twice the largest error met.

use pinhole::light::{BlinnPhong, Lambert, Light, LightError, Lights, Matcap, PointLight, RigidLambert};
use support::bridge::pair::{bits, random_view, ModelBits, Step, ONE};
use support::bridge::texels::{Numbered, Shown};
use support::bridge::{point, scalar, vector};
use support::oracle::chain::{self, V3};
use support::oracle::rng::Rng;

/// The normal through the inverse transpose: the cofactors, which are det · inverse transpose.
fn normal(model: &chain::Affine, n: V3) -> V3 {
    let [a, b, c] = model.m;
    // Rows of the cofactor matrix.
    let cofactors = [chain::cross(b, c), chain::cross(c, a), chain::cross(a, b)];
    let det = chain::dot(a, cofactors[0]);
    chain::normalise(chain::mul3(&cofactors, n).map(|c| c * det.signum()))
}

/// Checks `Lambert`, and `RigidLambert` where it takes the model, which it must if it is `rigid`.
fn check_lambert(rng: &mut Rng, model: &ModelBits, rigid: bool) -> f64 {
    let ambient = rng.int(0, 256) as u16;
    let length = rng.log(0.001, 30000.0);
    let Some(light) = bits(rng.direction().map(|c| c * length)) else {
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
            worst = worst.max(check_lambert(&mut rng, &model, rigid));
        }
        println!("{name}: within {worst:.3} levels");
    }
}

/// A rotation, possibly a uniform scale or a mirror, or any scale with a rotation before and after; moved about. The second value is whether it is stretched.
fn random_model(rng: &mut Rng) -> (ModelBits, bool) {
    let mut model = ModelBits::random_rotation(rng);
    let stretched = rng.one_in(3);
    if stretched {
        model.0.push(Step::Scale(
            [0; 3].map(|_| (f64::from(ONE) * rng.log(0.2, 5.0)) as i32 * [1, -1][rng.below(2)]),
        ));
        model.0.extend(ModelBits::random_rotation(rng).0);
    } else if rng.one_in(2) {
        let size = (f64::from(ONE) * rng.log(0.01, 50.0)) as i32;
        model.0.push(Step::Scale([0; 3].map(|_| size * [1, -1][rng.below(2)])));
    }
    model.0.push(Step::Move([0; 3].map(|_| rng.int(-100 << 16, 100 << 16) as i32)));
    (model, stretched)
}

/// A vector of any length, as bits, long enough that its direction is not one of few.
fn random_vector(rng: &mut Rng) -> [i32; 3] {
    let length = rng.log(0.01, 30_000.0);
    bits(rng.direction().map(|c| c * length)).expect("in range")
}

/// A unit normal in 2⁻¹⁵.
fn random_normal(rng: &mut Rng) -> [i16; 3] {
    rng.direction().map(|c| (c * 32767.0).round() as i16)
}

fn unit(bits: [i32; 3]) -> V3 {
    chain::normalise(chain::fx3(bits))
}

#[test]
fn sums_of_lights_are_within_their_bound() {
    let mut rng = Rng::new(0xA1);
    let mut worst = [0.0f64; 2];
    for _ in 0..20_000 {
        let (model, stretched) = random_model(&mut rng);
        let lights = [(); 4].map(|()| (random_vector(&mut rng), rng.int(0, 300) as u16));
        let ambient = rng.int(0, 80) as u16;
        let ours = Lights::new(
            &model.library(),
            &lights.map(|(towards, strength)| (vector(towards), strength)),
            ambient,
        )
        .expect("lights");
        let exact = model.exact();
        for _ in 0..5 {
            let n = random_normal(&mut rng);
            let world = normal(&exact, n.map(f64::from));
            let parts = lights.map(|(towards, strength)| {
                f64::from(strength.min(256)) * chain::dot(world, unit(towards)).max(0.0)
            });
            let level = (f64::from(ambient) + parts.iter().sum::<f64>()).min(256.0);
            let error = (f64::from(ours.level(n)) - level).abs();
            let bound = 0.5 + 4.0 / 64.0;
            assert!(error <= bound, "{error} off: {model:?} {lights:?} {n:?}");
            worst[usize::from(stretched)] = worst[usize::from(stretched)].max(error);
        }
    }
    println!("within {worst:?} levels");
    assert!(worst[0] > 0.5 && worst[1] > 0.5, "{worst:?}");
}

#[test]
fn one_light_and_no_light_are_lights() {
    let model = ModelBits::default().library();
    let towards = vector([ONE, 2 * ONE, -ONE]);
    let one = Lights::new(&model, &[(towards, 200)], 56).expect("a light");
    let lambert = Lambert::new(&model, towards, 56).expect("a light");
    let mut rng = Rng::new(0xA2);
    for normal in [(); 100].map(|()| random_normal(&mut rng)) {
        // Both are within 1 of the exact level.
        assert!(one.level(normal).abs_diff(lambert.level(normal)) <= 1);
    }
    let dark = Lights::new(&model, &[], 300).expect("no light");
    assert_eq!(dark.level([0, 0, 32767]), 256);
    let zero = (vector([0; 3]), 9);
    assert_eq!(Lights::new(&model, &[zero], 0), Err(LightError::ZeroDirection));
    // Many full lights do not wrap.
    let full = [(vector([0, 0, ONE]), 256); 9];
    assert_eq!(Lights::new(&model, &full, 256).expect("lights").level([0, 0, 32767]), 256);
}

/// A level by the documentation's formula.
fn blinn_phong(n: V3, l: V3, v: V3, ambient: f64, shininess: i32) -> f64 {
    let lit = chain::dot(n, l);
    let diffuse = 0.75 * (ambient + (256.0 - ambient) * lit.max(0.0));
    let half = chain::normalise([0, 1, 2].map(|i| l[i] + v[i]));
    let shine = if lit > 0.0 { chain::dot(n, half).max(0.0).powi(shininess) } else { 0.0 };
    diffuse + (256.0 - diffuse) * shine
}

#[test]
fn highlights_are_within_their_bound() {
    let mut rng = Rng::new(0xA3);
    let (mut worst, mut sum, mut count) = ([0.0f64; 9], 0.0, 0.0);
    for _ in 0..60_000 {
        let (model, _) = random_model(&mut rng);
        let (light, viewer) = (random_vector(&mut rng), random_vector(&mut rng));
        let (l, v) = (unit(light), unit(viewer));
        if chain::dot(l, v) < -0.999 {
            continue; // nearly opposite: half of nothing
        }
        let (ambient, power) = (rng.int(0, 256) as u16, rng.below(9));
        // Rounded down to a power of two.
        let shininess = (1 << power) + rng.below(1 << power) as u16;
        let ours =
            BlinnPhong::new(&model.library(), vector(light), vector(viewer), ambient, shininess).expect("ok");
        let exact = model.exact();
        let half = chain::normalise([0, 1, 2].map(|i| l[i] + v[i]));
        for i in 0..8 {
            // Half of the normals near the highlight, for a rigid model.
            let near = chain::normalise(chain::mul3(
                &[0, 1, 2].map(|i| [0, 1, 2].map(|j| exact.m[j][i])),
                [0, 1, 2].map(|i| half[i] + 0.1 * rng.real(-1.0, 1.0)),
            ));
            let n = if i % 2 == 0 { near } else { rng.direction() };
            let n = n.map(|c| (c * 32767.0).round() as i16);
            let world = normal(&exact, n.map(f64::from));
            if chain::dot(world, l).abs() < (-13f64).exp2() {
                continue; // the light grazes
            }
            let level = blinn_phong(world, l, v, f64::from(ambient), 1 << power);
            let off = f64::from(ours.level(n)) - level;
            (sum, count) = (sum + off, count + 1.0);
            let error = off.abs();
            let bound = 0.625 + f64::from(1 << power) / 64.0;
            assert!(error <= bound, "{error} off, 2^{power}: {model:?} {light:?} {viewer:?} {n:?}");
            worst[power] = worst[power].max(error);
        }
    }
    let mean: f64 = sum / count;
    println!("within {worst:.3?} levels, {mean:.4} on average");
    // Rounded to the nearest level, not down: half a level less on average.
    assert!(mean.abs() < 0.1, "{mean}");
    for (power, worst) in worst.into_iter().enumerate() {
        assert!(0.625 + f64::from(1 << power) / 64.0 <= 2.0 * worst, "2^{power}: {worst}");
    }
}

#[test]
fn highlights_end_where_light_does() {
    let model = ModelBits::default().library();
    let up = vector([0, 0, ONE]);
    assert_eq!(BlinnPhong::new(&model, vector([0; 3]), up, 0, 8), Err(LightError::ZeroDirection));
    assert_eq!(BlinnPhong::new(&model, up, vector([0; 3]), 0, 8), Err(LightError::ZeroDirection));
    // The light straight behind: a side that faces the viewer is unlit, and nothing shines.
    let behind = BlinnPhong::new(&model, vector([0, 0, -ONE]), up, 64, 8).expect("a light");
    assert_eq!(behind.level([0, 0, 32767]), 48);
    assert_eq!(behind.level([0, 0, -32767]), 192);
    // No shininess counts as 1, more than 256 as 256.
    let [none, one] = [0, 1].map(|shininess| BlinnPhong::new(&model, up, up, 0, shininess));
    assert_eq!(none, one);
    let [most, more] = [256, u16::MAX].map(|shininess| BlinnPhong::new(&model, up, up, 0, shininess));
    assert_eq!(most, more);
}

#[test]
fn point_lights_are_within_their_bound() {
    let mut rng = Rng::new(0xA4);
    let [mut worst, mut near, mut sum] = [0.0f64; 3];
    let mut lit = 0;
    for _ in 0..60_000 {
        let (model, _) = random_model(&mut rng);
        let exact = model.exact();
        let exponent = rng.int(-16, -8) as i8;
        let vertex = [0; 3].map(|_| rng.int(-32768, 32767) as i16);
        let at = exact.apply(chain::vertex(vertex, exponent));
        // Distances from a ten-thousandth of the range to a little beyond it.
        let range = (rng.log(0.25, 4000.0) * 65536.0) as i32;
        let distance = chain::fx(range) * rng.log(0.0001, 1.1);
        let direction = rng.direction();
        let Some(position) = bits([0, 1, 2].map(|i| at[i] + distance * direction[i])) else { continue };
        let strength = rng.int(0, 256) as u16;
        let ours = PointLight::new(&model.library(), exponent, point(position), scalar(range), strength);
        let n = random_normal(&mut rng);
        let towards = [0, 1, 2].map(|i| chain::fx(position[i]) - at[i]);
        let (r, range) = (chain::length(towards), chain::fx(range));
        let spread = (0..3).map(|i| chain::length(exact.m[i])).fold(0.0, f64::max)
            * 2.0
            * 32768.0
            * f64::from(exponent).exp2();
        if spread > 64.0 * range {
            continue; // larger than the bound allows
        }
        let fade = (1.0 - (r / range).powi(2)).max(0.0).powi(2);
        let cosine = chain::dot(normal(&exact, n.map(f64::from)), chain::normalise(towards)).max(0.0);
        let level = f64::from(strength) * cosine * fade;
        let off = f64::from(ours.level(vertex, n)) - level;
        let error = off.abs();
        let bound = 0.625 + range / r * (-15f64).exp2();
        assert!(error <= bound, "{error} off: {model:?} {vertex:?} 2^{exponent} {position:?} {range} {n:?}");
        worst = worst.max(error / bound);
        if r < range / 1000.0 {
            near = near.max((error - 0.5) * r / range);
        }
        if level > 1.0 {
            (lit, sum) = (lit + 1, sum + off);
        }
    }
    let mean: f64 = sum / f64::from(lit);
    println!("{worst:.3} of the bound; 2^{:.2} range/r; {lit} lit, {mean:.4} off on average", near.log2());
    // Rounded to the nearest level, not down: half a level less on average.
    assert!(mean.abs() < 0.05, "{mean}");
    assert!(worst > 0.5 && near > (-16f64).exp2() && lit > 5_000, "{worst} {near} {lit}");
}

#[test]
fn point_lights_without_range_light_nothing() {
    let model = ModelBits::default().library();
    let up = [0, 0, 32767];
    let light = |exponent, z: i32, range: i32| {
        PointLight::new(&model, exponent, point([0, 0, z]), scalar(range), 256).level([0; 3], up)
    };
    for range in [0, -1, i32::MIN] {
        assert_eq!(light(0, 1, range), 0, "{range}");
    }
    // The smallest range, the largest, a light at the vertex, and steps of a mesh that are longer than any range.
    assert_eq!(light(-10, 1, 2), 144);
    assert_eq!(light(0, 1 << 30, i32::MAX), 144);
    assert_eq!(light(0, 0, ONE), 0);
    assert_eq!(light(15, 1, 2), 0);
    assert_eq!(light(-32, 1, 2), 144);
    // Any model, any place, any exponent: no overflow.
    let mut rng = Rng::new(0xA5);
    for _ in 0..20_000 {
        let model = ModelBits(vec![
            Step::X(rng.bits()),
            Step::Scale([0; 3].map(|_| rng.bits() as i32)),
            Step::Move([0; 3].map(|_| rng.bits() as i32)),
            Step::Scale([0; 3].map(|_| rng.bits() as i32 >> rng.below(31))),
        ]);
        let place = point([0; 3].map(|_| rng.bits() as i32));
        let exponent = rng.int(-32, 15) as i8;
        let range = rng.bits() as i32 >> rng.below(31);
        let light = PointLight::new(&model.library(), exponent, place, scalar(range), u16::MAX);
        let vertex = [0; 3].map(|_| rng.bits() as i16);
        assert!(light.level(vertex, random_normal(&mut rng)) <= 256);
        assert!(light.level(vertex, [i16::MIN; 3]) <= 256);
    }
}

#[test]
fn levels_of_point_lights_add_up() {
    let model = ModelBits::default().library();
    let light = PointLight::new(&model, 0, point([0, 0, 2 * ONE]), scalar(4 * ONE), 256);
    let (vertices, up) = ([[0; 3], [0, 0, 1], [9, 0, 0]], [0, 0, 32767]);
    let sums = [0, 1, 2].map(|i: usize| ([100, 200, 30][i] + light.level(vertices[i], up)).min(256));
    assert_eq!(sums, [244, 256, 30]);
}

#[test]
fn matcap_coordinates_are_within_their_bound() {
    let mut rng = Rng::new(0xA6);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let (model, _) = random_model(&mut rng);
        let view = random_view(&mut rng);
        let (ours, exact) = (view.library().expect("a view"), view.exact());
        let matcap = Matcap::new(&ours, &model.library());
        let model = model.exact();
        for _ in 0..5 {
            let n = random_normal(&mut rng);
            let [x, y, _] = chain::mul3(&exact.rows, normal(&model, n.map(f64::from)));
            let [u, v] = matcap.coords(n);
            for (ours, exact) in [(u, x), (v, -y)] {
                let error = (f64::from(ours) / 32768.0 - (0.5 + 127.0 / 256.0 * exact)).abs();
                assert!(error <= (-14f64).exp2(), "{error}: {view:?} {n:?}");
                assert!((128..=32_640).contains(&ours));
                worst = worst.max(error);
            }
            let Shown([column, row]) = matcap.color(Numbered([4, 3]), n);
            let texel = [i32::from(u) * 16, i32::from(v) * 8].map(|c| (c >> 15) as u32);
            assert_eq!([column >> 28, row >> 29], texel);
        }
    }
    println!("within 2^{:.2} of a side", worst.log2());
    assert!((-14f64).exp2() <= 2.0 * worst, "2^{:.2}", worst.log2());
}

/// The levels and coordinates of a list of normals are those of each normal, up to the end of the shorter list.
#[test]
fn lists_of_normals_are_lit_one_by_one() {
    let mut rng = Rng::new(0xA7);
    for _ in 0..200 {
        let (model, _) = random_model(&mut rng);
        let (model, towards) = (model.library(), vector(random_vector(&mut rng)));
        let normals: Vec<_> = (0..rng.below(9)).map(|_| random_normal(&mut rng)).collect();
        let length = rng.below(9);
        let check = |name: &str, level: &dyn Fn([i16; 3]) -> u16, all: &dyn Fn(&mut [u16])| {
            let mut levels = vec![999; length];
            all(&mut levels);
            for (i, found) in levels.into_iter().enumerate() {
                assert_eq!(found, normals.get(i).map_or(999, |&normal| level(normal)), "{name}");
            }
        };
        let light = Lambert::new(&model, towards, 40).expect("a light");
        check("Lambert", &|n| light.level(n), &|levels| light.levels(&normals, levels));
        let light = Lights::new(&model, &[(towards, 90)], 56).expect("a light");
        check("lights", &|n| light.level(n), &|levels| light.levels(&normals, levels));
        let light = BlinnPhong::new(&model, towards, vector([0, 0, ONE]), 64, 8).expect("a light");
        check("highlights", &|n| light.level(n), &|levels| light.levels(&normals, levels));
        let matcap = Matcap::new(&random_view(&mut rng).library().expect("a view"), &model);
        // A normal that is too long stays in the picture.
        assert!(matcap.coords([i16::MIN; 3]).iter().all(|c| (128..=32_640).contains(c)));
    }
}
