//! docs/spec.md, section 4: for every projection of the family, vertices within 1/256 px of the f64 construction from
//! the definition (the projector cuts the view plane), over 10⁵ random valid set-ups each; depth
//! within one step. Beyond the documented conditions the error budget holds. `--nocapture` shows the
//! figures.

use pinhole::{Camera, Mesh, Projection};
use support::bridge::pair::{bits, random_view, ModelBits, Step, ViewBits};
use support::bridge::{point, rectangle};
use support::definition::{Family, Picture, Projectors};
use support::oracle::chain::{self, fx, length, to_fx, Viewport, V3};
use support::oracle::rng::Rng;

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 320.0;
const SETUPS: usize = 100_000;
const PROMISE: f64 = 1.0 / 256.0;

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

/// The range of a class of set-ups.
#[derive(Clone, Copy)]
struct Reach {
    /// The longest focal length in px.
    focal: f64,
    /// How far windows lie off the centre of projection's axis, in their own widths.
    off_axis: f64,
    /// The greatest slant of parallel projectors.
    slant: f64,
    /// The largest ratio of any length involved (half the object's extent, the distance from the VRP, the PRP's
    /// coordinates) to the vertex's distance.
    ratio: f64,
}

const PLAIN: Reach = Reach { focal: 700.0, off_axis: 1.0, slant: 2.0, ratio: 300.0 };

/// A window of the given width and height whose centre lies at a random distance from `at`.
fn window(rng: &mut Rng, reach: Reach, at: (f64, f64), w: f64, h: f64) -> Option<[i32; 4]> {
    let x = at.0 + w * rng.real(-reach.off_axis, reach.off_axis);
    let y = at.1 + h * rng.real(-reach.off_axis, reach.off_axis);
    let up = |v: f64| to_fx(v)?.checked_add(1);
    Some([to_fx(x - w / 2.0)?, up(x + w / 2.0)?, to_fx(y - h / 2.0)?, up(y + h / 2.0)?])
}

