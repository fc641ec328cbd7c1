//! Spheres around spheres, and spheres that a model transform moves: what lies in the one lies in the other, and the radius is
//! within its bound. `Camera::framing`: all of the sphere is seen, and it fills the frame. Points of the sphere, and of its silhouette,
//! are computed in f64 from the bits; that `project` agrees with f64 is tested in `vertex_chain.rs`.

use embedded_graphics::geometry::{Point, Size};
use pinhole::meshes::{CUBE, TORUS};
use pinhole::space::{Model, World};
use pinhole::{camera::CameraError, math::Sphere, prelude::*, Angle};
use support::oracle::chain::{fx, sin_cos, to_fx};
use support::oracle::rng::Rng;

/// Centre and radius in 2⁻¹⁶.
fn numbers(sphere: &Sphere) -> ([f64; 3], f64) {
    let Sphere { centre, radius } = sphere;
    let bits = |c: Scalar| f64::from(c.to_bits());
    ([bits(centre.x()), bits(centre.y()), bits(centre.z())], bits(*radius))
}

fn sphere(centre: [i32; 3], radius: i32) -> Sphere {
    let [x, y, z] = centre.map(Scalar::from_bits);
    Sphere { centre: Point3::new(x, y, z), radius: Scalar::from_bits(radius) }
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
    let far = Sphere { centre: Point3::from_ints(30000, 0, 0), radius: Scalar::ONE }.transformed(&away);
    assert_eq!(far.radius, Scalar::MAX, "its centre is beyond Scalar");
    assert_eq!(sphere([0; 3], 1 << 30).transformed(&Affine::scale(Scalar::from_int(3))).radius, Scalar::MAX);
}

#[test]
fn a_transformed_sphere_holds_what_the_transform_makes_of_it() {
    let mut rng = Rng::new(0x5f02);
    for case in 0..3000 {
        let angles: [Angle; 6] = [0; 6].map(|_| Angle::from_bits(rng.bits()));
        let scales = [0; 3].map(|_| Scalar::try_from(rng.log(0.02, 40.0)).expect("in range"));
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
        let stretch = scales.map(f64::from).into_iter().fold(0.0, f64::max);
        // A rotation before the scales leaves their lengths, but the rows of the product are not along axes.
        let factor = if case % 2 == 0 { 1.0 } else { 1.32 };
        let most = stretch * factor * r * (1.0 + 2f64.powi(-25)) + 4.0;
        assert!(radius <= most, "{radius}, at most {most}");
    }
}

