//! Cycles from instructions: timing tables of the Cortex-M cores and of an ESP32-C3, and how long flash takes.

pub(crate) mod decode;
pub(crate) mod flash;
pub(crate) mod pipeline;
pub(crate) mod program;
pub(crate) mod riscv;
#[cfg(test)]
mod tests;