fn family(rng: &mut Rng, kind: Kind, reach: Reach, distance: f64) -> Option<Family> {
    let (fx_px, fy_px) = (rng.log(8.0, reach.focal), rng.log(8.0, reach.focal));
    // Distances of near and far from the centre; for a parallel projection, signed positions around it.
    let near = to_fx(rng.log(0.25, 0.25 + distance.min(3000.0)))?;
    let far = to_fx(rng.log(fx(near) * 1.001 + 0.001, 32767.0))?;
    let [low, high] = {
        let a = rng.real(-distance, distance);
        let b = a + distance * rng.log(0.01, 3.0) + 0.001;
        [a, b].map(to_fx)
    };
    let parallel =
        |rng: &mut Rng, at| window(rng, reach, at, WIDTH * distance / fx_px, HEIGHT * distance / fy_px);
    // The window on a plane that lies so far before the centre.
    let central = |rng: &mut Rng, at, d: f64| window(rng, reach, at, WIDTH * d / fx_px, HEIGHT * d / fy_px);
    Some(match kind {
        Kind::FieldOfView => {
            let fov = 2.0 * (HEIGHT / 2.0 / fy_px).atan() / core::f64::consts::TAU;
            let ratio = WIDTH / HEIGHT * fy_px / fx_px;
            let aspect = ((1000.0 * ratio).ceil() as u32, 1000);
            Family::FieldOfView((fov * 4_294_967_296.0).ceil() as u32, aspect, near, far)
        }
        Kind::Frustum => Family::Frustum(central(rng, (0.0, 0.0), fx(near))?, near, far),
        Kind::Orthographic => Family::Orthographic(parallel(rng, (0.0, 0.0))?, low?, high?),
        Kind::Oblique => {
            let factor = to_fx(rng.real(-reach.slant, reach.slant))?;
            let w = parallel(rng, (0.0, 0.0))?;
            Family::Oblique(w, low?, high?, rng.bits(), factor)
        }
        Kind::Reference => {
            let n = rng.log(0.25, 3000.0);
            let w = central(rng, (0.0, 0.0), n)?;
            // The PRP in front of the window, or to its side.
            let (cw, ch) = (fx(w[1]) - fx(w[0]), fx(w[3]) - fx(w[2]));
            let x = (fx(w[0]) + fx(w[1])) / 2.0 + cw * rng.real(-reach.off_axis, reach.off_axis);
            let y = (fx(w[2]) + fx(w[3])) / 2.0 + ch * rng.real(-reach.off_axis, reach.off_axis);
            let prp = bits([x, y, n])?;
            Family::Reference(prp, w, prp[2].checked_sub(near)?, prp[2].checked_sub(far)?)
        }
        Kind::ReferenceParallel => {
            let w = parallel(rng, (0.0, 0.0))?;
            let n = rng.log(0.25, 3000.0);
            let slope = [(); 2].map(|()| rng.real(-reach.slant, reach.slant));
            let x = (fx(w[0]) + fx(w[1])) / 2.0 + slope[0] * n;
            let y = (fx(w[2]) + fx(w[3])) / 2.0 + slope[1] * n;
            Family::ReferenceParallel(bits([x, y, n])?, w, low?.checked_neg()?, high?.checked_neg()?)
        }
        Kind::EyeAtOrigin => {
            let d = to_fx(-rng.log(0.25, 3000.0))?;
            Family::EyeAtOrigin(d, central(rng, (0.0, 0.0), -fx(d))?, near, far)
        }
        Kind::OriginInPlane => {
            let d = to_fx(-rng.log(0.25, 3000.0))?;
            let w = central(rng, (0.0, 0.0), -fx(d))?;
            Family::OriginInPlane(d, w, near.checked_add(d)?, far.checked_add(d)?)
        }
        Kind::General => {
            let z_p = to_fx(rng.real(-100.0, 100.0))?;
            let direction = rng.direction();
            if direction[2].abs() < 1.0 / reach.slant {
                return None;
            }
            let length = rng.log(0.01, 1000.0);
            let direction = bits(direction.map(|c| c * length))?;
            let unit = chain::normalise(chain::fx3(direction));
            let q = to_fx(rng.log(0.25, 3000.0) * unit[2].signum())?;
            let c = unit.map(|v| v * fx(q));
            let w = central(rng, (c[0], c[1]), c[2])?;
            let centre = to_fx(c[2])?.checked_add(z_p)?;
            Family::General(z_p, Some(q), direction, w, near.checked_sub(centre)?, far.checked_sub(centre)?)
        }
        Kind::GeneralParallel => {
            let direction = rng.direction();
            if direction[2].abs() < 1.0 / reach.slant {
                return None;
            }
            let length = rng.log(0.01, 1000.0);
            let direction = bits(direction.map(|c| c * length))?;
            let z_p = to_fx(distance.min(3000.0) * rng.real(-1.0, 1.0))?;
            Family::General(z_p, None, direction, parallel(rng, (0.0, 0.0))?, low?, high?)
        }
    })
}

/// A set-up, and a point of its viewport at which the vertices are aimed.
struct Case {
    view: ViewBits,
    family: Family,
    projection: Projection,
    picture: Picture,
    viewport: (i32, i32),
    model: ModelBits,
    vertices: Vec<[i16; 3]>,
    exponent: i8,
}

fn case(rng: &mut Rng, kind: Kind, reach: Reach) -> Option<Case> {
    let distance = rng.log(0.25, 20_000.0);
    let family = family(rng, kind, reach, distance)?;
    let projection = family.library().ok()?;
    let picture = family.picture();
    let ndc = [rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)];
    let at = match picture.projectors {
        Projectors::From(c) => {
            let near = picture.distance(picture.front);
            picture.back_to(ndc, c[2] - rng.log(near, (near * 1.1).max(40_000.0)))
        }
        // Behind the front plane, and no farther than the scene is wide.
        Projectors::Along(_) => {
            let low = picture.front - 2.0 * distance;
            picture.back_to(ndc, rng.real(low, picture.front))
        }
    };
    let view = random_view(rng);
    let exact = view.exact();
    let world = exact.back(at);
    if world.iter().any(|c| c.abs() > 32000.0) {
        return None;
    }
    // The object about it.
    let scale = match picture.projectors {
        Projectors::From(_) => picture.distance(at[2]),
        Projectors::Along(_) => distance,
    };
    let wanted = scale * rng.log(1e-3, reach.ratio);
    let exponent = (wanted / 32767.0).log2().floor();
    if !(-32.0..=0.0).contains(&exponent) {
        return None;
    }
    let exponent = exponent as i8;
    let vertices = vec![[0; 3].map(|_| rng.int(-32767, 32767) as i16), [32767, -32767, 32767]];
    let mut model = ModelBits::random_rotation(rng);
    let first = model.exact().apply(chain::vertex(vertices[0], exponent));
    model.0.push(Step::Move(bits(core::array::from_fn(|i| world[i] - first[i]))?));
    let viewport = ([0, 0, -17, 100][rng.below(4)], [0, 0, 33, -200][rng.below(4)]);
    Some(Case { view, family, projection, picture, viewport, model, vertices, exponent })
}

