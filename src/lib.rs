#![no_std]
// docs.rs marks items that need a feature.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![doc = include_str!("book/links.md")]
#![doc = include_str!("book/pictures.md")]
//! Exact 3D for microcontroller displays: a rasteriser in integer arithmetic that draws into any
//! [`embedded-graphics`](https://docs.rs/embedded-graphics) DrawTarget, without heap and without a framebuffer.
//!
//! ![A gear with a hole, lit][docs/part.png] ![A landscape of two ridges, coloured by height][docs/cookbook/scope.png]
//! ![A torus, a frame time and a graph][docs/cookbook/hud.png]
//!
//! A lit torus with a depth buffer:
//!
//! ```
//! use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
//! use pinhole::{meshes::TORUS, prelude::*, Angle};
//!
//! // Pixels in memory. A display's driver and a band of some rows are targets, too.
//! let (size, mut pixels) = (Size::new(120, 120), [Rgb565::CSS_BLACK; 120 * 120]);
//! let mut picture = Picture::new(&mut pixels, size)?;
//! let mut depths = [0; 120 * 120];
//! let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
//!
//! // A camera that shows all of the mesh, from above and from one side.
//! let viewport = Viewport::new(Point::zero(), size)?;
//! let [fov, yaw, pitch] = [40, 20, 30].map(Angle::degrees);
//! let camera = Camera::framing(&TORUS.bounding_sphere(), &viewport, fov, yaw, pitch)?;
//!
//! // For each frame: place the mesh, and draw its faces, dimmed by the light.
//! let model = Affine::rotation_x(Angle::degrees(15));
//! let light = Lambert::new(&model, Vector3::from_ints(1, 3, 2), 40)?;
//! let color = |face: usize| Rgb565::CSS_GOLD.dim(light.level(TORUS.normals()[face]));
//! let mut cache = mesh_buffers!(TORUS).cache;
//! let torus = camera.place(&TORUS, &model);
//! let mut target = picture.pixels();
//! let statistics = torus.faces(color).cached(&mut cache).draw(&mut target.depth_tested(&mut depth))?;
//! assert!(statistics.drawn > 100 && statistics.culled > 100);
//! # assert!(picture.colors().iter().filter(|&&color| color != Rgb565::CSS_BLACK).count() > 120 * 120 / 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//!
//! | topic | module | start here |
//! |---|---|---|
//! | learning the pipeline | [`book`] | chapter by chapter; nine programs to copy: the [cookbook](book#cookbook) |
//! | names to import | [`prelude`] | and [`Angle`], apart because embedded-graphics has one |
//! | numbers, moving objects | [`math`], [`space`] | [`Affine`], [`Scalar`]; [`Hierarchy`](mesh::Hierarchy) for joints |
//! | cameras | [`camera`] | [`Camera::framing`]; [`Projection`], [`Viewport`]; [choosing a projection](camera#choosing-a-projection) |
//! | meshes | [`mesh`], [`meshes`] | [`Mesh`]; a ready cube, torus …; [`pinhole-import`](https://docs.rs/pinhole-import) reads OBJ and STL files |
//! | drawing | [`draw`] | [`MeshInstance`](draw::MeshInstance): `faces(..).draw(..)`, `edges(..)`, `points(..)` …; [which method](draw#hidden-surface-removal) |
//! | many objects | [`draw`] | [`Scene`](draw::Scene); [`Camera::frustum`] says what is in view |
//! | targets | [`target`], [`color`] | [`Surface`](target::Surface): any DrawTarget, or pixels in memory; [with a depth buffer](target::Surface::depth_tested); your own colour: [`Color`](color::Color) |
//! | no framebuffer, DMA, two cores | [`bands`] | [`Frame`](bands::Frame), [`mesh_buffers!`], [`strip_buffers!`]; [how](bands#bands-and-dma); [`DirtyRegions`](bands::DirtyRegions) sends what has changed |
//! | light | [`light`] | [`Lambert`](light::Lambert); several and point lights, highlights, matcaps |
//! | shading | [`shading`], [`texture`], [`fog`] | a colour, [`Gouraud`](shading::Gouraud), [`Texture`](texture::Texture), [`Fogged`](fog::Fogged); your own: [`SpanShader`](shading::SpanShader) |
//! | sprites, smooth edges | [`sprite`], [`draw`] | [`Sprite`](sprite::Sprite); [`AntiAliased`](shading::AntiAliased) lines; [`SmoothEdges`](draw::SmoothEdges) of faces |
//! | labels and picking | [`camera`], [`draw`] | [`Camera::project`], [`Faces::pick`](draw::Faces::pick) |
//! | 2D | [`raster`] | [`fill_triangle`](draw::fill_triangle), [`draw_line`](draw::draw_line) |
//! | RAM, flash and time | [`book`] | [estimating](book#estimating-ram-flash-and-frame-time), [measuring on your board](book#measuring-on-your-board) |
//!
//! Templates for firmware, a viewer and a planner are in the repository; its [README.md] has the steps from a model to a display.
//!
//! # What holds everywhere
//!
//! * **Exact.** One fill rule decides each pixel: neighbours leave no crack and share no pixel, with equal bits on all cores, in debug and
//!   release builds. [docs/accuracy.md] has all errors, [docs/spec.md] the rules.
//! * **Integers only**, except in conversions from and to floats.
//! * **No panic, no heap, no `unsafe`.** Memory is the caller's; its lengths are computed from the mesh. Print set-up errors by `{error}`:
//!   `Display` says what to do, and `Debug`, by which an error of `main` is printed, does not. Drawing returns only the target's own error.
//! * **Unused features cost no flash** ([docs/footprint.md]). [docs/speed.md] has instructions, times and frames per second.
//! * **Ranges**: a world of ±32768 units in steps of 2⁻¹⁶, viewports within ±8192 pixels, at most 65 536 vertices per mesh. Faces run counter-clockwise
//!   seen from outside.
//!
//! Features: `defmt` gives every public type a `defmt::Format`; `fixed` converts a [`Scalar`] from and to an
//! `I16F16` of that crate. Minimum Rust: 1.88. Changes: [CHANGELOG.md].

