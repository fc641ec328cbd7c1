//! Triangles and lines on the integer grid: the fill rule, ties, clipping at the guard band, and memory targets. The
//! expectations are exact integers.

mod fill_rule;
mod lines;
mod memory_triangles;
mod random_shapes;
