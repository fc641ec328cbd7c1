/// Measures frames by a count of cycles that wraps after 2³²; no frame takes as long.
pub struct Meter<F> {
    cycles: F,
    begin: u32,
    measured: Measured,
}

/// What a frame took: clock cycles, those of them that the core has waited for the display, and the bytes sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measured {
    pub cycles: u32,
    pub waited: u32,
    pub bytes: u32,
}

impl<F: Fn() -> u32> Meter<F> {
    /// The first frame begins.
    pub fn new(cycles: F) -> Self {
        Self { begin: cycles(), cycles, measured: Measured::default() }
    }

    /// Calls what waits for the display: a transfer that blocks, or the end of one.
    pub fn wait<T>(&mut self, transfer: impl FnOnce() -> T) -> T {
        let begin = (self.cycles)();
        let result = transfer();
        self.measured.waited += (self.cycles)().wrapping_sub(begin); // at most the cycles of the frame
        result
    }

    /// Counts the bytes of a band, and those of its window.
    pub fn sent(&mut self, bytes: usize) {
        self.measured.bytes = self.measured.bytes.saturating_add(bytes as u32);
    }

    /// The frame has ended, and the next one begins.
    pub fn frame(&mut self) -> Measured {
        let now = (self.cycles)();
        let cycles = now.wrapping_sub(self.begin);
        self.begin = now;
        Measured { cycles, ..core::mem::take(&mut self.measured) }
    }
}