#[test]
fn a_scene_s_sphere_is_around_its_objects() {
    let torus = TORUS;
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

/// Sine of the angle at which the silhouette is seen from the eye: its tangent is 31/32 of that of half the field of view.
fn silhouette(field_of_view: Angle) -> f64 {
    let (sine, cosine) = sin_cos(field_of_view.bits() / 2);
    (sine * 31.0 / 32.0).atan2(cosine).sin()
}

/// A random sphere, field of view, yaw, pitch and viewport, of all sizes.
struct Case {
    sphere: Sphere,
    field_of_view: Angle,
    yaw: Angle,
    pitch: Angle,
    viewport: Viewport,
}

impl Case {
    fn random(rng: &mut Rng) -> Self {
        let radius = rng.log(1.0, 2e9) as i32;
        let centre = [0; 3].map(|_| rng.int(-1 << 30, 1 << 30) as i32);
        let field_of_view = match rng.below(3) {
            0 => rng.int(1 << 20, (1 << 31) - (1 << 20)),
            1 => rng.int(1 << 28, 1 << 30), // 22.5° to 90°
            _ => rng.log(1.1e6, 2e9) as i64,
        };
        let [width, height] = [0; 2].map(|_| rng.log(1.0, 4000.0) as u32);
        Self {
            sphere: sphere(centre, radius),
            field_of_view: Angle::from_bits(field_of_view as u32),
            yaw: Angle::from_bits(rng.bits()),
            pitch: Angle::from_bits(rng.bits()),
            viewport: Viewport::new(Point::new(-7, 13), Size::new(width, height))
                .expect("inside the guard band"),
        }
    }

    fn camera(&self) -> Result<Camera, CameraError> {
        Camera::framing(&self.sphere, &self.viewport, self.field_of_view, self.yaw, self.pitch)
    }

    /// The directions to the right, up and to the viewer, from the angles.
    fn axes(&self) -> [[f64; 3]; 3] {
        let ((sy, cy), (sp, cp)) = (sin_cos(self.yaw.bits()), sin_cos(self.pitch.bits()));
        [[cy, 0.0, -sy], [-sy * sp, cp, -cy * sp], [sy * cp, sp, cy * cp]]
    }

    /// How far from the middle of the viewport points are seen, as fractions of half the width and half the height. The points
    /// are given by their direction from the sphere's centre. Also asserts that near and far planes do not cut them off.
    fn offsets(&self, camera: &Camera, directions: &[[f64; 3]]) -> Vec<[f64; 2]> {
        // Vertices of 15 bits, rounded towards the centre so that none lies outside of the sphere.
        let exponent = fx(self.sphere.radius.to_bits()).log2().ceil() as i8 - 15;
        let step = f64::from(exponent).exp2();
        let radius = fx(self.sphere.radius.to_bits());
        let vertices: Vec<[i16; 3]> =
            directions.iter().map(|d| d.map(|c| (c * radius / step).trunc() as i16)).collect();
        let mesh = Mesh::new(&vertices, exponent, &[]).expect("an exponent in range");
        let [x, y, z] = [self.sphere.centre.x(), self.sphere.centre.y(), self.sphere.centre.z()];
        let model = Affine::translation(Vector3::new(x, y, z));
        let far_clip = camera.with_far_clip(true);
        let instance = far_clip.place(&mesh, &model);
        let (Size { width, height }, Point { x, y }) = (self.viewport.size(), self.viewport.area().top_left);
        let half = [f64::from(width) * 128.0, f64::from(height) * 128.0];
        let middle = [f64::from(x) * 256.0 + half[0], f64::from(y) * 256.0 + half[1]];
        (0..vertices.len())
            .map(|index| {
                let at = instance.project(index).expect("between near and far").point;
                let off = |at: i32, axis: usize| {
                    ((f64::from(at) - middle[axis]).abs() - 0.5) / half[axis] // less the rounding to 1/256 px
                };
                [off(at.x(), 0), off(at.y(), 1)]
            })
            .collect()
    }
}

#[test]
fn all_of_the_sphere_is_in_the_frame_and_fills_it() {
    let mut rng = Rng::new(0x27);
    let (mut framed, mut filled, mut least) = (0, 0, f64::MAX);
    for _ in 0..6000 {
        let case = Case::random(&mut rng);
        let Ok(camera) = case.camera() else { continue };
        framed += 1;
        let sine = silhouette(case.field_of_view);
        let cosine = (1.0 - sine * sine).sqrt();
        let [right, up, viewer] = case.axes();
        // Where the silhouette is farthest right, left, up and down, and points of the sphere everywhere.
        let mut directions: Vec<[f64; 3]> = [(right, 1.0), (right, -1.0), (up, 1.0), (up, -1.0)]
            .map(|(axis, sign)| core::array::from_fn(|i| viewer[i] * sine + axis[i] * cosine * sign))
            .to_vec();
        directions.extend([viewer, viewer.map(|c| -c)]);
        directions.extend((0..60).map(|_| rng.direction()));
        let offsets = case.offsets(&camera, &directions);
        for (offset, direction) in offsets.iter().zip(&directions) {
            assert!(offset.iter().all(|&o| o < 1.0), "{offset:?} at {direction:?}: {:?}", case.sphere);
        }
        // Vertices of 15 bits show where the silhouette is if the eye is not close to the sphere.
        if 1.0 / sine - 1.0 > 0.002
            && fx(case.sphere.radius.to_bits()) / sine - fx(case.sphere.radius.to_bits()) > 0.002
        {
            let Size { width, height } = case.viewport.size();
            let narrower = usize::from(height < width);
            let most = offsets[..4].iter().map(|o| o[narrower]).fold(0.0, f64::max);
            let half = f64::from(width.min(height)) * 128.0;
            least = least.min(most + 1.5 / half);
            filled += 1;
        }
    }
    assert!(framed > 3000 && filled > 2000, "{framed} {filled}");
    assert!(least >= 0.95, "{least}");
}

/// A refused camera is impossible by arithmetic in f64 too, not only for this implementation.
#[test]
fn what_is_refused_has_no_room() {
    let mut rng = Rng::new(0x28);
    let (mut far, mut near) = (0, 0);
    for _ in 0..6000 {
        let case = Case::random(&mut rng);
        let radius = f64::from(case.sphere.radius.to_bits());
        let distance = radius / silhouette(case.field_of_view);
        match case.camera() {
            Ok(_) => assert!(distance + radius < 2_147_483_648.0 && distance - radius > 62.0),
            Err(CameraError::OutOfRange) => {
                far += 1;
                assert!(distance + radius * (65.0 / 64.0) > 2_147_483_000.0, "{radius} {distance}");
            }
            Err(CameraError::TooNear) => {
                near += 1;
                assert!(distance - radius < 66.0, "{radius} {distance}");
            }
            Err(error) => panic!("{error}"),
        }
    }
    assert!(far > 100 && near > 100, "{far} {near}");
}

#[test]
fn spheres_and_angles_out_of_range_are_explained() {
    let viewport = Viewport::new(Point::zero(), Size::new(240, 320)).expect("a viewport");
    let frame = |radius: i32, field_of_view: Angle| {
        Camera::framing(&sphere([0; 3], radius), &viewport, field_of_view, Angle::ZERO, Angle::ZERO).err()
    };
    let [wide, good] = [180, 40].map(Angle::degrees);
    assert_eq!(frame(0, good), Some(CameraError::NoRadius));
    assert_eq!(frame(-1, good), Some(CameraError::NoRadius));
    assert_eq!(frame(1 << 16, wide), Some(CameraError::FieldOfView));
    assert_eq!(frame(1 << 16, Angle::ZERO), Some(CameraError::FieldOfView));
    assert_eq!(frame(i32::MAX, good), Some(CameraError::OutOfRange));
    assert_eq!(frame(3, good), Some(CameraError::TooNear));
    assert_eq!(frame(1 << 16, good), None);
    for error in
        [CameraError::NoRadius, CameraError::FieldOfView, CameraError::OutOfRange, CameraError::TooNear]
    {
        assert!(error.to_string().len() > 20, "{error:?}");
    }
    // Without vertices, and with one, there is nothing to frame.
    for vertices in [&[][..], &[[3, 4, 5]]] {
        let mesh = Mesh::new(vertices, 0, &[]).expect("a mesh");
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, good, Angle::ZERO, Angle::ZERO);
        assert!(matches!(camera, Err(CameraError::NoRadius | CameraError::TooNear)));
    }
}

/// A camera that does not move can be a `const`.
#[test]
fn a_framing_camera_can_be_const() {
    const CAMERA: Camera = {
        let centre = Point3::from_ints(1, 2, 3);
        let Ok(viewport) = Viewport::new(Point::zero(), Size::new(128, 64)) else { panic!("the size") };
        let sphere = Sphere { centre, radius: Scalar::from_int(10) };
        match Camera::framing(&sphere, &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO) {
            Ok(camera) => camera,
            Err(_) => panic!("the sphere"),
        }
    };
    // By hand: the silhouette, 10 above the centre at most, is drawn 31/32 of the half height above the middle.
    let sine = silhouette(Angle::degrees(30));
    let top = [1.0, 2.0 + 10.0 * (1.0 - sine * sine).sqrt(), 3.0 + 10.0 * sine];
    let [x, y, z] = top.map(|c| Scalar::from_bits(to_fx(c).expect("in range")));
    let at = CAMERA.project(Point3::new(x, y, z)).expect("in view").point;
    assert_eq!((at.x(), at.y()), (64 * 256, 256));
}
