//! Refusals: one line that names the file and the field or option, and no file is changed.

use crate::harness::{changed, scene, with, Folder, RENDER};
use crate::textures::textured;
use pinhole_apps_support::testing::refusal;
use serde_json::{json, Value};
use std::fs;

#[test]
fn bad_scenes_are_one_line_that_names_file_and_field() {
    let to = Folder::new("bad");
    let refuse = |scene: &str, named: &str| {
        let said = to.refused_text(scene, &[]);
        assert!(said.starts_with("refused.json: ") && said.contains(named), "{named:?} is not in {said:?}");
    };
    for field in ["vertices", "triangles", "view", "projection", "width", "height"] {
        let missing = with(json!({field: null})).to_string();
        let said = to.refused_text(&missing, &[]);
        assert!(
            said.contains(&format!("{field}: is missing"))
                || said.contains(&format!("missing field `{field}`")),
            "{said}"
        );
        refuse(&with(json!({field: "8"})).to_string(), &format!("{field}: invalid type: string \"8\""));
    }
    let place = |row: Value| json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], row]);
    let wide = |factor: f64| json!([[factor, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let zero = [0; 4];
    for (changes, named) in [
        (json!({"width": 0}), "width: 0 is not from 1 to 4096"),
        (json!({"width": 4097}), "width: 4097 is not from 1 to 4096"),
        (json!({"height": 2.5}), "height: 2.5 is not a whole number"),
        (json!({"height": 1e300}), "height: 1"),
        (json!({"vertices": [[0, 0, 0], [1, 0]]}), "vertices[1]: invalid length 2"),
        (json!({"vertices": [[0, 0, 0], [1, "a", 0]]}), "vertices[1][1]: invalid type: string \"a\""),
        (json!({"triangles": [[0, 1, 2], [0, 1, 6]]}), "triangles[1][2]: names vertex 6, and there are 6"),
        (json!({"triangles": [[0, 1, -1]]}), "triangles[0][2]: -1 is not"),
        (json!({"triangles": [[0, 1, 1.5]]}), "triangles[0][2]: 1.5 is not a whole number"),
        (json!({"triangles": [[0, 1, 2, 3]]}), "triangles[0]: is not JSON: trailing characters"),
        (json!({"triangles": []}), "triangles: has no faces"),
        (json!({"vertices": []}), "triangles[0][0]: names vertex 0, and there are 0"),
        (json!({"colors": [[1, 2, 3]]}), "colors: has 1 colours, but there are 2 triangles"),
        (json!({"colors": [[1, 2, 3], [4, 5, 256]]}), "colors[1][2]: 256 is not from 0 to 255"),
        (json!({"emission": [[1, 2, 3]]}), "emission: has 1 colours, but there are 2 triangles"),
        (json!({"model": [[1, 0, 0, 0], [0, 1, 0, 0]]}), "model: invalid length 2"),
        (json!({"view": [[1, 0, 0, 0], [0, 1, 0]]}), "view[1]: invalid length 3"),
        (json!({"model": place(json!([0, 0, 1, 1]))}), "model: the last row"),
        (json!({"view": place(json!([0, 0, 1, 1]))}), "view: the viewing matrix is not rigid"),
        (json!({"view": wide(1.00001)}), "view: "),
        (json!({"view": wide(-1.0)}), "view: "),
        (json!({"projection": [zero, zero, zero, zero]}), "projection: "),
        (json!({"viewport": [0, 0, 8]}), "viewport: invalid length 3"),
        (json!({"viewport": [0, 0, 0, 6]}), "viewport: the viewport has no pixels"),
        (json!({"viewport": [0, 0, -1, 6]}), "viewport: -1 is not a width or height"),
        (json!({"viewport": [8000, 0, 400, 6]}), "viewport: the viewport extends beyond ±8192 pixels"),
        (json!({"viewport": [0.5, 0, 8, 6]}), "viewport[0]: 0.5 is not a whole number"),
        (json!({"cull": "front"}), "cull: unknown variant `front`, expected `none` or `back`"),
        (json!({"name": 1}), "name: invalid type: integer `1`, expected a string"),
        (json!({"license": "MIT"}), "license: unknown field `license`"),
        (json!({"mesh": "m.obj"}), "mesh: is given together with"),
        (json!({"mesh": "", "vertices": null, "triangles": null}), "mesh: is empty and should name a file"),
        (json!({"meshes": []}), "meshes: is given together with mesh, vertices or triangles"),
        (json!({"fog": [2, 1]}), "fog: begins at 2 and should end farther away than 1"),
        (json!({"lights": ["sun"]}), "lights[0]: sun is not one of ambient, key, fill"),
        (json!({"lights": [{"ambient": 257}]}), "lights[0].ambient: 257 is not from 0 to 256"),
        (json!({"lights": [{"towards": [0, 0, 1]}]}), "lights[0]: is neither"),
        (json!({"lights": [{"towards": [0, 0]}]}), "lights[0].towards: invalid length 2"),
        (json!({"camera": {}}), "camera: is given together with view or projection"),
    ] {
        refuse(&with(changes).to_string(), named);
    }
    let plain = scene().to_string();
    refuse(&plain.replace("\"width\":8", "\"width\":8,\"width\":8"), "duplicate field `width`");
    refuse(&plain.replace("\"width\":8", "\"width\":1e999"), "is not JSON");
    for (text, named) in [("{\"width\": 8", "is not JSON"), ("", "is not JSON"), ("[1]", "is not an object")]
    {
        refuse(text, named);
    }
}

#[test]
fn bad_cameras_and_meshes_are_named() {
    let to = Folder::new("bad_parts");
    to.write("far.obj", "v 0 1 2\nv 2 1 2\nv 0 3 2\nf 1 2 3\n");
    let (eye, target) = ([3, 4, 12], [0, 0, 0]);
    for (camera, named) in [
        (json!({"eye": eye}), "camera: missing field `target`"),
        (json!({"eye": eye, "target": eye}), "camera.target: is where the eye is"),
        (json!({"eye": eye, "target": target, "up": eye}), "camera.up: points to the target or away from it"),
        (json!({"eye": [0, 3, 0], "target": target}), "camera.up: points to the target or away from it"),
        (json!({"eye": eye, "target": target, "fov": 180}), "camera.fov: 180 is not from 1 to 170"),
        (json!({"eye": eye, "target": target, "near": 0}), "camera.near: 0 is not from"),
        (json!({"eye": eye, "target": target, "near": 3, "far": 2}), "camera: near is 3 and far is 2"),
        (json!({"eye": eye, "target": target, "yaw": 3}), "camera.yaw: unknown field"),
        (
            json!({"projection": "fish-eye"}),
            "camera.projection: fish-eye is not one of perspective, one-point",
        ),
        (json!({"projection": "two-point", "pitch": 80}), "camera.pitch: 80 is not from -70 to 70"),
        (json!({"near": 1}), "camera.near: unknown field"),
    ] {
        let said = to.refused(&with(json!({"camera": camera, "view": null, "projection": null})), &[]);
        assert!(said.contains(named), "{said}");
    }
    let far = json!({"mesh": "far.obj"});
    for (meshes, named) in [
        (json!([]), "meshes: has no meshes"),
        (json!([far, {"vertices": []}]), "meshes[1].triangles: is missing"),
        (json!([far, {"mesh": "far.obj", "cull": "none"}]), "meshes[1].cull: unknown field"),
        (json!([far, {"mesh": "none.obj"}]), "none.obj: cannot be read"),
        (
            json!([{"mesh": "far.obj", "model": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}]),
            "meshes[0].model: the last row is not [0, 0, 0, 1]",
        ),
    ] {
        let said = to.refused(&with(json!({"meshes": meshes, "vertices": null, "triangles": null})), &[]);
        assert!(said.contains(named), "{said}");
    }
    // Errors in the file of a mesh name that file.
    for (name, content, named) in [
        ("m.obj", "v 0 0 0\nf 1 2 3\n", "m.obj:2: the face names a vertex that does not exist"),
        ("m.obj", "v 0 0 0\n", "m.obj: has no faces"),
        ("m.obj", "v 0 0\n", "m.obj:1:"),
        ("m.stl", "solid\nendsolid\n", "m.stl: has no faces"),
        ("m.stl", "facet", "m.stl:1: the file ends within a facet"),
        ("m.stl", "fac", "ends before byte 3"),
        ("m.json", "{\"vertices\": [[0, 0, 0]]}", "m.json: missing field `triangles`"),
        ("m.json", "{\"vertices\": [], \"triangles\": [], \"width\": 3}", "m.json: width: unknown field"),
        ("m.json", "{\"vertices\": [], \"triangles\": []}", "m.json: triangles: has no faces"),
        ("m.ply", "ply", "m.ply: is not a model"),
    ] {
        to.write(name, content);
        let said = to.refused(&with(json!({"mesh": name, "vertices": null, "triangles": null})), &[]);
        assert!(said.contains(named), "{said}");
    }
}

#[test]
fn textures_that_are_none_are_refused() {
    let to = Folder::new("no-texture");
    for (changes, named) in [
        (json!({"texture": [16, 9]}), "texture: has a side of 9, which is none of 8, 16, 32, 64, 128, 256"),
        (json!({"texture": [512, 8]}), "texture: has a side of 512, which is none of"),
        (json!({"texture": [256, 256]}), "has 256 x 256 texels, of which 15 bits number 32768 at most"),
        (json!({"texture": "nowhere.png"}), "nowhere.png: cannot be read: "),
        (json!({"texture": null}), "texture: is missing, and uv is given"),
        (json!({"uv": null}), "uv: is missing, and texture or wrap is given"),
        (json!({"uv": [[0, 0]]}), "uv: has 1 entries, but there are 4 vertices"),
        (json!({"uv": [[0, "a"], [0, 0]]}), "uv[0][1]: invalid type"),
        (json!({"uv": [[[0, 0], [0, 0], [0, 0]]]}), "uv: has 1 entries, but there are 2 triangles"),
        (json!({"uv": [[0, 0], [0, 0], [0, 0], [0, 1e9]]}), "uv: goes beyond 32767 sides of the texture"),
        (json!({"wrap": "mirror"}), "wrap: unknown variant `mirror`, expected `repeat` or `clamp`"),
        (json!({"uv": null, "texture": null}), "--texels: the scene has no texture"),
    ] {
        let said = to.refused(&textured(changes), &["--texels", "texels"]);
        assert!(said.contains(named), "{said}");
    }
}

#[test]
fn sprites_that_are_none_are_refused() {
    let to = Folder::new("refused");
    to.png("picture.png", [2, 2], |_, _| [9, 8, 7, 255]);
    to.png("glass.png", [2, 2], |_, _| [9, 9, 9, 0]);
    to.write("text.png", "picture");
    let square = json!({"color": [1, 2, 3], "at": [0, 0, -2]});
    let file = json!({"picture": "picture.png", "at": [0, 0, -2], "color": null});
    for (base, changes, named) in [
        (&square, json!({"colour": [1, 2, 3]}), "sprites[0].colour: unknown field"),
        (
            &square,
            json!({"at": null}),
            "sprites[0].at: give a point of the world, [x, y, z], or a list of points",
        ),
        (&square, json!({"at": []}), "sprites[0].at: give a point"),
        (&square, json!({"at": [0, 0]}), "sprites[0].at: invalid length 2"),
        (&square, json!({"at": [[0, 0, 1], [0, 0]]}), "sprites[0].at[1]: invalid length 2"),
        (&square, json!({"at": [0, "a", 0]}), "sprites[0].at[1]: invalid type: string \"a\""),
        (&square, json!({"at": [0, 0, 1e101]}), "sprites: 1e101 is out of range"),
        (&square, json!({"color": null}), "sprites[0]: color is missing: give the colour of the picture"),
        (&square, json!({"color": null, "picture": "disc"}), "sprites[0]: color is missing"),
        (&square, json!({"color": [1, 2, 256]}), "sprites[0].color[2]: 256 is not from 0 to 255"),
        (&file, json!({"color": [1, 2, 3]}), "sprites[0].color: is for \"square\" and \"disc\""),
        (&square, json!({"key": [1, 2, 3]}), "sprites[0].key: is the transparent colour of a file"),
        (
            &file,
            json!({"key": [1, 2, 3]}),
            "sprites[0].key: no pixel of picture.png has the colour [1, 2, 3]",
        ),
        (&file, json!({"key": [1, 2]}), "sprites[0].key: invalid length 2"),
        (&file, json!({"picture": 7}), "sprites[0].picture: invalid type: integer `7`"),
        (&file, json!({"picture": "nowhere.png"}), "nowhere.png: cannot be read: "),
        (&file, json!({"picture": "text.png"}), "text.png: is neither PNG nor BMP: convert it"),
        (&file, json!({"picture": "glass.png"}), "sprites[0].picture: glass.png shows nothing"),
        (&square, json!({"pixels": 0}), "sprites[0].pixels: 0 is not from 1 to 255"),
        (&square, json!({"pixels": 256}), "sprites[0].pixels: 256 is not from 1 to 255"),
        (&square, json!({"pixels": 1.5}), "sprites[0].pixels: 1.5 is not a whole number"),
        (&square, json!({"size": [1, 0]}), "sprites[0].size[1]: 0 is not more than 0"),
        (&square, json!({"size": 1}), "sprites[0].size: invalid type: integer `1`"),
        (&square, json!({"height": -2}), "sprites[0].height: -2 is not more than 0"),
        (
            &square,
            json!({"pixels": 2, "height": 2}),
            "sprites[0]: has more than one size: give one of pixels,",
        ),
        (&square, json!({"anchor": "middle"}), "sprites[0].anchor: middle is not one of center, top-left, "),
        (&square, json!({"anchor": [1, -1]}), "sprites[0].anchor[1]: -1 is not from 0 to 4096"),
        (&square, json!({"alpha": 33}), "sprites[0].alpha: 33 is not from 0 to 32"),
        (&square, json!({"depth": "tested"}), "sprites[0].depth: unknown variant `tested`"),
    ] {
        let entry = changed(base.clone(), changes);
        let said = to.refused(&with(json!({"sprites": [entry]})), &[]);
        assert!(said.starts_with("refused.json: ") && said.contains(named), "{named:?} is not in {said:?}");
    }
    let said = to.refused(&with(json!({"sprites": "tree.png"})), &[]);
    assert!(said.contains("sprites: invalid type: string"), "{said}");
}

#[test]
fn bad_command_lines_are_one_line() {
    let to = Folder::new("flags");
    to.write("s.json", scene().to_string());
    to.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let faces = "is for faces: needs --mode solid, flat or gouraud";
    for (line, named) in [
        ("", "MODEL|SCENE>: --help lists what there is"),
        (
            "m.txt --size 9x9",
            "m.txt: is neither a scene (.json) nor a mesh (.obj, .stl): export .stl or .obj",
        ),
        ("absent.json", "absent.json: cannot be read"),
        ("s.json s.json", "found: one file is taken; a value of"),
        (
            "m.obj --firmware 30",
            "'30' found: one file is taken; a value of an option that may stand alone follows =",
        ),
        ("s.json --mode hidden-line --depth same", "--depth: needs --mode solid"),
        ("s.json --mode wireframe --ids same", "--ids: needs --mode solid"),
        ("m.obj --firmware --ids same", "cannot be used with"),
        ("s.json --mode points", "--mode: points is not one of solid, flat"),
        ("s.json --yaw 3", "--yaw: "),
        ("s.json --pong", "'--pong' found: --help lists what there is"),
        ("s.json --ids", "--ids"),
        ("- --png same", "-: standard input is not read"),
        ("s.json --png -", "--png: - is no file"),
        ("m.obj --gif -", "--gif: - is no file"),
        ("s.json --ids same --depth same", "--depth: names the same file as --ids"),
        ("s.json --ids same --png ../flags/./same", "--ids: names the same file as --png"),
        ("s.json --png s.json/below", "s.json/below: cannot be written"),
        // The first one could be written, the second not: neither is.
        ("s.json --ids same --png s.json/below", "s.json/below: cannot be written"),
        ("s.json --png .", "cannot be written"),
        ("m.obj --size 0x10", "--size: 0x10"),
        ("m.obj --size 5000x10", "--size: 5000x10"),
        ("m.obj --fov 180", "--fov: 180"),
        ("m.obj --pitch NaN", "--pitch: NaN"),
        ("s.json --png o --smooth-lines", "--smooth-lines: needs --mode wireframe or hidden-line"),
        ("s.json --png o --mode wireframe --half", &format!("--half: {faces}")),
        ("s.json --png o --mode wireframe --door 9", &format!("--door: {faces}")),
        ("s.json --png o --mode wireframe --alpha 9", &format!("--alpha: {faces}")),
        ("s.json --png o --mode wireframe --lit-texture", &format!("--lit-texture: {faces}")),
        ("s.json --png o --mode wireframe --fog auto", &format!("--fog: {faces}")),
        ("s.json --png o --door 65", "--door"),
        ("s.json --png o --alpha 33", "--alpha"),
        ("s.json --png o --half --alpha 3", "--alpha"),
        ("s.json --half", "--half: applies to pictures alone: give --png FILE too"),
        ("s.json --png o --fog 2,1", "--fog: begins at 2 and should end farther away than 1"),
        ("s.json --png o --fog 2", "--fog: 2 is not auto or START,END"),
        ("s.json --png o --fog 1,2,thick", "--fog: 1,2,thick is not auto or START,END"),
        (
            "s.json --png o --fog -9,-8",
            "fog: -9 to -8 is not where the scene is: its vertices are -0.5 to 0 before",
        ),
        ("s.json --png o --fog 0,0.0001", "fog: the fog spans 3 of 65535 steps of depth"),
    ] {
        let words: Vec<_> = line.split_whitespace().collect();
        let said = refusal(&RENDER.run_in(&to.0, &words));
        assert!(said.contains(named), "{line}: {said}");
        assert_eq!(fs::read_dir(&to.0).unwrap().count(), 2, "{line}");
    }
    assert!(RENDER.run(&["--help"]).status.success(), "help is no error");
}
