//! Bands at their limits: storage that is too small, displays that fail, meshes larger than the storage. That bands add up
//! to the full picture is tested on random scenes in `properties/bands.rs`.

use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, GrayColor, Rgb565};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    BandError, BinError, Cull, DepthBuffer, DepthBufferError, Frame, Mesh, MeshInstance, ScreenVertex,
    Statistics,
};
use support::bridge::draw::{cube_camera, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, screen};
use support::oracle::target::{Call, Recorder, Refused};

fn cube<R>(viewport: (i32, i32, u32, u32), then: impl FnOnce(&MeshInstance<'_>) -> R) -> R {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
    let model = ModelBits(vec![Step::Y(1 << 29), Step::X(1 << 28)]).library();
    then(&cube_camera(viewport).library().place(&mesh, &model))
}

fn colour(face: usize) -> Gray8 {
    Gray8::new(face as u8 + 1)
}

/// Draws the cube in bands of `rows` rows and sends them to a display.
fn draw(
    instance: &MeshInstance<'_>,
    rows: u32,
    display: &mut Recorder<Gray8>,
) -> Result<Statistics, Refused> {
    let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 13]);
    let area = display.bounding_box();
    let mut faces = instance.transform_depth(&mut corners).bin_faces(&mut bin_storage).expect("room");
    let mut frame = Frame::new(area, Gray8::BLACK);
    let pixels = Frame::<Gray8>::strip_bytes(area.size.width, rows);
    let (mut strip, mut storage) = (vec![0; pixels], vec![0; pixels]);
    while let Some(mut band) = frame.next_band(&mut strip).expect("a row") {
        let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
        let Ok(()) = faces.depth_tested(colour, &mut depth, &mut band);
        band.send(display)?;
    }
    Ok(faces.statistics())
}

fn luma(display: &Recorder<Gray8>) -> Vec<u8> {
    display.bounding_box().points().map(|p| display.colour(p.x, p.y).map_or(0, |c| c.luma())).collect()
}

fn whole(instance: &MeshInstance<'_>, area: Rectangle) -> Vec<u8> {
    let (drawn, _) = screen(area, &mut |target, depth| {
        let Ok(_) = instance.depth_tested(colour, &mut [ScreenVertex::EMPTY; 8], depth, target);
    });
    drawn.over(Gray8::BLACK).into_iter().map(|color| color.luma()).collect()
}

#[test]
fn a_strip_without_room_for_a_row_says_what_it_needs() {
    let mut frame = Frame::new(rectangle(0, 0, 240, 8), Rgb565::BLACK);
    for given in [0, 1, 479] {
        let error = frame.next_band(&mut vec![0; given]).map(|_| ()).expect_err("no row fits");
        assert_eq!(error, BandError { needed: 480, given });
        assert!(error.to_string().contains("480"));
    }
    // The failed call returned no band: the frame still begins at its top.
    let mut strip = [0; 480];
    assert_eq!(frame.next_band(&mut strip).expect("a row").expect("a band").area(), rectangle(0, 0, 240, 1));
    // A frame without pixels needs no strip.
    for (width, height) in [(0, 0), (0, 9), (9, 0)] {
        let mut empty = Frame::new(rectangle(3, 4, width, height), BinaryColor::Off);
        assert!(empty.next_band(&mut []).expect("nothing to hold").is_none());
    }
}

#[test]
fn a_depth_strip_too_short_says_what_it_needs() {
    let mut strip = [0; 64 * 4];
    let mut frame = Frame::new(rectangle(0, 0, 64, 64), Gray8::BLACK);
    let band = frame.next_band(&mut strip).expect("a row").expect("a band");
    let error = DepthBuffer::new(band.area(), &mut [0; 255]).map(|_| ()).expect_err("one too few");
    assert_eq!(error, DepthBufferError { needed: 256, given: 255 });
}

#[test]
fn without_records_nothing_is_drawn_and_the_error_names_the_need() {
    cube((0, 0, 64, 64), |instance| {
        let mut corners = [ScreenVertex::EMPTY; 8];
        let projected = instance.transform(&mut corners);
        // Three sides of the cube are visible: six faces, and one number for every 16 of the mesh's twelve.
        let (mut bin_storage, mut enough) = ([], [0; 7]);
        let error = projected.bin_faces(&mut bin_storage).map(|_| ()).expect_err("no room");
        assert_eq!(error, BinError::Storage { needed: 7, given: 0 });
        assert!(error.to_string().contains('7'));
        assert_eq!(projected.bin_faces(&mut enough).expect("room").statistics().drawn, 6);
        // A vertex cache is optional: without it each vertex is computed where a face needs it.
        let none = instance.transform(&mut []);
        assert_eq!(none.bin_faces(&mut enough).expect("room").statistics().drawn, 6);
    });
}

