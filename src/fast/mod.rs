//! Fast paths: each computes the same bits as a plain path, for some inputs or some cores.
//!
//! A fast path is attached by one call, which may decline: then the plain path runs. The header of its file names the plain
//! twin, the domain (the inputs that it takes), the gain, and the test that compares both bit for bit. `--cfg pinhole_plain`
//! makes all of them decline; scene S3 then takes twice the time. Scenes S1 to S8 are the benchmarks of `docs/speed.md`.
//!
//! # Triangles
//!
//! A triangle goes to the first tier whose domain contains it. Domains are the largest differences between corners, in pixels:
//! columns × rows. In all tiers but the last the corners lie between the scissor's columns, so that no edge is clipped.
//!
//! | tier | domain | row ends | core | gain of the tier |
//! |---|---|---|---|---|
//! | [`Small`]: [`SmallTriangle`](small_triangle) with [`OneDivision`](edge20) | 32 × 30, inside the scissor | 12.20 in 32 bits; one division for an edge's value, one for its step | all but Cortex-M0 | not measured alone |
//! | [`Low`], the middle tier: [`SmallTriangle`](small_triangle) with [`TwoDivisions`](edge20) | 2040 × 32, rows clipped | 12.20 in 32 bits; two divisions each | all but Cortex-M0 | S3 takes 9 % fewer instructions on an M3, 4.5 % with depth; nothing on an M0 |
//! | both: `BresenhamTriangle` (`bresenham_triangle.rs`) | 31 rows, rows clipped | integers and an error term; no rounding | Cortex-M0 | edges by reciprocals instead take 12 % more instructions on S3, 11 % on S4 and S7 |
//! | [`AnyTriangle`](crate::raster::AnyTriangle), the definition | any in the guard band | an integer and an error term; no rounding | all | – |
//!
//! In bands with a list of active faces, triangles of both kinds that begin in a band go to [`carried`] first.
//!
//! Gradients of triangles within 32 pixels have a fast path, too: [`tiny_gradient`]. Smooth triangles of a few pixels with depth go to
//! [`tiny_table`] before all tiers.

#![cfg_attr(pinhole_plain, allow(dead_code))]

pub(crate) mod anti_aliased_line;
mod attach;
mod back_face;
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) mod bresenham_triangle;
pub(crate) mod carried;
mod edge20;
mod fill;
mod fill_rows;
mod fog_fill;
pub(crate) mod line_fill;
pub(crate) mod line_pixels;
mod line_slope;
mod put_run;
mod ramp_fill;
mod rows;
mod shaded_fill;
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
mod small_triangle;
pub(crate) mod solid_fill;
mod spans;
pub(crate) mod sprite_fill;
pub(crate) mod table_line;
mod tiers;
mod tiny_gradient;
mod tiny_table;

use attach::memory_of;
pub(crate) use back_face::is_back_face;
pub(crate) use fill::{fill, fill_nearer};
pub(crate) use rows::{RowOrigin, Rows};
pub(crate) use spans::spans;
pub(crate) use tiers::{Low, LowSpans, Small};
pub(crate) use tiny_gradient::{depth_and_light_gradients, depth_gradient};
