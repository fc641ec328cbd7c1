#![no_std]
// docs.rs marks items that need a feature.
#![cfg_attr(docsrs, feature(doc_cfg))]
// The first definition of a link counts: these replace the README's relative links, which lead nowhere on docs.rs.
#![doc = include_str!("book/links.md")]
#![doc = include_str!("../README.md")]

#[cfg(doc)]
pub mod book;
mod camera;
pub mod clip;
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
    Camera, FramingError, Frustum, PlanarProjection, ProjectError, Projected, Projection, ProjectionError,
    Ray, ReferenceVolume, ScreenVertex, Side, VanishingPoint, ViewTransform, ViewTransformError, Viewport,
    ViewportError, Visibility, Window,
};
pub use math::{
    Affine, Angle, AxisError, ClipPoint, Coordinate, Inside, InverseError, MatrixError, NormalMatrix,
    NumberError, Outcode, Point3, Quaternion, QuaternionError, Scalar, Sphere, Vector3,
};
#[doc(hidden)]
pub use pipeline::largest;
pub use pipeline::{
    draw_line, fill_triangle, BinError, BinnedEdges, BinnedFaces, BinnedScene, Cull, HalfBins, HalfTransform,
    MeshBuffers, MeshInstance, Object, Painter, PainterError, PaintersOrder, Picked, PlacedScene,
    PlacedSprites, Scene, SceneError, SplitBins, SplitTransform, Statistics, TransformedMesh,
};
pub use scene::{
    edge_faces, FaceColors, FacePlanes, Hierarchy, HierarchyError, MaterialError, Mesh, MeshError, Node,
    TextureCoords, WithPlanes, WithoutPlanes,
};
pub use shading::{
    Accuracy, Alpha, AntiAliased, Blend, BlendMode, Blended, BlinnPhong, Channels, ClampedTexels, ColorKeyed,
    CornerValues, DepthTested, Dim, DirectionalLight, Dithered, ExponentialFog, Flat, Fog, FogError,
    FogProfile, FogTable, Fogged, Gouraud, Half, HalfBlended, IndexKeyed, IndexedTexels, Lambert, LightError,
    Lights, LinearFog, Lit, LitIndexedTexels, LitPalette, LitTexels, LitTextured, Matcap, PointLight,
    RigidLambert, ScreenDoor, ShadeTable, Shader, SolidTexel, SpanShader, Sprite, SpriteImage, SpriteSource,
    SquaredFog, Stroke, TableShader, TexelSlice, Texels, Texture, TextureError, Textured, Translucent,
    VertexFog,
};
pub use surface::{
    Band, BandError, DepthBuffer, DepthBufferError, DirtyRegions, Frame, LeastRun, Memory, Picture,
    PictureError, PixelFormat, PixelStore, Pixels, StoredPixel, StripBuffers, Target, Tracked, TransferCost,
};
