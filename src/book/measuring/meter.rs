/// Measures frames by a count of cycles that wraps after 2³²; no frame takes as long.
pub struct Meter<F> {
    cycles: F,
    begin: u32,
    measured: Measured,
}

/// The cost of a frame: its clock cycles, how many of them the core waited for the display, and the bytes sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measured {
    pub cycles: u32,
    pub waited: u32,
    pub bytes: u32,
}

impl<F: Fn() -> u32> Meter<F> {
    /// A meter whose first frame begins now. `cycles` reads the counter.
    pub fn new(cycles: F) -> Self {
        Self { begin: cycles(), cycles, measured: Measured::default() }
    }

    /// Runs a function that waits for the display, such as a blocking transfer or the end of a DMA transfer, and counts its cycles as
    /// waiting.
    pub fn wait<T>(&mut self, transfer: impl FnOnce() -> T) -> T {
        let begin = (self.cycles)();
        let result = transfer();
        self.measured.waited += (self.cycles)().wrapping_sub(begin); // at most the cycles of the frame
        result
    }

    /// Adds bytes sent to the display: pixels, and commands that set a window.
    pub fn sent(&mut self, bytes: usize) {
        self.measured.bytes = self.measured.bytes.saturating_add(bytes as u32);
    }

    /// Ends the frame and returns its cost; the next frame begins now.
    pub fn frame(&mut self) -> Measured {
        let now = (self.cycles)();
        let cycles = now.wrapping_sub(self.begin);
        self.begin = now;
        Measured { cycles, ..core::mem::take(&mut self.measured) }
    }
}
