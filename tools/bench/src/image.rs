//! What the images share whose size in flash is measured. Each is a firmware of its own, and all of them hold the cube.

use crate::scene::{lit, rigidly_lit, Model, CUBE, SIZE};
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::space::{Model as ModelSpace, World};
use pinhole::{
    light::RigidLambert,
    mesh::edge_faces,
    prelude::*,
    texture::{IndexedTexels, LitTextured},
    Angle,
};

/// A program that draws a frame of each of [`cubes`], one after the other: the second one is cut, so what cutting takes of
/// the stack is seen.
#[macro_export]
macro_rules! image {
    ($cube:ident, $($name:ident: $type:ty = $start:expr,)* $body:block) => {
        $crate::image!([$crate::scene::Model; $crate::image::cubes] $cube, $($name: $type = $start,)* $body);
    };
    ([$model:ty; $cubes:path] $cube:ident, $($name:ident: $type:ty = $start:expr,)* $body:block) => {
        $crate::firmware!($($name: $type = $start,)* {
            #[allow(clippy::too_many_arguments)] // the variables of the largest
            fn frame($cube: &'static $model, $($name: &mut $type),*) -> Option<()> $body
            for cube in $cubes() {
                frame(cube, $($name),*)?;
            }
            Some(())
        });
    };
}

/// The cube, and one twice as large about the same centre: the near planes of [`Turntable`]'s camera and of
/// [`Scene`](crate::scene::Scene)'s cut it where it shows, and both eyes are outside of it.
const CUBES: [Model; 2] = {
    let Model { mesh: cube, axes, distance } = CUBE;
    let Ok(mesh) = Mesh::new(cube.vertices(), cube.exponent() + 1, cube.faces()) else { panic!("faces") };
    let Ok(mesh) = mesh.with_normals(cube.normals()) else { panic!("normals") };
    let Ok(mesh) = mesh.with_edges(cube.edges()) else { panic!("edges") };
    [Model { mesh: cube, axes, distance }, Model { mesh, axes, distance: 3 << 16 }]
};

/// Both cubes. The compiler does not know how many there are: it makes the code of a frame once.
pub fn cubes() -> &'static [Model] {
    static BOTH: [Model; 2] = CUBES;
    black_box(BOTH.as_slice())
}

/// [`cubes`] with the faces beside their edges.
pub fn cubes_with_edge_faces() -> &'static [Model] {
    const BESIDE: [[u16; 2]; EDGES] = {
        let Some(edges) = CUBE.mesh.edges().first_chunk::<EDGES>() else { panic!("edges") };
        edge_faces(edges, CUBE.mesh.faces())
    };
    const fn with(Model { mesh, axes, distance }: &Model) -> Model {
        let Ok(mesh) = mesh.with_edge_faces(&BESIDE) else { panic!("faces beside edges") };
        Model { mesh, axes: *axes, distance: *distance }
    }
    static BOTH: [Model; 2] = [with(&CUBES[0]), with(&CUBES[1])];
    black_box(BOTH.as_slice())
}

/// What the book's chapter on budgets says that they take of a frame; on a Cortex-M0 a mesh takes more.
#[cfg(all(target_arch = "arm", target_has_atomic = "32"))]
const _: () = {
    assert!(size_of::<MeshInstance<'_>>() == 176);
    assert!(size_of::<pinhole::draw::BinnedFaces<'_>>() == 92);
    assert!(size_of::<Lambert>() == 52);
};

/// The cube's vertices, and bin storage for its faces or edges.
pub const CORNERS: usize = 8;
pub const BIN_STORAGE: usize = 12 + 1 + 4;
const EDGES: usize = 12;

/// Rows of a band.
pub const ROWS: u32 = 8;

/// The texture coordinates of the corners of both faces of a side, in 1/16 texel.
pub const UV: [[[i16; 2]; 3]; 2] = [[[0, 128], [128, 128], [128, 0]], [[0, 128], [128, 0], [0, 0]]];

/// Each face with a small picture on it, in the light that its normal has.
#[inline(always)]
pub fn textured<'s>(
    mesh: &'s Mesh<'s>,
    light: &'s Lambert,
) -> impl Fn(usize) -> LitTextured<IndexedTexels<'static, Rgb565, 1>> + 's {
    const PALETTE: [Rgb565; 2] = [Rgb565::new(31, 63, 31), Rgb565::new(15, 31, 15)];
    const TEXELS: IndexedTexels<'static, Rgb565, 1> = {
        let Ok(texels) = IndexedTexels::new(&[0xf0; 8], 8, 8, &PALETTE) else { panic!("texels") };
        texels
    };
    |face| {
        let level = mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
        let [even, odd] = UV;
        Texture::new(TEXELS).at(if face % 2 == 0 { even } else { odd }).lit([level; 3])
    }
}

