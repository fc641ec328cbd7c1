//! The named projections of `pinhole-measure render`, by their definitions: extents, and sides that are seen.

use crate::harness::{Folder, RENDER};
use pinhole_apps_support::bodies::{cuboid, obj};
use pinhole_apps_support::testing::extent;
use std::collections::BTreeSet;

/// The triangles seen in a picture of 200 × 200 of a cube.
fn cube_ids(projection: &str) -> Vec<i32> {
    let to = Folder::new(projection);
    to.write("cube.obj", obj(&cuboid([1.0; 3])));
    let fixed = ["cube.obj", "--frame", "outline", "--ids", "ids", "--size", "200x200", "--projection"];
    let done = RENDER.run_in(&to.0, &[&fixed[..], &[projection]].concat());
    assert!(done.status.success(), "{done:?}");
    to.read("ids").as_chunks().0.iter().map(|bytes| i32::from_le_bytes(*bytes)).collect()
}

#[test]
fn parallel_projections_have_the_extents_of_their_definitions() {
    // Of a unit cube, for a view plane normal n: right u = y × n, up v = n × u, and its sides are seen as long as the
    // sums of their components.
    let along = |[x, y, z]: [f64; 3]| {
        let (n, h) = ((x * x + y * y + z * z).sqrt(), x.hypot(z));
        let u = [z / h, 0.0, -x / h];
        let v = [-y * x / (h * n), h / n, -y * z / (h * n)];
        [u, v].map(|axis| axis.iter().map(|c| c.abs()).sum::<f64>())
    };
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let root = 0.5f64.sqrt();
    for (name, [width, height]) in [
        ("front", [1.0, 1.0]),
        ("back", [1.0, 1.0]),
        ("left", [1.0, 1.0]),
        ("right", [1.0, 1.0]),
        ("top", [1.0, 1.0]),
        ("bottom", [1.0, 1.0]),
        ("isometric", along([1.0, 1.0, 1.0])),
        ("dimetric", along([2.0, 1.0, 2.0])),
        ("trimetric", along([1.0, 2.0, 3.0])),
        // What recedes is drawn at 45 or 60 degrees, 1, 1/2 or 3/4 times as long.
        ("cavalier", [1.0 + root, 1.0 + root]),
        ("cabinet", [1.0 + root / 2.0, 1.0 + root / 2.0]),
        ("oblique", [1.0 + 0.75 * sin, 1.0 + 0.75 * cos]),
        // The plan turned by 30 degrees, and the height above it.
        ("military", [cos + sin, cos + sin + 1.0]),
    ] {
        let ids = cube_ids(name);
        let drawn: Vec<_> = ids.iter().map(|id| *id >= 0).collect();
        let [[left, right], [top, bottom]] = extent(&drawn, 200);
        // The larger one fills 184 of the 200 pixels; rounding to pixels moves each figure by at most one.
        let scale = 184.0 / width.max(height);
        let near = |pixels: usize, extent: f64| (pixels as f64 - extent * scale).abs() < 1.5;
        assert!(
            near(right - left, width) && near(bottom - top, height),
            "{name}: {left} {right} {top} {bottom}"
        );
    }
}

#[test]
fn sides_that_are_seen_are_those_of_the_name() {
    // Sides by triangle: front, back, right, left, top, bottom.
    let seen = |name| {
        let sides: BTreeSet<_> = cube_ids(name).into_iter().filter(|id| *id >= 0).map(|id| id / 2).collect();
        sides.into_iter().collect::<Vec<_>>()
    };
    for (name, sides) in [
        ("front", &[0][..]),
        ("back", &[1]),
        ("right", &[2]),
        ("left", &[3]),
        ("top", &[4]),
        ("bottom", &[5]),
        ("isometric", &[0, 2, 4]),
        ("cavalier", &[0, 2, 4]),
        ("military", &[0, 2, 4]),
        ("perspective", &[0, 2, 4]),
        ("one-point", &[0, 2, 4]),
        ("three-point", &[0, 2, 4]),
        // Sides that recede are larger than the front, and turned to the eye: all five.
        ("reverse", &[0, 2, 3, 4, 5]),
    ] {
        assert_eq!(seen(name), sides, "{name}");
    }
}

#[test]
fn uprights_and_fronts_stay_so_where_the_name_says_it() {
    let side = |name: &str, side: i32| {
        let ids = cube_ids(name);
        ids.iter().map(|id| id / 2 == side && *id >= 0).collect::<Vec<_>>()
    };
    // One-point: the front is a square, all of it.
    let front = side("one-point", 0);
    let [[left, right], [top, bottom]] = extent(&front, 200);
    assert!((right - left).abs_diff(bottom - top) <= 1);
    assert_eq!(front.iter().filter(|seen| **seen).count(), (right - left) * (bottom - top));
    // Two-point: the front's left edge is upright, and longer than what is above or below it of the front: many rows
    // begin in one column. In a three-point perspective it leans.
    let upright = |name: &str| {
        let front = side(name, 0);
        let firsts: Vec<_> = front.chunks(200).filter_map(|row| row.iter().position(|seen| *seen)).collect();
        let longest = firsts.chunk_by(|a, b| a == b).map(<[_]>::len).max().unwrap();
        longest as f64 / firsts.len() as f64
    };
    assert!(upright("two-point") > 0.4 && upright("off-axis") > 0.4, "{}", upright("two-point"));
    assert!(upright("three-point") < 0.2, "{}", upright("three-point"));
}
