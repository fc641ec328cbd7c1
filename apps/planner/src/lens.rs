//! The camera of a choice, made by the constructors that firmware uses.

use crate::choice::{place, Choice};
use crate::projections::{Kind, Named};
use crate::refused;
use embedded_graphics_core::geometry::Point;
use pinhole::{camera::Window, math::Sphere, prelude::*, Angle};

/// The projection of this name.
pub(crate) fn named(name: &str) -> Result<Named, String> {
    let place = place(&Named::ALL.each_ref().map(|named| named.name), name);
    place.map(|place| Named::ALL[place]).map_err(|problem| format!("projection={name}: {problem}"))
}

/// A projection with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lens {
    /// [`Camera::framing`], with the distances of its near and far planes.
    Framing { field_of_view: i32, range: [f64; 2] },
    /// A perspective that is magnified or moved, or whose view plane is upright. The eye looks at a point beside the centre.
    Frustum { aside: [Scalar; 3], distance: Scalar, window: Window, near: Scalar, far: Scalar },
    /// The eye is at the centre of the mesh, and depth runs from in front of it to behind it.
    Orthographic { window: Window, depth: Scalar },
    /// Like [`Lens::Orthographic`]; the angle is in hundredths of a degree.
    Oblique { window: Window, depth: Scalar, angle: i32, factor: Scalar },
    /// From a view whose origin is the centre of the mesh to clip space.
    Matrix([[f64; 4]; 4]),
}

/// The part of half the narrower side that the bounding sphere fills, as in [`Camera::framing`].
const FILL: f64 = 31.0 / 32.0;

impl Lens {
    /// The lens of a choice for a mesh with this bounding sphere.
    pub(crate) fn new(choice: &Choice, sphere: &Sphere) -> Self {
        let radius = f64::from(sphere.radius);
        let zoom = f64::from(choice.zoom) / 100.0;
        let (width, height) = (f64::from(choice.size.width), f64::from(choice.size.height));
        let narrow = width.min(height);
        let pan = choice.pan.map(|pan| f64::from(pan) / 1000.0);
        // The window of a given half narrower side, off the axis by `off`.
        let window = |half: f64, off: [f64; 2]| {
            let unit = half / zoom / narrow;
            let [x, y] = [0, 1].map(|axis| pan[axis] * half / zoom - off[axis]);
            Window {
                left: scalar(-unit * width - x),
                right: scalar(unit * width - x),
                bottom: scalar(-unit * height - y),
                top: scalar(unit * height - y),
            }
        };
        let deep = radius * 65.0 / 64.0;
        match choice.projection.kind {
            Kind::Oblique { angle, factor } => {
                let half = factor.hypot(1.0) * radius / FILL;
                let angle = (angle * 100.0).round() as i32; // at most 9000
                Self::Oblique {
                    window: window(half, [0.0; 2]),
                    depth: scalar(deep),
                    angle,
                    factor: scalar(factor),
                }
            }
            Kind::Parallel => {
                Self::Orthographic { window: window(radius / FILL, [0.0; 2]), depth: scalar(deep) }
            }
            Kind::Reverse => {
                // w = 1 + u/2 and z = −u − 1/2, where u runs over the mesh from −1 (far) to 1 (near). The sphere is widest at
                // u = −1/2: √(1 − u²)/w = √(4/3).
                let half = radius / FILL * (4.0f64 / 3.0).sqrt();
                let [x, y] = [width, height].map(|side| narrow / side);
                let row = |axis: usize, scale: f64| {
                    let mut row = [0.0, 0.0, pan[axis] * scale / (2.0 * deep), pan[axis] * scale];
                    row[axis] = zoom * scale / half;
                    row
                };
                Self::Matrix([
                    row(0, x),
                    row(1, y),
                    [0.0, 0.0, -1.0 / deep, -0.5],
                    [0.0, 0.0, 0.5 / deep, 1.0],
                ])
            }
            kind => {
                let field_of_view = choice.projection.field_of_view().round() as i32; // at most 100

                // As `Camera::framing` does it, for a sphere that holds the one that is sheared along the projectors: the
                // largest singular value of a shear by l is (l + √(l² + 4))/2.
                let (yaw, lean) = upright(choice).unwrap_or_default();
                let shear = lean[0].hypot(lean[1]);
                let large = radius * (shear + shear.hypot(2.0)) / 2.0;
                let (sine, cosine) = Angle::turns(field_of_view, 720).sin_cos();
                let (sine, cosine) = (f64::from(sine), f64::from(cosine));
                let distance = large * (sine * FILL).hypot(cosine) / (sine * FILL);
                let before = distance - radius;
                let near = before - (radius / 64.0).min(before / 2.0);
                if (kind, choice.zoom, choice.pan) == (Kind::Perspective, 100, [0; 2]) {
                    return Self::Framing { field_of_view, range: [near, distance + deep] };
                }
                let (turned, straight) = sine_cosine(yaw);
                let [right, up] = lean.map(|lean| lean * distance);
                Self::Frustum {
                    aside: [right * straight, up, -right * turned].map(scalar),
                    distance: scalar(distance),
                    window: window(near * sine / cosine, lean.map(|lean| -lean * near)),
                    near: scalar(near),
                    far: scalar(distance + deep),
                }
            }
        }
    }

