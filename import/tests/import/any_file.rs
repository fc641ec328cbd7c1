//! What holds for any file at all: a mesh is complete, and a refusal is one line. `fuzz/targets/import` gives stranger files.

use crate::common::Random;
use pinhole_import::{quantise, read_obj, read_stl, ImportError, ImportedMesh, Triangles};
use std::collections::HashSet;

/// Counts a mesh that was made. Its counts add up, and each of its vertices is another one and is used.
fn check(made: Result<ImportedMesh, ImportError>) -> u32 {
    let mesh = match made {
        Ok(mesh) => mesh,
        Err(error) => {
            assert_eq!(error.to_string().lines().count(), 1, "{error}");
            return 0;
        }
    };
    let report = mesh.report;
    assert!(!mesh.faces.is_empty());
    assert_eq!(report.faces_read + report.cut, mesh.faces.len() + report.degenerate + report.duplicate);
    let merged = report.welded + report.welded_by_quantising;
    assert_eq!(report.vertices_read, mesh.vertices.len() + merged + report.unused);
    let used: HashSet<u16> = mesh.faces.iter().flatten().copied().collect();
    assert!(used.len() == mesh.vertices.len() && used.iter().all(|&v| usize::from(v) < used.len()));
    assert_eq!(mesh.vertices.iter().collect::<HashSet<_>>().len(), mesh.vertices.len());
    assert!(mesh.warnings.iter().all(|warning| warning.to_string().lines().count() == 1));
    1
}

/// Words of a file in any order, and numbers.
fn words(random: &mut Random, known: &[&str]) -> String {
    let most = [8, 120][random.below(2)];
    (0..random.below(most))
        .map(|_| match random.below(13) {
            0..8 => known[random.below(known.len())].into(),
            8..12 => format!(" {}", random.below(19) as i32 - 9),
            _ => format!(" {:e}", (random.unit() - 0.5) * 10f64.powi(random.below(600) as i32 - 300)),
        })
        .collect()
}

#[test]
fn any_words_are_a_mesh_or_refused() {
    let obj = [
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
        "\0",
    ];
    let triangle =
        "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet";
    let stl = [
        triangle,
        "\nouter loop",
        "\nvertex 0 0 0",
        "\nvertex",
        "\nendloop\nendfacet",
        "\nendsolid a",
        "\nsolid b",
        "\n",
    ];
    let (random, mut made) = (&mut Random(0x9119), 0);
    for _ in 0..2000 {
        let text = words(random, &obj);
        check(read_obj(text.as_bytes(), "a.obj".as_ref()));
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n{text}");
        made += check(read_obj(text.as_bytes(), "a.obj".as_ref()));
        made += check(read_stl(format!("solid a{}", words(random, &stl)).as_bytes(), "a.stl".as_ref()));
    }
    assert!((500..3500).contains(&made), "{made}");
}

#[test]
fn any_binary_stl_is_a_mesh_or_refused() {
    let (random, mut made) = (&mut Random(0x9120), 0);
    for _ in 0..2000 {
        let count = random.below(12);
        let mut bytes = vec![b' '; 80];
        bytes.extend((count as u32 + random.below(9) as u32 / 8).to_le_bytes());
        for _ in 0..count {
            let mut number = || match random.below(300) {
                0 => f32::from_bits((random.unit() * 2f64.powi(32)) as u32),
                _ => random.below(5) as f32 - 2.0,
            };
            bytes.extend((0..12).flat_map(|_| number().to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes.resize(bytes.len() + random.below(9) / 7, 0);
        made += check(read_stl(&bytes, "a.stl".as_ref()));
    }
    assert!((500..1900).contains(&made), "{made}");
}

/// Against f64: each position is where a vertex is, within the error that is reported.
#[test]
fn positions_stay_where_they_are() {
    let random = &mut Random(0x9121);
    for _ in 0..1000 {
        let scale = 1e6 * 2f64.powi(random.below(60) as i32 - 30);
        let count = 3 + random.below(37);
        let positions: Vec<_> =
            (0..count).map(|_| [(); 3].map(|()| (2.0 * random.unit() - 1.0) * scale)).collect();
        let faces = (2..count).map(|i| [i - 2, i - 1, i]).collect();
        let mesh = quantise(&Triangles { positions: positions.clone(), faces }).expect("faces");
        let step = 2f64.powi(i32::from(mesh.exponent));
        let distance = |p: &[f64; 3], v: &[i16; 3]| {
            (0..3).map(|i| (p[i] - f64::from(v[i]) * step - mesh.offset[i]).abs()).fold(0.0, f64::max)
        };
        let nearest = |p| mesh.vertices.iter().map(|v| distance(p, v)).fold(f64::INFINITY, f64::min);
        let worst = positions.iter().map(nearest).fold(0.0, f64::max);
        // A face that rounding made a line may have taken a vertex with it.
        if mesh.report.unused == 0 {
            assert!((worst - mesh.report.error).abs() <= 1e-9 * step + 1e-12 * mesh.report.extent);
        }
        assert!(mesh.report.error <= mesh.report.extent / 65000.0);
    }
}
