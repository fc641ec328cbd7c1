//! Bands at their limits: storage that is too small, displays that fail, meshes larger than the storage, and strips that a transfer owns,
//! as with DMA; and bands of dirty regions. That bands add up to the full picture is tested on random scenes in `properties/scenes.rs`.

use core::convert::Infallible;
use core::ops::ControlFlow::{Break, Continue};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, GrayColor, Rgb565};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    bands::{DirtyRegions, Tracked, TransferCost},
    draw::ActiveFace,
    fog::{Fog, FogTable},
    prelude::*,
    target::BufferError,
};
use support::bridge::draw::{cube_camera, flat_camera, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{CameraBits, ModelBits, Step, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, memory, memory_with, screen};
use support::oracle::rng::Rng;
use support::oracle::target::{Recorder, Refused, Screen};
use support::solids::torus;

fn cube<R>(viewport: (i32, i32, u32, u32), then: impl FnOnce(&MeshInstance<'_>) -> R) -> R {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
    let model = ModelBits(vec![Step::Y(1 << 29), Step::X(1 << 28)]).library();
    then(&cube_camera(viewport).library().place(&mesh, &model))
}

fn colour(face: usize) -> Gray8 {
    Gray8::new((face % 255) as u8 + 1)
}

/// A user's function that is generic over targets can draw faces with depth.
fn draw_into<T: Target<Color = Gray8>>(faces: &mut BinnedFaces<'_>, target: &mut T) -> Result<(), T::Error> {
    faces.draw(colour, target)
}

/// Draws the cube in bands of `rows` rows and sends them to a display.
fn draw(
    instance: &MeshInstance<'_>,
    rows: u32,
    display: &mut Recorder<Gray8>,
) -> Result<Statistics, Refused> {
    let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 17]);
    let area = display.bounding_box();
    let mut faces = instance.transform_depth(&mut corners).bin_faces(&mut bin_storage).expect("room");
    let mut frame = Frame::new(area, Gray8::BLACK);
    let pixels = Frame::<Gray8>::strip_bytes(area.size.width, rows);
    let (mut strip, mut storage) = (vec![0; pixels], vec![0; pixels]);
    while let Some(mut band) = frame.next_band(&mut strip).expect("a row") {
        let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
        let Ok(()) = draw_into(&mut faces, &mut band.depth_tested(&mut depth));
        band.send(display)?;
    }
    Ok(faces.statistics())
}

fn luma(display: &Recorder<Gray8>) -> Vec<u8> {
    display.bounding_box().points().map(|p| display.colour(p.x, p.y).map_or(0, |c| c.luma())).collect()
}

fn whole(instance: &MeshInstance<'_>, area: Rectangle) -> Vec<u8> {
    let (drawn, _) = screen(area, &mut |target, depth| {
        let Ok(_) = instance
            .faces(colour)
            .cached(&mut [ScreenVertex::EMPTY; 8])
            .draw(&mut target.depth_tested(depth));
    });
    drawn.over(Gray8::BLACK).into_iter().map(|color| color.luma()).collect()
}

#[test]
fn a_strip_without_room_for_a_row_says_what_it_needs() {
    let mut frame = Frame::new(rectangle(0, 0, 240, 8), Rgb565::BLACK);
    for given in [0, 1, 479] {
        let error = frame.next_band(&mut vec![0; given]).map(|_| ()).expect_err("no row fits");
        assert_eq!(error, BufferError::Strip { of: "a strip of one row", needed: 480, given });
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
    assert_eq!(error, BufferError::Depth { needed: 256, given: 255 });
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
    assert_eq!(error, BufferError::TooManyItems { items: 65_536 });
    let mesh = Mesh::new(&CUBE, 0, &faces[1..]).expect("a mesh");
    assert!(camera.place(&mesh, &model).transform(&mut []).bin_faces(&mut bin_storage).is_ok());
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
        let (mut corners, mut bin_storage) = ([ScreenVertex::EMPTY; 8], [0; 17]);
        let projected = instance.transform(&mut corners);
        let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
        let mut good = Recorder::sized(64, 64);
        instance.faces(colour).draw(&mut good).expect("no error");
        for after in [0, 1, 20] {
            let mut bad = Recorder::failing(64, 64, after);
            assert_eq!(faces.draw(colour, &mut bad), Err(Refused(after)));
            bad = Recorder::sized(64, 64);
            faces.draw(colour, &mut bad).expect("no error");
            assert_eq!(luma(&bad), luma(&good));
        }
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
        let Ok(_) = instance.faces(shade).draw(&mut target.depth_tested(depth));
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
            let Ok(_) = chunk
                .faces(|face| shade(z as usize * 510 + face))
                .cached(&mut corners)
                .draw(&mut band.depth_tested(depth));
        }
    });
    assert!(picture == reference);

    // Binned once, with a cache of 300 vertices: the others are computed where a face needs them.
    let mut bin_storage = vec![0; instance.mesh().face_bins_len()];
    let projected = instance.transform_depth(&mut corners[..300]);
    let mut recorded = projected.bin_faces(&mut bin_storage).expect("room");
    let picture = bands(area, Gray8::BLACK, 16, &mut |band, depth| {
        let Ok(()) = recorded.draw(shade, &mut band.depth_tested(depth));
    });
    assert!(picture == reference);
    assert!(picture.iter().filter(|&&color| color != Gray8::BLACK).count() > 1000, "hardly anything is seen");
}

