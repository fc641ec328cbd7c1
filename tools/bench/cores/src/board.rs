//! mps2-an521 (Arm, *Application Note AN521*): two Cortex-M33 that see one memory, the second of which waits after reset.

use crate::both_cores::{serve, PaintedStack};
use core::ptr::with_exposed_provenance_mut;

/// The system control registers (Arm, *CoreLink SSE-200 Technical Reference Manual*): the second core's vector table, and a bit
/// for each core that waits.
const SECOND_VECTORS: usize = 0x5002_1114;
const CPU_WAIT: usize = 0x5002_1118;

fn write(register: usize, value: u32) {
    // SAFETY: the registers above, which nothing else writes.
    unsafe { with_exposed_provenance_mut::<u32>(register).write_volatile(value) };
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
