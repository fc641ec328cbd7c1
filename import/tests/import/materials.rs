//! Colours and texture coordinates of OBJ files, from the text to the generated source.

use crate::common::{file, folder, obj_beside, said};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole_import::{import, import_bytes, preview, ImportedMesh, Options};
use std::path::{Path, PathBuf};

/// A tetrahedron of which each face has a texture coordinate of its own per corner: face i, corner k has (i/4, k/8).
const CORNERS: &str = "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\n\
    vt 0 0\nvt 0 .125\nvt 0 .25\nvt .25 0\nvt .25 .125\nvt .25 .25\n\
    vt .5 0\nvt .5 .125\nvt .5 .25\nvt .75 0\nvt .75 .125\nvt .75 .25\n";
const FACES: [&str; 4] = ["f 1/1 3/2 2/3\n", "f 1/4 2/5 4/6\n", "f 2/7 3/8 4/9\n", "f 3/10 1/11 4/12\n"];

/// The tetrahedron, its faces with materials.
fn painted() -> String {
    let [a, b, c, d] = FACES;
    format!("mtllib painted.mtl\n{CORNERS}usemtl sky\n{a}usemtl rust\n{b}g group\n{c}usemtl sky\n{d}")
}

/// The painted tetrahedron, or another model, and its library in a folder of the test's own.
fn painted_file(test: &str, text: &str) -> PathBuf {
    let path = file(test, "painted.obj", text);
    std::fs::write(path.with_file_name("painted.mtl"), LIBRARY).unwrap();
    path
}

const LIBRARY: &str =
    "# by hand\nnewmtl rust\nKa nonsense\nKd .6 .2 0\nKe 1.5 .4 0\nmap_Kd rust.png\nnewmtl sky\nNs 3\nKd 0 .5 1\n";

/// The warning about a picture of the library that nobody asked for.
const UNWANTED: &str = "pictures of materials: 1, the first rust.png; left out: use --texture 16";

/// Of files that are in no folder, as in a browser: by the last part of the name, with the separators of any system.
#[test]
fn a_library_may_be_given_as_bytes() {
    let beside = [("painted.mtl".to_string(), LIBRARY.into())];
    for name in ["painted.mtl", "parts/painted.mtl", r"C:\parts\painted.mtl"] {
        let model = painted().replace("painted.mtl", name).into_bytes();
        let mesh = import_bytes(model.clone(), "no.obj".as_ref(), &beside, &Options::default()).unwrap();
        assert_eq!((mesh.palette.len(), said(&mesh)), (2, vec![UNWANTED.to_string()]), "{name}");
        let others = import_bytes(model, "no.obj".as_ref(), &[], &Options::default()).unwrap();
        assert_eq!(others.palette.len(), 0);
        assert!(said(&others).iter().any(|warning| warning.contains("is not there")), "{:?}", said(&others));
    }
}

/// The vertex of the tetrahedron at a corner, by where it is: 1 at the origin, and 2, 3, 4 on the axes.
fn vertex(mesh: &ImportedMesh, face: usize, corner: usize) -> usize {
    let at = mesh.vertices[usize::from(mesh.faces[face][corner])];
    at.iter().position(|&c| c > 0).map_or(1, |axis| axis + 2)
}

/// A face of the file: its number, its colour, and the vertices of its corners, ascending, with their texture coordinates.
type Face = (usize, [u8; 3], Vec<(usize, [f64; 2])>);

/// For each face of a mesh the file's face of which it is, by its corners, and its texture coordinates by vertex.
fn by_vertex(mesh: &ImportedMesh) -> Vec<Face> {
    let unit = 2f64.powi(i32::from(mesh.texture_exponent));
    let (colors, texture) = (mesh.colors().unwrap().unwrap(), mesh.texture().unwrap().unwrap());
    let of = |face: usize| {
        let mut corners: Vec<_> = (0..3)
            .map(|corner| {
                (vertex(mesh, face, corner), texture.corners(face)[corner].map(|c| f64::from(c) * unit))
            })
            .collect();
        corners.sort_by_key(|(vertex, _)| *vertex);
        let missing = 10 - corners.iter().map(|(vertex, _)| vertex).sum::<usize>();
        let color: Rgb888 = colors.color(face);
        let color = [color.r(), color.g(), color.b()];
        ([4, 3, 1, 2].iter().position(|&m| m == missing).unwrap(), color, corners)
    };
    (0..mesh.faces.len()).map(of).collect()
}

