//! What `pinhole-render` draws for people: pictures without any option, colours, films, text.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::Angle;
use pinhole_apps_support::bodies::{circle, cuboid, moved, obj, prism, stl};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::testing::{self, extent, refusal, Program};
use pinhole_render::firmware;
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

const RENDER: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-render"), env!("CARGO_TARGET_TMPDIR"));
const TEAPOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/teapot.obj");
const GEAR: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../boards/common/all/model.stl");

/// The folder of a test.
struct Folder(PathBuf);

struct Picture {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

/// How long a frame stays, in 1/100 s, and its colours.
type Frame = (u16, Vec<[u8; 3]>);

impl Folder {
    fn new(test: &str) -> Self {
        Self(RENDER.folder("people", test))
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.0.join(name), content).unwrap();
    }

    /// Runs a command line, separated by spaces, that succeeds. Returns what it said, and its warnings.
    fn run(&self, line: &str) -> (String, String) {
        let done = RENDER.run_in(&self.0, &line.split(' ').collect::<Vec<_>>());
        assert!(done.status.success(), "{line}: {done:?}");
        (String::from_utf8(done.stdout).unwrap(), String::from_utf8(done.stderr).unwrap())
    }

    /// What a command line draws.
    fn draw(&self, line: &str) -> Picture {
        self.run(&format!("{line} --png p.png"));
        self.picture("p.png")
    }

    fn picture(&self, name: &str) -> Picture {
        let ([width, _], pixels) = testing::picture(&self.0.join(name));
        Picture { width, pixels }
    }

    /// The width and the frames of the film of a command line, and the warnings.
    fn film(&self, line: &str) -> (usize, Vec<Frame>, String) {
        let (_, said) = self.run(&format!("{line} --gif film.gif"));
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(fs::File::open(self.0.join("film.gif")).unwrap()).unwrap();
        assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
        let width = usize::from(decoder.width());
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!((frame.left, frame.top, usize::from(frame.width)), (0, 0, width));
            frames.push((frame.delay, frame.buffer.chunks(4).map(|c| [c[0], c[1], c[2]]).collect()));
        }
        (width, frames, said)
    }
}

impl Picture {
    fn colors(&self) -> BTreeSet<[u8; 3]> {
        self.pixels.iter().copied().collect()
    }

    /// Which pixels are not as the corner is.
    fn drawn(&self) -> Vec<bool> {
        self.pixels.iter().map(|c| *c != self.pixels[0]).collect()
    }

    /// Columns and rows in which something is.
    fn extent(&self) -> [[usize; 2]; 2] {
        extent(&self.drawn(), self.width)
    }
}

/// What an installation sets up names the program and all of its options.
#[test]
fn an_installation_has_completions_and_a_man_page() {
    let folder = Folder::new("installation");
    let (version, _) = folder.run("--version");
    assert_eq!(version.trim(), format!("pinhole-render {}", env!("CARGO_PKG_VERSION")));
    for (line, heading, option) in [
        ("--completions bash", "complete -F _pinhole__render", "--smooth-faces"),
        ("--completions zsh", "#compdef pinhole-render", "--smooth-faces["),
        ("--man", ".TH pinhole-render 1", "smooth\\-faces"),
    ] {
        let (text, warnings) = folder.run(line);
        assert!(text.contains(heading) && text.contains(option) && warnings.is_empty(), "{line}: {text}");
    }
    let beside = RENDER.run_in(&folder.0, &["--man", "model.stl"]);
    assert_eq!(beside.status.code(), Some(2));
}

