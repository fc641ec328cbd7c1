//! Random cameras and objects, in the library's formats. They are equal on every host: they are computed by additions,
//! products, quotients and roots of f64, which IEEE 754 defines exactly, and by sines whose last bit makes no difference.

use crate::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits};
use crate::oracle::chain::{self, length, View, V3};
use crate::oracle::rng::Rng;

/// A distribution of cameras and vertices.
pub(crate) struct Population {
    pub(crate) name: &'static str,
    /// Bound of |world|.
    pub(crate) world: i32,
    /// 1/least distance.
    pub(crate) nearest: i32,
    /// Size of the viewport.
    pub(crate) size: (u32, u32),
    pub(crate) seed: u64,
}

pub(crate) const POPULATIONS: [Population; 3] = [
    Population { name: "A", world: 32_767, nearest: 1, size: (480, 320), seed: 0xA },
    Population { name: "B", world: 64, nearest: 4, size: (480, 320), seed: 0xB },
    Population { name: "C", world: 1024, nearest: 16, size: (320, 240), seed: 0xC },
];

/// Ratios far ÷ near: the classes of the depth table. The near plane lies at the population's least distance.
pub(crate) const RANGES: [f64; 5] = [1.01, 1.1, 2.0, 16.0, 32_000.0];

/// 26° … 120° in 2⁻³² turn.
const FIELD: (i64, i64) = (310_189_739, 1_431_655_765);

/// The number formats of a vertex.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Design {
    Short,
    Fixed,
    Point,
}

/// A format, and the range of half extent ÷ distance.
pub(crate) const DESIGNS: [(Design, &str, (f64, f64)); 5] = [
    (Design::Short, "`i16` mesh, r/z ≤ 16", (1.0 / 64.0, 16.0)),
    (Design::Short, "`i16` mesh, r/z ≤ 300", (16.0, 300.0)),
    (Design::Fixed, "`I16F16` mesh, r/z ≤ 16", (1.0 / 64.0, 16.0)),
    (Design::Fixed, "`I16F16` mesh, r/z ≤ 300", (16.0, 300.0)),
    (Design::Point, "single points", (0.0, 0.0)),
];

/// Vertices of an object.
pub(crate) const VERTICES: usize = 12;

/// An object before a camera.
pub(crate) struct Object {
    pub(crate) model: ModelBits,
    pub(crate) exponent: i8,
    /// The vertices, and a corner of the box ±r about the mesh's origin.
    pub(crate) short: [[i16; 3]; VERTICES + 1],
    pub(crate) fixed: [[i32; 3]; VERTICES + 1],
    pub(crate) half_extent: f64,
}

/// A number between two positive ones, uniform in its logarithm.
fn log(rng: &mut Rng, (low, high): (f64, f64)) -> f64 {
    let mut doublings = 0;
    while low * f64::from(1u32 << doublings) < high {
        doublings += 1;
    }
    loop {
        let v = low * f64::from(1u32 << rng.below(doublings)) * (1.0 + rng.unit());
        if v <= high {
            return v;
        }
    }
}

impl Population {
    /// A camera anywhere in the world, and the class of its far plane.
    pub(crate) fn camera(&self, rng: &mut Rng) -> (CameraBits, usize) {
        let limit = (i64::from(self.world) << 16) - 1;
        let eye = [0; 3].map(|_| rng.int(-limit, limit) as i32);
        let view = loop {
            let (gaze, up) = (rng.direction(), rng.direction());
            if length(chain::cross(gaze, up)) < 0.02 {
                continue;
            }
            let to = |v: V3| v.map(|c| (c * 1_073_741_824.0) as i32);
            break ViewBits::LookAlong(eye, to(gaze), to(up));
        };
        let range = rng.below(RANGES.len());
        let near = 65_536 / self.nearest;
        let far = (f64::from(near) * RANGES[range]).min(32_767.0 * 65_536.0) as i32;
        let fov = rng.int(FIELD.0, FIELD.1) as u32;
        let projection = ProjectionBits::Perspective(fov, self.size, near, far);
        let (width, height) = self.size;
        (CameraBits { view, projection, viewport: (0, 0, width, height) }, range)
    }

    pub(crate) fn inside(&self, world: V3) -> bool {
        world.iter().all(|c| c.abs() < f64::from(self.world))
    }

    /// A visible point of the world, in view coordinates; `None` where little of the world lies in front of the camera.
    pub(crate) fn target(&self, rng: &mut Rng, camera: &CameraBits, exact: &chain::Camera) -> Option<V3> {
        let m = exact.projection;
        let (near, far) = (camera.projection.near(), camera.projection.far());
        (0..8).find_map(|_| {
            let z = log(rng, (near * (1.0 + 2e-3), far * (1.0 - 2e-3)));
            let at = [rng.real(-1.0, 1.0) * z / m[0][0], rng.real(-1.0, 1.0) * z / m[1][1], -z];
            self.inside(exact.view.back(at)).then_some(at)
        })
    }

    /// An object with a vertex at this view point and others about it.
    pub(crate) fn object(
        &self,
        rng: &mut Rng,
        (design, _, ratio): (Design, &str, (f64, f64)),
        view: &View,
        at: V3,
    ) -> Option<Object> {
        let half_extent = -at[2] * log(rng, ratio);
        if half_extent >= f64::from(self.world) {
            return None;
        }
        // The finest unit in which 16 bits hold the object.
        let mut exponent = 15i8;
        while half_extent < 16_384.0 * f64::from(exponent).exp2() {
            exponent -= 1;
        }
        let unit = match design {
            Design::Short => f64::from(exponent).exp2(),
            _ => 1.0 / 65_536.0,
        };
        let reach = (half_extent / unit) as i64;
        let mut model = ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())]);
        let turn = model.exact();
        let first = [0; 3].map(|_| rng.int(-reach, reach));
        let at_first = turn.apply(first.map(|c| c as f64 * unit));
        let at_world = view.back(at);
        let shift = bits(core::array::from_fn(|i| at_world[i] - at_first[i]))?;
        model.0.push(Step::Move(shift));
        let mut vertices = [first; VERTICES + 1];
        vertices[VERTICES] = [0; 3].map(|_| if rng.one_in(2) { reach } else { -reach });
        for vertex in vertices.iter_mut().take(VERTICES).skip(1) {
            let away = half_extent.min(-at[2]) * rng.unit() / 2.0;
            let way = rng.direction();
            let to = view.back(core::array::from_fn(|i| at[i] + away * way[i]));
            let from: V3 = core::array::from_fn(|i| to[i] - chain::fx(shift[i]));
            let back: V3 = core::array::from_fn(|i| (0..3).map(|k| turn.m[k][i] * from[k]).sum());
            *vertex = back.map(|c| ((c / unit).round() as i64).clamp(-reach, reach));
        }
        Some(Object {
            model,
            exponent,
            short: vertices.map(|v| v.map(|c| c as i16)),
            fixed: vertices.map(|v| v.map(|c| c as i32)),
            half_extent: reach as f64 * unit,
        })
    }
}
