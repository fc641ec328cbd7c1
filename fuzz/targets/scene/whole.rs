//! A face or edge that is not clipped draws exactly the coverage, or the line, of its projected vertices.

use super::draw;
use super::input::Scene;
use pinhole::draw::{Cull, MeshInstance};
use pinhole::raster::ScreenPoint;
use std::collections::BTreeMap;
use support::bridge::draw::Shader;
use support::oracle::coverage::{self, P};
use support::oracle::line;
use support::oracle::target::Recorder;

fn sub_pixels(p: ScreenPoint) -> P {
    (p.x().into(), p.y().into())
}

fn pixel(p: ScreenPoint) -> P {
    let (x, y) = sub_pixels(p);
    (x.div_euclid(256), y.div_euclid(256))
}

fn drawn(target: &Recorder<Shader>) -> Vec<(P, u32)> {
    target.pixels.iter().map(|(&(x, y), &(_, n))| ((i64::from(x), i64::from(y)), n)).collect()
}

/// Once each, in the recorder's order.
fn once(mut pixels: Vec<P>) -> Vec<(P, u32)> {
    pixels.sort_unstable();
    pixels.into_iter().map(|p| (p, 1)).collect()
}

pub(crate) fn face(scene: &Scene, face: [u16; 3]) {
    scene.with_instance(&[face], &[], |instance| {
        let [Ok(a), Ok(b), Ok(c)] = face.map(|i| instance.project(i.into()).map(|seen| seen.point)) else {
            return;
        };
        let t = [a, b, c].map(sub_pixels);
        let drawing = draw(scene, |target| instance.faces(|_| Shader(1)).draw(target));
        let s = drawing.statistics;
        // Front is counter-clockwise with y up: the edge function is negative with y down.
        let area = coverage::edge(t[0], t[1], t[2]);
        let visible = area < 0 || (area > 0 && scene.cull == Cull::None);
        let wanted = match (area == 0, visible) {
            (true, _) => (0, 0, 1),
            (_, true) => (1, 0, 0),
            _ => (0, 1, 0),
        };
        assert_eq!((s.drawn, s.culled, s.degenerate), wanted, "{t:?}: {scene:?}");
        assert_eq!((s.clipped, s.outside), (0, 0), "{t:?}: {scene:?}");
        let pixels = scene.area().pixels().filter(|&(x, y)| visible && coverage::covers(t, x, y)).collect();
        assert_eq!(drawn(&drawing.target), once(pixels), "{t:?}: {scene:?}");
    });
}

pub(crate) fn edge(scene: &Scene, edge: [u16; 2]) {
    scene.with_instance(&[], &[edge], |instance| {
        let drawing = draw(scene, |target| instance.edges(|_| Shader(1)).draw(target));
        let turned = scene.with_instance(&[], &[[edge[1], edge[0]]], |instance| {
            draw(scene, |target| instance.edges(|_| Shader(1)).draw(target))
        });
        // L3, cut or not.
        assert_eq!(turned.statistics, drawing.statistics, "{edge:?}: {scene:?}");
        assert_eq!(drawn(&turned.target), drawn(&drawing.target), "{edge:?}: {scene:?}");
        let [Ok(a), Ok(b)] = edge.map(|i| instance.project(i.into()).map(|seen| seen.point)) else { return };
        assert_eq!((drawing.statistics.drawn, drawing.statistics.clipped), (1, 0), "{edge:?}: {scene:?}");
        let wanted = once(line::clipped(pixel(a), pixel(b), scene.area()));
        assert_eq!(drawn(&drawing.target), wanted, "{a:?} {b:?}: {scene:?}");
    });
}

pub(crate) fn points(scene: &Scene, instance: &MeshInstance<'_>, target: &Recorder<Shader>) {
    let mut wanted = BTreeMap::new();
    for i in 0..scene.vertices.len() {
        if let Ok(seen) = instance.project(i) {
            let (x, y) = pixel(seen.point);
            if scene.area().contains(x, y) {
                *wanted.entry((x, y)).or_insert(0) += 1;
            }
        }
    }
    assert_eq!(drawn(target), wanted.into_iter().collect::<Vec<_>>(), "{scene:?}");
}
