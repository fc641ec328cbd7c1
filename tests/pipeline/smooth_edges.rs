//! Smoothed edges, against 16 × 16 samples of each pixel by an oracle that interpolates in f64.

use core::fmt::Debug;
use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr888, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb565, Rgb666, Rgb888, RgbColor,
};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use pinhole::camera::Window;
use pinhole::color::{Color, Format, StoredPixel};
use pinhole::meshes::CUBE;
use pinhole::{
    bands::{DirtyRegions, SmoothBand, SmoothFrame, TransferCost},
    draw::{SmoothEdge, SmoothEdges},
    prelude::*,
    target::{BufferError, Pixels},
    Angle,
};
use support::bridge::{
    self,
    pair::{CameraBits, ModelBits, Step},
};
use support::oracle::{chain, rng::Rng};
use support::smooth_scenes::{camera, grey, reference, scenes, Reference, Scene, BACKGROUND, NO_CREASES};

/// Draws parts of the screen one after the other, each in bands of a strip of this many rows and `beyond` pixels larger on each side than
/// what is sent. `parts` gets the bounds of what is drawn.
fn send(
    scene: &Scene,
    instance: &MeshInstance<'_>,
    parts: impl FnOnce(Rectangle) -> Vec<Rectangle>,
    (rows, beyond): (u32, i32),
    display: &mut Picture<'_, Rgb888>,
) {
    let mesh = instance.mesh();
    let (mut cache, mut bins) =
        (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.face_bins_len()]);
    let (mut edge_bins, colors) = (vec![0; mesh.smooth_bins_len()], scene.levels().0);
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut bins).expect("room");
    let mut list = vec![SmoothEdge::EMPTY; rows as usize % 16];
    let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins).expect("room");
    edges.keep_in(&mut list);
    for part in parts(edges.bounds(faces.bounds())) {
        send_part(&mut faces, &mut edges, &colors, (part, rows, beyond), display);
    }
}

/// Draws a part of the screen.
fn send_part(
    faces: &mut BinnedFaces<'_>,
    edges: &mut SmoothEdges<'_>,
    colors: &[u8],
    (part, rows, beyond): (Rectangle, u32, i32),
    display: &mut Picture<'_, Rgb888>,
) {
    let area = part.offset(beyond);
    let storage = |rows: u32| vec![0; SmoothFrame::<Rgb888>::strip_bytes(area.size.width, rows)];
    let (mut strip, mut kept) = (storage(rows), storage(2));
    let mut depths = vec![0; (area.size.width * rows) as usize];
    let mut frame = SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut depths).expect("room");
    while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
        let (mut pixels, mut depth) = band.new_rows();
        let Ok(()) = faces.draw(|face| grey(colors[face]), &mut pixels.depth_tested(&mut depth));
        let band = band.smooth(|pass| edges.draw(pass));
        let Ok(()) = band.send(&mut display.clipped(&part));
    }
}

#[test]
fn bands_are_smoothed_as_one_piece() {
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let mesh = scene.mesh();
        for size in [[128, 64], [61, 77]] {
            let (camera, model) = (camera(size[0], size[1]).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let [plain, whole] = [None, Some(0)].map(|contrast| scene.picture(&instance, size, contrast));
            assert_ne!(plain, whole);
            let area = bridge::rectangle(0, 0, size[0], size[1]);
            for rows in [6, 7, 8, 9, 10, 32, 100] {
                // The second frame begins again with all edges.
                for frames in [1, 2] {
                    let mut cells = vec![Rgb888::RED; whole.len()];
                    let mut display = Picture::new(&mut cells, area.size).expect("room");
                    send(&scene, &instance, |_| vec![area; frames], (rows, 0), &mut display);
                    assert!(cells == whole, "{} {size:?} {rows}", scene.name);
                }
            }
        }
    }
}

/// The scene turned `step` times.
fn turned(step: u32) -> ModelBits {
    ModelBits(vec![Step::Y(step * 99_999_999), Step::X(step * 77_777_777)])
}

/// As the documentation of `SmoothFrame` says: each part is drawn three pixels larger on each side than it is sent.
#[test]
fn parts_of_the_screen_are_smoothed_as_one_piece() {
    let (size, area) = ([128, 64], bridge::rectangle(0, 0, 128, 64));
    let mut wrong = 0;
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let mesh = scene.mesh();
        for step in 0..9 {
            let (camera, model) = (camera(128, 64).library(), turned(step).library());
            let instance = camera.place(&mesh, &model);
            let whole = scene.picture(&instance, size, Some(0));
            let drawn = |beyond| {
                let mut cells = vec![Rgb888::RED; whole.len()];
                let mut display = Picture::new(&mut cells, area.size).expect("room");
                let parts = (0..16).map(|i| bridge::rectangle(i % 4 * 32, i / 4 * 16, 32, 16)).collect();
                send(&scene, &instance, |_| parts, (8, beyond), &mut display);
                cells
            };
            assert!(drawn(3) == whole, "{} {step}", scene.name);
            wrong += usize::from(drawn(0) != whole);
        }
    }
    assert!(wrong > 30);
}