    /// The distance along the direction of view of a point with this depth. Only ratios of distances are used: in a parallel
    /// projection all are 1.
    pub(crate) fn distance(&self, depth: u16) -> f64 {
        let depth = f64::from(depth) / 65_535.0;
        let between = |near: f64, far: f64| far * near / (far - (far - near) * depth);
        match *self {
            Self::Framing { range: [near, far], .. } => between(near, far),
            Self::Frustum { near, far, .. } => between(f64::from(near), f64::from(far)),
            // z/w = −(u + ½)/(1 + u/2), where w = 1 + u/2.
            Self::Matrix(_) => {
                let z = 2.0 * depth - 1.0;
                1.0 - (z + 0.5) / (z + 2.0)
            }
            Self::Orthographic { .. } | Self::Oblique { .. } => 1.0,
        }
    }

    /// The camera of this lens.
    pub(crate) fn camera(&self, choice: &Choice, sphere: &Sphere) -> Result<Camera, String> {
        let viewport = Viewport::new(Point::zero(), choice.size).map_err(refused::camera)?;
        let [yaw, pitch] = direction(choice).map(|angle| Angle::turns(angle, 36_000));
        let mut centre = [sphere.centre.x(), sphere.centre.y(), sphere.centre.z()];
        let (distance, projection) = match *self {
            Self::Framing { field_of_view, .. } => {
                let field_of_view = Angle::degrees(field_of_view);
                return Camera::framing(sphere, &viewport, field_of_view, yaw, pitch)
                    .map_err(refused::camera);
            }
            Self::Frustum { aside, distance, window, near, far } => {
                centre.iter_mut().zip(aside).for_each(|(c, aside)| *c += aside);
                (distance, Projection::frustum(window, near, far))
            }
            Self::Orthographic { window, depth } => {
                (Scalar::ZERO, Projection::orthographic(window, -depth, depth))
            }
            Self::Oblique { window, depth, angle, factor } => {
                let angle = Angle::turns(angle, 36_000);
                (Scalar::ZERO, Projection::oblique(window, -depth, depth, angle, factor))
            }
            Self::Matrix(matrix) => (Scalar::ZERO, Projection::from_matrix(&matrix)),
        };
        let [x, y, z] = centre;
        let view = ViewTransform::orbit(pinhole::Point3::new(x, y, z), distance, yaw, pitch);
        Ok(Camera::new(&view, &projection.map_err(refused::camera)?, &viewport))
    }
}

/// For an upright view plane: the yaw of its normal in hundredths of a degree, and the slope of the projectors to the right and
/// up, per unit towards the eye. Computed like `Kind::stance`, but by integer angles, which are equal in every browser. `None`
/// for a plane perpendicular to the direction of view.
fn upright(choice: &Choice) -> Option<(i32, [f64; 2])> {
    let kind = choice.projection.kind;
    let steepest = (100.0 * kind.steepest()) as i32; // 7000
    let (sine, cosine) = sine_cosine(choice.pitch.clamp(-steepest, steepest));
    let up = sine / cosine;
    match kind {
        Kind::Upright => Some((choice.yaw, [0.0, up])),
        Kind::Frontal => {
            // The nearest axis; half way between two axes, the one farther from yaw 0.
            let axis = (choice.yaw.abs() + 4500) / 9000 * 9000 * choice.yaw.signum();
            let (sine, cosine) = sine_cosine(choice.yaw - axis);
            Some((axis, [sine / cosine, up / cosine]))
        }
        _ => None,
    }
}

