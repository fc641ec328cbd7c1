//! Golden pictures of a cube in perspective and in orthographic projection, which the oracles drew.

use crate::picture::Picture;
use support::bridge::draw::CUBE;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::chain::vertex;

const SIZE: (u32, u32) = (44, 22);

/// The camera looks down at the cube, which has been turned about y and x. Sides: +x, −x, +y, −y, +z, −z.
fn picture(projection: ProjectionBits) -> Picture {
    let camera = CameraBits {
        view: ViewBits::LookAt([ONE, 2 * ONE, 4 * ONE], [0; 3], [0, ONE, 0]),
        projection,
        viewport: (0, 0, SIZE.0, SIZE.1),
    };
    let model = ModelBits(vec![Step::Y(350_000_000), Step::X(80_000_000)]);
    let (exact, turned) = (camera.exact(), model.exact());
    let exact: Vec<_> = CUBE.iter().map(|&v| exact.screen(exact.clip(&turned, vertex(v, 0)))).collect();
    for c in exact.iter().flat_map(|&(x, y)| [x, y]) {
        assert!(((c * 256.0).fract().abs() - 0.5).abs() > 1e-2, "a tie of the snap decides the picture");
    }
    let (camera, model) = (camera.library(), model.library());
    Picture { camera, model, vertices: CUBE, exact, size: SIZE, letters: b"aAbBcC" }
}

#[test]
fn a_cube_matches_its_golden_pictures() {
    // Pixels are twice as high as wide in a terminal: the aspect says so.
    let lens = ProjectionBits::Perspective((1 << 31) / 4, (SIZE.0, 2 * SIZE.1), ONE, 20 * ONE);
    let flat = ProjectionBits::Orthographic([-2 * ONE, 2 * ONE, -2 * ONE, 2 * ONE], ONE, 20 * ONE);
    let drawn = [lens, flat].map(|projection| picture(projection).as_the_oracle().join("\n")).join("\n");
    assert!(drawn == include_str!("cube.golden"), "{drawn}");
}
