//! Films to send to a panel: the spinning cube S2 of the benchmarks, and a small moving cube before one that stands still. Three methods of
//! sending their frames, and the bytes that each takes; every frame on the panel is compared with the frame drawn in memory.

use super::screen::{Kind, Screen, StoredPixel};
use crate::oracle::target;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    bands::{DirtyRegions, TransferCost},
    draw::draw_line,
    meshes::CUBE,
    prelude::*,
    target::LeastRun,
    Angle,
};

/// The orientation of the cube of S2.
const ROTATION: [[f64; 4]; 4] = [
    [0.7986355, 0.0, 0.601815, 0.0],
    [0.282535, 0.8829476, -0.3749367, 0.0],
    [-0.5313711, 0.4694716, 0.7051533, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];
const DISTANCE: f32 = 4.1022;
const LIGHT: (f32, f32, f32) = (0.3999502, 0.5999253, 0.6929137);

pub const BACKGROUND: Rgb888 = Rgb888::new(16, 16, 32);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Film {
    /// The cube spins about an axis of the world, with this many frames per turn.
    Cube { axis: [i16; 3], turn: u32 },
    /// The cube stands still, and a small cube flies a figure eight before it.
    Small,
}

/// The number of frames of a film.
pub const FRAMES: u32 = 72;

/// An object of a frame.
pub struct Thing {
    instance: MeshInstance<'static>,
    light: Lambert,
    colour: Rgb888,
    moves: bool,
}

fn camera(size: Size) -> Camera {
    let number = |v| Scalar::from_f32(v).expect("in range");
    let eye = Point3::from_f32(0.0, 0.0, DISTANCE).expect("in range");
    let (back, up) = (Vector3::from_ints(0, 0, 1), Vector3::from_ints(0, 1, 0));
    Camera::new(
        &ViewTransform::from_reference(eye, back, up).expect("a view"),
        &Projection::perspective(Angle::degrees(60), size, number(0.5), number(20.0)).expect("a projection"),
        &Viewport::new(Point::zero(), size).expect("a viewport"),
    )
}

impl Film {
    /// The objects of a frame, the farther ones first.
    pub fn frame(self, size: Size, frame: u32) -> Vec<Thing> {
        let camera = camera(size);
        let thing = |model: Affine<Model, World>, colour, moves| {
            let (x, y, z) = LIGHT;
            let towards = Vector3::from_f32(x, y, z).expect("in range");
            let light = Lambert::new(&model, towards, 40).expect("a light");
            Thing { instance: camera.place(&CUBE, &model), light, colour, moves }
        };
        let stands = Affine::from_matrix(&ROTATION).expect("a rotation");
        let (green, red) = (Rgb888::new(90, 220, 140), Rgb888::new(250, 90, 60));
        match self {
            Film::Cube { axis: [x, y, z], turn } => {
                let angle = Angle::turns(frame as i32, turn);
                let spin = Affine::rotation(Point3::from_ints(0, 0, 0), Vector3::from_ints(x, y, z), angle);
                vec![thing(stands.then(&spin.expect("an axis")), green, true)]
            }
            Film::Small => {
                let turn = |number: i32| Angle::turns(number * frame as i32, FRAMES);
                let sine = |angle: Angle| f64::from(angle.sin_cos().0) / f64::from(1 << 30);
                let place = [1.1 * sine(turn(1)), 0.8 * sine(turn(2)), 2.0];
                let mut matrix = [[0.0; 4]; 4];
                for (i, row) in matrix.iter_mut().enumerate().take(3) {
                    row[i] = 0.1;
                    row[3] = place[i];
                }
                matrix[3][3] = 1.0;
                let fly = Affine::<World, World>::from_matrix(&matrix).expect("a place");
                let small = Affine::<Model, World>::rotation_x(turn(3)).then(&fly);
                vec![thing(stands, green, false), thing(small, red, true)]
            }
        }
    }
}

/// Memory for the vertices and faces of an object.
type Store = ([ScreenVertex; CUBE.vertices().len()], [u16; CUBE.face_bins_len()]);
const STORE: Store = ([ScreenVertex::EMPTY; CUBE.vertices().len()], [0; CUBE.face_bins_len()]);

impl Thing {
    fn colour<C: Color + From<Rgb888>>(&self, face: usize) -> C {
        C::from(self.colour).dim(self.light.level(CUBE.normals()[face]))
    }

    /// Draws the object at once, onto any target.
    pub fn draw<D: DrawTarget<Color: Color + From<Rgb888>>>(&self, target: &mut D) -> Result<(), D::Error> {
        self.instance.faces(|face| self.colour::<D::Color>(face)).draw(target).map(|_| ())
    }

    /// The rectangle that the object covers.
    fn bounds(&self) -> Rectangle {
        let (mut cache, mut bins) = STORE;
        self.instance.transform(&mut cache).bin_faces(&mut bins).expect("room for all faces").bounds()
    }
}

/// A colour with all traits that these functions need.
pub trait Colour: Color + StoredPixel + From<Rgb888> {}
impl<C: Color + StoredPixel + From<Rgb888>> Colour for C {}

/// Memory for `rows` rows.
pub fn strip<C: Color>(width: u32, rows: u32) -> Vec<u8> {
    vec![0; Frame::<C>::strip_bytes(width, rows)]
}

/// A part of a frame, in bands as high as the strip has room for.
pub fn in_bands<D: DrawTarget<Color: Colour>>(
    things: &[Thing],
    area: Rectangle,
    strip: &mut [u8],
    target: &mut D,
) -> Result<(), D::Error> {
    let mut stores = vec![STORE; things.len()];
    let mut binned = Vec::new();
    for (thing, (cache, bins)) in things.iter().zip(&mut stores) {
        binned.push((thing, thing.instance.transform(cache).bin_faces(bins).expect("room for all faces")));
    }
    let mut frame = Frame::new(area, D::Color::from(BACKGROUND));
    while let Some(mut band) = frame.next_band(strip).expect("a strip of a row or more") {
        for (thing, faces) in &mut binned {
            let Ok(()) = faces.draw(|face| thing.colour::<D::Color>(face), &mut band);
        }
        band.send(target)?;
    }
    Ok(())
}

/// The tracker of the regions of a frame that changed.
pub fn dirty<C: Color>(area: Rectangle) -> DirtyRegions<4> {
    DirtyRegions::new(area, TransferCost::new(C::FORMAT.bits(), TransferCost::MIPI_DCS))
}

/// The rectangles of moving objects: where they were and where they are.
pub fn changes<D: DrawTarget<Color: Colour>>(
    things: &[Thing],
    dirty: &mut DirtyRegions<4>,
    strip: &mut [u8],
    target: &mut D,
) -> Result<(), D::Error> {
    things.iter().filter(|thing| thing.moves).for_each(|thing| dirty.mark(thing.bounds()));
    dirty.take().iter().try_for_each(|area| in_bands(things, *area, strip, target))
}

/// Draws directly onto the panel: clears it, then sends each span.
pub fn in_spans<D: DrawTarget<Color: Colour>>(things: &[Thing], target: &mut D) -> Result<(), D::Error> {
    target.clear(BACKGROUND.into())?;
    things.iter().try_for_each(|thing| thing.draw(target))
}

/// The pixels of a frame, drawn in memory at once.
pub fn reference<C: Colour>(things: &[Thing], size: Size) -> Vec<C> {
    let mut picture = target::Screen::sized(size.width, size.height);
    for thing in things {
        let Ok(()) = thing.draw(&mut picture);
    }
    picture.over(C::from(BACKGROUND))
}

impl<M: Kind<ColorFormat: Colour>> Screen<M> {
    /// The panel shows a picture, to the pixel.
    #[track_caller]
    pub fn assert_shows(&self, picture: &[M::ColorFormat], what: impl core::fmt::Debug) {
        let differing = self.picture().iter().zip(picture).filter(|(a, b)| **a != b.stored()).count();
        assert_eq!(differing, 0, "{}: pixels of {what:?}", M::NAME);
    }
}

/// The bytes of the pixels of an area.
pub fn pixel_bytes<C: Color>(size: Size) -> usize {
    size.width as usize * size.height as usize * C::FORMAT.bits() as usize / 8
}

/// The size of the smallest rectangle that contains the pixels that differ.
fn difference<C: PixelColor>(size: Size, a: &[C], b: &[C]) -> Size {
    let points = Rectangle::new(Point::zero(), size).points().zip(a.iter().zip(b));
    let differing = points.filter(|(_, (a, b))| a != b).map(|(at, _)| (at, at));
    let ends = differing.reduce(|(low, high), (at, _)| (low.component_min(at), high.component_max(at)));
    ends.map_or(Size::zero(), |(low, high)| Rectangle::with_corners(low, high).size)
}

/// How frames are sent.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    /// All of every frame.
    Bands,
    DirtyRegions,
    Spans,
}

