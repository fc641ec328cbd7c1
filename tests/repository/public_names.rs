//! Every public name is in the glossary, few are in the prelude and at the root, and every public trait says what to do.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use support::ROOT;

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
    mesh_buffers strip_buffers Affine Band BinnedFaces Camera Color Cull DepthBuffer Dithered Flat Fogged Frame Gouraud Lambert Light Mesh MeshBuffers
    MeshInstance Model Object Painter Picture Point3 Projection Scalar Scene ScreenDoor ScreenVertex ShadeTable Sprite Statistics StripBuffers Surface
    Target Texture Vector3 ViewTransform Viewport World
}

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join(path)).expect(path)
}

/// The names that `pub use module::{...};` and `pub use module::Name;` export.
fn exported(source: &str) -> BTreeSet<String> {
    let shown = source.replace("#[doc(hidden)]\npub use ", "");
    let uses = shown.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    let items = uses.flat_map(|path| path.rsplit("::").next().unwrap_or("").split(['{', '}', ',']));
    items.map(|name| name.trim().to_string()).filter(|name| !name.is_empty()).collect()
}

/// A reader finds names by topic: few of them are where all are seen.
#[test]
fn both_preludes_can_be_imported_and_are_short() {
    let prelude = exported(&read("src/prelude.rs"));
    assert_eq!(NAMES.iter().map(|name| name.to_string()).collect::<BTreeSet<_>>(), prelude);
    assert!(prelude.len() <= 40, "{} names in the prelude", prelude.len());
    // Lines of `lib.rs` outside its modules: what is indented belongs to one.
    let at_root: String = read("src/lib.rs")
        .lines()
        .filter(|line| !line.starts_with(' '))
        .map(|line| format!("{line}\n"))
        .collect();
    let mut root = exported(&at_root);
    // Types with a macro of the same name, which `#[macro_export]` puts there.
    assert!(root.remove("MeshBuffers") && root.remove("StripBuffers"));
    assert!(root.len() <= 10 && root.contains("Angle"), "{root:?}");
}

/// The names of public items at the top level of a file.
fn declared(source: &str) -> BTreeSet<String> {
    let items = source.lines().filter_map(|line| line.strip_prefix("pub "));
    let words = |item: &str| {
        let item = item.replace("const fn ", "fn ");
        let mut words = item.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_string);
        Some((words.next()?, words.next()?))
    };
    let is_item = |kind: &str| ["struct", "enum", "trait", "fn", "const", "type"].contains(&kind);
    items.filter_map(words).filter(|(kind, _)| is_item(kind)).map(|(_, name)| name).collect()
}

/// The names that users can import.
fn public() -> BTreeSet<String> {
    let mut public = exported(&read("src/lib.rs"));
    for file in ["src/clip.rs", "src/meshes.rs", "src/space.rs", "src/raster/mod.rs"] {
        public.extend(declared(&read(file)));
    }
    for module in ["camera", "color", "math", "raster", "shading"] {
        public.extend(exported(&read(&format!("src/{module}/mod.rs"))));
    }
    public
}

#[test]
fn every_public_name_is_in_the_glossary() {
    let public = public();
    assert!(["Camera", "edge_faces", "Barycentric", "Span", "fill_triangle"]
        .iter()
        .all(|name| public.contains(*name)));
    // The names in backticks in the third column of the tables, and the parts of `Type::function`.
    let glossary = read("GLOSSARY.md");
    let thirds = glossary.lines().filter_map(|line| line.strip_prefix('|')?.split('|').nth(2));
    let code = thirds.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    let explained: BTreeSet<&str> = code.flat_map(|name| name.trim_end_matches("()").split("::")).collect();
    let missing: Vec<_> = public.iter().filter(|name| !explained.contains(name.as_str())).collect();
    assert!(missing.is_empty(), "GLOSSARY.md has no entry for {missing:?}");
}

/// The compiler's own message names the trait alone.
#[test]
fn every_public_trait_says_what_to_do() {
    let (mut count, public) = (0, public());
    let is_public = |rest: &str| {
        rest.split(|c: char| !c.is_alphanumeric()).next().is_some_and(|name| public.contains(name))
    };
    for (file, text) in support::sources() {
        let traits = text.match_indices("\npub trait ");
        for (at, trait_) in traits.filter(|(at, found)| is_public(&text[at + found.len()..])) {
            let attributes = text[..at].rsplit("\n\n").next().unwrap_or("");
            let is_explained =
                attributes.contains("#[diagnostic::on_unimplemented(") && attributes.contains("note = ");
            assert!(is_explained, "{file}:{trait_} `diagnostic::on_unimplemented` with a note");
            count += 1;
        }
    }
    assert!(count >= 12, "only {count} traits were found");
    // The compiler shows this line where a coordinate has another type.
    let source = read("src/math/point.rs");
    let line = source.lines().find(|line| line.contains("fn new(x: Scalar,")).expect("a constructor");
    assert!(["Scalar::from_int(", "from_ratio(", "from_f32("].iter().all(|way| line.contains(way)), "{line}");
}
