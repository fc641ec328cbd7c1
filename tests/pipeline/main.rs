//! Meshes drawn by every pipeline: solid, depth-tested, in painter's order, as wireframes and in bands; culled, clipped and
//! seen from inside; and the messages of all errors.

mod anti_aliased;
mod bands;
mod buffers;
mod clipped_faces;
mod cull_front;
mod culling_by_planes;
mod cut_meshes;
mod documented_ranges;
mod drawing;
mod hidden_lines;
mod inside_a_mesh;
mod line_joints;
mod meshes;
mod messages;
mod no_panic;
mod nothing_outside;
mod owned_strips;
mod painter;
mod polylines;
mod scenes;
mod solids;
mod sprites;
mod tracked;
mod two_cores;
mod view_volume;
