//! Rules about the repository itself.

mod file_cycles;
mod layering;
