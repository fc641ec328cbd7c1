//! What firmware calls before and between frames.

use crate::any;
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::raster::ScreenPoint;
use pinhole::space::{Model, Ndc, View, World};
use pinhole::{
    Affine, Angle, Camera, ClipPoint, Lambert, LightError, Mesh, MeshError, NumberError, Point3, Projection,
    ProjectionError, Scalar, Statistics, Vector3, Viewing, ViewingError, Viewport, ViewportError, Window,
};

type Vertices = &'static [[i16; 3]];
type WideVertices = &'static [[Scalar; 3]];
type Faces = &'static [[u16; 3]];
type Edges = &'static [[u16; 2]];

fn scalar() -> Scalar {
    Scalar::from_bits(any())
}

fn point() -> Point3<World> {
    Point3::new(scalar(), scalar(), scalar())
}

fn vector() -> Vector3<World> {
    Vector3::new(scalar(), scalar(), scalar())
}

fn size() -> Size {
    Size::new(any() as u32, any() as u32)
}

fn window() -> Window {
    Window { left: scalar(), right: scalar(), bottom: scalar(), top: scalar() }
}

macro_rules! entries {
    ($($name:ident($($argument:ident: $type:ty),*) -> $result:ty { $body:expr })*) => {$(
        #[unsafe(no_mangle)]
        fn $name($($argument: $type),*) -> $result {
            $body
        }
    )*};
}

entries! {
    entry_angle(a: Angle, b: Angle) -> (i32, i32) { (a + b - -Angle::turns(any(), any() as u32) + Angle::degrees(any())).sin_cos() }
    entry_angle_f32(degrees: f32) -> Result<Angle, NumberError> { Angle::from_degrees_f32(degrees) }
    entry_point_f32(x: f32, y: f32, z: f32) -> Result<Point3<World>, NumberError> { Point3::from_f32(x, y, z) }
    entry_vector_f32(x: f32, y: f32, z: f32) -> Result<Vector3<World>, NumberError> { Vector3::from_f32(x, y, z) }

    entry_translation() -> Affine<Model, World> { Affine::translation(vector()) }
    entry_scale() -> Affine<Model, World> { Affine::scale(scalar()) }
    entry_scale_axes() -> Affine<Model, World> { Affine::scale_axes(scalar(), scalar(), scalar()) }
    entry_rotation_x(angle: Angle) -> Affine<Model, World> { Affine::rotation_x(angle) }
    entry_rotation_y(angle: Angle) -> Affine<Model, World> { Affine::rotation_y(angle) }
    entry_rotation_z(angle: Angle) -> Affine<Model, World> { Affine::rotation_z(angle) }
    entry_then(a: &Affine<Model, Model>, b: &Affine<Model, World>) -> Affine<Model, World> { a.then(b) }
    entry_apply(a: &Affine<Model, World>, p: Point3<Model>) -> Point3<World> { a.apply(p) }

    entry_look_at() -> Result<Viewing, ViewingError> { Viewing::look_at(point(), point(), vector()) }
    entry_look_along() -> Result<Viewing, ViewingError> { Viewing::look_along(point(), vector(), vector()) }
    entry_from_reference() -> Result<Viewing, ViewingError> { Viewing::from_reference(point(), vector(), vector()) }
    entry_view(viewing: &Viewing) -> Point3<View> { viewing.apply(point()) }
    entry_perspective(fov: Angle) -> Result<Projection, ProjectionError> { Projection::perspective(fov, size(), scalar(), scalar()) }
    entry_frustum() -> Result<Projection, ProjectionError> { Projection::frustum(window(), scalar(), scalar()) }
    entry_orthographic() -> Result<Projection, ProjectionError> { Projection::orthographic(window(), scalar(), scalar()) }
    entry_clip(projection: &Projection, p: Point3<View>) -> ClipPoint { projection.apply(p) }
    entry_divide(p: &ClipPoint) -> Option<Point3<Ndc>> { p.ndc() }
    entry_viewport() -> Result<Viewport, ViewportError> { Viewport::new(Point::new(any(), any()), size()) }
    entry_screen(viewport: &Viewport, p: Point3<Ndc>) -> ScreenPoint { viewport.apply(p) }
    entry_camera(a: &Viewing, b: &Projection, c: &Viewport) -> Camera { Camera::new(a, b, c).with_far_clip(any() == 0) }

    entry_light(model: &Affine<Model, World>, ambient: u16) -> Result<Lambert, LightError> { Lambert::new(model, vector(), ambient) }
    entry_level(light: &Lambert, normal: [i16; 3]) -> u16 { light.level(normal) }
    entry_statistics(a: Statistics, b: Statistics) -> Statistics { a.and(b) }
    entry_mesh(v: Vertices, exponent: i8, f: Faces) -> Result<Mesh<'static>, MeshError> { Mesh::new(v, exponent, f) }
    entry_wide_mesh(v: WideVertices, f: Faces) -> Result<Mesh<'static, Scalar>, MeshError> { Mesh::from_fixed(v, f) }
    entry_edges(mesh: Mesh<'static>, e: Edges) -> Result<Mesh<'static>, MeshError> { mesh.with_edges(e) }
    entry_normals(mesh: Mesh<'static>, n: Vertices) -> Result<Mesh<'static>, MeshError> { mesh.with_normals(n) }
}
