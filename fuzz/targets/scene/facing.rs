//! Culling by face planes, for meshes that have them, against culling by area.

use super::cut::before_rounding;
use super::input::Scene;
use super::{draw, sums_up, Drawing};
use pinhole::prelude::*;
use std::cell::RefCell;
use support::bridge::draw::Shader;
use support::solids::Solid;

/// Drawn with and without, and the faces that each drew.
fn both(scene: &Scene, instance: &MeshInstance<'_>) -> [(Drawing, Vec<usize>); 2] {
    [false, true].map(|by_planes| {
        let faces = RefCell::new(Vec::new());
        let shade = |face| {
            faces.borrow_mut().push(face);
            Shader(face as u16)
        };
        let mut cache = vec![ScreenVertex::EMPTY; scene.cache];
        let drawing = draw(scene, |target| match by_planes {
            true => instance.faces(shade).culled_by_planes().cached(&mut cache).draw(target),
            false => instance.faces(shade).cached(&mut cache).draw(target),
        });
        sums_up(drawing.statistics, instance.mesh().faces().len());
        (drawing, faces.into_inner())
    })
}

/// Whether a face is a front face before its corners are rounded to sub-pixels, by more than the error of screen positions can
/// make of an edge-on face. `None` if a corner has no screen position, or numbers leave their range.
fn is_front(scene: &Scene, instance: &MeshInstance<'_>, face: [u16; 3]) -> Option<bool> {
    let (error, _) = before_rounding(scene, face)?;
    let place = |index: u16| {
        let place = instance.project_unsnapped(index.into())?;
        place[..2].iter().all(|c| c.unsigned_abs() < 1 << 44).then(|| place.map(i128::from))
    };
    let [a, b, c] = face.map(place);
    let (a, b, c) = (a?, b?, c?);
    let [x1, y1, x2, y2] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
    // As thick as that and 2⁻¹⁶ pixel, in 2⁻³².
    let thick = (error * 2f64.powi(32)) as i128 + (1 << 16);
    let long = [x1, y1, x2, y2].map(i128::abs).into_iter().max()?;
    Some(x2 * y1 - x1 * y2 > long * thick)
}

pub(crate) fn check(scene: &Scene) {
    let camera = scene.camera.library().with_far_clip(scene.far_clip);
    let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).expect("a mesh");
    let instance = camera.place(&mesh, &scene.model.library()).with_cull(scene.cull);
    let [(plain, _), (by_planes, _)] = both(scene, &instance);
    assert_eq!(by_planes.statistics, plain.statistics, "without planes: {scene:?}");
    assert!(by_planes.target.calls == plain.target.calls, "without planes: {scene:?}");
    // Of a face without area none.
    let normals = Solid::new(scene.vertices.clone(), scene.exponent, scene.faces.clone()).normals();
    let mesh = mesh.with_normals(&normals).expect("one for each face");
    let planes: Vec<i16> = (0..normals.len()).map(|face| mesh.face_plane(face)).collect();
    let mesh = mesh.with_planes(&planes).expect("one for each face");
    let instance = camera.place(&mesh, &scene.model.library()).with_cull(scene.cull);
    let [(_, plain), (_, by_planes)] = both(scene, &instance);
    for &face in plain.iter().filter(|face| !by_planes.contains(face)) {
        // Cut faces, and faces that reach so far out that screen positions saturate, have no area to compare.
        assert_ne!(
            is_front(scene, &instance, scene.faces[face]),
            Some(true),
            "face {face} is left out: {scene:?}"
        );
    }
    assert!(by_planes.iter().all(|face| plain.contains(face)), "{scene:?}");
}
