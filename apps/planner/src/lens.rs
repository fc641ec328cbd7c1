//! The camera of a choice, by the constructors that firmware has.

use crate::choice::Choice;
use crate::projections::{Kind, Named};
use embedded_graphics_core::geometry::Point;
use pinhole::{Angle, Camera, Projection, Scalar, Sphere, ViewTransform, Viewport, Window};

/// The projections of `pinhole-render` that one constructor of the library makes.
pub(crate) const PROJECTIONS: [Named; 17] = {
    let (mut found, mut count, mut i) = ([Named::ALL[0]; 17], 0, 0);
    while i < Named::ALL.len() {
        if matches!(Named::ALL[i].kind, Kind::Perspective | Kind::Parallel | Kind::Oblique { .. }) {
            found[count] = Named::ALL[i];
            count += 1;
        }
        i += 1;
    }
    assert!(count == found.len(), "as many projections as there are");
    found
};

/// The projection of a name.
pub(crate) fn named(name: &str) -> Result<Named, String> {
    PROJECTIONS.iter().find(|named| named.name == name).copied().ok_or_else(|| {
        let names: Vec<_> = PROJECTIONS.iter().map(|named| named.name).collect();
        format!("projection={name}: none of {}", names.join(", "))
    })
}

/// A projection with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lens {
    /// `Camera::framing`.
    Framing { field_of_view: i32 },
    /// A perspective that is magnified or moved.
    Frustum { distance: Scalar, window: Window, near: Scalar, far: Scalar },
    /// The eye is the centre of the mesh, and the depth runs from before it to behind it.
    Orthographic { window: Window, depth: Scalar },
    /// As [`Lens::Orthographic`]; the angle in hundredths of a degree.
    Oblique { window: Window, depth: Scalar, angle: i32, factor: Scalar },
}

/// The part of the narrower half side that the bounding sphere fills, as in [`Camera::framing`].
const FILL: f64 = 31.0 / 32.0;

impl Lens {
    /// The lens of a choice for a mesh with this bounding sphere.
    pub(crate) fn new(choice: &Choice, sphere: &Sphere) -> Self {
        let radius = f64::from(sphere.radius);
        let zoom = f64::from(choice.zoom) / 100.0;
        let window = |half: f64| {
            let (width, height) = (f64::from(choice.size.width), f64::from(choice.size.height));
            let unit = half / zoom / width.min(height);
            let [x, y] = choice.pan.map(|pan| f64::from(pan) / 1000.0 * half / zoom);
            Window {
                left: scalar(-unit * width - x),
                right: scalar(unit * width - x),
                bottom: scalar(-unit * height - y),
                top: scalar(unit * height - y),
            }
        };
        match choice.projection.kind {
            Kind::Oblique { angle, factor } => {
                let half = factor.hypot(1.0) * radius / FILL;
                let depth = scalar(radius * 65.0 / 64.0);
                let angle = (angle * 100.0).round() as i32; // at most 9000
                Self::Oblique { window: window(half), depth, angle, factor: scalar(factor) }
            }
            Kind::Parallel => {
                Self::Orthographic { window: window(radius / FILL), depth: scalar(radius * 65.0 / 64.0) }
            }
            _ => {
                let field_of_view = choice.projection.field_of_view().round() as i32; // at most 100
                if (choice.zoom, choice.pan) == (100, [0; 2]) {
                    return Self::Framing { field_of_view };
                }
                // As `Camera::framing` does it.
                let (sine, cosine) = Angle::turns(field_of_view, 720).sin_cos();
                let (sine, cosine) = (f64::from(sine), f64::from(cosine));
                let distance = radius * (sine * FILL).hypot(cosine) / (sine * FILL);
                let before = distance - radius;
                let near = before - (radius / 64.0).min(before / 2.0);
                let far = distance + radius * 65.0 / 64.0;
                Self::Frustum {
                    distance: scalar(distance),
                    window: window(near * sine / cosine),
                    near: scalar(near),
                    far: scalar(far),
                }
            }
        }
    }

    /// The camera of this lens.
    pub(crate) fn camera(&self, choice: &Choice, sphere: &Sphere) -> Result<Camera, String> {
        let viewport = Viewport::new(Point::zero(), choice.size).map_err(|e| e.to_string())?;
        let [yaw, pitch] = [choice.yaw, choice.pitch].map(|angle| Angle::turns(angle, 36_000));
        let [x, y, z] = [sphere.centre.x(), sphere.centre.y(), sphere.centre.z()];
        let centre = pinhole::Point3::new(x, y, z);
        let (distance, projection) = match *self {
            Self::Framing { field_of_view } => {
                let field_of_view = Angle::degrees(field_of_view);
                return Camera::framing(sphere, &viewport, field_of_view, yaw, pitch)
                    .map_err(|e| e.to_string());
            }
            Self::Frustum { distance, window, near, far } => {
                (distance, Projection::frustum(window, near, far))
            }
            Self::Orthographic { window, depth } => {
                (Scalar::ZERO, Projection::orthographic(window, -depth, depth))
            }
            Self::Oblique { window, depth, angle, factor } => {
                let angle = Angle::turns(angle, 36_000);
                (Scalar::ZERO, Projection::oblique(window, -depth, depth, angle, factor))
            }
        };
        let view = ViewTransform::orbit(centre, distance, yaw, pitch);
        Ok(Camera::new(&view, &projection.map_err(|e| e.to_string())?, &viewport))
    }
}

/// The nearest number of the library's; lengths here are far below its 32 768.
fn scalar(value: f64) -> Scalar {
    Scalar::from_bits((value * 65_536.0).round() as i32)
}
