//! Ids, depths, colours and texels of scenes: meshes of every form, cameras, light, fog, textures, and numbers far apart.

use crate::harness::{changed, mix, scene, with, Folder, RENDER};
use pinhole_apps_support::testing::{input_is_not_overwritten, refusal};
use serde_json::{json, Value};

fn teapot() -> String {
    format!("{}/../../assets/teapot.obj", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn ids_and_depths_are_rows_of_little_endian_numbers() {
    let drawn = Folder::new("formats").draw(&scene(), &[]);
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
    assert_eq!(drawn.ids, expected);
    // z/w is 0 and −½: 65535·½ and 65535·¼, rounded.
    let steps = expected.iter().map(|id| [65_535, 32_768, 16_384][(id + 1) as usize]);
    assert!(drawn.depth.iter().zip(steps).all(|(a, b): (_, u16)| a.abs_diff(b) <= 1), "{:?}", drawn.depth);
}

/// In files of every format, whose paths count from the scene's own folder, and with what is ignored.
#[test]
fn meshes_of_every_form_are_one_scene() {
    let to = Folder::new("meshes");
    let (given, plain) = (scene(), to.draw(&scene(), &[]).ids);
    let list = |field: &str| given[field].as_array().unwrap().clone();
    let vertex = |v: &Value| [0, 1, 2].map(|i| v[i].as_f64().unwrap().to_string()).join(" ");
    let mut obj: String = list("vertices").iter().map(|v| format!("v {}\n", vertex(v))).collect();
    let mut stl = String::from("solid s\n");
    for t in list("triangles") {
        let corners = [0, 1, 2].map(|k| t[k].as_u64().unwrap() as usize);
        obj += &format!("f {}\n", corners.map(|corner| (corner + 1).to_string()).join(" "));
        let corners: String = corners
            .iter()
            .map(|&corner| format!("vertex {}\n", vertex(&given["vertices"][corner])))
            .collect();
        stl += &format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n");
    }
    let about = json!({"name": "any \"name\"", "source": "", "licence": "MIT"});
    let lists = json!({"vertices": given["vertices"], "triangles": given["triangles"]});
    let lists = changed(about.clone(), lists).to_string();
    std::fs::create_dir(to.0.join("below")).unwrap();
    for (name, content) in [
        ("m.obj", obj),
        ("m.stl", stl + "endsolid s\n"),
        ("m.json", lists.clone()),
        ("below/m.json", format!("\u{feff}{lists}")),
    ] {
        to.write(name, content);
        let of_file = with(json!({"mesh": name, "vertices": null, "triangles": null}));
        assert_eq!(to.draw(&of_file, &[]).ids, plain, "{name}");
    }
    assert_eq!(to.draw(&with(about), &[]).ids, plain);
    to.write("marked.json", format!("\u{feff}{}", scene()));
    assert_eq!(to.draw_file("marked.json", &[]).ids, plain);
    let identity = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]);
    assert_eq!(to.draw(&with(json!({"model": identity, "width": 8.0})), &[]).ids, plain);
    let of_file = with(json!({"mesh": "m.json", "vertices": null, "triangles": null}));
    to.write("scene.json", of_file.to_string());
    input_is_not_overwritten(RENDER, &to.0, "m.json", "scene.json --used out --ids");
}

#[test]
fn a_mesh_of_more_vertices_than_16_bits_name_has_no_seams() {
    // A grid of 400 × 400 squares, two triangles each, over the whole picture.
    let n = 400;
    let vertices: Vec<_> =
        (0..=n).flat_map(|j| (0..=n).map(move |i| [i as f64 * 0.0031, j as f64 * 0.0031, 0.0])).collect();
    let triangles: Vec<_> = (0..n)
        .flat_map(|j| (0..n).map(move |i| j * (n + 1) + i))
        .flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]])
        .collect();
    let view = [[0.8, -0.6, 0.0, 0.0], [0.6, 0.8, 0.0, -0.9], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let large =
        json!({"vertices": vertices, "triangles": triangles, "view": view, "width": 150, "height": 150});
    let seen = Folder::new("large").draw(&with(large), &[]).ids;
    assert!(seen.iter().max().unwrap() > &300_000, "the last parts are there, too");
    // Each row is seen in one piece.
    for row in seen.chunks(150) {
        let changes = row.windows(2).filter(|w| (w[0] == -1) != (w[1] == -1)).count();
        assert!(changes <= 2, "{row:?}");
    }
}