/// As the documentation of `SmoothFrame` says: each core finds the edges, and smooths half of the screen.
#[test]
fn two_cores_smooth_halves_of_the_screen() {
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let (mesh, camera) = (scene.mesh(), camera(128, 64).library());
        let colors = &scene.levels().0;
        for step in 0..5 {
            let model = turned(step).library();
            let instance = camera.place(&mesh, &model);
            let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
            let (mut bins, mut cursor) = (vec![0; mesh.face_bins_len()], vec![0; mesh.faces().len()]);
            let transformed = instance.transform_depth(&mut cache);
            let mut faces = transformed.bin_faces(&mut bins).expect("room");
            let whole = scene.picture(&instance, [128, 64], Some(0));
            let half = |mut faces: BinnedFaces<'_>, top: usize| {
                let (mut bins, mut cells) = (vec![0; mesh.smooth_bins_len()], vec![Rgb888::RED; whole.len()]);
                let mut edges = transformed.bin_smooth_edges(|_| true, &mut bins).expect("room");
                let mut display = Picture::new(&mut cells, Size::new(128, 64)).expect("room");
                let part = bridge::rectangle(0, top as i32, 128, 32);
                send_part(&mut faces, &mut edges, colors, (part, 8, 3), &mut display);
                let of_half = top * 128..(top + 32) * 128;
                assert!(cells[of_half.clone()] == whole[of_half], "{} {step}", scene.name);
            };
            let [one, other] = faces.fork(&mut cursor).expect("room");
            std::thread::scope(|scope| {
                scope.spawn(|| half(one, 0));
                half(other, 32);
            });
        }
    }
}

/// Bands by their numbers, in any order and again, of frames in and around the viewport that begin at any row.
#[test]
fn bands_by_number_are_smoothed_as_one_piece() {
    let mut rng = Rng::new(47);
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let (mesh, colors) = (scene.mesh(), scene.levels().0);
        for step in 0..24 {
            let [x, y] = [0; 2].map(|_| rng.int(-40, 9) as i32);
            let width = rng.int(12, 96) as u32; // in few pixels, edges follow each other in each row
            let camera = CameraBits { viewport: (x, y, width, width), ..camera(1, 1) }.library();
            let model = turned(step).library();
            let instance = camera.place(&mesh, &model);
            let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
            let (mut bins, mut edge_bins) = (vec![0; mesh.face_bins_len()], vec![0; mesh.smooth_bins_len()]);
            let transformed = instance.transform_depth(&mut cache);
            let mut faces = transformed.bin_faces(&mut bins).expect("room");
            let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins).expect("room");
            let height = [1, 2, 3, rng.int(4, 70) as u32][step as usize % 4];
            let top = y + rng.int(-9, width as i64 / 2) as i32;
            let area = bridge::rectangle(x, top, width, height);

            let (mut cells, mut depths) = (vec![grey(BACKGROUND); (width * 70) as usize], vec![0; 96 * 70]);
            let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
            let mut pixels = Pixels::<Rgb888>::new(&mut cells, area).expect("room");
            let mut target = pixels.depth_tested(&mut depth);
            let Ok(()) = faces.draw(|face| grey(colors[face]), &mut target);
            target.smooth(|pass| edges.draw(pass));

            // The rows of a strip, and those that a band sends if the frame begins at an even row, or an odd one.
            for (rows, sent) in
                [(7, [1, 1]), (8, [4, 2]), (9, [3, 3]), (10, [6, 4]), (19, [13, 13]), (90, [86, 84])]
            {
                let storage = |rows| vec![0; SmoothFrame::<Rgb888>::strip_bytes(width, rows)];
                let (mut strip, mut kept, mut depths) =
                    (storage(rows), storage(2), vec![0; (width * rows) as usize]);
                let mut frame =
                    SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut depths).expect("room");
                let sent = sent[top as usize & 1];
                let mut order: Vec<_> = (0..height.div_ceil(sent)).flat_map(|index| [index; 2]).collect();
                rng.shuffle(&mut order);
                frame.next_band(&mut strip).expect("room"); // whose last rows may wait
                let mut show = |mut band: SmoothBand<'_, '_, Rgb888>| {
                    let (mut pixels, mut depth) = band.new_rows();
                    let Ok(()) = faces.draw(|face| grey(colors[face]), &mut pixels.depth_tested(&mut depth));
                    let band = band.smooth(|pass| edges.draw(pass));
                    let first = (band.area().top_left.y - top) as u32;
                    let cells = cells[(first * width) as usize..].iter().copied();
                    let count = (width * band.area().size.height) as usize;
                    assert!(band.colors().eq(cells.take(count)), "{} {rows} {first}", scene.name);
                    band.area()
                };
                for index in order {
                    let band = frame.nth_band(index, &mut strip).expect("room").expect("a band");
                    let first = index * sent;
                    let height = sent.min(height - first);
                    assert_eq!(show(band), bridge::rectangle(x, top + first as i32, width, height));
                }
                assert!(frame.nth_band(height.div_ceil(sent), &mut strip).expect("room").is_none());
                assert!(frame.nth_band(u32::MAX, &mut strip).expect("room").is_none());
                let mut shown = 0;
                while let Some(band) = frame.next_band(&mut strip).expect("room") {
                    shown += show(band).size.height;
                }
                assert_eq!(shown, height);
            }
        }
    }
}

#[test]
fn dirty_regions_show_the_smoothed_edges_of_each_frame() {
    let sent = show_turned::<4>(&scenes()[0], 3);
    assert!(sent < 10 * 128 * 64 / 2, "{sent}");
}

/// As the documentation of `SmoothFrame` says: what contains the bounds of all edges is drawn as large as it is sent.
#[test]
fn a_part_around_all_edges_is_smoothed_as_one_piece() {
    let scenes: Vec<_> = scenes().into_iter().filter(|scene| !scene.is_smooth).collect();
    let sent: u32 = scenes.iter().map(|scene| show_turned::<1>(scene, 0)).sum();
    let whole = 10 * 128 * 64 * scenes.len() as u32;
    assert!(sent < whole - whole / 10, "{sent} of {whole}");
}

