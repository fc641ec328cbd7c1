//! Faces with depth in bands, into memory.
#![no_std]
#![no_main]

use linked::*;

depth_bands!(|band| &mut band.pixels());
