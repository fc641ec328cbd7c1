//! The microcontrollers that the page offers.

use crate::choice::{place, Choice};
use crate::figures::{ESP32C3_CYCLES, MODELLED};
use crate::json::{list, object, text};

/// A microcontroller.
#[derive(Clone, Copy)]
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
    /// Flash in KB.
    pub(crate) flash: f64,
    /// The error of the timing, or the basis of an estimate.
    pub(crate) error: &'static str,
    /// Whether the timing was validated neither on this chip nor on one with its core and flash.
    pub(crate) is_estimate: bool,
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

    /// Whether the code is copied to RAM before it runs.
    pub(crate) fn is_in_ram(&self) -> bool {
        self.key.ends_with("-ram")
    }

    /// The largest difference between the stated cycles per instruction and those of linked firmware, in percent.
    /// `apps/planner/sizes --times` compares them, and finds more than half of this. Code that shades faces in few bits a pixel fits an
    /// RP2040's cache better than that of 16-bit colour, and takes more of an ESP32-C3's slow instructions.
    pub(crate) fn cycles_error(&self, in_few_bits: bool) -> u32 {
        match (self.key, in_few_bits) {
            _ if self.is_estimate => 40,
            ("rp2040", true) => 60,
            ("esp32c3", true) => 55,
            ("rp2350-ram", _) => 15,
            ("esp32c3", false) => 40,
            ("rp2040", false) => 57,
            ("stm32f411" | "nrf52840", _) => 21,
            ("stm32f103", _) => 18,
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

const STM32F0: Chip = MODELLED[3];
const STM32F1: Chip = MODELLED[4];
const STM32F4: Chip = MODELLED[5];

const ESP32C3: Chip = Chip {
    key: "esp32c3",
    name: "ESP32-C3, code in flash",
    core: "RV32IMC",
    column: 3,
    clock: 160.0,
    spi: 80.0,
    // 400 KB, of which 16 are the cache.
    ram: 384.0,
    // Of the usual modules.
    flash: 4096.0,
    error: "a range: wide products, divisions, runs of stores are not measured",
    is_estimate: false,
    cycles: ESP32C3_CYCLES[1],
    range: Some([ESP32C3_CYCLES[0], ESP32C3_CYCLES[2]]),
};

/// A chip whose timing is estimated from that of another chip: key, name, core and basis; MHz of the core and of its SPI, KB of RAM and of
/// flash.
const fn estimate(texts: [&'static str; 4], numbers: [f64; 4], from: Chip) -> Chip {
    let ([key, name, core, error], [clock, spi, ram, flash]) = (texts, numbers);
    Chip { key, name, core, error, is_estimate: true, clock, spi, ram, flash, ..from }
}

/// Cycles per instruction of an M4 without wait states, times a factor.
const fn m4_times(factor: f64) -> [f64; 3] {
    [1.28 * factor, 1.36 * factor, 1.38 * factor]
}

const STM32H7: Chip = Chip {
    cycles: m4_times(0.68),
    range: Some([m4_times(0.5), m4_times(1.0)]),
    ..estimate(
        [
            "stm32h743",
            "STM32H743",
            "M7",
            "half to all of an M4's cycles, by CoreMark per MHz: 5.01, of an M4 3.42",
        ],
        [480.0, 75.0, 512.0, 2048.0],
        STM32F4,
    )
};

/// The chips that a choice may name, the usual one first, and [`OWN`] last.
pub(crate) static CHIPS: [Chip; 14] = [
    MODELLED[0],
    MODELLED[1],
    MODELLED[2],
    STM32F0,
    estimate(
        ["stm32g071", "STM32G071", "M0+", "cycles of an STM32F030, with a wait state less"],
        [64.0, 32.0, 36.0, 128.0],
        STM32F0,
    ),
    STM32F1,
    STM32F4,
    STM32H7,
    estimate(
        ["stm32l476", "STM32L476", "M4", "cycles of an STM32F411, which has this core and flash cache"],
        [80.0, 40.0, 96.0, 1024.0],
        STM32F4,
    ),
    MODELLED[6],
    ESP32C3,
    estimate(
        ["esp32c6", "ESP32-C6, code in flash", "RV32IMAC", "the range of an ESP32-C3, a similar core"],
        [160.0, 80.0, 452.0, 4096.0],
        ESP32C3,
    ),
    estimate(
        ["samd21", "SAMD21x18", "M0+", "cycles of an STM32F030, with as many wait states"],
        [48.0, 12.0, 32.0, 256.0],
        STM32F0,
    ),
    estimate([OWN, "own chip", "M4", "cycles of another chip with this core"], [0.0; 4], STM32F4),
];

/// The name of the chip whose core, clock and memory the user states.
const OWN: &str = "own";

/// The cores of an own chip, and the keys of the chips whose cycles it has.
pub(crate) const CORES: [(&str, &str); 6] = [
    ("M0+", "stm32f030"),
    ("M3", "stm32f103"),
    ("M4", "stm32f411"),
    ("M33", "rp2350-ram"),
    ("M7", "stm32h743"),
    ("RV32IMC", "esp32c3"),
];

/// The chip of a key: the usual one if there is none, and an own one as the choice states it.
pub(crate) fn stated(key: &str, choice: &Choice) -> Chip {
    let with_key = |key: &str| *CHIPS.iter().find(|chip| chip.key == key).unwrap_or(&CHIPS[0]);
    let chip = with_key(key);
    if key != OWN {
        return chip;
    }
    let [clock, ram, flash] = choice.own.map(f64::from);
    let (core, from) = CORES[choice.core];
    let from = with_key(from);
    // The fastest SPI of most chips has half the core's clock.
    Chip {
        core,
        column: from.column,
        cycles: from.cycles,
        range: from.range,
        clock,
        spi: clock / 2.0,
        ram,
        flash,
        ..chip
    }
}

/// The chips by their names in choices, with descriptions, as JSON.
pub(crate) fn chips() -> String {
    list(CHIPS.iter().map(|chip| {
        object(&[
            ("key", text(chip.key)),
            ("name", text(chip.name)),
            ("basis", text(if chip.is_estimate { chip.error } else { "" })),
        ])
    }))
}

/// A chip of this name.
pub(crate) fn named(key: &str) -> Result<&'static str, String> {
    let keys: Vec<_> = CHIPS.iter().map(|chip| chip.key).collect();
    Ok(keys[place(&keys, key)?])
}
