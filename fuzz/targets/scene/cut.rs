//! Cut faces against one f64 ray per pixel, which needs no clipping.

use super::draw;
use super::input::Scene;
use crate::fuzzed::set_up::views::sine;
use pinhole::draw::Cull;
use support::bridge::draw::Shader;
use support::oracle::chain::{self, length, mul4, V3, V4};
use support::oracle::eye;

/// How far off, in px, a pixel's answer may come from: the budget of a vertex (ARCHITECTURE.md, "Numbers") and a
/// cut's own rounding to 1/256 px, at the corner where it is largest; and how far off, in z/w, near and far may
/// cut. None where the numbers leave their range.
fn tolerance(scene: &Scene, face: [u16; 3]) -> Option<(f64, f64)> {
    let (px, depth) = before_rounding(scene, face)?;
    // And another 1/256 px for the cut corners' own snap.
    Some((2.0 / 256.0 + px, depth))
}

/// Bounds of the error in px and of depth for a clipped face, before vertices are rounded to 1/256 px.
pub(crate) fn before_rounding(scene: &Scene, face: [u16; 3]) -> Option<(f64, f64)> {
    let (exact, model) = (scene.camera.exact(), scene.model.exact());
    let largest = scene.vertices.iter().flatten().fold(1.0f64, |m, &c| m.max(f64::from(c).abs()));
    let stretch = (0..3).map(|j| length(core::array::from_fn(|i| model.m[i][j]))).fold(0.0, f64::max);
    let extent = largest * f64::from(scene.exponent).exp2() * stretch;
    let at: [V3; 3] = face.map(|i| exact.view.apply_placed(&model, scene.model_point(i)));
    let reach = extent + at.iter().map(|&p| length(p)).fold(0.0, f64::max) + 1.0 / 16.0;
    let m = exact.projection;
    let rho: V4 = m.map(|[a, b, c, d]| (a.abs() + b.abs() + c.abs()) * reach + d.abs() + 1.0 / 16.0);
    let v = exact.viewport;
    let free = 8192.0 - (v.x + v.width / 2.0).abs().max((v.y + v.height / 2.0).abs());
    if extent > 32_767.0 || free < 64.0 || rho.iter().any(|r| *r > 2f64.powi(28)) {
        return None;
    }
    // The nearest that anything of the face is seen: the least w beyond near.
    let near = scene.camera.projection.near();
    let clips = at.map(|p| mul4(&m, [p[0], p[1], p[2], 1.0]));
    let least = clips.iter().map(|c| c[3]).fold(f64::INFINITY, f64::min);
    let least = if m[3][3] == 1.0 { 1.0 } else { least.max(near) };
    let share = |i: usize, size: f64| size / 2.0 * rho[i] / least;
    let budget = share(0, v.width).max(share(1, v.height)) + 8192.0 * 8192.0 / free * rho[3] / least;
    // The 12 is for VUP well off VPN: the roll's error grows as 1/sine.
    let factor = 12.0 + (1.0 / sine(scene.camera.view) - 4.0).max(0.0);
    // A new vertex also moves along its edge by 2⁻³¹ of the edge, and its plane moves by the rounding of d and w: twice the
    // budget.
    let px = 2.0 * factor * 2f64.powi(-30) * budget;
    // d and w are rounded to a few 2⁻³⁰ of their own reach, or of x's and y's over what is free.
    let depth = 2f64.powi(-26) * ((rho[2] + rho[3]) / least + 2.0 * budget / free);
    Some((px, depth))
}

pub(crate) fn face(scene: &Scene, face: [u16; 3]) {
    let Some((tolerance, depth)) = tolerance(scene, face) else { return };
    if !(tolerance < 0.25 && depth < 0.01 && sine(scene.camera.view) > 0.02) {
        return;
    }
    let cut = scene.with_instance(&[face], &[], |instance| {
        let whole = face.iter().all(|&i| instance.project(i.into()).is_ok());
        (!whole).then(|| draw(scene, |target| instance.faces(|_| Shader(1)).draw(target)))
    });
    let Some(drawing) = cut else { return };
    let [a, b, c] = face;
    let turned = [[b, c, a], [c, a, b]].map(|turned| {
        scene.with_instance(&[turned], &[], |instance| {
            draw(scene, |target| instance.faces(|_| Shader(1)).draw(target))
        })
    });
    for turned in &turned {
        assert_eq!(turned.statistics, drawing.statistics, "{face:?} of {scene:?}");
    }
    let points: Vec<V3> = (0..scene.vertices.len() as u16).map(|i| scene.model_point(i)).collect();
    let (exact, model) = (scene.camera.exact(), scene.model.exact());
    // The oracle sees no pixels of an edge-on face, but cut corners are rounded. Below 2⁻⁴⁰ of its terms the determinant, and its
    // sign, are mostly rounding errors of f64.
    let [a_, b_, c_] = face.map(|i| exact.homogeneous_screen(exact.clip(&model, scene.model_point(i))));
    let determinant = chain::dot(a_, chain::cross(b_, c_));
    if determinant.abs() <= 2f64.powi(-40) * length(a_) * length(b_) * length(c_) {
        return;
    }
    // The oracle sees front faces; the other side is the front of the face turned over.
    let sides: &[[u16; 3]] = if scene.cull == Cull::None { &[face, [a, c, b]] } else { &[face] };
    // With near and far where they are, and a little off: that is z ± depth·w.
    let moved = [0.0, depth, -depth].map(|depth| {
        let mut camera = exact;
        for k in 0..4 {
            camera.projection[2][k] += depth * exact.projection[3][k];
        }
        camera
    });
    let seen = moved.map(|camera| {
        sides.iter().map(|side| eye::faces(&camera, &model, &points, &[*side])).collect::<Vec<_>>()
    });
    let (mut is_sliver, mut is_folded) = (true, false);
    for (x, y) in scene.area().pixels() {
        let count = drawing.target.count(x as i32, y as i32);
        is_folded |= count > 1;
        let answers = seen.each_ref().map(|sides| {
            let each = sides.iter().map(|faces| eye::pixel(faces, (x, y), scene.far_clip, tolerance));
            each.collect::<Result<Vec<_>, ()>>().map(|found| found.iter().any(Option::is_some))
        });
        let Ok(wanted) = answers[0] else { continue };
        if answers != [Ok(wanted); 3] {
            continue;
        }
        is_sliver &= !wanted;
        for count in
            [count].into_iter().chain(turned.iter().map(|turned| turned.target.count(x as i32, y as i32)))
        {
            assert_eq!(
                count > 0,
                wanted,
                "({x}, {y}) within {tolerance} px: {face:?} of {scene:?} {:?}",
                drawing.statistics
            );
        }
    }
    // Each pixel once, and the same from every corner (R7), but for slivers, of which no pixel is certain: rounding may fold their fan.
    let is_equal = turned.iter().all(|turned| turned.target.pixels == drawing.target.pixels);
    assert!(is_sliver || is_equal && !is_folded, "{face:?} of {scene:?}");
}