/// What `painted` says of the same, by reading its faces as text.
fn expected(face: usize) -> Face {
    let corner = |(k, word): (usize, &str)| {
        let vertex = word.split('/').next().unwrap().parse().unwrap();
        (vertex, [face as f64 / 4.0, 1.0 - k as f64 / 8.0])
    };
    let mut corners: Vec<_> = FACES[face].split_whitespace().skip(1).enumerate().map(corner).collect();
    corners.sort_by_key(|(vertex, _)| *vertex);
    // 0.6 · 255 = 153, 0.2 · 255 = 51, 0.5 · 255 = 127.5, up.
    (face, [[0, 128, 255], [153, 51, 0], [153, 51, 0], [0, 128, 255]][face], corners)
}

#[test]
fn faces_keep_their_colours_and_coordinates_through_every_option() {
    let path = painted_file("materials", &painted());
    let defaults = Options { centre: pinhole_import::Centre::Origin, ..Options::default() };
    for reorder in [false, true] {
        for flip in [false, true] {
            for (fix_winding, two_sided) in [(false, false), (true, false), (false, true), (true, true)] {
                let options = Options { reorder, flip, fix_winding, two_sided, ..defaults.clone() };
                let mesh = import(&path, &options).unwrap();
                // Flipped and not fixed, the tetrahedron is not sound: it gets backs.
                let backs = if flip && two_sided && !fix_winding { 4 } else { 0 };
                assert_eq!((mesh.faces.len(), mesh.report.backs), (4 + backs, backs));
                for (face, found) in by_vertex(&mesh).into_iter().enumerate() {
                    assert_eq!(found, expected(found.0), "{face} {options:?}");
                }
                assert_eq!(mesh.palette, [[0, 128, 255], [153, 51, 0]], "{options:?}");
            }
        }
    }
    let mesh = import(&path, &defaults).unwrap();
    assert_eq!((said(&mesh), mesh.face_colors), (vec![UNWANTED.to_string()], vec![0, 1, 1, 0]));
    assert_eq!(mesh.emission, [[0; 3], [255, 102, 0]]); // more than full is full
    assert_eq!(mesh.files, [path.with_file_name("painted.mtl")]);
    let bare = painted().replace("mtllib painted.mtl\n", "").replace("usemtl", "#");
    assert_eq!(obj_beside(&bare, &[], &defaults).palette, Vec::<[u8; 3]>::new());
}

/// The colours that a model has by these libraries, and the warnings.
fn painted_by(folder: &Path, libraries: &str, root: Option<&Path>) -> (Vec<[u8; 3]>, Vec<String>) {
    let path = folder.join("model/model.obj");
    std::fs::write(&path, painted().replace("painted.mtl", libraries)).unwrap();
    let mesh = import(&path, &Options { root: root.map(Path::to_owned), ..Options::default() }).unwrap();
    assert_eq!(mesh.faces.len(), 4);
    let said = said(&mesh);
    (mesh.palette, said)
}

