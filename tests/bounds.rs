//! Rule 2 of the house: every stated bound of a numeric function holds, and is at most twice the largest error met.
//! The measurements are those of docs/accuracy.md, made anew (`examples/accuracy/functions.rs`).
//!
//! `src/math/num.rs`, `unit.rs` and `quaternion.rs` are compiled in once more, as what is measured: their functions
//! are private.

mod bridge;
mod oracle;

#[path = "../examples/accuracy/functions.rs"]
mod functions;
#[allow(dead_code)]
#[path = "../src/math/num.rs"]
mod num;
#[allow(dead_code, unreachable_pub)]
#[path = "../src/math/quaternion.rs"]
mod quaternion;
#[allow(dead_code)]
#[path = "../src/math/unit.rs"]
mod unit;

use functions::Measured;
use oracle::rng::Rng;
use pinhole::space::{Model, World};
use pinhole::{Affine, NumberError, Point3, Scalar, Viewing}; // the numbers for `quaternion`

#[track_caller]
fn hold<const N: usize>(test: &str, all: [Measured; N]) {
    for m in all {
        println!("{}: {:e} of {:e} ({})", m.what, m.error, m.bound, m.unit);
        assert_eq!(m.test, test, "the page names another test");
        assert!(m.error <= m.bound, "{}: {:e} beyond {:e}", m.what, m.error, m.bound);
        assert!(m.bound <= 2.0 * m.error, "{}: {:e} is far below {:e}", m.what, m.error, m.bound);
    }
}

#[test]
fn e7_sine_and_cosine() {
    hold("e7_sine_and_cosine", functions::sines());
}

#[test]
fn e7_angles() {
    hold("e7_angles", functions::angles());
}

#[test]
fn e8_reciprocal() {
    hold("e8_reciprocal", functions::reciprocals());
}

#[test]
fn square_root() {
    hold("square_root", functions::roots());
}

#[test]
fn e4_unit_vectors() {
    hold("e4_unit_vectors", functions::unit_vectors());
}

#[test]
fn s2_rotations() {
    hold("s2_rotations", functions::rotations());
}

#[test]
fn s2_compositions_and_inverses() {
    hold("s2_compositions_and_inverses", functions::compositions());
}

#[test]
fn s2_normals() {
    hold("s2_normals", functions::normals());
}

#[test]
fn s3_views() {
    hold("s3_views", functions::views());
}

#[test]
fn s4_projections() {
    hold("s4_projections", functions::projections());
}

#[test]
fn s4_planes_and_vanishing_points() {
    hold("s4_planes_and_vanishing_points", functions::planes());
}

#[test]
fn s4_reference_volumes() {
    hold("s4_reference_volumes", functions::volumes());
}

#[test]
fn s6_viewports() {
    hold("s6_viewports", functions::viewports());
}

/// 1/√2, 1/√3 and 1/√6, to 2⁻³².
#[test]
fn s4_isometric_rows() {
    let (half, third, sixth) = (0.5f64.sqrt(), (1.0f64 / 3.0).sqrt(), (1.0f64 / 6.0).sqrt());
    let exact = [[half, 0.0, -half], [-sixth, 2.0 * sixth, -sixth], [third, third, third]];
    let rows = Viewing::isometric(Point3::from_ints(0, 0, 0)).rows();
    let mut worst = 0f64;
    for (row, exact) in rows.iter().zip(exact) {
        for (got, exact) in row.iter().zip(exact) {
            worst = worst.max((f64::from(*got) - exact * 1_073_741_824.0).abs());
        }
    }
    assert!((0.125..=0.25).contains(&worst), "{worst}");
}

/// What a transform keeps comes out of the matrix door and goes in again without loss.
#[test]
fn s2_a_matrix_read_back_is_the_same_transform() {
    let mut rng = Rng::new(0x5B);
    for _ in 0..20_000 {
        let size = rng.log(1e-6, 1e6);
        let any = [[0.0; 4]; 4].map(|row| row.map(|_| size * rng.real(-1.0, 1.0)));
        let matrix = [any[0], any[1], any[2], [0.0, 0.0, 0.0, 1.0]];
        let kept = Affine::<Model, World>::from_matrix(&matrix).expect("an affine matrix");
        let again = Affine::<Model, World>::from_matrix(&kept.to_matrix());
        assert_eq!(again.map(|a| a.to_matrix()), Ok(kept.to_matrix()), "{matrix:?}");
        // And what it keeps of the translation is its nearest 2⁻³².
        for (kept, given) in kept.to_matrix().iter().zip(matrix) {
            assert!((kept[3] - given[3]).abs() <= 2f64.powi(-33), "{matrix:?}");
        }
    }
}
