//! The cells: scenes drawn in some variants, each by a firmware of its own with no more memory than the scene takes.

mod banded;
mod foggy;
mod memory;
mod moving;
mod screen;
mod sprites;
mod textured;
mod ways;

pub use banded::{Listed, Strip};
pub use memory::{Deep, Frame, Memory, Plain, Smooth};
pub use screen::Screen;

use crate::bands::{bytes, pixels};
use crate::board::{println, Clock};
use crate::is_equal;
use crate::lists::{COLOURS, LINES, SCREEN, TORUS_EDGES, TRIANGLES};
use crate::scene::{self, Model, BACKGROUND, LINE, SIZE};
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use memory::Depth;
use pinhole::{
    draw::{ActiveFace, Faces, ShaderFor},
    mesh::{FacePlanes, WithPlanes},
    prelude::*,
    shading::{AntiAliased, Blended},
    target::Surface,
    texture::Accuracy,
};
use textured::{X2, X3, X4};
use ways::{picture, screen as dt};

/// The picture that cells are drawn into; its size is unknown to the compiler.
pub type Picture<'p> = pinhole::target::Picture<'p, Rgb565>;

/// The result of a cell.
#[derive(Clone, Copy)]
pub struct Counted {
    pub instructions: u32,
    /// CRC-32 of the pixels as little-endian numbers.
    pub crc: u32,
}

/// The most vertices of a scene: of the cube, of the torus and of the icosphere.
pub const CUBE: usize = 8;
pub const TORUS: usize = 500;
pub const ICO: usize = 2892;

/// Bins: the visible faces or edges of each, with some to spare, and a bit for each that the mesh has.
const CUBE_BINS: usize = 12 + 1;
const TORUS_BINS: usize = 480 + 1000_usize.div_ceil(16);
/// Links of all faces of the torus, and entries for those that continue in bands of 8 rows.
const TORUS_LINKS: usize = 1000 + 1000_usize.div_ceil(16);
const LIST: usize = 56;
const ICO_BINS: usize = 1750 + 5780_usize.div_ceil(16);

