//! Transforms vertices by the library and, from the same bits, in f64.

use super::population::{Design, Object, Population, DESIGNS, RANGES, VERTICES};
use super::Errors;
use crate::bridge::{point, scalar, vector};
use crate::oracle::chain::{self, V3};
use crate::oracle::rng::Rng;
use pinhole::camera::Projected;
use pinhole::space::{Model, World};
use pinhole::{mesh::Coordinate, prelude::*};

/// Vertices per population and design.
pub(super) const COUNT: usize = 1_000_000;

/// Errors before and after the rounding.
pub(super) type Pair = [Errors; 2];

/// The errors of a population.
#[derive(Default)]
pub(super) struct Sweep {
    /// Errors in px, per format.
    pub(super) places: [Pair; DESIGNS.len()],
    /// Errors in depth steps, per far ÷ near; for points and objects up to 16 times their distance, and up to 300.
    pub(super) depths: [[Pair; 2]; RANGES.len()],
    /// The largest error before the snap per unit of r/z, for r/z ≥ 16, in px.
    pub(super) per_ratio: f64,
}

/// The library's result for a vertex: x and y in px and depth in steps, before and after rounding.
struct Seen {
    before: V3,
    after: V3,
}

fn after(Projected { point, depth }: Projected) -> V3 {
    [f64::from(point.x()) / 256.0, f64::from(point.y()) / 256.0, depth.into()]
}

fn seen<V: Coordinate<Stored = V>>(
    camera: &Camera,
    mesh: &Mesh<'_, V>,
    model: &Affine<Model, World>,
) -> Vec<Option<Seen>> {
    let instance = camera.place(mesh, model);
    let vertex = |i| {
        let before = instance.project_unsnapped(i)?.map(|v| v as f64 / 4_294_967_296.0);
        Some(Seen { before, after: after(instance.project(i).ok()?) })
    };
    (0..VERTICES).map(vertex).collect()
}

fn object(
    camera: &Camera,
    design: Design,
    object: &Object,
) -> Result<Vec<Option<Seen>>, pinhole::mesh::MeshError> {
    let model = object.model.library();
    Ok(match design {
        Design::Fixed => {
            let vertices = object.fixed.map(|v| v.map(scalar));
            seen(camera, &Mesh::from_fixed(&vertices, &[])?, &model)
        }
        _ => seen(camera, &Mesh::new(&object.short, object.exponent, &[])?, &model),
    })
}

/// A single point by [`Camera::project`]. It is also drawn as an object without extent, from which its position before the snap
/// is read.
fn single(camera: &Camera, at: [i32; 3]) -> Result<Option<Seen>, pinhole::mesh::MeshError> {
    let model = Affine::<Model, World>::scale(Scalar::ZERO).then(&Affine::translation(vector(at)));
    let vertices = [[0; 3]; VERTICES];
    let as_object = seen(camera, &Mesh::new(&vertices, 0, &[])?, &model).into_iter().next().flatten();
    let projected = camera.project(point(at)).ok();
    Ok(as_object.zip(projected).map(|(seen, projected)| Seen { after: after(projected), ..seen }))
}

/// A million visible vertices for each design.
pub(super) fn sweep(population: &Population) -> Result<Sweep, String> {
    let mut sweep = Sweep::default();
    // Each camera has its own generator, so that no case depends on another.
    for index in 0.. {
        if sweep.places.iter().all(|pair| pair[0].count() >= COUNT) {
            break;
        }
        let mut rng = Rng::new(Rng::new(population.seed << 32 | index).next());
        let (bits, range) = population.camera(&mut rng);
        let exact = bits.exact();
        let camera = bits.library();
        for (k, design) in DESIGNS.into_iter().enumerate() {
            if sweep.places[k][0].count() >= COUNT {
                continue;
            }
            let Some(at) = population.target(&mut rng, &bits, &exact) else { continue };
            let mut one = |seen: Option<Seen>, model: &chain::Affine, p: V3, half_extent: f64| {
                let view = exact.view.apply_placed(model, p);
                let ratio = half_extent / -view[2];
                let (near, far) = (bits.projection.near(), bits.projection.far());
                let deep = -view[2] >= near * (1.0 + 1e-3) && -view[2] <= far * (1.0 - 1e-3);
                if !deep || ratio > design.2 .1 || !population.inside(model.apply(p)) {
                    return Ok(());
                }
                let clip = chain::mul4(&exact.projection, [view[0], view[1], view[2], 1.0]);
                let (x, y) = exact.screen(clip);
                let (width, height) = (exact.viewport.width, exact.viewport.height);
                if !(0.0..=width).contains(&x) || !(0.0..=height).contains(&y) {
                    return Ok(());
                }
                let Some(Seen { before, after }) = seen else {
                    return Err(format!("a vertex at ({x}, {y}), {view:?}, has no place: {bits:?}"));
                };
                let z = chain::depth(clip);
                let off = |v: V3| (v[0] - x).abs().max((v[1] - y).abs());
                let depth = [before[2] - z, after[2] - z.clamp(0.0, 65_534.0)].map(f64::abs);
                let of_depth = &mut sweep.depths[range][usize::from(design.2 .1 > 16.0)];
                of_depth.iter_mut().zip(depth).for_each(|(errors, error)| errors.add(error));
                sweep.places[k].iter_mut().zip([before, after]).for_each(|(errors, at)| errors.add(off(at)));
                if ratio >= 16.0 {
                    sweep.per_ratio = sweep.per_ratio.max(off(before) / ratio);
                }
                Ok(())
            };
            if design.0 == Design::Point {
                for _ in 0..VERTICES {
                    let Some(at) = population.target(&mut rng, &bits, &exact) else { continue };
                    let Some(world) = crate::bridge::pair::bits(exact.view.back(at)) else { continue };
                    let seen = single(&camera, world).map_err(|e| e.to_string())?;
                    one(seen, &chain::IDENTITY, chain::fx3(world), 0.0)?;
                }
                continue;
            }
            let Some(o) = population.object(&mut rng, design, &exact.view, at) else { continue };
            let exact_model = o.model.exact();
            let all = object(&camera, design.0, &o).map_err(|e| e.to_string())?;
            for (i, seen) in all.into_iter().enumerate() {
                let p = match design.0 {
                    Design::Fixed => chain::fx3(o.fixed[i]),
                    _ => chain::vertex(o.short[i], o.exponent),
                };
                one(seen, &exact_model, p, o.half_extent)?;
            }
        }
    }
    Ok(sweep)
}
