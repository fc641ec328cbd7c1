//! Rules about the repository itself.

mod layering;
