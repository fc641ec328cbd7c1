//! The fuzz targets, in one program for libFuzzer: `FUZZ_TARGET` names the one to run.
#![no_main]

#[path = "targets/mod.rs"]
mod fuzzed;

use libfuzzer_sys::fuzz_target;
use pinhole_import::{import_bytes, Edges, Options, TextureFormat};
use std::collections::HashSet;
use std::path::Path;
use std::sync::LazyLock;

/// A triangle with a picture.
const PAINTED: &[u8] =
    b"mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

fn import(name: &str, bytes: &[u8], beside: &[(String, Vec<u8>)], bits: u8) {
    let options = Options {
        fix_winding: bits & 1 != 0,
        two_sided: bits & 2 != 0,
        reorder: bits & 4 != 0,
        edges: if bits & 8 != 0 { Edges::Feature { degrees: 30.0 } } else { Edges::All },
        edge_faces: bits & 16 != 0,
        vertex_normals: bits & 32 != 0,
        texture: Some(TextureFormat {
            colors: [2, 4, 16, 256][usize::from(bits >> 6)],
            ..Default::default()
        }),
        ..Options::default()
    };
    match import_bytes(bytes.to_vec(), Path::new(name), beside, &options) {
        Ok(mesh) => {
            let report = mesh.report;
            if bits & 63 == 0 {
                // Each face of the file is there, in pieces or whole, or counted as dropped.
                let dropped = report.degenerate + report.duplicate;
                assert_eq!(report.faces_read + report.cut, mesh.faces.len() + dropped);
                // Vertices of faces alone, not of lines: each is another one and used, and stands for one of the file, or for several.
                if name == "m.stl" || !bytes.contains(&b'l') {
                    let merged = report.welded + report.welded_by_quantising;
                    assert_eq!(report.vertices_read, mesh.vertices.len() + merged + report.unused);
                    let used: HashSet<u16> = mesh.faces.iter().flatten().copied().collect();
                    let places: HashSet<[i16; 3]> = mesh.vertices.iter().copied().collect();
                    assert_eq!([used.len(), places.len()], [mesh.vertices.len(); 2]);
                }
            }
            mesh.mesh().expect("a mesh");
            mesh.colors().expect("colours of its faces");
            mesh.texture().expect("texture coordinates of its faces");
            mesh.to_rust("the fuzzer");
            for warning in mesh.warnings {
                assert_eq!(warning.to_string().lines().count(), 1, "{warning}");
            }
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
    }
}

/// Files of all formats that the importer reads: whatever is in them, it answers with a mesh that `pinhole::Mesh` takes or with an
/// error of one line, and its warnings are of one line, too. The first byte chooses the format; zero bytes separate an OBJ file from
/// the material library that it may name.
fn files(data: &[u8]) {
    let [format, bits, rest @ ..] = data else { return };
    let mut parts = rest.splitn(2, |&byte| byte == 0);
    let mut part = || parts.next().unwrap_or_default();
    let file = |name: &str, bytes: &[u8]| (name.to_string(), bytes.to_vec());
    match format % 4 {
        0 => import("m.obj", part(), &[file("m.mtl", part())], *bits),
        1 => import("m.stl", rest, &[], *bits),
        2 => import("m.obj", PAINTED, &[file("m.mtl", rest)], *bits),
        _ => import("m.obj", PAINTED, &[file("m.mtl", b"newmtl a\nmap_Kd p\n"), file("p", rest)], *bits),
    }
}

static TARGET: LazyLock<fn(&[u8])> = LazyLock::new(|| {
    let name = std::env::var("FUZZ_TARGET").expect("FUZZ_TARGET names a target");
    let import: fuzzed::Target = ("import", files);
    let targets = fuzzed::TARGETS.into_iter().chain([import]);
    targets.into_iter().find(|target| target.0 == name).expect("a target").1
});

fuzz_target!(|data: &[u8]| TARGET(data));
