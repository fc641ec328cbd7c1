//! The firmware that draws nothing: a start, a clock and a display, which every image has. The sizes of other images are measured
//! against it.
#![no_std]
#![no_main]

use core::hint::black_box;
use linked::{counted, start};

start!(counted(&mut |turn| {
    black_box(turn);
    Some(())
}));