/// The number of rows of a band, which is as wide as the panel.
pub const ROWS: u32 = 8;

/// The traffic of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    pub bytes: usize,
    pub windows: usize,
    /// The bytes of the pixels of the smallest rectangle that contains all changes.
    pub changed: usize,
}

/// The traffic of each frame of a film after the first. Asserts that the panel shows the reference after every frame.
pub fn film<M: Kind<ColorFormat: Colour>>(film: Film, frames: u32, way: Way) -> Vec<Cost> {
    let mut screen = Screen::<M>::new();
    let area = screen.display.bounding_box();
    let mut dirty = dirty::<M::ColorFormat>(area);
    let mut strip = strip::<M::ColorFormat>(M::SIZE.width, ROWS);
    let (mut last, mut costs) = (None::<Vec<_>>, Vec::new());
    for frame in 0..frames {
        let things = film.frame(M::SIZE, frame);
        let display = &mut screen.display;
        let sent = match way {
            Way::Bands => in_bands(&things, area, &mut strip, display),
            Way::DirtyRegions => changes(&things, &mut dirty, &mut strip, display),
            Way::Spans => in_spans(&things, display),
        };
        sent.expect("a bus that works");
        let picture = reference(&things, M::SIZE);
        screen.assert_shows(&picture, (film, frame, way));
        let (bytes, windows) = screen.count();
        if let Some(last) = &last {
            let changed = pixel_bytes::<M::ColorFormat>(difference(M::SIZE, last, &picture));
            costs.push(Cost { bytes, windows, changed });
        }
        last = Some(picture);
    }
    assert_eq!(screen.panel.controller().cut_off, 0);
    costs
}

