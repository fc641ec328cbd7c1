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
//! # Ok::<(), ViewportError>(())
//! ```

pub use crate::space::{Model, View, World};
pub use crate::{
    draw_line, edge_faces, fill_triangle, Affine, AxisError, Band, BandError, BinError, BinnedEdges,
    BinnedFaces, Camera, Channels, ClipPoint, Coordinate, CornerValues, Cull, DepthBuffer, DepthBufferError,
    Dim, DirtyRegions, Dithered, Flat, Frame, Gouraud, Hierarchy, HierarchyError, InverseError, Lambert,
    LightError, Lit, MatrixError, Memory, Mesh, MeshError, MeshInstance, Node, NormalMatrix, NumberError,
    Outcode, Painter, PainterError, PaintersOrder, Picture, PictureError, PixelFormat, PixelStore, Pixels,
    PlanarProjection, PlaneCulled, Point3, ProjectError, Projection, ProjectionError, Quaternion,
    QuaternionError, Ray, ReferenceVolume, Scalar, ScreenVertex, ShadeTable, Shader, Side, SpanShader,
    Sphere, Statistics, StoredPixel, TableShader, Target, TransferCost, TransformedMesh, VanishingPoint,
    Vector3, ViewTransform, ViewTransformError, Viewport, ViewportError, Visibility, Window,
};
