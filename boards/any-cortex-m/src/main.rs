//! Your model turns on your display, and each frame logs its time, its bytes and what was drawn. Yours to change: `model.stl` with its name
//! in `build.rs`, `src/display.rs`, `memory.x`, `.cargo/config.toml`, and the clock below.
#![no_std]
#![no_main]

#[cfg_attr(target_arch = "arm", path = "../../../src/book/measuring/systick.rs")]
#[cfg_attr(target_arch = "riscv32", path = "../../../src/book/measuring/mcycle.rs")]
mod clock;
mod display;
#[path = "../../common/one-strip/src/picture.rs"]
mod picture;
#[path = "../../common/all/src/stack.rs"]
mod stack;
mod stop;

use clock::Clock;
#[cfg(target_arch = "arm")]
use cortex_m::singleton;
use defmt_rtt as _; // logs go through the probe; without one they are dropped
use display::{Display, Peripherals, SIZE};
use embedded_graphics_core::{geometry::Point, pixelcolor::Rgb565, primitives::Rectangle};
use picture::{Drawn, Memory};
use pinhole::{prelude::*, Angle};
#[cfg(target_arch = "riscv32")]
use riscv::singleton;
use stop::stop;

include!(concat!(env!("OUT_DIR"), "/model.rs"));

/// The core's clock.
const MEGAHERTZ: u32 = 16;
/// From one writing of the display's registers to the next, in cycles: half a second.
const REFRESH: u32 = MEGAHERTZ * 500_000;
/// Frames of a turn.
const FRAMES: u32 = 120;
/// Rows of a band: more are faster, and take more memory.
const ROWS: u32 = 8;
const SCREEN: Rectangle = Rectangle::new(Point::zero(), SIZE);

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    stack::paint();
    // In statics, so that the linker says if they do not fit. The rest of RAM is the stack.
    let mesh = singleton!(: MeshBuffers!(MODEL) = mesh_buffers!(MODEL));
    let strip =
        singleton!(: StripBuffers!(Rgb565, SIZE.width, ROWS) = strip_buffers!(Rgb565, SIZE.width, ROWS));
    let (Some(mesh), Some(strip)) = (mesh, strip) else { stop("the buffers are in use") };
    let mut memory = Memory::new(&mut mesh.cache, &mut mesh.bins, &mut strip.colors, &mut strip.depths);

    #[cfg(target_arch = "arm")]
    let Some(core) = cortex_m::Peripherals::take() else {
        stop("the core's peripherals are in use")
    };
    #[cfg(target_arch = "arm")]
    let clock = Clock::start(core.SYST);
    #[cfg(target_arch = "riscv32")]
    let clock = Clock::start();

    let Some(peripherals) = Peripherals::take() else { stop("the chip's peripherals are in use") };
    let mut display = Display::new(peripherals).unwrap_or_else(|problem| stop(problem));
    let camera = picture::camera(&MODEL, SCREEN).unwrap_or_else(|problem| stop(problem));
    // A constant: what the model does not have is left out when this is compiled.
    let color = |face: usize, level: u16| match MODEL_COLORS {
        Some(colors) => colors.lit(face, level),
        None => picture::COLOR.dim(level),
    };
    let mut refreshed = clock.cycles();
    loop {
        for frame in 0..FRAMES {
            display.feed();
            let start = clock.cycles();
            let turn = Angle::turns(frame as i32, FRAMES);
            let mut drawn =
                picture::draw(&MODEL, color, &camera, turn, &mut memory, SCREEN, |area, pixels| {
                    display.send(area, pixels)
                });
            let time = clock.cycles().wrapping_sub(start) / MEGAHERTZ;
            if drawn.is_ok() && clock.cycles().wrapping_sub(refreshed) >= REFRESH {
                refreshed = clock.cycles();
                drawn = display.refresh().and(drawn);
            }
            match drawn {
                Ok(Drawn { statistics, bytes }) => {
                    defmt::info!("frame {=u32}: {=u32} us, {=u32} bytes, {}", frame, time, bytes, statistics);
                }
                // An error of the bus, for instance. The next frame opens its own windows and sends every pixel again.
                Err(problem) => {
                    defmt::error!("frame {=u32}: {=str}", frame, problem);
                    display.restart().unwrap_or_else(|problem| stop(problem));
                }
            }
        }
        stack::log();
    }
}