/// One unit is one pixel, with y up: faces and edges that only touch the viewport's borders from outside, which share no pixel with
/// it, do not count in the bounds.
#[test]
fn bounds_leave_out_what_ends_at_the_borders() {
    const SEEN: [[i16; 3]; 3] = [[20, -30, -5], [28, -30, -5], [20, -22, -5]];
    let camera = CameraBits::pixels((64, 48)).library();
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

/// A display that takes windows of bytes, and the transfer that may be under way.
struct Bus {
    area: Rectangle,
    /// The number that each pixel shows.
    pixels: Vec<u32>,
    sent: usize,
}

impl Bus {
    /// Each pixel of a row of whole bytes, by hand.
    fn receive<C: Color>(&mut self, window: &Rectangle, bytes: &[u8]) {
        let stride = (window.size.width * C::FORMAT.bits()).div_ceil(8) as usize;
        assert_eq!(bytes.len(), stride * window.size.height as usize);
        self.sent += bytes.len();
        for at in window.points() {
            let bit = (at.x - window.top_left.x) as usize * C::FORMAT.bits() as usize;
            let row = &bytes[(at.y - window.top_left.y) as usize * stride..][..stride];
            let bits = (0..C::FORMAT.bits() as usize)
                .fold(0, |all, i| all << 1 | u32::from(row[(bit + i) / 8] >> (7 - (bit + i) % 8) & 1));
            let index = (at.y - self.area.top_left.y) as u32 * self.area.size.width
                + (at.x - self.area.top_left.x) as u32;
            self.pixels[index as usize] = bits;
        }
    }
}

/// What pixel (x, y) of frame n shows.
fn pixel<C: Color>(at: Point, frame: i32) -> C {
    let bits = (at.x * 7 + at.y * 13 + frame * 5) as u32;
    C::from_bits(bits & (u32::MAX >> (32 - C::FORMAT.bits())))
}

fn frames_with_two_strips<C: Color>(area: Rectangle, bytes: usize) {
    let count = (area.size.width * area.size.height) as usize;
    let mut bus = Bus { area, pixels: vec![u32::MAX; count], sent: 0 };
    let [mut free, other] = [0; 2].map(|_| vec![0x55; bytes].leak());
    let mut busy = Some((Rectangle::zero(), other)); // an empty transfer
    let whole_rows = bytes - bytes % Frame::<C>::strip_bytes(area.size.width, 1);
    for number in 0..3 {
        let mut frame = Frame::new(area, pixel::<C>(Point::zero(), 0));
        free = loop {
            let mut band = match frame.band_or_strip(free).expect("room for a row") {
                Continue(band) => band,
                Break(strip) => break strip,
            };
            let window = band.area();
            let colors = window.points().map(|at| pixel::<C>(at, number));
            let Ok(()) = band.fill_contiguous(&window, colors);
            let (window, drawn) = (band.area(), band.into_bytes());
            let (sent_window, sent) = busy.take().expect("a transfer");
            if !sent_window.is_zero_sized() {
                bus.receive::<C>(&sent_window, sent);
            }
            busy = Some((window, drawn));
            free = sent;
        };
        let (window, last) = busy.take().expect("a transfer");
        bus.receive::<C>(&window, last);
        busy = Some((Rectangle::zero(), last));
        let shown = area.points().zip(&bus.pixels);
        for (at, &bits) in shown {
            assert!(
                C::from_bits(bits) == pixel::<C>(at, number),
                "{at} of frame {number}, strips of {bytes}"
            );
        }
    }
    if whole_rows <= Frame::<C>::strip_bytes(area.size.width, area.size.height) {
        let lengths = [free.len(), busy.expect("a transfer").1.len()];
        assert!(lengths.iter().all(|&length| length >= whole_rows), "{lengths:?} of {bytes}");
    }
}

#[test]
fn frames_of_any_height_leave_the_strips_as_long_as_they_were() {
    for height in 1..14 {
        for rows in 1..7 {
            for extra in [0, 1, 3] {
                let area = rectangle(-3, 5, 11, height);
                frames_with_two_strips::<Gray8>(area, 11 * rows + extra);
                frames_with_two_strips::<Rgb565>(area, 22 * rows + extra);
                frames_with_two_strips::<BinaryColor>(area, 2 * rows + extra.min(1));
            }
        }
    }
}

/// Only where the strip is longer than the frame, or the rows do not divide the height, a row is sent twice.
#[test]
fn no_row_is_sent_twice_where_the_strip_divides_the_frame() {
    let mut strip: &mut [u8] = &mut [0; 8 * 4];
    let mut frame = Frame::new(rectangle(0, 0, 8, 12), Gray8::BLACK);
    let mut tops = Vec::new();
    while let Continue(band) = frame.band_or_strip(strip).expect("room") {
        tops.push(band.area().rows());
        (strip, _) = band.into_strip();
        assert_eq!(strip.len(), 32);
    }
    assert_eq!(tops, [0..4, 4..8, 8..12]);
    let mut frame = Frame::new(rectangle(0, 0, 8, 12), Gray8::BLACK);
    assert_eq!(
        frame.band_or_strip(&mut [0; 7]).err(),
        Some(BufferError::Strip { of: "a strip of one row", needed: 8, given: 7 })
    );
    for empty in [rectangle(0, 0, 0, 5), rectangle(0, 0, 5, 0)] {
        let mut strip = [0; 3];
        let given =
            Frame::new(empty, Gray8::BLACK).band_or_strip(&mut strip).expect("nothing to hold").break_value();
        assert_eq!(given.map(|strip| strip.len()), Some(3));
    }
}

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(60, 40));

