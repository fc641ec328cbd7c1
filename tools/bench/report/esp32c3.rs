//! Frames of an ESP32-C3: cycles by the rules of `timing/riscv.rs`, and what its cache adds.

use crate::chips::rounded;
use crate::core::emulated;
use crate::data::{row, Row};
use crate::record::{record, Recorded};
use crate::timing::flash::{DataCache, Flash, FlashRules};
use crate::timing::riscv::{Program, Rules};
use crate::{provenance, Result};
use bench::timed::{Variant, IMAGES, TIMED};
use serde_json::json;

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
    pub(crate) instructions: u64,
    in_ram: [u64; 3],
    /// Lines of code and mesh that the cache lacks.
    misses: u64,
}

impl Sum {
    /// Cycles with code and mesh in flash: least, likely, most.
    pub(crate) fn in_flash(&self) -> [u64; 3] {
        [0, 1, 2].map(|at| self.in_ram[at] + self.misses * MISS[at])
    }

    /// Adds a frame, with a mesh and other constants of `constants` bytes.
    pub(crate) fn add(&mut self, program: &Program, Recorded { run, end }: &Recorded, constants: u32) {
        let run: Vec<u32> = run.iter().map(|executed| executed.at).collect();
        self.instructions += run.len() as u64;
        for (cycles, rules) in self.in_ram.iter_mut().zip([Rules::Least, Rules::Likely, Rules::Most]) {
            *cycles += program.cycles(rules, &run, *end);
        }
        // The lines that a frame behind another one misses: of its code, and of the mesh, each once, as both together exceed the cache.
        let mut flash = Flash::new(FLASH);
        let mut pass = || -> u64 { run.iter().map(|at| flash.fetch(*at, 2, 0)).sum() };
        pass();
        self.misses += pass() + u64::from(constants.div_ceil(FLASH.line));
    }
}

/// The cycles of an instruction in lines, faces, and faces with depth.
pub(crate) fn rows() -> Result<Vec<Row>> {
    let core = emulated("RV32")?;
    let name = IMAGES[IMAGE].0;
    core.build().cargo("build", &[format!("--bin={name}")])?;
    let image = core.build().image(name);
    let recorded = record(core, &image, &provenance::frames(&image)?, TIMED.len())?;
    let program = Program::of(&image)?;
    let mut sums = [Sum::default(); 3];
    for (timed, frame) in TIMED.iter().zip(&recorded.frames) {
        let sum = &mut sums[match timed.variant {
            Variant::Wireframe => 0,
            Variant::Plain => 1,
            Variant::Depth => 2,
        }];
        sum.add(&program, frame, timed.model.bytes() as u32);
    }
    let row_of = |chip: &str, cycles: fn(&Sum) -> [u64; 3]| {
        let [least, likely, most] = [0, 1, 2]
            .map(|at| json!(sums.map(|sum| rounded(cycles(&sum)[at] as f64 / sum.instructions as f64))));
        row([
            ("chip", json!(chip)),
            ("core", json!("RV32")),
            ("mhz", json!(160)),
            ("cycles", likely),
            ("least", least),
            ("most", most),
        ])
    };
    Ok(vec![
        row_of("ESP32-C3, code in RAM", |sum| sum.in_ram),
        row_of("ESP32-C3, code in flash", Sum::in_flash),
    ])
}
