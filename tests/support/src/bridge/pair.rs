//! Makes everything twice from the same bits: once for the library, once for the f64 oracle.

use super::{point, rectangle, scalar, vector, viewport};
use crate::oracle::chain::{self, fx, M4};
use crate::oracle::rng::Rng;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    camera::{CameraError, Window},
    prelude::*,
    Angle,
};

/// One in I16F16.
pub const ONE: i32 = 1 << 16;

/// Whole numbers in I16F16.
pub fn ints(x: i16, y: i16, z: i16) -> [i32; 3] {
    [x, y, z].map(|c| i32::from(c) << 16)
}

/// The rows of a view, as reals.
pub fn rows(v: &ViewTransform) -> [[f64; 3]; 3] {
    let [u, v, n, _] = v.to_matrix().map(|[x, y, z, _]| [x, y, z]);
    [u, v, n]
}

/// A view, described by bits.
#[derive(Clone, Copy, Debug)]
pub enum ViewBits {
    /// eye, target, up
    LookAt([i32; 3], [i32; 3], [i32; 3]),
    /// eye, gaze, up
    LookAlong([i32; 3], [i32; 3], [i32; 3]),
    /// VRP, VPN, VUP
    Reference([i32; 3], [i32; 3], [i32; 3]),
}

impl ViewBits {
    pub fn library(self) -> Result<ViewTransform, CameraError> {
        match self {
            Self::LookAt(e, t, u) => ViewTransform::look_at(point(e), point(t), vector(u)),
            Self::LookAlong(e, g, u) => {
                ViewTransform::from_reference(point(e), vector(g.map(i32::saturating_neg)), vector(u))
            }
            Self::Reference(e, n, u) => ViewTransform::from_reference(point(e), vector(n), vector(u)),
        }
    }

    pub fn exact(self) -> chain::View {
        match self {
            Self::LookAt(e, t, u) => chain::View::look_at(e, t, u),
            Self::LookAlong(e, g, u) => chain::View::look_along(e, g, u),
            Self::Reference(e, n, u) => chain::View::from_reference(e, n, u),
        }
    }
}

pub fn window([left, right, bottom, top]: [i32; 4]) -> Window {
    Window { left: scalar(left), right: scalar(right), bottom: scalar(bottom), top: scalar(top) }
}

/// Every projection, described by bits.
#[derive(Clone, Copy, Debug)]
pub enum ProjectionBits {
    /// fov_y, aspect (width, height), near, far
    Perspective(u32, (u32, u32), i32, i32),
    /// window (left, right, bottom, top), near, far
    Frustum([i32; 4], i32, i32),
    Orthographic([i32; 4], i32, i32),
    /// window, near, far, angle, factor
    Oblique([i32; 4], i32, i32, u32, i32),
    /// PRP, window, front, back
    Reference([i32; 3], [i32; 4], i32, i32),
    ReferenceParallel([i32; 3], [i32; 4], i32, i32),
    /// d, window, near, far
    EyeAtOrigin(i32, [i32; 4], i32, i32),
    OriginInPlane(i32, [i32; 4], i32, i32),
    PlanarParallel([i32; 4], i32, i32),
    /// z_p, Q (none: infinite), direction, window, near, far
    General(i32, Option<i32>, [i32; 3], [i32; 4], i32, i32),
}

