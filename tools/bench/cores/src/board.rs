//! mps2-an521 (Arm, *Application Note AN521*): two Cortex-M33 that see one memory, the second of which waits after reset, and a
//! timer of 20 MHz. Under `-icount shift=6` an instruction takes 64 ns, so 25/32 instructions pass in a tick. While both cores
//! run, the emulator's clock counts the instructions of both: here it is read only while one runs.

use crate::both_cores::{serve, PaintedStack};
use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

/// Timer 0 in the secure state (Arm, *Cortex-M System Design Kit*, chapter 4, "APB timer"): 32 bits, counting down.
const CONTROL: usize = 0x5000_0000;
const VALUE: usize = 0x5000_0004;
const RELOAD: usize = 0x5000_0008;

/// The system control registers (Arm, *CoreLink SSE-200 Technical Reference Manual*): the second core's vector table, and a bit
/// for each core that waits.
const SECOND_VECTORS: usize = 0x5002_1114;
const CPU_WAIT: usize = 0x5002_1118;

fn write(register: usize, value: u32) {
    // SAFETY: the registers above, which nothing else writes.
    unsafe { with_exposed_provenance_mut::<u32>(register).write_volatile(value) };
}

/// Counts instructions of one core, exactly to the one or two that are cut off at both ends.
pub(crate) struct Clock {
    /// The count of a measurement of nothing.
    own: u32,
}

impl Clock {
    /// `None` if the emulator's clock is not the expected one: a loop of known length tells.
    pub(crate) fn new() -> Option<Self> {
        write(RELOAD, u32::MAX);
        write(VALUE, u32::MAX);
        write(CONTROL, 1);
        let mut clock = Self { own: 0 };
        clock.own = clock.count(|| ());
        let [short, long] = [100, 50_100].map(|turns| clock.count(|| cortex_m::asm::delay(turns)));
        // Two instructions a turn: subtract, branch.
        ((long - short).abs_diff(2 * 50_000) <= 1).then_some(clock)
    }

    /// At most 3 · 10⁹ instructions.
    #[inline(never)]
    pub(crate) fn count(&self, work: impl FnOnce()) -> u32 {
        let start = now();
        work();
        let ticks = start.wrapping_sub(now()); // counts down
        ((u64::from(ticks) * 25).div_ceil(32) as u32).saturating_sub(self.own)
    }
}

#[inline(never)]
fn now() -> u32 {
    // SAFETY: a register of the board on which this runs; reading changes nothing.
    unsafe { with_exposed_provenance::<u32>(VALUE).read_volatile() }
}

/// A vector table: the end of the stack, and the entry point.
#[repr(C, align(128))]
struct Vectors {
    stack: *const PaintedStack<WORDS>,
    reset: extern "C" fn() -> !,
}

/// Of the second core's stack.
const WORDS: usize = 2048;

// SAFETY: it is constant.
unsafe impl Sync for Vectors {}

pub(crate) static STACK: PaintedStack<WORDS> = PaintedStack::new();
static VECTORS: Vectors =
    // SAFETY: the address behind the stack is computed, not read.
    Vectors { stack: unsafe { (&raw const STACK).add(1) }, reset: second };

/// The entry point of the second core. The first core has set up all memory.
extern "C" fn second() -> ! {
    serve()
}

/// Starts the second core.
pub(crate) fn start_second() {
    STACK.paint();
    write(SECOND_VECTORS, (&raw const VECTORS).expose_provenance() as u32);
    write(CPU_WAIT, 0);
}
