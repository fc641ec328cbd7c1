//! Rules about the repository itself.

mod layering;
mod links;
mod locks;
mod package;
mod public_names;
