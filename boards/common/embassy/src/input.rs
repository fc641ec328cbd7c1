//! A rotary encoder with a button, read every millisecond. The readings are shared with the drawing through atomics: the task that
//! reads runs in an interrupt, so that it is served in the middle of a band.

use core::convert::Infallible;
use core::sync::atomic::{AtomicBool, AtomicI32, AtomicU32, Ordering::Relaxed};
use embassy_sync::{blocking_mutex::raw::CriticalSectionRawMutex, signal::Signal};
use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::InputPin;

const PERIOD: Duration = Duration::from_millis(1);
/// Readings of a button before it counts as pressed or released: its contacts bounce for some milliseconds.
const BOUNCES: u8 = 5;

// Each has one writer, so that load and store are enough.
static QUARTERS: AtomicI32 = AtomicI32::new(0);
static RUNNING: AtomicBool = AtomicBool::new(true);
static LATE: AtomicU32 = AtomicU32::new(0);
static CHANGED: Signal<CriticalSectionRawMutex, ()> = Signal::new();

/// Clicks of the encoder since the start. A click is four changes of its contacts, and counts after the second one.
pub fn clicks() -> i32 {
    QUARTERS.load(Relaxed).wrapping_add(2) >> 2
}

/// Whether the model turns by itself: each press of the button changes it.
pub fn running() -> bool {
    RUNNING.load(Relaxed)
}

/// How late a reading was at most, in microseconds.
pub fn late() -> u32 {
    LATE.load(Relaxed)
}

/// Waits until the encoder or the button has changed.
pub async fn changed() {
    CHANGED.wait().await
}

/// Reads the encoder's two contacts, and a button. All close to ground. A pin that cannot be read counts as open.
pub async fn read<Pin: InputPin>([mut first, mut second]: [Pin; 2], mut button: Pin) -> Infallible {
    let closed = |pin: &mut Pin| pin.is_low().unwrap_or(false);
    let mut position = || usize::from(closed(&mut first)) << 1 | usize::from(closed(&mut second));
    let (mut at, mut pressed, mut differs) = (position(), closed(&mut button), 0);
    let mut due = Instant::now();
    loop {
        due += PERIOD;
        Timer::at(due).await;
        let late = due.elapsed().as_micros() as u32; // wraps after an hour
        LATE.store(LATE.load(Relaxed).max(late), Relaxed);

        let new = position();
        // From row to column: one contact has changed in one direction or the other; 0 where none or both have.
        let quarter = [[0, -1, 1, 0], [1, 0, 0, -1], [-1, 0, 0, 1], [0, 1, -1, 0]];
        let quarter: i32 = quarter.get(at).and_then(|row| row.get(new)).copied().unwrap_or(0);
        at = new;
        let before = clicks();
        QUARTERS.store(QUARTERS.load(Relaxed).wrapping_add(quarter), Relaxed);

        differs = if closed(&mut button) == pressed { 0 } else { differs + 1 };
        let changes = differs == BOUNCES;
        if changes {
            (pressed, differs) = (!pressed, 0);
            RUNNING.store(running() != pressed, Relaxed);
        }
        if changes || clicks() != before {
            CHANGED.signal(());
        }
    }
}
