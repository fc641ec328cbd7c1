//! Files that `pinhole-render` writes for other programs, and its messages for bad input.

use pinhole_apps_support::testing::{refusal, Program};
use serde_json::{json, Value};
use std::fs;
use std::path::{Path, PathBuf};

const RENDER: Program =
    Program::new(env!("CARGO_BIN_EXE_pinhole-measure"), env!("CARGO_TARGET_TMPDIR")).subcommand("render");

/// A triangle in front of a triangle, in a picture of 8 × 6.
fn scene() -> Value {
    let identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
    json!({
        "vertices": [[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0.5], [0, -1, 0.5], [-1, 0, 0.5]],
        "triangles": [[0, 1, 2], [3, 4, 5]],
        "model": identity,
        "view": identity,
        // z = −1 is near −1: depth grows with −z.
        "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]],
        "width": 8, "height": 6
    })
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn ids_and_depths_are_rows_of_little_endian_numbers() {
    let to = RENDER.folder("render", "formats");
    let file = write(&to, "scene.json", scene().to_string());
    let (ids, depth) = (to.join("ids"), to.join("depth"));
    let done = RENDER.run(&[text(&file), "--ids", text(&ids), "--depth", text(&depth)]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    // Pixel (i, j) has x = (i + ½)/4 − 1 and y = 1 − (j + ½)/3. Triangle 0 is x + y < 0 (its slanted edge
    // passes no centre: (2i + 1)/8 = (2j + 1)/6 has no solution below), triangle 1 is x + y < −1.
    let expected: Vec<i32> = (0..6)
        .flat_map(|j| (0..8).map(move |i| (3 * (2 * i + 1), 4 * (2 * j + 1)))) // (x + 1)·24, (1 − y)·24
        .map(|(x, y)| match x - y {
            sum if sum < -24 => 1,
            sum if sum < 0 => 0,
            _ => -1,
        })
        .collect();
    let bytes = fs::read(&ids).unwrap();
    let found: Vec<_> = bytes.chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(found, expected);
    // z/w is 0 and −½: 65535·½ and 65535·¼, rounded.
    let steps = expected.iter().map(|id| [65_535, 32_768, 16_384][(id + 1) as usize]);
    let bytes = fs::read(&depth).unwrap();
    let found: Vec<_> = bytes.chunks(2).map(|b| u16::from_le_bytes(b.try_into().unwrap())).collect();
    assert!(found.iter().zip(steps).all(|(a, b): (_, u16)| a.abs_diff(b) <= 1), "{found:?}");
}

#[test]
fn without_an_output_it_says_what_it_would_draw() {
    let to = RENDER.folder("render", "silent");
    let file = write(&to, "scene.json", scene().to_string());
    let done = RENDER.run(&[text(&file)]);
    let said = String::from_utf8(done.stdout).unwrap();
    assert!(
        done.status.success() && said.contains("8 x 6 pixels") && said.contains("nothing was written"),
        "{said}"
    );
    assert!(said.contains("of 2 triangles 2 drawn"), "{said}");
    assert_eq!(fs::read_dir(&to).unwrap().count(), 1);
    let said = String::from_utf8(RENDER.run(&[text(&file), "--stats"]).stdout).unwrap();
    assert!(said.contains(" px") && said.contains("nothing was written: give --png"), "{said}");
}

#[test]
fn meshes_of_every_format_are_the_same_scene() {
    let to = RENDER.folder("render", "meshes");
    let mut given = scene();
    let vertices = given["vertices"].take();
    let triangles = given["triangles"].take();
    let number = |v: &Value| v.as_f64().unwrap();
    let mut obj = String::new();
    for v in vertices.as_array().unwrap() {
        obj += &format!("v {} {} {}\n", number(&v[0]), number(&v[1]), number(&v[2]));
    }
    let mut stl = String::from("solid s\n");
    for t in triangles.as_array().unwrap() {
        obj += "f";
        stl += "facet normal 0 0 1\nouter loop\n";
        for k in 0..3 {
            let index = t[k].as_u64().unwrap() as usize;
            obj += &format!(" {}", index + 1);
            let v = &vertices[index];
            stl += &format!("vertex {} {} {}\n", number(&v[0]), number(&v[1]), number(&v[2]));
        }
        obj += "\n";
        stl += "endloop\nendfacet\n";
    }
    stl += "endsolid s\n";
    let list = json!({"vertices": vertices, "triangles": triangles}).to_string();
    fs::create_dir(to.join("below")).unwrap();
    let mut pictures = Vec::new();
    for (name, content) in [("m.obj", obj), ("m.stl", stl), ("m.json", list)] {
        write(&to, name, content);
        // The path counts from the scene's own folder.
        let mut with_mesh = scene();
        let fields = with_mesh.as_object_mut().unwrap();
        fields.retain(|field, _| field != "vertices" && field != "triangles");
        fields.insert("mesh".into(), format!("../{name}").into());
        let file = write(&to, "below/scene.json", with_mesh.to_string());
        let ids = to.join("ids");
        let done = RENDER.run(&[text(&file), "--ids", text(&ids)]);
        assert!(done.status.success(), "{name}: {done:?}");
        pictures.push(fs::read(&ids).unwrap());
    }
    let file = write(&to, "scene.json", scene().to_string());
    let ids = to.join("own");
    assert!(RENDER.run(&[text(&file), "--ids", text(&ids)]).status.success());
    let own = fs::read(&ids).unwrap();
    assert!(pictures.iter().all(|p| *p == own));
}

#[test]
fn a_mesh_alone_is_shown_whole_by_every_projection() {
    let to = RENDER.folder("render", "alone");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/teapot.obj");
    let mut shown = Vec::new();
    for (name, more) in [
        ("perspective", &["--yaw", "-120", "--pitch", "35", "--fov", "90"][..]),
        ("orthographic", &["--yaw", "200"]),
        ("isometric", &[]),
        ("cavalier", &[]),
        ("cabinet", &["--mode", "solid"]),
    ] {
        let ids = to.join("ids");
        let flags = [
            text(&mesh),
            "--projection",
            name,
            "--size",
            "90x120",
            "--frame",
            "outline",
            "--ids",
            text(&ids),
        ];
        let done = RENDER.run(&[&flags, more].concat());
        assert!(done.status.success(), "{done:?}");
        let bytes = fs::read(&ids).unwrap();
        let seen: Vec<_> = bytes.chunks(4).map(|b| b != [255; 4]).collect();
        assert_eq!(seen.len(), 90 * 120);
        // It touches no border, and fills the width or the height but for a twelfth on each side.
        let at = |x: usize, y: usize| seen[y * 90 + x];
        let columns: Vec<_> = (0..90).filter(|&x| (0..120).any(|y| at(x, y))).collect();
        let rows: Vec<_> = (0..120).filter(|&y| (0..90).any(|x| at(x, y))).collect();
        let (left, right) = (columns[0], 89 - columns[columns.len() - 1]);
        let (top, bottom) = (rows[0], 119 - rows[rows.len() - 1]);
        assert!([left, right, top, bottom].iter().all(|&free| free > 0), "{name}");
        assert!(left.min(right) <= 8 || top.min(bottom) <= 10, "{name}: {left} {right} {top} {bottom}");
        shown.push(bytes);
    }
    shown.sort();
    shown.dedup();
    assert_eq!(shown.len(), 5);
}

#[test]
fn a_mesh_of_more_vertices_than_16_bits_name_has_no_seams() {
    // A grid of 400 × 400 squares, two triangles each, over the whole picture.
    let to = RENDER.folder("render", "large");
    let n = 400;
    let vertices: Vec<_> =
        (0..=n).flat_map(|j| (0..=n).map(move |i| [i as f64 * 0.0031, j as f64 * 0.0031, 0.0])).collect();
    let triangles: Vec<_> = (0..n)
        .flat_map(|j| (0..n).map(move |i| j * (n + 1) + i))
        .flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]])
        .collect();
    let mut large = scene();
    large["vertices"] = json!(vertices);
    large["triangles"] = json!(triangles);
    large["view"] = json!([[0.8, -0.6, 0, 0], [0.6, 0.8, 0, -0.9], [0, 0, 1, 0], [0, 0, 0, 1]]);
    (large["width"], large["height"]) = (json!(150), json!(150));
    let file = write(&to, "scene.json", large.to_string());
    let ids = to.join("ids");
    let done = RENDER.run(&[text(&file), "--ids", text(&ids)]);
    assert!(done.status.success(), "{done:?}");
    let bytes = fs::read(&ids).unwrap();
    let seen: Vec<_> = bytes.chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect();
    assert!(seen.iter().max().unwrap() > &300_000, "the last parts are there, too");
    // Each row is seen in one piece.
    for row in seen.chunks(150) {
        let changes = row.windows(2).filter(|w| (w[0] == -1) != (w[1] == -1)).count();
        assert!(changes <= 2, "{row:?}");
    }
}

