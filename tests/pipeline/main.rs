//! Meshes drawn by every pipeline: solid, depth-tested, in painter's order, as wireframes and in bands; culled, clipped and
//! seen from inside; and the messages of all errors.

mod anti_aliased;
mod bands;
mod clipped_faces;
mod culling_by_planes;
mod dirty_regions;
mod hidden_lines;
mod limits;
mod meshes;
mod no_panic;
mod nothing_outside;
mod painter;
mod paths;
mod scenes;
mod smooth_edges;
mod sprites;
mod two_cores;
mod view_volume;