impl ProjectionBits {
    pub fn library(self) -> Result<Projection, CameraError> {
        let planar = |z: i32, q: Option<i32>, d: [i32; 3], w, n, f| {
            Projection::planar(scalar(z), q.map(scalar), vector(d), window(w), scalar(n), scalar(f))
        };
        match self {
            Self::Perspective(fov, (w, h), n, f) => {
                Projection::perspective(Angle::from_bits(fov), Size::new(w, h), scalar(n), scalar(f))
            }
            Self::Frustum(w, n, f) => Projection::frustum(window(w), scalar(n), scalar(f)),
            Self::Orthographic(w, n, f) => Projection::orthographic(window(w), scalar(n), scalar(f)),
            Self::Oblique(w, n, f, angle, factor) => {
                Projection::oblique(window(w), scalar(n), scalar(f), Angle::from_bits(angle), scalar(factor))
            }
            Self::Reference(p, w, front, back) => {
                Projection::perspective_from_reference(point(p), window(w), scalar(front), scalar(back))
            }
            Self::ReferenceParallel(p, w, front, back) => {
                Projection::parallel_from_reference(point(p), window(w), scalar(front), scalar(back))
            }
            Self::EyeAtOrigin(d, w, n, f) => planar(d, Some(d), [0, 0, -1], w, n, f),
            Self::OriginInPlane(d, w, n, f) => planar(0, Some(d), [0, 0, -1], w, n, f),
            Self::PlanarParallel(w, n, f) => planar(0, None, [0, 0, 1], w, n, f),
            Self::General(z, q, d, w, n, f) => planar(z, q, d, w, n, f),
        }
    }

    pub fn exact(self) -> M4 {
        match self {
            Self::Perspective(fov, (w, h), n, f) => chain::perspective(fov, w, h, fx(n), fx(f)),
            Self::Frustum([l, r, b, t], n, f) => chain::frustum(fx(l), fx(r), fx(b), fx(t), fx(n), fx(f)),
            Self::Orthographic([l, r, b, t], n, f) => {
                chain::orthographic(fx(l), fx(r), fx(b), fx(t), fx(n), fx(f))
            }
            // The planar ones have w = 1 in their plane, also with the centre behind it.
            Self::EyeAtOrigin(..) | Self::OriginInPlane(..) | Self::General(..) => {
                let picture = self.picture();
                let scale = picture.distance(picture.plane);
                picture.matrix().map(|row| row.map(|v| v / scale))
            }
            _ => self.picture().matrix(),
        }
    }

    /// The distance of the near plane from the origin, along −z.
    pub fn near(self) -> f64 {
        -self.picture().front
    }

    pub fn far(self) -> f64 {
        -self.picture().back
    }
}

#[derive(Clone, Copy, Debug)]
pub struct CameraBits {
    pub view: ViewBits,
    pub projection: ProjectionBits,
    /// x, y, width, height
    pub viewport: (i32, i32, u32, u32),
}

impl CameraBits {
    /// An eye at the origin that looks along −z, and a picture from (0, 0) on.
    pub const fn ahead(projection: ProjectionBits, (width, height): (u32, u32)) -> Self {
        let view = ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]);
        Self { view, projection, viewport: (0, 0, width, height) }
    }

    /// [`Self::ahead`], in perspective.
    pub const fn perspective(fov_y: u32, size: (u32, u32), near: i32, far: i32) -> Self {
        Self::ahead(ProjectionBits::Perspective(fov_y, size, near, far), size)
    }

    /// [`Self::ahead`]: one unit is one pixel, with y up, the origin is the picture's upper left corner, and z lies between −100 and −1.
    pub const fn pixels((width, height): (u32, u32)) -> Self {
        let window = [0, width as i32 * ONE, -(height as i32) * ONE, 0];
        Self::ahead(ProjectionBits::Orthographic(window, ONE, 100 * ONE), (width, height))
    }

    /// The pixels of the viewport.
    pub fn area(&self) -> Rectangle {
        let (x, y, width, height) = self.viewport;
        rectangle(x, y, width, height)
    }

    pub fn library(&self) -> Camera {
        let (x, y, width, height) = self.viewport;
        Camera::new(
            &self.view.library().expect("a view"),
            &self.projection.library().expect("a projection"),
            &viewport(x, y, width, height),
        )
    }

    pub fn exact(&self) -> chain::Camera {
        let (x, y, w, h) = self.viewport;
        chain::Camera {
            view: self.view.exact(),
            projection: self.projection.exact(),
            viewport: chain::Viewport::new(x, y, w, h),
        }
    }
}

/// One step of a model transform.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    X(u32),
    Y(u32),
    Z(u32),
    Scale([i32; 3]),
    Move([i32; 3]),
}

/// A model transform: its steps from the first to the last.
#[derive(Clone, Debug, Default)]
pub struct ModelBits(pub Vec<Step>);

