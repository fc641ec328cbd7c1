//! The registers that are used, by name: all `unsafe` code of the board.
//! (Stellaris LM3S6965 data sheet: chapters on system control, GPIO, UART and SSI.)

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

/// A register; its value is its address.
#[derive(Clone, Copy)]
#[repr(usize)]
pub(crate) enum Register {
    /// Clocks of serial devices, and of GPIO ports.
    RunClock1 = 0x400F_E104,
    RunClock2 = 0x400F_E108,

    /// Port C: pin 7 alone, then the directions and the digital enable of all pins.
    PortCPin7 = pin(0x4000_6000, 7),
    PortCDirection = 0x4000_6400,
    PortCDigital = 0x4000_651C,
    /// Port D, the same with pin 0.
    PortDPin0 = pin(0x4000_7000, 0),
    PortDDirection = 0x4000_7400,
    PortDDigital = 0x4000_751C,

    /// SSI0, a PL022.
    SsiControl0 = 0x4000_8000,
    SsiControl1 = 0x4000_8004,
    SsiData = 0x4000_8008,
    SsiStatus = 0x4000_800C,
    SsiPrescale = 0x4000_8010,

    /// UART0, a PL011.
    UartData = 0x4000_C000,
    UartFlags = 0x4000_C018,
    UartLine = 0x4000_C02C,
    UartControl = 0x4000_C030,
}

/// The register of one pin of a port: the address says which bits of the data it reaches.
const fn pin(port: usize, number: usize) -> usize {
    port + (4 << number)
}

impl Register {
    pub(crate) fn read(self) -> u32 {
        // SAFETY: the addresses above are aligned 32-bit registers of this microcontroller, outside all memory that
        // Rust knows; only `Board` reads them, and there is none elsewhere.
        unsafe { with_exposed_provenance::<u32>(self as usize).read_volatile() }
    }

    pub(crate) fn write(self, value: u32) {
        // SAFETY: as for `read`; and none of these registers starts a transfer from or to memory.
        unsafe { with_exposed_provenance_mut::<u32>(self as usize).write_volatile(value) }
    }

    pub(crate) fn set(self, bits: u32) {
        self.write(self.read() | bits);
    }

    /// Waits until a bit is 1.
    pub(crate) fn until_set(self, bit: u32) {
        while self.read() & bit == 0 {}
    }

    /// Waits until a bit is 0.
    pub(crate) fn until_clear(self, bit: u32) {
        while self.read() & bit != 0 {}
    }
}