/// The torus with its edges alone, for wireframes, and from so near that parts of it lie behind the camera, and others beyond the
/// borders of the picture: with the eye at 0.8 from its centre, where the near plane at 0.5 cuts it. It reaches 1.42.
static TORUS_EDGED: Model = edged(&scene::TORUS, &TORUS_EDGES);
const NEAR: i32 = 52_429;
static C1: Model = at(&scene::TORUS, NEAR);
static C1_PLANES: Model<WithPlanes> = at(&scene::TORUS_BY_PLANES, NEAR);
static C1_EDGED: Model = at(&TORUS_EDGED, NEAR);

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
        /// The images: `cell-S3-z` draws S3 in the variant `z`.
        const IMAGES: &[&str] = &[$(concat!("cell-", $scene, "-", $variant)),*];

        $(impl Cell for Image<{ of_image(concat!("cell-", $scene, "-", $variant)) }> {
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
    "S2" "z": Deep<CUBE>, |m| picture::flat(&scene::CUBE, m);
    // S3: the torus, S4: the icosphere, a colour for each face, culled by face planes; S8: the torus, smooth.
    "S3" "plain": Plain<TORUS>, |m| picture::flat(&scene::TORUS_BY_PLANES, m);
    "S3" "z": Deep<TORUS>, |m| picture::flat(&scene::TORUS_BY_PLANES, m);
    "S4" "plain": Plain<ICO>, |m| picture::flat(&scene::ICO_BY_PLANES, m);
    "S4" "z": Deep<ICO>, |m| picture::flat(&scene::ICO_BY_PLANES, m);
    "S8" "z": Smooth<TORUS>, |m| picture::smooth_z(&scene::TORUS_BY_PLANES, m);
    // S5: one triangle over half of the picture. S6: a thousand lines. S7: a thousand triangles.
    "S5" "plain": Frame, |m| picture::triangle(&SCREEN, LINE, m);
    "S6" "plain": Frame, |m| picture::lines(&LINES, LINE, m);
    "S7" "plain": Frame, |m| picture::triangles(&TRIANGLES, &COLOURS, m);
    // Without planes.
    "S3" "no-planes": Plain<TORUS>, |m| picture::flat(&scene::TORUS, m);
    "S3" "no-planes-z": Deep<TORUS>, |m| picture::flat(&scene::TORUS, m);
    // All edges.
    "S3" "wire": Plain<TORUS>, |m| picture::wire(&TORUS_EDGED, LINE, m);
    // The torus from near by.
    "C1" "plain": Plain<TORUS>, |m| picture::flat(&C1, m);
    "C1" "z": Deep<TORUS>, |m| picture::flat(&C1, m);
    "C1" "wire": Plain<TORUS>, |m| picture::wire(&C1_EDGED, LINE, m);
    "C1" "planes": Plain<TORUS>, |m| picture::flat(&C1_PLANES, m);
    "C1" "planes-z": Deep<TORUS>, |m| picture::flat(&C1_PLANES, m);
    // T1: the turning cube. F50: fifty cubes before a moving camera, half of them out of view. The placing is counted.
    "T1" "plain": Plain<CUBE>, |m| moving::t1(m);
    "F50" "z": Deep<CUBE>, |m| moving::f50_z(m);
    // Into a DrawTarget of the firmware's own.
    "S1" "dt": Plain<CUBE>, |m| dt::wire(&scene::CUBE, LINE, m);
    "S2" "dt": Plain<CUBE>, |m| dt::flat(&scene::CUBE, m);
    "S2" "dt-z": Deep<CUBE>, |m| dt::flat(&scene::CUBE, m);
    "S3" "dt": Plain<TORUS>, |m| dt::flat(&scene::TORUS_BY_PLANES, m);
    "S3" "dt-z": Deep<TORUS>, |m| dt::flat(&scene::TORUS_BY_PLANES, m);
    "S5" "dt": Frame, |m| dt::triangle(&SCREEN, LINE, m);
    "S6" "dt": Frame, |m| dt::lines(&LINES, LINE, m);
    "S7" "dt": Frame, |m| dt::triangles(&TRIANGLES, &COLOURS, m);
    "S8" "dt-z": Smooth<TORUS>, |m| dt::smooth_z(&scene::TORUS_BY_PLANES, m);
    // Anti-aliased: S1, S3's edges, and S6.
    "S1" "smooth": Plain<CUBE>, |m| picture::wire(&scene::CUBE, AntiAliased(LINE), m);
    "S3" "smooth": Plain<TORUS>, |m| picture::wire(&TORUS_EDGED, AntiAliased(LINE), m);
    "S6" "smooth": Frame, |m| picture::lines(&LINES, AntiAliased(LINE), m);
    // Textures on the torus, on a floor, on one that is rolled, and on one that reaches the horizon, by each accuracy.
    "X1" "plain": Plain<TORUS>, |m| textured::torus(Accuracy::Quarter, m);
    "X2" "plain": Plain<4>, |m| textured::floor(&X2, Accuracy::Quarter, m);
    "X3" "plain": Plain<4>, |m| textured::floor(&X3, Accuracy::Quarter, m);
    "X4" "plain": Plain<4>, |m| textured::floor(&X4, Accuracy::Quarter, m);
    "X1" "eighth": Plain<TORUS>, |m| textured::torus(Accuracy::Eighth, m);
    "X2" "eighth": Plain<4>, |m| textured::floor(&X2, Accuracy::Eighth, m);
    "X3" "eighth": Plain<4>, |m| textured::floor(&X3, Accuracy::Eighth, m);
    "X4" "eighth": Plain<4>, |m| textured::floor(&X4, Accuracy::Eighth, m);
    "X1" "sixteenth": Plain<TORUS>, |m| textured::torus(Accuracy::Sixteenth, m);
    "X2" "sixteenth": Plain<4>, |m| textured::floor(&X2, Accuracy::Sixteenth, m);
    "X3" "sixteenth": Plain<4>, |m| textured::floor(&X3, Accuracy::Sixteenth, m);
    "X4" "sixteenth": Plain<4>, |m| textured::floor(&X4, Accuracy::Sixteenth, m);
    "X1" "z": Deep<TORUS>, |m| textured::torus(Accuracy::Quarter, m);
    // S5 blended in equal parts, and by an alpha of 13/32.
    "S5" "half": Frame, |m| picture::triangle(&SCREEN, HalfBlended::new(black_box(LINE)), m);
    "S5" "alpha": Frame, |m| picture::triangle(&SCREEN, Blended::new(black_box(LINE), black_box(13)), m);
    // The torus, a floor and the textured torus in fog by pixel. Fifty sprites.
    "G1" "plain": Plain<TORUS>, |m| foggy::g1(m);
    "G1" "z": Deep<TORUS>, |m| foggy::g1(m);
    "G2" "plain": Plain<4>, |m| foggy::g2(m);
    "G3" "z": Deep<TORUS>, |m| foggy::g3_z(m);
    "B1" "z": Deep<0>, |m| sprites::b1_z(m);
    // In one piece with the clear of the picture, and in bands.
    "S1" "full": Plain<CUBE>, |m| banded::full_wire(&scene::CUBE, m);
    "S1" "bands8": Strip<{ bytes(8) }, 0, CUBE_BINS, CUBE>, |m| m.wire(&scene::CUBE);
    "S1" "bands16": Strip<{ bytes(16) }, 0, CUBE_BINS, CUBE>, |m| m.wire(&scene::CUBE);
    "S2" "full": Plain<CUBE>, |m| banded::full(&scene::CUBE, m);
    "S2" "full-z": Deep<CUBE>, |m| banded::full(&scene::CUBE, m);
    "S2" "bands8": Strip<{ bytes(8) }, 0, CUBE_BINS, CUBE>, |m| m.faces(&scene::CUBE);
    "S2" "bands8-z": Strip<{ bytes(8) }, { pixels(8) }, CUBE_BINS, CUBE>, |m| m.faces(&scene::CUBE);
    "S2" "bands16": Strip<{ bytes(16) }, 0, CUBE_BINS, CUBE>, |m| m.faces(&scene::CUBE);
    "S2" "bands16-z": Strip<{ bytes(16) }, { pixels(16) }, CUBE_BINS, CUBE>, |m| m.faces(&scene::CUBE);
    "S3" "full": Plain<TORUS>, |m| banded::full(&scene::TORUS, m);
    "S3" "full-z": Deep<TORUS>, |m| banded::full(&scene::TORUS, m);
    "S3" "bands8": Strip<{ bytes(8) }, 0, TORUS_BINS, TORUS>, |m| m.faces(&scene::TORUS);
    "S3" "bands8-z": Strip<{ bytes(8) }, { pixels(8) }, TORUS_BINS, TORUS>, |m| m.faces(&scene::TORUS);
    "S3" "bands16": Strip<{ bytes(16) }, 0, TORUS_BINS, TORUS>, |m| m.faces(&scene::TORUS);
    "S3" "bands16-z": Strip<{ bytes(16) }, { pixels(16) }, TORUS_BINS, TORUS>, |m| m.faces(&scene::TORUS);
    "S3" "active8": Listed<ActiveFace<Rgb565>, { bytes(8) }, 0>, |m| m.torus(crate::bands::active);
    "S3" "active8-z": Listed<ActiveFace<Rgb565, 3>, { bytes(8) }, { pixels(8) }>,
        |m| m.torus(crate::bands::active_depth);
    "S4" "bands8-z": Strip<{ bytes(8) }, { pixels(8) }, ICO_BINS, ICO>, |m| m.faces(&scene::ICO);
}

/// The variants of textures by other accuracies.
pub const ACCURACIES: [&str; 2] = ["eighth", "sixteenth"];

/// The number of the cell with this image. A name that no cell has does not compile.
pub const fn of_image(name: &str) -> usize {
    let mut at = 0;
    while !is_equal(name, IMAGES[at]) {
        at += 1;
    }
    at
}

/// Defines a function that draws two frames, each on a cleared target, and counts the second without the clear. `draw` says whether it
/// could.
macro_rules! count {
    ($count:ident, $target:ident, |$new:ident| $option:expr) => {
        #[inline(never)]
        pub fn $count(
            frame: &mut Frame,
            draw: &mut dyn FnMut(&mut $target<'_>) -> Option<()>,
        ) -> Option<Counted> {
            let mut clock = Clock::new()?;
            let $new = $target::new(&mut frame.0, black_box(Size::new(SIZE, SIZE)));
            let mut target = $option?;
            let Ok(()) = target.clear(BACKGROUND);
            draw(&mut target)?;
            let Ok(()) = target.clear(BACKGROUND);
            let mut good = None;
            let instructions = clock.count(&mut || good = draw(&mut target))?;
            good.map(|()| frame.counted(instructions))
        }
    };
}

count!(count, Picture, |new| new.ok());
// On a DrawTarget that is not this library's.
count!(count_screen, Screen, |new| new);

/// The end of a frame: what a draw call returns is used.
#[inline(always)]
fn drawn(statistics: Result<Statistics, Infallible>) -> Option<()> {
    let Ok(statistics) = statistics;
    black_box(statistics);
    Some(())
}

/// Draws faces, with depth where the memory has depths.
#[inline(always)]
fn draw_faces<P: FacePlanes, S: ShaderFor<T>, T, const DEPTHS: usize>(
    faces: Faces<'_, i16, P, impl FnMut(usize) -> S>,
    depth: &mut Depth<DEPTHS>,
    surface: &mut T,
) -> Option<()>
where
    T: Surface<Color = Rgb565, Error = Infallible>,
{
    if const { DEPTHS == 0 } {
        return drawn(faces.draw(surface));
    }
    let mut depth = DepthBuffer::new(black_box(scene::area()), &mut depth.0).ok()?;
    drawn(faces.draw(&mut surface.depth_tested(&mut depth)))
}

/// The line that `report` reads: `instructions,stack,crc`.
pub fn print(Counted { instructions, crc }: Counted, stack: usize) {
    println!("{instructions},{stack},{crc:08x}");
}