/// An object: filled with its shade.
#[derive(Clone, Copy)]
struct Object {
    shade: u8,
    area: Rectangle,
    is_shown: bool,
}

fn draw_objects(objects: &[Object], target: &mut impl DrawTarget<Color = Gray8, Error = Infallible>) {
    for object in objects.iter().filter(|object| object.is_shown) {
        let Ok(()) = target.fill_solid(&object.area.intersection(&SCREEN), Gray8::new(object.shade));
    }
}

/// Tracked objects: what a display shows equals the frame drawn anew, and nothing is sent while nothing changes.
#[test]
fn the_display_shows_the_frame_and_receives_nothing_while_nothing_changes() {
    let mut rng = Rng::new(0x7a);
    let (mut quiet, mut busy, mut erased) = (0, 0, 0);
    for _ in 0..40 {
        let mut dirty =
            DirtyRegions::<5>::new(SCREEN, TransferCost::new(Gray8::FORMAT.bits(), TransferCost::MIPI_DCS));
        let mut display = Screen::new(SCREEN);
        let mut tracked = [Tracked::new(); 4];
        let mut objects = [Object { shade: 9, area: Rectangle::zero(), is_shown: false }; 4];
        for frame in 0..60 {
            let mut is_changed = frame == 0;
            if rng.one_in(2) {
                let object = &mut objects[rng.below(4)];
                match rng.below(4) {
                    0 => object.is_shown = !object.is_shown,
                    1 => object.shade = object.shade.wrapping_add(1),
                    _ => {
                        let [x, y] = [rng.int(-20, 70), rng.int(-20, 50)].map(|v| v as i32);
                        let [width, height] = [0; 2].map(|_| rng.int(0, 25) as u32);
                        object.area = rectangle(x, y, width, height);
                    }
                }
                is_changed = true;
            }
            for (tracked, object) in tracked.iter_mut().zip(&objects) {
                match object.is_shown {
                    true => tracked.show(object.shade, object.area, &mut dirty),
                    false => tracked.hide(&mut dirty),
                }
            }
            display.counts.fill(0);
            for area in dirty.take() {
                let mut strip = [0; 400];
                let mut frame = Frame::new(area, Gray8::BLACK);
                while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
                    draw_objects(&objects, &mut band);
                    let Ok(()) = band.send(&mut display);
                }
            }
            let mut whole = Screen::new(SCREEN);
            draw_objects(&objects, &mut whole);
            assert!(display.over(Gray8::WHITE) == whole.over(Gray8::BLACK), "frame {frame}");
            let received = display.counts.iter().sum::<u32>();
            match is_changed {
                true => busy += usize::from(received > 0),
                false => {
                    assert_eq!(received, 0, "frame {frame}");
                    quiet += 1;
                }
            }
            erased += usize::from(frame > 0 && received > 0 && objects.iter().all(|o| !o.is_shown));
        }
    }
    assert!(quiet > 500 && busy > 300 && erased > 5, "{quiet} {busy} {erased}");
}

