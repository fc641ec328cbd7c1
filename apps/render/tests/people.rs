//! What `pinhole-render` draws for people: pictures without any option, projections, colours, films, text.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::Angle;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::testing::{refusal, Program};
use pinhole_render::firmware;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const RENDER: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-render"), env!("CARGO_TARGET_TMPDIR"));

/// A box from 0 to (a, b, c); its first two triangles are the front, at z = c.
fn cuboid([a, b, c]: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let vertices = (0..8)
        .map(|i| {
            [
                if i & 1 > 0 { a } else { 0.0 },
                if i & 2 > 0 { b } else { 0.0 },
                if i & 4 > 0 { c } else { 0.0 },
            ]
        })
        .collect();
    let sides = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
    (vertices, sides.iter().flat_map(|&[p, q, r, s]| [[p, q, r], [p, r, s]]).collect())
}

fn obj(size: [f64; 3]) -> String {
    let (vertices, faces) = cuboid(size);
    let vertices = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = faces.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    vertices.chain(faces).collect()
}

fn stl(size: [f64; 3]) -> String {
    let (vertices, faces) = cuboid(size);
    let vertex = |i: usize| format!("vertex {} {} {}\n", vertices[i][0], vertices[i][1], vertices[i][2]);
    let facet = |f: &[usize; 3]| {
        let corners: String = f.iter().map(|&i| vertex(i)).collect();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    format!("solid box\n{}endsolid box\n", faces.iter().map(facet).collect::<String>())
}

fn write(folder: &Path, name: &str, text: String) -> PathBuf {
    let file = folder.join(name);
    fs::write(&file, text).unwrap();
    file
}

fn teapot() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/teapot.obj")
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Asserts that nothing else is said than what the importer doubts.
fn no_more_than_warnings(done: &std::process::Output, file: &Path) {
    let start = format!("{}: warning: ", file.display());
    let said = String::from_utf8(done.stderr.clone()).unwrap();
    assert!(said.lines().all(|line| line.starts_with(&start)), "{said}");
}

struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    fn read(file: &Path) -> Self {
        let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(file).unwrap()));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        let pixels = bytes.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    /// What a command line draws.
    fn of(name: &str, file: &Path, options: &[&str]) -> Self {
        let png = RENDER.folder("people", name).join("p.png");
        let done = RENDER.run(&[&[text(file), "--png", text(&png)], options].concat());
        assert!(done.status.success(), "{done:?}");
        no_more_than_warnings(&done, file);
        Self::read(&png)
    }

    fn colors(&self) -> BTreeSet<[u8; 3]> {
        self.pixels.iter().copied().collect()
    }

    /// Which pixels are not as the corner is.
    fn drawn(&self) -> Vec<bool> {
        self.pixels.iter().map(|c| *c != self.pixels[0]).collect()
    }
}

/// Columns and rows in which something is: the first, and the first behind it.
fn extent(drawn: &[bool], width: usize) -> [[usize; 2]; 2] {
    let height = drawn.len() / width;
    let ends = |all: Vec<usize>| [all[0], all[all.len() - 1] + 1];
    let columns = (0..width).filter(|&x| (0..height).any(|y| drawn[y * width + x])).collect();
    let rows = (0..height).filter(|&y| (0..width).any(|x| drawn[y * width + x])).collect();
    [ends(columns), ends(rows)]
}

