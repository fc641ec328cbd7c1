#![doc = include_str!("links.md")]
#![doc = include_str!("pictures.md")]
//! The book: what a user needs to know beyond the documentation of single items. Chapters on one topic open the page of its module.
//!
//! 1. [The pipeline, type by type](#the-pipeline-type-by-type)
//! 2. [Spaces, axes and signs](crate::space#spaces-axes-and-signs), with a figure
//! 3. [Choosing a projection](crate::camera#choosing-a-projection), with the gallery
//! 4. [Hidden-surface removal](crate::draw#hidden-surface-removal): the mesh's order, painter's order, a depth buffer, hidden lines
//! 5. [Bands and DMA](crate::bands#bands-and-dma)
//! 6. [Tearing](crate::bands#tearing), with a figure
//! 7. [Number formats and errors](crate::math#number-formats-and-errors)
//! 8. [Changing the firmware's picture](#changing-the-firmwares-picture): begin here with a firmware from a template: colours, a second object, a texture, fog, a label, a button
//! 9. [Estimating RAM, flash and frame time](#estimating-ram-flash-and-frame-time)
//! 10. [Measuring on your board](#measuring-on-your-board): clock cycles, waiting, bytes, and logs
//! 11. [From embedded-gfx and embedded-3dgfx](#from-embedded-gfx-and-embedded-3dgfx)
//! 12. [Cookbook](#cookbook): nine whole programs, with their pictures
//!
//! The module exists in the documentation only: it has nothing to import.
//!
#![doc = include_str!("tour.md")]
//!
#![doc = include_str!("changes.md")]
//!
#![doc = include_str!("budget.md")]
//!
//! # Measuring on your board
//!
//! Time can be [estimated](#estimating-ram-flash-and-frame-time). This chapter measures it: how long a frame takes on your board, whether the
//! core or the bus limits it, and what to change. The templates in `boards` log all of it, with the code below or with their HAL's timer.
//!
//! | to find | by |
//! |---|---|
//! | the time of a frame | a count of clock cycles |
//! | whether the core waits for the display | the cycles of the transfers that block, or of waiting for DMA |
//! | how much is sent | [`Band::bytes`](crate::bands::Band::bytes) of each band, and the bytes of its window |
//! | what was drawn | [`Statistics`](crate::draw::Statistics), which every draw call returns, and binned faces and edges count |
//!
//! ## Counting cycles
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
//! ### DWT
//!
//! ```ignore
#![doc = include_str!("measuring/dwt.rs")]
//! ```
//!
//! ### SysTick
//!
//! ```ignore
#![doc = include_str!("measuring/systick.rs")]
//! ```
//!
//! ### mcycle
//!
//! ```ignore
#![doc = include_str!("measuring/mcycle.rs")]
//! ```
//!
//! ## A frame
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
//! ## The log
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
//! ## What to change
//!
//! | the log says | then |
//! |---|---|
//! | much waiting | the bus limits: a faster clock of the bus, [`DirtyRegions`](crate::bands::DirtyRegions) ([docs/wire.md]), or drawing while DMA sends ([bands](crate::bands#bands-and-dma)) |
//! | no waiting | the core limits: higher bands ([docs/bands.md]), a coarser mesh, a faster clock; [docs/speed.md] has what scenes cost |
//! | much more time than [docs/speed.md] has for such a scene | flash with wait states and without a cache: run code from RAM, or switch the cache on |
//! | `clipped` above 0 in each frame | the near plane cuts the object: clipping costs more than drawing |
//! | the time differs much between frames | count more: one line of the log for each phase, or a pin that is high during it and an oscilloscope |
//!
#![doc = include_str!("porting.md")]
//!
//! # Cookbook
//!
//! Nine whole programs, each in one file that can be copied into a firmware as it is. Each has at most 60 lines beside its imports,
//! uses no heap, and draws into any DrawTarget of its colour: a display's driver, or a framebuffer. What stands in for the
//! microcontroller is in `examples/cookbook`, which runs the programs and draws their pictures:
//!
//! ```sh
//! cargo run --release --example cookbook
//! ```
//!
//! They need `embedded-graphics` and `pinhole` among the dependencies, and three of them `heapless`, for text that is made at run time.
//! A mesh and a camera that never change are constants: they lie in flash, and wrong numbers do not compile.
//!
//! | program | display | RAM in bytes | where |
//! |---|---|--:|---|
//! | [a logo with a label](#a-logo-with-a-label) | 240 × 240, 16 bits | 8 008 | `Memory`, on the stack or in a static |
//! | [a gauge](#a-gauge) | 128 × 64, 1 bit | 472 | `Gauge` in a static, the rest on the stack |
//! | [a walk through a town](#a-walk-through-a-town) | 320 × 240, 16 bits | 26 436 | `Town` in a static, the rest on the stack |
//! | [bars, an encoder and a touch screen](#bars-an-encoder-and-a-touch-screen) | 240 × 240, 16 bits | 11 768 | the stack |
//! | [a head-up display](#a-head-up-display) | 240 × 240, 16 bits | 10 836 | `Hud` in a static, the rest on the stack |
//! | [a drawing on e-paper](#a-drawing-on-e-paper) | 200 × 200, 1 bit | 9 920 | the stack |
//! | [a scope](#a-scope) | 320 × 240, 16 bits | 26 504 | `Scope` in a static, the rest on the stack |
//! | [a round display](#a-round-display) | 240 × 240, 16 bits | 10 196 | `Memory`, on the stack or in a static |
//! | [two by two samples](#two-by-two-samples) | 160 × 128, 16 bits | 10 436 | `Memory`, on the stack or in a static |
//!
//! RAM is all arrays and state of a program, measured on a 64-bit host; a 32-bit core needs no more. What the library's functions
//! themselves use of the stack is in [docs/footprint.md].
//!
//! Where a program calls `expect`, only its own constants decide: a buffer that is as long as the mesh or the display needs, a
//! direction that is not zero.
//!
//! ## A logo with a label
//!
//! ![A ring of six sides in three colours, with the word pinhole at a line to one of its corners][docs/cookbook/logo.png]
//!
//! The label is placed by [`MeshInstance::project`](crate::draw::MeshInstance::project), whose answer converts into a `Point`, and drawn with
//! embedded-graphics into each band, on top of the ring. In place of the ring, put the mesh that `pinhole-import` makes of your logo.
//!
//! ```
#![doc = include_str!("cookbook/logo.rs")]
//! ```
//!
//! ## A gauge
//!
//! ![A dial over half a turn, an arrow as the needle, and the text 62 km/h][docs/cookbook/gauge.png]
//!
//! [`Tracked`](crate::bands::Tracked) knows where the needle and the text were drawn last. When the value is as before, nothing is drawn and
//! nothing sent; when it changes, [`DirtyRegions`](crate::bands::DirtyRegions) has the rectangles that differ. Dithering makes greys of one bit.
//!
//! ```
#![doc = include_str!("cookbook/gauge.rs")]
//! ```
//!
//! ## A walk through a town
//!
//! ![A street between houses of many colours, under a blue sky][docs/cookbook/walk.png]
//!
//! A [`Scene`](crate::draw::Scene) of 50 houses, all of them one cube, scaled and moved. Houses that the walker does not see are culled by
//! their bounding spheres; a house that is next to the walker is clipped at the near plane.
//!
//! ```
#![doc = include_str!("cookbook/walk.rs")]
//! ```
//!
//! ## Bars, an encoder and a touch screen
//!
//! ![Twelve bars seen from above, one of them orange, and the text 12: 60 kWh][docs/cookbook/orbit.png]
//!
//! [`PlacedScene::pick`](crate::draw::PlacedScene::pick) finds the bar that is seen in a pixel, without a picture and without a depth buffer.
//!
//! ```
#![doc = include_str!("cookbook/orbit.rs")]
//! ```
//!
//! ## A head-up display
//!
//! ![A torus, above it the frame time and the number of faces, below it a graph of frame times][docs/cookbook/hud.png]
//!
//! Everything of embedded-graphics can be drawn into a [`Band`](crate::bands::Band), after the faces.
//! [`Statistics`](crate::draw::Statistics) has more counts than these two. Measure the time with a timer of the microcontroller.
//!
//! ```
#![doc = include_str!("cookbook/hud.rs")]
//! ```
//!
//! ## A drawing on e-paper
//!
//! ![A chess pawn as a mesh of lines][docs/cookbook/epaper.png]
//!
//! Drivers of e-paper have a framebuffer and often colours of their own: the program draws into it directly, with any colour.
//! Only the depth comes in strips of 20 rows, as nothing is drawn outside a [`DepthBuffer`](crate::target::DepthBuffer).
//! [`hidden_line`](crate::draw::Edges::hidden_line) leaves out what the pawn itself hides.
//!
//! ```
#![doc = include_str!("cookbook/epaper.rs")]
//! ```
//!
//! ## A scope
//!
//! ![A landscape of two ridges, red at the top and blue at the bottom, with a line for each row][docs/cookbook/scope.png]
//!
//! The vertices of this mesh lie in RAM and are computed in every frame: a mesh only borrows its lists. Colours come from the samples
//! by [`Gouraud`](crate::shading::Gouraud), one at each corner.
//!
//! ```
#![doc = include_str!("cookbook/scope.rs")]
//! ```
//!
//! ## A round display
//!
//! ![A golden torus on a disc][docs/cookbook/round.png]
//!
//! The corners of a GC9A01 are 21 % of its pixels, and nobody sees them. A frame of its own for each band, as wide as the glass is there, takes 82 % of
//! the bytes, windows included; [docs/wire.md] has other heights.
//!
//! ```
#![doc = include_str!("cookbook/round.rs")]
//! ```
//!
//! ## Two by two samples
//!
//! ![A golden and a blue cube that pierce each other, without steps at their edges][docs/cookbook/samples.png]
//!
//! [`SmoothEdges`](crate::draw::SmoothEdges) leave textures, and lines where faces pierce each other, as they are; samples smooth all of it. A
//! viewport of twice the width and height takes strips of four times the bytes, and one loop makes a pixel of four samples. A torus of 1000
//! faces in bands of 8 rows takes 3.7 times the instructions on an M3; [docs/accuracy.md] compares the errors. For a
//! still picture, as on e-paper, the samples can also be drawn one after the other in their place: take the mean of four pictures, each through a [`jittered`](crate::Viewport::jittered) viewport.
//!
//! ```
#![doc = include_str!("cookbook/samples.rs")]
//! ```