#[test]
fn a_model_alone_becomes_a_picture_that_it_fills() {
    let to = Folder::new("alone");
    to.write("tall.stl", stl(&cuboid([1.0, 1.0, 3.0])));
    let (said, warnings) = to.run("tall.stl --frame outline");
    assert!(said.contains("target/render/tall.png") && said.contains("640 x 480"), "{said}");
    let size = "tall.stl: in firmware: 8 vertices, 12 faces, 18 edges; 264 bytes of flash";
    assert!(said.contains(size) && warnings.is_empty(), "{said}{warnings}");
    let picture = to.picture("target/render/tall.png");
    // Twelve sides of which three show, each in one colour, before one background.
    assert_eq!((picture.width, picture.pixels.len(), picture.colors().len()), (640, 640 * 480, 4));
    let [[left, right], [top, bottom]] = picture.extent();
    // z is up in a file for 3D printers: it is higher than wide, in the middle, and fills 92 of 100 rows.
    assert!(bottom - top > 3 * (right - left) / 2, "{left} {right} {top} {bottom}");
    assert!((bottom - top).abs_diff(480 * 92 / 100) <= 2, "{top} {bottom}");
    assert!(top.abs_diff(480 - bottom) <= 2 && left.abs_diff(640 - right) <= 2, "{left} {right}");
    // In the sphere's frame, the default, it is smaller: half its diagonal, √11/2, is the radius.
    to.run("tall.stl");
    let [[left, right], [upper, lower]] = to.picture("target/render/tall.png").extent();
    assert!(upper > 240 / 32 && lower < 480 - 240 / 32 && right - left < lower - upper);
    // From 20 degrees above 3 is seen as 2.82 at least, 2√(11/4) = 3.32 fill 31/32 of the height.
    assert!(lower - upper > 480 * 80 / 100, "{upper} {lower}");
    // Otherwise said, it lies.
    let [[left, right], [top, bottom]] = to.draw("tall.stl --up y --size 80x60").extent();
    assert!(right - left > bottom - top);
    // Of its name only the last extension goes.
    to.write("tall.v2.obj", obj(&cuboid([1.0; 3])));
    to.run("tall.v2.obj --size 9x9");
    assert!(to.0.join("target/render/tall.v2.png").exists());
    // A scene has its outputs named: nothing is written.
    to.write("scene.json", r#"{"mesh": "tall.stl", "camera": {}, "width": 8, "height": 6}"#);
    let (said, _) = to.run("scene.json");
    assert!(said.contains("8 x 6 pixels") && said.contains("of 12 triangles "), "{said}");
    assert!(
        said.contains("nothing was written: give --png") && !to.0.join("target/render/scene.png").exists()
    );
    let (said, _) = to.run("scene.json --stats");
    assert!(said.contains(" px") && said.contains("nothing was written: give --png"), "{said}");
}

#[test]
fn colours_are_those_that_were_named() {
    let to = Folder::new("colours");
    to.write("cube.obj", obj(&cuboid([1.0; 3])));
    let red = to.draw("cube.obj --size 60x40 --colour red --background #102030");
    let (paper, lit): (Vec<[u8; 3]>, Vec<[u8; 3]>) = red.pixels.iter().partition(|c| **c == [16, 32, 48]);
    assert!(paper.len() > 400 && lit.len() > 400 && lit.iter().all(|c| c[0] > 40 && c[1..] == [0, 0]));
    for (name, colour) in
        [("DarkSeaGreen", [143, 188, 143]), ("slate-grey", [112, 128, 144]), ("#fd0", [255, 221, 0])]
    {
        let line = format!("cube.obj --size 60x40 --mode wireframe --background BLACK --color {name}");
        assert_eq!(to.draw(&line).colors(), [[0; 3], colour].into(), "{name}");
    }
}

#[test]
fn materials_are_shown_unless_a_colour_is_named() {
    // The front (the first two triangles) is red, the right side blue, the rest has no material.
    let to = Folder::new("materials");
    to.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    let text = obj(&cuboid([1.0; 3]));
    let faces: Vec<&str> = text.split_inclusive("-1\n").collect();
    let of = |name: &str, faces: &[&str]| format!("usemtl {name}\n{}", faces.concat());
    let parts =
        [of("red", &faces[..2]), of("none", &faces[2..4]), of("blue", &faces[4..6]), of("none", &faces[6..])];
    to.write("m.obj", format!("mtllib m.mtl\n{}", parts.concat()));
    // Sides are lit: of red some red, of blue some blue; the top has the grey of no material.
    let kinds = |options: &str| {
        let picture = to.draw(&format!("m.obj --size 60x60 --mode flat{options}"));
        let of = |colour: &[u8; 3]| match *colour {
            [r, 0, 0] if r > 40 => "red",
            [0, 0, b] if b > 40 => "blue",
            [r, g, b] if r == g && g == b => "grey",
            _ => "paper",
        };
        picture.colors().iter().map(of).collect::<BTreeSet<_>>()
    };
    assert_eq!(kinds(""), ["blue", "grey", "paper", "red"].into());
    // A colour that is named is that of all faces.
    assert_eq!(kinds(" --colour red"), ["paper", "red"].into());
    // A library is an input.
    let said = refusal(&RENDER.run_in(&to.0, &["m.obj", "--png", "m.mtl"]));
    assert!(said.contains("m.mtl: is the input file"), "{said}");
}

#[test]
fn formats_have_no_other_colours() {
    let to = Folder::new("formats");
    let of = |options: &str| to.draw(&format!("{TEAPOT} --size 80x60 --format {options}"));
    for (format, step, shades) in
        [("gray8", 1, 17..256), ("gray4", 17, 5..17), ("gray2", 85, 4..5), ("mono", 255, 2..3)]
    {
        let met = of(format).colors();
        assert!(met.iter().all(|[r, g, b]| r == g && g == b && r % step == 0), "{met:?}");
        assert!(shades.contains(&met.len()), "{format}: {met:?}");
    }
    // Dither has single pixels; the nearest colours are areas.
    let changes = |p: &Picture| p.pixels.windows(2).filter(|two| two[0] != two[1]).count();
    assert!(changes(&of("mono")) > 4 * changes(&of("mono --no-dither")));
    // 31 and 63 levels.
    let level = |v: u8, most: u32| (0..=most).any(|n| (n * 510 + most) / (2 * most) == u32::from(v));
    let met = of("rgb565").colors();
    assert!(met.iter().all(|&[r, g, b]| level(r, 31) && level(g, 63) && level(b, 31)), "{met:?}");
}

#[test]
fn modes_are_what_they_say() {
    let to = Folder::new("modes");
    to.write("cube.stl", stl(&cuboid([1.0; 3])));
    let of = |file: &str, mode: &str| to.draw(&format!("{file} --size 100x80 --mode {mode}"));
    // A cube's sides are flat, its edges sharp: three colours and the background.
    let flat = of("cube.stl", "flat");
    assert_eq!(flat.colors().len(), 4);
    assert!(of("cube.stl", "solid").pixels == flat.pixels);
    assert!(of("cube.stl", "gouraud").colors().len() > 20);
    assert!(of(TEAPOT, "solid").colors().len() > of(TEAPOT, "flat").colors().len());
    // Hidden lines are missing: the three edges at the far corner and the diagonals of the three far sides.
    let hidden = of("cube.stl", "hidden-line");
    let (wire, less) = (of("cube.stl", "wireframe").drawn(), hidden.drawn());
    assert!(wire.iter().zip(&less).all(|(wire, less)| *wire || !less));
    let count = |drawn: &[bool]| drawn.iter().filter(|d| **d).count();
    assert!(count(&less) < count(&wire) * 3 / 4 && count(&less) > count(&wire) / 4);
    // The lines lie inside the outline, or outside by half a line's width: half a pixel.
    let [a, b] = [flat.extent(), hidden.extent()];
    assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| a.abs_diff(*b) <= 1), "{a:?} {b:?}");
}

