//! A picture by its definition, in f64 and without a matrix: the projector through a point cuts the
//! view plane, and the window on that plane goes onto the viewport. Depth is the one map of the
//! projector onto −1 … 1 that is linear in the picture and takes the front plane to −1, the back
//! plane to +1.

use crate::bridge::pair::window;
use crate::bridge::{point, scalar, vector};
use crate::oracle::chain::{self, fx, fx3, Viewport, V3};
use embedded_graphics_core::geometry::Size;
use pinhole::{camera::CameraError, Angle, Projection};

/// All lines that project: through one centre, or along one direction.
#[derive(Clone, Copy, Debug)]
pub enum Projectors {
    From(V3),
    Along(V3),
}

/// In view coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    pub projectors: Projectors,
    /// The view plane is z = plane.
    pub plane: f64,
    /// left, right, bottom, top
    pub window: [f64; 4],
    /// Places on the n axis.
    pub front: f64,
    pub back: f64,
}

impl Picture {
    /// Where the projector through `p` cuts the plane z = `plane`.
    pub fn cut(&self, p: V3, plane: f64) -> (f64, f64) {
        match self.projectors {
            Projectors::From(c) => {
                let t = (c[2] - plane) / (c[2] - p[2]);
                (c[0] + (p[0] - c[0]) * t, c[1] + (p[1] - c[1]) * t)
            }
            Projectors::Along(d) => {
                let t = (plane - p[2]) / d[2];
                (p[0] + d[0] * t, p[1] + d[1] * t)
            }
        }
    }

    /// How far before the centre of projection a place on the n axis lies; 1 where there is none.
    pub fn distance(&self, n: f64) -> f64 {
        match self.projectors {
            Projectors::From(c) => c[2] - n,
            Projectors::Along(_) => 1.0,
        }
    }

    pub fn ndc(&self, p: V3) -> V3 {
        let (x, y) = self.cut(p, self.plane);
        let [l, r, b, t] = self.window;
        let z = match self.projectors {
            Projectors::From(_) => {
                let [front, back, at] = [self.front, self.back, p[2]].map(|n| 1.0 / self.distance(n));
                (front - at) / (front - back)
            }
            Projectors::Along(_) => (self.front - p[2]) / (self.front - self.back),
        };
        [(2.0 * x - l - r) / (r - l), (2.0 * y - b - t) / (t - b), 2.0 * z - 1.0]
    }

    pub fn screen(&self, viewport: &Viewport, p: V3) -> (f64, f64) {
        viewport.apply(self.ndc(p))
    }

    /// 0 near … 65535 far, before it is rounded and clamped.
    pub fn depth(&self, p: V3) -> f64 {
        65535.0 * (self.ndc(p)[2] + 1.0) / 2.0
    }

    /// The point at `n` whose image lies at this place of the window (−1 … 1).
    pub fn back_to(&self, ndc: [f64; 2], n: f64) -> V3 {
        let [l, r, b, t] = self.window;
        let p = [l + (r - l) * (ndc[0] + 1.0) / 2.0, b + (t - b) * (ndc[1] + 1.0) / 2.0, self.plane];
        let (x, y) = self.cut(p, n);
        [x, y, n]
    }
}

/// Every projection of the family, described by bits.
#[derive(Clone, Copy, Debug)]
pub enum Family {
    /// fov_y, aspect, near, far
    FieldOfView(u32, (u32, u32), i32, i32),
    /// window, near, far
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

impl Family {
    pub fn library(&self) -> Result<Projection, CameraError> {
        let planar = |z: i32, q: Option<i32>, d: [i32; 3], w, n, f| {
            Projection::planar(scalar(z), q.map(scalar), vector(d), window(w), scalar(n), scalar(f))
        };
        match *self {
            Self::FieldOfView(fov, (w, h), n, f) => {
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

    pub fn picture(&self) -> Picture {
        let make = |projectors, plane, w: [i32; 4], front, back| Picture {
            projectors,
            plane,
            window: w.map(fx),
            front,
            back,
        };
        let (origin, straight) = (Projectors::From([0.0; 3]), Projectors::Along([0.0, 0.0, 1.0]));
        match *self {
            Self::FieldOfView(fov, (w, h), n, f) => {
                let t = (f64::from(fov) * (core::f64::consts::PI / 4_294_967_296.0)).tan();
                let r = t * f64::from(w) / f64::from(h);
                Picture { window: [-r, r, -t, t], ..make(origin, -1.0, [0; 4], -fx(n), -fx(f)) }
            }
            Self::Frustum(w, n, f) => make(origin, -fx(n), w, -fx(n), -fx(f)),
            Self::Orthographic(w, n, f) | Self::PlanarParallel(w, n, f) => {
                make(straight, 0.0, w, -fx(n), -fx(f))
            }
            Self::Oblique(w, n, f, angle, factor) => {
                let (s, c) = chain::sin_cos(angle);
                let slant = Projectors::Along([fx(factor) * c, fx(factor) * s, 1.0]);
                make(slant, 0.0, w, -fx(n), -fx(f))
            }
            Self::Reference(p, w, front, back) => make(Projectors::From(fx3(p)), 0.0, w, fx(front), fx(back)),
            Self::ReferenceParallel(p, w, front, back) => {
                let [x, y, n] = fx3(p);
                let [l, r, b, t] = w.map(fx);
                let dop = [(l + r) / 2.0 - x, (b + t) / 2.0 - y, -n];
                make(Projectors::Along(dop), 0.0, w, fx(front), fx(back))
            }
            Self::EyeAtOrigin(d, w, n, f) => make(origin, fx(d), w, -fx(n), -fx(f)),
            Self::OriginInPlane(d, w, n, f) => {
                make(Projectors::From([0.0, 0.0, -fx(d)]), 0.0, w, -fx(n), -fx(f))
            }
            Self::General(z, q, d, w, n, f) => {
                let d = fx3(d);
                let projectors = match q {
                    None => Projectors::Along(d),
                    Some(q) => {
                        let [x, y, n] = chain::normalise(d).map(|c| c * fx(q));
                        Projectors::From([x, y, n + fx(z)])
                    }
                };
                make(projectors, fx(z), w, -fx(n), -fx(f))
            }
        }
    }
}
