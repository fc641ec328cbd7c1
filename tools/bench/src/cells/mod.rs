//! The cells: scenes drawn in some variants, each by a firmware of its own with no more memory than the scene takes.

mod banded;
mod field;
mod foggy;
mod memory;
mod moving;
mod room;
mod screen;
mod sprites;
mod textured;
mod ways;

pub use banded::{Both, Listed, Sampled, Sent, SmoothStrip, Strip, TwoCores, Wheel};
pub use field::{Banded, Whole};
pub use memory::{Deep, DeepSmooth, Frame, Memory, Plain, PlainSmooth, Smooth};
pub use screen::Screen;

use crate::bands::{bytes, pixels};
use crate::board::{println, Clock};
use crate::is_equal;
use crate::lists::{self, COLOURS, LINES, SCREEN, TORUS_BESIDE, TORUS_EDGES, TRIANGLES};
use crate::scene::{self, Model, BACKGROUND, LINE};
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use memory::Depth;
use pinhole::{
    color::{Alpha, Half},
    draw::{Faces, ShaderFor},
    prelude::*,
    shading::{AntiAliased, Translucent},
    target::Surface,
    texture::Accuracy,
};
use textured::{X2, X3, X4, X5};
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

/// The vertices of the cube, of the torus, of the icosphere.
pub const CUBE: usize = 8;
pub const TORUS: usize = 500;
pub const ICO: usize = 2892;

/// Bins of the faces of each, or of the cube's edges.
const CUBE_BINS: usize = scene::CUBE.mesh.face_bins_len();
pub const TORUS_BINS: usize = scene::TORUS.mesh.face_bins_len();
/// And of its edges to be smoothed.
pub(crate) const TORUS_EDGE_BINS: usize = TORUS_SMOOTH.mesh.smooth_bins_len();
const ICO_BINS: usize = scene::ICO.mesh.face_bins_len();
/// Entries for the torus's faces that continue in bands of 8 rows.
const LIST: usize = 56;

/// The torus with its edges alone, for wireframes, and from so near that parts of it lie behind the camera, and others beyond the
/// borders of the picture: with the eye at 0.8 from its centre, where the near plane at 0.5 cuts it. It reaches 1.42.
static TORUS_EDGED: Model = edged(&scene::TORUS, &TORUS_EDGES);
/// The torus with its edges and the faces beside them.
pub(crate) static TORUS_SMOOTH: Model = {
    let Ok(mesh) = scene::TORUS.mesh.with_edges(&TORUS_EDGES) else { panic!("edges") };
    let Ok(mesh) = mesh.with_edge_faces(&TORUS_BESIDE) else { panic!("faces") };
    Model { mesh, ..scene::TORUS }
};
const NEAR: i32 = 52_429;
static C1: Model = at(&scene::TORUS, NEAR);
static C1_PLANES: Model = at(&scene::TORUS_BY_PLANES, NEAR);
static C1_EDGED: Model = at(&TORUS_EDGED, NEAR);

/// At compile time: without normals.
const fn edged(model: &Model, edges: &'static [[u16; 2]]) -> Model {
    let mesh = &model.mesh;
    let Ok(mesh) = Mesh::new(mesh.vertices(), mesh.exponent(), mesh.faces()) else { panic!("faces") };
    let Ok(mesh) = mesh.with_edges(edges) else { panic!("edges") };
    Model { mesh, ..*model }
}

const fn at(model: &Model, distance: i32) -> Model {
    Model { distance, ..*model }
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

// The list in `cells.json`.
include!(concat!(env!("OUT_DIR"), "/cells.rs"));

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
        #[inline(always)]
        pub fn $count<const WIDTH: usize, const HEIGHT: usize>(
            frame: &mut Frame<WIDTH, HEIGHT>,
            draw: &mut dyn FnMut(&mut $target<'_>) -> Option<()>,
        ) -> Option<Counted> {
            // Compiled once, in this crate, whatever the size.
            #[inline(never)]
            fn count(
                pixels: &mut [Rgb565],
                size: Size,
                draw: &mut dyn FnMut(&mut $target<'_>) -> Option<()>,
            ) -> Option<u32> {
                let mut clock = Clock::new()?;
                let $new = $target::new(pixels, black_box(size));
                let mut target = $option?;
                let Ok(()) = target.clear(BACKGROUND);
                draw(&mut target)?;
                let Ok(()) = target.clear(BACKGROUND);
                let mut good = None;
                let instructions = clock.count(&mut || good = draw(&mut target))?;
                good.map(|()| instructions)
            }
            let instructions = count(frame.0.as_flattened_mut(), Frame::<WIDTH, HEIGHT>::SIZE, draw)?;
            Some(frame.counted(instructions))
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
fn draw_faces<S: ShaderFor<T>, T, const WIDTH: usize, const ROWS: usize, const CULLED_BY: u8>(
    faces: Faces<'_, i16, impl FnMut(usize) -> S, CULLED_BY>,
    depth: &mut Depth<WIDTH, ROWS>,
    surface: &mut T,
) -> Option<()>
where
    T: Surface<Color = Rgb565, Error = Infallible>,
{
    if const { ROWS == 0 } {
        return drawn(faces.draw(surface));
    }
    drawn(faces.draw(&mut surface.depth_tested(&mut depth.buffer()?)))
}

/// The line that `report` reads: `instructions,stack,crc`.
pub fn print(Counted { instructions, crc }: Counted, stack: usize) {
    println!("{instructions},{stack},{crc:08x}");
}