/// No reference leads out of the model's folder, or to what could wait for ever.
#[cfg(unix)]
#[test]
fn libraries_elsewhere_are_skipped() {
    use std::os::unix::fs::symlink;
    let folder = folder("elsewhere");
    let model = folder.join("model");
    std::fs::create_dir_all(model.join("Deep")).unwrap();
    std::fs::write(model.join("my sky.mtl"), "newmtl sky\nKd 0 0 1\n").unwrap();
    std::fs::create_dir(folder.join("outside")).unwrap();
    std::fs::write(folder.join("outside/far.mtl"), "newmtl sky\nKd 0 0 1\nnewmtl rust\nKd 1 0 0\n").unwrap();
    symlink(folder.join("outside/far.mtl"), model.join("link.mtl")).unwrap();
    symlink(folder.join("outside"), model.join("folder")).unwrap();
    symlink("/dev/zero", model.join("zeros.mtl")).unwrap();
    std::fs::File::create(model.join("huge.mtl")).unwrap().set_len((1 << 30) + 1).unwrap(); // takes no room
    let pipe = model.join("pipe.mtl");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let absolute = folder.join("outside/far.mtl");
    let absolute = absolute.to_str().unwrap();
    for (libraries, problem) in [
        ("../outside/far.mtl", "lies outside the model's folder"),
        ("Deep/../../outside/far.mtl", "lies outside the model's folder"),
        (absolute, "lies outside the model's folder"),
        ("link.mtl", "lies outside the model's folder"),
        ("folder/far.mtl", "lies outside the model's folder"),
        ("zeros.mtl", "lies outside the model's folder"),
        (
            "/proc/kmsg",
            if cfg!(target_os = "linux") { "lies outside the model's folder" } else { "is not there" },
        ),
        ("pipe.mtl", "is no regular file"),
        ("Deep", "is no regular file"),
        ("huge.mtl", "has more than 1 GiB"),
    ] {
        let (found, said) = painted_by(&folder, libraries, None);
        assert_eq!(found, Vec::<[u8; 3]>::new(), "{libraries}");
        let root = if problem.starts_with("lies") { ", or use --root FOLDER" } else { "" };
        assert_eq!(
            said,
            [format!(
                "material library {libraries}: {problem}; its materials are grey: put it beside the model{root}"
            )]
        );
    }
    let outside = folder.join("outside");
    for libraries in ["../outside/far.mtl", absolute, "link.mtl", "folder/far.mtl"] {
        assert_eq!(
            painted_by(&folder, libraries, Some(&outside)),
            (vec![[0, 0, 255], [255, 0, 0]], vec![]),
            "{libraries}"
        );
    }
    // Files of the system that have no length are not waited for.
    #[cfg(target_os = "linux")]
    assert_eq!(painted_by(&folder, "/proc/kmsg", Some(Path::new("/"))).0, Vec::<[u8; 3]>::new());
    assert_eq!(painted_by(&folder, "zeros.mtl", Some(Path::new("/"))).1.len(), 1);
    // A folder of links, as some build systems make them: the folder is as the model names it.
    std::fs::create_dir(folder.join("links")).unwrap();
    symlink(&model, folder.join("links/model")).unwrap();
    assert_eq!(painted_by(&folder.join("links"), "my sky.mtl", None).0[0], [0, 0, 255]);
}

#[test]
fn more_than_256_colours_become_the_256_most_used() {
    let mut library = String::new();
    let mut text = String::from("mtllib many.mtl\n");
    for i in 0..300 {
        library += &format!("newmtl m{i}\nKd {} {} 0\n", f64::from(i % 20) / 20.0, f64::from(i / 20) / 20.0);
        text += &format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\nusemtl m{i}\nf -3 -2 -1\n");
        // All but the first 44 a second time.
        text +=
            &if i < 44 { String::new() } else { format!("v {i} 3 0\nv {i} 4 0\nv {i} 3 1\nf -3 -2 -1\n") };
    }
    let mesh = obj_beside(&text, &[("many.mtl", &library)], &Options::default());
    let doubt = "colours: 300, of which a palette holds 256; the others become the nearest of these";
    assert!(said(&mesh).contains(&doubt.into()), "{:?}", said(&mesh));
    assert_eq!(mesh.palette.len(), 256);
    let exact = |i: i32| {
        [f64::from(i % 20) / 20.0, f64::from(i / 20) / 20.0, 0.0].map(|c| (c * 255.0).round() as i32)
    };
    let mut face = 0;
    for i in 0..300 {
        let found = mesh.palette[usize::from(mesh.face_colors[face])].map(i32::from);
        let distance = |a: [i32; 3], b: [i32; 3]| (0..3).map(|k| (a[k] - b[k]).pow(2)).sum::<i32>();
        let nearest = (44..300).map(|other| distance(exact(i), exact(other))).min().unwrap();
        assert_eq!(distance(found, exact(i)), nearest, "{i}");
        face += if i < 44 { 1 } else { 2 };
    }
}

#[test]
fn a_preview_has_the_colours_of_its_triangles() {
    let path = painted_file("materials-preview", &painted().replace(FACES[3], "")); // open
    let shown = preview(&path, &Options { two_sided: true, ..Options::default() }).unwrap();
    let [sky, rust] = [[0, 128, 255], [153, 51, 0]];
    assert_eq!(shown.colors, [sky, rust, rust, sky, rust, rust]);
    let [dark, glowing] = [[0; 3], [255, 102, 0]];
    assert_eq!(shown.emission, [dark, glowing, glowing, dark, glowing, glowing]);
    assert_eq!(shown.files, [path.with_file_name("painted.mtl")]);
}
