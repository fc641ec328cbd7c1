//! How much of the stack has been used, by interrupts too: it is painted at start-up, and use leaves the paint off.

use painted_stack::{repaint_stack, stack_painted, stack_size};

/// Paints what is not in use. The core takes 6 cycles for 4 bytes.
pub fn paint() {
    repaint_stack();
}

/// Logs how many bytes have been used since then, and how many there are: all RAM but for variables.
pub fn log() {
    let size = stack_size();
    defmt::info!("stack: {} of {} bytes used", size - stack_painted(), size);
}
