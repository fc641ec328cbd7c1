//! The scenes of `scenes.json`: S1 and S2 show its cube, S3 its torus, S4 its icosphere, R1 its room.

use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model as ModelSpace, World};
use pinhole::{light::RigidLambert, prelude::*, shading::Lit, Angle};

/// Width and height of a frame.
pub const SIZE: u32 = 240;
/// Where no face is, and the colour of lines and of a face in full light.
pub const BACKGROUND: Rgb565 = Rgb565::BLACK;
pub const LINE: Rgb565 = Rgb565::CYAN;
const FACE: Rgb565 = Rgb565::new(31, 52, 14);
const AMBIENT: u16 = 48;

/// The pixels of a frame.
pub const fn area() -> Rectangle {
    Rectangle::new(Point::zero(), Size::new(SIZE, SIZE))
}

/// What `build.rs` makes of a model: of each one without face planes and one with them.
pub struct Model {
    pub mesh: Mesh<'static>,
    /// Where the object's axes point in the world, in 2⁻¹⁶.
    pub(crate) axes: [[i32; 3]; 3],
    /// Of the eye from the origin, in 2⁻¹⁶.
    pub(crate) distance: i32,
}

impl Model {
    /// Turned as it is shown. The compiler sees none of the numbers.
    #[inline(always)]
    pub fn turned(&self) -> Affine<ModelSpace, World> {
        turned(black_box(self).axes)
    }

    /// Before it. `None` is for what the types cannot know: that its numbers have an image.
    #[inline(always)]
    pub fn camera(&self) -> Option<Camera> {
        View::new([0, 0, black_box(self).distance], Size::new(SIZE, SIZE)).camera()
    }
}

include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// At compile time.
const fn mesh(
    vertices: &'static [[i16; 3]],
    exponent: i8,
    faces: &'static [[u16; 3]],
    normals: &'static [[i16; 3]],
    edges: &'static [[u16; 2]],
) -> Mesh<'static> {
    let Ok(mesh) = Mesh::new(vertices, exponent, faces) else { panic!("faces") };
    let Ok(mesh) = mesh.with_normals(normals) else { panic!("normals") };
    let Ok(mesh) = mesh.with_edges(edges) else { panic!("edges") };
    mesh
}

/// A model before its camera: set up before the frame.
pub struct Scene {
    mesh: Mesh<'static>,
    pub model: Affine<ModelSpace, World>,
    pub camera: Camera,
}

impl Scene {
    /// Of a model as it is shown.
    #[inline(always)]
    pub fn new(model: &'static Model) -> Option<Self> {
        let model = black_box(model);
        Some(Self { mesh: model.mesh, camera: model.camera()?, model: model.turned() })
    }

    /// Of any mesh, turned to these axes, from an eye that looks at the origin, in 2⁻¹⁶.
    #[inline(always)]
    pub fn viewed(mesh: Mesh<'static>, axes: [[i32; 3]; 3], eye: [i32; 3], size: Size) -> Option<Self> {
        Some(Self { mesh, camera: View::new(eye, size).camera()?, model: turned(axes) })
    }

    /// The first thing in every frame.
    #[inline(always)]
    pub fn place(&self) -> MeshInstance<'_> {
        self.camera.place(&self.mesh, &self.model)
    }

    /// The light, set up before the frame; `None` where there is none.
    pub fn light(&self) -> Option<Lambert> {
        lit(&self.model)
    }
    /// Lambert-flat.
    #[inline(always)]
    pub fn shade<'s>(&'s self, light: &'s Lambert) -> impl Fn(usize) -> Rgb565 + 's {
        flat(&self.mesh, |normal| light.level(normal))
    }
}

/// Turned to these axes, in 2⁻¹⁶.
fn turned(axes: [[i32; 3]; 3]) -> Affine<ModelSpace, World> {
    let [x, y, z] = axes.map(vector);
    Affine::from_frame(x, y, z, Point3::from_ints(0, 0, 0))
}