/// Draws bands by lists of active faces on one core or on two in turns, and compares each with the picture of one piece. `order`: the
/// numbers of the bands, and their columns.
fn in_any_order(instance: &MeshInstance<'_>, rows: u32, length: usize, order: &[(u32, i32, u32)]) {
    let [mut cache, mut deep_cache] = [(); 2].map(|()| vec![ScreenVertex::EMPTY; 600]);
    let [mut bins, mut deep_bins, mut cursor, mut deep_cursor] = [(); 4].map(|()| vec![0; 600]);
    let [mut list, mut other] = [(); 2].map(|()| vec![ActiveFace::EMPTY; length]);
    let [mut deep_list, mut deep_other] = [(); 2].map(|()| vec![ActiveFace::EMPTY; length]);
    let mesh = instance.transform_depth(&mut deep_cache);
    let mut deep = mesh.bin_faces(&mut deep_bins).expect("room");
    let [one, two] = deep.fork(&mut deep_cursor).expect("room");
    let mut deep = [one.with_active_faces(&mut deep_list), two.with_active_faces(&mut deep_other)];
    let mesh = instance.transform(&mut cache);
    let mut solid = mesh.bin_faces(&mut bins).expect("room");
    let [one, two] = solid.fork(&mut cursor).expect("room");
    let mut solid = [one.with_active_faces(&mut list), two.with_active_faces(&mut other)];
    for (at, &(number, left, width)) in order.iter().enumerate() {
        let area = rectangle(left, (number * rows) as i32, width, rows);
        let core = at % (1 + length % 2);
        let wanted = memory_with(area, area, Gray8::BLACK, &mut |target, depth| {
            let Ok(_) = instance.faces(colour).draw(&mut target.depth_tested(depth));
        });
        let found = memory_with(area, area, Gray8::BLACK, &mut |target, depth| {
            let Ok(()) = deep[core].draw(colour, &mut target.depth_tested(depth));
        });
        assert!(found == wanted, "band {number} of {rows} rows, {length} entries, {order:?}");
        let wanted = memory(area, Gray8::BLACK, &mut |target, _| {
            let Ok(_) = instance.faces(colour).draw(target);
        });
        let found = memory(area, Gray8::BLACK, &mut |target, _| {
            let Ok(()) = solid[core].draw(colour, target);
        });
        assert!(found == wanted, "band {number} of {rows} rows without depth, {length} entries, {order:?}");
    }
}

/// Faces in fog, whose colours depend on their depth, are the same with a list as without.
#[test]
fn active_faces_are_in_fog() {
    let torus = torus(20, 10);
    let mesh = Mesh::new(&torus.vertices, torus.exponent, &torus.faces).expect("a mesh");
    let (camera, all) = (cube_camera((0, 0, 64, 64)).library(), rectangle(0, 0, 64, 64));
    for turn in 0..8 {
        let instance = camera.place(&mesh, &ModelBits(vec![Step::Y(turn << 29)]).library());
        let fog = Fog::new(Scalar::from_int(1), Scalar::from_int(8)).expect("a fog");
        let fog = FogTable::new(&fog, &camera, Gray8::new(99)).expect("a table");
        let shade = |face| Fogged::new(colour(face), &fog);
        let (wanted, _) = memory_with(all, all, Gray8::BLACK, &mut |target, depth| {
            let Ok(_) = instance.faces(shade).draw(&mut target.depth_tested(depth));
        });
        let (mut cache, mut bins) = (vec![ScreenVertex::EMPTY; 200], vec![0; mesh.face_bins_len()]);
        let (mesh, mut list) = (instance.transform_depth(&mut cache), vec![ActiveFace::EMPTY; 99]);
        let mut faces = mesh.bin_faces(&mut bins).expect("room").with_active_faces(&mut list);
        let found = bands(all, Gray8::BLACK, 4, &mut |band, depth| {
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(depth));
        });
        assert!(found == wanted, "turn {turn}");
    }
}

