//! Smoothed edges, against 16 × 16 samples of each pixel by an oracle that interpolates in f64.

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb888;
use pinhole::{bands::SmoothFrame, prelude::*};
use support::bridge;
use support::smooth_scenes::{camera, grey, reference, scenes, Scene, BACKGROUND};

/// The scene in bands, each in a strip of this many rows.
fn in_bands(scene: &Scene, instance: &MeshInstance<'_>, [width, height]: [u32; 2], rows: u32) -> Vec<Rgb888> {
    let (area, mesh) = (bridge::rectangle(0, 0, width, height), instance.mesh());
    let (mut cache, mut bins) = (vec![ScreenVertex::EMPTY; mesh.cache_len()], vec![0; mesh.face_bins_len()]);
    let (mut edge_bins, colors) = (vec![0; mesh.smooth_bins_len()], scene.levels().0);
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut bins).expect("room");
    let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins).expect("room");
    let storage =
        |rows: u32| (vec![0; Frame::<Rgb888>::strip_bytes(width, rows)], vec![0; (width * rows) as usize]);
    let ((mut strip, mut depths), (mut kept, mut kept_depths)) = (storage(rows), storage(2));
    let mut frame = SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut kept_depths).expect("room");
    let mut picture = Vec::new();
    while let Some(mut band) = frame.next_band(&mut strip, &mut depths).expect("room") {
        let (mut pixels, mut depth) = band.new_rows();
        let Ok(()) = faces.draw(|face| grey(colors[face]), &mut pixels.depth_tested(&mut depth));
        let band = band.smooth(|pass| edges.draw(pass));
        assert_eq!((band.area().top_left.y as usize) * width as usize, picture.len());
        picture.extend(band.colors());
    }
    picture
}

#[test]
fn bands_are_smoothed_as_one_piece() {
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let beside = scene.solid.edge_faces();
        let mesh = scene.mesh(&beside);
        for size in [[128, 64], [61, 77]] {
            let (camera, model) = (camera(size[0], size[1]).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let [plain, whole] = [None, Some(true)].map(|creases| scene.picture(&instance, size, creases));
            assert_ne!(plain, whole);
            for rows in [3, 4, 5, 8, 9, 32, 100] {
                assert!(in_bands(&scene, &instance, size, rows) == whole, "{} {size:?} {rows}", scene.name);
            }
        }
    }
}

/// Edges that are drawn in the pass over odd rows alone smooth no other pixels than those of the picture's odd rows.
#[test]
fn one_pass_smooths_its_rows() {
    let scene = &scenes()[1];
    let (beside, [width, height]) = (scene.solid.edge_faces(), [128, 64]);
    let (mesh, camera, model) = (scene.mesh(&beside), camera(width, height).library(), scene.model.library());
    let instance = camera.place(&mesh, &model);
    let plain = scene.picture(&instance, [width, height], None);
    let (mut cache, mut bins) =
        (vec![ScreenVertex::EMPTY; mesh.cache_len()], vec![0; mesh.smooth_bins_len()]);
    let (mut cells, mut depths) = (plain.clone(), vec![0; plain.len()]);
    let mut depth = DepthBuffer::new(bridge::rectangle(0, 0, width, height), &mut depths).expect("room");
    instance.depth_only(&mut cache, &mut depth);
    let transformed = instance.transform_depth(&mut cache);
    for only in [0, 1] {
        cells.copy_from_slice(&plain);
        let mut picture = Picture::new(&mut cells, Size::new(width, height)).expect("room");
        let (mut edges, mut pass_number) =
            (transformed.bin_smooth_edges(|_| true, &mut bins).expect("room"), 0);
        picture.pixels().depth_tested(&mut depth).smooth(|pass| {
            if pass_number == only {
                edges.draw(pass);
            }
            pass_number += 1;
        });
        let changed = |at: &usize| cells[*at] != plain[*at];
        assert!((0..cells.len()).filter(changed).count() > 100);
        assert!((0..cells.len()).filter(changed).all(|at| at / width as usize % 2 == only));
    }
}

#[test]
fn smoothed_edges_are_close_to_their_areas() {
    for scene in scenes() {
        let beside = scene.solid.edge_faces();
        let mesh = scene.mesh(&beside);
        for (width, height) in [(240, 240), (128, 64)] {
            let (camera, model) = (camera(width, height).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let reference = reference(&scene, &instance, [width, height]);
            let [plain, smooth] = [None, Some(!scene.is_smooth)]
                .map(|creases| scene.picture(&instance, [width, height], creases));
            let (rms, far, worse) = reference.errors(&smooth, &plain);
            let rms = [reference.errors(&plain, &plain).0, rms];
            println!("{} {width} × {height}: {rms:.1?}, {far:.1} % off by 20, {worse} worse", scene.name);
            // Levels; per cent of the edge pixels; pixels.
            let [most, most_far, most_worse] =
                if height == 240 { [5.5, 1.5, 60.0] } else { [10.0, 5.0, 100.0] };
            assert!(rms[1] < most && 2.0 * rms[1] < rms[0] && far < most_far && worse as f64 <= most_worse);
        }
    }
}
