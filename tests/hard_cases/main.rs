//! d
#[path = "../bridge/mod.rs"]
mod bridge;
mod d;
#[path = "../oracle/mod.rs"]
mod oracle;
