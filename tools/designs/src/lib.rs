//! Number designs of the vertex chain: one loop each, which runs on emulated microcontrollers, where its instructions
//! are counted, and on the host, where its error is measured. What the library does is one of them.
#![cfg_attr(target_os = "none", no_std)]

pub mod board;
pub mod chain;
pub mod count;
mod divide;
mod float;
mod form;
mod library;
pub mod list;
mod num;
mod object;
mod scaled;
mod short;
mod sixteen;
mod thirty;
pub mod torus;
mod vertex;
mod world;

pub use object::Object;
pub use vertex::Vertex;