/// A camera at a place in the world. Lengths in 2⁻¹⁶.
pub(crate) struct View {
    pub(crate) eye: [i32; 3],
    /// A point before the eye.
    pub(crate) ahead: [i32; 3],
    /// The vertical angle of view.
    pub(crate) degrees: i32,
    /// The distances of the near and the far plane.
    pub(crate) range: [i32; 2],
    pub(crate) size: Size,
}

impl View {
    /// Of the origin.
    pub(crate) const fn new(eye: [i32; 3], size: Size) -> Self {
        Self { eye, ahead: [0; 3], degrees: 60, range: [1 << 15, 20 << 16], size }
    }

    /// The compiler sees none of the numbers. In a function of its own: what it is made of is off the stack when it returns.
    #[inline(never)]
    pub(crate) fn camera(&self) -> Option<Camera> {
        let Self { eye, ahead, degrees, range: [near, far], size } = *black_box(self);
        let place = |[x, y, z]: [Scalar; 3]| Point3::new(x, y, z);
        let [eye, ahead] = [eye, ahead].map(|at| place(at.map(Scalar::from_bits)));
        let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).ok()?;
        let [near, far] = [near, far].map(Scalar::from_bits);
        let projection = Projection::perspective(Angle::degrees(degrees), size, near, far).ok()?;
        Some(Camera::new(&view, &projection, &Viewport::new(Point::zero(), size).ok()?))
    }
}

/// Each face in the light that its normal has; `level` is that of a normal.
#[inline(always)]
pub fn flat<'s>(mesh: &'s Mesh<'s>, level: impl Fn([i16; 3]) -> u16 + 's) -> impl Fn(usize) -> Rgb565 + 's {
    move |face| mesh.normals().get(face).map_or(FACE, |&normal| FACE.dim(level(normal)))
}

/// [`flat`] where an instance has the mesh. The images of which flash is measured hold the mesh, one word where the list of normals
/// is two: up to 40 bytes at opt-level s.
#[inline(always)]
pub fn flat_of_normals<'s>(normals: &'s [[i16; 3]], light: &'s Lambert) -> impl Fn(usize) -> Rgb565 + 's {
    |face| normals.get(face).map_or(FACE, |&normal| FACE.dim(light.level(normal)))
}

/// Each face in the light that its normal has, in dithered colours.
#[inline(always)]
pub fn flat_dithered<'s>(
    normals: &'s [[i16; 3]],
    light: &'s Lambert,
) -> impl Fn(usize) -> Dithered<Flat> + 's {
    |face| {
        let level = normals.get(face).map_or(256, |&normal| light.level(normal));
        Dithered(Flat::lit(Rgb888::WHITE, level))
    }
}

/// Each corner in a light of its own: what the light's level is for its place, as if that were a normal.
#[inline(always)]
pub fn smooth<'s>(mesh: &'s Mesh<'s>, light: &'s Lambert) -> impl Fn(usize) -> Lit + 's {
    |face| {
        let corners = mesh.faces().get(face).copied().unwrap_or_default();
        let place = |vertex: u16| mesh.vertices().get(usize::from(vertex)).copied().unwrap_or_default();
        Gouraud::lit(Rgb888::WHITE, corners.map(|vertex| light.level(place(vertex))))
    }
}

/// Where the light of all scenes is.
pub fn lit(model: &Affine<ModelSpace, World>) -> Option<Lambert> {
    Lambert::new(model, vector(black_box(LIGHT)), AMBIENT).ok()
}

/// [`lit`] for a model that only turns.
pub fn rigidly_lit(model: &Affine<ModelSpace, World>) -> Option<RigidLambert> {
    RigidLambert::new(model, vector(black_box(LIGHT)), AMBIENT).ok()
}

fn vector<S>(bits: [i32; 3]) -> Vector3<S> {
    let [x, y, z] = bits.map(Scalar::from_bits);
    Vector3::new(x, y, z)
}
