//! The memory that drawing a mesh in bands needs, with the lengths taken from the mesh.

use crate::camera::ScreenVertex;

/// Vertex cache and bin storage for one mesh, for several meshes drawn one after the other, or for a
/// [`Scene`](crate::draw::Scene). [`mesh_buffers!`](crate::mesh_buffers) makes one with the lengths that these need, and the macro `MeshBuffers!` names the type.
///
/// It takes 8 bytes per vertex, and 2 per face or edge and per 16 of them.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// use pinhole::{meshes::CUBE, prelude::*, Angle};
/// let mut display = MockDisplay::<Rgb565>::new();
/// let viewport = Viewport::new(Point::zero(), display.size())?;
/// let sphere = CUBE.bounding_sphere();
/// let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::degrees(30), Angle::degrees(20))?;
///
/// let mut buffers = mesh_buffers!(CUBE);
/// let mut strip = strip_buffers!(Rgb565, 64, 8);
/// let instance = camera.place(&CUBE, &Affine::identity());
/// let mut faces = instance.transform_depth(&mut buffers.cache).bin_faces(&mut buffers.bins)?;
/// let mut frame = Frame::new(display.bounding_box(), Rgb565::BLACK);
/// while let Some(mut band) = frame.next_band(&mut strip.colors)? {
///     let mut depth = DepthBuffer::new(band.area(), &mut strip.depths)?;
///     faces.draw(|face| Rgb565::CSS_GOLD.dim(20 * (face as u16 + 1)), &mut band.pixels().depth_tested(&mut depth))?;
///     band.send(&mut display)?;
/// }
/// assert!(faces.statistics().drawn > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshBuffers<const VERTICES: usize, const BINS: usize, const EDGE_BINS: usize = 0> {
    /// The vertex cache: see [`MeshInstance::transform`](crate::draw::MeshInstance::transform).
    pub cache: [ScreenVertex; VERTICES],
    /// Bin storage for faces: see [`TransformedMesh::bin_faces`](crate::draw::TransformedMesh::bin_faces).
    pub bins: [u16; BINS],
    /// Bin storage for edges: see [`TransformedMesh::bin_edges`](crate::draw::TransformedMesh::bin_edges) and
    /// [`bin_smooth_edges`](crate::draw::TransformedMesh::bin_smooth_edges).
    pub edge_bins: [u16; EDGE_BINS],
}

impl<const VERTICES: usize, const BINS: usize, const EDGE_BINS: usize>
    MeshBuffers<VERTICES, BINS, EDGE_BINS>
{
    /// Buffers of zeros: a static is in `.bss` and takes no flash.
    pub const fn new() -> Self {
        Self { cache: [ScreenVertex::EMPTY; VERTICES], bins: [0; BINS], edge_bins: [0; EDGE_BINS] }
    }
}

impl<const VERTICES: usize, const BINS: usize, const EDGE_BINS: usize> Default
    for MeshBuffers<VERTICES, BINS, EDGE_BINS>
{
    fn default() -> Self {
        Self::new()
    }
}

defmt_format!(
    [const VERTICES: usize, const BINS: usize, const EDGE_BINS: usize] MeshBuffers<VERTICES, BINS, EDGE_BINS>, self,
    "buffers of {=usize} vertices, {=usize} + {=usize} bins",
    VERTICES, BINS, EDGE_BINS
);

