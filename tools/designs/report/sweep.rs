//! Random vertices before random cameras through every design, against f64 of the same inputs.

use crate::about::Family;
use crate::errors::{Errors, Figures, Pair};
use crate::exact::Case;
use crate::oracle::rng::Rng;
use crate::population::{self, Population, POPULATIONS, VERTICES};
use crate::{about, Result};
use designs::chain::{Design, ScreenVertex};
use designs::list::{all, Visit};
use designs::{Object, Vertex};
use pinhole::{Coordinate, Mesh, MeshInstance, Scalar};

/// Vertices of a class.
pub(crate) const COUNT: usize = 250_000;
/// The farthest distance of a vertex: beyond it, the view coordinates of Q16.16 leave 32 bits.
const FARTHEST: f64 = 8192.0;

pub(crate) struct Class {
    pub(crate) population: &'static Population,
    /// Half extent ÷ distance.
    ratio: (f64, f64),
}

const UP_TO_16: (f64, f64) = (1.0 / 64.0, 16.0);

/// A, B and C as in docs/accuracy.md; D is an object that the camera sees whole.
pub(crate) const CLASSES: [Class; 4] = [
    Class { population: &POPULATIONS[0], ratio: UP_TO_16 },
    Class { population: &POPULATIONS[1], ratio: UP_TO_16 },
    Class { population: &POPULATIONS[2], ratio: UP_TO_16 },
    Class {
        population: &Population { name: "D", world: 64, nearest: 4, size: (240, 240), seed: 0xD },
        ratio: (1.0 / 8.0, 0.5),
    },
];

/// The errors of every design, in the order of [`about::ALL`].
pub(crate) fn measure() -> Result<Vec<Errors>> {
    let classes: Result<Vec<Vec<Pair>>> = std::thread::scope(|scope| {
        let threads: Vec<_> = CLASSES.iter().map(|class| scope.spawn(|| sweep(class))).collect();
        threads.into_iter().map(|thread| thread.join().map_err(|_| "a class of errors")?).collect()
    });
    let classes = classes?;
    let of = |design: usize| Errors { classes: core::array::from_fn(|class| classes[class][design]) };
    Ok((0..about::ALL.len()).map(of).collect())
}

/// Errors of one design, one by one.
#[derive(Default)]
struct Raw {
    before: Vec<f32>,
    after: Vec<f32>,
    /// Vertices in the picture that the design takes for vertices in front of the near plane.
    lost: usize,
    /// The largest distance of a corner from the place that it was rounded from, in sub-pixels.
    snap: f64,
}

impl Raw {
    fn add(&mut self, exact: [f64; 2], before: [f64; 2], after: [f64; 2]) {
        let off = |at: [f64; 2]| (at[0] - exact[0]).abs().max((at[1] - exact[1]).abs()) as f32;
        self.before.push(off(before));
        self.after.push(off(after));
    }
}

fn sweep(class: &Class) -> Result<Vec<Pair>> {
    let Class { population, ratio } = class;
    let mut raw: Vec<Raw> = about::ALL.iter().map(|_| Raw::default()).collect();
    // Each camera has a generator of its own: no case depends on another.
    for index in 0.. {
        if raw[0].before.len() >= COUNT {
            break;
        }
        let mut rng = Rng::new(Rng::new(population.seed << 32 | index).next());
        let (bits, _) = population.camera(&mut rng);
        let exact = bits.exact();
        let Some(at) = population.target(&mut rng, &bits, &exact) else { continue };
        let design = (population::Design::Short, "", *ratio);
        let Some(o) = population.object(&mut rng, design, &exact.view, at) else { continue };
        let case = Case::new(&bits, &o.model, o.exponent);
        let visible = |v: &[i16; 3]| {
            let from_eye = v.relative(&case.object);
            let [.., z] = case.object.image(from_eye);
            let world = core::array::from_fn(|i| from_eye[i] + case.object.eye[i]);
            is_seen(&case.object, from_eye) && o.half_extent / z <= ratio.1 && population.inside(world)
        };
        let vertices: Vec<[i16; 3]> = o.short[..VERTICES].iter().copied().filter(visible).collect();
        // The library computes a mesh's size from its vertices, so the corner of the box is one of them.
        let mut mesh = vertices.clone();
        mesh.push(o.short[VERTICES]);
        let fixed: Vec<_> = mesh.iter().map(|v| fixed(*v, o.exponent)).collect();
        let short = Mesh::new(&mesh, o.exponent, &[]).map_err(|e| e.to_string())?;
        library(&case, &short, &vertices, &mut raw[0])?;
        if fixed.iter().flatten().all(Option::is_some) {
            let fixed: Vec<_> = fixed.iter().map(|v| v.map(Option::unwrap_or_default)).collect();
            let mesh = Mesh::from_fixed(&fixed, &[]).map_err(|e| e.to_string())?;
            library(&case, &mesh, &vertices, &mut raw[1])?;
        }
        all(&mut Meter { object: &case.object, vertices: &vertices, raw: raw[2..].iter_mut() });
    }
    for (about, raw) in about::ALL.iter().zip(&raw) {
        // This happens where the error of depth is larger than a vertex's distance from the near plane; elsewhere it is a fault.
        if raw.lost > 0 && about.exact_depth() {
            return Err(format!("{} has no place for {} vertices in the picture", about.id, raw.lost).into());
        }
    }
    for (about, raw) in about::ALL.iter().zip(&raw) {
        // Half a sub-pixel, and what was dropped before the rounding. f32 is cut towards zero, which is no rounding for vertices
        // left of the picture.
        let most = if about.family == Family::Float { 1.5 } else { 0.6 };
        if raw.snap > most {
            return Err(format!("{} snaps by {} sub-pixels", about.id, raw.snap).into());
        }
    }
    let pair =
        |mut raw: Raw| Pair { before: Figures::of(&mut raw.before), after: Figures::of(&mut raw.after) };
    Ok(raw.into_iter().map(pair).collect())
}

