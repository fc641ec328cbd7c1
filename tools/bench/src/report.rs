//! Six cells, drawn on a board: `cargo run --release --example report` in a template logs what `cargo run -p pinhole-report -- LOG` reads.

use crate::bands::{self, bytes, pixels, EdgeStorage, Storage};
use crate::cells::{TORUS, TORUS_BINS, TORUS_EDGE_BINS, TORUS_SMOOTH};
use crate::measure::Display;
use crate::scene::{self, area, Scene, LINE};
use core::hint::black_box;
use pinhole::{draw::SmoothEdge, prelude::*};

/// What the frames are drawn in: a strip of 10 rows of 240 pixels and two rows more, and the torus's cache and bins.
pub struct Memory {
    mesh: MeshBuffers<TORUS, TORUS_BINS, TORUS_EDGE_BINS>,
    strip: StripBuffers<{ bytes(10) }, { pixels(10) }>,
    kept: [u8; bytes(2)],
    list: [SmoothEdge; 16],
}

impl Memory {
    pub const NEW: Self = Self {
        mesh: MeshBuffers::new(),
        strip: StripBuffers::new(),
        kept: [0; bytes(2)],
        list: [SmoothEdge::EMPTY; 16],
    };
}

/// A frame of a cell, from placing the mesh to the bytes of the last band.
pub struct Row {
    pub scene: &'static str,
    pub variant: &'static str,
    pub cycles: u32,
    /// The CRC-32 of the pixels as little-endian numbers.
    pub crc: u32,
}

/// Tenths of frames a second, rounded down, where a frame takes so many cycles.
pub fn tenths(megahertz: u32, cycles: u32) -> u32 {
    // Less than 2⁵⁶.
    let tenths = (u64::from(megahertz) * 10_000_000).checked_div(cycles.into());
    tenths.and_then(|tenths| tenths.try_into().ok()).unwrap_or(u32::MAX)
}

/// The compiler that has built this.
pub const COMPILER: &str = env!("BENCH_COMPILER");

/// Logs a report by the `defmt` of the firmware, and waits for ever: the chip, its core and its clock in MHz, and what [`each`] draws.
/// Where the core's own counter, [`counter`], does not count, two arguments more are the last count and the counter for [`each`].
#[macro_export]
macro_rules! log_report {
    ($chip:expr, $core:expr, $megahertz:expr) => {{
        use $crate::report::counter;
        defmt::unwrap!(counter::start());
        $crate::log_report!($chip, $core, $megahertz, counter::LAST, counter::cycles())
    }};
    ($chip:expr, $core:expr, $megahertz:expr, $last:expr, $cycles:expr) => {{
        use $crate::report::{each, memory, tenths, Row, COMPILER};
        let megahertz: u32 = $megahertz;
        defmt::info!("report: chip {=str}, {=str}, {=u32} MHz, {=str}", $chip, $core, megahertz, COMPILER);
        let mut row = |Row { scene, variant, cycles, crc }: Row| {
            let speed = tenths(megahertz, cycles);
            defmt::info!(
                "report: {=str} {=str} {=u32} cycles, {=u32}.{=u32} frames/s, crc {=u32:08x}",
                scene,
                variant,
                cycles,
                speed / 10,
                speed % 10,
                crc
            );
        };
        defmt::unwrap!(each(defmt::unwrap!(memory()), $last, &mut || $cycles, &mut row));
        defmt::info!("report: end");
        loop {
            core::hint::spin_loop();
        }
    }};
}

/// The memory of a report, once.
#[cfg(target_os = "none")]
pub fn memory() -> Option<&'static mut Memory> {
    #[cfg(target_arch = "arm")]
    use cortex_m::singleton;
    #[cfg(target_arch = "riscv32")]
    use riscv::singleton;
    singleton!(: Memory = Memory::NEW)
}

/// SysTick, which counts the cycles of every Cortex-M down.
#[cfg(all(target_os = "none", target_arch = "arm"))]
pub mod counter {
    use cortex_m::peripheral::{syst::SystClkSource, SYST};

    pub const LAST: u32 = (1 << 24) - 1;

    /// `None` if the core's peripherals are in use.
    pub fn start() -> Option<()> {
        let mut timer = cortex_m::Peripherals::take()?.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(LAST);
        timer.clear_current();
        timer.enable_counter();
        Some(())
    }

    pub fn cycles() -> u32 {
        LAST - SYST::get_current() // 24 bits
    }
}

