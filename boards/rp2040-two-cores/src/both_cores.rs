//! Work for both cores at once: the first core lends the second one a closure, which may borrow, and goes on when both are done.
//!
//! It needs no more than atomic loads and stores, which a Cortex-M0+ has, and WFE and SEV. In a test, QEMU runs this file on two
//! Cortex-M33 (`tools/bench/cores`).

use core::ops::Range;
use core::ptr::null_mut;
use core::sync::atomic::{AtomicPtr, AtomicUsize, Ordering::Acquire, Ordering::Relaxed, Ordering::Release};
use cortex_m::asm::{sev, wfe};

type Work<'w> = &'w mut (dyn FnMut() + Send);

/// The work of the second core, null while it has none.
static WORK: AtomicPtr<Work<'static>> = AtomicPtr::new(null_mut());

/// Memory for the second core's stack, painted, so that the first core sees how much of it has been used.
#[repr(align(32))]
pub struct PaintedStack<const WORDS: usize>([AtomicUsize; WORDS]);

const PAINT: usize = 0xcccc_cccc;

impl<const WORDS: usize> PaintedStack<WORDS> {
    pub const fn new() -> Self {
        Self([const { AtomicUsize::new(0) }; WORDS])
    }

    /// Paints it, and returns its beginning and end.
    pub fn paint(&'static self) -> Range<*mut usize> {
        self.0.iter().for_each(|word| word.store(PAINT, Relaxed));
        let Range { start, end } = self.0.as_ptr_range();
        start.cast_mut().cast()..end.cast_mut().cast()
    }

    /// Bytes that have been used since it was painted.
    pub fn used(&self) -> usize {
        let painted = self.0.iter().take_while(|word| word.load(Relaxed) == PAINT).count();
        (WORDS - painted) * size_of::<usize>() // at most all words are painted
    }
}

/// The second core, as the first one sees it.
pub struct OtherCore(());

impl OtherCore {
    /// `start` makes the second core call [`serve`].
    pub fn new<E>(start: impl FnOnce() -> Result<(), E>) -> Result<Self, E> {
        start()?;
        Ok(Self(()))
    }

    /// Does `ours` here and `theirs` on the second core, and returns when both are done.
    pub fn both(&mut self, ours: impl FnOnce(), theirs: impl FnOnce() + Send) {
        let mut theirs = Some(theirs);
        let mut once = || {
            if let Some(theirs) = theirs.take() {
                theirs();
            }
        };
        let mut work: Work<'_> = &mut once;
        WORK.store((&raw mut work).cast(), Release);
        sev();
        ours();
        // A panic does not unwind: no one leaves this function while the second core uses the closure.
        while !WORK.load(Acquire).is_null() {
            wfe();
        }
    }
}

/// What the second core does: all work that it gets.
pub fn serve() -> ! {
    loop {
        let work = WORK.load(Acquire);
        if work.is_null() {
            wfe();
            continue;
        }
        // SAFETY: `both` waits until the pointer is null again. Until then the closure and all that it borrows live, and it is
        // this core's alone; it is `Send`.
        #[allow(unsafe_code)]
        let work = unsafe { &mut *work };
        work();
        WORK.store(null_mut(), Release);
        sev();
    }
}
