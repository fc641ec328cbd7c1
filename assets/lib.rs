//! The Utah teapot, which `pinhole-import` made of `teapot.obj`. It depends on nothing, so that anything may draw it.
#![no_std]

mod teapot;

pub use teapot::*;
