//! Frames of an ESP32-C3: cycles by the rules of `timing/riscv.rs`, and what its cache adds.

use crate::cycles::emulated;
use crate::timing::flash::{DataCache, Flash, FlashRules};
use crate::timing::riscv::{Kind, Program, Rules};
use crate::{provenance, trace, Result};
use bench::timed::{Variant, IMAGES, TIMED};

/// The image in bands of 16 rows.
const IMAGE: usize = 1;

/// Code and constants in flash: a read-only cache of 16 KB, 8 ways, lines of 32 bytes (data sheet, section 3.1.5). Only the
/// number of its waits is used.
const FLASH: FlashRules =
    FlashRules { wait: 1, line: 32, prefetch: false, lines: 512, ways: 8, data: DataCache::Shared };

/// Cycles of a line, for [`Rules::Least`], [`Rules::Likely`] and [`Rules::Most`]: 84 clocks of 80 MHz by four wires; a load that
/// misses, measured on an ESP32-C6 (LLTA-Bench, as in `timing/riscv.rs`); and 152 clocks of 40 MHz by two wires.
const MISS: [u64; 3] = [168, 347, 608];

/// The sum of frames of a kind, with cycles by [`Rules::Least`], [`Rules::Likely`] and [`Rules::Most`].
#[derive(Clone, Copy, Default)]
pub(crate) struct Sum {
    instructions: u64,
    cycles: [u64; 3],
    /// Lines of code and mesh that the cache lacks.
    misses: u64,
}

impl Sum {
    /// Cycles per instruction where code and mesh are in RAM: least, likely, most.
    pub(crate) fn in_ram(&self) -> [f64; 3] {
        self.cycles.map(|cycles| cycles as f64 / self.instructions as f64)
    }

    /// Cycles per instruction with code and mesh in flash: least, likely, most.
    pub(crate) fn in_flash(&self) -> [f64; 3] {
        let waits = MISS.map(|wait| (self.misses * wait) as f64 / self.instructions as f64);
        let [least, likely, most] = self.in_ram();
        [least + waits[0], likely + waits[1], most + waits[2]]
    }
}

impl Sum {
    /// The instructions that were added.
    pub(crate) fn instructions(&self) -> u64 {
        self.instructions
    }

    /// Adds a frame: a run of `Clock::count`, with a mesh and other constants of `constants` bytes.
    pub(crate) fn add(&mut self, program: &Program, run: &[u32], constants: u32) -> Result<()> {
        // The function that the clock calls, by its only jump to a register.
        let is_call = |at: &u32| program.instruction(*at).is_some_and(|it| it.kind == Kind::JumpTo);
        let call = run.iter().position(is_call).ok_or("the clock calls nothing")?;
        let end = run[call] + program.instruction(run[call]).map_or(0, |it| it.size);
        let run = &run[call + 1..];
        let length = run.iter().position(|at| *at == end).ok_or("a frame does not return to the clock")?;
        let run = &run[..length];
        self.instructions += run.len() as u64;
        for (cycles, rules) in self.cycles.iter_mut().zip([Rules::Least, Rules::Likely, Rules::Most]) {
            *cycles += program.cycles(rules, run, end);
        }
        self.misses += misses(run, constants);
        Ok(())
    }
}

/// Measures lines, faces, and faces with depth.
pub(crate) fn measure() -> Result<[Sum; 3]> {
    let core = emulated("RV32")?;
    let name = IMAGES[IMAGE].0;
    core.build().cargo("build", &[format!("--bin={name}")])?;
    let image = core.build().image(name);
    let places = provenance::frames(&image)?;
    let mut runs = vec![Vec::new(); TIMED.len()];
    trace::frames(core, &image, &places, TIMED.len(), |number, block| {
        runs[number].extend(block.iter().map(|at| *at as u32)); // the board's addresses have 32 bits
    })?;
    let program = Program::of(&image)?;
    let mut sums = [Sum::default(); 3];
    for (timed, run) in TIMED.iter().zip(&runs) {
        let sum = &mut sums[match timed.variant {
            Variant::Wireframe => 0,
            Variant::Plain => 1,
            Variant::Depth => 2,
        }];
        sum.add(&program, run, timed.model.bytes() as u32)?;
    }
    Ok(sums)
}

/// The lines that a frame behind another one misses: of its code, and of the mesh, each once, as both together exceed the cache.
fn misses(run: &[u32], mesh: u32) -> u64 {
    let mut flash = Flash::new(FLASH);
    let mut pass = || -> u64 { run.iter().map(|at| flash.fetch(*at, 2, 0)).sum() };
    pass();
    pass() + u64::from(mesh.div_ceil(FLASH.line))
}
