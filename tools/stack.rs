//! How deep the stack was: painted first, looked at afterwards. (`unsafe`, for no safe code can speak of memory below its own
//! frame.)

use core::ptr::with_exposed_provenance_mut;

extern "C" {
    /// The top of RAM, where the stack begins.
    static _stack_start: u32;
    /// The first word above all variables: how far the stack may come down.
    static __sheap: u32;
}

const COLOUR: u32 = 0x5afe_57ac;
/// More than the frames here have below `here`.
const MARGIN: usize = 128;

/// Paints the RAM between the variables and the stack. For firmware without a heap.
#[inline(never)]
pub fn paint() {
    let here = 0u32;
    for at in (bottom()..((&raw const here).addr() & !3) - MARGIN).step_by(4) {
        // SAFETY: aligned RAM above all variables and below all frames that are alive, this one included; what an interrupt
        // puts there is gone when it ends.
        unsafe { with_exposed_provenance_mut::<u32>(at).write_volatile(COLOUR) };
    }
}

/// Bytes from the top of RAM to the deepest one that has changed since [`paint`], frames of the program itself and of
/// interrupts included.
#[inline(never)]
pub fn deepest() -> usize {
    let here = 0u32;
    let (mut at, end) = (bottom(), (&raw const here).addr() & !3);
    // SAFETY: as above; `paint` has made a number of every word. If it was not called, or not from here, RAM is read
    // that nothing else looks at.
    while at < end && unsafe { with_exposed_provenance_mut::<u32>(at).read_volatile() } == COLOUR {
        at += 4;
    }
    (&raw const _stack_start).addr() - at
}

/// On a word.
fn bottom() -> usize {
    (&raw const __sheap).addr().next_multiple_of(4)
}