#[test]
fn a_model_alone_becomes_a_picture_that_it_fills() {
    let to = RENDER.folder("people", "alone");
    write(&to, "tall.stl", stl([1.0, 1.0, 3.0]));
    let done = RENDER.run_in(&to, &["tall.stl", "--frame", "outline"]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let said = String::from_utf8(done.stdout).unwrap();
    assert!(said.contains("target/render/tall.png") && said.contains("640 x 480"), "{said}");
    assert!(
        said.contains("tall.stl: in firmware: 8 vertices, 12 faces, 18 edges; 264 bytes of flash"),
        "{said}"
    );
    let picture = Picture::read(&to.join("target/render/tall.png"));
    assert_eq!((picture.width, picture.height), (640, 480));
    // Twelve sides of which three show, each in one colour, before one background.
    assert_eq!(picture.colors().len(), 4);
    let [[left, right], [top, bottom]] = extent(&picture.drawn(), 640);
    // z is up in a file for 3D printers: it is higher than wide, in the middle, and fills 92 of 100 rows.
    assert!(bottom - top > 3 * (right - left) / 2, "{left} {right} {top} {bottom}");
    assert!((bottom - top).abs_diff(480 * 92 / 100) <= 2, "{top} {bottom}");
    assert!(top.abs_diff(480 - bottom) <= 2 && left.abs_diff(640 - right) <= 2, "{left} {right}");
    // In the sphere's frame, the default, it is smaller: half its diagonal, √11/2, is the radius.
    assert!(RENDER.run_in(&to, &["tall.stl"]).status.success());
    let picture = Picture::read(&to.join("target/render/tall.png"));
    let [[left, right], [upper, lower]] = extent(&picture.drawn(), 640);
    assert!(upper > 240 / 32 && lower < 480 - 240 / 32 && right - left < lower - upper);
    // From 20 degrees above 3 is seen as 2.82 at least, 2√(11/4) = 3.32 fill 31/32 of the height.
    assert!(lower - upper > 480 * 80 / 100, "{upper} {lower}");
    // Otherwise said, it lies.
    let lying = Picture::of("lying", &to.join("tall.stl"), &["--up", "y", "--size", "80x60"]);
    let [[left, right], [top, bottom]] = extent(&lying.drawn(), 80);
    assert!(right - left > bottom - top);
    // Of its name only the last extension goes.
    write(&to, "tall.v2.obj", obj([1.0; 3]));
    assert!(RENDER.run_in(&to, &["tall.v2.obj", "--size", "9x9"]).status.success());
    assert!(to.join("target/render/tall.v2.png").exists());
    // A scene has its outputs named, as before: nothing is written.
    let (vertices, triangles) = cuboid([1.0; 3]);
    let identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
    let scene = serde_json::json!({"vertices": vertices, "triangles": triangles, "model": identity,
        "view": identity, "projection": identity, "width": 8, "height": 8});
    write(&to, "scene.json", scene.to_string());
    let done = RENDER.run_in(&to, &["scene.json"]);
    assert!(String::from_utf8(done.stdout).unwrap().contains("nothing was written"));
    assert!(!to.join("target/render/scene.png").exists());
}

#[test]
fn doubts_are_the_importer_s_and_options_mend_them() {
    // The box with its front reversed: 4 of its edges, the first with triangle 3, lie between opposite windings.
    let text = stl([1.0, 1.0, 3.0]);
    let mut facets: Vec<String> = text.split_inclusive("endfacet\n").map(String::from).collect();
    for facet in &mut facets[..2] {
        let mut lines: Vec<_> = facet.lines().collect();
        let vertex = lines.iter().position(|line| line.starts_with("vertex")).unwrap();
        lines.swap(vertex, vertex + 1);
        *facet = lines.join("\n") + "\n";
    }
    let to = RENDER.folder("people", "doubts");
    let (sound, mixed) = (write(&to, "sound.stl", text), write(&to, "mixed.stl", facets.concat()));
    let draw = |file: &Path, options: &[&str]| {
        let png = to.join("p.png");
        let done = RENDER.run(&[&[self::text(file), "--png", self::text(&png)], options].concat());
        assert!(done.status.success(), "{done:?}");
        (Picture::read(&png).pixels, String::from_utf8(done.stderr).unwrap())
    };
    let (right, said) = draw(&sound, &[]);
    assert_eq!(said, "");
    let (wrong, said) = draw(&mixed, &[]);
    let line = said
        .strip_prefix(&format!("{}: warning: edges between faces of opposite winding: 4, ", mixed.display()));
    assert!(
        line.is_some_and(|rest| rest.ends_with("use --fix-winding\n") && rest.lines().count() == 1),
        "{said}"
    );
    assert!(wrong != right);
    for option in ["--fix-winding", "--two-sided"] {
        let (pixels, said) = draw(&mixed, &[option]);
        assert!(pixels == right && said.is_empty(), "{option}: {said}");
    }
    // Of a refusal nothing but the refusal is said.
    refusal(&RENDER.run(&[self::text(&mixed), "--png", self::text(&to)]));
}

#[test]
fn colours_are_those_that_were_named() {
    let file = write(&RENDER.folder("people", "colours"), "cube.obj", obj([1.0; 3]));
    let small = ["--size", "60x40"];
    let of = |name, options: &[&str]| Picture::of(name, &file, &[&small, options].concat());
    let red = of("red", &["--colour", "red", "--background", "#102030"]);
    assert_eq!((red.width, red.height, red.pixels[0]), (60, 40, [16, 32, 48]));
    let (paper, lit): (Vec<[u8; 3]>, Vec<[u8; 3]>) = red.pixels.iter().partition(|c| **c == [16, 32, 48]);
    assert!(paper.len() > 400 && lit.len() > 400 && lit.iter().all(|c| c[0] > 40 && c[1..] == [0, 0]));
    for (name, colour) in
        [("DarkSeaGreen", [143, 188, 143]), ("slate-grey", [112, 128, 144]), ("#fd0", [255, 221, 0])]
    {
        let picture = of("named", &["--color", name, "--background", "BLACK", "--mode", "wireframe"]);
        assert_eq!(picture.colors(), [[0; 3], colour].into(), "{name}");
    }
}

#[test]
fn materials_are_shown_unless_a_colour_is_named() {
    // The front (the first two triangles) is red, the right side blue, the rest has no material.
    let to = RENDER.folder("people", "materials");
    write(&to, "m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n".into());
    let text = obj([1.0; 3]);
    let (vertices, faces) = text.split_at(text.find('f').unwrap());
    let faces: Vec<&str> = faces.split_inclusive('\n').collect();
    let text = format!(
        "mtllib m.mtl\n{vertices}usemtl red\n{}{}usemtl none\n{}usemtl blue\n{}usemtl none\n{}",
        faces[0],
        faces[1],
        faces[2..4].concat(),
        faces[4..6].concat(),
        faces[6..].concat()
    );
    let file = write(&to, "m.obj", text);
    let png = to.join("p.png");
    let flags = ["--size", "60x60", "--mode", "flat", "--png", self::text(&png)];
    let run = |file: &Path, more: &[&str]| {
        let done = RENDER.run(&[&[self::text(file)], more].concat());
        assert!(done.status.success(), "{done:?}");
    };
    run(&file, &flags);
    let picture = Picture::read(&png);
    // Sides are lit: of red some red, of blue some blue; the top has the grey of no material.
    let kinds = |picture: &Picture| {
        let of = |colour: &[u8; 3]| match *colour {
            [r, 0, 0] if r > 40 => "red",
            [0, 0, b] if b > 40 => "blue",
            [r, g, b] if r == g && g == b => "grey",
            _ => "paper",
        };
        picture.colors().iter().map(of).collect::<BTreeSet<_>>()
    };
    assert_eq!(picture.colors().len(), 4);
    assert_eq!(kinds(&picture), ["blue", "grey", "paper", "red"].into());
    // A colour that is named is that of all faces, and so it is for lines.
    run(&file, &[&flags[..], &["--colour", "red"]].concat());
    assert_eq!(kinds(&Picture::read(&png)), ["paper", "red"].into());
    // A library is an input.
    let said = refusal(&RENDER.run(&[self::text(&file), "--png", self::text(&to.join("m.mtl"))]));
    assert!(said.contains("m.mtl: is the input file"), "{said}");
}

#[test]
fn formats_have_no_other_colours() {
    let of = |name, options: &[&str]| Picture::of(name, &teapot(), &[&["--size", "80x60"], options].concat());
    let grey = |options: &[&str], step: u8| {
        let met = of("grey", options).colors();
        assert!(met.iter().all(|[r, g, b]| r == g && g == b && r % step == 0), "{met:?}");
        met.len()
    };
    assert!(grey(&["--format", "gray8"], 1) > 16);
    assert!(grey(&["--format", "gray4"], 17) > 4);
    assert_eq!(grey(&["--format", "gray2"], 85), 4);
    assert_eq!(grey(&["--format", "mono"], 255), 2);
    let (dithered, nearest) =
        (of("mono", &["--format", "mono"]), of("mono", &["--format", "mono", "--no-dither"]));
    // Dither has single pixels; the nearest colours are areas.
    let changes = |p: &Picture| p.pixels.windows(2).filter(|two| two[0] != two[1]).count();
    assert!(changes(&dithered) > 4 * changes(&nearest));
    // 31 and 63 levels.
    let level = |v: u8, most: u32| (0..=most).any(|n| (n * 510 + most) / (2 * most) == u32::from(v));
    let met = of("rgb565", &["--format", "rgb565"]).colors();
    assert!(met.iter().all(|&[r, g, b]| level(r, 31) && level(g, 63) && level(b, 31)), "{met:?}");
}

#[test]
fn modes_are_what_they_say() {
    let cube = write(&RENDER.folder("people", "modes"), "cube.stl", stl([1.0; 3]));
    let of = |file: &Path, mode: &str| Picture::of(mode, file, &["--size", "100x80", "--mode", mode]);
    // A cube's sides are flat, its edges sharp: three colours and the background.
    let flat = of(&cube, "flat");
    assert_eq!(flat.colors().len(), 4);
    assert!(of(&cube, "solid").pixels == flat.pixels);
    assert!(of(&cube, "gouraud").colors().len() > 20);
    let smooth = of(&teapot(), "solid");
    assert!(smooth.colors().len() > of(&teapot(), "flat").colors().len());
    // Hidden lines are missing: the three edges at the far corner and the diagonals of the three far sides.
    let (wire, less) = (of(&cube, "wireframe").drawn(), of(&cube, "hidden-line").drawn());
    assert!(wire.iter().zip(&less).all(|(wire, less)| *wire || !less));
    let count = |drawn: &[bool]| drawn.iter().filter(|d| **d).count();
    assert!(count(&less) < count(&wire) * 3 / 4 && count(&less) > count(&wire) / 4);
    // Of a cube's edges no mode of lines but the wireframe has the six diagonals, unless it is asked for all; its sides meet at 90
    // degrees.
    let edges = |file: &Path, mode: &str, options: &[&str]| -> u32 {
        let done = RENDER.run(&[&[text(file), "--mode", mode, "--stats"], options].concat());
        assert!(done.status.success(), "{done:?}");
        let said = String::from_utf8(done.stdout).unwrap();
        said.split("; of ").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok()).expect("a count")
    };
    assert_eq!([edges(&cube, "wireframe", &[]), edges(&cube, "hidden-line", &[])], [18, 12]);
    assert_eq!(edges(&cube, "hidden-line", &["--edges", "all"]), 18);
    assert_eq!(edges(&cube, "wireframe", &["--edges", "feature"]), 12);
    assert_eq!(edges(&cube, "wireframe", &["--feature-angle", "89"]), 12);
    // Hidden lines have the outline in any case: six edges lie between the three sides that are seen and those that are not.
    let blunt = ["--edges", "feature", "--feature-angle", "91"];
    assert_eq!([edges(&cube, "hidden-line", &blunt), edges(&cube, "wireframe", &blunt)], [6, 0]);
    // The back of a sheet, which lies beside its front, makes no edge of a diagonal.
    let sheet = write(
        &RENDER.folder("people", "sheet"),
        "sheet.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n".into(),
    );
    let of_sheet = |mode| edges(&sheet, mode, &["--edges", "feature", "--two-sided"]);
    assert_eq!(["wireframe", "hidden-line"].map(of_sheet), [4, 4]);
    // The lines lie inside the outline, or outside by half a line's width: half a pixel.
    let [a, b] = [flat.drawn(), less].map(|drawn| extent(&drawn, 100));
    assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| a.abs_diff(*b) <= 1), "{a:?} {b:?}");
}

