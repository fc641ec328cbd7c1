//! The cells of `docs/speed.md`: scenes drawn at once into memory, each by a firmware of its own with no more memory than
//! the scene takes.

mod banded;
mod blended;
mod close;
mod draw_target;
mod foggy;
mod memory;
mod moving;
mod screen;
mod sprites;
mod stepped;
mod textured;
mod three;
mod two;

pub use banded::{s3_bands, s3_bands_z, s3_full, s3_full_z, s3_smooth_bands};
pub use banded::{LineStrip8, Strip16, Strip16Deep, Strip8, Strip8Deep};
pub use blended::{s5_alpha, s5_half};
pub use close::{c1, c1_planes, c1_planes_z, c1_wire, c1_z, c2, c2_planes, c2_planes_z, c2_wire, c2_z};
pub use draw_target::{s1_dt, s2_dt, s2_dt_z, s3_dt, s3_dt_wire, s3_dt_z, s5_dt, s6_dt, s7_dt, s8_dt_z};
pub use foggy::{g1, g1_z, g2, g2_z, g3_z};
pub use memory::{Deep, Frame, Plain, Smooth};
#[cfg(not(target_os = "none"))]
pub use moving::f50_in_view;
pub use moving::{f50, f50_wire, f50_z, t1};
pub use screen::Screen;
pub use sprites::b1_z;
pub use textured::{x1, x1_z, x2, x2_z, x3, x4};
pub use textured::{
    x1_each, x1_eighth, x1_every16, x1_sixteenth, x2_each, x2_eighth, x2_every16, x2_sixteenth, x3_each,
    x3_eighth, x3_every16, x3_sixteenth, x4_each, x4_eighth, x4_every16, x4_sixteenth,
};
#[cfg(not(target_os = "none"))]
pub use three::placed;
pub use three::{s1, s2, s2_z, s3, s3_wire, s3_z, s4, s4_z, s8_z};
pub use three::{s1_smooth, s3_smooth, s3_smooth_z};
pub use three::{s3_no_planes, s3_z_no_planes, s4_no_planes, s4_z_no_planes, s8_z_no_planes};
pub use two::{s5, s6, s6_smooth, s7};

