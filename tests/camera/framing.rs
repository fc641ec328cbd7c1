//! `Camera::framing`: all of the sphere is seen, and it fills the frame. Points of the sphere, and of its silhouette, are computed
//! in f64 from the definition and projected; that `project` agrees with f64 is tested in `vertex_chain.rs`.

use embedded_graphics::geometry::{Point, Size};
use pinhole::{Affine, Angle, Camera, FramingError, Mesh, Point3, Scalar, Sphere, Vector3, Viewport};
use support::oracle::chain::{fx, sin_cos, to_fx};
use support::oracle::rng::Rng;

fn sphere(centre: [i32; 3], radius: i32) -> Sphere {
    let [x, y, z] = centre.map(Scalar::from_bits);
    Sphere { centre: Point3::new(x, y, z), radius: Scalar::from_bits(radius) }
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

    fn camera(&self) -> Result<Camera, FramingError> {
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
        let (Size { width, height }, Point { x, y }) = (self.viewport.size(), self.viewport.top_left());
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
            Err(FramingError::TooFar) => {
                far += 1;
                assert!(distance + radius * (65.0 / 64.0) > 2_147_483_000.0, "{radius} {distance}");
            }
            Err(FramingError::TooNear) => {
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
    assert_eq!(frame(0, good), Some(FramingError::NoRadius));
    assert_eq!(frame(-1, good), Some(FramingError::NoRadius));
    assert_eq!(frame(1 << 16, wide), Some(FramingError::FieldOfView));
    assert_eq!(frame(1 << 16, Angle::ZERO), Some(FramingError::FieldOfView));
    assert_eq!(frame(i32::MAX, good), Some(FramingError::TooFar));
    assert_eq!(frame(3, good), Some(FramingError::TooNear));
    assert_eq!(frame(1 << 16, good), None);
    for error in
        [FramingError::NoRadius, FramingError::FieldOfView, FramingError::TooFar, FramingError::TooNear]
    {
        assert!(error.to_string().len() > 20, "{error:?}");
    }
    // Without vertices, and with one, there is nothing to frame.
    for vertices in [&[][..], &[[3, 4, 5]]] {
        let mesh = Mesh::new(vertices, 0, &[]).expect("a mesh");
        let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, good, Angle::ZERO, Angle::ZERO);
        assert!(matches!(camera, Err(FramingError::NoRadius | FramingError::TooNear)));
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