#[test]
fn faces_have_the_colours_of_their_materials_unless_a_scene_has_its_own() {
    let to = Folder::new("scene_materials");
    to.write("m.mtl", "newmtl steel\nKd 0.6 0.6 0.6\nnewmtl red one\nKd 1 0 0\nKe 0 0 0.2\n");
    let vertices = "v -1 -1 0\nv 1 -1 0\nv -1 1 0\nv -1 -1 0.5\nv 0 -1 0.5\nv -1 0 0.5\n";
    to.write("m.obj", format!("mtllib m.mtl\n{vertices}usemtl steel\nf 1 2 3\nusemtl red one\nf 4 5 6\n"));
    let of_file = with(json!({"mesh": "m.obj", "vertices": null, "triangles": null}));
    let used = to.draw(&of_file, &[]).used;
    assert_eq!(used["colors"], json!([[153, 153, 153], [255, 0, 0]]));
    assert_eq!(used["emission"], json!([[0, 0, 0], [0, 0, 51]]));
    let own = json!([[1, 2, 3], [4, 5, 6]]);
    let used = to.draw(&changed(of_file, json!({"colors": own})), &[]).used;
    assert_eq!((&used["colors"], used.get("emission")), (&own, None));
    // A library is an input.
    let said = refusal(&RENDER.run_in(&to.0, &["scene.json", "--ids", "m.mtl"]));
    assert!(said.contains("m.mtl: is the input file"), "{said}");
}

#[test]
fn several_meshes_are_one_scene() {
    let to = Folder::new("several");
    // Each triangle of the scene is a mesh that lies elsewhere, in a file and in lists.
    to.write("far.obj", "v 0 1 2\nv 2 1 2\nv 0 3 2\nf 1 2 3\n");
    let place = |x: i32, y: i32, z: i32| json!([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]);
    let near = json!({"vertices": [[0, 0, 0], [2, 0, 0], [0, 2, 0]], "triangles": [[0, 1, 2]],
        "model": [[0.5, 0, 0, -1], [0, 0.5, 0, -1], [0, 0, 0.5, 0.5], [0, 0, 0, 1]], "colors": [[9, 8, 7]]});
    let far = json!({"mesh": "far.obj", "model": place(-1, -2, -2)});
    let meshes = with(json!({"meshes": [far, near], "vertices": null, "triangles": null}));
    let drawn = to.draw(&meshes, &[]);
    assert_eq!(drawn.ids, to.draw(&scene(), &[]).ids);
    // The one has the colour of a face without a material.
    assert_eq!(drawn.used["colors"], json!([[204, 204, 204], [9, 8, 7]]));
}

/// A point in the picture's coordinates from −1 to 1 and its depth, by the matrices of a scene.
fn projected(scene: &Value, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let after = |matrix: &Value, p: [f64; 4]| -> [f64; 4] {
        core::array::from_fn(|i| (0..4).map(|k| matrix[i][k].as_f64().unwrap() * p[k]).sum())
    };
    let [x, y, z, w] = after(&scene["projection"], after(&scene["view"], [x, y, z, 1.0]));
    assert!(w > 0.0, "behind the eye");
    [x / w, y / w, z / w]
}

