//! Depth-tested scenes: each pixel shows the nearest of the faces drawn alone, and each of those has the
//! depth of the plane through its snapped corners.

use super::input::Scene;
use super::{draw, sums_up};
use embedded_graphics_core::geometry::Point;
use pinhole::prelude::*;
use pinhole::raster::ScreenPoint;
use support::bridge::draw::Shader;
use support::oracle::coverage::edge;

/// The faces' pixels and depths: (x, y), which face, how deep.
fn drawn(scene: &Scene, faces: &[[u16; 3]]) -> Vec<((i32, i32), u16, u16)> {
    let Some(bounds) = scene.rectangle() else { return Vec::new() };
    let mut storage = vec![0; (bounds.size.width * bounds.size.height) as usize];
    let mut depth = DepthBuffer::new(bounds, &mut storage).expect("storage for all pixels");
    let drawing = scene.with_instance(faces, &[], |instance| {
        let mut cache = vec![ScreenVertex::EMPTY; scene.cache];
        draw(scene, |target| {
            instance
                .faces(|face| Shader(face as u16))
                .cached(&mut cache)
                .draw(&mut target.depth_tested(&mut depth))
        })
    });
    sums_up(drawing.statistics, faces.len());
    let seen: Vec<_> = drawing
        .target
        .pixels
        .iter()
        .map(|(&(x, y), &(Shader(face), _))| {
            let held = depth.at(Point::new(x, y)).expect("inside");
            assert!(held < DepthBuffer::NOTHING, "({x}, {y}): {scene:?}");
            ((x, y), face, held)
        })
        .collect();
    let held = depth.values().iter().filter(|&&d| d < DepthBuffer::NOTHING).count();
    assert_eq!(held, seen.len(), "depths where nothing was drawn: {scene:?}");
    seen
}

pub(crate) fn check(scene: &Scene) {
    let together = drawn(scene, &scene.faces);
    let mut nearest = std::collections::BTreeMap::new();
    for (index, face) in scene.faces.iter().enumerate() {
        let alone = drawn(scene, &[*face]);
        plane(scene, *face, &alone);
        for (at, _, depth) in alone {
            let best = nearest.entry(at).or_insert((index as u16, depth));
            if depth < best.1 {
                *best = (index as u16, depth);
            }
        }
    }
    let nearest: Vec<_> = nearest.into_iter().map(|(at, (face, depth))| (at, face, depth)).collect();
    assert_eq!(together, nearest, "{scene:?}");
}

/// Whole faces that end before the far plane, against the plane in rationals.
fn plane(scene: &Scene, face: [u16; 3], pixels: &[((i32, i32), u16, u16)]) {
    let corners = scene.with_instance(&[face], &[], |instance| {
        face.map(|i| instance.project(i.into()).ok().zip(instance.project_unsnapped(i.into())))
    });
    let [Some(a), Some(b), Some(c)] = corners else { return };
    let place = |p: ScreenPoint| (i64::from(p.x()), i64::from(p.y()));
    let [a, b, c] = [a, b, c].map(|(pinhole::camera::Projected { point: p, .. }, fine)| (place(p), fine[2]));
    if [a, b, c].iter().any(|corner| corner.1 >> 32 >= 65_534) {
        return;
    }
    let along = |pick: fn(&((i64, i64), i64)) -> i64| {
        let all = [a, b, c].map(|corner| pick(&corner));
        all.iter().max().unwrap() - all.iter().min().unwrap()
    };
    // Beyond 512 pixels, ½ and 2⁻¹⁷ for every column and row of the viewport; the hundredth is for the corners' depths, which
    // are not rounded here.
    let (_, _, width, height) = scene.camera.viewport;
    let large = 0.51 + f64::from(width + height) / f64::from(1 << 17);
    let bound = if along(|p| p.0 .0).max(along(|p| p.0 .1)) < 1 << 17 { 0.54 } else { large };
    for &((x, y), _, depth) in pixels {
        let at = (256 * i64::from(x) + 128, 256 * i64::from(y) + 128);
        let weights = [edge(b.0, c.0, at), edge(c.0, a.0, at), edge(a.0, b.0, at)].map(i128::from);
        let area: i128 = weights.iter().sum();
        let sum: i128 = weights.iter().zip([a.1, b.1, c.1]).map(|(w, z)| w * i128::from(z)).sum();
        let error = (i128::from(depth) * (area << 32) - sum) as f64 / (area << 32) as f64;
        assert!(error.abs() <= bound, "({x}, {y}) is off by {error}: {scene:?}");
    }
}
