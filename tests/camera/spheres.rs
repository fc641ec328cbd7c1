//! Spheres around spheres, and spheres that a model transform moves: what lies in the one lies in the other, and the radius is
//! within its bound. Everything is computed in f64 from the bits.

use pinhole::meshes::{CUBE, TORUS};
use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, Object, Point3, Scalar, Scene, Sphere, Vector3};
use support::oracle::rng::Rng;

/// Centre and radius in 2⁻¹⁶.
fn numbers(sphere: &Sphere) -> ([f64; 3], f64) {
    let Sphere { centre, radius } = sphere;
    let bits = |c: Scalar| f64::from(c.to_bits());
    ([bits(centre.x()), bits(centre.y()), bits(centre.z())], bits(*radius))
}

fn sphere(centre: [i32; 3], radius: i32) -> Sphere {
    let [x, y, z] = centre.map(Scalar::from_bits);
    Sphere::new(Point3::new(x, y, z), Scalar::from_bits(radius))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

fn random(rng: &mut Rng, largest: f64) -> Sphere {
    let reach = rng.log(4.0, largest) as i64;
    let centre = [0; 3].map(|_| rng.int(-reach, reach) as i32);
    sphere(centre, rng.log(1.0, largest) as i32)
}

#[test]
fn a_sphere_around_spheres_holds_each_and_is_not_much_larger() {
    let mut rng = Rng::new(0x5f01);
    for count in (1..7).cycle().take(3000) {
        let spheres: Vec<Sphere> = (0..count).map(|_| random(&mut rng, 4e8)).collect();
        let (centre, radius) = numbers(&Sphere::around(spheres.iter().copied()));
        let mut box_ = [(f64::MAX, f64::MIN); 3];
        let mut needed = 0f64;
        for (c, r) in spheres.iter().map(numbers) {
            needed = needed.max(distance(centre, c) + r);
            for (axis, (low, high)) in box_.iter_mut().enumerate() {
                (*low, *high) = (low.min(c[axis] - r), high.max(c[axis] + r));
            }
        }
        // f64 holds the sums and squares to 2⁻⁵² of themselves.
        assert!(radius >= needed - 1e-3 && radius <= needed + 7.0, "{needed} {radius}");
        let half = box_.map(|(low, high)| (high - low) / 2.0);
        assert!((0..3).all(|i| (box_[i].0 + half[i] - centre[i]).abs() <= 0.5), "the middle of the box");
        // No smaller sphere than the box's longest half side can hold them.
        let least = half.into_iter().fold(0.0, f64::max);
        assert!(radius <= least * 3f64.sqrt() + 8.0, "{least} {radius}");
        if count == 1 {
            assert_eq!((centre, radius), numbers(&spheres[0]), "one sphere is itself");
        }
    }
}

#[test]
fn a_sphere_around_what_has_no_bound_has_none() {
    assert_eq!(Sphere::around([]), sphere([0; 3], 0));
    let negative = sphere([7, 8, 9], -5);
    assert_eq!(Sphere::around([negative]), sphere([7, 8, 9], 0));
    let all = sphere([1, 2, 3], i32::MAX);
    assert_eq!(Sphere::around([all, sphere([0; 3], 4)]).radius, Scalar::MAX);
    // Twice as far apart as a radius reaches.
    let ends = [i32::MIN, i32::MAX].map(|x| sphere([x, x, x], i32::MAX - 1));
    let both = Sphere::around(ends);
    assert_eq!((both.centre, both.radius), (sphere([-1; 3], 0).centre, Scalar::MAX));
    assert_eq!(all.transformed(&Affine::identity()).radius, Scalar::MAX);
    let away = Affine::translation(Vector3::from_ints(32767, 0, 0));
    let far = Sphere::new(Point3::from_ints(30000, 0, 0), Scalar::ONE).transformed(&away);
    assert_eq!(far.radius, Scalar::MAX, "its centre is beyond Scalar");
    assert_eq!(sphere([0; 3], 1 << 30).transformed(&Affine::scale(Scalar::from_int(3))).radius, Scalar::MAX);
}

#[test]
fn a_transformed_sphere_holds_what_the_transform_makes_of_it() {
    let mut rng = Rng::new(0x5f02);
    for case in 0..3000 {
        let angles: [Angle; 6] = [0; 6].map(|_| Angle::from_bits(rng.bits()));
        let scales = [0; 3].map(|_| Scalar::from_f64(rng.log(0.02, 40.0)).expect("in range"));
        let moved = Vector3::from_ints(rng.int(-90, 90) as i16, 5, rng.int(-9000, 9000) as i16);
        // Scales along the axes, then a rotation; every second one after another rotation, which shears.
        let mut model = Affine::<Model, World>::identity();
        if case % 2 == 1 {
            model = model.rotate_x(angles[0]).rotate_y(angles[1]).rotate_z(angles[2]);
        }
        model = model.then(&Affine::<World, World>::scale_axes(scales[0], scales[1], scales[2]));
        if case % 4 < 2 {
            model = model.then(&Affine::<World, World>::scale_axes(Scalar::ONE, -Scalar::ONE, Scalar::ONE));
        }
        model = model.rotate_z(angles[3]).rotate_x(angles[4]).rotate_y(angles[5]).translate(moved);
        let given = random(&mut rng, 2e6);
        let (from, r) = numbers(&given);
        let (to, radius) = numbers(&given.transformed(&model));
        let matrix = model.to_matrix();
        let image = |p: [f64; 3]| {
            [0, 1, 2].map(|i| {
                let [a, b, c, d] = matrix[i];
                a * p[0] + b * p[1] + c * p[2] + d * 65536.0
            })
        };
        for _ in 0..60 {
            let direction = rng.direction();
            let reached = distance(image([0, 1, 2].map(|i| from[i] + r * direction[i])), to);
            assert!(reached <= radius, "{reached} {radius}");
        }
        let stretch = scales.map(|c| c.to_f64()).into_iter().fold(0.0, f64::max);
        // A rotation before the scales leaves their lengths, but the rows of the product are not along axes.
        let factor = if case % 2 == 0 { 1.0 } else { 1.32 };
        let most = stretch * factor * r * (1.0 + 2f64.powi(-25)) + 4.0;
        assert!(radius <= most, "{radius}, at most {most}");
    }
}

#[test]
fn a_scene_s_sphere_is_around_its_objects() {
    let torus = TORUS.without_planes();
    let mut scene = Scene::<u8, 3>::new();
    assert_eq!(scene.bounding_sphere(), sphere([0; 3], 0));
    let placed = [
        (&CUBE, Affine::identity().rotate_y(Angle::degrees(45)).translate(Vector3::from_ints(-7, 0, 0))),
        (&torus, Affine::scale(Scalar::from_int(2)).translate(Vector3::from_ints(5, 3, 1))),
    ];
    for (mesh, model) in placed {
        scene.add(Object::new(mesh, model, 0)).expect("room for three");
    }
    let (centre, radius) = numbers(&scene.bounding_sphere());
    let mut needed = 0f64;
    for (mesh, model) in placed {
        let (unit, matrix) = (f64::from(mesh.exponent()).exp2(), model.to_matrix());
        for v in mesh.vertices() {
            let [x, y, z] = v.map(|c| f64::from(c) * unit);
            let at = matrix.map(|[a, b, c, d]| (a * x + b * y + c * z + d) * 65536.0);
            needed = needed.max(distance([at[0], at[1], at[2]], centre));
        }
    }
    // From -7 - √3 to 5 + 2: 15.7 wide, and the spheres about mesh and scene are not the smallest.
    assert!(needed <= radius && radius < 9.5 * 65536.0, "{needed} {radius}");
}