/// With smooth edges a picture comes closer to one of eight times the size: silhouettes, creases, and edges between two colours.
#[test]
fn smooth_faces_have_edges_of_mixed_colours() {
    let to = Folder::new("smooth");
    // Two triangles of one plane.
    to.write("sheet.obj", "v 0 0 0 1 0 0\nv 4 1 0 1 0 0\nv 1 5 0 1 0 0\nv 5 6 0 0 1 1\nf 1 2 3\nf 2 4 3\n");
    for (options, gain) in [
        (format!("{GEAR} --mode flat"), 4.0),
        (format!("{GEAR} --mode solid"), 4.0),
        (format!("{TEAPOT} --mode gouraud --format rgb565"), 2.0), // whose parts meet in no edges
        ("sheet.obj --from 0,0 --mode flat".into(), 4.0),
        ("sheet.obj --from 0,0 --format gray4 --no-dither".into(), 2.0),
    ] {
        let of = |size, more| to.draw(&format!("{options} --size {size}{more}"));
        let fine = of("512x384", "").pixels;
        let mean = |pixel: usize, channel: usize| {
            let (column, row) = (pixel % 64 * 8, pixel / 64 * 8);
            let sum = (0..64)
                .map(|at| u32::from(fine[(row + at / 8) * 512 + column + at % 8][channel]))
                .sum::<u32>();
            f64::from(sum) / 64.0
        };
        let off = |pixels: &[[u8; 3]]| {
            let off = |(pixel, channel): (usize, usize)| {
                (f64::from(pixels[pixel][channel]) - mean(pixel, channel)).powi(2)
            };
            (0..64 * 48 * 3).map(|at| off((at / 3, at % 3))).sum::<f64>().sqrt()
        };
        let [plain, smooth] = ["", " --smooth-faces"].map(|more| off(&of("64x48", more).pixels));
        assert!(smooth * gain < plain, "{options}: {plain} {smooth}");
    }
    // The first frame of a film is the picture; 16 greys fit in its palette. A scene's sprites are drawn into it afterwards.
    let line = format!("{GEAR} --size 64x48 --format gray4 --smooth-faces");
    assert!(to.film(&format!("{line} --frames 2")).1[0].1 == to.draw(&line).pixels);
    let scene = |sprites| {
        let text = format!(
            r#"{{"mesh": "sheet.obj", "camera": {{}}, "width": 64, "height": 48, "sprites": [{sprites}]}}"#
        );
        to.write("scene.json", text);
        to.draw("scene.json --smooth-faces").pixels
    };
    let dot = r#"{"at": [3, 3, 1], "color": [1, 2, 3], "pixels": 5}, {"at": [3, 3, -1], "color": [9, 9, 9]}"#;
    let [before, after] = ["", dot].map(scene);
    let changed: Vec<_> = before.iter().zip(after).filter(|(before, after)| *before != after).collect();
    assert!(changed.len() == 25 && changed.iter().all(|(_, after)| *after == [1, 2, 3]), "{changed:?}");
}