/// Implements `defmt::Format` for a type whose parameters need not implement it: the parameters in brackets, the type, `self`, and
/// the text and arguments of `defmt::write!`.
macro_rules! defmt_format {
    ([$($parameter:tt)*] $type:ty, $own:ident, $($text:tt)*) => {
        #[cfg(feature = "defmt")]
        impl<$($parameter)*> defmt::Format for $type {
            fn format(&$own, f: defmt::Formatter<'_>) {
                let _ = $own; // some texts have no arguments
                defmt::write!(f, $($text)*);
            }
        }
    };
}

#[cfg(doc)]
pub mod book;
pub mod camera;
mod clip;
pub mod color;
mod fast;
pub mod math;
pub mod meshes;
mod pipeline;
pub mod prelude;
pub mod raster;
mod scene;
pub mod shading;
pub mod space;
mod surface;

pub mod mesh {
    //! Meshes, the colours and texture coordinates of their faces, and hierarchies of moving parts. Start with [`Mesh`]; the ready ones are in
    //! [`meshes`](crate::meshes).

    pub use crate::math::form::Coordinate;
    pub use crate::scene::{edge_faces, FaceColors, Hierarchy, Mesh, MeshError, Node, TextureCoords};
}

pub mod draw {
    #![doc = include_str!("book/links.md")]
    //! Drawing: one mesh, a scene of many, faces from far to near, bands, picking, and triangles and lines in 2D. Start with
    //! [`MeshInstance`]; [`Scene`] is for many objects, [`BinnedFaces`] for bands.
    //!
    #![doc = include_str!("book/visibility.md")]

    pub use crate::math::form::Inside;
    pub use crate::pipeline::{
        draw_line, fill_triangle, ActiveFace, ActiveFaces, BinnedEdges, BinnedFaces, BinnedScene, Cull,
        Edges, Faces, MeshInstance, Object, Painter, PaintersOrder, Picked, PlacedScene, Scene, ShaderFor,
        SmoothEdge, SmoothEdges, SmoothScene, SpriteFor, Statistics, StrokeFor, TransformedMesh,
    };
}

pub mod target {
    //! Drawing targets: any DrawTarget, or pixels in memory, with a depth buffer or without. Start with [`Surface`], the trait of every
    //! DrawTarget; [`Picture`] is a framebuffer.

    pub use crate::surface::{
        BufferError, DepthBuffer, DepthTestedSurface, LeastRun, Memory, Picture, Pixels, SmoothPass, Surface,
        Target,
    };
}

pub mod bands {
    //! Frames without a framebuffer, drawn and sent in bands of some rows, and the rectangles that a new frame has to send. Start with
    //! [`Frame`], and with [`DirtyRegions`] where little changes.
    //!
    #![doc = include_str!("book/bands.md")]
    //!
    #![doc = include_str!("book/tearing.md")]
    //!
    #![doc = include_str!("book/tearing.svg")]
    //!
    #![doc = include_str!("book/tearing_rules.md")]

    pub use crate::surface::{Band, DirtyRegions, Frame, SmoothBand, SmoothFrame, Tracked, TransferCost};
}

pub mod light {
    //! Light, computed for faces or vertices. Start with [`Lambert`]; [`Lights`] adds several.

    pub use crate::shading::highlight::BlinnPhong;
    pub use crate::shading::lambert::{Lambert, RigidLambert};
    pub use crate::shading::light::Light;
    pub use crate::shading::light_error::LightError;
    pub use crate::shading::lights::Lights;
    pub use crate::shading::matcap::Matcap;
    pub use crate::shading::point_light::PointLight;
}

pub mod texture {
    //! Pictures on faces, perspective-correct. Start with [`Texture`].

    pub use crate::shading::texture::{
        Accuracy, BilinearTexels, ClampedTexels, ColorKeyed, IndexedTexels, LitTextured, MipPicture,
        MipTexels, TexelSlice, Texels, Texture, TextureError, Textured,
    };
}

pub mod fog {
    //! Fog by distance, for pixels or vertices. Start with [`FogTable`] and [`Fogged`].

    pub use crate::shading::fog::{Fog, FogTable, Fogged, VertexFog};
}

pub mod sprite {
    //! Pictures that face the viewer: trees, particles, labels. Start with [`Sprite`].

    pub use crate::pipeline::PlacedSprites;
    pub use crate::shading::sprite::{SolidTexel, Sprite, SpriteImage, SpriteSource};
}

// What nearly every program names.
pub use camera::{Camera, Projection, ViewTransform, Viewport};
pub use math::{Affine, Angle, Point3, Scalar, Vector3};
pub use mesh::Mesh;
// Each is a type and a macro; `#[macro_export]` puts macros here.
#[doc(hidden)]
pub use pipeline::largest;
pub use pipeline::MeshBuffers;
pub use surface::StripBuffers;