/// Declares vertex cache and bin storage for one or more `const` meshes that are drawn one after the other: [`MeshBuffers`] with
/// the lengths of the largest one. `mesh_buffers!([MESH; 8], [OTHER; 1])` is for a [`Scene`](crate::draw::Scene), whose objects are
/// binned at the same time: for as many of each mesh as can be visible, with the sum of their lengths. Drawn in one piece, the objects share
/// the vertex cache of the largest mesh. A mesh that is made at run time has no constant lengths: it takes slices of as many
/// [`ScreenVertex`](crate::camera::ScreenVertex) of 8 bytes as the mesh has vertices, and [`face_bins_len`](crate::Mesh::face_bins_len) numbers.
///
/// `mesh_buffers!(MESH)` is for faces, with storage in the field `bins`; `mesh_buffers!(edges: MESH)` for a wireframe, with `edge_bins`; and
/// `mesh_buffers!(faces, edges: MESH)` for hidden lines, with both. `mesh_buffers!(smooth: MESH)` has both for faces whose edges are
/// [smoothed](crate::bands::SmoothFrame), for a scene as `mesh_buffers!(smooth: [MESH; 8])`. [`MeshBuffers!`](macro@crate::MeshBuffers) with equal arguments is the type, for statics:
///
/// ```
/// use pinhole::{meshes::{AXES, CUBE}, prelude::*};
/// use std::sync::Mutex; // in firmware `ConstStaticCell` of the crate static_cell
/// static BUFFERS: Mutex<MeshBuffers!(CUBE)> = Mutex::new(mesh_buffers!(CUBE));
/// let shared = mesh_buffers!(CUBE, AXES);
/// assert_eq!((shared.cache.len(), shared.bins.len()), (8, 17)); // 12 faces, one for up to 16 faces, and 4 bins
/// let scene = mesh_buffers!([CUBE; 20], [AXES; 1]);
/// assert_eq!((scene.cache.len(), scene.bins.len()), (20 * 8 + 4, 20 * 17));
/// # let largest = CUBE.smooth_bins_len().max(pinhole::meshes::GRID.smooth_bins_len());
/// # assert!(CUBE.smooth_bins_len() > CUBE.edge_bins_len());
/// # assert_eq!(mesh_buffers!(smooth: CUBE, pinhole::meshes::GRID).edge_bins.len(), largest);
/// # let smooth = mesh_buffers!(smooth: [CUBE; 2], [pinhole::meshes::GRID; 1]);
/// # assert_eq!(smooth.edge_bins.len(), 2 * CUBE.smooth_bins_len() + pinhole::meshes::GRID.smooth_bins_len());
/// # assert_eq!(smooth.bins.len(), 2 * CUBE.face_bins_len() + pinhole::meshes::GRID.face_bins_len());
/// ```
#[macro_export]
macro_rules! mesh_buffers {
    ($($argument:tt)+) => {
        <$crate::MeshBuffers!($($argument)+)>::new()
    };
}

/// The type of [`mesh_buffers!`](crate::mesh_buffers) with equal arguments: [`MeshBuffers`] with the lengths that the meshes need.
#[macro_export]
macro_rules! MeshBuffers {
    (edges: $($mesh:expr),+ $(,)?) => {
        $crate::MeshBuffers<
            { $crate::largest(&[$($mesh.vertices().len()),+]) },
            0,
            { $crate::largest(&[$($mesh.edge_bins_len()),+]) },
        >
    };
    (faces, edges: $($mesh:expr),+ $(,)?) => {
        $crate::MeshBuffers<
            { $crate::largest(&[$($mesh.vertices().len()),+]) },
            { $crate::largest(&[$($mesh.face_bins_len()),+]) },
            { $crate::largest(&[$($mesh.edge_bins_len()),+]) },
        >
    };
    (smooth: $([$mesh:expr; $count:expr]),+ $(,)?) => {
        $crate::MeshBuffers<
            { 0 $(+ $mesh.vertices().len() * $count)+ },
            { 0 $(+ $mesh.face_bins_len() * $count)+ },
            { 0 $(+ $mesh.smooth_bins_len() * $count)+ },
        >
    };
    (smooth: $($mesh:expr),+ $(,)?) => {
        $crate::MeshBuffers<
            { $crate::largest(&[$($mesh.vertices().len()),+]) },
            { $crate::largest(&[$($mesh.face_bins_len()),+]) },
            { $crate::largest(&[$($mesh.smooth_bins_len()),+]) },
        >
    };
    ($([$mesh:expr; $count:expr]),+ $(,)?) => {
        $crate::MeshBuffers<
            { 0 $(+ $mesh.vertices().len() * $count)+ },
            { 0 $(+ $mesh.face_bins_len() * $count)+ },
        >
    };
    ($($mesh:expr),+ $(,)?) => {
        $crate::MeshBuffers<
            { $crate::largest(&[$($mesh.vertices().len()),+]) },
            { $crate::largest(&[$($mesh.face_bins_len()),+]) },
        >
    };
}

/// The largest of the lengths, 0 if there are none: for the macros.
#[doc(hidden)]
pub const fn largest(lengths: &[usize]) -> usize {
    let (mut largest, mut rest) = (0, lengths);
    while let [first, others @ ..] = rest {
        if *first > largest {
            largest = *first;
        }
        rest = others;
    }
    largest
}