/// Sends what changes while a scene turns, in rectangles that are drawn `beyond` pixels larger on each side. Returns the number of pixels.
fn show_turned<const RECTANGLES: usize>(scene: &Scene, beyond: i32) -> u32 {
    let area = bridge::rectangle(0, 0, 128, 64);
    let (mesh, camera) = (scene.mesh(), camera(128, 64).library());
    let mut dirty = DirtyRegions::<RECTANGLES>::new(area, TransferCost::new(24, TransferCost::MIPI_DCS));
    let (mut cells, mut sent) = (vec![Rgb888::RED; 128 * 64], 0);
    for step in 0..10 {
        let model = turned(step).library();
        let instance = camera.place(&mesh, &model);
        let mut display = Picture::new(&mut cells, area.size).expect("room");
        let parts = |bounds| {
            dirty.mark(bounds);
            let parts = dirty.take();
            sent += parts.iter().map(|part| part.size.width * part.size.height).sum::<u32>();
            parts.to_vec()
        };
        send(scene, &instance, parts, (8, beyond), &mut display);
        assert!(cells == scene.picture(&instance, [128, 64], Some(0)), "{} {step}", scene.name);
    }
    sent
}

#[test]
fn short_buffers_are_refused() {
    let area = bridge::rectangle(0, 0, 64, 9);
    let error = SmoothFrame::new(area, Rgb565::BLACK, &mut [0; 255], &mut [0; 384]).map(drop);
    assert_eq!(error, Err(BufferError::Strip { of: "`kept` of two rows", needed: 256, given: 255 }));
    let (mut kept, mut depths) = ([0; 256], [0; 384]);
    let mut frame = SmoothFrame::new(area, Rgb565::BLACK, &mut kept, &mut depths).expect("room");
    let error = frame.next_band(&mut [0; 767]).map(drop);
    assert_eq!(error, Err(BufferError::Strip { of: "a strip of six rows", needed: 768, given: 767 }));
    let error = frame.nth_band(0, &mut [0; 895]).map(drop);
    assert_eq!(error, Err(BufferError::Strip { of: "a strip of seven rows", needed: 896, given: 895 }));
    let error = frame.nth_band(0, &mut [0; 896]).map(drop);
    assert_eq!(error, Err(BufferError::Depth { needed: 448, given: 384 }));
    // Fewer depths than the strip has pixels decide how many rows are sent.
    for (rows, sent) in [(7, 1), (8, 4), (9, 3)] {
        let (mut strip, mut depths) = ([0; 1280], vec![0; 64 * rows]);
        let mut frame = SmoothFrame::new(area, Rgb565::BLACK, &mut kept, &mut depths).expect("room");
        let band = frame.nth_band(0, &mut strip).expect("room").expect("a band");
        assert_eq!(band.smooth::<2>(|_| ()).area().size.height, sent);
    }
}

/// Dirty regions may be empty.
#[test]
fn an_area_without_pixels_has_no_band() {
    for (width, height) in [(0, 9), (8, 0), (0, 0)] {
        let (mut strip, mut kept, mut depths) = ([0; 64], [0; 16], [0; 64]);
        let area = bridge::rectangle(3, 4, width, height);
        let mut frame = SmoothFrame::new(area, Gray8::new(0), &mut kept, &mut depths).expect("room");
        assert!(frame.next_band(&mut strip).expect("no error").is_none(), "{width} × {height}");
        assert!(frame.nth_band(0, &mut strip).expect("no error").is_none(), "{width} × {height}");
    }
}

/// A viewport of 64 × 64 pixels, and a camera that sees the cube in it.
fn cube_seen_from(yaw: Angle) -> (Viewport, Camera) {
    let viewport = Viewport::new(Point::zero(), Size::new(64, 64)).expect("a viewport");
    let [field_of_view, pitch] = [40, 20].map(Angle::degrees);
    let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, field_of_view, yaw, pitch);
    (viewport, camera.expect("a camera"))
}

/// Of a mesh that lists no edges, and of one that lists all.
#[test]
fn bounds_without_edges_are_those_of_the_faces() {
    let (_, camera) = cube_seen_from(Angle::ZERO);
    let plain = Mesh::new(CUBE.vertices(), CUBE.exponent(), CUBE.faces()).expect("a mesh");
    let [without, with] = [&plain, &CUBE].map(|mesh| {
        let instance = camera.place(mesh, &Affine::identity());
        let mut buffers = mesh_buffers!(smooth: CUBE);
        let transformed = instance.transform_depth(&mut buffers.cache);
        let faces = transformed.bin_faces(&mut buffers.bins).expect("room").bounds();
        let edges = transformed.bin_smooth_edges(|_| false, &mut buffers.edge_bins).expect("room");
        (faces, edges.bounds(faces), edges.bounds(Rectangle::zero()))
    });
    assert_eq!(without, (with.0, with.0, Rectangle::zero()));
    // A pixel that an edge crosses, and the one beyond it, may be those next to the drawn ones.
    assert_eq!((with.1.intersection(&with.0), with.1.intersection(&with.0.offset(2))), (with.0, with.1));
    assert_eq!(with.2, with.1);
}

