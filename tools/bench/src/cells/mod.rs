//! The cells: scenes drawn in some variants, each by a firmware of its own with no more memory than the scene takes.

mod banded;
mod foggy;
mod memory;
mod moving;
mod screen;
mod sprites;
mod stepped;
mod textured;
mod ways;

pub use banded::{LineStrip8, Strip16, Strip16Deep, Strip8, Strip8Deep, Strip8DeepIco};
pub use memory::{Deep, Frame, Plain, Smooth};
pub use screen::Screen;

use crate::board::{println, Clock};
use crate::lists::{COLOURS, LINES, SCREEN, TORUS_EDGES, TRIANGLES};
use crate::scene::{self, Model, BACKGROUND, LINE, SIZE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{AntiAliased, Blended, HalfBlended, Mesh, WithPlanes};
use textured::{Each, Eighth, Every16, Sixteenth, X2, X3, X4};
use ways::{picture, screen as dt};

/// The picture that cells are drawn into; its size is unknown to the compiler.
pub type Picture<'p> = pinhole::Picture<'p, Rgb565>;

/// The result of a cell.
#[derive(Clone, Copy)]
pub struct Counted {
    pub instructions: u32,
    /// CRC-32 of the pixels as little-endian numbers.
    pub crc: u32,
    /// Pixels that are not the background's.
    pub drawn: usize,
}

/// The most vertices of a scene: of the cube, of the torus and of the icosphere.
pub const CUBE: usize = 8;
pub const TORUS: usize = 500;
pub const ICO: usize = 2892;

/// The torus with its edges alone, for wireframes, and from so near that parts of it lie behind the camera, and others beyond the
/// borders of the picture: with the eye at 0.8 from its centre, where the near plane at 0.5 cuts it, and at 1.2. It reaches 1.42.
static TORUS_EDGED: Model = edged(&scene::TORUS, &TORUS_EDGES);
const NEAR: i32 = 52_429;
const FARTHER: i32 = 78_643;
static C1: Model = at(&scene::TORUS, NEAR);
static C2: Model = at(&scene::TORUS, FARTHER);
static C1_PLANES: Model<WithPlanes> = at(&scene::TORUS_BY_PLANES, NEAR);
static C2_PLANES: Model<WithPlanes> = at(&scene::TORUS_BY_PLANES, FARTHER);
static C1_EDGED: Model = at(&TORUS_EDGED, NEAR);
static C2_EDGED: Model = at(&TORUS_EDGED, FARTHER);

/// At compile time: without normals.
const fn edged(model: &Model, edges: &'static [[u16; 2]]) -> Model {
    let Model { mesh, axes, distance } = model;
    let Ok(mesh) = Mesh::new(mesh.vertices(), mesh.exponent(), mesh.faces()) else { panic!("faces") };
    let Ok(mesh) = mesh.with_edges(edges) else { panic!("edges") };
    Model { mesh, axes: *axes, distance: *distance }
}

const fn at<P>(model: &Model<P>, distance: i32) -> Model<P> {
    let Model { mesh, axes, .. } = model;
    Model { mesh: *mesh, axes: *axes, distance }
}

/// A cell's firmware, by the cell's number in the list.
pub struct Image<const N: usize>;

pub trait Cell {
    type Memory;
    fn draw(memory: &mut Self::Memory) -> Option<Counted>;
}

/// Scene, variant, and how it is drawn on the host.
#[cfg(not(target_os = "none"))]
pub type Known = (&'static str, &'static str, fn() -> Option<Counted>);

macro_rules! cells {
    ($($scene:literal $variant:literal: $memory:ty, |$of:ident| $draw:expr;)*) => {
        const NAMES: &[[&str; 2]] = &[$([$scene, $variant]),*];

        $(impl Cell for Image<{ number($scene, $variant) }> {
            type Memory = $memory;

            #[inline(always)] // as if the firmware called the function itself
            fn draw($of: &mut $memory) -> Option<Counted> {
                $draw
            }
        })*

        /// The cells on the host.
        #[cfg(not(target_os = "none"))]
        pub const CELLS: &[Known] = &[$(($scene, $variant, || {
            let $of = &mut *Box::<$memory>::new(<$memory>::NEW);
            $draw
        })),*];
    };
}

cells! {
    // The start, the count of a frame in which nothing is drawn, and the end: in every cell.
    "empty" "plain": Frame, |m| count(m, &mut |_| Some(()));
    // S1: the cube's edges. S2: the cube, a colour for each face.
    "S1" "plain": Plain<CUBE>, |m| picture::wire(&scene::CUBE, LINE, m);
    "S2" "plain": Plain<CUBE>, |m| picture::flat(&scene::CUBE, m);
    "S2" "z": Deep<CUBE>, |m| picture::flat_z(&scene::CUBE, m);
    // S3: the torus, S4: the icosphere, a colour for each face, culled by face planes; S8: the torus, smooth.
    "S3" "plain": Plain<TORUS>, |m| picture::flat(&scene::TORUS_BY_PLANES, m);
    "S3" "z": Deep<TORUS>, |m| picture::flat_z(&scene::TORUS_BY_PLANES, m);
    "S4" "plain": Plain<ICO>, |m| picture::flat(&scene::ICO_BY_PLANES, m);
    "S4" "z": Deep<ICO>, |m| picture::flat_z(&scene::ICO_BY_PLANES, m);
    "S8" "z": Smooth<TORUS>, |m| picture::smooth_z(&scene::TORUS_BY_PLANES, m);
    // S5: one triangle over half of the picture. S6: a thousand lines. S7: a thousand triangles.
    "S5" "plain": Frame, |m| picture::triangle(&SCREEN, LINE, m);
    "S6" "plain": Frame, |m| picture::lines(&LINES, LINE, m);
    "S7" "plain": Frame, |m| picture::triangles(&TRIANGLES, &COLOURS, m);
    // Without planes.
    "S3" "no-planes": Plain<TORUS>, |m| picture::flat(&scene::TORUS, m);
    "S3" "no-planes-z": Deep<TORUS>, |m| picture::flat_z(&scene::TORUS, m);
    "S4" "no-planes": Plain<ICO>, |m| picture::flat(&scene::ICO, m);
    "S4" "no-planes-z": Deep<ICO>, |m| picture::flat_z(&scene::ICO, m);
    "S8" "no-planes-z": Smooth<TORUS>, |m| picture::smooth_z(&scene::TORUS, m);
    // All edges.
    "S3" "wire": Plain<TORUS>, |m| picture::wire(&TORUS_EDGED, LINE, m);
    // C1 and C2: the torus from near by.
    "C1" "plain": Plain<TORUS>, |m| picture::flat(&C1, m);
    "C1" "z": Deep<TORUS>, |m| picture::flat_z(&C1, m);
    "C1" "wire": Plain<TORUS>, |m| picture::wire(&C1_EDGED, LINE, m);
    "C1" "planes": Plain<TORUS>, |m| picture::flat(&C1_PLANES, m);
    "C1" "planes-z": Deep<TORUS>, |m| picture::flat_z(&C1_PLANES, m);
    "C2" "plain": Plain<TORUS>, |m| picture::flat(&C2, m);
    "C2" "z": Deep<TORUS>, |m| picture::flat_z(&C2, m);
    "C2" "wire": Plain<TORUS>, |m| picture::wire(&C2_EDGED, LINE, m);
    "C2" "planes": Plain<TORUS>, |m| picture::flat(&C2_PLANES, m);
    "C2" "planes-z": Deep<TORUS>, |m| picture::flat_z(&C2_PLANES, m);
    // T1: the turning cube. F50: fifty cubes before a moving camera, half of them out of view. The objects' placing is counted.
    "T1" "plain": Plain<CUBE>, |m| moving::t1(m);
    "F50" "plain": Plain<CUBE>, |m| moving::f50(m);
    "F50" "z": Deep<CUBE>, |m| moving::f50_z(m);
    "F50" "wire": Plain<CUBE>, |m| moving::f50_wire(m);
    // Into a DrawTarget of the firmware's own.
    "S1" "dt": Plain<CUBE>, |m| dt::wire(&scene::CUBE, LINE, m);
    "S2" "dt": Plain<CUBE>, |m| dt::flat(&scene::CUBE, m);
    "S2" "dt-z": Deep<CUBE>, |m| dt::flat_z(&scene::CUBE, m);
    "S3" "dt": Plain<TORUS>, |m| dt::flat(&scene::TORUS_BY_PLANES, m);
    "S3" "dt-z": Deep<TORUS>, |m| dt::flat_z(&scene::TORUS_BY_PLANES, m);
    "S3" "dt-wire": Plain<TORUS>, |m| dt::wire(&TORUS_EDGED, LINE, m);
    "S5" "dt": Frame, |m| dt::triangle(&SCREEN, LINE, m);
    "S6" "dt": Frame, |m| dt::lines(&LINES, LINE, m);
    "S7" "dt": Frame, |m| dt::triangles(&TRIANGLES, &COLOURS, m);
    "S8" "dt-z": Smooth<TORUS>, |m| dt::smooth_z(&scene::TORUS_BY_PLANES, m);
    // Anti-aliased: S1, S3's edges, at once, in bands and with a depth test, and S6.
    "S1" "smooth": Plain<CUBE>, |m| picture::wire(&scene::CUBE, AntiAliased(LINE), m);
    "S3" "smooth": Plain<TORUS>, |m| picture::wire(&TORUS_EDGED, AntiAliased(LINE), m);
    "S3" "smooth-bands8": LineStrip8, |m| banded::smooth(&TORUS_EDGED, m);
    "S3" "smooth-z": Deep<TORUS>, |m| ways::wire_z(&TORUS_EDGED, AntiAliased(LINE), m);
    "S6" "smooth": Frame, |m| picture::lines(&LINES, AntiAliased(LINE), m);
    // Textures on the torus, on a floor, on one that is rolled, and on one that reaches the horizon; by other accuracies, and by
    // other libraries' methods.
    "X1" "plain": Plain<TORUS>, |m| textured::torus(m);
    "X1" "z": Deep<TORUS>, |m| textured::torus_z(m);
    "X2" "plain": Plain<4>, |m| textured::floor(&X2, m);
    "X2" "z": Deep<4>, |m| textured::floor_z(&X2, m);
    "X3" "plain": Plain<4>, |m| textured::floor(&X3, m);
    "X4" "plain": Plain<4>, |m| textured::floor(&X4, m);
    "X1" "eighth": Plain<TORUS>, |m| textured::torus_by::<Eighth>(m);
    "X1" "sixteenth": Plain<TORUS>, |m| textured::torus_by::<Sixteenth>(m);
    "X1" "each": Plain<TORUS>, |m| textured::torus_by::<Each>(m);
    "X1" "every16": Plain<TORUS>, |m| textured::torus_by::<Every16>(m);
    "X2" "eighth": Plain<4>, |m| textured::floor_by::<Eighth>(&X2, m);
    "X2" "sixteenth": Plain<4>, |m| textured::floor_by::<Sixteenth>(&X2, m);
    "X2" "each": Plain<4>, |m| textured::floor_by::<Each>(&X2, m);
    "X2" "every16": Plain<4>, |m| textured::floor_by::<Every16>(&X2, m);
    "X3" "eighth": Plain<4>, |m| textured::floor_by::<Eighth>(&X3, m);
    "X3" "sixteenth": Plain<4>, |m| textured::floor_by::<Sixteenth>(&X3, m);
    "X3" "each": Plain<4>, |m| textured::floor_by::<Each>(&X3, m);
    "X3" "every16": Plain<4>, |m| textured::floor_by::<Every16>(&X3, m);
    "X4" "eighth": Plain<4>, |m| textured::floor_by::<Eighth>(&X4, m);
    "X4" "sixteenth": Plain<4>, |m| textured::floor_by::<Sixteenth>(&X4, m);
    "X4" "each": Plain<4>, |m| textured::floor_by::<Each>(&X4, m);
    "X4" "every16": Plain<4>, |m| textured::floor_by::<Every16>(&X4, m);
    // S5 blended in equal parts, and by an alpha of 13/32.
    "S5" "half": Frame, |m| picture::triangle(&SCREEN, HalfBlended::new(black_box(LINE)), m);
    "S5" "alpha": Frame, |m| picture::triangle(&SCREEN, Blended::new(black_box(LINE), black_box(13)), m);
    // The torus, a floor and the textured torus in fog by pixel. Fifty sprites.
    "G1" "plain": Plain<TORUS>, |m| foggy::g1(m);
    "G1" "z": Deep<TORUS>, |m| foggy::g1_z(m);
    "G2" "plain": Plain<4>, |m| foggy::g2(m);
    "G2" "z": Deep<4>, |m| foggy::g2_z(m);
    "G3" "z": Deep<TORUS>, |m| foggy::g3_z(m);
    "B1" "z": Deep<0>, |m| sprites::b1_z(m);
    // In one piece with the clear of the picture, and in bands.
    "S3" "full": Plain<TORUS>, |m| banded::full(m);
    "S3" "full-z": Deep<TORUS>, |m| banded::full_z(m);
    "S3" "bands8": Strip8, |m| banded::plain(&scene::TORUS, m);
    "S3" "bands8-z": Strip8Deep, |m| banded::deep(&scene::TORUS, m);
    "S3" "bands16": Strip16, |m| banded::plain(&scene::TORUS, m);
    "S3" "bands16-z": Strip16Deep, |m| banded::deep(&scene::TORUS, m);
    "S4" "bands8-z": Strip8DeepIco, |m| banded::deep(&scene::ICO, m);
}

/// The variants of textures by other accuracies and other libraries' methods.
pub const METHODS: [&str; 4] = ["eighth", "sixteenth", "each", "every16"];

const fn number(scene: &str, variant: &str) -> usize {
    let mut at = 0;
    while !(crate::is_equal(NAMES[at][0], scene) && crate::is_equal(NAMES[at][1], variant)) {
        at += 1;
    }
    at
}

/// The number of the cell with this image, such as `cell_s3_bands8_z` for S3 in the variant `bands8-z`, or `cell_s3` for `plain`.
pub const fn of_image(name: &str) -> usize {
    let (name, mut at) = (name.as_bytes(), 0);
    while at < NAMES.len() {
        let [scene, variant] = [NAMES[at][0].as_bytes(), NAMES[at][1].as_bytes()];
        let is_plain = crate::is_equal(NAMES[at][1], "plain");
        let length = scene.len() + if is_plain { 0 } else { 1 + variant.len() };
        let (mut same, mut i) = (name.len() == 5 + length, 0);
        while same && i < length {
            let letter = if i < scene.len() {
                scene[i].to_ascii_lowercase()
            } else if i == scene.len() || variant[i - scene.len() - 1] == b'-' {
                b'_'
            } else {
                variant[i - scene.len() - 1]
            };
            same = name[5 + i] == letter;
            i += 1;
        }
        if same {
            return at;
        }
        at += 1;
    }
    panic!("no cell of this name")
}

/// Draws two frames, each on a cleared picture, and counts the second without the clear. `draw` says whether it could.
pub fn count(frame: &mut Frame, draw: &mut dyn FnMut(&mut Picture<'_>) -> Option<()>) -> Option<Counted> {
    count_by(&mut Clock::new()?, frame, draw)
}

/// [`count`] with a given clock.
#[inline(never)]
pub fn count_by(
    clock: &mut Clock,
    frame: &mut Frame,
    draw: &mut dyn FnMut(&mut Picture<'_>) -> Option<()>,
) -> Option<Counted> {
    let mut picture = Picture::new(&mut frame.0, black_box(Size::new(SIZE, SIZE))).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    draw(&mut picture)?;
    let Ok(()) = picture.clear(BACKGROUND);
    let mut good = None;
    let instructions = clock.count(&mut || good = draw(&mut picture))?;
    good.map(|()| frame.counted(instructions))
}

/// [`count`] on a DrawTarget that is not this library's.
pub fn count_screen(
    frame: &mut Frame,
    draw: &mut dyn FnMut(&mut Screen<'_>) -> Option<()>,
) -> Option<Counted> {
    count_screen_by(&mut Clock::new()?, frame, draw)
}

/// [`count_screen`] with a given clock.
#[inline(never)]
pub fn count_screen_by(
    clock: &mut Clock,
    frame: &mut Frame,
    draw: &mut dyn FnMut(&mut Screen<'_>) -> Option<()>,
) -> Option<Counted> {
    let mut screen = Screen::new(&mut frame.0, black_box(Size::new(SIZE, SIZE)))?;
    let Ok(()) = screen.clear(BACKGROUND);
    draw(&mut screen)?;
    let Ok(()) = screen.clear(BACKGROUND);
    let mut good = None;
    let instructions = clock.count(&mut || good = draw(&mut screen))?;
    good.map(|()| frame.counted(instructions))
}

/// The line that `report` reads: `instructions,stack,crc`.
pub fn print(Counted { instructions, crc, .. }: Counted, stack: usize) {
    println!("{instructions},{stack},{crc:08x}");
}

/// A firmware that draws one cell: its memory, and how.
#[macro_export]
macro_rules! cell {
    ($memory:ty, $draw:path) => {
        #[cfg(target_os = "none")]
        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        fn main() -> ! {
            use core::cell::RefCell;
            use critical_section::Mutex;
            // Not on the stack.
            static MEMORY: Mutex<RefCell<$memory>> = Mutex::new(RefCell::new(<$memory>::NEW));
            $crate::stack::paint();
            let counted = critical_section::with(|token| $draw(&mut MEMORY.borrow_ref_mut(token)));
            let stack = $crate::stack::deepest();
            if let Some(counted) = counted {
                $crate::cells::print(counted, stack);
            }
            $crate::board::end(counted.is_some())
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            let counted = $draw(&mut *Box::<$memory>::new(<$memory>::NEW));
            $crate::board::end(counted.is_some())
        }
    };
}
