//! Every public type can be logged by defmt, and can be sent to another core and shared with it. A list of all types is compared
//! with the sources and checked by the compiler: the former with the feature (`cargo test -p pinhole-tests --features defmt --test format`), the
//! latter always. `examples/log` tests the output on a device.

use std::collections::BTreeSet;

/// All public names.
mod everything {
    pub(super) use pinhole::{
        bands::*, camera::*, color::*, draw::*, fog::*, light::*, math::*, mesh::*, raster::*, shading::*,
        space::*, sprite::*, target::*, texture::*, *,
    };
}

/// The list, by types whose parameters have no Format where there are any.
macro_rules! public_types {
    ($($name:ident $(<$($parameter:tt),*>)?),* $(,)?) => {
        const LISTED: &[&str] = &[$(stringify!($name)),*];

        #[cfg(feature = "defmt")]
        #[allow(dead_code)] // that it compiles is the test
        fn all_are_formats() {
            use everything::*;
            struct Plain;
            fn is_format<T: defmt::Format>() {}
            $(is_format::<$name $(<$($parameter),*>)?>();)*
        }

        #[allow(dead_code)] // that it compiles is the test
        fn all_are_send_and_sync() {
            use everything::*;
            struct Plain;
            fn is_send_and_sync<T: Send + Sync>() {}
            $(is_send_and_sync::<$name $(<$($parameter),*>)?>();)*
        }
    };
}

/// An image without a Format.
struct Image;

impl embedded_graphics::image::GetPixel for Image {
    type Color = embedded_graphics::pixelcolor::Gray8;

    fn pixel(&self, _: embedded_graphics::geometry::Point) -> Option<Self::Color> {
        None
    }
}

impl embedded_graphics::geometry::OriginDimensions for Image {
    fn size(&self) -> embedded_graphics::geometry::Size {
        embedded_graphics::geometry::Size::zero()
    }
}

public_types! {
    Affine<Plain, Plain>, ActiveFace<Plain>, ActiveFaces<'static, Plain>, Angle, AntiAliased<ScreenPoint>, MathError, Band<'static, Plain>, BufferError, Barycentric, Alpha,
    Camera, CornerValues, ScreenVertex, Cull, DepthBuffer<'static>,
    DepthTestedSurface<'static, 'static, Plain>,    DirtyRegions<4>, FaceColors<'static>, MeshError, TextureCoords<'static>, Dithered<Flat>, BinnedEdges<'static>,
    BinnedScene<'static, 'static, Plain, 3>, BinnedFaces<'static>, Flat, Format,
    Edges<'static, i16, Plain>, Faces<'static, i16, Plain>,
    Frame<Plain>, CameraError, Gouraud, Gradient, Lit, Projected, Hierarchy<'static>, Inside<Plain>,
    Frustum, Lambert, BlinnPhong, Lights<2>, Matcap, PointLight,
    LeastRun<'static, Plain, 1>, LightError, Memory<Plain>, Mixed<Flat, Alpha>, Mesh<'static, Plain>, MeshBuffers<3, 2, 1>,
    Model, Ndc, Node, Painter<Plain, 4, 4>, PerspectiveGouraud,
    PaintersOrder<'static, Plain>, Picture<'static, Plain>, Pixels<'static, Plain>, MeshInstance<'static,
    i16>, Point3<Plain>, Projection, Object<'static, Plain>, Picked, PlacedSprites<'static, i16>, Rotation, Upright<'static, Plain>, PlacedScene<'static, 'static, Plain, 3>, Scene<'static,
    Plain, 3>, RigidLambert, Scalar, ShadeTable<Plain>, TableShader<'static, Plain>,
    Accuracy, AntiAliasedBy<Plain, Plain>, Half, DepthTested<Flat>, Fog, FogTable<Plain>, Fogged<'static, Flat, Plain>,
    VertexFog, ColorKeyed<Plain, Plain>, IndexedTexels<'static, Plain,
    1>, ClampedTexels<Plain>, LitTextured<Plain>, MipPicture<Plain, 8, 8>, MipTexels<Plain>, BilinearTexels<Plain>,
    TexelSlice<'static, Plain>, Texture<Plain>, TextureError, Textured<Plain>, ScreenDoor<Flat>, SmoothBand<'static, 'static, Plain>, SmoothEdge, SmoothEdges<'static, i16>,
    SmoothFrame<'static, Plain>, SmoothPass<'static, Plain, Plain>, SmoothScene<'static, 'static, Plain, 3>, SolidTexel<ScreenPoint>,
    Sprite<Plain>, SpriteImage<'static, Image>, ScreenPoint, Span, Sphere, Statistics, StripBuffers<6, 2>,
    TransformedMesh<'static>, Triangle<'static>, Vector3<Plain>, View, ViewTransform,
    Viewport, Visibility, Window, Tracked<Plain>, TransferCost, Translucent<Flat, Half>,
    World
}

