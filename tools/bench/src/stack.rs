//! How deep the stack was: painted first, looked at afterwards. The only unsafe code here, for no safe code can speak of
//! memory below its own frame.

#[cfg(target_os = "none")]
mod paint {
    use core::ptr::with_exposed_provenance_mut;

    extern "C" {
        /// The top of RAM, where `cortex-m-rt` starts the stack.
        static _stack_start: u32;
    }

    const COLOUR: u32 = 0x5afe_57ac;
    /// What is painted below the frame of who asks, less this frame itself.
    const DEPTH: usize = 64 << 10;
    const MARGIN: usize = 128;

    fn top() -> usize {
        (&raw const _stack_start).addr()
    }

    /// Paints 64 KB below here.
    #[inline(never)]
    pub fn paint() {
        let here = 0u32;
        let sp = (&raw const here).addr() & !3;
        for at in (sp - DEPTH..sp - MARGIN).step_by(4) {
            // SAFETY: aligned RAM, of which the board has 4 MB and the programs use less than 1; it lies below all frames
            // that are alive, and the margin is more than this one can have below `here`. No interrupt is enabled.
            unsafe { with_exposed_provenance_mut::<u32>(at).write_volatile(COLOUR) };
        }
    }

    /// Bytes from the top of RAM to the deepest one that has changed since [`paint`], called from the same frame.
    #[inline(never)]
    pub fn deepest() -> usize {
        let here = 0u32;
        let sp = (&raw const here).addr() & !3;
        let mut at = sp - DEPTH + MARGIN;
        // SAFETY: as above; `paint` has made a number of every word.
        while at < sp && unsafe { with_exposed_provenance_mut::<u32>(at).read_volatile() } == COLOUR {
            at += 4;
        }
        top() - at
    }
}

#[cfg(target_os = "none")]
pub use paint::{deepest, paint};

/// The host's stack is of no interest.
#[cfg(not(target_os = "none"))]
pub fn paint() {}

#[cfg(not(target_os = "none"))]
pub fn deepest() -> usize {
    0
}