impl ModelBits {
    pub fn library(&self) -> Affine<Model, World> {
        self.local().then(&Affine::identity())
    }

    /// In the parent's space.
    pub fn local(&self) -> Affine<Model, Model> {
        let mut all = Affine::identity();
        for step in &self.0 {
            all = all.then(&match *step {
                Step::X(a) => Affine::rotation_x(Angle::from_bits(a)),
                Step::Y(a) => Affine::rotation_y(Angle::from_bits(a)),
                Step::Z(a) => Affine::rotation_z(Angle::from_bits(a)),
                Step::Scale([x, y, z]) if x == y && y == z => Affine::scale(scalar(x)),
                Step::Scale([x, y, z]) => Affine::scale_axes(scalar(x), scalar(y), scalar(z)),
                Step::Move(t) => Affine::translation(vector(t)),
            });
        }
        all
    }

    pub fn exact(&self) -> chain::Affine {
        let mut all = chain::IDENTITY;
        for step in &self.0 {
            all = all.then(&match *step {
                Step::X(a) => chain::Affine::rotation_x(a),
                Step::Y(a) => chain::Affine::rotation_y(a),
                Step::Z(a) => chain::Affine::rotation_z(a),
                Step::Scale(s) => chain::Affine::scale(s),
                Step::Move(t) => chain::Affine::translation(t),
            });
        }
        all
    }

    /// Rotations about the three axes, none, or a few.
    pub fn random_rotation(rng: &mut Rng) -> Self {
        let mut steps = Vec::new();
        for _ in 0..rng.below(4) {
            steps.push(match rng.below(3) {
                0 => Step::X(rng.bits()),
                1 => Step::Y(rng.bits()),
                _ => Step::Z(rng.bits()),
            });
        }
        ModelBits(steps)
    }
}

/// A vector of real numbers as bits.
pub fn bits(v: [f64; 3]) -> Option<[i32; 3]> {
    let [x, y, z] = v.map(chain::to_fx);
    Some([x?, y?, z?])
}

/// A random camera anywhere in the world, by any constructor, with directions of any length.
pub fn random_view(rng: &mut Rng) -> ViewBits {
    loop {
        let eye = match rng.below(4) {
            0 => [0; 3].map(|_| rng.int(-32000 << 16, 32000 << 16) as i32),
            // Large offsets.
            1 => [0; 3].map(|_| {
                let far = if rng.one_in(2) { 20_000.0 } else { -20_000.0 };
                ((far + rng.real(-50.0, 50.0)) * 65536.0) as i32
            }),
            2 => [0; 3].map(|_| rng.int(-64 << 16, 64 << 16) as i32),
            _ => [0; 3].map(|_| {
                let reach = rng.log(1.0, 2e9) as i64;
                rng.int(-reach, reach) as i32
            }),
        };
        let n = rng.direction();
        let length = rng.log(2f64.powi(-13), 32000.0);
        let Some(n) = bits(n.map(|c| c * length)) else {
            continue;
        };
        let up = if rng.one_in(2) {
            [0, ONE, 0]
        } else {
            let length = rng.log(2f64.powi(-13), 32000.0);
            match bits(rng.direction().map(|c| c * length)) {
                Some(up) => up,
                None => continue,
            }
        };
        // Well apart from parallel: 1/50 rad. (Parallel up has its own test.)
        let (a, b) = (chain::fx3(n), chain::fx3(up));
        if chain::length(chain::cross(a, b)) < 0.02 * chain::length(a) * chain::length(b) {
            continue;
        }
        match rng.below(3) {
            0 => {
                let mut target = [0; 3];
                let sums = [0, 1, 2].map(|i| i64::from(eye[i]) - i64::from(n[i]));
                if sums.iter().any(|&s| i32::try_from(s).is_err()) {
                    continue;
                }
                for (t, s) in target.iter_mut().zip(sums) {
                    *t = s as i32;
                }
                return ViewBits::LookAt(eye, target, up);
            }
            1 => return ViewBits::LookAlong(eye, n.map(|c| -c), up),
            _ => return ViewBits::Reference(eye, n, up),
        }
    }
}
