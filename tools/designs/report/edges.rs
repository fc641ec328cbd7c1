//! Pictures of the torus, drawn from every design's corners: how far edges must move to explain them.

use crate::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits};
use crate::exact::Case;
use crate::oracle::coverage::covers;
use crate::oracle::rng::Rng;
use crate::{about, Result};
use designs::chain::Design;
use designs::list::{all, Visit};
use designs::torus::{DEGREES, DISTANCE, EXPONENT, FACES, FAR, NEAR, SIZE, VERTICES};
use designs::{Object, Vertex};
use pinhole::{Coordinate, Mesh, Scalar};

/// The number of pictures at each place.
pub(crate) const TURNS: usize = 16;
/// Where the torus is, in whole units: at the origin, and far out.
pub(crate) const PLACES: [[i32; 3]; 2] = [[0, 0, 0], [20_000, -20_000, 20_000]];

/// Shifts in px, for each place.
#[derive(Clone, Copy, Default)]
pub(crate) struct Edges {
    pub(crate) shift: [f64; PLACES.len()],
}

/// The shifts of every design, in the order of [`about::ALL`].
pub(crate) fn measure() -> Result<Vec<Edges>> {
    let mut edges = vec![Edges::default(); about::ALL.len()];
    let mut rng = Rng::new(0xE);
    for _ in 0..TURNS {
        let turns = [Step::X(rng.bits()), Step::Y(rng.bits()), Step::Z(rng.bits())];
        let gaze = rng.direction();
        for (place, at) in PLACES.iter().enumerate() {
            let target = at.map(|c| c << 16);
            let eye = core::array::from_fn(|i| target[i] + (gaze[i] * f64::from(DISTANCE)) as i32);
            // The scene's field of view, in 2⁻³² turn.
            let field = ((i64::from(DEGREES) << 32) / 360) as u32;
            let camera = CameraBits {
                view: ViewBits::LookAt(eye, target, [0, 1 << 16, 0]),
                projection: ProjectionBits::Perspective(field, (SIZE, SIZE), NEAR, FAR),
                viewport: (0, 0, SIZE, SIZE),
            };
            let mut model = ModelBits(turns.to_vec());
            model.0.push(Step::Move(target));
            let case = Case::new(&camera, &model, EXPONENT);
            let mut each = edges.iter_mut().map(|edges| &mut edges.shift[place]);
            let short = Mesh::new(&VERTICES, EXPONENT, &[]).map_err(|e| e.to_string())?;
            library(&case, &short, each.next())?;
            let fixed = VERTICES.map(|v| v.map(|c| Scalar::from_bits(i32::from(c) << (16 + EXPONENT))));
            library(&case, &Mesh::from_fixed(&fixed, &[]).map_err(|e| e.to_string())?, each.next())?;
            all(&mut Painter { object: &case.object, shifts: &mut each });
        }
    }
    Ok(edges)
}

fn library<V: Coordinate<Stored = V>>(
    case: &Case,
    mesh: &Mesh<'_, V>,
    shift: Option<&mut f64>,
) -> Result<()> {
    let instance = case.camera.place(mesh, &case.model);
    let corners: Option<Vec<_>> = (0..VERTICES.len())
        .map(|index| {
            let point = instance.project(index).ok()?.point;
            Some((point.x().into(), point.y().into()))
        })
        .collect();
    let exact: Vec<_> = VERTICES.iter().map(|v| image(&case.object, v.relative(&case.object))).collect();
    if let Some(shift) = shift {
        *shift = shift.max(picture(&exact, &corners.ok_or("a vertex has no place")?));
    }
    Ok(())
}

/// The exact position of a point, in pixels from the picture's top left.
fn image(object: &Object, from_eye: [f64; 3]) -> [f64; 2] {
    let [x, y, _] = object.image(from_eye);
    [x + object.centre[0], y + object.centre[1]]
}

struct Painter<'p, I> {
    object: &'p Object,
    shifts: &'p mut I,
}

impl<'s, I: Iterator<Item = &'s mut f64>> Visit for Painter<'_, I> {
    fn visit<D: Design>(&mut self, _: &'static str) {
        let Some(shift) = self.shifts.next() else { return };
        let Some(design) = D::new(self.object) else { return };
        let vertices = VERTICES.map(|v| D::Vertex::of(self.object, v));
        let exact = vertices.map(|v| image(self.object, v.relative(self.object)));
        let centre = if D::FROM_CENTRE { i64::from(SIZE) * 128 } else { 0 };
        let corners = vertices.map(|v| {
            let corner = design.corner(v);
            let along = |c: i32| (i64::from(c) << (8 - D::BITS)) + centre;
            (along(corner.x), along(corner.y))
        });
        *shift = shift.max(picture(&exact, &corners));
    }
}

/// The smallest shift of edges that explains every pixel of every face: the faces are drawn one by one, so that none
/// hides what another gets wrong. Corners are in 24.8.
fn picture(exact: &[[f64; 2]], corners: &[(i64, i64)]) -> f64 {
    let mut shift = 0.0f64;
    for face in &FACES {
        let (drawn, true_) = (face.map(|i| corners[usize::from(i)]), face.map(|i| exact[usize::from(i)]));
        let along = |k: usize| {
            let all = drawn.map(|(x, y)| [x, y][k] as f64 / 256.0);
            let all = all.iter().chain(true_.iter().map(|p| &p[k]));
            let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), &c| (l.min(c), h.max(c)));
            (low.floor().max(0.0) as i64, high.ceil().min(f64::from(SIZE)) as i64)
        };
        let ((left, right), (top, bottom)) = (along(0), along(1));
        for row in top..bottom {
            for column in left..right {
                let inside = inside(true_, [column as f64 + 0.5, row as f64 + 0.5]);
                // Only larger errors matter.
                if inside.abs() > shift && (inside > 0.0) != covers(drawn, column, row) {
                    shift = inside.abs();
                }
            }
        }
    }
    shift
}

/// How far inside the triangle the point lies; outside, how far from it, negative.
fn inside(t: [[f64; 2]; 3], p: [f64; 2]) -> f64 {
    let cross =
        |a: [f64; 2], b: [f64; 2], p: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let turn = cross(t[0], t[1], t[2]).signum();
    let (mut nearest, mut inside) = (f64::MAX, true);
    for k in 0..3 {
        let (a, b) = (t[k], t[(k + 1) % 3]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let along = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
        let along = along.clamp(0.0, 1.0);
        nearest = nearest.min((p[0] - a[0] - along * dx).hypot(p[1] - a[1] - along * dy));
        inside &= turn * cross(a, b, p) >= 0.0;
    }
    if inside {
        nearest
    } else {
        -nearest
    }
}
