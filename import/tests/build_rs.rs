//! The example with a build script, from its STL file to its picture: what each pixel shows is worked out here by a ray
//! through its centre.

use std::path::Path;
use std::process::Command;

/// Half the sides of the block, 40 × 20 × 10 mm with z upwards, made 2 long and turned to y upwards.
const HALF: [f64; 3] = [1.0, 0.25, 0.5];
const EYE: [f64; 3] = [3.0, 2.0, 4.0];

#[test]
fn a_build_script_brings_a_model_to_the_screen() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/build-rs");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["run", "--quiet", "--locked"]).current_dir(folder);
    cargo.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("build-rs"));
    let done = cargo.output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success() && said.is_empty(), "builds without a warning: {said}");
    let picture = String::from_utf8(done.stdout).unwrap();
    let rows: Vec<&[u8]> = picture.lines().map(str::as_bytes).collect();
    assert!(rows.len() == 64 && rows.iter().all(|row| row.len() == 64), "{picture}");

    let (mut judged, mut by_side) = (0, [0; 4]);
    for (y, row) in rows.iter().enumerate() {
        for (x, &pixel) in row.iter().enumerate() {
            // The picture is right within 1/256 pixel; near an outline the centre may fall on either side.
            let seen = |dx: f64, dy: f64| side_seen(x as f64 + 0.5 + dx, y as f64 + 0.5 + dy);
            let side = seen(0.0, 0.0);
            if [seen(-0.01, 0.0), seen(0.01, 0.0), seen(0.0, -0.01), seen(0.0, 0.01)]
                .iter()
                .any(|s| *s != side)
            {
                continue;
            }
            assert_eq!(char::from(pixel), side.map_or(' ', shade), "{x}, {y}:\n{picture}");
            judged += 1;
            by_side[side.unwrap_or(3)] += 1;
        }
    }
    // Outlines of about 240 pixels in all, 1 in 25 of which lies that near.
    assert!(judged > 64 * 64 - 40, "{judged}");
    assert!(by_side.iter().all(|&pixels| pixels > 100), "right, top, front, nothing: {by_side:?}");
}

/// The axis of the side that is seen at a point of the 64 × 64 screen, where 26° stand for 64 rows.
fn side_seen(x: f64, y: f64) -> Option<usize> {
    let unit = |v: [f64; 3]| v.map(|c| c / v.iter().map(|c| c * c).sum::<f64>().sqrt());
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let ahead = unit(EYE.map(|c| -c));
    let right = unit(cross(ahead, [0.0, 1.0, 0.0]));
    let up = cross(right, ahead);
    let scale = 13f64.to_radians().tan() / 32.0;
    let ray = [0, 1, 2].map(|i| ahead[i] + scale * ((x - 32.0) * right[i] + (32.0 - y) * up[i]));
    // All three sides that may be seen are those of +x, +y and +z: where does the ray come through each?
    (0..3).find(|&axis| {
        let t = (HALF[axis] - EYE[axis]) / ray[axis];
        t > 0.0 && (0..3).all(|i| i == axis || (EYE[i] + t * ray[i]).abs() <= HALF[i])
    })
}

/// Ambient 40 of 256, the rest by Lambert's law with the light from (2, 4, 1), on a scale of ten characters.
fn shade(axis: usize) -> char {
    let cosine = [2.0, 4.0, 1.0][axis] / 21f64.sqrt();
    let luma = (40.0 + 216.0 * cosine) * 255.0 / 256.0;
    // The library may be a level off: none of the three is that near to another character.
    assert_eq!((luma + 2.0) as usize / 26, (luma - 2.0) as usize / 26);
    char::from(b" .:-=+*#%@"[luma as usize / 26])
}
