//! The cases that break fixed-point renderers, each under its number: A triangles, B lines, C the near plane,
//! D depth, E matrices, cameras and numbers. No oracle shares code with the library.
//!
//! | case | tests | oracle |
//! |---|---|---|
//! | A0 the rule: snap, then cull; top and left edges | `triangles::a0_*`, `triangles::a6_faces_*` | by hand; the f64 chain |
//! | A1 watertight | `tests/raster`; `tests/pipeline/clipped_faces.rs` | exact edge functions, of which it follows; each pixel once |
//! | A2 slivers | `Sliver` in `tests/raster/random_shapes.rs` | exact edge functions |
//! | A3 degenerate | `tests/raster/fill_rule.rs` | exactly zero area |
//! | A4 ties | `tests/raster/fill_rule.rs` | exact edge functions |
//! | A5 huge | `triangles::a5_*`; `Huge` in `tests/raster/random_shapes.rs` | exact edge functions; one ray per pixel |
//! | A6 culling on the snapped area | `triangles::a6_*` | exact areas before and after the snap |
//! | A7 rounding at the snap | `triangles::a7_*` | integer rounding |
//! | B1 a pixel a step, B2 ties, B3 reversal | L1 in `tests/raster/lines.rs` | exact division, from either end |
//! | B4 clipped is unclipped | L2 in `tests/raster/lines.rs` | the line cut pixel by pixel |
//! | B5 extremes | `tests/raster/lines.rs`, `tests/raster/random_shapes.rs` | exact division |
//! | B6 zero length, horizontal, vertical, diagonal | L1 in `tests/raster/lines.rs` | exact division |
//! | B7 joints | `tests/pipeline/anti_aliased.rs` | the union of the lines |
//! | C1 crossing near | `fuzz/targets/scene/cut.rs`; `tests/pipeline/paths.rs` | one ray per pixel, no clipping in it; the exact cut |
//! | C2 a vertex on near | `near_plane::c2_*` | exact coverage of the snapped triangle |
//! | C3 w down to nothing | `near_plane::c3_*`; `fuzz/targets/set_up/camera.rs` | one ray per pixel; the f64 chain |
//! | C4 all behind | `near_plane::c4_*` | empty |
//! | C5 inside a mesh | `fuzz/targets/scene/cut.rs`; `tests/pipeline/clipped_faces.rs`, `tests/pipeline/culling_by_planes.rs` | one ray per pixel; each pixel once; all ways of drawing |
//! | C6 far off screen, the shared cut, larger than the screen | `near_plane::c6_*`; `fuzz/targets/set_up/camera.rs` | one ray per pixel; the f64 chain |
//! | D1 the threshold of z-fighting | `depth::d1_*` | f64, all that is two steps apart |
//! | D2 slivers and extrapolation | `d2_*` in `src/raster/depth.rs`; `fuzz/targets/scene/depth.rs` | the plane in rationals |
//! | D3 what is stored | `depth::d3_*` | f64 |
//! | E1 large offsets | `numbers::e1_*`; `s3_views` in `tests/bounds.rs`; `tests/camera/vertex_chain.rs` | the same scene at the origin; f64 |
//! | E2 out of Q16.16 | `numbers::e2_*`; `tests/camera/vertex_chain.rs` | by hand; f64 |
//! | E3 parallel up | `fuzz/targets/set_up/views.rs` | exact angles of integer vectors |
//! | E4 zero, tiny and huge vectors | `s3_views` in `tests/bounds.rs`; `fuzz/targets/set_up/views.rs` | f64 |
//! | E5 degenerate lenses | `fuzz/targets/set_up/projections.rs` | the documented bounds, both sides |
//! | E6 drift | `numbers::e6_*` | exact fractions of a turn |
//! | E7 sine and cosine | `e7_*` in `tests/bounds.rs`; `numbers::e7_*` | f64; by hand |
//! | E8 reciprocal | `e8_reciprocal` in `tests/bounds.rs` | f64 |
//! | E9 viewports | `viewports::e9_*` | the crop of the whole picture |

mod depth;
mod near_plane;
mod numbers;
mod setup_errors;
mod triangles;
mod viewports;
