//! Rules about the repository itself.

mod layering;
mod links;
mod package;
mod public_names;