#[test]
fn a_camera_is_an_eye_and_what_it_looks_at() {
    let to = Folder::new("eye");
    let of = |camera: Value| {
        let fields = json!({"camera": camera, "view": null, "projection": null, "width": 80, "height": 60});
        let drawn = to.draw(&with(fields), &[]);
        assert!(drawn.ids.iter().any(|&id| id >= 0));
        drawn.used
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
    let depth = |corner: &Value| projected(&used, [0, 1, 2].map(|i| corner[i].as_f64().unwrap()))[2];
    let mut depths: Vec<f64> = scene()["vertices"].as_array().unwrap().iter().map(depth).collect();
    depths.sort_by(f64::total_cmp);
    assert!(depths[0] > -1.0 && depths[5] < 1.0 && depths[5] - depths[0] > 1.0, "{depths:?}");
    // Depth by definition: −1 at near and 1 at far.
    let used = of(json!({"eye": [0, 0, 5], "target": target, "near": 2, "far": 8}));
    for (z, depth) in [(3.0, -1.0), (-3.0, 1.0)] {
        assert!((projected(&used, [0.0, 0.0, z])[2] - depth).abs() < 1e-6);
    }
}

/// By the camera's own projection: what the option of the same name draws of the mesh alone.
#[test]
fn a_camera_frames_the_scene_as_options_frame_a_mesh() {
    let to = Folder::new("framing");
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
        let mesh = teapot();
        let fixed = [&mesh, "--size", "90x70", "--ids", "mesh.ids"];
        assert!(RENDER.run_in(&to.0, &[&fixed, options].concat()).status.success());
        let wanted = to.read("mesh.ids");
        let wanted = wanted.as_chunks().0.iter().map(|bytes| i32::from_le_bytes(*bytes));
        // The model matrix moves the mesh, and the camera follows.
        let scene = json!({"mesh": teapot(), "camera": camera, "width": 90, "height": 70, "cull": "back",
            "model": [[2, 0, 0, 64], [0, 2, 0, -32], [0, 0, 2, 128], [0, 0, 0, 1]]});
        // Both round in their own coordinates, which moves an edge by less than 1/256 px.
        let differ = to.draw(&scene, &[]).ids.into_iter().zip(wanted).filter(|(a, b)| a != b).count();
        assert!(differ <= 3, "{differ} pixels differ with {camera}");
    }
}

/// Of numbers, 30 bits of the largest one are kept. One that is so large that nothing is left of what is seen is refused.
#[test]
fn numbers_that_take_all_bits_of_the_others_are_refused() {
    let to = Folder::new("out_of_range");
    // Perspective, near 1 and far 64, from 4 before the triangles.
    let before = |factor: f64, changes: Value| {
        let view = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4.0 * factor], [0, 0, 0, 1]]);
        let depth = [0.0, 0.0, -65.0 / 63.0, -128.0 / 63.0 * factor];
        let projection = json!([[2, 0, 0, 0], [0, 2.5, 0, 0], depth, [0, 0, -1, 0]]);
        let scene = json!({"view": view, "projection": projection, "width": 80, "height": 60});
        changed(with(scene), changes)
    };
    let floor = |size: f64| json!({"vertices": [[-size, -1, -size], [size, -1, -size], [0, -1, size], [0, 0, 9], [1, 0, 9], [0, 1, 9]]});
    let corner = json!([[1e30, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]);
    for (changes, named) in [
        (json!({"vertices": corner}), "vertices[0][0]: 1e30"),
        (floor(1e30), "vertices[2][2]: 1e30"),
        (json!({"sprites": [{"at": [[0, 0, 0], [1e30, 0, 0]], "color": [1, 2, 3]}]}), "sprites: 1e30"),
        (json!({"fog": [0, 1e30]}), "fog"),
    ] {
        let said = to.refused(&before(1.0, changes), &[]);
        assert!(said.contains(named), "{said}");
    }
    // Nothing is seen of this one, so nothing is lost.
    let away = json!({"model": [[1, 0, 0, 0], [0, 1, 0, 1e30], [0, 0, 1, 0], [0, 0, 0, 1]]});
    assert!(to.draw(&before(1.0, away), &[]).ids.iter().all(|&id| id < 0));
    // Large numbers alone are no fault, nor is a floor that ends far away.
    let wanted = to.draw(&before(1.0, json!({})), &[]).ids;
    assert!(wanted.iter().filter(|&&id| id >= 0).count() > 100);
    let factor = 2f64.powi(80);
    let vertices: Vec<Vec<f64>> = serde_json::from_value(scene()["vertices"].clone()).unwrap();
    let large: Vec<_> = vertices.iter().map(|v| v.iter().map(|c| c * factor).collect::<Vec<_>>()).collect();
    assert!(to.draw(&before(factor, json!({"vertices": large})), &[]).ids == wanted);
    assert!(to.draw(&before(1.0, floor(1e6)), &[]).ids.contains(&0));
}