/// A ring, inside out, with 64 sides that turn by 5.6 degrees: its only features are its four rims.
#[test]
fn hidden_lines_show_the_outline_of_a_round_body() {
    let sides = 64;
    let vertex = |i: usize, [radius, y]: [f64; 2]| {
        let (sin, cos) = (i as f64 / sides as f64 * core::f64::consts::TAU).sin_cos();
        format!("v {} {y} {}\n", radius * cos, radius * sin)
    };
    let rims = [[1.0, 0.0], [1.0, 0.4], [0.85, 0.4], [0.85, 0.0]];
    let vertices: String = (0..sides).flat_map(|i| rims.map(|rim| vertex(i, rim))).collect();
    let at = |i: usize, rim: usize| i % sides * 4 + rim % 4 + 1;
    let face = |i: usize, rim: usize| {
        format!("f {} {} {} {}\n", at(i, rim), at(i + 1, rim), at(i + 1, rim + 1), at(i, rim + 1))
    };
    let faces: String = (0..sides).flat_map(|i| (0..4).map(move |rim| face(i, rim))).collect();
    let file = write(&RENDER.folder("people", "round"), "ring.obj", vertices + &faces);
    let view = ["--flip", "--size", "160x120"];
    let of = |mode: &[&str]| Picture::of("ring", &file, &[&view, mode].concat()).drawn();
    let body = of(&["--mode", "flat"]);
    let lines = of(&["--mode", "hidden-line", "--edges", "feature"]);
    // At both ends of each row of the body a line is at most a pixel away, in that row or the next, but for the gaps of lines that
    // are almost hidden.
    let near = |x: usize, y: usize| {
        (y.saturating_sub(1)..=y + 1).any(|y| (x.saturating_sub(1)..=x + 1).any(|x| lines[y * 160 + x]))
    };
    let (mut ends, mut without) = (0, 0);
    for (y, row) in body.chunks(160).enumerate() {
        let first = row.iter().position(|drawn| *drawn);
        for x in first.into_iter().chain(row.iter().rposition(|drawn| *drawn)) {
            ends += 1;
            without += usize::from(!near(x, y));
        }
    }
    assert!(ends > 100 && without * 10 <= ends, "{without} of {ends} ends of rows have no line");
}

