//! Rules about the repository itself.

mod layering;
mod links;
mod messages;
mod package;
mod public_names;