/// A face that is carried is not shaded again, and one that finds no entry is.
#[test]
fn carried_faces_are_shaded_once() {
    let torus = torus(20, 10);
    let mesh = Mesh::new(&torus.vertices, torus.exponent, &torus.faces).expect("a mesh");
    let model = ModelBits(vec![Step::Y(1 << 29)]).library();
    let instance = cube_camera((0, 0, 64, 64)).library().place(&mesh, &model);
    let shaded = [0, 5, 100].map(|length| {
        let (mut cache, mut bins) = (vec![ScreenVertex::EMPTY; 200], vec![0; mesh.face_bins_len()]);
        let (mesh, mut list) = (instance.transform_depth(&mut cache), vec![ActiveFace::EMPTY; length]);
        let (faces, mut calls) = (mesh.bin_faces(&mut bins).expect("room"), 0);
        let mut faces = faces.with_active_faces(&mut list);
        bands(rectangle(0, 0, 64, 64), Gray8::BLACK, 4, &mut |band, depth| {
            let shade = |face| {
                calls += 1;
                colour(face)
            };
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(depth));
        });
        calls
    });
    // Fewer calls with each longer list.
    assert!(shaded.is_sorted_by(|before, after| before > after) || cfg!(pinhole_plain), "{shaded:?}");
}

/// Faces that continue from band to band, in bands from top to bottom, from bottom to top, twice each, every second one, and in columns
/// that change: from near by, where many faces are cut, and from afar.
#[test]
fn active_faces_show_one_piece_in_bands_of_any_order() {
    const SIDE: u32 = 64;
    let torus = torus(20, 10);
    let mesh = Mesh::new(&torus.vertices, torus.exponent, &torus.faces).expect("a mesh");
    let mut rng = Rng::new(19);
    for (case, rows) in [1, 2, 3, 5, 8, 13, 30].into_iter().cycle().take(28).enumerate() {
        let model = ModelBits(vec![Step::Y(rng.bits()), Step::X(rng.bits())]);
        let camera = cube_camera((0, 0, SIDE, SIDE)).library();
        let model = model.library();
        let instance = camera.place(&mesh, &model);
        let numbers: Vec<u32> = (0..SIDE.div_ceil(rows)).collect();
        let all = |number: &u32| (*number, 0, SIDE);
        let twice = |number: &u32| [all(number), all(number)];
        let order: Vec<(u32, i32, u32)> = match case % 6 {
            0 => numbers.iter().map(all).collect(),
            1 => numbers.iter().rev().map(all).collect(),
            2 => numbers.iter().flat_map(twice).collect(),
            3 => numbers.iter().step_by(2).map(all).collect(),
            4 => numbers.iter().map(|&number| (number, 10 * (number as i32 / 3 % 3), 40)).collect(),
            _ => numbers.iter().map(|_| all(&numbers[rng.below(numbers.len())])).collect(),
        };
        for length in [0, 1, 7, 100] {
            in_any_order(&instance, rows, length, &order);
        }
    }
}

/// Faces of 20 to 29 rows, which are carried over many bands: their middle corners lie anywhere, or in the first rows.
#[test]
fn tall_carried_faces_show_one_piece() {
    const SIDE: u32 = 64;
    let (mut rng, camera) = (Rng::new(20), flat_camera((SIDE, SIDE), 1, 8).library());
    for (rows, round) in (1..=8).flat_map(|rows| (0..8).map(move |round| (rows, round))) {
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        for face in 0..8 {
            // In 1/256 pixel, counted from the lower border.
            let (height, left) = (rng.int(20 << 8, 29 << 8), rng.int(0, 32 << 8));
            let top = rng.int(height, 63 << 8);
            let middle = rng.int(0, [height, 512][face % 2]);
            let mut corner = |down| [left + rng.int(0, 31 << 8), top - down, rng.int(-1024, 1024)];
            vertices.extend([0, middle, height].map(|down| corner(down).map(|c| c as i16)));
            faces.push([0, 1, 2].map(|corner| 3 * face as u16 + corner));
        }
        let mesh = Mesh::new(&vertices, -8, &faces).expect("a mesh");
        let order: Vec<_> = (0..SIDE.div_ceil(rows)).map(|number| (number, 0, SIDE)).collect();
        let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None);
        in_any_order(&instance, rows, [3, 8][round % 2], &order);
    }
}