/// A ring, inside out, with 64 sides that turn by 5.6 degrees: its only features are its four rims.
#[test]
fn hidden_lines_show_the_outline_of_a_round_body() {
    let to = Folder::new("round");
    let ring = prism(&circle(64, |_| 1.0), &circle(64, |_| 0.85), 0.4);
    to.write("ring.obj", obj(&moved(&ring, |[x, y, z]| [x, z, y])));
    let of = |mode: &str| to.draw(&format!("ring.obj --flip --size 160x120 --mode {mode}")).drawn();
    let (body, lines) = (of("flat"), of("hidden-line --edges feature"));
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
    let (to, n) = (Folder::new("grid"), 150);
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| format!("v {i} {j} 0\n")));
    let faces = (0..n).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i + 1));
    let faces = faces.map(|a| format!("f {} {} {} {}\n", a, a + 1, a + n + 2, a + n + 1));
    to.write("grid.obj", vertices.chain(faces).collect::<String>());
    for mode in ["wireframe", "hidden-line"] {
        let line = format!("grid.obj --projection front --frame outline --size 80x80 --edges all --mode {mode} --stats --png p.png");
        let (said, _) = to.run(&line);
        // 92 of 100 columns and rows, and each of their pixels has an edge.
        let drawn = to.picture("p.png").drawn().iter().filter(|drawn| **drawn).count();
        assert!(drawn.abs_diff(80 * 80 * 92 * 92 / 10_000) < 160, "{mode}: {drawn}");
        // 45 000 triangles are three times 21 845 at most; an edge where two parts meet is in both.
        assert!(said.contains(" edges (in 3 parts; edges between parts count twice) "), "{said}");
    }
}

