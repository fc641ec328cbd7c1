//! Cycles from instructions: timing tables of the Cortex-M cores, and how long flash takes.

pub(crate) mod decode;
pub(crate) mod flash;
pub(crate) mod pipeline;
pub(crate) mod program;
#[cfg(test)]
mod tests;