/// Sine and cosine of an angle in hundredths of a degree.
fn sine_cosine(angle: i32) -> (f64, f64) {
    // In 2⁻³⁰.
    let (sine, cosine) = Angle::turns(angle, 36_000).sin_cos();
    (f64::from(sine) / f64::from(1 << 30), f64::from(cosine) / f64::from(1 << 30))
}

/// The view plane's normal, in hundredths of a degree: yaw and pitch.
pub(crate) fn direction(choice: &Choice) -> [i32; 2] {
    upright(choice).map_or([choice.yaw, choice.pitch], |(yaw, _)| [yaw, 0])
}

/// The library's nearest number; lengths here are far below its limit of 32 768.
fn scalar(value: f64) -> Scalar {
    Scalar::from_bits((value * 65_536.0).round() as i32)
}

#[cfg(test)]
mod tests {
    use super::Lens;
    use crate::choice::Choice;
    use crate::projections::Named;
    use pinhole::{math::Sphere, Point3, Scalar};
    use std::f64::consts::{FRAC_PI_2, TAU};

    #[test]
    fn an_upright_plane_lies_as_the_renderers() {
        for named in Named::ALL {
            for (yaw, pitch) in [(30, 20), (-130, -65), (-45, 0), (45, 12), (200, 89)] {
                let text = format!("projection={}&yaw={yaw}&pitch={pitch}", named.name);
                let choice = Choice::parse(&text).expect(&text);
                let Some((plane, lean)) = super::upright(&choice) else { continue };
                let stance = named.kind.stance(yaw.into(), f64::from(pitch).min(70.0)).expect(&text);
                assert!((f64::from(plane) / 100.0 - stance.yaw.to_degrees()).abs() < 1e-9, "{text}: {plane}");
                let off = lean.iter().zip(stance.lean).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < 1e-7, "{text}: {lean:?}, not {:?}", stance.lean);
            }
        }
    }

    /// Checks points of the sphere, near to and far from the eye.
    #[test]
    fn the_sphere_fills_the_picture_and_its_centre_is_in_the_middle() {
        let sphere = Sphere { centre: Point3::from_ints(1, -2, 3), radius: Scalar::from_ratio(3, 2) };
        let mut vertices = vec![[256, -512, 768]];
        for i in 0..40 * 80 {
            let (latitude, longitude) =
                (f64::from(i / 80 - 20) / 20.0 * FRAC_PI_2, f64::from(i % 80) / 80.0 * TAU);
            let direction =
                [latitude.cos() * longitude.cos(), latitude.sin(), latitude.cos() * longitude.sin()];
            // Rounded to the centre: inside.
            vertices.push([0, 1, 2].map(|axis| vertices[0][axis] + (384.0 * direction[axis]) as i16));
        }
        let mesh = pinhole::Mesh::new(&vertices, -8, &[[0, 1, 2]]).expect("points");
        for named in Named::ALL {
            for (yaw, pitch) in [(30, 20), (-130, -65), (200, 89)] {
                let text = format!("projection={}&yaw={yaw}&pitch={pitch}&width=320&height=240", named.name);
                let choice = Choice::parse(&text).expect(&text);
                let camera = Lens::new(&choice, &sphere).camera(&choice, &sphere).expect(&text);
                let instance = camera.place(&mesh, &pinhole::Affine::identity());
                let seen = |vertex: usize| {
                    let point = instance.project(vertex).expect(&text).point;
                    [point.x() - 160 * 256, point.y() - 120 * 256]
                };
                assert!(seen(0).iter().all(|off| off.abs() <= 64), "{text}: {:?}", seen(0));
                let far = (1..vertices.len()).map(|vertex| seen(vertex)[1].abs()).max().unwrap_or_default();
                // Within the picture; a shear is framed for its worst direction.
                assert!((60 * 256..=120 * 256).contains(&far), "{text}: {far}");
            }
        }
    }
}