/// The storage of edges is that of the frame before: what it holds does not matter, also where silhouettes are found by the planes of all faces.
#[test]
fn storage_of_an_earlier_frame_leaves_no_edge() {
    let (viewport, camera) = cube_seen_from(Angle::degrees(30));
    for cull in [Cull::Back, Cull::None] {
        let instance = camera.place(&CUBE, &Affine::identity()).with_cull(cull);
        let picture = |before: u16| {
            let (mut levels, mut depths) = (vec![Gray8::BLACK; 64 * 64], vec![0; 64 * 64]);
            let mut picture = Picture::new(&mut levels, viewport.size()).expect("room");
            let mut depth = DepthBuffer::new(viewport.area(), &mut depths).expect("room");
            let mut target = picture.pixels();
            let mut target = target.depth_tested(&mut depth);
            instance.faces(|face| Gray8::new(20 * face as u8 + 15)).draw(&mut target).expect("no error");
            let mut buffers = mesh_buffers!(smooth: CUBE);
            buffers.edge_bins.fill(before);
            let transformed = instance.transform_depth(&mut buffers.cache);
            let mut edges = transformed.bin_smooth_edges(|_| false, &mut buffers.edge_bins).expect("room");
            target.smooth(|pass| edges.draw(pass));
            levels
        };
        assert!(picture(0) == picture(u16::MAX), "{cull:?}");
    }
}

/// A band by its number uses the depths of rows that wait for the next band.
#[test]
fn the_next_band_after_one_by_number_is_the_first_one() {
    let (mut strip, mut kept, mut depths) = ([0; 16 * 8], [0; 16 * 2], [0; 16 * 8]);
    let mut frame = SmoothFrame::new(bridge::rectangle(0, 4, 16, 20), Gray8::new(0), &mut kept, &mut depths)
        .expect("room");
    let mut new_rows = |index: Option<u32>| {
        let band = match index {
            Some(index) => frame.nth_band(index, &mut strip),
            None => frame.next_band(&mut strip),
        };
        band.expect("room").map(|band| band.area().rows())
    };
    assert_eq!(
        [None, None, Some(2), None, None].map(&mut new_rows),
        [4..10, 10..16, 10..18, 4..10, 10..16].map(Some)
    );
}

/// Sprites and lines that faces hide in part, drawn over smoothed edges.
#[test]
fn what_is_drawn_over_smoothed_bands_is_hidden_as_in_one_piece() {
    let scene = &scenes()[1];
    let (mesh, camera, model) = (scene.mesh(), camera(128, 64).library(), scene.model.library());
    let (instance, sprites) = (camera.place(&mesh, &model), camera.place_sprites(&mesh, &model));
    let (sprite, colors) = (Sprite::square(Rgb888::CYAN, 3), scene.levels().0);
    let over = |mut pixels: Pixels<'_, Rgb888, [u8; 3]>, mut depth: DepthBuffer<'_>| {
        let mut target = pixels.depth_tested(&mut depth);
        let Ok(_) = sprites.draw(|_| sprite, &mut target);
        let Ok(_) = instance.edges(|_| Rgb888::MAGENTA).draw(&mut target);
    };
    let drawn = |rows: u32| {
        let (mut cache, mut bins) =
            (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.face_bins_len()]);
        let mut edge_bins = vec![0; mesh.smooth_bins_len()];
        let transformed = instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(&mut bins).expect("room");
        let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins).expect("room");
        let storage = |rows: u32| vec![0; SmoothFrame::<Rgb888>::strip_bytes(128, rows)];
        let (mut strip, mut kept, mut depths) = (storage(rows), storage(2), vec![0; 128 * rows as usize]);
        let area = bridge::rectangle(0, 0, 128, 64);
        let mut frame = SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut depths).expect("room");
        let mut shown = Vec::new();
        while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
            let (mut pixels, mut depth) = band.new_rows();
            faces.draw(|face| grey(colors[face]), &mut pixels.depth_tested(&mut depth)).expect("no error");
            shown.extend(band.smooth_then(|pass| edges.draw(pass), over).colors());
        }
        shown
    };
    let smoothed = scene.picture(&instance, [128, 64], Some(0));
    let mut whole: Vec<_> = smoothed.iter().map(|color| [color.r(), color.g(), color.b()]).collect();
    let (mut cache, mut depths) = (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; whole.len()]);
    let area = bridge::rectangle(0, 0, 128, 64);
    let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
    instance.depth_only(&mut cache, &mut depth);
    over(Pixels::new(&mut whole, area).expect("room"), depth);
    let whole: Vec<_> = whole.into_iter().map(|[r, g, b]| Rgb888::new(r, g, b)).collect();
    for color in [Rgb888::CYAN, Rgb888::MAGENTA] {
        assert!(whole.iter().filter(|&&shown| shown == color).count() > 20);
    }
    for rows in [6, 7, 8, 16, 64] {
        assert!(drawn(rows) == whole, "{rows}");
    }
}

/// The second and the third pass mix no other pixels than neighbours in a column, of which the upper one has an odd row, and an even row.
#[test]
fn passes_mix_their_pairs() {
    let scene = &scenes()[1];
    let [width, height] = [128, 64];
    let (mesh, camera, model) = (scene.mesh(), camera(width, height).library(), scene.model.library());
    let instance = camera.place(&mesh, &model);
    let plain = scene.picture(&instance, [width, height], None);
    let after = |passes: usize| {
        let (mut cache, mut bins) =
            (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.smooth_bins_len()]);
        let (mut cells, mut depths) = (plain.clone(), vec![0; plain.len()]);
        let mut depth = DepthBuffer::new(bridge::rectangle(0, 0, width, height), &mut depths).expect("room");
        instance.depth_only(&mut cache, &mut depth);
        let transformed = instance.transform_depth(&mut cache);
        let mut picture = Picture::new(&mut cells, Size::new(width, height)).expect("room");
        let mut edges = transformed.bin_smooth_edges(|_| true, &mut bins).expect("room");
        let mut pass_number = 0;
        picture.pixels().depth_tested(&mut depth).smooth(|pass| {
            if pass_number < passes {
                edges.draw(pass);
            }
            pass_number += 1;
        });
        assert_eq!(pass_number, 3);
        cells
    };
    for (passes, odd) in [(1, 1), (2, 0)] {
        let [before, cells] = [passes, passes + 1].map(after);
        assert!(cells.iter().zip(&before).filter(|(cell, before)| cell != before).count() > 50);
        let width = width as usize;
        for (at, cell) in cells.iter().enumerate() {
            let beyond = if at / width % 2 == odd { at + width } else { at.wrapping_sub(width) };
            let pair = [before[at], *before.get(beyond).unwrap_or(&before[at])].map(|color| color.r());
            let levels = pair[0].min(pair[1])..=pair[0].max(pair[1]);
            assert!(levels.contains(&cell.r()), "{at} {pair:?} {cell:?}");
        }
    }
}

