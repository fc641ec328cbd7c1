//! Texels of scenes, against their definition and against rays.

use crate::harness::{changed, with, Folder};
use serde_json::{json, Value};

/// A square of two triangles that fills a picture of 16 × 16, with 16 × 8 texels on it.
pub(crate) fn textured(changes: Value) -> Value {
    let scene = json!({
        "vertices": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
        "triangles": [[0, 1, 2], [0, 2, 3]],
        "uv": [[0, 8], [16, 8], [16, 0], [0, 0]],
        "texture": [16, 8], "width": 16, "height": 16
    });
    changed(with(scene), changes)
}

/// The picture of a texture.
fn texel(column: u32, row: u32) -> [u8; 4] {
    [column as u8 * 16, row as u8 * 32, 99, 255]
}

#[test]
fn texels_are_numbered_row_by_row() {
    let to = Folder::new("texels");
    let texels = |changes: Value| to.draw(&textured(changes), &[]).texels;
    // Pixel (i, j) has u = i + ½ and v = (j + ½)/2, in column i and row j/2.
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| (1 << 15) | (j / 2 * 16 + i))).collect();
    let corners = [[[0, 8], [16, 8], [16, 0]], [[0, 8], [16, 0], [0, 0]]];
    for changes in [
        json!({}),
        json!({"uv": corners, "wrap": "repeat"}),
        // Three pictures to the left, and one down: rounded down below zero, too.
        json!({"uv": [[-48, 16], [-32, 16], [-32, 8], [-48, 8]]}),
    ] {
        assert_eq!(texels(changes.clone()), expected, "{changes}");
    }
    // Nothing is drawn where the triangle is not.
    let half = texels(json!({"uv": [corners[0]], "triangles": [[0, 1, 2]]}));
    assert_eq!(half.iter().filter(|&&number| number == 0).count(), 16 * 15 / 2);
    assert!(half.iter().zip(&expected).all(|(&a, &b)| a == 0 || a == b));
    // The edge of a clamped picture continues: one picture to the left and to the right, half a picture above and below.
    // Pixel (i, j) has u = 3·(i + ½) − 16 and v = j + ½ − 4.
    let column = |i: i32| (3 * i + 1 - 16).clamp(0, 15);
    let row = |j: i32| (j - 4).clamp(0, 7);
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| 1 << 15 | (16 * row(j) + column(i)) as u16)).collect();
    let clamped = json!({"uv": [[-16, 12], [32, 12], [32, -4], [-16, -4]], "wrap": "clamp"});
    assert_eq!(texels(clamped), expected);
}

#[test]
fn a_picture_is_a_texture_which_may_be_lit() {
    let to = Folder::new("picture");
    to.png("texture.png", [16, 8], texel);
    let scene = textured(json!({"texture": "texture.png"}));
    let drawn = to.draw(&scene, &[]);
    assert_eq!(drawn.texels[16 * 15 + 15], 1 << 15 | 127);
    for (index, pixel) in (0..).zip(&drawn.picture) {
        assert_eq!(pixel[..], texel(index % 16, index / 32)[..3], "{index}");
    }
    // A white face of the same scene shows the light.
    let white = textured(json!({"uv": null, "texture": null}));
    let light = to.draw(&white, &["--mode", "flat", "--colour", "white"]).picture;
    assert!(light[0][0] > 60 && light[0][0] < 250);
    let lit = to.draw(&scene, &["--lit-texture"]).picture;
    for ((plain, lit), light) in drawn.picture.iter().zip(&lit).zip(&light) {
        for channel in 0..3 {
            let exact = f64::from(plain[channel]) * f64::from(light[channel]) / 255.0;
            assert!((f64::from(lit[channel]) - exact).abs() <= 1.5, "{plain:?} in {light:?}: {lit:?}");
        }
    }
}

#[test]
fn texels_of_a_rolled_floor_are_those_of_rays() {
    // The floor y = −1, seen along −z, the camera rolled by 25°; w is 1 to 17.
    let (sin, cos) = 25f64.to_radians().sin_cos();
    // Near ½, far 32, 90°.
    let (near, far) = (0.5, 32.0);
    let depth = [0.0, 0.0, (far + near) / (near - far), 2.0 * far * near / (near - far)];
    let scene = textured(json!({
        "vertices": [[-9, -1, -1], [9, -1, -1], [9, -1, -17], [-9, -1, -17]],
        "uv": [[0, 64], [72, 64], [72, 0], [0, 0]],
        "texture": [64, 32],
        "view": [[cos, -sin, 0, 0], [sin, cos, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        "projection": [[1, 0, 0, 0], [0, 1, 0, 0], depth, [0, 0, -1, 0]],
        "width": 96, "height": 96
    }));
    let numbers = Folder::new("rolled").draw(&scene, &[]).texels;
    let (mut seen, mut equal) = (0, 0);
    for (index, &number) in numbers.iter().enumerate() {
        let at = |c: usize| (c as f64 + 0.5) / 48.0 - 1.0;
        let (x, y) = (at(index % 96), -at(index / 96));
        // Back through the roll, to the ray (x, y, −1) and the floor.
        let (x, y) = (cos * x + sin * y, -sin * x + cos * y);
        let t = -1.0 / y;
        let (u, v) = (4.0 * (t * x + 9.0), 4.0 * (17.0 - t));
        let is_on_floor = |more: f64| t > 1.0 - more && t < 17.0 + more && (t * x).abs() < 9.0 + more;
        if number == 0 {
            assert!(!is_on_floor(-0.1), "{index}");
            continue;
        }
        assert!(is_on_floor(0.1), "{index}");
        seen += 1;
        let (column, row) = (f64::from(number & 63), f64::from((number & 0x7fff) >> 6));
        // Within the bound of ¼ texel, 1/50 for the planes, and 1/64 pixel, which is up to t²/12 texels far away.
        let shift = t * t / 12.0 / 64.0;
        for (coordinate, texel, side) in [(u, column, 64.0), (v, row, 32.0)] {
            let off = (coordinate - texel - 0.5f64).rem_euclid(side);
            let off = off.min(side - off) - 0.5;
            assert!(off <= 0.27 + shift, "{index}: {off} off at distance {t}");
        }
        equal += usize::from(u.floor().rem_euclid(64.0) == column && v.floor().rem_euclid(32.0) == row);
    }
    assert!(seen > 3000 && equal * 10 > seen * 8, "{equal} of {seen}");
}
