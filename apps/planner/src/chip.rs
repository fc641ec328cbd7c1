//! The microcontrollers that the page offers.

use crate::choice::place;
use crate::figures::{ESP32C3_CYCLES, MODELLED};
use crate::json::{list, object, text};

/// A microcontroller.
pub(crate) struct Chip {
    /// Its name in a choice.
    pub(crate) key: &'static str,
    pub(crate) name: &'static str,
    pub(crate) core: &'static str,
    /// The index of its core in [`Constants`].
    pub(crate) column: usize,
    /// The clock in MHz.
    pub(crate) clock: f64,
    /// The clock of the fastest SPI in MHz.
    pub(crate) spi: f64,
    /// RAM in KB.
    pub(crate) ram: f64,
    pub(crate) error: &'static str,
    /// Cycles per instruction: for lines, faces, faces with depth.
    pub(crate) cycles: [f64; 3],
    /// The least and the most cycles per instruction, if not all of the core's rules are known.
    pub(crate) range: Option<[[f64; 3]; 2]>,
}

impl Chip {
    /// The cycles per instruction for a kind of drawing: `cycles` is the chip's own, or a bound of its range.
    pub(crate) fn of_kind(&self, cycles: &[f64; 3], kind: usize) -> f64 {
        match (self.key, kind) {
            ("rp2040", LARGE) => LARGE_CYCLES,
            _ => cycles.get(kind.min(2)).copied().unwrap_or_default(),
        }
    }

    /// Flash in KB: of an RP2040 that of a Pico, of an RP2350 that of a Pico 2, of an ESP32-C3 that of the usual modules.
    pub(crate) fn flash(&self) -> f64 {
        match self.key {
            "esp32c3" | "rp2350-ram" => 4096.0,
            "nrf52840" => 1024.0,
            "stm32f411" => 512.0,
            "stm32f030" => 256.0,
            "stm32f103" => 128.0,
            _ => 2048.0,
        }
    }

    /// Whether the code is copied to RAM before it runs.
    pub(crate) fn is_in_ram(&self) -> bool {
        self.key.ends_with("-ram")
    }

    /// The largest difference between the stated cycles per instruction and those of linked firmware, in percent.
    /// `apps/planner/sizes --times` compares them, and finds more than half of this. Code that shades faces in few bits a pixel fits an
    /// RP2040's cache better than that of 16-bit colour, and takes more of an ESP32-C3's slow instructions.
    pub(crate) fn cycles_error(&self, in_few_bits: bool) -> u32 {
        match (self.key, in_few_bits) {
            ("rp2040", true) => 60,
            ("esp32c3", true) => 50,
            ("rp2350-ram", true) => 15,
            ("esp32c3", false) => 40,
            ("rp2040", false) => 57,
            ("stm32f411" | "nrf52840", _) => 20,
            ("stm32f103", _) => 17,
            ("stm32f030", _) => 10,
            _ => 12,
        }
    }
}

/// The kind of faces with depth whose code is larger than a cache of 16 KB.
pub(crate) const LARGE: usize = 3;
/// Cycles per instruction of such code on an RP2040, whose flash has a cache of 16 KB. `apps/planner/sizes --times` finds 2.03 to
/// 3.42.
const LARGE_CYCLES: f64 = 2.55;

const ESP32C3: Chip = Chip {
    key: "esp32c3",
    name: "ESP32-C3, code in flash",
    core: "RV32IMC",
    column: 3,
    clock: 160.0,
    spi: 80.0,
    // 400 KB, of which 16 are the cache.
    ram: 384.0,
    error: "a range, as products of two words, divisions and stores in a row were not measured on it",
    cycles: ESP32C3_CYCLES[1],
    range: Some([ESP32C3_CYCLES[0], ESP32C3_CYCLES[2]]),
};

/// The chips that a choice may name, the usual one first.
pub(crate) const CHIPS: [Chip; MODELLED.len() + 1] = {
    let [a, b, c, d, e, f, g] = MODELLED;
    [a, b, c, d, e, f, g, ESP32C3]
};

/// The chips by their names in choices, with descriptions, as JSON.
pub(crate) fn chips() -> String {
    list(CHIPS.iter().map(|chip| object([("key", text(chip.key)), ("name", text(chip.name))])))
}

/// A chip of this name.
pub(crate) fn named(key: &str) -> Result<&'static str, String> {
    Ok(CHIPS[place(&CHIPS.each_ref().map(|chip| chip.key), key)?].key)
}