#[test]
fn a_film_goes_once_around() {
    let to = Folder::new("film");
    let (width, frames, _) = to.film(&format!("{TEAPOT} --frames 7 --size 64x48"));
    assert_eq!((width, frames.len(), frames[0].1.len()), (64, 7, 64 * 48));
    assert_eq!(frames.iter().map(|(delay, _)| u32::from(*delay)).sum::<u32>(), 400);
    let different: BTreeSet<_> = frames.iter().map(|(_, pixels)| pixels).collect();
    assert_eq!(different.len(), 7);
    for (_, pixels) in frames {
        // All of them show the whole mesh.
        let [[left, right], [top, bottom]] = Picture { width, pixels }.extent();
        assert!(left > 0 && right < 64 && top > 0 && bottom < 48);
    }
    // The film's usual size and number of frames.
    to.write("cube.obj", obj(&cuboid([1.0; 3])));
    let (width, frames, _) = to.film("cube.obj");
    assert_eq!((width, frames.len(), frames[0].1.len()), (320, 36, 320 * 240));
    // A cube looks the same from its four sides, but for rounding at edges.
    let differ = |frame: usize| frames[0].1.iter().zip(&frames[frame].1).filter(|(a, b)| a != b).count();
    assert!([9, 18, 27].into_iter().all(|quarter| differ(quarter) < 100) && differ(4) > 2000);
}

/// Any frame of the firmware, and all of them as a film.
#[test]
fn firmware_is_shown_frame_by_frame() {
    let to = Folder::new("firmware");
    let options = firmware::options(&firmware::TEMPLATE, &pinhole_import::Options::default());
    let model = pinhole_import::import(GEAR.as_ref(), &options).unwrap();
    let wanted = |frame: i32, frames: u32| -> Vec<[u8; 3]> {
        let mut canvas = Canvas::new(Size::new(64, 48), Rgb565::MAGENTA);
        firmware::draw(&model, Angle::turns(frame, frames), &mut canvas).unwrap();
        canvas.pixels().iter().map(|color| Rgb888::from(*color)).map(|c| [c.r(), c.g(), c.b()]).collect()
    };
    assert!(wanted(0, 120) != wanted(7, 120));
    for (option, frame) in [("--firmware", 0), ("--firmware=7", 7), ("--firmware=119", 119)] {
        let picture = to.draw(&format!("{GEAR} {option} --size 64x48"));
        assert!(picture.pixels == wanted(frame, 120), "{option}");
    }
    let (width, frames, _) = to.film(&format!("{GEAR} --firmware --size 64x48"));
    assert_eq!((width, frames.len()), (64, 120));
    assert!((0..).zip(&frames).all(|(number, (_, pixels))| *pixels == wanted(number, 120)));
    let (_, frames, _) = to.film(&format!("{GEAR} --firmware --size 64x48 --frames 5"));
    assert!(frames.len() == 5 && frames[3].1 == wanted(3, 5));
}

#[test]
fn text_has_the_picture_s_shape() {
    let to = Folder::new("text");
    to.write("cube.obj", obj(&cuboid([1.0; 3])));
    let shape = |options: &str, lines: usize, columns: usize| {
        let (said, _) = to.run(&format!("cube.obj {options}"));
        let rows: Vec<Vec<char>> = said.lines().map(|line| line.chars().collect()).collect();
        assert!(rows.len() == lines && rows.iter().all(|row| row.len() == columns), "{said}");
        rows
    };
    // 160 × 120 pixels, 2 × 4 of them a character.
    let rows = shape("--ascii --projection front --frame outline", 30, 80);
    assert!(rows.iter().flatten().all(|c| " .:-=+*#%@".contains(*c)));
    // A square of 110 × 110 pixels, 92 of 100 of the height: 55 or 57 characters wide, 27 to 29 high.
    let drawn: Vec<_> = rows.iter().flatten().map(|c| *c != ' ').collect();
    let [[left, right], [top, bottom]] = extent(&drawn, 80);
    assert!((55..=57).contains(&(right - left)) && (27..=29).contains(&(bottom - top)), "{left} {right}");
    let inside = &rows[15][left + 1..right - 1];
    assert!(inside.iter().all(|c| *c == inside[0]), "a side has one light");
    let rows = shape("--ascii=braille --size 40x41 --mode wireframe", 11, 20);
    assert!(rows.iter().flatten().all(|c| ('\u{2800}'..='\u{28ff}').contains(c)));
    assert!(rows.iter().flatten().any(|c| *c != '\u{2800}'));
    // With a file, too, it says so behind.
    let (said, _) = to.run("cube.obj --ascii --png p.png");
    assert!(said.lines().count() == 31 && said.lines().last().unwrap().contains("p.png"));
}