/// The ends of lines from the middle of a panel to every eighth point of its border: every direction.
pub fn lines(size: Size) -> Vec<[Point; 2]> {
    let (width, height) = (size.width as i32, size.height as i32);
    let across = (0..width).step_by(8).flat_map(|x| [(x, 0), (x, height - 1)]);
    let down = (8..height - 1).step_by(8).flat_map(|y| [(0, y), (width - 1, y)]);
    let middle = Point::new(width / 2, height / 2);
    across.chain(down).map(|(x, y)| [middle, Point::new(x, y)]).collect()
}

/// The bytes and windows of [`lines`], drawn with this [`LEAST_RUN`](pinhole::target::Surface::LEAST_RUN). Asserts that the panel shows
/// them.
pub fn line_traffic<M: Kind<ColorFormat: Colour>, const LEAST_RUN: u16>() -> (usize, usize) {
    let (mut screen, background, ink) =
        (Screen::<M>::new(), BACKGROUND.into(), M::ColorFormat::from(Rgb888::WHITE));
    let mut picture = target::Screen::sized(M::SIZE.width, M::SIZE.height);
    screen.display.clear(background).expect("a bus that works");
    screen.count();
    for [from, to] in lines(M::SIZE) {
        draw_line(from, to, ink, &mut LeastRun::<_, LEAST_RUN>(&mut screen.display))
            .expect("a bus that works");
        let Ok(()) = draw_line(from, to, ink, &mut picture);
    }
    screen.assert_shows(&picture.over(background), "lines");
    screen.count()
}

/// The sum over all frames.
pub fn sum(costs: &[Cost]) -> Cost {
    costs.iter().fold(Cost::default(), |sum, cost| Cost {
        bytes: sum.bytes + cost.bytes,
        windows: sum.windows + cost.windows,
        changed: sum.changed + cost.changed,
    })
}