/// What the drawn faces beside an edge tell is what their planes tell: without a list of the faces beside edges, of edges that list one face twice, so
/// that all are searched, or where no face is culled, as back faces of closed meshes are hidden.
#[test]
fn silhouettes_are_found_by_faces_as_by_planes() {
    for scene in scenes() {
        let listed = scene.mesh();
        let searched = Mesh::new(listed.vertices(), scene.solid.exponent, listed.faces());
        let searched = searched.and_then(|mesh| mesh.with_edges(&scene.solid.edges)).expect("a mesh");
        let mut twice = scene.solid.edge_faces();
        twice.iter_mut().step_by(3).for_each(|[first, second]| *first = *second);
        let twice = listed.with_edge_faces(&twice).expect("faces");
        let (size, model) = ([128, 64], scene.model.library());
        let camera = camera(size[0], size[1]).library();
        for cull in [Cull::Back, Cull::Front, Cull::None] {
            for contrast in [None, Some(NO_CREASES), Some(0)] {
                let [by_faces, by_planes, by_both] = [&listed, &searched, &twice]
                    .map(|mesh| scene.picture(&camera.place(mesh, &model).with_cull(cull), size, contrast));
                assert!(by_faces == by_planes && by_both == by_planes, "{cull:?} {contrast:?}");
            }
        }
    }
}

