//! Code that the rivals' programs share.
#![cfg_attr(target_os = "none", no_std)]

pub mod models;
pub mod target;
