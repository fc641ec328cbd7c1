//! docs/spec.md, section 4: through every projection of the family, vertices land within 1/256 px of the construction from the definition
//! in f64 (the projector cuts the view plane), over 10⁵ random valid set-ups each: |world| ≤ 32767, near ≥ ¼, anywhere in a 480 × 320
//! viewport, for objects whose half extent is at most 300 times the vertex's distance, and for every focal length up to 700 px. Depth
//! lands within one step. Beyond these conditions the error budget of ARCHITECTURE.md holds: `fuzz/targets/set_up/camera.rs`.
//!
//! The oracle starts from the quantised inputs. The half extent is that of the mesh about its own origin: the largest |coordinate|, times
//! the model's scale. `--nocapture` shows the figures.

use pinhole::{
    camera::{CameraError, Projected},
    prelude::*,
};
use support::bridge::pair::{bits, random_view, CameraBits, ModelBits, ProjectionBits, Step};
use support::bridge::{point, scalar};
use support::definition::{Picture, Projectors};
use support::oracle::chain::{self, fx, length, to_fx, V3};
use support::oracle::rng::Rng;

const WORLD: f64 = 32_767.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    FieldOfView,
    Frustum,
    Orthographic,
    Oblique,
    Reference,
    ReferenceParallel,
    EyeAtOrigin,
    OriginInPlane,
    General,
    GeneralParallel,
}

/// The kinds that firmware uses: with a field of view, a frustum and a box.
const LENSES: [Kind; 3] = [Kind::FieldOfView, Kind::Frustum, Kind::Orthographic];

/// The range of a class of set-ups.
#[derive(Clone, Copy)]
struct Class {
    /// The least and the greatest half extent ÷ distance.
    ratio: (f64, f64),
    /// The greatest |coordinate| of the mesh in its i16 units.
    reach: i64,
    /// I16F16 vertices instead of i16.
    fixed: bool,
}

impl Class {
    /// 1/256 px, up to 300 times the distance. Beyond, what the documentation states.
    fn is_promised(&self) -> bool {
        self.ratio.1 <= 300.0
    }
}

const PLAIN: Class = Class { ratio: (1e-3, 300.0), reach: 32_767, fixed: false };

/// The greatest slant of parallel projectors.
const SLANT: f64 = 2.0;
/// The least near distance.
const NEAR: f64 = 0.25;
/// Focal lengths in px.
const FOCAL: (f64, f64) = (8.0, 700.0);
/// Width and height of the viewport.
const SIZE: [f64; 2] = [480.0, 320.0];

/// A window as wide as the focal lengths ask for on a plane at a distance from the centre, about a point of the plane.
fn window(rng: &mut Rng, at: [f64; 2], distance: f64, focal: [f64; 2]) -> Option<[i32; 4]> {
    let mut side = |axis: usize| {
        let extent = SIZE[axis] * distance / focal[axis];
        let middle = at[axis] + extent * rng.real(-1.0, 1.0);
        Some([to_fx(middle - extent / 2.0)?, to_fx(middle + extent / 2.0)?.checked_add(1)?])
    };
    let ([left, right], [bottom, top]) = (side(0)?, side(1)?);
    Some([left, right, bottom, top])
}

