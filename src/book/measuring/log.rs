use super::meter::Measured;
use pinhole::draw::Statistics;

/// The core's clock.
const MEGAHERTZ: u32 = 100;

pub fn log(number: u32, frame: &Measured, statistics: &Statistics) {
    let percent = frame.waited / (frame.cycles / 100).max(1);
    defmt::info!(
        "frame {=u32}: {=u32} us, {=u32} % waiting, {=u32} bytes, {}",
        number,
        frame.cycles / MEGAHERTZ,
        percent,
        frame.bytes,
        statistics
    );
}