#[test]
fn smoothed_edges_are_close_to_their_areas() {
    for scene in scenes() {
        let mesh = scene.mesh();
        for (width, height) in [(240, 240), (128, 64)] {
            let (camera, model) = (camera(width, height).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let reference = reference(&scene, &instance, [width, height]);
            let [plain, smooth] = [None, Some(scene.contrast())]
                .map(|contrast| scene.picture(&instance, [width, height], contrast));
            let (rms, far, worse) = reference.errors(&smooth, &plain);
            let rms = [reference.errors(&plain, &plain).0, rms];
            println!("{} {width} × {height}: {rms:.1?}, {far:.1} % off by 20, {worse} worse", scene.name);
            // Levels; per cent of the edge pixels; pixels.
            let [most, most_far, most_worse] = if height == 240 { [5.0, 1.2, 8.0] } else { [8.3, 4.0, 8.0] };
            assert!(rms[1] < most && 2.0 * rms[1] < rms[0] && far < most_far && worse as f64 <= most_worse);
        }
    }
}

/// White triangles on black, drawn with smooth edges in an orthographic projection: a unit is 2⁻⁸ pixel, and the middle of the picture is 0.
fn white_triangles(vertices: &[[i16; 3]], size: u32) -> Vec<Gray8> {
    let window = Scalar::from_int(2);
    let window = Window { left: -window, right: window, bottom: -window, top: window };
    let lens = Projection::orthographic(window, -window.top, window.top).expect("a box");
    let (origin, [up, back]) =
        (Point3::from_ints(0, 0, 0), [[0, 1, 0], [0, 0, 1]].map(|[x, y, z]| Vector3::from_ints(x, y, z)));
    let view = ViewTransform::from_reference(origin, back, up).expect("axes");
    let viewport = Viewport::new(Point::zero(), Size::new(size, size)).expect("a viewport");
    let camera = Camera::new(&view, &lens, &viewport);
    let faces: Vec<_> = (0..vertices.len() as u16).step_by(3).map(|i| [i, i + 1, i + 2]).collect();
    let edges: Vec<_> = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let mesh = Mesh::new(vertices, -12, &faces).expect("a mesh").with_edges(&edges).expect("edges");
    let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
    let count = (size * size) as usize;
    let (mut levels, mut depths) = (vec![Gray8::BLACK; count], vec![0; count]);
    let mut picture = Picture::new(&mut levels, viewport.size()).expect("room");
    let mut depth = DepthBuffer::new(viewport.area(), &mut depths).expect("room");
    let mut target = picture.pixels();
    let mut target = target.depth_tested(&mut depth);
    instance.faces(|_| Gray8::WHITE).draw(&mut target).expect("no error");
    let (mut cache, mut bins) = (vec![ScreenVertex::EMPTY; vertices.len()], vec![0; mesh.smooth_bins_len()]);
    let transformed = instance.transform_depth(&mut cache);
    let mut edges = transformed.bin_smooth_edges(|_| false, &mut bins).expect("room");
    target.smooth(|pass| edges.draw(pass));
    levels
}

/// Corners in the picture of 64 × 64 pixels, whose y points down.
fn in_picture<const N: usize>(corners: [[i16; N]; 3]) -> [[f64; 2]; 3] {
    corners.map(|corner| [32.0 + f64::from(corner[0]) / 256.0, 32.0 - f64::from(corner[1]) / 256.0])
}

/// A white triangle on black, whose corners are in half pixels or in 1/256 of one: each pixel that a single side crosses shows its area inside,
/// also where the side goes through its centre.
#[test]
fn pixels_on_a_side_show_their_areas() {
    let (mut rng, mut halves, mut compared) = (Rng::new(11), 0, 0);
    for case in 0..4_000 {
        let step = [128, 1][case % 2];
        let most = 28 * 256 / step;
        let corners = [0; 3].map(|_| [0; 2].map(|_| (rng.int(-most, most) * step) as i16));
        let levels = white_triangles(&corners.map(|[x, y]| [x, y, 0]), 64);
        let corners = in_picture(corners);
        for (pixel, level) in bridge::rectangle(0, 0, 64, 64).points().zip(levels) {
            let [x, y] = [pixel.x, pixel.y].map(f64::from);
            let Some(inside) = area_of_one_side(corners, [x, y]) else { continue };
            let off = (f64::from(level.luma()) - 255.0 * inside).abs();
            assert!(off < 1.5, "{corners:?} {pixel}: {level:?} for {inside}");
            (compared, halves) = (compared + 1, halves + u32::from(inside == 0.5));
        }
    }
    assert!(compared > 1_000_000 && halves > 1_500, "{compared} {halves}");
}

/// A triangle behind another one, of which it is a smaller copy: nothing of it is seen, so the picture is that of the one in front,
/// but near its corners, where pixels of a side lie outside of both.
#[test]
fn a_side_behind_a_nearer_surface_is_not_smoothed() {
    let (mut rng, mut compared) = (Rng::new(12), 0);
    for _ in 0..2_000 {
        let front =
            [0; 3].map(|_| [0; 2].map(|_| rng.int(-28 * 256, 28 * 256) as i16)).map(|[x, y]| [x, y, 4096]);
        let middle = [0, 1].map(|axis| front.iter().map(|corner| f64::from(corner[axis])).sum::<f64>() / 3.0);
        let kept = 1.0 - 0.0006 * rng.int(1, 100) as f64;
        let z = 4096 - rng.int(64, 8000) as i16;
        let behind = front.map(|[x, y, _]| {
            let [x, y] =
                [(x, 0), (y, 1)].map(|(at, axis)| middle[axis] + kept * (f64::from(at) - middle[axis]));
            [x as i16, y as i16, z]
        });
        let alone = white_triangles(&front, 64);
        let both = white_triangles(&[front, behind].concat(), 64);
        for (pixel, (alone, both)) in bridge::rectangle(0, 0, 64, 64).points().zip(alone.iter().zip(&both)) {
            let [x, y] = [pixel.x, pixel.y].map(f64::from);
            if area_of_one_side(in_picture(front), [x, y]).is_some_and(|area| area > 0.0 && area < 1.0) {
                assert_eq!(alone, both, "{front:?} {behind:?} {pixel}");
                compared += 1;
            }
        }
    }
    assert!(compared > 50_000, "{compared}");
}

/// The part of the pixel at (x, y) inside a triangle; `None` if a second side or a corner is near.
fn area_of_one_side(corners: [[f64; 2]; 3], [x, y]: [f64; 2]) -> Option<f64> {
    let centre = [x + 0.5, y + 0.5];
    let sides = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
    let beyond =
        |[a, b]: [[f64; 2]; 2], p: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let is_near = |side: &&[[f64; 2]; 2]| {
        let [a, b] = **side;
        beyond(**side, centre).abs() < 3.0 * (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let is_corner_near = corners.iter().any(|c| (c[0] - centre[0]).hypot(c[1] - centre[1]) < 3.0);
    let turn = beyond(sides[0], corners[2]).signum();
    if sides.iter().filter(is_near).count() != 1 || is_corner_near || turn == 0.0 {
        return None;
    }
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| [x + u, y + v]);
    let inside = sides
        .into_iter()
        .fold(square.to_vec(), |polygon, side| chain::cut(&polygon, |point| turn * beyond(side, *point)));
    Some(chain::area(&inside))
}

/// Objects of which one is clipped by the viewport, one by the near plane, and one shows its back faces.
#[test]
fn a_scene_is_smoothed_as_its_objects() {
    let (area, [cube, torus, _, gear, house]) = (bridge::rectangle(0, 0, 128, 64), &scenes()[..]) else {
        panic!("five solids");
    };
    let meshes = [cube, torus, gear, house].map(Scene::mesh);
    let camera = camera(128, 64).library();
    let mut scene = pinhole::draw::Scene::<u8, 5>::new();
    let mut add = |mesh, step, [x, y, z]: [i16; 3], cull, level| {
        let model = turned(step).library().translate(Vector3::from_ints(x, y, z));
        let mut object = Object::new(mesh, model, level);
        object.cull = cull;
        scene.add(object).expect("room");
    };
    add(&meshes[0], 1, [-2, 0, 0], Cull::Front, 250);
    add(&meshes[1], 2, [3, 0, 1], Cull::None, 40);
    add(&meshes[2], 3, [0, 0, -3], Cull::Back, 120);
    add(&meshes[3], 4, [90, 0, 0], Cull::Back, 0); // out of view
    add(&meshes[0], 5, [4, -1, 7], Cull::None, 90);
    let is_crease = |index: usize, edge: usize| !(index + edge).is_multiple_of(3);
    let shade = |_, object: &Object<'_, u8>| {
        let level = object.material;
        move |face: usize| grey(level.wrapping_add(5 * (face % 50) as u8))
    };
    let placed = scene.place(&camera);
    assert_eq!(placed.iter().count(), 4);

    // The objects one by one.
    let draw = |smooth: &mut dyn FnMut(&mut Picture<'_, Rgb888>, &mut DepthBuffer<'_>)| {
        let (mut cells, mut depths) = (vec![grey(BACKGROUND); 128 * 64], vec![0; 128 * 64]);
        let mut picture = Picture::new(&mut cells, area.size).expect("room");
        let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
        let Ok(_) = placed.draw(shade, &mut [], &mut picture.pixels().depth_tested(&mut depth));
        smooth(&mut picture, &mut depth);
        cells
    };
    let storage = || (vec![ScreenVertex::EMPTY; 2000], vec![0; 20_000], vec![0; 20_000]);
    let whole = draw(&mut |picture, depth| {
        let instances: Vec<_> = placed.iter().map(|(_, instance)| instance).collect();
        let mut storages = [(); 4].map(|()| storage());
        let mut edges = Vec::new();
        for ((index, instance), (cache, bins, _)) in
            [0, 1, 2, 4].into_iter().zip(&instances).zip(&mut storages)
        {
            let transformed = instance.transform_depth(cache);
            edges.push(transformed.bin_smooth_edges(|edge| is_crease(index, edge), bins).expect("room"));
        }
        picture
            .pixels()
            .depth_tested(depth)
            .smooth(|pass| edges.iter_mut().for_each(|edges| edges.draw(pass)));
    });
    let plain = draw(&mut |_, _| {});
    let differ = whole.iter().zip(&plain).filter(|(a, b)| a != b).count();
    assert!(differ > 300, "{differ}");

    let creases = |index, _: &Object<'_, u8>, edge| is_crease(index, edge);
    for (vertices, entries) in [(2000, 0), (2000, 16), (300, 16), (0, 3)] {
        let (mut cache, mut bins, mut edge_bins) = storage();
        let mut list = vec![SmoothEdge::EMPTY; entries];
        let mut faces = placed.bin_faces(&mut cache[..vertices], &mut bins).expect("room");
        let needed = placed.iter().map(|(object, _)| object.mesh().smooth_bins_len()).sum();
        let error = faces.bin_smooth_edges(creases, &mut vec![0; needed - 1]).map(drop);
        assert_eq!(error, Err(BufferError::Bins { needed, given: needed - 1 }));
        let mut edges = faces.bin_smooth_edges(creases, &mut edge_bins[..needed]).expect("room");
        edges.keep_in(&mut list);
        let bounds: Vec<_> = edges.bounds().map(|(_, bounds)| bounds).collect();
        let is_inside = |at: Point| bounds.iter().any(|bounds| bounds.contains(at));
        let smooth = draw(&mut |picture, depth| {
            picture.pixels().depth_tested(depth).smooth(|pass| edges.draw(pass));
        });
        assert!(smooth == whole);
        for (at, color) in area.points().zip(&smooth) {
            assert!(is_inside(at) || *color == grey(BACKGROUND), "{at}");
        }
        for rows in [6, 8, 13] {
            let (mut strip, mut depths) = (vec![0; 128 * 3 * rows], vec![0; 128 * rows]);
            let mut kept = [0; 2 * 128 * 3];
            let mut frame = SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut depths).expect("room");
            let mut picture = Vec::new();
            while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
                let (mut pixels, mut depth) = band.new_rows();
                let Ok(()) = faces.draw(shade, &mut pixels.depth_tested(&mut depth));
                picture.extend(band.smooth(|pass| edges.draw(pass)).colors());
            }
            assert!(picture == whole, "{rows}");
        }
    }
}