/// A random projection: near, far and focal length over their whole ranges.
fn family(rng: &mut Rng, kind: Kind, distance: f64) -> Option<ProjectionBits> {
    let focal = [(); 2].map(|()| rng.log(FOCAL.0, FOCAL.1));
    // Distances of near and far from the centre; for a parallel projection, signed positions around it.
    let near = to_fx(rng.log(NEAR, NEAR + distance.min(3000.0)))?.max((NEAR * 65_536.0) as i32);
    let far = to_fx(rng.log(fx(near) * 1.001 + 0.001, WORLD))?;
    let from = rng.real(-distance, distance);
    let to = from + distance * rng.log(0.01, 3.0) + 0.001;
    let (low, high) = (to_fx(from), to_fx(to));
    let flat = |rng: &mut Rng| window(rng, [0.0; 2], distance, focal);
    let mut direction = || {
        let direction = rng.direction();
        let is_steep = direction[2].abs() >= 1.0 / SLANT;
        let length = rng.log(0.01, 1000.0);
        bits(direction.map(|c| c * length)).filter(|_| is_steep)
    };
    Some(match kind {
        Kind::FieldOfView => {
            let [width, height] = SIZE;
            let fov = 2.0 * (height / 2.0 / focal[1]).atan() / core::f64::consts::TAU;
            // Mostly the viewport's own aspect; else another focal length along x.
            let aspect = match rng.one_in(3) {
                true => ((1000.0 * width / height * focal[1] / focal[0]).ceil() as u32, 1000),
                false => SIZE.map(|c| c as u32).into(),
            };
            ProjectionBits::Perspective((fov * 4_294_967_296.0).ceil() as u32, aspect, near, far)
        }
        Kind::Frustum => ProjectionBits::Frustum(window(rng, [0.0; 2], fx(near), focal)?, near, far),
        Kind::Orthographic => ProjectionBits::Orthographic(flat(rng)?, low?, high?),
        Kind::Oblique => {
            let factor = to_fx(rng.real(-SLANT, SLANT))?;
            ProjectionBits::Oblique(flat(rng)?, low?, high?, rng.bits(), factor)
        }
        Kind::Reference | Kind::ReferenceParallel => {
            let n = rng.log(0.25, 3000.0);
            let w = match kind {
                Kind::Reference => window(rng, [0.0; 2], n, focal)?,
                _ => flat(rng)?,
            };
            // The PRP in front of the window, or to its side.
            let mut beside = |[low, high]: [i32; 2]| {
                let reach = match kind {
                    Kind::Reference => fx(high) - fx(low),
                    _ => n * SLANT,
                };
                (fx(low) + fx(high)) / 2.0 + rng.real(-reach, reach)
            };
            let prp = bits([beside([w[0], w[1]]), beside([w[2], w[3]]), n])?;
            match kind {
                Kind::Reference => {
                    ProjectionBits::Reference(prp, w, prp[2].checked_sub(near)?, prp[2].checked_sub(far)?)
                }
                _ => ProjectionBits::ReferenceParallel(prp, w, low?.checked_neg()?, high?.checked_neg()?),
            }
        }
        Kind::EyeAtOrigin | Kind::OriginInPlane => {
            let d = to_fx(-rng.log(0.25, 3000.0))?;
            let w = window(rng, [0.0; 2], -fx(d), focal)?;
            match kind {
                Kind::EyeAtOrigin => ProjectionBits::EyeAtOrigin(d, w, near, far),
                _ => ProjectionBits::OriginInPlane(d, w, near.checked_add(d)?, far.checked_add(d)?),
            }
        }
        Kind::General => {
            let direction = direction()?;
            let unit = chain::normalise(chain::fx3(direction));
            let z_p = to_fx(rng.real(-100.0, 100.0))?;
            let q = to_fx(rng.log(0.25, 3000.0) * unit[2].signum())?;
            let [x, y, z] = unit.map(|v| v * fx(q));
            let w = window(rng, [x, y], z, focal)?;
            let centre = to_fx(z)?.checked_add(z_p)?;
            ProjectionBits::General(
                z_p,
                Some(q),
                direction,
                w,
                near.checked_sub(centre)?,
                far.checked_sub(centre)?,
            )
        }
        Kind::GeneralParallel => {
            let direction = direction()?;
            let z_p = to_fx(distance.min(3000.0) * rng.real(-1.0, 1.0))?;
            ProjectionBits::General(z_p, None, direction, flat(rng)?, low?, high?)
        }
    })
}

/// A camera, and an object whose first vertex lies in the picture.
#[derive(Debug)]
struct Case {
    camera: CameraBits,
    picture: Picture,
    model: ModelBits,
    vertices: Vec<[i16; 3]>,
    exponent: i8,
    /// Bits of the I16F16 vertices, if the mesh has such.
    fixed: Vec<[i32; 3]>,
    half_extent: f64,
}

