//! What every image has, too: a start, a clock and a display. The others are measured against it.
#![no_std]
#![no_main]

use core::hint::black_box;
use linked::{counted, start};

start!(counted(&mut |turn| {
    black_box(turn);
    Some(())
}));
