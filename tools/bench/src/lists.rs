//! What S5, S6 and S7 draw, and the normals at the torus's vertices for S8. Integers of triangles are corners of pixels,
//! those of lines are pixels.

include!(concat!(env!("OUT_DIR"), "/lists.rs"));
