//! The waiting times of a display controller.
//!
//! After the data sheets' chapters on reset, on the commands SWRESET, SLPIN and SLPOUT, and on the timing of the reset line
//! (Sitronix ST7789V; Ilitek ILI9341), which ask for equal times.

const US: u64 = 1000;
const MS: u64 = 1000 * US;
/// The shortest pulse that resets the controller for sure.
const RESET_PULSE: u64 = 10 * US;
/// From the end of a reset, or from a command that changes the power supply, to the next command.
const SUPPLY: u64 = 5 * MS;
/// From a reset, or from the other sleep command, to a sleep command.
const SLEEP: u64 = 120 * MS;

const SWRESET: u8 = 0x01;
const SLPIN: u8 = 0x10;
const SLPOUT: u8 = 0x11;

/// The times from which on the controller takes commands.
#[derive(Debug)]
pub(crate) struct Timing {
    /// The time since which the reset line is low, while it is low.
    reset: Option<u64>,
    /// The earliest time of any command, and why.
    any: (u64, &'static str),
    /// The earliest time of a command that begins or ends sleep.
    sleep: (u64, &'static str),
}

impl Timing {
    /// Powered on at time 0, which is a reset.
    pub(crate) fn new() -> Self {
        Self { reset: None, any: (SUPPLY, "power on"), sleep: (SLEEP, "power on") }
    }

    /// The reset line has changed. Returns whether this has reset the controller.
    pub(crate) fn reset_line(&mut self, high: bool, time: u64) -> Result<bool, String> {
        if !high {
            self.reset.get_or_insert(time);
            return Ok(false);
        }
        let Some(since) = self.reset.take() else { return Ok(false) };
        let pulse = time - since;
        if pulse < RESET_PULSE {
            return Err(format!("a reset pulse of {pulse} ns: the controller needs {RESET_PULSE} ns"));
        }
        self.wait(time, "reset");
        Ok(true)
    }

    /// A command.
    pub(crate) fn command(&mut self, command: u8, time: u64) -> Result<(), String> {
        if self.reset.is_some() {
            return Err(format!("command {command:#04x} while the reset line is low"));
        }
        let sleeps = matches!(command, SLPIN | SLPOUT);
        let earliest = [Some(self.any), sleeps.then_some(self.sleep)];
        if let Some((earliest, why)) = earliest.into_iter().flatten().find(|(earliest, _)| time < *earliest) {
            let early = (earliest - time).div_ceil(US);
            return Err(format!("command {command:#04x} is {early} µs too early after {why}"));
        }
        let why = match command {
            SWRESET => "SWRESET",
            SLPIN => "SLPIN",
            SLPOUT => "SLPOUT",
            _ => return Ok(()),
        };
        self.wait(time, why);
        Ok(())
    }

    /// After a reset, or a change of the power supply.
    fn wait(&mut self, time: u64, why: &'static str) {
        self.any = (time + SUPPLY, why);
        self.sleep = (time + SLEEP, why);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INVON: u8 = 0x21;

    #[test]
    fn a_patient_driver_is_let_through() {
        let mut timing = Timing::new();
        assert_eq!(timing.reset_line(true, 0), Ok(false));
        assert_eq!(timing.reset_line(false, 100), Ok(false));
        assert_eq!(timing.reset_line(true, 100 + 10_000), Ok(true));
        assert_eq!(timing.command(INVON, 5_010_100), Ok(()));
        assert_eq!(timing.command(SLPOUT, 120_010_100), Ok(()));
        assert_eq!(timing.command(INVON, 125_010_100), Ok(()));
        assert_eq!(timing.command(SWRESET, 125_010_101), Ok(()));
        assert_eq!(timing.command(SLPOUT, 245_010_101), Ok(()));
    }

    #[test]
    fn each_time_that_is_too_short_is_an_error() {
        let mut timing = Timing::new();
        for (obeyed, [(command, early), (sleep, earlier)], why) in [
            (None, [(INVON, 4_999_000), (SLPOUT, 119_000_000)], "power on"),
            (Some((SWRESET, 5_000_000)), [(INVON, 9_999_999), (SLPOUT, 124_000_000)], "SWRESET"),
            (Some((SLPOUT, 125_000_000)), [(INVON, 129_999_000), (SLPIN, 244_000_000)], "SLPOUT"),
        ] {
            if let Some((command, time)) = obeyed {
                timing.command(command, time).expect("late enough");
            }
            let refused = |command: u8, early: u32| {
                Err(format!("command {command:#04x} is {early} µs too early after {why}"))
            };
            assert_eq!(timing.command(command, early), refused(command, 1));
            assert_eq!(timing.command(sleep, earlier), refused(sleep, 1000));
        }

        timing.reset_line(false, 300_000_000).expect("a pulse begins");
        let low = "command 0x21 while the reset line is low";
        assert_eq!(timing.command(INVON, 300_000_001), Err(low.into()));
        let pulse = "a reset pulse of 9999 ns: the controller needs 10000 ns";
        assert_eq!(timing.reset_line(true, 300_009_999), Err(pulse.into()));
    }
}