#[test]
fn lines_of_large_meshes_are_all_there() {
    // A grid of 150 × 150 squares has 45 000 triangles and more edges than 16 bits count: about one each pixel.
    let n = 150;
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| format!("v {i} {j} 0\n")));
    let faces = (0..n).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i + 1));
    let faces = faces.map(|a| format!("f {} {} {} {}\n", a, a + 1, a + n + 2, a + n + 1));
    let grid: String = vertices.chain(faces).collect();
    let file = write(&RENDER.folder("people", "grid"), "grid.obj", grid);
    for mode in ["wireframe", "hidden-line"] {
        let front = ["--projection", "front", "--frame", "outline", "--size", "80x80", "--edges", "all"];
        let picture = Picture::of(mode, &file, &[&front[..], &["--mode", mode]].concat());
        // 92 of 100 columns and rows, and each of their pixels has an edge.
        let drawn = picture.drawn().iter().filter(|drawn| **drawn).count();
        assert!(drawn.abs_diff(80 * 80 * 92 * 92 / 10_000) < 160, "{mode}: {drawn}");
        // 45 000 triangles are three times 21 845 at most; an edge where two parts meet is in both.
        let done =
            RENDER.run(&[text(&file), "--projection", "front", "--mode", mode, "--edges", "all", "--stats"]);
        let said = String::from_utf8(done.stdout).unwrap();
        assert!(said.contains(" edges (in 3 parts; edges between parts count twice) "), "{said}");
    }
}

