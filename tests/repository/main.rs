//! Rules about the repository itself.

mod file_cycles;
mod glossary;
mod layering;
mod links;
mod locks;
mod package;
mod preludes;
mod trait_messages;
