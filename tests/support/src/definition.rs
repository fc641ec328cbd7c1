//! A picture by its definition, in f64 and without a matrix: the projector through a point cuts the
//! view plane, and the window on that plane goes onto the viewport. Depth is the one map of the
//! projector onto −1 … 1 that is linear in the picture and takes the front plane to −1, the back
//! plane to +1.

use crate::bridge::pair::ProjectionBits;
use crate::oracle::chain::{self, fx, fx3, Viewport, M4, V3};

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

    /// The projection matrix, each of its linear forms from the definition.
    pub fn matrix(&self) -> M4 {
        let [l, r, b, t] = self.window;
        let thick = self.front - self.back;
        match self.projectors {
            // x = 2·(c₀·w + (p₀ − c₀)·(c₂ − plane)) − (l + r)·w over r − l, with w = c₂ − p₂.
            Projectors::From(c) => {
                let form = |axis: usize, low: f64, high: f64| {
                    let (reach, middle) = (c[2] - self.plane, 2.0 * c[axis] - low - high);
                    let mut row = [0.0, 0.0, -middle, middle * c[2] - 2.0 * c[axis] * reach];
                    row[axis] = 2.0 * reach;
                    row.map(|v| v / (high - low))
                };
                let (near, far) = (self.distance(self.front), self.distance(self.back));
                // z = 2·far·(w − near)/(far − near) − w.
                let k = 2.0 * far / thick;
                let z = [0.0, 0.0, 1.0 - k, k * (c[2] - near) - c[2]];
                [form(0, l, r), form(1, b, t), z, [0.0, 0.0, -1.0, c[2]]]
            }
            // x = 2·(p₀ + (plane − p₂)·d₀/d₂) − (l + r) over r − l.
            Projectors::Along(d) => {
                let form = |axis: usize, low: f64, high: f64| {
                    let slope = d[axis] / d[2];
                    let mut row = [0.0, 0.0, -2.0 * slope, 2.0 * slope * self.plane - low - high];
                    row[axis] = 2.0;
                    row.map(|v| v / (high - low))
                };
                let z = [0.0, 0.0, -2.0 / thick, (self.front + self.back) / thick];
                [form(0, l, r), form(1, b, t), z, [0.0, 0.0, 0.0, 1.0]]
            }
        }
    }
}

impl ProjectionBits {
    /// The picture by the definition of the projection.
    pub fn picture(self) -> Picture {
        let make = |projectors, plane, w: [i32; 4], front, back| Picture {
            projectors,
            plane,
            window: w.map(fx),
            front,
            back,
        };
        let (origin, straight) = (Projectors::From([0.0; 3]), Projectors::Along([0.0, 0.0, 1.0]));
        match self {
            Self::Perspective(fov, (w, h), n, f) => {
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