/// A colour type of the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rgb444(u32);

impl PixelColor for Rgb444 {
    type Raw = ();
}

impl Color for Rgb444 {
    const FORMAT: Format = Format::rgb(4, 4, 4);

    fn to_bits(self) -> u32 {
        self.0
    }

    fn from_bits(bits: u32) -> Self {
        Self(bits & 0xfff)
    }
}

/// What a level of the reference is in the three channels.
const CHANNELS: [fn(f64) -> f64; 3] = [|level| level, |level| 255.0 - level, |level| level / 2.0];

/// The gear in a format.
struct InFormat<'a> {
    scene: &'a Scene,
    instance: &'a MeshInstance<'a>,
    size: [u32; 2],
    reference: &'a Reference,
    /// Its levels are multiplied by this, modulo 256, so that those of neighbours differ more.
    factor: u8,
}

impl InFormat<'_> {
    fn color<C: Color>(&self, level: u8) -> C {
        let level = f64::from(level.wrapping_mul(self.factor));
        let mut channels = CHANNELS.map(|channel| channel(level) / 255.0);
        let most = C::from_bits(u32::MAX).channels();
        channels.iter_mut().zip(most).for_each(|(value, most)| *value = (*value * f64::from(most)).round());
        C::from_channels(channels.map(|value| value as u8))
    }

    /// The picture in cells of memory without and with smoothed edges.
    fn pictures<C: Color + StoredPixel<Cell>, Cell: Copy>(&self) -> [Vec<C>; 2] {
        let ([width, height], mesh) = (self.size, self.instance.mesh());
        let (area, count) = (bridge::rectangle(0, 0, width, height), (width * height) as usize);
        let (mut cells, mut depths) = (vec![self.color::<C>(BACKGROUND).stored(); count], vec![0; count]);
        let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
        let mut pixels = Pixels::<C, Cell>::new(&mut cells, area).expect("room");
        let faces = self.scene.levels().0;
        let mut target = pixels.depth_tested(&mut depth);
        let Ok(_) = self.instance.faces(|face| self.color::<C>(faces[face])).draw(&mut target);
        let loaded = |cells: &[Cell]| cells.iter().map(|&cell| C::load(cell)).collect();
        let plain = loaded(&cells);
        let (mut cache, mut bins) =
            (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.smooth_bins_len()]);
        let transformed = self.instance.transform_depth(&mut cache);
        let mut edges = transformed.bin_smooth_edges(|_| true, &mut bins).expect("room");
        let mut pixels = Pixels::<C, Cell>::new(&mut cells, area).expect("room");
        pixels.depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
        [plain, loaded(&cells)]
    }

    /// Compares each channel with the reference, and returns the smoothed picture.
    fn check<C: Color + StoredPixel<Cell> + Debug, Cell: Copy>(&self) -> Vec<C> {
        let [plain, smooth] = self.pictures::<C, Cell>();
        let most = C::from_bits(u32::MAX).channels().map(f64::from);
        for (at, most) in most.into_iter().enumerate().filter(|(_, most)| *most > 0.0) {
            let step = 255.0 / most;
            let rms = |picture: &[C]| {
                let expected = |i: usize| CHANNELS[at](self.reference.means[i]);
                self.reference.rms(|i| f64::from(picture[i].channels()[at]) * step - expected(i))
            };
            let rms = [rms(&plain), rms(&smooth)];
            println!("{} {at}: {rms:.1?}", core::any::type_name::<C>());
            // Smoothed edges are off by 4.0 levels; a channel is rounded to its levels twice. Between neighbours of four levels lies none.
            assert!(rms[1] < rms[0] && rms[1] < 4.5 + 0.5 * step, "{at} {rms:?}");
        }
        smooth
    }
}