/// In scenes and in meshes alike.
#[test]
fn name_source_and_licence_are_ignored() {
    let to = RENDER.folder("render", "about");
    let about = |mut value: Value| {
        for field in ["name", "source", "licence"] {
            value[field] = json!(format!("any \"{field}\""));
        }
        value
    };
    let ids = |scene: Value| {
        let (file, ids) = (write(&to, "scene.json", scene.to_string()), to.join("ids"));
        let done = RENDER.run(&[text(&file), "--ids", text(&ids)]);
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        fs::read(&ids).unwrap()
    };
    let plain = ids(scene());
    assert!(ids(about(scene())) == plain);
    // With the lists of the mesh in a file of their own.
    let mut named = about(scene());
    let fields = named.as_object_mut().unwrap();
    let lists = ["vertices", "triangles"].map(|field| fields.remove(field).unwrap());
    fields.insert("mesh".into(), json!("m.json"));
    let [vertices, triangles] = lists;
    write(&to, "m.json", about(json!({"vertices": vertices, "triangles": triangles})).to_string());
    assert!(ids(named) == plain);
}

#[test]
fn bad_scenes_are_one_line_that_names_file_and_field() {
    let to = RENDER.folder("render", "bad");
    let out = to.join("out");
    let refuse = |name: &str, content: &str, named: &str| {
        let file = write(&to, name, content);
        write(&to, "out", "as it was");
        let said = refusal(&RENDER.run(&[text(&file), "--ids", text(&out), "--png", text(&to.join("new"))]));
        assert!(said.contains(text(&file)) && said.contains(named), "{named:?} is not in {said:?}");
        assert_eq!(fs::read(&out).unwrap(), b"as it was");
        let left: Vec<_> = fs::read_dir(&to).unwrap().map(|f| f.unwrap().file_name()).collect();
        assert!(left.iter().all(|f| f == name || f == "out"), "{left:?}");
        fs::remove_file(&file).unwrap();
    };
    let change = |field: &str, value: Value, named: &str| {
        let mut changed = scene();
        changed[field] = value;
        refuse("scene.json", &changed.to_string(), named);
    };
    for field in ["vertices", "triangles", "model", "view", "projection", "width", "height"] {
        let mut changed = scene();
        changed.as_object_mut().unwrap().remove(field);
        if field != "model" {
            refuse("scene.json", &changed.to_string(), &format!("{field}: is missing"));
        }
        change(field, Value::Null, &format!("{field}: is null"));
        change(field, json!("8"), &format!("{field}: is a text"));
    }
    for bad in [json!(0), json!(4097), json!(-3), json!(2.5), json!(1e300)] {
        change("width", bad.clone(), "width: ");
        change("height", bad, "height: ");
    }
    change("vertices", json!([[0, 0, 0], [1, 0]]), "vertices[1]: has 2 entries and needs 3");
    change("vertices", json!([[0, 0, 0], [1, "a", 0]]), "vertices[1][1]: is a text");
    change("triangles", json!([[0, 1, 2], [0, 1, 6]]), "triangles[1][2]: 6 is not from 0 to 5");
    change("triangles", json!([[0, 1, -1]]), "triangles[0][2]: -1 is not");
    change("triangles", json!([[0, 1, 1.5]]), "triangles[0][2]: 1.5 is not a whole number");
    change("triangles", json!([[0, 1, 2, 3]]), "triangles[0]: has 4 entries and needs 3");
    change("triangles", json!([]), "triangles: has no faces");
    change("colors", json!([[1, 2, 3]]), "colors: has 1 colours, but there are 2 triangles");
    change("colors", json!([[1, 2, 3], [4, 5, 256]]), "colors[1][2]");
    change("emission", json!([[1, 2, 3]]), "emission: has 1 colours, but there are 2 triangles");
    change("vertices", json!([]), "triangles[0][0]: names a vertex, and there are none");
    for field in ["model", "view", "projection"] {
        change(field, json!([[1, 0, 0, 0], [0, 1, 0, 0]]), &format!("{field}: has 2 entries and needs 4"));
        change(
            field,
            json!([[1, 0, 0, 0], [0, 1, 0], [0, 0, 0, 0], [0, 0, 0, 0]]),
            &format!("{field}[1]: has 3 entries"),
        );
    }
    change("model", json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]), "model: the last row");
    change(
        "view",
        json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]),
        "view: the viewing matrix is not rigid",
    );
    change("view", json!([[1.00001, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]), "view: ");
    change("view", json!([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]), "view: ");
    change("projection", json!([[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]), "projection: ");
    change("viewport", json!([0, 0, 8]), "viewport: has 3 entries and needs 4");
    change("viewport", json!([0, 0, 0, 6]), "viewport: the viewport has no pixels");
    change("viewport", json!([0, 0, -1, 6]), "viewport: -1 is not a width or height");
    change("viewport", json!([8000, 0, 400, 6]), "viewport: the viewport extends beyond ±8192 pixels");
    change("viewport", json!([0.5, 0, 8, 6]), "viewport[0]: 0.5 is not a whole number");
    change("cull", json!("front"), "cull: is \"front\"");
    change("cull", json!(1), "cull: is a number");
    change("name", json!(1), "name: is a number and should be a text");
    change("source", json!(null), "source: is null and should be a text");
    change("licence", json!([]), "licence: is an array and should be a text");
    change("license", json!("MIT"), "license: is not a field");
    change("colour", json!(1), "colour: is not a field");
    let mut unnamed = scene();
    unnamed.as_object_mut().unwrap().retain(|field, _| field != "vertices" && field != "triangles");
    unnamed["mesh"] = json!("");
    refuse("scene.json", &unnamed.to_string(), "mesh: is empty and should name a file");
    change("mesh", json!("m.obj"), "mesh: is given together with");
    refuse(
        "scene.json",
        &scene().to_string().replace("\"width\":8", "\"width\":8,\"width\":8"),
        "width: is given twice",
    );
    refuse("scene.json", &scene().to_string().replace("\"width\":8", "\"width\":1e999"), "is not JSON");
    refuse("scene.json", "{\"width\": 8", "is not JSON");
    refuse("scene.json", "", "is not JSON");
    refuse("scene.json", "[1]", "is an array and should be an object");
    refuse("scene.txt", &scene().to_string(), "is neither a scene");
    refuse("mesh.obj", "v 0 0\n", "mesh.obj:1:");
    refuse("mesh.obj", "v 0 0 0\n", "mesh.obj: has no faces");
    refuse("mesh.stl", "solid\nendsolid\n", "mesh.stl: has no faces");
    refuse("mesh.stl", "facet", "mesh.stl:1: the file ends within a facet");
    refuse("mesh.stl", "fac", "ends before byte 3");
}

/// A scene with these fields instead of others.
fn with(changes: Value) -> Value {
    let mut changed = scene();
    for (field, value) in changes.as_object().unwrap() {
        changed[field] = value.clone();
    }
    changed.as_object_mut().unwrap().retain(|_, value| !value.is_null());
    changed
}

/// The number of the visible triangle in each pixel, and the scene as it is used.
fn seen(to: &Path, name: &str, content: impl AsRef<[u8]>) -> (Vec<i32>, Value) {
    let (file, ids, used) = (write(to, name, content), to.join("ids"), to.join("used.json"));
    let done = RENDER.run(&[text(&file), "--ids", text(&ids), "--used", text(&used)]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let ids = fs::read(&ids).unwrap();
    let ids = ids.chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect();
    (ids, serde_json::from_slice(&fs::read(&used).unwrap()).unwrap())
}

/// The line that refuses a scene.
fn refused(to: &Path, scene: &Value) -> String {
    let file = write(to, "refused.json", scene.to_string());
    refusal(&RENDER.run(&[text(&file), "--ids", text(&to.join("none"))]))
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let to = RENDER.folder("render", "mark");
    let (marked, _) = seen(&to, "marked.json", format!("\u{feff}{}", scene()));
    assert_eq!(marked, seen(&to, "plain.json", scene().to_string()).0);
    let mesh = json!({"vertices": scene()["vertices"], "triangles": scene()["triangles"]});
    write(&to, "m.json", format!("\u{feff}{mesh}"));
    let of_file = with(json!({"mesh": "m.json", "vertices": null, "triangles": null}));
    assert_eq!(marked, seen(&to, "of_file.json", of_file.to_string()).0);
}

#[test]
fn faces_have_the_colours_of_their_materials_unless_a_scene_has_its_own() {
    let to = RENDER.folder("render", "scene_materials");
    write(&to, "m.mtl", "newmtl steel\nKd 0.6 0.6 0.6\nnewmtl red one\nKd 1 0 0\nKe 0 0 0.2\n");
    let vertices = "v -1 -1 0\nv 1 -1 0\nv -1 1 0\nv -1 -1 0.5\nv 0 -1 0.5\nv -1 0 0.5\n";
    write(&to, "m.obj", format!("mtllib m.mtl\n{vertices}usemtl steel\nf 1 2 3\nusemtl red one\nf 4 5 6\n"));
    let of_file = with(json!({"mesh": "m.obj", "vertices": null, "triangles": null}));
    let (_, used) = seen(&to, "scene.json", of_file.to_string());
    assert_eq!(
        (&used["colors"], &used["emission"]),
        (&json!([[153, 153, 153], [255, 0, 0]]), &json!([[0, 0, 0], [0, 0, 51]]))
    );
    let mut own = of_file;
    own["colors"] = json!([[1, 2, 3], [4, 5, 6]]);
    let (_, used) = seen(&to, "own.json", own.to_string());
    assert_eq!((&used["colors"], used.get("emission")), (&own["colors"], None));
    // A library is an input.
    let file = to.join("scene.json");
    let said = refusal(&RENDER.run(&[text(&file), "--ids", text(&to.join("m.mtl"))]));
    assert!(said.contains("m.mtl: is the input file"), "{said}");
}

#[test]
fn several_meshes_are_one_scene() {
    let to = RENDER.folder("render", "several");
    let (whole, _) = seen(&to, "one.json", scene().to_string());
    // Each triangle of the scene is a mesh that lies elsewhere, in a file and in lists.
    write(&to, "far.obj", "v 0 1 2\nv 2 1 2\nv 0 3 2\nf 1 2 3\n");
    let place = |x: i32, y: i32, z: i32| json!([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]);
    let near = json!({"vertices": [[0, 0, 0], [2, 0, 0], [0, 2, 0]], "triangles": [[0, 1, 2]],
        "model": [[0.5, 0, 0, -1], [0, 0.5, 0, -1], [0, 0, 0.5, 0.5], [0, 0, 0, 1]], "colors": [[9, 8, 7]]});
    let far = json!({"mesh": "far.obj", "model": place(-1, -2, -2)});
    let meshes = json!({"meshes": [far, near], "vertices": null, "triangles": null, "model": null});
    let (ids, used) = seen(&to, "several.json", with(meshes.clone()).to_string());
    assert_eq!(ids, whole);
    // The one has the colour of a face without a material.
    assert_eq!(used["colors"], json!([[204, 204, 204], [9, 8, 7]]));
    for (field, value, wanted) in [
        ("mesh", json!("far.obj"), "meshes: is given together with mesh, vertices or triangles"),
        ("meshes", json!([]), "meshes: has no meshes"),
        ("meshes", json!([far, {"vertices": []}]), "meshes[1]: triangles: is missing"),
        ("meshes", json!([far, {"mesh": "far.obj", "cull": "none"}]), "meshes[1].cull: is not a field"),
        (
            "meshes",
            json!([{"mesh": "far.obj", "model": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}]),
            "meshes[0].model: the last row is not [0, 0, 0, 1]",
        ),
        ("meshes", json!([far, {"mesh": "none.obj"}]), "none.obj: cannot be read"),
    ] {
        let mut changed = with(meshes.clone());
        changed[field] = value;
        let said = refused(&to, &changed);
        assert!(said.contains(wanted), "{said}");
    }
}

/// A point in the picture's coordinates from −1 to 1 and its depth, by the matrices of a scene.
fn projected(scene: &Value, point: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = point;
    let after = |matrix: &Value, p: [f64; 4]| -> [f64; 4] {
        core::array::from_fn(|i| (0..4).map(|k| matrix[i][k].as_f64().unwrap() * p[k]).sum())
    };
    let [x, y, z, w] = after(&scene["projection"], after(&scene["view"], [x, y, z, 1.0]));
    assert!(w > 0.0, "{point:?} lies behind the eye");
    [x / w, y / w, z / w]
}

#[test]
fn a_camera_is_an_eye_and_what_it_looks_at() {
    let to = RENDER.folder("render", "eye");
    let of = |camera: Value| {
        let fields = json!({"camera": camera, "view": null, "projection": null, "model": null, "width": 80, "height": 60});
        let (ids, used) = seen(&to, "camera.json", with(fields).to_string());
        assert!(ids.iter().any(|&id| id >= 0));
        used
    };
    let near = |a: [f64; 3], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6;
    // From (3, 4, 12), 13 away from the target; the picture is wider than high, by 4 to 3.
    let (eye, target, up) = ([3.0, 4.0, 12.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let used = of(json!({"eye": eye, "target": target, "fov": 60, "up": up}));
    assert!(near(projected(&used, target), [0.0, 0.0]));
    // The direction to the right is (12, 0, −3)/√153, that upwards (−12, 153, −48)/(13·√153).
    let root = 153f64.sqrt();
    let right = [12.0 / root, 0.0, -3.0 / root];
    let upwards = [-12.0, 153.0, -48.0].map(|c| c / (13.0 * root));
    let half = 13.0 * 30f64.to_radians().tan();
    assert!(near(projected(&used, upwards.map(|c| c * half)), [0.0, 1.0]));
    assert!(near(projected(&used, right.map(|c| c * half * 4.0 / 3.0)), [1.0, 0.0]));
    // Without more said, y is up, and all vertices are between near and far, which the depths use well.
    assert_eq!(of(json!({"eye": eye, "target": target, "fov": 60})), used);
    let corners = scene()["vertices"].as_array().unwrap().clone();
    let depths: Vec<f64> = corners
        .iter()
        .map(|corner| projected(&used, [0, 1, 2].map(|i| corner[i].as_f64().unwrap()))[2])
        .collect();
    assert!(depths.iter().all(|depth| depth.abs() < 1.0), "{depths:?}");
    let spread = depths.iter().fold(-1.0f64, |a, &b| a.max(b)) - depths.iter().fold(1.0f64, |a, &b| a.min(b));
    assert!(spread > 1.0, "{depths:?}");
    // Depth by definition: −1 at near and 1 at far.
    let used = of(json!({"eye": [0, 0, 5], "target": target, "near": 2, "far": 8}));
    for (z, depth) in [(3.0, -1.0), (-3.0, 1.0)] {
        assert!((projected(&used, [0.0, 0.0, z])[2] - depth).abs() < 1e-6);
    }
    for (camera, wanted) in [
        (json!({"eye": eye}), "camera: target: is missing"),
        (json!({"eye": eye, "target": eye}), "camera.target: is where the eye is"),
        (json!({"eye": eye, "target": target, "up": eye}), "camera.up: points to the target or away from it"),
        (json!({"eye": [0, 3, 0], "target": target}), "camera: up: points to the target or away from it"),
        (json!({"eye": eye, "target": target, "fov": 180}), "camera.fov: 180 is not from 1 to 170"),
        (json!({"eye": eye, "target": target, "near": 0}), "camera.near: 0 is not from"),
        (json!({"eye": eye, "target": target, "near": 3, "far": 2}), "camera: near is 3 and far is 2"),
        (json!({"eye": eye, "target": target, "yaw": 3}), "camera.yaw: is not a field"),
        (json!({"projection": "fish-eye"}), "camera.projection: is \"fish-eye\" and should be"),
        (json!({"projection": "two-point", "pitch": 80}), "camera.pitch: 80 is not from -70 to 70"),
        (json!({"near": 1}), "camera.near: is not a field"),
    ] {
        let said = refused(&to, &with(json!({"camera": camera, "view": null, "projection": null})));
        assert!(said.contains(wanted), "{said}");
    }
    let said = refused(&to, &with(json!({"camera": {}})));
    assert!(said.contains("camera: is given together with view or projection"), "{said}");
}

/// By the camera's own projection: what the option of the same name draws of the mesh alone.
#[test]
fn a_camera_frames_the_scene_as_options_frame_a_mesh() {
    let to = RENDER.folder("render", "framing");
    let teapot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/teapot.obj");
    for (camera, options) in [
        (json!({}), &[][..]),
        (
            json!({"projection": "isometric", "frame": "outline"}),
            &["--projection", "isometric", "--frame", "outline"],
        ),
        (
            json!({"yaw": 70, "pitch": -20, "fov": 90, "up": "z"}),
            &["--from", "70,-20", "--fov", "90", "--up", "z"],
        ),
    ] {
        let ids = to.join("mesh.ids");
        let done = RENDER.run(&[&[text(&teapot), "--size", "90x70", "--ids", text(&ids)], options].concat());
        assert!(done.status.success(), "{done:?}");
        let wanted: Vec<i32> =
            fs::read(&ids).unwrap().chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect();
        // The model matrix moves the mesh, and the camera follows.
        let scene = json!({"mesh": teapot, "camera": camera, "width": 90, "height": 70, "cull": "back",
            "model": [[2, 0, 0, 64], [0, 2, 0, -32], [0, 0, 2, 128], [0, 0, 0, 1]]});
        let (found, _) = seen(&to, "scene.json", scene.to_string());
        // Both round in their own coordinates, which moves an edge by less than 1/256 px.
        let differ = found.iter().zip(&wanted).filter(|(a, b)| a != b).count();
        assert!(differ <= 3, "{differ} pixels differ with {camera}");
    }
}

#[test]
fn lights_are_those_of_the_scene() {
    let to = RENDER.folder("render", "lights");
    let lit = |lights: Value| -> [u8; 3] {
        let mut scene = with(json!({"lights": lights, "colors": [[200, 100, 50], [200, 100, 50]]}));
        let picture = to.join("out.png");
        let used = to.join("used.json");
        let draw = |scene: &Value| {
            let file = write(&to, "scene.json", scene.to_string());
            let done =
                RENDER.run(&[text(&file), "--mode", "flat", "--png", text(&picture), "--used", text(&used)]);
            assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
            colours(&picture)[5 * 8 + 1]
        };
        let color = draw(&scene);
        scene = serde_json::from_slice(&fs::read(&used).unwrap()).unwrap();
        assert_eq!(draw(&scene), color, "the scene as it is used has other lights");
        color
    };
    let usual = lit(Value::Null);
    assert_eq!(lit(json!(["key", "fill", "ambient"])), usual);
    let [key, fill, ambient] = ["key", "fill", "ambient"].map(|name| u32::from(lit(json!([name]))[0]));
    assert!((key + fill + ambient).abs_diff(usual[0].into()) <= 2 && key > fill && fill > 0 && ambient > 0);
    // The faces look along z. Levels by Lambert's law, within one of 256.
    let near = |color: [u8; 3], level: f64| {
        [200.0, 100.0, 50.0]
            .iter()
            .zip(color)
            .all(|(full, is)| (f64::from(is) - full * level / 256.0).abs() <= 1.3)
    };
    let root = 0.5f64.sqrt();
    for (lights, level) in [
        (json!([]), 0.0),
        (json!([{"ambient": 128}]), 128.0),
        (json!([{"towards": [0, 0, 1], "level": 256}]), 256.0),
        (json!([{"towards": [0, 3, 3], "level": 256}]), 256.0 * root),
        (json!([{"towards": [0, 0, -1], "level": 256}]), 0.0),
        (json!([{"towards": [0, 0, 2], "level": 100}, {"ambient": 28}]), 128.0),
        (json!([{"towards": [0, 0, 1], "from": "camera", "level": 64}, {"ambient": 256}]), 256.0),
    ] {
        let color = lit(lights.clone());
        assert!(near(color, level), "{lights}: {color:?}");
    }
    // A lamp of the camera moves with it, a lamp of the world does not: seen from the side, (1, 0, 0) is right of the camera.
    let side = |from: &str| {
        let lights = json!([{"towards": [0, 0, 1], "from": from, "level": 256}]);
        let turned = with(json!({"lights": lights, "colors": [[200, 100, 50], [200, 100, 50]],
            "view": [[0.6, 0, -0.8, 0], [0, 1, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 0, 1]],
            "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.2, 0], [0, 0, 0, 1]]}));
        let (file, picture) = (write(&to, "side.json", turned.to_string()), to.join("side.png"));
        let done =
            RENDER.run(&[text(&file), "--mode", "flat", "--background", "blue", "--png", text(&picture)]);
        assert!(done.status.success(), "{done:?}");
        colours(&picture).into_iter().find(|color| color[0] > 0).unwrap()
    };
    assert!(near(side("world"), 256.0) && near(side("camera"), 256.0 * 0.6));
    for (lights, wanted) in [
        (json!(["sun"]), "lights[0]: is \"sun\" and should be \"ambient\", \"key\" or \"fill\""),
        (json!([{"ambient": 257}]), "lights[0].ambient: 257 is not from 0 to 256"),
        (json!([{"towards": [0, 0, 1]}]), "lights[0]: level: is missing"),
        (json!([{}]), "lights[0]: has neither ambient nor towards, or both"),
    ] {
        let said = refused(&to, &with(json!({"lights": lights})));
        assert!(said.contains(wanted), "{said}");
    }
}

/// Of numbers, 30 bits of the largest one are kept. One that is so large that nothing is left of what is seen is refused.
#[test]
fn numbers_that_take_all_bits_of_the_others_are_refused() {
    let to = RENDER.folder("render", "out_of_range");
    // Perspective, near 1 and far 64, from 4 before the triangles.
    let before = |factor: f64| {
        let view = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4.0 * factor], [0, 0, 0, 1]]);
        let projection = json!([
            [2, 0, 0, 0],
            [0, 2.5, 0, 0],
            [0, 0, -65.0 / 63.0, -128.0 / 63.0 * factor],
            [0, 0, -1, 0]
        ]);
        with(json!({"view": view, "projection": projection, "width": 80, "height": 60}))
    };
    let change = |field: &str, value: Value| {
        let mut scene = before(1.0);
        scene[field] = value;
        scene
    };
    let floor = |size: f64| {
        json!([[-size, -1, -size], [size, -1, -size], [0, -1, size], [0, 0, 9], [1, 0, 9], [0, 1, 9]])
    };
    for (scene, named) in [
        (
            change("vertices", json!([[1e30, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]])),
            "vertices[0][0]: 1e30",
        ),
        (change("vertices", floor(1e30)), "vertices[2][2]: 1e30"),
        (change("model", json!([[1, 0, 0, 0], [0, 1, 0, 1e30], [0, 0, 1, 0], [0, 0, 0, 1]])), ""),
        (change("sprites", json!([{"at": [[0, 0, 0], [1e30, 0, 0]], "color": [1, 2, 3]}])), "sprites: 1e30"),
        (change("fog", json!([0, 1e30])), "fog"),
    ] {
        if named.is_empty() {
            // Nothing is seen of it, so nothing is lost.
            assert!(seen(&to, "unseen.json", scene.to_string()).0.iter().all(|&id| id < 0));
            continue;
        }
        let said = refused(&to, &scene);
        assert!(said.contains(named), "{said}");
    }
    // Large numbers alone are no fault, nor is a floor that ends far away.
    let (wanted, _) = seen(&to, "plain.json", before(1.0).to_string());
    assert!(wanted.iter().filter(|&&id| id >= 0).count() > 100);
    let mut large = before(2f64.powi(80));
    let scaled = |c: &Value| json!(c.as_f64().unwrap() * 2f64.powi(80));
    for vertex in large["vertices"].as_array_mut().unwrap() {
        *vertex = vertex.as_array().unwrap().iter().map(scaled).collect();
    }
    assert!(seen(&to, "large.json", large.to_string()).0 == wanted);
    assert!(seen(&to, "floor.json", change("vertices", floor(1e6)).to_string()).0.contains(&0));
}

#[test]
fn bad_meshes_of_a_scene_are_named_themselves() {
    let to = RENDER.folder("render", "bad_meshes");
    for (name, content, named) in [
        ("m.obj", Some("v 0 0 0\nf 1 2 3\n"), "m.obj:2: the face names a vertex that does not exist"),
        ("m.json", Some("{\"vertices\": [[0, 0, 0]]}"), "m.json: triangles: is missing"),
        (
            "m.json",
            Some("{\"vertices\": [], \"triangles\": [], \"width\": 3}"),
            "m.json: width: is not a field",
        ),
        ("m.json", Some("{\"vertices\": [], \"triangles\": []}"), "m.json: triangles: has no faces"),
        ("m.obj", Some("v 0 0 0\n"), "m.obj: has no faces"),
        ("m.ply", Some("ply"), "m.ply: is not a model"),
        ("absent.obj", None, "absent.obj: cannot be read"),
    ] {
        let mut with_mesh = scene();
        let fields = with_mesh.as_object_mut().unwrap();
        fields.retain(|field, _| field != "vertices" && field != "triangles");
        fields.insert("mesh".into(), name.into());
        let file = write(&to, "scene.json", with_mesh.to_string());
        if let Some(content) = content {
            write(&to, name, content);
        }
        let said = refusal(&RENDER.run(&[text(&file)]));
        assert!(said.contains(named), "{said}");
    }
}

#[test]
fn bad_command_lines_are_one_line() {
    let to = RENDER.folder("render", "flags");
    let file = write(&to, "scene.json", scene().to_string());
    let mesh = write(&to, "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let (scene, mesh) = (text(&file), text(&mesh));
    let same = text(&to.join("same")).to_string();
    let dotted = text(&to.join("../flags/./same")).to_string();
    let below = text(&to.join("scene.json/below")).to_string();
    for (arguments, named) in [
        (&[][..], "MODEL|SCENE>: --help lists what there is"),
        (&["m.txt", "--size", "9x9"], "m.txt: is neither a scene (.json) nor a mesh (.obj, .stl): export .stl or .obj"),
        (&["absent.json"], "absent.json: cannot be read"),
        (&[scene, scene], "found: one file is taken; a value of"),
        (&[mesh, "--firmware", "30"], "'30' found: one file is taken; a value of an option that may stand alone follows =, as in --option=value"),
        (&[scene, "--mode", "hidden-line", "--depth", &same], "--depth: needs --mode solid"),
        (&[scene, "--mode", "points"], "--mode: points is not"),
        (&[scene, "--yaw", "3"], "--yaw: "),
        (&[scene, "--pong"], "'--pong' found: --help lists what there is"),
        (&[scene, "--ids"], "--ids"),
        (&["-", "--png", &same], "-: standard input is not read"),
        (&[scene, "--png", "-"], "--png: - is no file"),
        (&[mesh, "--gif", "-"], "--gif: - is no file"),
        (&[scene, "--ids", &same, "--depth", &same], "--depth: names the same file as --ids"),
        (&[scene, "--ids", &same, "--png", &dotted], "--ids: names the same file as --png"),
        (&[scene, "--mode", "wireframe", "--ids", &same], "--ids: needs --mode solid"),
        (&[scene, "--png", &below], "scene.json/below: cannot be written"),
        // The first one could be written, the second not: neither is.
        (&[scene, "--ids", &same, "--png", &below], "scene.json/below: cannot be written"),
        (&[scene, "--png", text(&to)], "cannot be written"),
        (&[mesh, "--size", "0x10"], "--size: 0x10"),
        (&[mesh, "--size", "5000x10"], "--size: 5000x10"),
        (&[mesh, "--projection", "fish-eye"], "--projection: fish-eye"),
        (&[mesh, "--fov", "180"], "--fov: 180"),
        (&[mesh, "--pitch", "NaN"], "--pitch: NaN"),
    ] {
        let said = refusal(&RENDER.run(arguments));
        assert!(said.contains(named), "{said}");
        assert_eq!(fs::read_dir(&to).unwrap().count(), 2, "{arguments:?}");
    }
    // Help is no error.
    assert!(RENDER.run(&["--help"]).status.success());
}

/// A square of two triangles that fills a picture of 16 × 16, with 16 × 8 texels on it.
fn textured() -> Value {
    let mut scene = scene();
    scene["vertices"] = json!([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]);
    scene["triangles"] = json!([[0, 1, 2], [0, 2, 3]]);
    scene["uv"] = json!([[0, 8], [16, 8], [16, 0], [0, 0]]);
    scene["texture"] = json!([16, 8]);
    scene["width"] = json!(16);
    scene["height"] = json!(16);
    scene
}

/// The numbers that `--texels` writes of a scene, and those of the scene that `--used` writes.
fn texels(to: &Path, scene: &Value) -> Vec<u16> {
    let file = write(to, "texels.json", scene.to_string());
    let (texels, used) = (to.join("texels"), to.join("used.json"));
    let done = RENDER.run(&[text(&file), "--texels", text(&texels), "--used", text(&used)]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let read = || -> Vec<u16> {
        let bytes = fs::read(&texels).unwrap();
        bytes.chunks(2).map(|b| u16::from_le_bytes(b.try_into().unwrap())).collect()
    };
    let first = read();
    let again = RENDER.run(&[text(&used), "--texels", text(&texels)]);
    assert!(again.status.success(), "{again:?}");
    assert_eq!(first, read(), "the scene as it is used gives other texels");
    first
}

#[test]
fn texels_are_numbered_row_by_row() {
    let to = RENDER.folder("render", "texels");
    // Pixel (i, j) has u = i + ½ and v = (j + ½)/2, in column i and row j/2.
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| (1 << 15) | (j / 2 * 16 + i))).collect();
    assert_eq!(texels(&to, &textured()), expected);
    let mut corners = textured();
    corners["uv"] = json!([[[0, 8], [16, 8], [16, 0]], [[0, 8], [16, 0], [0, 0]]]);
    corners["wrap"] = json!("repeat");
    assert_eq!(texels(&to, &corners), expected);
    // Three pictures to the left, and one down: rounded down below zero, too.
    let mut left = textured();
    left["uv"] = json!([[-48, 16], [-32, 16], [-32, 8], [-48, 8]]);
    assert_eq!(texels(&to, &left), expected);
    // Nothing is drawn where the triangle is not.
    let mut half = corners;
    half["triangles"] = json!([[0, 1, 2]]);
    half["uv"] = json!([[[0, 8], [16, 8], [16, 0]]]);
    let half = texels(&to, &half);
    assert_eq!(half.iter().filter(|&&number| number == 0).count(), 16 * 15 / 2);
    assert!(half.iter().zip(&expected).all(|(&a, &b)| a == 0 || a == b));
}

#[test]
fn the_edge_of_a_clamped_picture_continues() {
    let to = RENDER.folder("render", "clamped");
    let mut scene = textured();
    // One picture to the left and to the right, half a picture above and below.
    scene["uv"] = json!([[-16, 12], [32, 12], [32, -4], [-16, -4]]);
    scene["wrap"] = json!("clamp");
    // Pixel (i, j) has u = 3·(i + ½) − 16 and v = j + ½ − 4.
    let column = |i: i32| (3 * i + 1 - 16).clamp(0, 15);
    let row = |j: i32| (j - 4).clamp(0, 7);
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| 1 << 15 | (16 * row(j) + column(i)) as u16)).collect();
    assert_eq!(texels(&to, &scene), expected);
}

/// The colours of a picture.
fn colours(file: &Path) -> Vec<[u8; 3]> {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(file).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND); // a palette to colours
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let samples = reader.next_frame(&mut bytes).unwrap().color_type.samples();
    assert!(samples >= 3);
    bytes.chunks(samples).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

/// The picture of a scene that fills it with two squares, one behind the other, with these options.
fn squares(to: &Path, options: &[&str]) -> Vec<[u8; 3]> {
    let mut scene = scene();
    let square = |z: f64| [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
    scene["vertices"] = json!([square(0.5), square(0.0)].concat());
    // The near one comes first, so that blending must sort.
    scene["triangles"] = json!([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]);
    let (near, far) = ([200, 100, 0], [40, 80, 120]);
    scene["colors"] = json!([near, near, far, far]);
    (scene["width"], scene["height"]) = (json!(16), json!(8));
    let (file, picture) = (write(to, "squares.json", scene.to_string()), to.join("squares.png"));
    let fixed = [text(&file), "--mode", "flat", "--background", "#0000ff", "--png", text(&picture)];
    let done = RENDER.run(&[&fixed, options].concat());
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    colours(&picture)
}

#[test]
fn faces_may_emit_light() {
    let to = RENDER.folder("render", "emission");
    let mut scene = scene();
    // Two triangles beside each other, of one colour.
    scene["vertices"] = json!([[-1, -1, 0], [0, -1, 0], [0, 1, 0], [0, -1, 0], [1, -1, 0], [1, 1, 0]]);
    (scene["width"], scene["height"]) = (json!(16), json!(8));
    scene["colors"] = json!([[200, 100, 40], [200, 100, 40]]);
    let emission = [0, 90, 251];
    let drawn = |scene: &Value, options: &[&str]| {
        let (file, picture) = (write(&to, "lamp.json", scene.to_string()), to.join("lamp.png"));
        let used = to.join("used.json");
        let fixed = [text(&file), "--png", text(&picture), "--used", text(&used)];
        let done = RENDER.run(&[&fixed, options].concat());
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        let pixels = colours(&picture);
        (pixels[5 * 16 + 6], pixels[5 * 16 + 14], serde_json::from_slice(&fs::read(used).unwrap()).unwrap())
    };
    for mode in ["flat", "solid"] {
        let (dark, _, _): (_, _, Value) = drawn(&scene, &["--mode", mode]);
        assert!(dark[0] > 20 && dark[0] < 200, "{dark:?}");
        let mut lamp = scene.clone();
        lamp["emission"] = json!([[0, 0, 0], emission]);
        // Light is added whole after the other is rounded: levels of eight bits.
        let wanted = [0, 1, 2].map(|i| (u16::from(dark[i]) + emission[i]).min(255) as u8);
        let (first, second, used) = drawn(&lamp, &["--mode", mode]);
        assert_eq!((first, second), (dark, wanted), "{mode}");
        assert_eq!(drawn(&used, &["--mode", mode]), (first, second, used.clone()));
        // A colour that is asked for replaces both.
        let (first, second, _) = drawn(&lamp, &["--mode", mode, "--colour", "#c86428"]);
        assert_eq!([first, second], [dark; 2], "{mode}");
    }
}

#[test]
fn faces_may_be_translucent() {
    let to = RENDER.folder("render", "translucent");
    let opaque = squares(&to, &[]);
    let near = opaque[0];
    assert!(opaque.iter().all(|&pixel| pixel == near));
    // Both have the light of the near one: its ratio is that of their colours.
    let far = near[0] / 5;
    let sky = [0, 0, 255];
    // A door of nothing, of everything, and of half of the pixels, in a chequered pattern.
    assert!(squares(&to, &["--door", "0"]).iter().all(|&pixel| pixel == sky));
    assert_eq!(squares(&to, &["--door", "64"]), opaque);
    for (at, pixel) in squares(&to, &["--door", "32"]).into_iter().enumerate() {
        let is_drawn = (at % 16 + at / 16) % 2 == 0;
        assert_eq!(pixel, if is_drawn { near } else { sky }, "{at}");
    }
    // The far one over the sky, and the near one over both.
    let mix = |own: u8, below: u8, alpha: u32| {
        ((u32::from(own) * alpha + u32::from(below) * (32 - alpha) + 16) / 32) as u8
    };
    let red = |alpha: u32| mix(near[0], mix(far, sky[0], alpha), alpha);
    for alpha in [0, 8, 20, 32] {
        let drawn = squares(&to, &["--alpha", &alpha.to_string()]);
        assert!(drawn.iter().all(|pixel| pixel[0].abs_diff(red(alpha)) <= 1), "{alpha}: {:?}", drawn[0]);
    }
    let half = squares(&to, &["--half"]);
    assert!(half.iter().all(|pixel| pixel[0].abs_diff(red(16)) <= 1), "{:?}", half[0]);
    // In every pixel format.
    for format in ["rgb565", "rgb666", "gray8", "gray4", "gray2", "mono"] {
        let (behind, mixed) = (squares(&to, &["--format", format, "--alpha", "32", "--no-dither"]), &to);
        assert_eq!(behind, squares(mixed, &["--format", format, "--no-dither"]), "{format}");
    }
}

#[test]
fn a_texture_may_be_lit() {
    let to = RENDER.folder("render", "lit");
    let mut encoder = png::Encoder::new(fs::File::create(to.join("texture.png")).unwrap(), 16, 8);
    encoder.set_color(png::ColorType::Rgb);
    let pixels: Vec<u8> = (0..8).flat_map(|j| (0..16).flat_map(move |i| [i * 16, j * 32, 99])).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    let mut scene = textured();
    scene["texture"] = json!("texture.png");
    let draw = |scene: &Value, options: &[&str]| {
        let (file, picture) = (write(&to, "scene.json", scene.to_string()), to.join("out.png"));
        let done = RENDER.run(&[&[text(&file), "--png", text(&picture)], options].concat());
        assert!(done.status.success(), "{done:?}");
        colours(&picture)
    };
    let (plain, lit) = (draw(&scene, &[]), draw(&scene, &["--lit-texture"]));
    // A white face of the same scene shows the light.
    for field in ["uv", "texture"] {
        scene.as_object_mut().unwrap().remove(field);
    }
    let light = draw(&scene, &["--mode", "flat", "--colour", "white"]);
    assert!(light[0][0] > 60 && light[0][0] < 250);
    for ((plain, lit), light) in plain.iter().zip(&lit).zip(&light) {
        for channel in 0..3 {
            let exact = f64::from(plain[channel]) * f64::from(light[channel]) / 255.0;
            assert!((f64::from(lit[channel]) - exact).abs() <= 1.5, "{plain:?} in {light:?}: {lit:?}");
        }
    }
}

#[test]
fn lines_may_be_smooth() {
    let to = RENDER.folder("render", "smooth");
    let file = write(&to, "scene.json", scene().to_string());
    let draw = |options: &[&str]| {
        let picture = to.join("out.png");
        let fixed = [text(&file), "--colour", "black", "--background", "white", "--png", text(&picture)];
        let done = RENDER.run(&[&fixed, options].concat());
        assert!(done.status.success(), "{done:?}");
        colours(&picture)
    };
    for mode in ["wireframe", "hidden-line"] {
        let ink = |pixels: &[[u8; 3]]| pixels.iter().map(|pixel| 255 - u32::from(pixel[0])).sum::<u32>();
        let (plain, smooth) = (draw(&["--mode", mode]), draw(&["--mode", mode, "--smooth-lines"]));
        assert!(plain.iter().all(|pixel| [0, 255].contains(&pixel[0])));
        let grey = smooth.iter().filter(|pixel| ![0, 255].contains(&pixel[0])).count();
        assert!(grey > 5, "{mode}: {grey}");
        // As much ink, but for diagonals, which are √2 as long as they have pixels.
        assert!(2 * ink(&smooth) > ink(&plain) && ink(&smooth) < 2 * ink(&plain), "{mode}");
    }
}

/// Fog of the background's colour, by definition: the near square is a quarter of the way from −1 to 1 before the camera.
#[test]
fn faces_may_be_in_fog() {
    let to = RENDER.folder("render", "fog");
    let near = squares(&to, &[])[0];
    let mixed = |factor: u32| {
        [0, 1, 2].map(|i| {
            let sky = [0, 0, 255][i];
            ((u32::from(near[i]) * factor + sky * (32 - factor) + 16) / 32) as u8
        })
    };
    // 32·64^(−1/4) is 11.3, 32·64^(−1/16) is 24.7.
    for (fog, factor) in [
        ("-1,1", 24),
        ("-1,1,linear", 24),
        ("-1,1,exponential", 11),
        ("-1,1,squared", 25),
        ("0,1", 32),
        ("auto", 32),
        ("auto,squared", 32),
    ] {
        let drawn = squares(&to, &["--fog", fog]);
        assert!(drawn.iter().all(|&pixel| pixel == mixed(factor)), "{fog}: {:?}", drawn[0]);
    }
    // A scene's own fog, which --used keeps and --fog replaces.
    let file = to.join("squares.json");
    let mut scene: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    scene["fog"] = json!([-1, 1]);
    let (own, used, picture) =
        (write(&to, "own.json", scene.to_string()), to.join("used.json"), to.join("own.png"));
    let draw = |file: &Path, options: &[&str]| {
        let fixed = [
            text(file),
            "--mode",
            "flat",
            "--background",
            "#0000ff",
            "--png",
            text(&picture),
            "--used",
            text(&used),
        ];
        let done = RENDER.run(&[&fixed, options].concat());
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        colours(&picture)[0]
    };
    assert_eq!(draw(&own, &[]), mixed(24));
    let again = write(&to, "again.json", fs::read(&used).unwrap());
    assert_eq!(draw(&again, &[]), mixed(24));
    assert_eq!(draw(&own, &["--fog", "0,1"]), near);
    scene["fog"] = json!([2, 1]);
    let wrong = write(&to, "wrong.json", scene.to_string());
    let said = refusal(&RENDER.run(&[text(&wrong), "--png", text(&picture)]));
    assert!(said.contains("fog: begins at 2 and should end farther away than 1"), "{said}");
    for (fog, wanted) in [
        ("2,1", "--fog: begins at 2 and should end farther away than 1"),
        ("2", "--fog: 2 is not auto or START,END"),
        ("1,2,thick", "--fog: 1,2,thick is not auto or START,END"),
        ("-9,-8", "fog: -9 to -8 is not where the scene is: its vertices are -0.5 to 0 before the camera"),
        ("0,0.0001", "fog: the fog spans 3 of 65535 steps of depth"),
    ] {
        let said = refusal(&RENDER.run(&[text(&own), "--png", text(&picture), "--fog", fog]));
        assert!(said.contains(wanted), "{said}");
    }
}

#[test]
fn options_of_faces_and_of_lines_are_told_apart() {
    let to = RENDER.folder("render", "told-apart");
    let file = write(&to, "scene.json", scene().to_string());
    let out = to.join("out.png");
    let refused = |options: &[&str], wanted: &str| {
        let said = refusal(&RENDER.run(&[&[text(&file), "--png", text(&out)], options].concat()));
        assert!(said.contains(wanted), "{said}");
        assert!(!out.exists());
    };
    refused(&["--smooth-lines"], "--smooth-lines: needs --mode wireframe or hidden-line");
    for (options, name) in [
        (&["--half"][..], "half"),
        (&["--door", "9"], "door"),
        (&["--alpha", "9"], "alpha"),
        (&["--lit-texture"], "lit-texture"),
        (&["--fog", "auto"], "fog"),
    ] {
        let wanted = format!("--{name}: is for faces: needs --mode solid, flat or gouraud");
        refused(&[options, &["--mode", "wireframe"]].concat(), &wanted);
    }
    refused(&["--door", "65"], "--door");
    refused(&["--alpha", "33"], "--alpha");
    refused(&["--half", "--alpha", "3"], "--alpha");
    let said = refusal(&RENDER.run(&[text(&file), "--half"]));
    assert!(said.contains("--half: applies to pictures alone: give --png FILE too"), "{said}");
}

#[test]
fn texels_of_a_rolled_floor_are_those_of_rays() {
    let to = RENDER.folder("render", "rolled");
    let mut scene = textured();
    // The floor y = −1, seen along −z, the camera rolled by 25°; w is 1 to 17.
    let (sin, cos) = 25f64.to_radians().sin_cos();
    scene["vertices"] = json!([[-9, -1, -1], [9, -1, -1], [9, -1, -17], [-9, -1, -17]]);
    scene["uv"] = json!([[0, 64], [72, 64], [72, 0], [0, 0]]);
    scene["texture"] = json!([64, 32]);
    scene["view"] = json!([[cos, -sin, 0, 0], [sin, cos, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    // Near ½, far 32, 90°.
    let (near, far) = (0.5, 32.0);
    let depth = [0.0, 0.0, (far + near) / (near - far), 2.0 * far * near / (near - far)];
    scene["projection"] = json!([[1, 0, 0, 0], [0, 1, 0, 0], depth, [0, 0, -1, 0]]);
    scene["width"] = json!(96);
    scene["height"] = json!(96);
    let numbers = texels(&to, &scene);
    let (mut seen, mut equal) = (0, 0);
    for (index, &number) in numbers.iter().enumerate() {
        let at = |c: usize| (c as f64 + 0.5) / 48.0 - 1.0;
        let (x, y) = (at(index % 96), -at(index / 96));
        // Back through the roll, to the ray (x, y, −1) and the floor.
        let (x, y) = (cos * x + sin * y, -sin * x + cos * y);
        let t = -1.0 / y;
        let (u, v) = (4.0 * (t * x + 9.0), 4.0 * (17.0 - t));
        let is_on_floor = |more: f64| t > 1.0 - more && t < 17.0 + more && (t * x).abs() < 9.0 + more;
        if number == 0 {
            assert!(!is_on_floor(-0.1), "{index}");
            continue;
        }
        assert!(is_on_floor(0.1), "{index}");
        seen += 1;
        let (column, row) = (f64::from(number & 63), f64::from((number & 0x7fff) >> 6));
        // Within the bound of ¼ texel, 1/50 for the planes, and 1/64 pixel, which is up to t²/12 texels far away.
        let shift = t * t / 12.0 / 64.0;
        for (coordinate, texel, side) in [(u, column, 64.0), (v, row, 32.0)] {
            let off = (coordinate - texel - 0.5f64).rem_euclid(side);
            let off = off.min(side - off) - 0.5;
            assert!(off <= 0.27 + shift, "{index}: {off} off at distance {t}");
        }
        equal += usize::from(u.floor().rem_euclid(64.0) == column && v.floor().rem_euclid(32.0) == row);
    }
    println!("{equal} of {seen}");
    assert!(seen > 3000 && equal * 10 > seen * 8, "{equal} of {seen}");
}

#[test]
fn a_picture_is_a_texture() {
    let to = RENDER.folder("render", "picture");
    let pixels: Vec<u8> = (0..8).flat_map(|j| (0..16).flat_map(move |i| [i * 16, j * 32, 99])).collect();
    let mut encoder = png::Encoder::new(fs::File::create(to.join("texture.png")).unwrap(), 16, 8);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    let mut scene = textured();
    scene["texture"] = json!("texture.png");
    let numbers = texels(&to, &scene);
    assert_eq!(numbers[16 * 15 + 15], 1 << 15 | 127);
    let (file, picture) = (write(&to, "scene.json", scene.to_string()), to.join("out.png"));
    let done = RENDER.run(&[text(&file), "--png", text(&picture)]);
    assert!(done.status.success(), "{done:?}");
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(picture).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND); // a palette to colours
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    let samples = frame.color_type.samples();
    assert!(samples >= 3);
    for (index, pixel) in bytes.chunks(samples).enumerate() {
        let (i, j) = (index % 16, index / 16);
        assert_eq!(pixel[..3], [i as u8 * 16, (j / 2) as u8 * 32, 99], "{i}, {j}");
    }
}

#[test]
fn textures_that_are_none_are_refused() {
    let to = RENDER.folder("render", "no-texture");
    let out = to.join("texels");
    let refused = |field: &str, value: Value, wanted: &str| {
        let mut scene = textured();
        scene[field] = value;
        if scene[field].is_null() {
            scene.as_object_mut().unwrap().remove(field);
        }
        let file = write(&to, "scene.json", scene.to_string());
        let said = refusal(&RENDER.run(&[text(&file), "--texels", text(&out)]));
        assert!(said.contains(wanted), "{said}");
        assert!(!out.exists());
    };
    refused("texture", json!([16, 9]), "texture: has a side of 9, which is none of 8, 16, 32, 64, 128, 256");
    refused("texture", json!([512, 8]), "texture: has a side of 512, which is none of");
    refused("texture", json!([256, 256]), "has 256 x 256 texels, of which 15 bits number 32768 at most");
    refused("texture", json!("nowhere.png"), "nowhere.png: cannot be read: ");
    refused("texture", json!(null), "texture: is missing, and uv is given");
    refused("uv", json!(null), "uv: is missing, and texture or wrap is given");
    refused("uv", json!([[0, 0]]), "uv: has 1 entries, but there are 4 vertices");
    refused("uv", json!([[[0, 0], [0, 0], [0, 0]]]), "uv: has 1 entries, but there are 2 triangles");
    refused("uv", json!([[0, 0], [0, 0], [0, 0], [0, 1e9]]), "uv: goes beyond 32767 sides of the texture");
    refused("wrap", json!("mirror"), "wrap: is \"mirror\" and should be \"repeat\" or \"clamp\"");
    let file = write(&to, "bare.json", scene().to_string());
    let said = refusal(&RENDER.run(&[text(&file), "--texels", text(&out)]));
    assert!(said.contains("--texels: the scene has no texture"), "{said}");
}