/// Whether the point lies in the picture, between near and far.
fn is_seen(object: &Object, from_eye: [f64; 3]) -> bool {
    let [x, y, z] = object.image(from_eye);
    let [cx, cy] = object.centre;
    let deep = z > object.near * (1.0 + 1e-3) && z < object.far.min(FARTHEST) * (1.0 - 1e-3);
    deep && x.abs() < cx && y.abs() < cy
}

/// The vertex in I16F16, where it has no finer bits.
fn fixed(vertex: [i16; 3], exponent: i8) -> [Option<Scalar>; 3] {
    let up = 16 + i32::from(exponent);
    vertex.map(|c| {
        let bits = if up >= 0 { i64::from(c) << up } else { i64::from(c) };
        i32::try_from(bits).ok().filter(|_| up >= 0).map(Scalar::from_bits)
    })
}

fn library<V: Coordinate<Stored = V>>(
    case: &Case,
    mesh: &Mesh<'_, V>,
    vertices: &[[i16; 3]],
    raw: &mut Raw,
) -> Result<()> {
    let instance: MeshInstance<'_, V> = case.camera.place(mesh, &case.model);
    for (index, v) in vertices.iter().enumerate() {
        let [cx, cy] = case.object.centre;
        let [x, y, _] = case.object.image(v.relative(&case.object));
        let (Some([bx, by, _]), Ok(pinhole::Projected { point: p, .. })) =
            (instance.project_unsnapped(index), instance.project(index))
        else {
            return Err(format!("the library has no place for {v:?}").into());
        };
        let before = [bx, by].map(|c| c as f64 / 4_294_967_296.0);
        raw.add([x + cx, y + cy], before, [f64::from(p.x()) / 256.0, f64::from(p.y()) / 256.0]);
    }
    Ok(())
}

struct Meter<'m> {
    object: &'m Object,
    vertices: &'m [[i16; 3]],
    raw: core::slice::IterMut<'m, Raw>,
}

impl Visit for Meter<'_> {
    fn visit<D: Design>(&mut self, _: &'static str) {
        let Some(raw) = self.raw.next() else { return };
        let Some(design) = D::new(self.object) else { return };
        let origin = if D::FROM_CENTRE { [0.0; 2] } else { self.object.centre };
        for &v in self.vertices {
            let v = D::Vertex::of(self.object, v);
            let from_eye = v.relative(self.object);
            // A coarser vertex type may have moved it out of the picture.
            if !is_seen(self.object, from_eye) {
                continue;
            }
            let [x, y, _] = self.object.image(from_eye);
            let corner = design.corner(v);
            if corner == ScreenVertex::EMPTY {
                raw.lost += 1;
                continue;
            }
            let subpixels = f64::from(1 << D::BITS);
            let after = [f64::from(corner.x) / subpixels, f64::from(corner.y) / subpixels];
            let before = design.before_snap(v);
            for i in 0..2 {
                raw.snap = raw.snap.max((after[i] - before[i]).abs() * subpixels);
            }
            raw.add([x + origin[0], y + origin[1]], before, after);
        }
    }
}
