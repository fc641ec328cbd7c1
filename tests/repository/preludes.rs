//! `pinhole::prelude` has every name of the crate's root but `Angle`, and none of embedded-graphics' prelude.

use std::collections::BTreeSet;

/// What a program sees that imports both preludes.
mod both {
    #[allow(unused_imports)]
    pub(super) use embedded_graphics::prelude::*;
    #[allow(unused_imports)]
    pub(super) use pinhole::prelude::*;
}

/// Uses each name: one that both preludes export is ambiguous, and does not compile.
macro_rules! names {
    ($($name:ident)*) => {
        $(
            #[allow(unused_imports)]
            use both::$name as _;
        )*
        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

names! {
    Model View World
    draw_line edge_faces fill_triangle mesh_buffers strip_buffers Accuracy Affine Alpha AntiAliased AxisError Band BandError BinError BinnedEdges BinnedFaces BinnedScene Blend BlendMode Blended BlinnPhong Camera Channels ClampedTexels ClipPoint ColorKeyed Coordinate CornerValues Cull DepthBuffer DepthBufferError DepthTested Dim DirectionalLight DirtyRegions Dithered ExponentialFog FaceColors FacePlanes Flat Fog FogError FogProfile FogTable Fogged Frame FramingError Frustum Gouraud Half HalfBins HalfBlended HalfTransform Hierarchy HierarchyError IndexKeyed IndexedTexels Inside InverseError Lambert LeastRun LightError Lights LinearFog Lit LitIndexedTexels LitPalette LitTexels LitTextured Matcap MaterialError MatrixError Memory Mesh MeshBuffers MeshError MeshInstance Node NormalMatrix NumberError Object Outcode Painter PainterError PaintersOrder Picked Picture PictureError PixelFormat PixelStore Pixels PlacedScene PlacedSprites PlanarProjection Point3 PointLight ProjectError Projected Projection ProjectionError Quaternion QuaternionError Ray ReferenceVolume RigidLambert Scalar Scene SceneError ScreenDoor ScreenVertex ShadeTable Shader Side SolidTexel SpanShader Sphere SplitBins SplitTransform Sprite SpriteImage SpriteSource SquaredFog Statistics StoredPixel StripBuffers Stroke TableShader Target TexelSlice Texels Texture TextureCoords TextureError Textured Tracked TransferCost TransformedMesh Translucent VanishingPoint Vector3 VertexFog ViewTransform ViewTransformError Viewport ViewportError Visibility Window WithPlanes WithoutPlanes
}

fn exported(source: &str) -> BTreeSet<&str> {
    let source = source.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    let names = source.flat_map(|path| path.split(['{', '}', ',']).skip(1)).map(str::trim);
    names.filter(|name| !name.is_empty()).collect()
}

#[test]
fn both_preludes_can_be_imported() {
    let mut root = exported(include_str!("../../src/lib.rs"));
    root.remove("Angle");
    root.extend(["Model", "View", "World"]);
    root.extend(["mesh_buffers", "strip_buffers"]); // macros: `#[macro_export]` puts them there
    assert_eq!(NAMES.iter().copied().collect::<BTreeSet<_>>(), root);
    assert_eq!(exported(include_str!("../../src/prelude.rs")), root);
}