/// The error budget without its constant, in px: what the projection's linear forms make of half
/// extent + distance from the VRP, over w, and what the guard band makes of w's.
fn budget(picture: &Picture, at: V3, extent: f64) -> f64 {
    let reach = extent + length(at);
    let w = picture.distance(at[2]);
    let (w_row, centre) = match picture.projectors {
        Projectors::From(c) => (reach + c[2].abs(), c),
        Projectors::Along(_) => (1.0, [0.0; 3]),
    };
    // x·w and y·w are linear: their coefficients from their values at four points.
    let form = |axis: usize, p: V3| picture.ndc(p)[axis] * picture.distance(p[2]);
    let row = |axis: usize| {
        // Four random points around a point that has an image.
        let o = [centre[0], centre[1], centre[2] - 1.0];
        let constant = form(axis, o);
        let slopes: V3 = core::array::from_fn(|i| {
            let mut p = o;
            p[i] -= 1.0;
            constant - form(axis, p)
        });
        let at_zero = constant - chain::dot(slopes, o);
        slopes.iter().map(|m| m.abs()).sum::<f64>() * reach + at_zero.abs()
    };
    let ndc = picture.ndc(at);
    let part = |axis: usize, size: f64| size / 2.0 * (row(axis) + ndc[axis].abs() * w_row) / w;
    8192.0 * w_row / w + part(0, WIDTH).max(part(1, HEIGHT))
}

/// The error budget of depth, in steps.
fn depth_budget(picture: &Picture, at: V3, extent: f64) -> f64 {
    let thick = picture.front - picture.back;
    let slope = picture.distance(picture.back) / thick;
    65535.0 * slope * (extent + length(at) + picture.front.abs() + thick) / picture.distance(at[2])
}

fn near_degenerate(reach: Reach) -> bool {
    reach.focal > 700.0 || reach.off_axis > 1.0 || reach.slant > 2.0 || reach.ratio > 300.0
}

