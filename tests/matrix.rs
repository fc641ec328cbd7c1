//! SPEC 4, issue B: any projective 4 × 4 as it is. 10⁵ random matrices, each a frustum, a box or a
//! slanted box after a rigid move of view space, times any positive factor: vertices within 1/256 px
//! of the same matrix in f64. And what is refused.

mod bridge;
mod oracle;

use bridge::pair::{bits, random_view, ModelBits};
use bridge::{point, rectangle};
use oracle::chain::{self, length, Viewport, M4, V3};
use oracle::rng::Rng;
use pinhole::{Camera, Projection, ProjectionError};

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 320.0;

struct Case {
    matrix: M4,
    /// A view point, and its distance or the scale of the scene.
    at: V3,
    scale: f64,
    away: f64,
}

fn case(rng: &mut Rng) -> Case {
    let distance = rng.log(0.25, 10_000.0);
    let (fx, fy) = (rng.log(8.0, 700.0), rng.log(8.0, 700.0));
    let (w, h) = (WIDTH / fx, HEIGHT / fy);
    let (x, y) = (w * rng.real(-1.0, 1.0), h * rng.real(-1.0, 1.0));
    let (l, r, b, t) = (x - w / 2.0, x + w / 2.0, y - h / 2.0, y + h / 2.0);
    let near = distance * rng.log(0.01, 0.9);
    let far = distance * rng.log(1.1, 100.0);
    let flat = rng.one_in(3);
    let (mut m, at) = if flat {
        let [l, r, b, t] = [l, r, b, t].map(|c| c * distance);
        let mut m = chain::orthographic(l, r, b, t, near, far);
        m[0][2] = m[0][0] * rng.real(-2.0, 2.0);
        m[1][2] = m[1][1] * rng.real(-2.0, 2.0);
        (m, distance)
    } else {
        let [l, r, b, t] = [l, r, b, t].map(|c| c * near);
        (chain::frustum(l, r, b, t, near, far), distance)
    };
    // A place in the picture.
    let wanted = [rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)];
    let w = if flat { 1.0 } else { at };
    let p = [
        (wanted[0] * w + m[0][2] * at - m[0][3]) / m[0][0],
        (wanted[1] * w + m[1][2] * at - m[1][3]) / m[1][1],
        -at,
    ];
    // The move, undone on the point.
    let turn = ModelBits::random_rotation(rng).exact();
    let shift = rng.direction().map(|c| c * distance * rng.log(0.01, 10.0));
    let back: V3 = core::array::from_fn(|i| (0..3).map(|k| turn.m[k][i] * (p[k] - shift[k])).sum());
    let rigid: M4 = core::array::from_fn(|i| match i {
        3 => [0.0, 0.0, 0.0, 1.0],
        _ => [turn.m[i][0], turn.m[i][1], turn.m[i][2], shift[i]],
    });
    m = chain::matmul4(&m, &rigid);
    let factor = match rng.below(3) {
        0 => 1.0,
        1 => rng.log(1e-6, 1e6),
        _ => rng.log(1e-30, 1e30),
    };
    let matrix = m.map(|row| row.map(|c| c * factor));
    Case { matrix, at: back, scale: distance, away: length(shift) }
}

#[test]
fn s4_any_matrix_within_1_256_px() {
    let mut rng = Rng::new(0xAA);
    let (mut setups, mut worst, mut steps_worst) = (0, 0f64, 0f64);
    while setups < 100_000 {
        let c = case(&mut rng);
        let bits_view = random_view(&mut rng);
        let view = bits_view.exact();
        let world =
            core::array::from_fn(|i| view.eye[i] + (0..3).map(|k| view.rows[k][i] * c.at[k]).sum::<f64>());
        let Some(world) = bits(world) else { continue };
        let at = view.apply(chain::fx3(world));
        let clip = chain::mul4(&c.matrix, [at[0], at[1], at[2], 1.0]);
        let exact_viewport = Viewport::new(5, -7, 480, 320);
        let [x, y, z] = [0, 1, 2].map(|i| clip[i] / clip[3]);
        // The world's 2⁻¹⁶ may have moved it out.
        if clip[3] <= 0.0 || x.abs() > 1.0 || y.abs() > 1.0 || z < -0.9999 {
            continue;
        }
        let ratio = (length(at) + c.away) / c.scale;
        assert!(ratio < 300.0);
        setups += 1;
        let projection = Projection::from_matrix(&c.matrix).expect("a matrix");
        let area = rectangle(5, -7, 480, 320);
        let viewport = pinhole::Viewport::new(area.top_left, area.size).expect("a viewport");
        let camera = Camera::new(&bits_view.library().expect("a view"), &projection, &viewport);
        let (p, depth) = match camera.project(point(world)) {
            Ok(found) => found,
            Err(error) => panic!("{error}: {bits_view:?} {:?} {world:?} {clip:?}", c.matrix),
        };
        let (ex, ey) = exact_viewport.apply([x, y, z]);
        let error = (f64::from(p.x()) / 256.0 - ex).abs().max((f64::from(p.y()) / 256.0 - ey).abs());
        worst = worst.max(error);
        assert!(
            error <= 1.0 / 256.0,
            "{error} px off, ratio {ratio}: {bits_view:?} {:?} {world:?} {clip:?}",
            c.matrix
        );
        let wanted = chain::depth(clip).clamp(0.0, 65534.0).round();
        let steps = (f64::from(depth) - wanted).abs();
        steps_worst = steps_worst.max(steps);
        assert!(steps <= 1.0, "depth {depth} for {wanted}: {bits_view:?} {:?} {world:?} {clip:?}", c.matrix);
    }
    println!(
        "matrices: {worst:.7} px, beyond the snap {:.2e} px, depth {steps_worst} steps",
        worst - 1.0 / 512.0
    );
}

#[test]
fn s4_what_is_no_matrix_is_refused() {
    let good = chain::frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0);
    assert!(Projection::from_matrix(&good).is_ok());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..4 {
            for j in 0..4 {
                let mut m = good;
                m[i][j] = bad;
                assert_eq!(Projection::from_matrix(&m), Err(ProjectionError::Matrix));
            }
        }
    }
    assert_eq!(Projection::from_matrix(&[[0.0; 4]; 4]), Err(ProjectionError::Matrix));
}
