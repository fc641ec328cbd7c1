//! The pipeline on one page.
//!
//! 1. [`Camera::place`](crate::Camera::place) folds model, view, projection and viewport transforms into integer linear
//!    forms, once per object: a [`MeshInstance`].
//! 2. Vertices go through the forms to the screen, into a cache that the caller provides: all before the first face
//!    ([`TransformedMesh`]), or, culled by planes, each when the first face needs it (`LazyCache`). Vertices that are not on
//!    the screen are marked: they need clipping.
//! 3. A source pushes faces into the face loop (`faces.rs`), in the order of the mesh: all faces, those that their planes or
//!    clusters do not cull, or the faces that may lie in a band. The loop culls each face by its area on the
//!    screen; a face with a marked vertex is clipped in clip space and becomes a fan of triangles.
//! 4. A sink takes the triangles: it fills them with their shader, or those of their pixels that pass the depth
//!    test ([`Faces::draw`]), stores only their depth ([`MeshInstance::depth_only`]), bins the face
//!    ([`TransformedMesh::bin_faces`]) or stores it to be drawn from far to near ([`Painter`]).
//! 5. `fill.rs` draws a triangle or a line into the target, span by span.

mod active_faces;
mod anti_aliased;
mod binned;
mod binned_edges;
mod binned_faces;
mod bins;
mod buffers;
mod clip_face;
mod cull;
mod draw_2d;
mod draw_region;
mod drawable;
mod edge_lists;
mod face_source;
mod face_triangles;
mod faces;
mod fill;
mod hidden_line;
mod instance;
mod painter;
mod pick;
mod points;
mod scene;
mod smooth_edges;
mod split_bins;
mod split_transform;
mod sprite_fill;
mod sprites;
mod statistics;
mod vertex_cache;
mod wireframe;

pub use active_faces::{ActiveFace, ActiveFaces};
pub use binned_edges::BinnedEdges;
pub use binned_faces::BinnedFaces;
#[doc(hidden)]
pub use buffers::largest;
pub use buffers::MeshBuffers;
pub use cull::Cull;
pub use draw_2d::{draw_line, fill_triangle};
pub use drawable::{ShaderFor, SpriteFor, StrokeFor};
pub use faces::Faces;
pub use instance::MeshInstance;
pub use painter::{Painter, PaintersOrder};
pub use pick::Picked;
pub use scene::{BinnedScene, Object, PlacedScene, Scene, SmoothScene};
pub use smooth_edges::{SmoothEdge, SmoothEdges};
pub use sprites::PlacedSprites;
pub use statistics::Statistics;
pub use vertex_cache::TransformedMesh;
pub use wireframe::Edges;