/// Hands the gear to a check.
fn in_formats(size: [u32; 2], factor: u8, check: impl FnOnce(InFormat<'_>)) {
    let scene = &scenes()[3];
    let (mesh, camera, model) = (scene.mesh(), camera(size[0], size[1]).library(), scene.model.library());
    let instance = &camera.place(&mesh, &model);
    check(InFormat { scene, instance, size, reference: &reference(scene, instance, size), factor });
}

/// Each channel, in all forms of memory.
#[test]
fn edges_are_smoothed_in_each_format() {
    in_formats([240, 240], 1, |gear| {
        assert_eq!(gear.check::<Rgb888, Rgb888>(), gear.check::<Rgb888, [u8; 3]>());
        gear.check::<Bgr888, [u8; 3]>();
        gear.check::<Rgb666, Rgb666>();
        let in_order = gear.check::<Rgb565, [u8; 2]>();
        assert_eq!(in_order, gear.check::<Rgb565, u16>());
        assert_eq!(in_order, gear.check::<Rgb565, Rgb565>());
        gear.check::<Bgr555, u16>();
        gear.check::<Rgb444, Rgb444>();
        gear.check::<Gray8, [u8; 1]>();
        gear.check::<Gray4, Gray4>();
    });
}

/// Bands of colours that share bytes with their neighbours, whole and by number, in rows that end within a byte.
#[test]
fn bands_are_packed_once_they_are_smoothed() {
    fn check<C: Color + StoredPixel<[u8; N]> + Debug, const N: usize>(gear: &InFormat<'_>, row: usize) {
        let ([width, height], mesh) = (gear.size, gear.instance.mesh());
        let [plain, whole] = gear.pictures::<C, C>();
        assert!(plain != whole);
        let (mut cache, mut bins) =
            (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.face_bins_len()]);
        let mut edge_bins = vec![0; mesh.smooth_bins_len()];
        let transformed = gear.instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(&mut bins).expect("room");
        let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins).expect("room");
        let colors = gear.scene.levels().0;
        let storage = |rows| vec![0; SmoothFrame::<C>::strip_bytes(width, rows)];
        let (mut strip, mut kept, mut depths) = (storage(10), storage(2), vec![0; (width * 10) as usize]);
        let area = bridge::rectangle(0, 0, width, height);
        let mut frame = SmoothFrame::new(area, gear.color(BACKGROUND), &mut kept, &mut depths).expect("room");
        let mut check = |mut band: SmoothBand<'_, '_, C>| {
            let (mut pixels, mut depth) = band.new_rows();
            let Ok(()) =
                faces.draw(|face| gear.color::<C>(colors[face]), &mut pixels.depth_tested(&mut depth));
            let band = band.smooth(|pass| edges.draw(pass));
            let (first, rows) = (band.area().top_left.y as usize, band.area().size.height as usize);
            let pixels = first * width as usize..(first + rows) * width as usize;
            assert!(band.colors().eq(whole[pixels].iter().copied()));
            // Bits beside the last pixel of a row are zeros.
            let unused = 8 * row as u32 - width * C::FORMAT.bits();
            assert_eq!(band.bytes().len(), rows * row);
            assert!(band.bytes().chunks(row).all(|row| row[row.len() - 1].trailing_zeros() >= unused));
            rows as u32
        };
        let mut rows = [0; 2];
        while let Some(band) = frame.next_band(&mut strip).expect("room") {
            rows[0] += check(band);
        }
        while let Some(band) = frame.nth_band(rows[1].div_ceil(6), &mut strip).expect("room") {
            rows[1] += check(band);
        }
        assert_eq!(rows, [height; 2]);
    }
    in_formats([61, 77], 3, |gear| {
        check::<Gray2, 1>(&gear, 16);
        check::<Gray4, 1>(&gear, 31);
        check::<Rgb444, 2>(&gear, 92);
    });
}
