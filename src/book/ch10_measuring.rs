#![doc = include_str!("links.md")]
//! # Measuring on your board
//!
//! [Chapter 6](super::ch6_budget) estimates the time of a frame. This one measures it: how long a frame takes on your board, whether the core
//! or the bus limits it, and what to change. The templates in `boards` log all of it, with the code below or with their HAL's timer.
//!
//! | to find | by |
//! |---|---|
//! | the time of a frame | a count of clock cycles |
//! | whether the core waits for the display | the cycles of the transfers that block, or of waiting for DMA |
//! | how much is sent | [`Band::bytes`](crate::bands::Band::bytes) of each band, and the bytes of its window |
//! | what was drawn | [`Statistics`](crate::draw::Statistics), which every draw call returns, and binned faces and edges count |
//!
//! # Counting cycles
//!
//! | core | counter | bits | code |
//! |---|---|--:|---|
//! | Cortex-M3, M4, M7, M33 | CYCCNT of the unit DWT | 32 | [DWT](#dwt) |
//! | Cortex-M0, M0+, M23 | SysTick, which almost every Cortex-M has | 24, and an exception | [SysTick](#systick) |
//! | RISC-V | `mcycle` | 64, of which the 32 low ones are read at once | [mcycle](#mcycle) |
//!
//! All three have one interface: `cycles()` is a `u32` that wraps, and the difference of two readings is right as long as less than 2³²
//! cycles lie between them, 21 s at 200 MHz. A few chips leave CYCCNT out, some RISC-V cores count under another name (the ESP32-C3
//! does: use its HAL's timer), and DWT and SysTick may stand still while the core sleeps: embassy's `Instant` does not.
//!
//! ## DWT
//!
//! ```ignore
#![doc = include_str!("measuring/dwt.rs")]
//! ```
//!
//! ## SysTick
//!
//! ```ignore
#![doc = include_str!("measuring/systick.rs")]
//! ```
//!
//! ## mcycle
//!
//! ```ignore
#![doc = include_str!("measuring/mcycle.rs")]
//! ```
//!
//! # A frame
//!
//! ```
#![doc = include_str!("measuring/meter.rs")]
//!
//! // A clock that counts 10 cycles between two readings, in place of `|| clock.cycles()`.
//! let time = core::cell::Cell::new(u32::MAX - 25);
//! let mut meter = Meter::new(|| time.replace(time.get().wrapping_add(10)));
//! for band in [3840, 1920] {
//!     meter.sent(11 + band); // the window's commands on a MIPI DCS display, and pixels
//!     meter.wait(|| ()); // send the band here
//! }
//! assert_eq!(meter.frame(), Measured { cycles: 50, waited: 20, bytes: 5782 });
//! assert_eq!(meter.frame(), Measured { cycles: 10, waited: 0, bytes: 0 });
//! ```
//!
//! # The log
//!
//! [defmt](https://docs.rs/defmt) sends numbers, and the host makes text of them: the image has neither the texts nor the code that formats.
//! `defmt-rtt` puts them into a buffer in RAM (1 KB by default), which the probe reads while the firmware runs; `cargo run` with probe-rs as
//! the runner shows them. The feature `defmt` of this crate has a `Format` for each of its types.
//!
//! ```ignore
#![doc = include_str!("measuring/log.rs")]
//! ```
//!
//! Log once a frame: a full buffer drops messages, or blocks the core if a debugger asks for that. The figures of a build without optimisation say nothing; use
//! `--release` with `lto = "fat"` and `codegen-units = 1`.
//!
//! # What to change
//!
//! | the log says | then |
//! |---|---|
//! | much waiting | the bus limits: a faster clock of the bus, [`DirtyRegions`](crate::bands::DirtyRegions) ([docs/wire.md]), or drawing while DMA sends ([chapter 5](super::ch5_bands)) |
//! | no waiting | the core limits: higher bands ([docs/bands.md]), a coarser mesh, a faster clock; [docs/speed.md] has what scenes cost |
//! | much more time than [docs/speed.md] has for such a scene | flash with wait states and without a cache: run code from RAM, or switch the cache on |
//! | `clipped` above 0 in each frame | the near plane cuts the object: clipping costs more than drawing |
//! | the time differs much between frames | count more: one line of the log for each phase, or a pin that is high during it and an oscilloscope |
