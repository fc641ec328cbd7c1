//! A camera that frames an object: it orbits the bounding sphere, at the distance from which all of the sphere is seen.

use super::projection::Projection;
use super::view_transform::ViewTransform;
use super::viewport::Viewport;
use super::Camera;
use crate::camera::CameraError;
use crate::math::num::{divide, sqrt};
use crate::math::{Angle, Point3, Scalar, Sphere};

impl Camera {
    /// A camera that sees all of an object, from any side: it looks at the centre of the bounding sphere from the distance at
    /// which the sphere fills 31/32 of the viewport in its narrower direction, with near and far planes just before and behind
    /// the sphere. `field_of_view` is the angle across the narrower direction; a small one flattens the object, a large one
    /// exaggerates its depth. `yaw` and `pitch` are as in [`ViewTransform::orbit`], with y up.
    ///
    /// The eye is `radius / sin a` from the centre, where `tan a = 31/32 · tan(field_of_view / 2)`: 3 radii for 40°, 2.05 for 60°.
    ///
    /// The sphere is in world units. So the object may have the identity as its model transform, or any rotation about the
    /// sphere's centre. The margin at the frame is 1/32 of the narrower half side, at most 1/20 for an object of a few steps of
    /// [`Scalar`].
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// const VERTICES: [[i16; 3]; 4] = [[100, 100, 100], [100, -100, -100], [-100, 100, -100], [-100, -100, 100]];
    /// const EDGES: [[u16; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    /// let mesh = Mesh::new(&VERTICES, 0, &[])?.with_edges(&EDGES)?;
    ///
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let (yaw, pitch) = (Angle::degrees(30), Angle::degrees(20)); // from the right, and from above
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), yaw, pitch)?;
    ///
    /// let mut display = MockDisplay::<BinaryColor>::new();
    /// display.set_allow_overdraw(true); // edges share their end pixels
    /// camera.place(&mesh, &Affine::identity()).edges(|_| BinaryColor::On).draw(&mut display)?;
    /// let Size { width, height } = display.affected_area().size;
    /// assert!(width > 32 && height > 32, "more than half of 64 pixels");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError`] if the sphere has no radius, the field of view is out of range, or the eye would be too far from the
    /// sphere or too near for [`Scalar`].
    #[inline(never)] // set-up: code size counts
    pub const fn framing(
        sphere: &Sphere,
        viewport: &Viewport,
        field_of_view: Angle,
        yaw: Angle,
        pitch: Angle,
    ) -> Result<Self, CameraError> {
        let radius = sphere.radius.to_bits() as i64;
        if radius <= 0 {
            return Err(CameraError::NoRadius);
        }
        if !Projection::is_field_of_view(field_of_view) {
            return Err(CameraError::FieldOfView);
        }
        let (sine, cosine) = Angle::from_bits(field_of_view.bits() / 2).sin_cos();
        // The silhouette of a sphere at distance d reaches to an angle with the sine r/d, whose tangent shall be 31/32 of the
        // tangent of half the field of view. Both in 2⁻³⁰; half angles of 1/8192 turn and more have sines above 2¹⁹.
        let (sine, cosine) = (sine as i64 - (sine >> 5) as i64, cosine as i64);
        let length = sqrt((sine * sine + cosine * cosine) as u64); // ≤ 2³⁰ and a little
        let (distance, rest) = divide(radius as u64 * length as u64, sine as u32); // 31 + 30 bits
        let distance = distance as i64 + (rest > 0) as i64; // up, to see no less
        const LEAST: i64 = 64; // 2⁻¹⁰: the slack below is more than the error of the eye
        let before = distance - radius;
        if before < LEAST {
            return Err(CameraError::TooNear);
        }
        // The eye is within 2⁻²⁸ of the distance, at most 8 steps; both slacks are larger.
        let slack = radius >> 6;
        let near = before - if slack < before >> 1 { slack + 8 } else { before >> 1 };
        let far = distance + radius + slack + 8;
        if far > i32::MAX as i64 {
            return Err(CameraError::OutOfRange);
        }
        let [x, y, z] = sphere.centre.bits();
        let centre = Point3::new(Scalar::from_bits(x), Scalar::from_bits(y), Scalar::from_bits(z));
        let view = ViewTransform::orbit(centre, Scalar::from_bits(distance as i32), yaw, pitch);
        let (near, far) = (Scalar::from_bits(near as i32), Scalar::from_bits(far as i32));
        match Projection::perspective_across(field_of_view, viewport.size(), near, far) {
            Ok(projection) => Ok(Self::new(&view, &projection, viewport)),
            // Near and far: near·far/(far − near) is below d²/2r, at most 2¹⁵ · 2¹⁰.
            Err(_) => Err(CameraError::TooNear),
        }
    }
}
