//! The Utah teapot as arrays, which `build.rs` makes from `teapot.obj`: `VERTICES` in steps of 2^`EXPONENT` of the file's unit, `FACES`,
//! counter-clockwise seen from outside, `EDGES`, each once, and `NORMALS` of the faces, 32767 = 1. It depends on nothing, so that
//! anything may draw it.
#![no_std]
#![allow(missing_docs)] // of generated constants, which are described above

include!(concat!(env!("OUT_DIR"), "/teapot.rs"));
