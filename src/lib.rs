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
//! | topic | start here | more |
//! |---|---|---|
//! | learning the pipeline | [`book`], chapter by chapter | seven programs to copy: the [cookbook](book::ch9_cookbook) |
//! | names to import | [`prelude`] | and [`Angle`], apart because embedded-graphics has one |
//! | meshes | [`Mesh`]; [`meshes`] has a cube, a torus … | [`FaceColors`], [`TextureCoords`]; [`pinhole-import`](https://docs.rs/pinhole-import) reads OBJ and STL files |
//! | moving objects | [`Affine`] | [`Hierarchy`] for joints, [`Quaternion`], [`Scalar`], [`space`] |
//! | cameras | [`Camera::framing`] | [`ViewTransform`], [`Projection`], [`Viewport`]; [choosing a projection](book::ch3_projections) |
//! | drawing | [`MeshInstance`]: `faces(..).draw(..)`, `edges(..)`, `points(..)` … | [`Painter`], [`Statistics`]; [which method](book::ch4_visibility) |
//! | many objects | [`Scene`] | [`Frustum`], [`Camera::visibility`] |
//! | targets | [`Surface`]: any DrawTarget, or pixels in memory; [with a depth buffer](Surface::depth_tested) | [`Picture`], [`Color`] |
//! | no framebuffer, DMA, two cores | [`Frame`], [`mesh_buffers!`], [`strip_buffers!`] | [bands](book::ch5_bands); [`DirtyRegions`] sends only what has changed |
//! | light | [`Lambert`] | [`Lights`], [`PointLight`], [`BlinnPhong`], [`Matcap`] |
//! | shading | a colour, [`Flat`], [`Gouraud`], [`ShadeTable`] | [`Texture`], [`Fogged`], [`VertexFog`], [`Translucent`], [`ScreenDoor`]; your own: [`Shader`] |
//! | sprites and lines | [`Sprite`], [`MeshInstance::polyline`] | [`AntiAliased`] |
//! | labels and picking | [`Camera::project`], [`Faces::pick`] | [`Camera::unproject`], [`Camera::ray`] |
//! | 2D, and the stages alone | [`fill_triangle`], [`draw_line`] | [`raster`], [`clip`] |
//! | RAM, flash and time | [estimating](book::ch6_budget) | [measuring on your board](book::ch10_measuring) |
//!
//! Templates for firmware, a viewer and a planner are in the repository; its [README.md] has the steps from a model to a display.
//!
//! # What holds everywhere
//!
//! * **Exact.** One fill rule decides each pixel: neighbours leave no crack and share no pixel, with equal bits on all cores, in debug and
//!   release builds. [docs/accuracy.md] has all errors, [docs/spec.md] the rules.
//! * **Integers only**, except in conversions from and to floats.
//! * **No panic, no heap, no `unsafe`.** Memory is the caller's; its lengths are computed from the mesh. Set-up errors say what to do.
//!   Drawing returns only the target's own error.
//! * **Unused features cost no flash** ([docs/footprint.md]). [docs/speed.md] has instructions, times and frames per second.
//! * **Ranges**: a world of ±32768 units in steps of 2⁻¹⁶, viewports within ±8192 pixels, at most 65 536 vertices per mesh. Faces run counter-clockwise
//!   seen from outside.
//!
//! The feature `defmt` gives every public type a `defmt::Format`. Minimum Rust: 1.88. Changes: [CHANGELOG.md].

#[cfg(doc)]
pub mod book;
mod camera;
pub mod clip;
mod color;
mod fast;
mod math;
pub mod meshes;
mod pipeline;
pub mod prelude;
pub mod raster;
mod scene;
mod shading;
pub mod space;
mod surface;

pub use camera::{
    Camera, CameraError, Frustum, PlanarProjection, Projected, Projection, Ray, ReferenceVolume,
    ScreenVertex, Side, VanishingPoint, ViewTransform, Viewport, Visibility, Window,
};
pub use color::{
    Access, Alpha, BlendMode, Color, Format, Half, Ink, Mixed, Reads, StoredPixel, Unmixed, Writes,
};
pub use math::{
    Affine, Angle, ClipPoint, Coordinate, Inside, MathError, NormalMatrix, Outcode, Point3, Quaternion,
    Scalar, Sphere, Vector3,
};
#[doc(hidden)]
pub use pipeline::largest;
pub use pipeline::{
    draw_line, fill_triangle, BinnedEdges, BinnedFaces, BinnedScene, Cull, Edges, Faces, HalfBins,
    HalfTransform, MeshBuffers, MeshInstance, Object, Painter, PaintersOrder, Picked, PlacedScene,
    PlacedSprites, Scene, SceneFaces, ShaderFor, SplitBins, SplitTransform, SpriteFor, Statistics, StrokeFor,
    TransformedMesh,
};
pub use scene::{
    edge_faces, FaceColors, FacePlanes, Hierarchy, Mesh, MeshError, Node, TextureCoords, WithPlanes,
    WithoutPlanes,
};
pub use shading::{
    Accuracy, AntiAliased, Blended, BlinnPhong, ClampedTexels, ColorKeyed, CornerValues, DepthTested,
    DirectionalLight, Dithered, ExponentialFog, Flat, Fog, FogProfile, FogTable, Fogged, Gouraud,
    HalfBlended, IndexKeyed, IndexedTexels, Lambert, LightError, Lights, LinearFog, Lit, LitIndexedTexels,
    LitPalette, LitTexels, LitTextured, Matcap, PointLight, RigidLambert, ScreenDoor, ShadeTable, Shader,
    SolidTexel, SpanShader, Sprite, SpriteImage, SpriteSource, SquaredFog, Stroke, TableShader, TexelSlice,
    Texels, Texture, TextureError, Textured, Translucent, VertexFog,
};
pub use surface::{
    Band, BufferError, DepthBuffer, DepthTestedSurface, DirtyRegions, Frame, Gives, LeastRun, Memory,
    Picture, PixelStore, Pixels, StripBuffers, Surface, Target, Tracked, TransferCost,
};
