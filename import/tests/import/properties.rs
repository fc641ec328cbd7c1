//! What must hold for any file at all.

use pinhole_import::{quantise, read_obj, read_stl, ImportError, ImportedMesh, Triangles};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::collections::HashSet;
use std::path::Path;

/// A mesh that was made is one; what was refused is said in one line.
fn check(made: Result<ImportedMesh, ImportError>) {
    match made {
        Ok(mesh) => {
            let report = mesh.report;
            assert!(!mesh.faces.is_empty());
            assert_eq!(
                report.faces_read + report.cut,
                mesh.faces.len() + report.degenerate + report.duplicate
            );
            assert_eq!(
                report.vertices_read,
                mesh.vertices.len() + report.welded + report.welded_by_quantising + report.unused
            );
            let used: HashSet<u16> = mesh.faces.iter().flatten().copied().collect();
            assert!(used.len() == mesh.vertices.len() && used.iter().all(|&v| usize::from(v) < used.len()));
            assert_eq!(mesh.vertices.iter().collect::<HashSet<_>>().len(), mesh.vertices.len());
            assert!(mesh.warnings.iter().all(|w| w.to_string().lines().count() == 1));
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
    }
}

/// The words of a file, mostly sound, in any order.
fn words(known: &'static [&'static str]) -> impl Strategy<Value = String> {
    let word = prop_oneof![
        8 => prop::sample::select(known).prop_map(str::to_string),
        4 => (-9i32..10).prop_map(|i| format!(" {i}")),
        1 => any::<f64>().prop_map(|f| format!(" {f:e}")),
        1 => "\\PC{0,3}",
    ];
    vec(word, 0..120).prop_map(|words| words.concat())
}

const OBJ: &[&str] = &[
    "\nv 1 0 0",
    "\nv 0 1 0",
    "\nv 0 0 1",
    "\nv 1 1 1 1",
    "\nv",
    "\nf",
    "\nf 1 2 3",
    " \\\n",
    "/",
    "//",
    "#",
    "\r\n",
];
const STL: &[&str] = &[
    "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet",
    "\nfacet normal 0 0 1\nouter loop",
    "\nvertex 0 0 0",
    "\nvertex",
    "\nendloop\nendfacet",
    "\nendsolid a",
    "\nsolid b",
    "\n",
];

/// Fixed cases in every run, unless `PROPTEST_RNG_SEED` or `PROPTEST_CASES` is set.
fn cases() -> ProptestConfig {
    let mut config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = 2000;
    }
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(0x9119);
    }
    config
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn any_bytes_are_a_mesh_or_refused(bytes in vec(any::<u8>(), 0..600)) {
        check(read_obj(&bytes, Path::new("a.obj")));
        check(read_stl(&bytes, Path::new("a.stl")));
    }

    #[test]
    fn any_words_of_obj_are_a_mesh_or_refused(text in words(OBJ)) {
        check(read_obj(text.as_bytes(), Path::new("a.obj")));
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n{text}");
        check(read_obj(text.as_bytes(), Path::new("a.obj")));
    }

    #[test]
    fn any_words_of_stl_are_a_mesh_or_refused(text in words(STL)) {
        check(read_stl(format!("solid a{text}").as_bytes(), Path::new("a.stl")));
    }

    #[test]
    fn any_binary_stl_is_a_mesh_or_refused(
        faces in vec(vec(prop_oneof![9 => (-2i8..3).prop_map(f32::from), 1 => any::<f32>()], 12), 0..12),
        more in -3i32..4,
        header in "[solid ]{0,80}",
    ) {
        let mut bytes = header.into_bytes();
        bytes.resize(80, 0);
        bytes.extend((faces.len() as u32).wrapping_add_signed(more / 3).to_le_bytes());
        for face in faces {
            bytes.extend(face.iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes.resize(bytes.len().saturating_add_signed(more as isize), 0);
        check(read_stl(&bytes, Path::new("a.stl")));
    }

    /// Against `f64`: each position is where a vertex is, within the error that is reported, and that is within bounds.
    #[test]
    fn positions_stay_where_they_are(
        positions in vec([-1e6..1e6, -1e6..1e6, -1e6..1e6], 3..40),
        scale in -30i32..30,
    ) {
        let positions: Vec<[f64; 3]> =
            positions.iter().map(|p: &[f64; 3]| p.map(|c| c * 2f64.powi(scale))).collect();
        let faces: Vec<[usize; 3]> = (2..positions.len()).map(|i| [i - 2, i - 1, i]).collect();
        // Positions at random are hardly ever on a line.
        let mesh = quantise(&Triangles { positions: positions.clone(), faces }).expect("faces");
        let step = 2f64.powi(i32::from(mesh.exponent));
        let mut worst = 0.0_f64;
        for p in &positions {
            let distance = |v: &[i16; 3]| {
                let at = |i: usize| f64::from(v[i]) * step + mesh.offset[i];
                (0..3).map(|i| (p[i] - at(i)).abs()).fold(0.0, f64::max)
            };
            worst = worst.max(mesh.vertices.iter().map(distance).fold(f64::INFINITY, f64::min));
        }
        // A face that rounding made a line may have taken a vertex with it.
        if mesh.report.unused == 0 {
            prop_assert!((worst - mesh.report.error).abs() <= 1e-9 * step + 1e-12 * mesh.report.extent);
        }
        prop_assert!(mesh.report.error <= mesh.report.extent / 65000.0);
    }
}