/// The lines of `cases.txt`.
#[test]
fn what_is_said_is_as_in_the_table() {
    let to = Folder::new("cases");
    to.write("m.obj", obj(&cuboid([1.0; 3])));
    to.write("cube.stl", stl(&cuboid([1.0; 3])));
    to.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    to.write("s.json", "{}");
    let rows = include_str!("cases.txt").lines().filter(|row| !row.is_empty() && !row.starts_with('#'));
    for row in rows {
        let (line, wanted) = row.split_once(" => ").unwrap();
        let said = match line.strip_prefix("x ") {
            Some(line) => refusal(&RENDER.run_in(&to.0, &line.split(' ').collect::<Vec<_>>())),
            None => to.run(line).0,
        };
        assert!(wanted.split(" & ").all(|part| said.contains(part)), "{row}: {said}");
        assert_eq!(fs::read_dir(&to.0).unwrap().count(), 4, "{row}");
    }
}

/// A picture that the materials name is shown if it is asked for, in films, too; if not, a note says how to ask.
#[test]
fn a_model_s_picture_is_shown_where_it_is_asked_for() {
    let to = Folder::new("picture");
    testing::textured(&to.0);
    let shown = |options: &str| {
        let (_, frames, said) = to.film(&format!("skin.obj --two-sided --size 64x48 --frames 2{options}"));
        (frames[0].1.contains(&[255, 0, 0]) && frames[0].1.contains(&[0, 0, 255]), said)
    };
    let (is_shown, said) = shown("");
    let note = "warning: pictures of materials: 1, the first skin.png; left out: use --texture 16";
    assert!(!is_shown && said.contains(note), "{said}");
    let (is_shown, said) = shown(" --texture 4");
    assert!(is_shown && !said.contains("pictures"), "{said}");
    let done = RENDER.run_in(&to.0, &["skin.obj", "--png", "out.png", "--lit-texture"]);
    assert!(
        refusal(&done).contains("--lit-texture: no texture is shown: give --texture COLORS too"),
        "{done:?}"
    );
}

/// A green square above the square with the picture, in every mode.
#[test]
fn faces_whose_material_has_no_picture_have_their_own_colour() {
    let to = Folder::new("bare");
    let model = fs::read_to_string(testing::textured(&to.0)).unwrap();
    let more = "v 0 2 0\nv 1 2 0\nusemtl bare\nf 4/1 3/2 6/3 5/4\n";
    to.write("skin.obj", model + more);
    let library = fs::read_to_string(to.0.join("skin.mtl")).unwrap();
    to.write("skin.mtl", library + "newmtl bare\nKd 0 1 0\n");
    for options in ["", " --mode flat", " --smooth-faces", " --alpha 32", " --format rgb565"] {
        let line = format!("skin.obj --from 0,0 --texture 4 --size 64x64{options}");
        let Picture { width, pixels } = to.draw(&line);
        let has = |[r, g, b]: [bool; 3]| {
            move |pixel: &&[u8; 3]| [pixel[0] > 9, pixel[1] > 9, pixel[2] > 9] == [r, g, b]
        };
        let (above, below) = pixels.split_at(width * 31); // the middle row may be smoothed
        let below = &below[width * 2..];
        let count = |rows: &[[u8; 3]], of| rows.iter().filter(has(of)).count();
        let [red, green, blue] = [[true, false, false], [false, true, false], [false, false, true]];
        let counts = [red, green, blue].map(|of| [above, below].map(|rows| count(rows, of).min(200)));
        assert_eq!(counts, [[0, 200], [200, 0], [0, 200]], "{options}");
    }
}