fn run(seed: u64, setups: usize, kind: Kind, reach: Reach, bound: impl Fn(f64) -> f64) {
    let mut rng = Rng::new(seed);
    let (mut found, mut vertices, mut worst) = (0, 0, 0f64);
    while found < setups {
        let Some(c) = case(&mut rng, kind, reach) else {
            continue;
        };
        found += 1;
        let (x0, y0) = c.viewport;
        let area = rectangle(x0, y0, 480, 320);
        let viewport = pinhole::Viewport::new(area.top_left, area.size).expect("a viewport");
        let camera = Camera::new(&c.view.library().expect("a view"), &c.projection, &viewport);
        let (view, exact_viewport) = (c.view.exact(), Viewport::new(x0, y0, 480, 320));
        let mesh = Mesh::new(&c.vertices, c.exponent, &[]).expect("a mesh");
        let (model, exact_model) = (c.model.library(), c.model.exact());
        let instance = camera.place(&mesh, &model);
        let half_extent = 32767.0 * f64::from(c.exponent).exp2();
        let mut check = |at: V3, extent: f64, got: Option<(i32, i32, u16)>, door: &str| {
            let scale = match c.picture.projectors {
                Projectors::From(p) => {
                    let d = p[2] - at[2];
                    if d < 0.0 || (d / c.picture.distance(c.picture.front) - 1.0).abs() < 1e-4 {
                        return;
                    }
                    d
                }
                Projectors::Along(_) => {
                    let [l, r, ..] = c.picture.window;
                    // As if seen from where the focal length would be 700 px.
                    if (at[2] - c.picture.front).abs() < 1e-4 * (c.picture.front - c.picture.back) {
                        return;
                    }
                    700.0 * (r - l) / WIDTH
                }
            };
            let away = match c.picture.projectors {
                Projectors::From(p) => length(p),
                Projectors::Along(_) => c.picture.plane.abs(),
            };
            let ratio = (extent + length(at) + away) / scale;
            if ratio > reach.ratio {
                return;
            }
            let (x, y) = c.picture.screen(&exact_viewport, at);
            let inside = x >= exact_viewport.x
                && x <= exact_viewport.x + WIDTH
                && y >= exact_viewport.y
                && y <= exact_viewport.y + HEIGHT;
            if at[2] > c.picture.front {
                assert!(got.is_none(), "{door}: before the front plane {:?} {:?}", c.view, c.family);
                return;
            }
            if !inside {
                return;
            }
            let Some((gx, gy, depth)) = got else {
                panic!("{door}: dropped at ({x}, {y}), view {at:?}: {:?} {:?}", c.view, c.family);
            };
            vertices += 1;
            let budget = budget(&c.picture, at, extent);
            let error = (f64::from(gx) / 256.0 - x).abs().max((f64::from(gy) / 256.0 - y).abs());
            worst = worst.max(error);
            assert!(
                error <= bound(budget),
                "{door}: {error} px off at ({x}, {y}), view {at:?}, ratio {ratio}, budget {:.2}·2⁻³⁰: {:?} {:?} {:?}",
                (error - 1.0 / 512.0 - 2.5e-6) / budget * 2f64.powi(30),
                c.view,
                c.family,
                c.model
            );
            let exact_depth = c.picture.depth(at);
            let steps = (f64::from(depth) - exact_depth.clamp(0.0, 65534.0).round()).abs();
            let allowed = if near_degenerate(reach) {
                1.0 + 8.0 * 2f64.powi(-30) * depth_budget(&c.picture, at, extent)
            } else {
                1.0
            };
            assert!(
                steps <= allowed,
                "{door}: depth {depth} instead of {exact_depth}, ratio {ratio}, view {at:?}: {:?} {:?} {:?}",
                c.view,
                c.family,
                c.model
            );
        };
        for (i, &v) in c.vertices.iter().enumerate() {
            let at = view.apply_placed(&exact_model, chain::vertex(v, c.exponent));
            let got = instance.project(i).ok().map(|seen| (seen.point.x(), seen.point.y(), seen.depth));
            check(at, half_extent, got, "place");
        }
        // The point in world coordinates, which has its own rounding.
        let world = exact_model.apply(chain::vertex(c.vertices[0], c.exponent));
        if let Some(world) = bits(world) {
            let at = view.apply(chain::fx3(world));
            let got =
                camera.project(point(world)).ok().map(|seen| (seen.point.x(), seen.point.y(), seen.depth));
            check(at, 0.0, got, "project");
        }
    }
    println!("{kind:?}: {found} set-ups, {vertices} vertices: at most {worst:.7} px");
    assert!(vertices >= setups / 5, "{vertices}");
}

macro_rules! plain {
    ($($name:ident $kind:ident $seed:literal)*) => {$(
        #[test]
        fn $name() {
            run($seed, SETUPS, Kind::$kind, PLAIN, |_| PROMISE);
        }
    )*};
}

plain! {
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

const KINDS: [Kind; 10] = [
    Kind::FieldOfView,
    Kind::Frustum,
    Kind::Orthographic,
    Kind::Oblique,
    Kind::Reference,
    Kind::ReferenceParallel,
    Kind::EyeAtOrigin,
    Kind::OriginInPlane,
    Kind::General,
    Kind::GeneralParallel,
];

/// Long focal lengths, windows far off the axis, slants near the view plane, large ratios.
#[test]
fn s4_near_degenerate_ones_follow_the_error_budget() {
    for (k, reach) in [
        Reach { focal: 100_000.0, ..PLAIN },
        Reach { off_axis: 100.0, ..PLAIN },
        Reach { slant: 100.0, ..PLAIN },
        Reach { ratio: 1e5, ..PLAIN },
    ]
    .into_iter()
    .enumerate()
    {
        for (j, kind) in KINDS.into_iter().enumerate() {
            print!("{k} ");
            let bound = |budget| 1.0 / 512.0 + 2.5e-6 + 8.0 * 2f64.powi(-30) * budget;
            run(0x100 + 16 * k as u64 + j as u64, 5000, kind, reach, bound);
        }
    }
}
