//! Everything that a program usually needs, in one line: `use pinhole::prelude::*`.
//!
//! The names do not collide with those of `embedded_graphics::prelude`, so both preludes can be imported. [`Angle`](crate::Angle)
//! is not here, because `embedded-graphics` has an `Angle` too: write `pinhole::Angle`.
//!
//! ```
//! use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
//! use pinhole::prelude::*;
//!
//! let size = Size::new(64, 64);
//! let viewport = Viewport::new(Point::zero(), size)?;
//! let turned = Affine::<Model, World>::identity().rotate_y(pinhole::Angle::degrees(30));
//! # let _ = (viewport, turned, Rgb565::RED);
//! # Ok::<(), CameraError>(())
//! ```

// `MeshBuffers` and `StripBuffers` are each a type and a macro: this exports both.
pub use crate::{mesh_buffers, strip_buffers, MeshBuffers, StripBuffers};

pub use crate::camera::{
    Camera, CameraError, Frustum, PlanarProjection, Projected, Projection, Ray, ReferenceVolume,
    ScreenVertex, Side, VanishingPoint, ViewTransform, Viewport, Visibility, Window,
};
pub use crate::color::{
    Access, Alpha, BlendMode, Color, Format, Half, Ink, Mixed, Reads, StoredPixel, Unmixed, Writes,
};
pub use crate::math::{
    Affine, ClipPoint, Coordinate, Inside, MathError, NormalMatrix, Outcode, Point3, Quaternion, Scalar,
    Sphere, Vector3,
};
pub use crate::pipeline::{
    draw_line, fill_triangle, BinnedEdges, BinnedFaces, BinnedScene, Cull, Edges, Faces, HalfBins,
    HalfTransform, MeshInstance, Object, Painter, PaintersOrder, Picked, PlacedScene, PlacedSprites, Scene,
    SceneFaces, ShaderFor, SplitBins, SplitTransform, SpriteFor, Statistics, StrokeFor, TransformedMesh,
};
pub use crate::scene::{
    edge_faces, FaceColors, FacePlanes, Hierarchy, Mesh, MeshError, Node, TextureCoords, WithPlanes,
    WithoutPlanes,
};
pub use crate::shading::{
    Accuracy, AntiAliased, Blended, BlinnPhong, ClampedTexels, ColorKeyed, CornerValues, DepthTested,
    DirectionalLight, Dithered, ExponentialFog, Flat, Fog, FogProfile, FogTable, Fogged, Gouraud,
    HalfBlended, IndexKeyed, IndexedTexels, Lambert, LightError, Lights, LinearFog, Lit, LitIndexedTexels,
    LitPalette, LitTexels, LitTextured, Matcap, PointLight, RigidLambert, ScreenDoor, ShadeTable, Shader,
    SolidTexel, SpanShader, Sprite, SpriteImage, SpriteSource, SquaredFog, Stroke, TableShader, TexelSlice,
    Texels, Texture, TextureError, Textured, Translucent, VertexFog,
};
pub use crate::space::{Model, View, World};
pub use crate::surface::{
    Band, BufferError, DepthBuffer, DepthTestedSurface, DirtyRegions, Frame, Gives, LeastRun, Memory,
    Picture, PixelStore, Pixels, Surface, Target, Tracked, TransferCost,
};