#[test]
fn more_faces_than_records_can_count_are_refused() {
    let faces = vec![[0, 1, 2]; 65_536];
    let mesh = Mesh::new(&CUBE, 0, &faces).expect("a mesh");
    let camera = cube_camera((0, 0, 8, 8)).library();
    let model = ModelBits(vec![]).library();
    let mut bin_storage = vec![0; 80_000];
    let instance = camera.place(&mesh, &model);
    let error = instance.transform(&mut []).bin_faces(&mut bin_storage).map(|_| ()).expect_err("too many");
    assert_eq!(error, BinError::TooMany { items: 65_536 });
    let mesh = Mesh::new(&CUBE, 0, &faces[1..]).expect("a mesh");
    assert!(camera.place(&mesh, &model).transform(&mut []).bin_faces(&mut bin_storage).is_ok());
}

/// Bands beside, above and below the viewport alternate with bands of it: there the shader is not called, and later bands
/// are complete.
#[test]
fn a_band_beside_the_viewport_changes_nothing() {
    for viewport in [(0, -64, 64, 64), (0, -32, 64, 64)] {
        cube(viewport, |instance| {
            let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 13]);
            let mut faces = instance.transform(&mut corners).bin_faces(&mut bin_storage).expect("room");
            let (mut edge_corners, mut edge_bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 20]);
            let mut edges =
                instance.transform(&mut edge_corners).bin_edges(&mut edge_bin_storage).expect("room");
            let area = rectangle(viewport.0, viewport.1, viewport.2, viewport.3);
            let (mut at_once, mut banded) = (Recorder::new(area), Recorder::new(area));
            instance.solid(colour, &mut [], &mut at_once).expect("no error");
            instance.wireframe(Gray8::WHITE, &mut [], &mut at_once).expect("no error");
            for row in (0..64).step_by(4) {
                let mut band = Recorder::new(rectangle(0, viewport.1 + row, 64, 4));
                faces.solid(colour, &mut band).expect("no error");
                edges.draw(Gray8::WHITE, &mut band).expect("no error");
                for pixel in band.bounding_box().points() {
                    if let Some(colour) = band.colour(pixel.x, pixel.y) {
                        banded.draw_iter([Pixel(pixel, colour)]).expect("no error");
                    }
                }
                for beside in [(64, viewport.1 + row, 8, 4), (0, viewport.1 - 8, 64, 4), (0, 99, 64, 4)] {
                    let mut beside = Recorder::new(rectangle(beside.0, beside.1, beside.2, beside.3));
                    let shade = |face| -> Gray8 { panic!("the colour of face {face}") };
                    faces.solid(shade, &mut beside).expect("no error");
                    edges.draw(Gray8::WHITE, &mut beside).expect("no error");
                }
            }
            assert_eq!(luma(&banded), luma(&at_once), "{viewport:?}");
            assert!(luma(&banded).iter().any(|&luma| luma > 0));
        });
    }
}

/// The error of the display is returned at the band where it failed, and the next frame is right.
#[test]
fn a_display_error_in_mid_frame_is_returned() {
    cube((0, 0, 64, 64), |instance| {
        for after in 0..8 {
            let mut display = Recorder::failing(64, 64, after);
            assert_eq!(draw(instance, 8, &mut display), Err(Refused(after)));
            assert_eq!(display.calls.len(), after + 1);
            display.fails_at = None;
            draw(instance, 8, &mut display).expect("a display that works again");
            assert!(luma(&display) == whole(instance, rectangle(0, 0, 64, 64)), "after {after} bands");
        }
    });
}

/// After a target failed in mid-band the binned faces are complete and can be drawn again.
#[test]
fn a_band_that_fails_can_be_drawn_again() {
    cube((0, 0, 64, 64), |instance| {
        let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 7]);
        let projected = instance.transform(&mut corners);
        let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
        let mut good = Recorder::sized(64, 64);
        instance.solid(colour, &mut [], &mut good).expect("no error");
        for after in [0, 1, 20] {
            let mut bad = Recorder::failing(64, 64, after);
            assert_eq!(faces.solid(colour, &mut bad), Err(Refused(after)));
            bad = Recorder::sized(64, 64);
            faces.solid(colour, &mut bad).expect("no error");
            assert_eq!(luma(&bad), luma(&good));
        }
    });
}

/// A band is sent by one call, whatever it contains.
#[test]
fn a_band_is_sent_in_one_piece() {
    cube((0, 0, 60, 60), |instance| {
        let mut display = Recorder::sized(60, 60);
        draw(instance, 8, &mut display).expect("no error");
        let calls: Vec<_> = (0..8)
            .map(|i| {
                let rows = if i == 7 { 4 } else { 8 };
                Call::Contiguous(rectangle(0, 8 * i, 60, rows), 60 * rows as usize)
            })
            .collect();
        assert_eq!(display.calls, calls);
    });
}