/// Public by their keyword only: set-ups of shaders, marks of targets and inks, and what is returned to be passed on; no path leads to them.
const NOT_NAMED: [&str; 12] = [
    "AntiAliasedByTable",
    "DepthLevels",
    "FoggedSetup",
    "LevelGradients",
    "Reads",
    "RotatedPicture",
    "Tested",
    "TextureGradients",
    "Unmatched",
    "Untested",
    "Weights",
    "Writes",
];

#[test]
fn no_public_type_is_missing() {
    // A chapter's programs are text to the crate, and only doctests compile them.
    let files = support::sources().into_iter().filter(|(file, _)| !file.starts_with("book/"));
    let found: BTreeSet<String> =
        files.flat_map(|(_, text)| text.lines().filter_map(named).collect::<Vec<_>>()).collect();
    let listed = LISTED.iter().chain(&NOT_NAMED).map(|name| name.to_string()).collect();
    assert_eq!(found, listed, "the sources' public types, and those listed here");
}

/// A type that users cannot name needs no Format. Public modules export their `pub use` items and the public types of their
/// own files.
#[test]
fn types_left_out_of_the_list_are_not_public() {
    let sources = support::sources();
    let root = &sources["lib.rs"];
    let modules: Vec<&str> = root.lines().filter_map(|line| line.strip_prefix("pub mod ")).collect();
    // A module with a body in lib.rs has no file, and exports types of other modules.
    let files = modules.iter().filter_map(|name| name.strip_suffix(';')).map(|name| {
        let mut paths = [format!("{name}/mod.rs"), format!("{name}.rs")].into_iter();
        paths.find(|path| sources.contains_key(path)).expect("a file")
    });
    let files: Vec<String> = files.collect();
    assert!(files.contains(&"shading/mod.rs".into()) && files.contains(&"meshes.rs".into()), "{files:?}");
    let mut exported = BTreeSet::new();
    let files = files.iter().filter(|file| !file.starts_with("book"));
    for text in files.map(|file| &sources[file]).chain([root]) {
        for item in text.split(';').filter_map(|item| item.split_once("pub use ")) {
            exported.extend(item.1.split(|c: char| !c.is_alphanumeric()).map(str::to_string));
        }
        exported.extend(text.lines().filter_map(named));
    }
    assert!(
        ["Gouraud", "Gradient", "Barycentric"].iter().all(|&name| exported.contains(name)),
        "{exported:?}"
    );
    for name in NOT_NAMED {
        assert!(!exported.contains(name), "{name} is exported");
    }
}

/// The name after `pub struct`, `pub enum` or `pub union` at the start of a line.
fn named(line: &str) -> Option<String> {
    let line = line.trim_start();
    let rest = ["pub struct ", "pub enum ", "pub union "].iter().find_map(|kind| line.strip_prefix(kind))?;
    rest.split(|c: char| !c.is_alphanumeric()).next().map(str::to_string)
}