impl Case {
    fn random(rng: &mut Rng, kind: Kind, class: &Class) -> Option<Self> {
        let distance = rng.log(NEAR, 30_000.0);
        let family = family(rng, kind, distance)?;
        family.library().ok()?;
        let picture = family.picture();
        let ndc = [(); 2].map(|()| rng.real(-1.0, 1.0));
        let (at, scale) = match picture.projectors {
            Projectors::From(c) => {
                let near = picture.distance(picture.front);
                let depth = rng.log(near, (near * 1.1).max(40_000.0));
                (picture.back_to(ndc, c[2] - depth), depth)
            }
            // Behind the front plane, and no farther than the scene is wide.
            Projectors::Along(_) => {
                let n = rng.real(picture.front - 2.0 * distance, picture.front);
                (picture.back_to(ndc, n), distance)
            }
        };
        let view = random_view(rng);
        let world = view.exact().back(at);
        // The first vertex is aimed at; one reaches the largest coordinate.
        let reach = class.reach;
        let mut vertices: Vec<_> = (0..3).map(|_| [0; 3].map(|_| rng.int(-reach, reach) as i16)).collect();
        vertices.push([0; 3].map(|_| reach as i16 * [1, -1][rng.below(2)]));
        if reach == 32_767 && rng.one_in(4) {
            vertices.push([i16::MIN; 3]);
        }
        if rng.one_in(4) {
            vertices.swap(0, 3);
        }
        // Exponent and scale together make the wanted size.
        let unit = scale * rng.log(class.ratio.0, class.ratio.1) / reach as f64;
        let exponent = match rng.one_in(2) {
            true => unit.log2().floor(),
            false => (unit.log2().floor() + rng.int(-3, 8) as f64).min(0.0),
        };
        if !(-32.0..=15.0).contains(&exponent) {
            return None;
        }
        let mut model = ModelBits::random_rotation(rng);
        if exponent != unit.log2().floor() {
            let rest = unit / exponent.exp2();
            let [y, z] = if rng.one_in(2) { [1.0; 2] } else { [rng.real(0.2, 1.0), rng.real(-1.0, -0.2)] };
            let scales = [to_fx(rest)?, to_fx(rest * y)?, to_fx(rest * z)?];
            if scales[0] < 16 {
                return None;
            }
            model.0.insert(0, Step::Scale(scales));
        }
        let exponent = exponent as i8;
        let mut fixed = Vec::new();
        if class.fixed {
            // All 32 bits in use.
            let step = f64::from(exponent).exp2();
            for &v in &vertices {
                fixed.push(bits(chain::vertex(v, exponent).map(|c| c + step * rng.real(-0.5, 0.5)))?);
            }
        }
        let viewport = ([0, 0, -17, 100][rng.below(4)], [0, 0, 33, -200][rng.below(4)], 480, 320);
        let camera = CameraBits { view, projection: family, viewport };
        let mut case = Self { camera, picture, model, vertices, exponent, fixed, half_extent: 0.0 };
        let first = case.model.exact().apply(case.position(0));
        case.model.0.push(Step::Move(bits(core::array::from_fn(|i| world[i] - first[i]))?));
        let exact = case.model.exact();
        let positions: Vec<V3> = (0..case.vertices.len()).map(|i| case.position(i)).collect();
        let is_inside = |&p: &V3| exact.apply(p).iter().all(|c| c.abs() <= WORLD);
        let largest = positions.iter().flatten().fold(0.0f64, |a, &c| a.max(c.abs()));
        let scale = (0..3).map(|j| length(exact.m.map(|row| row[j]))).fold(0.0, f64::max);
        case.half_extent = largest * scale;
        positions.iter().all(is_inside).then_some(case)
    }

    /// The position of a vertex in the mesh.
    fn position(&self, i: usize) -> V3 {
        match self.fixed.get(i) {
            Some(&fixed) => chain::fx3(fixed),
            None => chain::vertex(self.vertices[i], self.exponent),
        }
    }

    /// Compares the image of a view point of an object so large; returns its error in px if it is in the picture.
    fn check(
        &self,
        kind: Kind,
        class: &Class,
        (at, extent): (V3, f64),
        found: Result<Projected, CameraError>,
    ) -> Option<f64> {
        let picture = &self.picture;
        let [width, height] = SIZE;
        let is_central = matches!(picture.projectors, Projectors::From(_));
        let (away, scales, first) = match picture.projectors {
            Projectors::From(c) => (length(c), [picture.distance(at[2]); 2], picture.distance(picture.front)),
            // As if seen from where the focal length would be 700 px.
            Projectors::Along(_) => {
                let [left, right, bottom, top] = picture.window;
                let scales = [700.0 * (right - left) / width, 700.0 * (top - bottom) / height];
                (picture.plane.abs(), scales, picture.front - picture.back)
            }
        };
        let (reach, scale) = (extent + length(at) + away, scales[0]);
        let ratio = if LENSES[..2].contains(&kind) { extent / scale } else { reach / scale };
        // Near is as exact as the formats; its neighbourhood has its own test.
        if (at[2] - picture.front).abs() < 1e-4 * first + reach * 2f64.powi(-20) || ratio > class.ratio.1 {
            return None;
        }
        if at[2] > picture.front {
            assert!(found.is_err(), "before the front plane: {self:?}");
            return None;
        }
        let bound = match class.is_promised() {
            true => 1.0 / 256.0,
            false => 1.0 / 512.0 + 6.5e-6 * ratio * (scale / scales[1]).max(1.0),
        };
        let [left, top] = [self.camera.viewport.0, self.camera.viewport.1].map(f64::from);
        let viewport = chain::Viewport { x: left, y: top, width, height };
        let (x, y) = picture.screen(&viewport, at);
        let farthest = x.abs().max(y.abs());
        let is_inside = (left..=left + width).contains(&x) && (top..=top + height).contains(&y);
        if !is_inside {
            assert!(found.is_err() || farthest < 8192.0 + bound, "({x}, {y}) is {found:?}: {self:?}");
            return None;
        }
        let Projected { point, depth } = found.unwrap_or_else(|_| panic!("dropped at ({x}, {y}): {self:?}"));
        let error = (f64::from(point.x()) / 256.0 - x).abs().max((f64::from(point.y()) / 256.0 - y).abs());
        assert!(error <= bound, "{error} px off at ({x}, {y}), {at:?}, ratio {ratio}: {self:?}");
        let wanted = picture.depth(at).clamp(0.0, 65_534.0);
        // Not where the far plane follows right behind the near plane.
        let is_deep = match is_central {
            true => picture.distance(picture.back) >= 1.1 * first,
            false => reach <= 1000.0 * first,
        };
        let steps = (f64::from(depth) - wanted.round()).abs();
        assert!(steps <= 1.0 || !is_deep || reach / scale > 300.0, "depth {depth} for {wanted}: {self:?}");
        Some(error)
    }
}