use crate::board::{println, Clock};
use crate::measure::Checksum;
use crate::scene::{BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;

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

/// A way to draw a cell, on memory of its own.
#[cfg(not(target_os = "none"))]
type Draw = fn() -> Option<Counted>;

/// Scene, variant, and how it is drawn on the host.
#[cfg(not(target_os = "none"))]
pub type Known = (&'static str, &'static str, Draw);

#[cfg(not(target_os = "none"))]
pub const CELLS: &[Known] = &[
    ("S1", "plain", || s1(&mut boxed(Plain::NEW))),
    ("S2", "plain", || s2(&mut boxed(Plain::NEW))),
    ("S2", "z", || s2_z(&mut boxed(Deep::NEW))),
    ("S3", "plain", || s3(&mut boxed(Plain::NEW))),
    ("S3", "z", || s3_z(&mut boxed(Deep::NEW))),
    ("S4", "plain", || s4(&mut boxed(Plain::NEW))),
    ("S4", "z", || s4_z(&mut boxed(Deep::NEW))),
    ("S5", "plain", || s5(&mut boxed(Frame::NEW))),
    ("S6", "plain", || s6(&mut boxed(Frame::NEW))),
    ("S7", "plain", || s7(&mut boxed(Frame::NEW))),
    ("S8", "z", || s8_z(&mut boxed(Smooth::NEW))),
];

/// Cells of what users draw: near objects, moving ones, all edges of a mesh, into a DrawTarget of their own, in bands.
#[cfg(not(target_os = "none"))]
pub const USER_CELLS: &[Known] = &[
    ("S3", "wire", || s3_wire(&mut boxed(Plain::NEW))),
    // From near by, by planes too.
    ("C1", "plain", || c1(&mut boxed(Plain::NEW))),
    ("C1", "z", || c1_z(&mut boxed(Deep::NEW))),
    ("C1", "wire", || c1_wire(&mut boxed(Plain::NEW))),
    ("C1", "planes", || c1_planes(&mut boxed(Plain::NEW))),
    ("C1", "planes-z", || c1_planes_z(&mut boxed(Deep::NEW))),
    ("C2", "plain", || c2(&mut boxed(Plain::NEW))),
    ("C2", "z", || c2_z(&mut boxed(Deep::NEW))),
    ("C2", "wire", || c2_wire(&mut boxed(Plain::NEW))),
    ("C2", "planes", || c2_planes(&mut boxed(Plain::NEW))),
    ("C2", "planes-z", || c2_planes_z(&mut boxed(Deep::NEW))),
    // Objects that are placed in each frame.
    ("T1", "plain", || t1(&mut boxed(Plain::NEW))),
    ("F50", "plain", || f50(&mut boxed(Plain::NEW))),
    ("F50", "z", || f50_z(&mut boxed(Deep::NEW))),
    ("F50", "wire", || f50_wire(&mut boxed(Plain::NEW))),
    // Into a DrawTarget of the firmware's own.
    ("S1", "dt", || s1_dt(&mut boxed(Plain::NEW))),
    ("S2", "dt", || s2_dt(&mut boxed(Plain::NEW))),
    ("S2", "dt-z", || s2_dt_z(&mut boxed(Deep::NEW))),
    ("S3", "dt", || s3_dt(&mut boxed(Plain::NEW))),
    ("S3", "dt-z", || s3_dt_z(&mut boxed(Deep::NEW))),
    ("S3", "dt-wire", || s3_dt_wire(&mut boxed(Plain::NEW))),
    ("S5", "dt", || s5_dt(&mut boxed(Frame::NEW))),
    ("S6", "dt", || s6_dt(&mut boxed(Frame::NEW))),
    ("S7", "dt", || s7_dt(&mut boxed(Frame::NEW))),
    ("S8", "dt-z", || s8_dt_z(&mut boxed(Smooth::NEW))),
    // Anti-aliased lines: wireframes, in bands and with a depth test too, and lines in the picture's plane.
    ("S1", "smooth", || s1_smooth(&mut boxed(Plain::NEW))),
    ("S3", "smooth", || s3_smooth(&mut boxed(Plain::NEW))),
    ("S3", "smooth-bands8", || s3_smooth_bands(&mut boxed(LineStrip8::NEW))),
    ("S3", "smooth-z", || s3_smooth_z(&mut boxed(Deep::NEW))),
    ("S6", "smooth", || s6_smooth(&mut boxed(Frame::NEW))),
    // Textures.
    ("X1", "plain", || x1(&mut boxed(Plain::NEW))),
    ("X1", "z", || x1_z(&mut boxed(Deep::NEW))),
    ("X2", "plain", || x2(&mut boxed(Plain::NEW))),
    ("X2", "z", || x2_z(&mut boxed(Deep::NEW))),
    ("X3", "plain", || x3(&mut boxed(Plain::NEW))),
    ("X4", "plain", || x4(&mut boxed(Plain::NEW))),
    // A blended triangle.
    ("S5", "half", || s5_half(&mut boxed(Frame::NEW))),
    ("S5", "alpha", || s5_alpha(&mut boxed(Frame::NEW))),
    // Fog by pixel, and sprites.
    ("G1", "plain", || g1(&mut boxed(Plain::NEW))),
    ("G1", "z", || g1_z(&mut boxed(Deep::NEW))),
    ("G2", "plain", || g2(&mut boxed(Plain::NEW))),
    ("G2", "z", || g2_z(&mut boxed(Deep::NEW))),
    ("G3", "z", || g3_z(&mut boxed(Deep::NEW))),
    ("B1", "z", || b1_z(&mut boxed(Deep::NEW))),
    // In one piece, the clear of the picture counted, and in bands.
    ("S3", "full", || s3_full(&mut boxed(Plain::NEW))),
    ("S3", "full-z", || s3_full_z(&mut boxed(Deep::NEW))),
    ("S3", "bands8", || s3_bands(&mut boxed(Strip8::NEW))),
    ("S3", "bands8-z", || s3_bands_z(&mut boxed(Strip8Deep::NEW))),
    ("S3", "bands16", || s3_bands(&mut boxed(Strip16::NEW))),
    ("S3", "bands16-z", || s3_bands_z(&mut boxed(Strip16Deep::NEW))),
];

/// Textures by other accuracies, and by methods of other libraries. No page lists them: docs/accuracy.md has their counts.
#[cfg(not(target_os = "none"))]
pub const TEXTURE_METHODS: &[Known] = &[
    ("X1", "eighth", || x1_eighth(&mut boxed(Plain::NEW))),
    ("X1", "sixteenth", || x1_sixteenth(&mut boxed(Plain::NEW))),
    ("X1", "each", || x1_each(&mut boxed(Plain::NEW))),
    ("X1", "every16", || x1_every16(&mut boxed(Plain::NEW))),
    ("X2", "eighth", || x2_eighth(&mut boxed(Plain::NEW))),
    ("X2", "sixteenth", || x2_sixteenth(&mut boxed(Plain::NEW))),
    ("X2", "each", || x2_each(&mut boxed(Plain::NEW))),
    ("X2", "every16", || x2_every16(&mut boxed(Plain::NEW))),
    ("X3", "eighth", || x3_eighth(&mut boxed(Plain::NEW))),
    ("X3", "sixteenth", || x3_sixteenth(&mut boxed(Plain::NEW))),
    ("X3", "each", || x3_each(&mut boxed(Plain::NEW))),
    ("X3", "every16", || x3_every16(&mut boxed(Plain::NEW))),
    ("X4", "eighth", || x4_eighth(&mut boxed(Plain::NEW))),
    ("X4", "sixteenth", || x4_sixteenth(&mut boxed(Plain::NEW))),
    ("X4", "each", || x4_each(&mut boxed(Plain::NEW))),
    ("X4", "every16", || x4_every16(&mut boxed(Plain::NEW))),
];

/// The cells with early culling by face planes, drawn without it; the table does not list them.
#[cfg(not(target_os = "none"))]
pub const NO_PLANES: &[Known] = &[
    ("S3", "plain", || s3_no_planes(&mut boxed(Plain::NEW))),
    ("S3", "z", || s3_z_no_planes(&mut boxed(Deep::NEW))),
    ("S4", "plain", || s4_no_planes(&mut boxed(Plain::NEW))),
    ("S4", "z", || s4_z_no_planes(&mut boxed(Deep::NEW))),
    ("S8", "z", || s8_z_no_planes(&mut boxed(Smooth::NEW))),
];

/// Flash of a scene's face planes, in bytes.
#[cfg(not(target_os = "none"))]
pub fn planes(scene: &str) -> usize {
    use crate::scene::{ICO_BY_PLANES, TORUS_BY_PLANES};
    match scene {
        "S3" | "S8" => size_of_val(TORUS_BY_PLANES.mesh.planes()),
        "S4" => size_of_val(ICO_BY_PLANES.mesh.planes()),
        _ => 0,
    }
}

/// Flash of a scene's data, its mesh or list, in bytes.
#[cfg(not(target_os = "none"))]
pub fn data(scene: &str) -> usize {
    use crate::lists::{COLOURS, LINES, SCREEN, TORUS_NORMALS, TRIANGLES};
    use crate::scene::{CUBE, ICO_BY_PLANES, TORUS_BY_PLANES};
    match scene {
        "S1" | "S2" => CUBE.bytes(),
        "S3" => TORUS_BY_PLANES.bytes(),
        "S4" => ICO_BY_PLANES.bytes(),
        "S5" => size_of_val(&SCREEN),
        "S6" => size_of_val(&LINES),
        "S7" => size_of_val(&TRIANGLES) + size_of_val(&COLOURS),
        "S8" => TORUS_BY_PLANES.bytes() + size_of_val(&TORUS_NORMALS),
        _ => 0,
    }
}

#[cfg(not(target_os = "none"))]
fn boxed<T>(memory: T) -> Box<T> {
    Box::new(memory)
}

/// A frame in which nothing is drawn.
pub fn empty(frame: &mut Frame) -> Option<Counted> {
    count(frame, &mut |_| Some(()))
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
    let pixels = black_box(&frame.0);
    let drawn = pixels.iter().filter(|&&pixel| pixel != BACKGROUND).count();
    good.map(|()| Counted { instructions, crc: Checksum::of(pixels), drawn })
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
    let pixels = black_box(&frame.0);
    let drawn = pixels.iter().filter(|&&pixel| pixel != BACKGROUND).count();
    good.map(|()| Counted { instructions, crc: Checksum::of(pixels), drawn })
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
            if let Some(counted) = counted {
                $crate::cells::print(counted, 0);
            }
            $crate::board::end(counted.is_some())
        }
    };
}
