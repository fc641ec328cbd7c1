//! Rules about the repository itself.

mod examples;
mod layering;
mod links;
mod messages;
mod package;
mod public_names;
