//! OBJ files as they come, sound and broken. `fuzz/main.rs` has stranger ones.

use pinhole_apps_support::bodies::{cuboid, stl};
use pinhole_import::{
    quantise, read, read_obj, read_stl, ImportError, ImportedMesh, Problem, Remedy, Triangles,
};
use std::path::Path;
use support::oracle::rng::Rng;

fn import(text: &str) -> Result<ImportedMesh, ImportError> {
    read_obj(text.as_bytes(), Path::new("model.obj"))
}

/// The line that a warning tells a program, of those that have one.
#[test]
fn warnings_have_lines() {
    for (text, line) in [
        ("f 1 2 3\nf 1 2 2\n", 5),
        ("f 1 2 3\nf 1 2 3\n", 5),
        ("f 1 2 3\nf 1 3 2\nvt x\n", 6),
        ("f 1 2 3\nf 1 3 2\np 1\n", 6),
        ("\nf 1 2 3\n", 5),
    ] {
        let mesh = import(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{text}")).unwrap();
        assert_eq!(mesh.warnings[0].line(), Some(line), "{text}");
    }
    assert_eq!(import("f 1\nv 0 x 0\n").unwrap_err().line, Some(2));
    // Of a text without its end the last line, and of a binary file none.
    let facet = "facet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let binary = stl(&cuboid([1.0; 3])[..11]);
    for (bytes, line) in [(format!("solid\n{facet}").as_bytes(), Some(8)), (&binary, None)] {
        assert_eq!(read_stl(bytes, Path::new("model.stl")).unwrap().warnings[0].line(), line);
    }
}

/// The largest distance along an axis from a position to its vertex, by search.
fn measured_error(model: &Triangles, mesh: &ImportedMesh) -> f64 {
    let step = 2f64.powi(i32::from(mesh.exponent));
    let distance = |p: &[f64; 3], v: &[i16; 3]| {
        (0..3).map(|i| (p[i] - (f64::from(v[i]) * step + mesh.offset[i])).abs()).fold(0.0, f64::max)
    };
    let nearest = |p| mesh.vertices.iter().map(|v| distance(p, v)).fold(f64::INFINITY, f64::min);
    model.positions.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn quantisation_is_within_a_65000th_of_the_largest_extent() {
    let mut random = Rng::new(2);
    let mut worst = 0.0_f64;
    for round in 0..2000 {
        // Extents around the places where the exponent changes (where the error is largest), and anywhere; centres near
        // and far; tiny models, whose centre is not rounded.
        let half = match round % 4 {
            0 => 32767.5 * (1.0 - 1e-9),
            1 => 32767.5 * (1.0 + 1e-9),
            2 => 32767.5 * (1.0 + 1e-3 * (random.unit() - 0.5)),
            _ => 16384.0 * (1.0 + random.unit()),
        } * 2f64.powi((random.unit() * 40.0) as i32 - 35);
        let centre = [0; 3].map(|_| (random.unit() - 0.5) * half * 8.0);
        let mut model = Triangles::default();
        for corner in 0..60 {
            let mut p = [0; 3].map(|_| (random.unit() * 2.0 - 1.0) * half);
            if corner < 2 {
                p[round % 3] = if corner == 0 { half } else { -half };
            }
            model.positions.push([0, 1, 2].map(|i| centre[i] + p[i]));
        }
        model.faces = (0..58).map(|i| [i, i + 1, i + 2]).collect();
        let mesh = quantise(&model).unwrap();
        assert_eq!(mesh.report.welded, 0);
        let error = measured_error(&model, &mesh) / mesh.report.extent;
        assert!(error <= 1.0 / 65000.0, "round {round}: 1/{}", 1.0 / error);
        let reported = mesh.report.error / mesh.report.extent;
        assert!((reported - error).abs() < 1e-9, "{reported} {error}");
        assert!(mesh.vertices.iter().flatten().all(|c| c.unsigned_abs() <= 32767));
        for normal in &mesh.normals {
            let length = normal.map(f64::from).iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((length - 32767.0).abs() <= 0.5 * 3f64.sqrt(), "{normal:?}");
        }
        worst = worst.max(error);
    }
    // The bound is no idle one.
    assert!(worst > 1.0 / 66000.0, "1/{}", 1.0 / worst);
}

#[test]
fn a_mesh_has_at_most_65536_vertices() {
    // A strip of triangles with one vertex after the other.
    let strip = |count: usize| Triangles {
        positions: (0..count).map(|i| [(i / 2 % 256) as f64, (i % 2) as f64, (i / 512) as f64]).collect(),
        faces: (0..count - 2).map(|i| [i, i + 1, i + 2]).collect(),
    };
    let full = quantise(&strip(1 << 16)).unwrap();
    assert_eq!(full.vertices.len(), 1 << 16);
    assert!(full.mesh().is_ok());
    let problem = quantise(&strip((1 << 16) + 1)).unwrap_err();
    assert!(matches!(problem, Problem::TooManyVertices(65537)), "{problem:?}");
    assert_eq!(
        problem.to_string(),
        format!(
            "has 65537 vertices, more than the 65536 of a mesh: {}, or split the model",
            Remedy::Decimate(0)
        )
    );
}

#[test]
fn extents_beyond_an_exponent_are_an_error() {
    let triangle = |size: f64| {
        quantise(&Triangles {
            positions: vec![[0.0; 3], [size, 0.0, 0.0], [0.0, -size, 0.0]],
            faces: vec![[0, 1, 2]],
        })
    };
    assert_eq!(triangle(1e-30).unwrap().vertices.len(), 3);
    for size in [1e-40, 1e60, f64::MAX] {
        assert!(matches!(triangle(size), Err(Problem::Extent(_))), "{size}");
    }
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let missing = read(Path::new("no/such/model.obj")).unwrap_err();
    assert_eq!(format!("{missing:?}"), missing.to_string()); // what `main` of a build.rs prints
    assert!(matches!(missing.problem, Problem::Read(_)));
    let message = missing.to_string();
    assert!(message.starts_with("no/such/model.obj: cannot be read: "), "{message}");
    assert_eq!(message.lines().count(), 1);

    let unknown = read(Path::new("model.blend")).unwrap_err();
    assert_eq!(unknown.to_string(), "model.blend: is not a model this program reads: export .obj or .stl");
}

#[test]
fn indices_out_of_range_are_an_error_from_any_reader() {
    let model = Triangles { positions: vec![[0.0; 3]; 3], faces: vec![[0, 1, 3]] };
    assert!(matches!(quantise(&model), Err(Problem::NoSuchVertex)));
}

/// The texture lies on a concave polygon as on a fan: all coordinates are the position over 2.
#[test]
fn concave_polygons_have_their_texture() {
    let l = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
    let mapped = "vt 0 0\nvt 1 0\nvt 1 .5\nvt .5 .5\nvt .5 1\nvt 0 1\nf 2/2 3/3 4/4 5/5 6/6 1/1\n";
    let mesh = import(&format!("{l}{mapped}")).unwrap();
    for (face, coords) in mesh.faces.iter().zip(&mesh.texture_faces) {
        for (&vertex, &coord) in face.iter().zip(coords) {
            let [x, y, _] = mesh.vertices[usize::from(vertex)]
                .map(|c| f64::from(c) * 2f64.powi(i32::from(mesh.exponent)) / 2.0 + 0.5);
            let [u, v] = mesh.texture_coords[usize::from(coord)]
                .map(|c| f64::from(c) * 2f64.powi(i32::from(mesh.texture_exponent)));
            assert_eq!([u, 1.0 - v], [x, y]);
        }
    }
}

#[test]
fn files_beyond_a_gibibyte_are_not_even_read() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("huge.obj");
    // Sparse: it takes no room.
    std::fs::File::create(&path).unwrap().set_len((1 << 30) + 1).unwrap();
    let error = read(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert!(matches!(error.problem, Problem::TooLarge), "{error}");
    assert!(error.to_string().contains("has more than 1 GiB"), "{error}");
}
