//! Reading what was set up, colours of every format, and copies of types whose `Clone` is written by hand.

use crate::any;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::clip::Varying;
use pinhole::raster::{Gradient, Triangle};
use pinhole::space::{Model, World};
use pinhole::{
    edge_faces, Affine, Band, Channels, Coordinate, DepthBuffer, Dim, DirtyRegions, Fog, Frame, Gouraud,
    Hierarchy, Lit, Mesh, MeshInstance, Node, NormalMatrix, NumberError, Outcode, PixelFormat,
    PlanarProjection, Point3, Scalar, ShadeTable, SquaredFog, StoredPixel, TransformedMesh, Vector3,
    ViewTransform, Viewport, WithPlanes,
};

macro_rules! entries {
    ($($name:ident$(<$life:lifetime>)?($($argument:ident: $type:ty),*) -> $result:ty { $body:expr })*) => {$(
        #[unsafe(no_mangle)]
        fn $name$(<$life>)?($($argument: $type),*) -> $result {
            $body
        }
    )*};
}

/// One format of colour: its code on the wire and in memory, and its colours from light.
macro_rules! colours {
    ($($name:ident: $colour:ty, $memory:ty;)*) => {$(
        #[unsafe(no_mangle)]
        fn $name(colour: $colour, emission: $colour) -> ($colour, $colour, $colour, u32, $colour, $memory, $colour) {
            let channels = <$colour>::from_channels([any() as u8, any() as u8, any() as u8]);
            let decoded = <$colour as PixelFormat>::decode(any() as u32);
            let cell: $memory = colour.stored();
            let loaded = <$colour as StoredPixel<$memory>>::load(core::hint::black_box(cell));
            (colour.dim(any() as u16).emitting(emission), channels, decoded, PixelFormat::encode(colour), colour.stored(), cell, loaded)
        }
    )*};
}

colours! {
    entry_colour_binary: BinaryColor, BinaryColor;
    entry_colour_gray2: Gray2, Gray2;
    entry_colour_gray4: Gray4, Gray4;
    entry_colour_gray8: Gray8, [u8; 1];
    entry_colour_rgb555: Rgb555, [u8; 2];
    entry_colour_bgr555: Bgr555, [u8; 2];
    entry_colour_rgb565: Rgb565, [u8; 2];
    entry_colour_bgr565: Bgr565, [u8; 2];
    entry_colour_rgb666: Rgb666, [u8; 3];
    entry_colour_bgr666: Bgr666, [u8; 3];
    entry_colour_rgb888: Rgb888, [u8; 3];
    entry_colour_bgr888: Bgr888, [u8; 3];
}

entries! {
    entry_edge_faces_of_12(edges: &[[u16; 2]; 12], faces: &[[u16; 3]]) -> [[u16; 2]; 12] { edge_faces(edges, faces) }
    entry_edge_faces_of_1(edges: &[[u16; 2]; 1], faces: &[[u16; 3]]) -> [[u16; 2]; 1] { edge_faces(edges, faces) }
    entry_edge_faces_of_500(edges: &[[u16; 2]; 500], faces: &[[u16; 3]]) -> [[u16; 2]; 500] { edge_faces(edges, faces) }

    entry_vector_parts(v: Vector3<World>) -> [Scalar; 3] { [v.x(), v.y(), v.z()] }
    entry_vector_micromath(v: micromath::vector::F32x3) -> Result<Vector3<World>, NumberError> { v.try_into() }
    entry_outcode_sets(a: Outcode, b: Outcode) -> (Outcode, Outcode, u8) { (a.and(b), a.or(b), a.bits()) }
    entry_translation_of_view(viewing: &ViewTransform) -> [i64; 3] { viewing.translation() }
    entry_viewport_parts(viewport: &Viewport) -> (Point, Size) { (viewport.top_left(), viewport.size()) }
    entry_parallel() -> PlanarProjection { PlanarProjection::parallel() }
    entry_coordinates(narrow: i16, wide: Scalar) -> (i32, i32) { (Coordinate::times(narrow, any()), Coordinate::times(wide, any())) }

    entry_nodes(local: Affine<Model, Model>) -> [Node; 2] { [Node::root(local), Node::child(any() as u16, local)] }
    entry_node<'n>(node: &'n Node) -> (&'n Affine<Model, Model>, &'n Affine<Model, World>) { (node.local(), node.world()) }
    entry_hierarchy_node<'h>(hierarchy: &'h Hierarchy<'_>) -> (Option<&'h Affine<Model, World>>, &'h [Node]) { (hierarchy.world(any() as usize), hierarchy.nodes()) }
    entry_instance_mesh<'p>(instance: &MeshInstance<'p, i16, WithPlanes>) -> (Mesh<'p, i16, WithPlanes>, Mesh<'p>) { (instance.mesh(), instance.without_planes().mesh()) }
    entry_mesh_planes(mesh: Mesh<'static, i16, WithPlanes>) -> (Mesh<'static>, Mesh<'static, i16, WithPlanes>) { (mesh.without_planes(), mesh.without_planes().with_planes_if_any()) }

    entry_band_bytes<'b>(band: &'b Band<'_, Rgb565>) -> &'b [u8] { band.bytes() }
    entry_frame_area(frame: &Frame<Rgb565>) -> Rectangle { frame.area() }
    entry_strip_bytes(width: u32, rows: u32) -> [usize; 2] { [Frame::<Rgb565>::strip_bytes(width, rows), Frame::<BinaryColor>::strip_bytes(width, rows)] }
    entry_depths<'d>(depth: &'d DepthBuffer<'_>) -> &'d [u16] { depth.values() }
    entry_dirty_area(dirty: &DirtyRegions<7>) -> Rectangle { dirty.area() }
    entry_table(colours: [Rgb565; 256]) -> Rgb565 { ShadeTable::from_colors(colours).colors()[usize::from(any() as u8)] }
    entry_lit(colour: Rgb888) -> pinhole::Dithered<Lit> { Gouraud::lit(colour, [any() as u16; 3]).dithered() }
    entry_triangle_plane(triangle: &Triangle<'_>, values: [u32; 3]) -> Gradient { triangle.gradient(values) }
    entry_carries_nothing(corner: usize) -> () { { <() as Varying>::of(corner); ().towards(&(), any().into()) } }

    entry_copies(
        affine: &Affine<Model, World>,
        normals: &NormalMatrix<Model, World>,
        point: &Point3<World>,
        vector: &Vector3<World>,
        fog: &Fog<SquaredFog>
    ) -> () {
        { core::hint::black_box((Clone::clone(affine), Clone::clone(normals), Clone::clone(point), Clone::clone(vector), Clone::clone(fog))); }
    }
    entry_copy_of_mesh(mesh: &Mesh<'static>) -> Mesh<'static> { Clone::clone(mesh) }
    entry_copy_of_transformed(transformed: &TransformedMesh<'static, i16, true>) -> TransformedMesh<'static, i16, true> { Clone::clone(transformed) }
}
