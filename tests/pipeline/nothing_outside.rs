//! A DrawTarget that the library does not know: its errors are returned unchanged from every call, and every pixel is drawn
//! by a fill. That nothing is written outside viewport ∩ target is case E9 of `hard_cases`.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, IntoStorage, Rgb565, Rgb888, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::Span;
use pinhole::{
    prelude::*,
    target::{BufferError, Memory, Pixels},
};
use support::bridge::draw::{cube_camera as camera, turned_cube as draw, CUBE, CUBE_FACES, WAYS};
use support::bridge::pair::ModelBits;
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder, Refused};

#[test]
fn an_error_of_the_target_is_returned_from_every_call() {
    let camera = camera((0, 0, 40, 30));
    for way in WAYS {
        let mut whole = Recorder::sized(40, 30);
        draw(way, &camera, &mut whole).expect("no error");
        let calls = whole.calls.len();
        assert!(calls > 10, "{way:?}");
        // Every pixel is drawn by a fill.
        let is_fill = |call: &Call<_>| match *call {
            Call::Solid(area, _) => area.size.width >= 1 && area.size.height >= 1,
            Call::Contiguous(area, n) => area.size.width as usize * area.size.height as usize == n,
            _ => false,
        };
        assert!(whole.calls.iter().all(is_fill), "{way:?}: {:?}", whole.calls);
        for n in 0..calls {
            let mut target = Recorder::failing(40, 30, n);
            assert_eq!(draw(way, &camera, &mut target).err(), Some(Refused(n)), "{way:?}");
            // Drawing stops at the error, and the calls before it are unchanged.
            assert_eq!(target.calls, whole.calls[..=n], "{way:?}");
        }
        let mut target = Recorder::failing(40, 30, calls);
        assert!(draw(way, &camera, &mut target).is_ok());
    }
}

/// Filling rectangles at the ends of their range in a picture and in a band changes each pixel inside and no other.
#[test]
fn rectangles_of_any_position_and_size_are_filled() {
    let (old, new) = (Gray8::new(9), Gray8::new(200));
    let mut rng = Rng::new(0x3F);
    const GIVEN: i64 = 3000;
    let (mut met, mut met_by_each) = (0, 0);
    for _ in 0..20_000 {
        let size = Size::new(1 + rng.below(20) as u32, 1 + rng.below(20) as u32);
        let mut place = || match rng.below(6) {
            0 => i32::MIN + rng.below(40) as i32,
            1 => i32::MAX - rng.below(40) as i32,
            _ => rng.int(-30, 30) as i32,
        };
        let at = Point::new(place(), place());
        let mut extent = || match rng.below(5) {
            0 => u32::MAX - rng.below(40) as u32,
            1 => (1 << 31) + rng.below(40) as u32,
            _ => rng.below(50) as u32,
        };
        let area = Rectangle::new(at, Size::new(extent(), extent()));
        let holds = |x: i32, y: i32| {
            let along = |p: i32, from: i32, extent: u32| {
                (0..i64::from(extent)).contains(&(i64::from(p) - i64::from(from)))
            };
            along(x, at.x, area.size.width) && along(y, at.y, area.size.height)
        };
        let mut memory = vec![old; (size.width * size.height) as usize];
        let mut strip = vec![old.luma(); memory.len()];
        let Ok(()) = Picture::new(&mut memory, size).expect("room").fill_solid(&area, new);
        let mut frame = Frame::new(Rectangle::new(Point::zero(), size), old);
        let mut band = frame.next_band(&mut strip).expect("room").expect("rows");
        let Ok(()) = band.fill_solid(&area, new);
        let solid: Vec<Gray8> = band.colors().collect();
        // A colour for each pixel of the rectangle, row by row; fewer leave the rest as it was.
        let nth = |n: i64| Gray8::new((n % 199) as u8);
        let Ok(()) = band.fill_contiguous(&area, (0..GIVEN).map(nth));
        for (i, (picture, (solid, each))) in
            memory.into_iter().zip(solid.into_iter().zip(band.colors())).enumerate()
        {
            let [x, y] = [i as u32 % size.width, i as u32 / size.width].map(|p| p as i32);
            let wanted = if holds(x, y) { new } else { old };
            assert_eq!((picture, solid), (wanted, wanted), "({x}, {y}) of {size:?}: {area:?}");
            met += usize::from(wanted == new);
            let [column, row] = [(x, at.x), (y, at.y)].map(|(p, from)| i64::from(p) - i64::from(from));
            let place = row.checked_mul(area.size.width.into()).and_then(|start| start.checked_add(column));
            let given = place.filter(|n| holds(x, y) && (0..GIVEN).contains(n));
            assert_eq!(each, given.map_or(solid, nth), "({x}, {y}) of {size:?}: {area:?}");
            met_by_each += usize::from(given.is_some());
        }
    }
    assert!(met > 100_000 && met_by_each > 10_000, "{met}, {met_by_each}");
}

/// A target of this test's own whose pixels lie in memory, as numbers.
struct Numbers<'a>(Pixels<'a, Rgb565, u16>);

impl<'a> Surface for Numbers<'a> {
    type Color = Rgb565;
    type Error = Infallible;
    type Store = &'a mut [u16];

    fn area(&self) -> Rectangle {
        self.0.area()
    }

    fn fill(&mut self, span: Span, color: Rgb565) -> Result<(), Infallible> {
        self.0.fill(span, color)
    }

    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Rgb565>) -> Result<(), Infallible> {
        self.0.fill_run(span, colors)
    }

    fn memory(&mut self) -> Option<&mut Memory<&'a mut [u16]>> {
        self.0.memory()
    }
}

