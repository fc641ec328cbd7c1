//! The programs, as the book shows them.
#![allow(dead_code, unreachable_pub)] // a firmware uses all of a program, and exports it

#[path = "../../src/book/cookbook/epaper.rs"]
pub(crate) mod epaper;
#[path = "../../src/book/cookbook/gauge.rs"]
pub(crate) mod gauge;
#[path = "../../src/book/cookbook/hud.rs"]
pub(crate) mod hud;
#[path = "../../src/book/cookbook/logo.rs"]
pub(crate) mod logo;
#[path = "../../src/book/cookbook/orbit.rs"]
pub(crate) mod orbit;
#[path = "../../src/book/cookbook/round.rs"]
pub(crate) mod round;
#[path = "../../src/book/cookbook/samples.rs"]
pub(crate) mod samples;
#[path = "../../src/book/cookbook/scope.rs"]
pub(crate) mod scope;
#[path = "../../src/book/cookbook/walk.rs"]
pub(crate) mod walk;
