//! What firmware calls before and between frames: set-up, reading what was set up, colours of every format, and copies of types whose
//! `Clone` is written by hand.

use crate::any;
use crate::inputs::{pixel, point, report, rotation, scalar, size, vector, window};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::{Gradient, ScreenPoint, Triangle};
use pinhole::shading::{Lit, Varying};
use pinhole::space::{Model, Ndc, View, World};
use pinhole::{
    bands::{DirtyRegions, SmoothFrame},
    camera::{CameraError, Frustum, Projected, Rotation, Visibility},
    color::{Format, StoredPixel},
    draw::TransformedMesh,
    light::{BlinnPhong, LightError, Lights, Matcap, PointLight, RigidLambert},
    math::{MathError, Sphere},
    mesh::{edge_faces, Coordinate, FaceColors, Hierarchy, MeshError, Node, TextureCoords},
    prelude::*,
    Angle,
};

type Vertices = &'static [[i16; 3]];
type WideVertices = &'static [[Scalar; 3]];
type Faces = &'static [[u16; 3]];
type Edges = &'static [[u16; 2]];

/// One format of colour: its code on the wire and in memory, and its colours from light.
macro_rules! colours {
    ($($name:ident: $colour:ty, $memory:ty;)*) => {$(
        #[unsafe(no_mangle)]
        fn $name(colour: $colour, emission: $colour) -> ($colour, $colour, $colour, u32, [u8; 3], $memory, $colour) {
            let channels = <$colour>::from_channels([any() as u8, any() as u8, any() as u8]);
            let decoded = <$colour as Color>::from_bits(any() as u32);
            let cell: $memory = colour.stored();
            let loaded = <$colour as StoredPixel<$memory>>::load(black_box(cell));
            (colour.dim(any() as u16).emitting(emission), channels, decoded, colour.to_bits(), colour.channels(), cell, loaded)
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

#[cfg(feature = "fixed")]
entries! {
    entry_scalar_i16f16(a: Scalar, fixed: fixed::types::I16F16) -> (Scalar, fixed::types::I16F16) { (fixed.into(), a.into()) }
}

entries! {
    entry_scalar_operators(a: Scalar, b: Scalar) -> [Scalar; 6] { [a + b, a - b, a * b, a / b, -a, a.abs()] }
    entry_scalar_assignments(a: &mut Scalar) { *a += scalar(); *a -= scalar(); *a *= scalar(); *a /= scalar() }
    entry_scalar_from() -> [Scalar; 3] { [Scalar::from_int(any()), Scalar::from_ratio(any(), any()), Scalar::from(any() as i16)] }
    entry_scalar_from_floats(single: f32, double: f64) -> [Result<Scalar, MathError>; 2] { [Scalar::from_f32(single), Scalar::try_from(double)] }
    entry_scalar_to(a: Scalar) -> f64 { a.into() }
    entry_angle(a: Angle, b: Angle) -> (i32, i32) { (a + b - -Angle::turns(any(), any() as u32) + Angle::degrees(any())).sin_cos() }
    entry_sin_cos(a: Angle) -> (Scalar, Scalar) { (a.sin(), a.cos()) }
    entry_atan2(y: Scalar, x: Scalar) -> Angle { Angle::atan2(y, x) }
    entry_vector_sums() -> (Vector3<World>, Vector3<World>) { (vector() + vector() - vector(), -vector() * scalar()) }
    entry_vector_moves(moved: &mut Vector3<World>) { *moved += vector(); *moved -= vector() }
    entry_point_sums() -> (Point3<World>, Vector3<World>) { (point() + vector() - vector(), point() - point()) }
    entry_point_moves(moved: &mut Point3<World>) { *moved += vector(); *moved -= vector() }
    entry_vector_products() -> (Scalar, Vector3<World>, Scalar) { (vector().dot(vector()), vector().cross(vector()), vector().length()) }
    entry_chain(a: &Affine<Model, World>, angle: Angle) -> Affine<Model, World> {
        a.rotate_x(angle).rotate_y(angle).rotate_z(angle).translate(vector())
    }
    entry_framing(sphere: &Sphere, viewport: &Viewport, fov: Angle, yaw: Angle, pitch: Angle) -> Result<Camera, CameraError> {
        Camera::framing(sphere, viewport, fov, yaw, pitch)
    }
    entry_buffer_lengths(mesh: &Mesh<'static>) -> [usize; 4] { [mesh.vertices().len(), mesh.face_bins_len(), mesh.edge_bins_len(), pinhole::largest(&[any() as usize, any() as usize])] }
    entry_buffers(mesh: &mut MeshBuffers<9, 9, 9>, strip: &mut StripBuffers<8, 4>) { *mesh = MeshBuffers::default(); *strip = StripBuffers::default() }
    entry_painter(painter: &mut Painter<Rgb565, 9, 9>, vertex: &mut ScreenVertex) { *painter = Painter::default(); *vertex = ScreenVertex::default() }
    entry_orbit(yaw: Angle, pitch: Angle) -> ViewTransform { ViewTransform::orbit(point(), scalar(), yaw, pitch) }
    entry_screen_point(at: ScreenPoint) -> Point { at.into() }
    entry_angle_f32(degrees: f32) -> Result<Angle, MathError> { Angle::from_degrees_f32(degrees) }
    entry_point_f32(x: f32, y: f32, z: f32) -> Result<Point3<World>, MathError> { Point3::from_f32(x, y, z) }
    entry_vector_ints(x: i16, y: i16, z: i16) -> Vector3<World> { Vector3::from_ints(x, y, z) }
    entry_vector_f32(x: f32, y: f32, z: f32) -> Result<Vector3<World>, MathError> { Vector3::from_f32(x, y, z) }

    entry_translation() -> Affine<Model, World> { Affine::translation(vector()) }
    entry_scale() -> Affine<Model, World> { Affine::scale(scalar()) }
    entry_scale_axes() -> Affine<Model, World> { Affine::scale_axes(scalar(), scalar(), scalar()) }
    entry_rotation_x(angle: Angle) -> Affine<Model, World> { Affine::rotation_x(angle) }
    entry_rotation_y(angle: Angle) -> Affine<Model, World> { Affine::rotation_y(angle) }
    entry_rotation_z(angle: Angle) -> Affine<Model, World> { Affine::rotation_z(angle) }
    entry_then(a: &Affine<Model, Model>, b: &Affine<Model, World>) -> Affine<Model, World> { a.then(b) }
    entry_apply(a: &Affine<Model, World>, p: Point3<Model>) -> Point3<World> { a.apply(p) }

    entry_look_at() -> Result<ViewTransform, CameraError> { ViewTransform::look_at(point(), point(), vector()) }
    entry_from_reference() -> Result<ViewTransform, CameraError> { ViewTransform::from_reference(point(), vector(), vector()) }
    entry_view(viewing: &ViewTransform) -> Point3<View> { viewing.apply(point()) }
    entry_perspective(fov: Angle) -> Result<Projection, CameraError> { Projection::perspective(fov, size(), scalar(), scalar()) }
    entry_frustum() -> Result<Projection, CameraError> { Projection::frustum(window(), scalar(), scalar()) }
    entry_orthographic() -> Result<Projection, CameraError> { Projection::orthographic(window(), scalar(), scalar()) }
    entry_clip(projection: &Projection, p: Point3<View>) -> Option<Point3<Ndc>> { projection.apply(p) }
    entry_viewport() -> Result<Viewport, CameraError> { Viewport::new(pixel(), size()) }
    entry_screen(viewport: &Viewport, p: Point3<Ndc>) -> ScreenPoint { viewport.apply(p) }
    entry_camera(a: &ViewTransform, b: &Projection, c: &Viewport) -> Camera { Camera::new(a, b, c).with_far_clip(any() == 0) }

    entry_light(model: &Affine<Model, World>, ambient: u16) -> Result<Lambert, LightError> { Lambert::new(model, vector(), ambient) }
    entry_level(light: &Lambert, normal: [i16; 3]) -> u16 { light.level(normal) }
    entry_rigid_light(model: &Affine<Model, World>, ambient: u16) -> Result<RigidLambert, LightError> { RigidLambert::new(model, vector(), ambient) }
    entry_rigid_level(light: &RigidLambert, normal: [i16; 3]) -> u16 { light.level(normal) }
    entry_rigid_levels(light: &RigidLambert, normals: &[[i16; 3]], levels: &mut [u16]) { light.levels(normals, levels) }
    entry_lights(model: &Affine<Model, World>, lights: &[(Vector3<World>, u16); 3], ambient: u16) -> Result<Lights<3>, LightError> { Lights::new(model, lights, ambient) }
    entry_lights_levels(light: &Lights<3>, normals: &[[i16; 3]], levels: &mut [u16]) -> u16 { light.levels(normals, levels); light.level([any() as i16; 3]) }
    entry_blinn_phong(model: &Affine<Model, World>, ambient: u16, shininess: u16) -> Result<BlinnPhong, LightError> { BlinnPhong::new(model, vector(), vector(), ambient, shininess) }
    entry_blinn_phong_levels(light: &BlinnPhong, normals: &[[i16; 3]], levels: &mut [u16]) -> u16 { light.levels(normals, levels); light.level([any() as i16; 3]) }
    entry_highlight_table(color: Rgb888, highlight: Rgb888) -> [ShadeTable<Rgb565>; 1] { [ShadeTable::with_highlight(color, highlight)] }
    entry_emission(color: Rgb888, emission: Rgb888, levels: [u16; 3]) -> (Flat, Gouraud) { (Flat::lit(color, any() as u16).emitting(emission), Gouraud::lit(color, levels).emitting(emission)) }
    entry_emitting_table(color: Rgb888, emission: Rgb888) -> (ShadeTable<Rgb565>, ShadeTable<Gray8>) { (ShadeTable::emitting(color, emission), ShadeTable::emitting(color, emission)) }
    entry_point_light(model: &Affine<Model, World>, exponent: i8, strength: u16) -> PointLight { PointLight::new(model, exponent, point(), scalar(), strength) }
    entry_point_light_level(light: &PointLight, position: [i16; 3], normal: [i16; 3]) -> u16 { light.level(position, normal) }
    entry_view_normals(view: &ViewTransform, model: &Affine<Model, World>) -> Matcap { Matcap::new(view, model) }
    entry_matcap_coords(matcap: &Matcap) -> [i16; 2] { matcap.coords([any() as i16; 3]) }
    entry_matcap_color(matcap: &Matcap, ball: &[[Rgb565; 32]; 32], normal: [i16; 3]) -> Rgb565 { matcap.color(ball, normal) }
    entry_statistics(a: Statistics, b: Statistics) -> Statistics { a + b }
    entry_mesh(v: Vertices, exponent: i8, f: Faces) -> Result<Mesh<'static>, MeshError> { Mesh::new(v, exponent, f) }
    entry_wide_mesh(v: WideVertices, f: Faces) -> Result<Mesh<'static, Scalar>, MeshError> { Mesh::from_fixed(v, f) }
    entry_format(red: u32, green: u32, blue: u32) -> [Format; 4] { [Format::rgb(red, green, blue), Format::bgr(blue, green, red), Format::gray(red), Format::indexed(red, [any() as u8; 3])] }
    entry_format_of(format: Format, bits: u32) -> [Format; 2] { [format.padded_to(bits), format.in_bytes()] }
    entry_format_parts(format: Format) -> (u32, [u8; 3]) { (format.bits(), format.max()) }
    entry_face_colors(p: &'static [[u8; 3]], f: &'static [u8]) -> Result<FaceColors<'static>, MeshError> { FaceColors::new(p, f) }
    entry_face_color(colors: &FaceColors<'static>, face: usize) -> Rgb565 { colors.color(face) }
    entry_face_emission(colors: FaceColors<'static>, e: &'static [[u8; 3]]) -> Result<FaceColors<'static>, MeshError> { colors.with_emission(e) }
    entry_face_lit(colors: &FaceColors<'static>, face: usize, level: u16) -> (Rgb565, Gray8) { (colors.lit(face, level), colors.emission(face)) }
    entry_texture_coords(c: &'static [[i16; 2]], f: Faces, exponent: i8) -> Result<TextureCoords<'static>, MeshError> { TextureCoords::new(c, f, exponent) }
    entry_texture_corners(t: &TextureCoords<'static>, face: usize) -> ([[i16; 2]; 3], i8) { (t.corners(face), t.exponent()) }
    entry_edges(mesh: Mesh<'static>, e: Edges) -> Result<Mesh<'static>, MeshError> { mesh.with_edges(e) }
    entry_edge_faces(mesh: Mesh<'static>, e: Edges) -> Result<Mesh<'static>, MeshError> { mesh.with_edge_faces(e) }
    entry_normals(mesh: Mesh<'static>, n: Vertices) -> Result<Mesh<'static>, MeshError> { mesh.with_normals(n) }
    entry_planes(mesh: Mesh<'static>, p: &'static [i16]) -> Result<Mesh<'static>, MeshError> { mesh.with_planes(p) }
    entry_clusters(mesh: &Mesh<'static>) -> &'static [[i16; 8]] { mesh.clusters() }
    entry_mesh_lists(mesh: &Mesh<'static>) -> [Vertices; 2] { [mesh.vertices(), mesh.normals()] }
    entry_mesh_edges(mesh: &Mesh<'static>) -> (Faces, [Edges; 2]) { (mesh.faces(), [mesh.edges(), mesh.edge_faces()]) }
    entry_mesh_numbers(mesh: &Mesh<'static>) -> (&'static [i16], i8) { (mesh.planes(), mesh.exponent()) }
    entry_face_planes(mesh: &Mesh<'static>, face: usize) -> ([i16; 9], i16) { (mesh.face_planes(), mesh.face_plane(face)) }
    entry_wide_face_plane(mesh: &Mesh<'static, Scalar>, face: usize) -> i16 { mesh.face_plane(face) }
    entry_vertex_normals(mesh: Mesh<'static>, n: Vertices) -> Result<Mesh<'static>, MeshError> { mesh.with_vertex_normals(n) }

    entry_rotation(angle: Angle) -> Result<Affine<Model, World>, MathError> { Affine::rotation(point(), vector(), angle) }
    entry_micromath(q: micromath::Quaternion) -> Result<Affine<Model, World>, MathError> { q.try_into() }
    entry_from_quaternion() -> Result<Affine<Model, World>, MathError> { Affine::from_quaternion([scalar(), scalar(), scalar(), scalar()]) }
    entry_from_frame() -> Affine<Model, World> { Affine::from_frame(vector(), vector(), vector(), point()) }
    entry_inverse(a: &Affine<Model, World>) -> Result<Affine<World, Model>, MathError> { a.inverse() }

    entry_isometric() -> ViewTransform { ViewTransform::isometric(point()) }
    entry_view_matrix(m: &[[f64; 4]; 4]) -> Result<ViewTransform, CameraError> { ViewTransform::from_matrix(m) }
    entry_oblique(angle: Angle) -> Result<Projection, CameraError> { Projection::oblique(window(), scalar(), scalar(), angle, scalar()) }
    entry_planar(q: Option<Scalar>, d: Vector3<View>) -> Result<Projection, CameraError> { Projection::planar(scalar(), q, d, window(), scalar(), scalar()) }
    entry_reference() -> Result<Projection, CameraError> { Projection::perspective_from_reference(point(), window(), scalar(), scalar()) }
    entry_reference_parallel() -> Result<Projection, CameraError> { Projection::parallel_from_reference(point(), window(), scalar(), scalar()) }
    entry_affine_matrix(m: &[[f64; 4]; 4]) -> Result<Affine<Model, World>, MathError> { Affine::from_matrix(m) }
    entry_affine_to_matrix(a: &Affine<Model, World>) -> [[f64; 4]; 4] { a.to_matrix() }
    entry_view_to_matrix(v: &ViewTransform) -> [[f64; 4]; 4] { v.to_matrix() }
    entry_projection_to_matrix(p: &Projection) -> [[f64; 4]; 4] { p.to_matrix() }
    entry_matrix(m: &[[f64; 4]; 4]) -> Result<Projection, CameraError> { Projection::from_matrix(m) }

    entry_project(camera: &Camera) -> Result<Projected, CameraError> { camera.project(point()) }
    entry_unproject(camera: &Camera, at: ScreenPoint, depth: u16) -> Option<Point3<World>> { camera.unproject(at, depth) }
    entry_vanishing_points(camera: &Camera) -> [Option<[i32; 2]>; 3] { camera.vanishing_points() }
    entry_camera_frustum(camera: &Camera) -> Frustum { camera.frustum() }
    entry_frustum_visibility(frustum: &Frustum, s: &Sphere, a: &Affine<Model, World>) -> Visibility { frustum.visibility(s, a) }
    entry_bounding_sphere(mesh: &Mesh<'static>) -> Sphere { mesh.bounding_sphere() }
    entry_wide_bounding_sphere(mesh: &Mesh<'static, Scalar>) -> Sphere { mesh.bounding_sphere() }
    entry_sphere_around(spheres: &[Sphere]) -> Sphere { Sphere::around(spheres.iter().copied().chain([Sphere { centre: Point3::from_ints(1, 2, 3), radius: Scalar::from_bits(any()) }])) }
    entry_sphere_transformed(s: &Sphere, a: &Affine<Model, World>) -> Sphere { s.transformed(a) }
    entry_hierarchy(nodes: &'static mut [Node]) -> Result<Hierarchy<'static>, MeshError> { Hierarchy::new(nodes) }
    entry_update(hierarchy: &mut Hierarchy<'static>) { hierarchy.update() }
    entry_set_local(hierarchy: &mut Hierarchy<'static>, local: Affine<Model, Model>) -> bool { hierarchy.set_local(any() as usize, local) }

    entry_edge_faces_of_12(edges: &[[u16; 2]; 12], faces: &[[u16; 3]]) -> [[u16; 2]; 12] { edge_faces(edges, faces) }
    entry_edge_faces_of_1(edges: &[[u16; 2]; 1], faces: &[[u16; 3]]) -> [[u16; 2]; 1] { edge_faces(edges, faces) }
    entry_edge_faces_of_500(edges: &[[u16; 2]; 500], faces: &[[u16; 3]]) -> [[u16; 2]; 500] { edge_faces(edges, faces) }

    entry_vector_parts(v: Vector3<World>) -> [Scalar; 3] { [v.x(), v.y(), v.z()] }
    entry_vector_micromath(v: micromath::vector::F32x3) -> Result<Vector3<World>, MathError> { v.try_into() }
    entry_viewport_parts(viewport: &Viewport) -> (Size, Rectangle, Rotation, Point) {
        (viewport.size(), viewport.area(), viewport.rotation(), viewport.upright_point(pixel()))
    }
    entry_moved_viewport() -> Result<Viewport, CameraError> {
        Ok(Viewport::new(pixel(), size())?.rotated(rotation()).jittered([any() as i8, any() as i8]))
    }
    entry_coordinates(narrow: i16, wide: Scalar) -> (i32, i32) { (Coordinate::times(narrow, any()), Coordinate::times(wide, any())) }

    entry_nodes(local: Affine<Model, Model>) -> [Node; 2] { [Node::root(local), Node::child(any() as u16, local)] }
    entry_hierarchy_node<'h>(hierarchy: &'h Hierarchy<'_>) -> Option<&'h Affine<Model, World>> { hierarchy.world(any() as usize) }
    entry_instance_mesh<'p>(instance: &MeshInstance<'p>) -> &'p Mesh<'p> { instance.mesh() }

    entry_band_bytes<'b>(band: &'b Band<'_, Rgb565>) -> &'b [u8] { band.bytes() }
    entry_frame_area(frame: &Frame<Rgb565>) -> Rectangle { frame.area() }
    entry_strip_bytes(width: u32, rows: u32) -> [usize; 3] { [Frame::<Rgb565>::strip_bytes(width, rows), Frame::<BinaryColor>::strip_bytes(width, rows), SmoothFrame::<Rgb565>::strip_bytes(width, rows)] }
    entry_depths<'d>(depth: &'d DepthBuffer<'_>) -> &'d [u16] { depth.values() }
    entry_dirty_area(dirty: &DirtyRegions<7>) -> Rectangle { dirty.area() }
    entry_table(colours: [Rgb565; 256]) -> Rgb565 { ShadeTable::from_colors(colours).colors()[usize::from(any() as u8)] }
    entry_lit(colour: Rgb888) -> pinhole::shading::Dithered<Lit> { Dithered(Gouraud::lit(colour, [any() as u16; 3])) }
    entry_triangle_plane(triangle: &Triangle<'_>, values: [u32; 3]) -> Gradient { triangle.gradient(values) }
    entry_triangle_depth(triangle: &Triangle<'_>, depths: [i32; 3]) -> Gradient { triangle.depth_gradient(depths) }
    entry_carries_nothing(corner: usize) { <() as Varying>::of(corner); ().towards(&(), any().into()) }

    entry_copies(
        affine: &Affine<Model, World>,
        point: &Point3<World>,
        vector: &Vector3<World>
    ) {
        report((Clone::clone(affine), Clone::clone(point), Clone::clone(vector)))
    }
    entry_copy_of_mesh(mesh: &Mesh<'static>) -> Mesh<'static> { Clone::clone(mesh) }
    entry_copy_of_transformed(transformed: &TransformedMesh<'static>) -> TransformedMesh<'static> { Clone::clone(transformed) }
}