const SKY: [u8; 3] = [0, 0, 255];
const FLAT: [&str; 4] = ["--mode", "flat", "--background", "#0000ff"];

/// The picture of a scene that fills it with two squares, one behind the other.
fn squares(to: &Folder, changes: Value, options: &[&str]) -> Vec<[u8; 3]> {
    let square = |z: f64| [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
    let (near, far) = ([200, 100, 0], [40, 80, 120]);
    let vertices = [square(0.5), square(0.0)].concat();
    let scene = json!({
        "vertices": vertices,
        // The near one comes first, so that blending must sort.
        "triangles": [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        "colors": [near, near, far, far], "width": 16, "height": 8
    });
    to.draw(&changed(with(scene), changes), &[&FLAT, options].concat()).picture
}

#[test]
fn lights_are_those_of_the_scene() {
    let to = Folder::new("lights");
    let lit = |lights: &Value| -> [u8; 3] {
        let scene = json!({"lights": lights, "colors": [[200, 100, 50], [200, 100, 50]]});
        to.draw(&with(scene), &FLAT).picture[5 * 8 + 1]
    };
    let usual = lit(&Value::Null);
    assert_eq!(lit(&json!(["key", "fill", "ambient"])), usual);
    let [key, fill, ambient] = ["key", "fill", "ambient"].map(|name| u32::from(lit(&json!([name]))[0]));
    assert!((key + fill + ambient).abs_diff(usual[0].into()) <= 2 && key > fill && fill > 0 && ambient > 0);
    // The faces look along z. Levels by Lambert's law, within one of 256.
    let near = |color: [u8; 3], level: f64| {
        let full = [200.0, 100.0, 50.0].into_iter().zip(color);
        full.into_iter().all(|(full, is)| (f64::from(is) - full * level / 256.0).abs() <= 1.3)
    };
    for (lights, level) in [
        (json!([]), 0.0),
        (json!([{"ambient": 128}]), 128.0),
        (json!([{"towards": [0, 0, 1], "level": 256}]), 256.0),
        (json!([{"towards": [0, 3, 3], "level": 256}]), 256.0 * 0.5f64.sqrt()),
        (json!([{"towards": [0, 0, -1], "level": 256}]), 0.0),
        (json!([{"towards": [0, 0, 2], "level": 100}, {"ambient": 28}]), 128.0),
        (json!([{"towards": [0, 0, 1], "from": "camera", "level": 64}, {"ambient": 256}]), 256.0),
    ] {
        let color = lit(&lights);
        assert!(near(color, level), "{lights}: {color:?}");
    }
    // A lamp of the camera moves with it, a lamp of the world does not: seen from the side, (1, 0, 0) is right of the camera.
    for (from, level) in [("world", 256.0), ("camera", 256.0 * 0.6)] {
        let turned = json!({"lights": [{"towards": [0, 0, 1], "from": from, "level": 256}],
            "colors": [[200, 100, 50], [200, 100, 50]],
            "view": [[0.6, 0, -0.8, 0], [0, 1, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 0, 1]],
            "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.2, 0], [0, 0, 0, 1]]});
        let picture = to.draw(&with(turned), &FLAT).picture;
        assert!(near(picture.into_iter().find(|color| color[0] > 0).unwrap(), level), "{from}");
    }
}

#[test]
fn faces_may_emit_light() {
    let to = Folder::new("emission");
    // Two triangles beside each other, of one colour.
    let scene = with(json!({
        "vertices": [[-1, -1, 0], [0, -1, 0], [0, 1, 0], [0, -1, 0], [1, -1, 0], [1, 1, 0]],
        "colors": [[200, 100, 40], [200, 100, 40]], "width": 16, "height": 8
    }));
    let emission = [0, 90, 251];
    let lamp = changed(scene.clone(), json!({"emission": [[0, 0, 0], emission]}));
    for mode in ["flat", "solid"] {
        let drawn = |scene: &Value, options: &[&str]| {
            let pixels = to.draw(scene, &[&["--mode", mode], options].concat()).picture;
            [pixels[5 * 16 + 6], pixels[5 * 16 + 14]]
        };
        let [dark, _] = drawn(&scene, &[]);
        assert!(dark[0] > 20 && dark[0] < 200, "{dark:?}");
        // Light is added whole after the other is rounded: levels of eight bits.
        let wanted = [0, 1, 2].map(|i| (u16::from(dark[i]) + emission[i]).min(255) as u8);
        assert_eq!(drawn(&lamp, &[]), [dark, wanted], "{mode}");
        // A colour that is asked for replaces both.
        assert_eq!(drawn(&lamp, &["--colour", "#c86428"]), [dark; 2], "{mode}");
    }
}

#[test]
fn faces_may_be_translucent() {
    let to = Folder::new("translucent");
    let draw = |options: &[&str]| squares(&to, json!({}), options);
    let opaque = draw(&[]);
    let near = opaque[0];
    assert!(opaque.iter().all(|&pixel| pixel == near));
    // A door of nothing, of everything, and of half of the pixels, in a chequered pattern.
    assert!(draw(&["--door", "0"]).iter().all(|&pixel| pixel == SKY));
    assert_eq!(draw(&["--door", "64"]), opaque);
    for (at, pixel) in draw(&["--door", "32"]).into_iter().enumerate() {
        assert_eq!(pixel, if (at % 16 + at / 16) % 2 == 0 { near } else { SKY }, "{at}");
    }
    // The far one over the sky, and the near one over both. Both have the light of the near one: its ratio is that of their colours.
    let far = [near[0] / 5; 3];
    for (options, alpha) in [
        (&["--alpha", "0"][..], 0),
        (&["--alpha", "8"], 8),
        (&["--alpha", "20"], 20),
        (&["--alpha", "32"], 32),
        (&["--half"], 16),
    ] {
        let [red, _, _] = mix(near, mix(far, SKY, alpha), alpha);
        assert!(draw(options).iter().all(|pixel| pixel[0].abs_diff(red) <= 1), "{options:?}");
    }
    // In every pixel format.
    for format in ["rgb565", "rgb666", "gray8", "gray4", "gray2", "mono"] {
        let plain = ["--format", format, "--no-dither"];
        assert_eq!(draw(&[&plain[..], &["--alpha", "32"]].concat()), draw(&plain), "{format}");
    }
}

/// Fog of the background's colour, by definition: the near square is a quarter of the way from −1 to 1 before the camera.
#[test]
fn faces_may_be_in_fog() {
    let to = Folder::new("fog");
    let near = squares(&to, json!({}), &[])[0];
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
        let drawn = squares(&to, json!({}), &["--fog", fog]);
        assert!(drawn.iter().all(|&pixel| pixel == mix(near, SKY, factor)), "{fog}: {:?}", drawn[0]);
    }
    // A scene's own fog, which --fog replaces.
    let own = json!({"fog": [-1, 1]});
    assert_eq!(squares(&to, own.clone(), &[])[0], mix(near, SKY, 24));
    assert_eq!(squares(&to, own, &["--fog", "0,1"])[0], near);
}

#[test]
fn lines_may_be_smooth() {
    let to = Folder::new("smooth");
    for mode in ["wireframe", "hidden-line"] {
        let fixed = ["--colour", "black", "--background", "white", "--mode", mode];
        let draw = |options: &[&str]| to.draw(&scene(), &[&fixed, options].concat()).picture;
        let (plain, smooth) = (draw(&[]), draw(&["--smooth-lines"]));
        let grey = |pixels: &[[u8; 3]]| pixels.iter().filter(|pixel| ![0, 255].contains(&pixel[0])).count();
        assert!(grey(&plain) == 0 && grey(&smooth) > 5, "{mode}");
        // As much ink, but for diagonals, which are √2 as long as they have pixels.
        let ink = |pixels: &[[u8; 3]]| pixels.iter().map(|pixel| 255 - u32::from(pixel[0])).sum::<u32>();
        assert!(2 * ink(&smooth) > ink(&plain) && ink(&smooth) < 2 * ink(&plain), "{mode}");
    }
}

/// A square of two triangles that fills a picture of 16 × 16, with 16 × 8 texels on it.
pub(crate) fn textured(changes: Value) -> Value {
    let scene = json!({
        "vertices": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
        "triangles": [[0, 1, 2], [0, 2, 3]],
        "uv": [[0, 8], [16, 8], [16, 0], [0, 0]],
        "texture": [16, 8], "width": 16, "height": 16
    });
    changed(with(scene), changes)
}

/// The picture of a texture.
fn picture_of_texels(column: u32, row: u32) -> [u8; 4] {
    [column as u8 * 16, row as u8 * 32, 99, 255]
}

#[test]
fn texels_are_numbered_row_by_row() {
    let to = Folder::new("texels");
    let texels = |changes: Value| to.draw(&textured(changes), &[]).texels;
    // Pixel (i, j) has u = i + ½ and v = (j + ½)/2, in column i and row j/2.
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| (1 << 15) | (j / 2 * 16 + i))).collect();
    let corners = [[[0, 8], [16, 8], [16, 0]], [[0, 8], [16, 0], [0, 0]]];
    for changes in [
        json!({}),
        json!({"uv": corners, "wrap": "repeat"}),
        // Three pictures to the left, and one down: rounded down below zero, too.
        json!({"uv": [[-48, 16], [-32, 16], [-32, 8], [-48, 8]]}),
    ] {
        assert_eq!(texels(changes.clone()), expected, "{changes}");
    }
    // Nothing is drawn where the triangle is not.
    let half = texels(json!({"uv": [corners[0]], "triangles": [[0, 1, 2]]}));
    assert_eq!(half.iter().filter(|&&number| number == 0).count(), 16 * 15 / 2);
    assert!(half.iter().zip(&expected).all(|(&a, &b)| a == 0 || a == b));
    // The edge of a clamped picture continues: one picture to the left and to the right, half a picture above and below.
    // Pixel (i, j) has u = 3·(i + ½) − 16 and v = j + ½ − 4.
    let column = |i: i32| (3 * i + 1 - 16).clamp(0, 15);
    let row = |j: i32| (j - 4).clamp(0, 7);
    let expected: Vec<u16> =
        (0..16).flat_map(|j| (0..16).map(move |i| 1 << 15 | (16 * row(j) + column(i)) as u16)).collect();
    let clamped = json!({"uv": [[-16, 12], [32, 12], [32, -4], [-16, -4]], "wrap": "clamp"});
    assert_eq!(texels(clamped), expected);
}

#[test]
fn a_picture_is_a_texture_which_may_be_lit() {
    let to = Folder::new("picture");
    to.png("texture.png", [16, 8], picture_of_texels);
    let scene = textured(json!({"texture": "texture.png"}));
    let drawn = to.draw(&scene, &[]);
    assert_eq!(drawn.texels[16 * 15 + 15], 1 << 15 | 127);
    for (index, pixel) in (0..).zip(&drawn.picture) {
        assert_eq!(pixel[..], picture_of_texels(index % 16, index / 32)[..3], "{index}");
    }
    // A white face of the same scene shows the light.
    let white = textured(json!({"uv": null, "texture": null}));
    let light = to.draw(&white, &["--mode", "flat", "--colour", "white"]).picture;
    assert!(light[0][0] > 60 && light[0][0] < 250);
    let lit = to.draw(&scene, &["--lit-texture"]).picture;
    for ((plain, lit), light) in drawn.picture.iter().zip(&lit).zip(&light) {
        for channel in 0..3 {
            let exact = f64::from(plain[channel]) * f64::from(light[channel]) / 255.0;
            assert!((f64::from(lit[channel]) - exact).abs() <= 1.5, "{plain:?} in {light:?}: {lit:?}");
        }
    }
}