/// Compares the vertices of so many set-ups, and their first one as a point of the world, which has its own rounding.
fn run(seed: u64, count: usize, kind: Kind, class: Class) {
    let mut rng = Rng::new(seed);
    let (mut set_ups, mut compared, mut worst) = (0, 0, 0f64);
    while set_ups < count {
        let Some(case) = Case::random(&mut rng, kind, &class) else { continue };
        set_ups += 1;
        let camera = case.camera.library();
        let (view, model, exact) = (case.camera.view.exact(), case.model.library(), case.model.exact());
        let fixed: Vec<_> = case.fixed.iter().map(|v| v.map(scalar)).collect();
        for i in 0..case.vertices.len() {
            let found = match class.fixed {
                true => camera.place(&Mesh::from_fixed(&fixed, &[]).expect("a mesh"), &model).project(i),
                false => {
                    let mesh = Mesh::new(&case.vertices, case.exponent, &[]).expect("a mesh");
                    camera.place(&mesh, &model).project(i)
                }
            };
            let at = (view.apply_placed(&exact, case.position(i)), case.half_extent);
            let error = case.check(kind, &class, at, found);
            (compared, worst) = (compared + usize::from(error.is_some()), worst.max(error.unwrap_or(0.0)));
        }
        // The bound that is stated is for objects that are larger than their distance.
        let world = bits(exact.apply(case.position(0))).filter(|_| class.is_promised());
        if let Some(world) = world {
            let at = (view.apply(chain::fx3(world)), 0.0);
            case.check(kind, &class, at, camera.project(point(world)));
        }
    }
    println!("{kind:?}: {set_ups} set-ups, {compared} vertices: at most {worst:.7} px");
    assert!(compared >= count / 2, "{kind:?}: {compared}");
}

macro_rules! promised {
    ($($name:ident $kind:ident $seed:literal)*) => {$(
        #[test]
        fn $name() {
            run($seed, 100_000, Kind::$kind, PLAIN);
        }
    )*};
}

promised! {
    s4_field_of_view FieldOfView 0xF0
    s4_frustum_off_axis Frustum 0xF1
    s4_orthographic_box Orthographic 0xF2
    s4_oblique Oblique 0xF3
    s4_prp_and_window_perspective Reference 0xF4
    s4_prp_and_window_parallel ReferenceParallel 0xF5
    s4_planar_eye_at_origin EyeAtOrigin 0xF6
    s4_planar_origin_in_plane OriginInPlane 0xF7
    s4_planar_general General 0xF8
    s4_planar_general_parallel GeneralParallel 0xF9
}

/// Compares each lens that firmware uses with each class.
fn run_all(seed: u64, classes: &[Class]) {
    for (k, class) in classes.iter().enumerate() {
        for (j, &kind) in LENSES.iter().enumerate() {
            run(seed + 16 * k as u64 + j as u64, 2000, kind, *class);
        }
    }
}

#[test]
fn small_and_large_meshes_and_i16f16_vertices_keep_the_promise() {
    let classes = [
        Class { reach: 1, ..PLAIN },
        Class { reach: 40, ..PLAIN },
        Class { reach: 1000, ..PLAIN },
        Class { ratio: (200.0, 300.0), ..PLAIN },
        Class { fixed: true, ..PLAIN },
    ];
    run_all(0x200, &classes);
}

#[test]
fn objects_beyond_300_times_their_distance_keep_the_stated_bound() {
    let ratio = (300.0, 1e5);
    let classes = [Class { ratio, ..PLAIN }, Class { ratio, fixed: true, ..PLAIN }];
    run_all(0x300, &classes);
}