/// Before the cube, and a constant, as that of a firmware whose camera stands still.
const CAMERA: Camera = {
    // So far above the larger cube that the near plane cuts its top where that shows.
    let (height, distance) = (Scalar::from_bits(5 << 15), Scalar::from_bits(9 << 14));
    let eye = Point3::new(Scalar::ZERO, height, distance);
    let (origin, up) = (Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0));
    let Ok(viewing) = ViewTransform::look_at(eye, origin, up) else { panic!("the direction") };
    let size = Size::new(SIZE, SIZE);
    let Ok(viewport) = Viewport::new(Point::zero(), size) else { panic!("the size") };
    let (near, far) = (Scalar::from_int(1), Scalar::from_int(20));
    let Ok(lens) = Projection::perspective(Angle::degrees(60), size, near, far) else { panic!("the lens") };
    Camera::new(&viewing, &lens, &viewport)
};

/// The cube on a turntable.
pub struct Turntable {
    pub model: Affine<ModelSpace, World>,
}

impl Turntable {
    /// Turned by an angle that the compiler does not know.
    pub fn turned() -> Self {
        Self { model: Affine::rotation_y(Angle::from_bits(black_box(1 << 29))) }
    }

    #[inline(always)]
    pub fn place(&self, cube: &'static Model) -> MeshInstance<'static> {
        self.camera().place(&cube.mesh, &self.model)
    }

    /// The compiler does not see that there is but one.
    #[inline(always)]
    pub fn camera(&self) -> &'static Camera {
        black_box(&CAMERA)
    }

    pub fn light(&self) -> Option<Lambert> {
        lit(&self.model)
    }

    pub fn rigid_light(&self) -> Option<RigidLambert> {
        rigidly_lit(&self.model)
    }
}

/// A display that costs next to nothing: a driver's code is not the library's.
pub struct Sink;

impl OriginDimensions for Sink {
    fn size(&self) -> Size {
        black_box(Size::new(SIZE, SIZE))
    }
}

impl DrawTarget for Sink {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for pixel in pixels {
            black_box(pixel);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: Rgb565) -> Result<(), Infallible> {
        black_box((area, colour));
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        black_box(area);
        for colour in colours {
            black_box(colour);
        }
        Ok(())
    }
}

/// The names that the images use.
pub mod prelude {
    pub use super::{cubes_with_edge_faces, Sink, Turntable, BIN_STORAGE, CORNERS, ROWS, UV};
    pub use crate::bands::{bytes, pixels};
    pub use crate::scene::Model;
    pub use crate::{image, is_equal, scene};
    pub use core::hint::black_box;
    pub use embedded_graphics_core::geometry::{Point, Size};
    pub use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
    pub use embedded_graphics_core::primitives::Rectangle;
    pub use pinhole::{
        bands::{DirtyRegions, TransferCost},
        color::Half,
        fog::{Fog, FogTable, VertexFog},
        mesh::Coordinate,
        prelude::*,
        shading::{AntiAliased, SpanShader, Translucent},
        target::LeastRun,
        texture::ColorKeyed,
        Angle,
    };
}
