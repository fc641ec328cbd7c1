//! The rasteriser's types: positions on the screen, spans of pixels, and values that are linear over a triangle, for shaders of your own.
//! [`fill_triangle`](crate::draw::fill_triangle) and [`draw_line`](crate::draw::draw_line) fill any target; one that takes fills
//! (`fill_solid`) gets each span.
//!
//! # Rules
//!
//! Lines:
//! - **L1** every pixel lies within ½ pixel of the true line along the minor axis;
//! - **L2** a line clipped to a rectangle draws exactly those pixels of the unclipped line that lie
//!   in the rectangle;
//! - **L3** A→B and B→A draw the same pixels: ends are ordered by (x, y), and from there a tie
//!   keeps the smaller minor step, in every octant.
//!
//! Triangles:
//! - **R1** pixel (i, j) has its centre at (i + ½, j + ½);
//! - **R2** it is covered when, for each edge, the centre lies strictly on its inner side, or on it
//!   and the edge is a left or a top edge;
//! - **R3** left edge: not horizontal, interior to its right;
//! - **R4** top edge: horizontal, interior below;
//! - **R5** a centre on a vertex is covered if R2 holds for both edges of the vertex;
//! - **R6** a triangle without area covers no pixel;
//! - **R7** order and winding of the vertices do not matter;
//! - **R8** triangles on opposite sides of shared edges cover every centre in the interior of their
//!   union exactly once, and on its border at most once;
//! - **R9** R1 to R8 hold exactly for every triangle in the guard band.
//!
//! (Direct3D 11.3 functional specification, section 3.4.2: the top-left rule.)
//!
//! Screen points come from a camera or, for 2D drawing, from a constructor that rejects points beyond the guard band:
//!
//! ```
//! use pinhole::raster::ScreenPoint;
//! assert!(ScreenPoint::from_subpixels(8192 * 256, 0).is_some());
//! assert!(ScreenPoint::from_subpixels(8192 * 256 + 1, 0).is_none());
//! ```
//! ```compile_fail,E0451
//! let forged = pinhole::raster::ScreenPoint { x: 1 << 30, y: 0 };
//! ```

mod any_triangle;
mod crossed_edge;
mod depth;
mod depth_triangle;
pub(crate) mod edge;
mod edge_planes;
mod gradient;
pub(crate) mod gradient_setup;
mod line;
mod line_area;
mod line_coverage;
mod line_depth;
mod line_end;
mod line_table;
mod pixel_layout;
#[cfg(test)]
pub(crate) mod random_triangles;
mod row_scratch;
mod scissor;
mod screen;
mod span;
mod sprite_axis;
mod table_light;
pub(crate) mod trapezoid;
pub(crate) mod triangle;

pub(crate) use any_triangle::{AnyTriangle, Spans};
pub(crate) use crossed_edge::{CrossedEdge, Window};
pub(crate) use depth::FARTHEST;
pub(crate) use depth_triangle::DepthTriangle;
pub(crate) use edge_planes::EdgePlanes;
pub use gradient::Gradient;
pub(crate) use gradient_setup::GradientSetup;
pub(crate) use line::line;
pub(crate) use line::{LineSetup, LineSpans};
pub(crate) use line_area::{rest, share, unrounded_rest, LineArea, PIXELS};
pub(crate) use line_coverage::{Column, LineCoverage};
pub(crate) use line_depth::LineDepth;
pub(crate) use line_end::{weighted_area, LineEnds};
pub(crate) use line_table::{areas_at, line_table, rests_at, rests_of, LineRests};
pub(crate) use pixel_layout::PixelLayout;
pub(crate) use row_scratch::RowScratch;
pub(crate) use scissor::Scissor;
pub(crate) use screen::Pixel;
pub use screen::ScreenPoint;
pub(crate) use screen::GUARD_BAND;
pub use span::Span;
pub(crate) use sprite_axis::{SpriteAxis, TexelWalk};
pub(crate) use trapezoid::Trapezoid;
pub(crate) use triangle::area;
pub use triangle::Triangle;
