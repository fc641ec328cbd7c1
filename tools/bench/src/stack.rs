//! How deep the stack was, by the code that the board of the examples has for it: painted first, looked at afterwards.

#[cfg(target_os = "none")]
#[path = "../../lm3s6965evb/src/stack.rs"]
mod painted;

#[cfg(target_os = "none")]
pub use painted::{deepest, paint};

/// The host's stack is of no interest.
#[cfg(not(target_os = "none"))]
pub fn paint() {}

#[cfg(not(target_os = "none"))]
pub fn deepest() -> usize {
    0
}
