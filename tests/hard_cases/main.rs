//! The cases that break fixed-point renderers, each under its number: A triangles, B lines, C the near plane,
//! D depth, E matrices, cameras and numbers. No oracle shares code with the library.
//!
//! | case | tests | oracle |
//! |---|---|---|
//! | A0 the rule: snap, then cull; top and left edges | `a::a0_*`, `a::a6_faces_*` | by hand; the f64 chain |
//! | A1 watertight | `a::watertight::a1_*` | each centre exactly in, on or out of the partition |
//! | A2 slivers | `a::a2_*`; `raster_many.rs` `Sliver` | by construction; exact edge functions |
//! | A3 degenerate | `a::a3_*`; R6 in `fill_rule.rs` | exactly zero area |
//! | A4 ties | `a::a4_*`; R2 to R5 in `fill_rule.rs` | exact edge functions, and five wrong rules that must be found |
//! | A5 huge | `a::huge::a5_*` | exact edge functions; one ray per pixel |
//! | A6 culling on the snapped area | `a::a6_*` | exact areas before and after the snap |
//! | A7 rounding at the snap | `a::a7_*` | integer rounding |
//! | B1 a pixel a step | `b::b1_*`; L1 in `lines.rs` | exact distance from the line |
//! | B2 ties | `b::b2_*` | exact division; by hand |
//! | B3 reversal | `b::b3_*` | exact division, from either end |
//! | B4 clipped is unclipped | `b::b4_*`; L2 in `lines.rs` | the line cut pixel by pixel |
//! | B5 extremes | `b::b5_*` | exact division |
//! | B6 zero length, horizontal, vertical, diagonal | `b::b6_*` | exact division |
//! | B7 joints | `b::b7_*`; `path.rs` | the union of the lines |
//! | C1 crossing near | `c::c1_*` | one ray per pixel, no clipping in it; the exact cut |
//! | C2 a vertex on near | `c::c2_*` | exact coverage of the snapped triangle |
//! | C3 w down to nothing | `c::c3_*`; `chain.rs` | one ray per pixel |
//! | C4 all behind | `c::c4_*` | empty |
//! | C5 inside a mesh | `c::c5_*`; `inside.rs`, `clipped.rs` | one ray per pixel; each pixel once |
//! | C6 far off screen, the shared cut, larger than the screen | `c::c6_*`; `chain.rs` | one ray per pixel; the f64 chain |
//! | D1 the threshold of z-fighting | `d::d1_*` | f64, all that is two steps apart |
//! | D2 slivers and extrapolation | `d::d2_*`; `d2_*` in `src/raster/depth.rs` | the plane in rationals |
//! | D3 what is stored | `d::d3_*` | f64 |
//! | E1 large offsets | `e::e1_*`; `chain.rs` | the same scene at the origin; f64 |
//! | E2 out of Q16.16 | `e::e2_*` | f64 |
//! | E3 parallel up | `e::errors::e3_*` | exact angles of integer vectors |
//! | E4 zero, tiny and huge vectors | `e::e4_*`, `e::errors::e4_*` | f64 |
//! | E5 degenerate lenses | `e::errors::e5_*` | the documented bounds, both sides |
//! | E6 drift | `e::e6_*` | exact fractions of a turn |
//! | E7 sine and cosine | `e::e7_*` | f64 |
//! | E8 reciprocal | `e8_reciprocal_is_within_2_to_the_minus_29` in `src/math/num/reciprocal.rs`: it is private | f64 |
//! | E9 viewports | `e::viewports::e9_*` | the crop of the whole picture |

#[path = "../bridge/mod.rs"]
mod bridge;
#[path = "../oracle/mod.rs"]
mod oracle;

mod a;
mod b;
mod c;
mod d;
mod e;