/// Draws a cube in every way, with and without depth.
fn cubes<T: Surface<Color = Rgb565>>(target: &mut T) {
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let (model, camera) = (ModelBits::default().library(), camera((0, 0, 40, 30)).library());
    let instance = camera.place(&mesh, &model);
    let table = ShadeTable::new(Rgb888::CSS_GOLD);
    let smooth = |face| table.lit([10 * face as u16, 200, 256]);
    let solid = |face| Rgb565::new(face as u8 + 1, 9, 9);
    let _ = instance.faces(solid).draw(target);
    let _ = instance.faces(|face| Gouraud::lit(Rgb888::CSS_CORAL, [10 * face as u16, 200, 256])).draw(target);
    let mut depths = [0; 40 * 30];
    let mut depth = DepthBuffer::new(target.area(), &mut depths).expect("as many numbers");
    let _ = instance.faces(solid).draw(&mut target.depth_tested(&mut depth));
    depth.clear();
    let _ = instance.faces(smooth).draw(&mut target.depth_tested(&mut depth));
    let _ = instance.edges(|_| Rgb565::CSS_WHITE).draw(target);
}

#[test]
fn a_target_of_ones_own_gets_the_picture() {
    let area = Rectangle::new(Point::zero(), Size::new(40, 30));
    let mut colors = [Rgb565::CSS_BLACK; 40 * 30];
    let mut frames = [[0_u16; 40 * 30]; 2];
    cubes(&mut Picture::new(&mut colors, area.size).expect("as many colors"));
    let [pixels, numbers] = &mut frames;
    cubes(&mut Pixels::new(pixels, area).expect("as many cells"));
    cubes(&mut Numbers(Pixels::new(numbers, area).expect("as many cells")));
    let wanted = colors.map(IntoStorage::into_storage);
    assert!(frames.iter().all(|frame| *frame == wanted));
    assert!(wanted.iter().filter(|color| **color != 0).count() > 100);
}

/// A framebuffer that is wider than the picture, with a depth buffer of the picture alone: a pixel's index differs between them.
#[test]
fn rows_of_pixels_may_be_farther_apart_than_those_of_depths() {
    const AREA: Rectangle = Rectangle::new(Point::new(3, 2), Size::new(40, 30));
    fn paint(
        instance: &MeshInstance<'_>,
        shader: usize,
        target: &mut Pixels<'_, Rgb565, u16>,
        depth: &mut DepthBuffer<'_>,
    ) {
        let color = |face: usize| Rgb888::new((face % 16) as u8 * 16, 200, (face / 16 % 32) as u8 * 8);
        let levels = |face: usize| [10 * (face as u16 % 20), 200, 256];
        let table = ShadeTable::new(Rgb888::CSS_GOLD);
        let target = &mut target.depth_tested(depth);
        let Ok(statistics) = match shader {
            0 => instance.faces(|face| Rgb565::from(color(face))).draw(target),
            1 => instance.faces(|face| Dithered(Flat::from(color(face)))).draw(target),
            2 => instance.faces(|face| Gouraud::lit(color(face), levels(face))).draw(target),
            _ => instance.faces(|face| table.lit(levels(face))).draw(target),
        };
        assert!(statistics.drawn > 2);
    }
    let viewport = Viewport::new(AREA.top_left, AREA.size).expect("a small viewport");
    for mesh in [pinhole::meshes::CUBE, pinhole::meshes::TORUS] {
        let (sphere, angle) = (mesh.bounding_sphere(), pinhole::Angle::degrees(30));
        let camera = Camera::framing(&sphere, &viewport, angle, angle, angle).expect("a radius");
        let instance = camera.place(&mesh, &Affine::identity());
        for shader in 0..4 {
            let (mut cells, mut depths) = ([0_u16; 40 * 30], [0; 40 * 30]);
            let mut depth = DepthBuffer::new(AREA, &mut depths).expect("as many numbers");
            paint(&instance, shader, &mut Pixels::new(&mut cells, AREA).expect("as many cells"), &mut depth);
            let (mut apart, mut other) = ([0_u16; 47 * 30], [0; 40 * 30]);
            let mut depth = DepthBuffer::new(AREA, &mut other).expect("as many numbers");
            let mut target = Pixels::with_stride(&mut apart, AREA, 47).expect("as many cells");
            paint(&instance, shader, &mut target, &mut depth);
            assert!(other == depths, "depths of shader {shader}");
            let rows = apart.chunks(47).zip(cells.chunks(40));
            for (apart, row) in rows {
                assert!(apart[..40] == *row && apart[40..] == [0; 7], "shader {shader}");
            }
        }
    }
}

#[test]
fn too_few_cells_for_the_area_are_refused() {
    let area = Rectangle::new(Point::zero(), Size::new(40, 30));
    let error = Pixels::<Rgb565, u16>::new(&mut [0; 1199], area).map(|_| ()).expect_err("one too few");
    assert_eq!(error, BufferError::Picture { needed: 1200, given: 1199 });
    let last = 50 * 29 + 40;
    let apart = |cells: &mut [u16]| Pixels::<Rgb565, u16>::with_stride(cells, area, 50).map(|_| ());
    assert_eq!(apart(&mut vec![0; last]), Ok(()));
    let error = apart(&mut vec![0; last - 1]).expect_err("one too few");
    assert_eq!(error, BufferError::Picture { needed: 1490, given: 1489 });
    let huge = Rectangle::new(Point::zero(), Size::new(u32::MAX, u32::MAX));
    assert!(Pixels::<Rgb565, u16>::new(&mut [0; 9], huge).is_err());
}