#[test]
fn light_falls_on_the_side_that_is_seen() {
    // Two equal worlds: a box, and its mirror image, which the model matrix mirrors back.
    let to = RENDER.folder("people", "light");
    let draw = |name: &str, factor: f64| {
        let (vertices, triangles) = cuboid([0.8, 0.6, 0.5]);
        let vertices: Vec<_> = vertices.iter().map(|[x, y, z]| [x * factor, *y, *z]).collect();
        let scene = serde_json::json!({
            "vertices": vertices, "triangles": triangles,
            "model": [[factor, 0.0, 0.0, 0.0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
            "view": [[0.8, 0, -0.6, 0], [-0.36, 0.8, -0.48, 0], [0.48, 0.6, 0.64, 0], [0, 0, 0, 1]],
            "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.5, 0], [0, 0, 0, 1]],
            "width": 60, "height": 60
        });
        Picture::of(name, &write(&to, name, scene.to_string()), &[])
    };
    let (plain, mirrored) = (draw("plain.json", 1.0), draw("mirrored.json", -1.0));
    assert_eq!(plain.colors().len(), 4);
    assert!(plain.pixels == mirrored.pixels);
}

/// How long it stays, in 1/100 s, and its colours.
type Frame = (u16, Vec<[u8; 3]>);

/// The width and the frames of a film.
fn film(name: &str, file: &Path, options: &[&str]) -> (usize, Vec<Frame>) {
    let gif = RENDER.folder("people", name).join("film.gif");
    let done = RENDER.run(&[&[text(file), "--gif", text(&gif)], options].concat());
    assert!(done.status.success(), "{done:?}");
    no_more_than_warnings(&done, file);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(fs::File::open(&gif).unwrap()).unwrap();
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    let width = usize::from(decoder.width());
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!((frame.left, frame.top, usize::from(frame.width)), (0, 0, width));
        frames.push((frame.delay, frame.buffer.chunks(4).map(|c| [c[0], c[1], c[2]]).collect()));
    }
    (width, frames)
}

#[test]
fn a_film_goes_once_around() {
    let (width, frames) = film("teapot", &teapot(), &["--frames", "7", "--size", "64x48"]);
    assert_eq!((width, frames.len(), frames[0].1.len()), (64, 7, 64 * 48));
    assert_eq!(frames.iter().map(|(delay, _)| u32::from(*delay)).sum::<u32>(), 400);
    let different: BTreeSet<_> = frames.iter().map(|(_, pixels)| pixels).collect();
    assert_eq!(different.len(), 7);
    for (_, pixels) in &frames {
        // All of them show the whole mesh.
        let drawn: Vec<_> = pixels.iter().map(|c| *c != pixels[0]).collect();
        let [[left, right], [top, bottom]] = extent(&drawn, 64);
        assert!(left > 0 && right < 64 && top > 0 && bottom < 48);
    }
    // The film's usual size and number of frames.
    let (width, frames) = film("usual", &write(&RENDER.folder("people", "box"), "b.obj", obj([1.0; 3])), &[]);
    assert_eq!((width, frames.len(), frames[0].1.len()), (320, 36, 320 * 240));
    // A cube looks the same from its four sides: frames 0, 9, 18 and 27, but for rounding at edges.
    for quarter in [9, 18, 27] {
        let pairs = frames[0].1.iter().zip(&frames[quarter].1);
        let differ = pairs.filter(|(a, b)| a != b).count();
        assert!(differ < 100, "{differ} in frame {quarter}");
    }
    let differ = frames[0].1.iter().zip(&frames[4].1).filter(|(a, b)| a != b).count();
    assert!(differ > 2000, "{differ}");
}

/// Any frame of the firmware, and all of them as a film.
#[test]
fn firmware_is_shown_frame_by_frame() {
    let gear = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../boards/any-cortex-m/model.stl");
    let options = firmware::options(&firmware::TEMPLATE, &pinhole_import::Options::default());
    let model = pinhole_import::import(&gear, &options).unwrap();
    let wanted = |frame: i32, frames: u32| -> Vec<[u8; 3]> {
        let mut canvas = Canvas::new(Size::new(64, 48), Rgb565::MAGENTA);
        firmware::draw(&model, Angle::turns(frame, frames), &mut canvas).unwrap();
        let pixel = |color: &Rgb565| Rgb888::from(*color);
        canvas.pixels().iter().map(pixel).map(|c| [c.r(), c.g(), c.b()]).collect()
    };
    assert!(wanted(0, 120) != wanted(7, 120));
    for (option, frame) in [("--firmware", 0), ("--firmware=7", 7), ("--firmware=119", 119)] {
        let picture = Picture::of("frame", &gear, &[option, "--size", "64x48"]);
        assert!(picture.pixels == wanted(frame, 120), "{option}");
    }
    let (width, frames) = film("turn", &gear, &["--firmware", "--size", "64x48"]);
    assert_eq!((width, frames.len()), (64, 120));
    for (number, (_, pixels)) in (0..).zip(&frames) {
        assert!(*pixels == wanted(number, 120), "frame {number}");
    }
    let (_, frames) = film("few", &gear, &["--firmware", "--size", "64x48", "--frames", "5"]);
    assert!(frames.len() == 5 && frames[3].1 == wanted(3, 5));
}

#[test]
fn text_has_the_picture_s_shape() {
    let cube = write(&RENDER.folder("people", "text"), "cube.obj", obj([1.0; 3]));
    let print = |options: &[&str]| {
        let done = RENDER.run(&[&[text(&cube)], options].concat());
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        String::from_utf8(done.stdout).unwrap()
    };
    let shape = |said: &str, lines: usize, columns: usize| {
        let rows: Vec<Vec<char>> = said.lines().map(|line| line.chars().collect()).collect();
        assert_eq!(rows.len(), lines);
        assert!(rows.iter().all(|row| row.len() == columns), "{said}");
        rows
    };
    // 160 × 120 pixels, 2 × 4 of them a character.
    let rows = shape(&print(&["--ascii", "--projection", "front", "--frame", "outline"]), 30, 80);
    assert!(rows.iter().flatten().all(|c| " .:-=+*#%@".contains(*c)));
    // A square of 110 × 110 pixels, 92 of 100 of the height: 55 or 57 characters wide, 27 to 29 high.
    let drawn: Vec<_> = rows.iter().flatten().map(|c| *c != ' ').collect();
    let [[left, right], [top, bottom]] = extent(&drawn, 80);
    assert!((55..=57).contains(&(right - left)) && (27..=29).contains(&(bottom - top)), "{left} {right}");
    let inside = &rows[15][left + 1..right - 1];
    assert!(inside.iter().all(|c| *c == inside[0]), "a side has one light");
    let rows = shape(&print(&["--ascii=braille", "--size", "40x41", "--mode", "wireframe"]), 11, 20);
    assert!(rows.iter().flatten().all(|c| ('\u{2800}'..='\u{28ff}').contains(c)));
    assert!(rows.iter().flatten().any(|c| *c != '\u{2800}'));
    // With a file, too, it says so behind.
    let png = RENDER.folder("people", "text_and_file").join("p.png");
    let said = print(&["--ascii", "--png", text(&png)]);
    assert_eq!(said.lines().count(), 31);
    assert!(said.lines().last().unwrap().contains("p.png") && png.exists());
}

#[test]
fn messages_for_bad_options_name_the_alternatives() {
    let to = RENDER.folder("people", "wrong");
    let mesh = write(&to, "m.obj", obj([1.0; 3]));
    let gif = to.join("f.gif");
    let gif = text(&gif);
    for (options, parts) in [
        (
            &["--projection", "fish-eye"][..],
            &["--projection: fish-eye", "isometric", "one-point", "reverse"][..],
        ),
        (&["--mode", "points"], &["--mode: points", "solid", "hidden-line"]),
        (&["--format", "rgb332"], &["--format: rgb332", "rgb565", "mono"]),
        (&["--ascii=ansi"], &["--ascii: ansi", "ramp", "braille"]),
        (&["--colour", "bleu"], &["--colour: bleu", "#rrggbb", "blue", "rebeccapurple"]),
        (&["--background", "#12345"], &["--background: #12345", "6 or 3 hexadecimal digits"]),
        (&["--background", "#12345é"], &["--background: #12345é"]),
        (&["--from", "30"], &["--from: 30", "YAW,PITCH"]),
        (&["--from", "30,95"], &["--from: pitch: 95 is not from -90 to 90"]),
        (&["--from", "3,4", "--yaw", "5"], &["--from: ", "--yaw"]),
        (&["--projection", "two-point", "--pitch", "80"], &["--pitch: 80", "two-point"]),
        (&["--projection", "isometric", "--fov", "50"], &["--fov: isometric has no field of view"]),
        (&["--stats", "--colour", "red"], &["--colour: applies to pictures alone: give --png"]),
        (&["--ascii", "--no-dither"], &["--no-dither: applies to pictures alone"]),
        (&["--up", "w"], &["'w' for '--up <AXIS>'", "[possible values: x, y, z, -x, -y, -z]"]),
        (&["--frame", "box"], &["--frame: box", "sphere, outline"]),
        (&["--frames", "12"], &["--frames: ", "--gif"]),
        (&["--gif", gif, "--frames", "1"], &["--frames", "2..=360"]),
        (&["--gif", gif, "--png", gif], &["--gif: names the same file as --png"]),
        (&["--edges", "some"], &["--edges", "all, feature"]),
        (&["--edges", "feature"], &["--edges: needs --mode wireframe or hidden-line"]),
        (
            &["--mode", "wireframe", "--edges", "all", "--feature-angle", "9"],
            &["--feature-angle: is that of"],
        ),
        (&["--mode", "wireframe", "--feature-angle", "200"], &["--feature-angle: 200 is not from 0 to 180"]),
        (&["--firmware=120"], &["--firmware", "120 is not in 0..120"]),
        (&["--firmware", "--mode", "flat"], &["--firmware", "cannot be used with", "--mode"]),
        (&["--size", "640"], &["--size: 640", "320x240"]),
    ] {
        let said = refusal(&RENDER.run(&[&[text(&mesh)], options].concat()));
        assert!(parts.iter().all(|part| said.contains(part)), "{options:?}: {said}");
        assert_eq!(fs::read_dir(&to).unwrap().count(), 1, "{options:?}");
    }
    let scene = write(&to, "s.json", "{}".into());
    for option in [&["--gif", gif][..], &["--from", "1,2"], &["--frame", "sphere"]] {
        let said = refusal(&RENDER.run(&[&[text(&scene)], option].concat()));
        assert!(said.contains(option[0]) && said.contains("its own camera"), "{said}");
    }
    for option in [&["--up", "z"][..], &["--flip"], &["--fix-winding"], &["--two-sided"], &["--root", "."]] {
        let said = refusal(&RENDER.run(&[&[text(&scene)], option].concat()));
        assert!(said.contains(option[0]) && said.contains("drawn as it stands"), "{said}");
    }
}

/// A picture that the materials name is shown if it is asked for, in films, too; if not, a note says how to ask.
#[test]
fn a_model_s_picture_is_shown_where_it_is_asked_for() {
    let to = RENDER.folder("people", "picture");
    let mut encoder = png::Encoder::new(fs::File::create(to.join("skin.png")).unwrap(), 8, 8);
    encoder.set_color(png::ColorType::Rgb);
    let pixels: Vec<u8> = (0..64).flat_map(|i| if i % 8 < 4 { [255, 0, 0] } else { [0, 0, 255] }).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    fs::write(to.join("skin.mtl"), "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\n").unwrap();
    let model =
        "mtllib skin.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                 f 1/1 2/2 3/3 4/4\n";
    let (file, film) = (write(&to, "skin.obj", model.into()), to.join("film.gif"));
    let run = |options: &[&str]| {
        let done = RENDER.run(&[&[text(&file), "--two-sided", "--size", "64x48"], options].concat());
        (done.status.success(), String::from_utf8(done.stderr).unwrap())
    };
    let note = "warning: pictures of materials: 1, the first skin.png; left out: use --texture 16";
    let film_of = |options: &[&str]| {
        let fixed = ["--gif", text(&film), "--frames", "2"];
        let (is_done, said) = run(&[&fixed, options].concat());
        assert!(is_done, "{said}");
        let mut decoder = gif::DecodeOptions::new();
        decoder.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = decoder.read_info(fs::File::open(&film).unwrap()).unwrap();
        let frame = decoder.read_next_frame().unwrap().unwrap();
        let met = |color: [u8; 3]| frame.buffer.chunks(4).any(|pixel| pixel[..3] == color);
        (met([255, 0, 0]) && met([0, 0, 255]), said)
    };
    let (is_shown, said) = film_of(&[]);
    assert!(!is_shown && said.contains(note), "{said}");
    let (is_shown, said) = film_of(&["--texture", "4"]);
    assert!(is_shown && !said.contains("pictures"), "{said}");
    let (is_done, said) = run(&["--png", text(&to.join("out.png")), "--lit-texture"]);
    assert!(
        !is_done && said.contains("--lit-texture: no texture is shown: give --texture COLORS too"),
        "{said}"
    );
}
