//! Every public type can be logged by defmt: one list of them all, held against the sources and, with the feature
//! (`cargo test --features defmt --test format`), by the compiler. What they print, `examples/log` shows on a device.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The list, by types whose parameters have no Format where there are any.
macro_rules! public_types {
    ($($name:ident $(<$($parameter:tt),*>)?),* $(,)?) => {
        const LISTED: &[&str] = &[$(stringify!($name)),*];

        #[cfg(feature = "defmt")]
        #[allow(dead_code)] // that it compiles is the test
        fn all_are_formats() {
            use pinhole::{clip::*, raster::*, space::*, *};
            struct Plain;
            fn is_format<T: defmt::Format>() {}
            $(is_format::<$name $(<$($parameter),*>)?>();)*
        }
    };
}

public_types![
    Affine<Plain, Plain>,
    Angle,
    AxisError,
    Band<'static, Plain>,
    BandError,
    Barycentric,
    BinsError,
    Camera,
    Canonical,
    ClipPoint,
    ClipVertex<2>,
    Corner,
    Cull,
    DepthBuffer<'static>,
    DepthBufferError,
    Dirty<4>,
    Dithered<Flat>,
    Edges<'static, Plain, true>,
    Faces<'static, Plain, true>,
    Facing<'static, Plain>,
    Flat,
    Frame<Plain>,
    Gouraud,
    Lit,
    Hidden,
    Hierarchy<'static>,
    HierarchyError,
    InverseError,
    Lambert,
    LightError,
    MatrixError,
    Mesh<'static, Plain>,
    MeshError,
    Model,
    Ndc,
    Node,
    NormalMap<Plain, Plain>,
    NumberError,
    Outcode,
    Painter<Plain, 4, 4>,
    PaintersOrder<'static, Plain>,
    Picture<'static, Plain>,
    PictureError,
    Pixel,
    Pixels<'static, Plain>,
    Placed<'static, Plain>,
    PlanarProjection,
    Plane,
    Point3<Plain>,
    Projection,
    ProjectionError,
    Quaternion,
    QuaternionError,
    Ray,
    RecordError,
    ReferenceVolume,
    Scissor,
    ShadeTable<Plain>,
    Shaded<'static, Plain>,
    ScreenPoint,
    Side,
    Span,
    Sphere,
    Statistics,
    Transformed<'static, Plain, true>,
    Triangle<'static>,
    VanishingPoint,
    Vector3<Plain>,
    View,
    Viewing,
    ViewingError,
    Viewport,
    ViewportError,
    Visibility,
    Window,
    WindowCost,
    World,
];

/// Public by their keyword only: what inks and targets have of their own, which no path leads to.
const NOT_NAMED: [&str; 6] = ["Against", "Even", "Piece", "Ramps", "Shade", "Shades"];

#[test]
fn no_public_type_is_missing() {
    let mut found = BTreeSet::new();
    types(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut found);
    let listed = LISTED.iter().chain(&NOT_NAMED).map(|name| name.to_string()).collect();
    assert_eq!(found, listed, "the sources' public types, and those listed here");
}

/// What cannot be named needs no Format; what can be does.
#[test]
fn what_is_left_out_is_not_exported() {
    let root = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).expect("lib.rs");
    let words: BTreeSet<&str> = root.split(|c: char| !c.is_alphanumeric()).collect();
    assert!(words.contains("Gouraud"), "not the list of exports: {root}");
    for name in NOT_NAMED {
        assert!(!words.contains(name), "{name} is exported");
    }
}

/// The names after `pub struct`, `pub enum` and `pub union` at the start of a line.
fn types(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            types(&path, found);
        } else {
            let text = fs::read_to_string(&path).expect("a source file");
            for line in text.lines() {
                let line = line.trim_start();
                let after =
                    ["pub struct ", "pub enum ", "pub union "].iter().find_map(|k| line.strip_prefix(k));
                if let Some(rest) = after {
                    found.insert(rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("").to_string());
                }
            }
        }
    }
}