/// The low word of `mcycle`.
#[cfg(all(target_os = "none", target_arch = "riscv32"))]
pub mod counter {
    pub const LAST: u32 = u32::MAX;

    pub fn start() -> Option<()> {
        Some(())
    }

    pub fn cycles() -> u32 {
        riscv::register::mcycle::read() as u32
    }
}

/// Wires, faces, faces with depth of a cube and of a torus, and the torus with smooth silhouettes.
const CELLS: [[&str; 2]; 6] = [
    ["S1", "bands8"],
    ["S2", "bands8"],
    ["S2", "bands8-z"],
    ["S3", "bands8"],
    ["S3", "bands8-z"],
    ["S3", "bands8-z-edges"],
];

/// Draws each cell three times, and reports the second time. `cycles` reads a counter of the core's clock that counts up and starts again
/// after `last`, which is a power of two less 1; the frames take up to 8 million cycles. `None` if a cell cannot be drawn.
pub fn each(
    memory: &mut Memory,
    last: u32,
    cycles: &mut dyn FnMut() -> u32,
    row: &mut dyn FnMut(Row),
) -> Option<()> {
    for [scene, variant] in CELLS {
        draw(scene, variant, memory, &mut |frame| {
            let (mut display, mut good) = (Display::default(), true);
            let mut once = |display: &mut Display| good &= frame(display).is_some();
            once(&mut display);
            let begin = cycles();
            once(&mut display);
            let cycles = cycles().wrapping_sub(begin) & last;
            let crc = display.look(&mut once);
            row(good.then_some(Row { scene, variant, cycles, crc })?);
            Some(())
        })?;
    }
    Some(())
}

type Frame<'f> = dyn FnMut(&mut Display) -> Option<()> + 'f;

/// Hands a frame of a cell to `count`.
fn draw(
    scene: &str,
    variant: &str,
    memory: &mut Memory,
    count: &mut dyn FnMut(&mut Frame<'_>) -> Option<()>,
) -> Option<()> {
    let Memory {
        mesh: MeshBuffers { cache, bins, edge_bins },
        strip: StripBuffers { colors, depths, .. },
        kept,
        list,
    } = memory;
    let has_faces = scene != "S1";
    let is_smooth = variant == "bands8-z-edges";
    let scene = Scene::new(match scene {
        "S3" if is_smooth => &TORUS_SMOOTH,
        "S3" => &scene::TORUS,
        _ => &scene::CUBE,
    })?;
    let light = scene.light();
    let rows = if is_smooth { 10 } else { 8 };
    let (colors, depths) = (colors.get_mut(..bytes(rows))?, depths.get_mut(..pixels(rows))?);
    count(&mut |display| {
        let storage = Storage { corners: cache, bin_storage: bins, strip: colors, depth: depths };
        let scene = black_box(&scene);
        match (variant, &light) {
            ("bands8-z-edges", Some(light)) => bands::lit_smooth(
                scene,
                light,
                storage,
                EdgeStorage { kept, bins: edge_bins, list },
                false,
                display,
            ),
            ("bands8-z", Some(light)) => bands::lit_depth(scene, light, storage, display),
            (_, Some(light)) if has_faces => bands::lit_solid(scene, light, storage, display),
            _ => bands::wireframe(&scene.place(), area().size, storage, |edges, band| {
                let Ok(()) = edges.draw(LINE, &mut band.pixels());
                display.take_bytes(band.bytes());
            }),
        }
    })
}

#[cfg(all(test, not(target_os = "none")))]
mod tests {
    use super::*;
    use crate::cells::CELLS;

    /// The pictures are those of the cells of which the page has figures.
    #[test]
    fn pictures_are_those_of_the_cells() {
        let (mut memory, mut now, mut rows) = (Box::new(Memory::NEW), 0xff_fff0, Vec::new());
        let mut clock = || {
            now += 100;
            now & 0xff_ffff // it starts again
        };
        each(&mut memory, 0xff_ffff, &mut clock, &mut |row| rows.push(row)).expect("six pictures");
        for row in &rows {
            let cell =
                CELLS.iter().find(|(scene, variant, _)| [scene, variant] == [&row.scene, &row.variant]);
            let (.., draw) = cell.expect("a cell");
            assert_eq!(
                (row.cycles, row.crc),
                (100, draw().expect("a picture").crc),
                "{} {}",
                row.scene,
                row.variant
            );
        }
        assert_eq!(rows.len(), 6);
    }
}