/// A mesh of 65 536 vertices, in chunks of 512 that share storage: every band draws chunk after chunk, in one order over
/// all of them. Then the mesh is binned once, with a cache of 300 vertices.
#[test]
fn a_mesh_larger_than_the_storage_streams_in_chunks() {
    // A field of 256 x 256 posts, hilly enough to hide parts of itself.
    let height = |x: i32, z: i32| ((x * x / 60 + z * 37 + x * z / 50) % 60 * 60) as i16;
    let at = |x: i32, z: i32| [((x - 128) * 200) as i16, height(x, z), ((z - 128) * 200) as i16];
    let vertices: Vec<[i16; 3]> = (0..256).flat_map(|z| (0..256).map(move |x| at(x, z))).collect();
    let corner = |x: u32, z: u32| (z * 256 + x) as u16;
    let quad = |x, z| {
        let [a, b, c, d] = [corner(x, z), corner(x, z + 1), corner(x + 1, z + 1), corner(x + 1, z)];
        [[a, b, c], [a, c, d]]
    };
    // Chunks of one row of posts, and a mesh of all for reference, which must have its faces below 65536.
    let rows = 0..96u32;
    let faces: Vec<[u16; 3]> = rows.clone().flat_map(|z| (0..255).flat_map(move |x| quad(x, z))).collect();
    let camera = cube_camera((0, 0, 96, 64)).library();
    let model = ModelBits(vec![Step::Move([0, 0, ONE])]).library();
    let mesh = Mesh::new(&vertices, -13, &faces).expect("a mesh");
    let instance = camera.place(&mesh, &model).with_cull(Cull::None);
    let area = rectangle(0, 0, 96, 64);
    let shade = |face: usize| Gray8::new((face * 7 % 251) as u8 + 1);
    let (reference, _) = screen(area, &mut |target, depth| {
        let Ok(_) = instance.depth_tested(shade, &mut [], depth, target);
    });
    let reference = reference.over(Gray8::BLACK);

    // In chunks: each chunk is transformed again for every band, with storage for two rows of posts.
    let chunk_faces: Vec<[u16; 3]> = (0..255).flat_map(|x| quad(x, 0)).collect();
    let mut corners = [ScreenVertex::EMPTY; 512];
    let picture = bands(area, Gray8::BLACK, 16, &mut |band, depth| {
        for z in rows.clone() {
            let own = &vertices[z as usize * 256..(z as usize + 2) * 256];
            let chunk = Mesh::new(own, -13, &chunk_faces).expect("a mesh");
            let chunk = camera.place(&chunk, &model).with_cull(Cull::None);
            let Ok(_) = chunk.depth_tested(|face| shade(z as usize * 510 + face), &mut corners, depth, band);
        }
    });
    assert!(picture == reference);

    // Binned once, with a cache of 300 vertices: the others are computed where a face needs them.
    let mut bin_storage = vec![0; faces.len() + faces.len().div_ceil(16)];
    let projected = instance.transform_depth(&mut corners[..300]);
    let mut recorded = projected.bin_faces(&mut bin_storage).expect("room");
    let picture = bands(area, Gray8::BLACK, 16, &mut |band, depth| {
        let Ok(()) = recorded.depth_tested(shade, depth, band);
    });
    assert!(picture == reference);
    assert!(picture.iter().filter(|&&color| color != Gray8::BLACK).count() > 1000, "hardly anything is seen");
}

/// One unit is one pixel, with y up: faces and edges that only touch the viewport's borders from outside, which share no pixel with
/// it, do not count in the bounds.
#[test]
fn bounds_leave_out_what_ends_at_the_borders() {
    const SEEN: [[i16; 3]; 3] = [[20, -30, -5], [28, -30, -5], [20, -22, -5]];
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([0, 64 * ONE, -48 * ONE, 0], ONE, 100 * ONE),
        viewport: (0, 0, 64, 48),
    };
    let camera = camera.library();
    for beside in [
        [[-8, -40, -5], [0, -40, -5], [-8, -4, -5]],  // left
        [[64, -40, -5], [72, -40, -5], [64, -4, -5]], // right
        [[4, 0, -5], [60, 0, -5], [4, 8, -5]],        // above
        [[4, -56, -5], [60, -56, -5], [60, -48, -5]], // below
    ] {
        let vertices = [SEEN, beside].concat();
        let mesh = Mesh::new(&vertices, 0, &[[0, 1, 2], [3, 4, 5]]).expect("a mesh");
        let model = ModelBits::default().library();
        let (mut cache, mut storage) = ([ScreenVertex::EMPTY; 6], [0; 4]);
        let transformed = camera.place(&mesh, &model);
        let transformed = transformed.transform_depth(&mut cache);
        let faces = transformed.bin_faces(&mut storage).expect("room");
        assert_eq!(faces.bounds(), rectangle(20, 22, 8, 8), "{beside:?}");
    }
}
