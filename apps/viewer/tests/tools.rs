//! One model in all tools: what `pinhole-import` gives to firmware, what the template for firmware draws, what `pinhole-render`
//! draws, and what `pinhole-viewer` shows are one picture, with the same warnings in the same words, or the same refusal.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::Angle;
use pinhole_apps_support::bodies::{cuboid, gear, obj, reversed, stl, torus, Body};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::testing::extent;
use pinhole_import::{Axis, Options};
use pinhole_render::model::{self, Fit, Look};
use pinhole_render::paint::Subject;
use pinhole_render::picture::{picture, Format};
use pinhole_render::projections::Named;
use pinhole_render::quantised::Quantised;
use pinhole_render::style::{Mode, Style};
use pinhole_render::{firmware, import};
use pinhole_viewer::{Source, Viewer};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

const SIZE: Size = Size::new(160, 120);
static NONE: LazyLock<Options> = LazyLock::new(Options::default);
static FLIP: LazyLock<Options> = LazyLock::new(|| Options { flip: true, ..Options::default() });
static FIX: LazyLock<Options> = LazyLock::new(|| Options { fix_winding: true, ..Options::default() });
static BOTH_SIDES: LazyLock<Options> = LazyLock::new(|| Options { two_sided: true, ..Options::default() });

fn file(name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tools");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    std::fs::write(&file, bytes).unwrap();
    file
}

fn drawn(pixels: &[Rgb888]) -> Vec<bool> {
    pixels.iter().map(|pixel| *pixel != pixels[0]).collect()
}

/// The pixels that `pinhole-render` draws, and its warnings.
fn in_render(file: &Path, options: &Options) -> Result<(Vec<bool>, Vec<String>), String> {
    let (pixels, warnings) = rendered(file, options)?;
    Ok((drawn(&pixels), warnings))
}

fn rendered(file: &Path, options: &Options) -> Result<(Vec<Rgb888>, Vec<String>), String> {
    let mut model = import::read(file, options)?;
    let usual = Named::ALL[0];
    let look = Look {
        projection: usual,
        yaw: usual.yaw,
        pitch: usual.pitch,
        field_of_view: usual.field_of_view(),
        width: SIZE.width,
        height: SIZE.height,
        up: model.up,
        fit: Fit::Sphere { zoom: 1.0 },
    };
    let (quantised, used) = Quantised::settle(&model::scene(
        std::mem::take(&mut model.triangles),
        import::colors(&mut model),
        &look,
    )?)?;
    let style = Style::chosen(Mode::Solid, Format::Rgb888, None, None, false);
    let (pixels, _) = picture(&Subject::new(&used, &style), (&used, &quantised), &style, Format::Rgb888)?;
    Ok((pixels, model.warnings.iter().map(ToString::to_string).collect()))
}

/// The pixels that `pinhole-viewer` shows first, and its warnings.
fn in_viewer(file: &Path, options: &Options) -> Result<(Vec<bool>, Vec<String>), String> {
    let source = Source::read(file, options)?;
    let (warnings, state) = (source.warnings().collect(), source.state());
    let mut viewer = Viewer::new(source, SIZE);
    viewer.draw(&state)?;
    Ok((drawn(viewer.pixels()), warnings))
}

/// The pixels of the firmware that is made from the template with a model, and the importer's warnings, except the one about the
/// size in flash, because the template has no edges.
fn in_template(file: &Path, options: &Options) -> Result<(Vec<bool>, Vec<String>), String> {
    let options = firmware::options(&firmware::TEMPLATE, options);
    let mesh = pinhole_import::import(file, &options).map_err(|e| e.to_string())?;
    let mut canvas = Canvas::new(SIZE, Rgb565::MAGENTA);
    firmware::draw(&mesh, Angle::ZERO, &mut canvas)?;
    let drawn = canvas.pixels().iter().map(|pixel| *pixel != Rgb565::BLACK).collect();
    Ok((drawn, mesh.warnings.iter().map(ToString::to_string).collect()))
}

/// How many pixels are drawn in only one of the two pictures.
fn differ(a: &[bool], b: &[bool]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

/// Draws a model with all tools, and asserts that they agree. Returns the pixels and the warnings.
#[track_caller]
fn agreed(file: &Path, options: &Options) -> (Vec<bool>, Vec<String>) {
    let mesh = pinhole_import::import(file, options).unwrap_or_else(|e| panic!("{e}"));
    let said: Vec<_> = mesh.warnings.iter().map(ToString::to_string).collect();
    let (rendered, warnings) = in_render(file, options).unwrap();
    assert_eq!(warnings, said, "{}", file.display());
    for shown in [in_viewer(file, options), in_template(file, options)] {
        let (pixels, warnings) = match shown {
            Ok(shown) => shown,
            // What the template logs, after a warning that says what to do.
            Err(problem) => {
                assert!(problem.contains("more than 65535 faces") && mesh.faces.len() > 65535, "{problem}");
                assert!(
                    said.iter().any(|said| said.contains("65535 that can be drawn in bands: use")),
                    "{said:?}"
                );
                continue;
            }
        };
        assert_eq!(warnings, said, "{}", file.display());
        // The mesh's grid moves vertices by up to 1/65000 of its size, which at times changes a pixel of its outline.
        let differ = differ(&pixels, &rendered);
        assert!(differ <= 3, "{}: {differ} pixels differ, with {options:?}", file.display());
    }
    (rendered, said)
}

/// Asserts that all tools refuse a file with the same line.
#[track_caller]
fn refused(file: &Path, what: &str) {
    let error = pinhole_import::import(file, &NONE).unwrap_err().to_string();
    assert!(error.starts_with(file.to_str().unwrap()) && error.contains(what), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    assert_eq!(in_render(file, &NONE).unwrap_err(), error);
    assert_eq!(in_viewer(file, &NONE).unwrap_err(), error);
    assert_eq!(in_template(file, &NONE).unwrap_err(), error);
}

/// The numbers of columns and rows in which something is.
fn size(pixels: &[bool]) -> [usize; 2] {
    extent(pixels, SIZE.width as usize).map(|[from, to]| to - from)
}

/// A gear with a part of its faces reversed.
fn mixed() -> Body {
    let mut mixed = gear();
    for (number, [_, b, c]) in mixed.iter_mut().enumerate() {
        if number % 5 < 2 {
            std::mem::swap(b, c);
        }
    }
    mixed
}

/// Models with what is said of them, by its first words, and the model before them in the list whose picture theirs is, if it is one.
#[test]
fn all_tools_show_one_picture_and_say_the_same() {
    let (tower, cube, flat) = (cuboid([1.0, 1.0, 3.0]), cuboid([2.0; 3]), cuboid([3.0, 2.0, 1.0]));
    // A box without the three sides that are seen from the right, the front and above.
    let open: Body = [2, 3, 6, 7, 10, 11].map(|face| cube[face]).into();
    let (gear, flipped) = (gear(), reversed(&gear()));
    let with = |body: &Body, more: &[[[f64; 3]; 3]]| [body, more].concat();
    let sliver = [[0.0; 3], [900.0, 0.0, 0.0], [1800.0, 0.0, 0.0]];
    let none = [[[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]], [[3.0, 2.0, 0.0]; 3]];
    // Two boxes that share an edge, and a fin on one of them.
    let mut shared = with(&cube, &cuboid([-2.0, -2.0, 2.0]));
    shared.push([[2.0, 2.0, 0.0], [2.0, 2.0, 2.0], [3.0, 3.0, 1.0]]);
    let more = with(&with(&flat, &[flat[3]; 2]), &none);
    let twice = "duplicate faces: 2, the first at line 52; ";
    let many = "100350 faces, more than the 65535 that can be drawn in bands: ";
    let up = |axis| Options { up: Some(axis), ..Options::default() };
    let inside_out = "parts inside out: 1 of 1, the first at triangle 1; ";
    let mut pictures: Vec<(&str, Vec<bool>)> = Vec::new();
    let [usual, flip, fix, both_sides]: [&Options; 4] = [&NONE, &FLIP, &FIX, &BOTH_SIDES];
    for (name, body, options, said, same) in [
        // z is up in an STL file and y in an OBJ file, or either axis, if the options name it.
        ("tower.stl", &tower, usual, &[][..], None),
        ("tower.obj", &tower, usual, &[], None),
        ("tower.stl", &tower, &up(Axis::Y), &[], Some("tower.obj")),
        ("tower.obj", &tower, &up(Axis::Z), &[], Some("tower.stl")),
        ("tower.obj", &tower, &up(Axis::X), &[], None),
        ("tower.obj", &tower, &up(Axis::MinusX), &[], None),
        ("tower.obj", &tower, &up(Axis::MinusZ), &[], None),
        ("gear.stl", &gear, usual, &[], None),
        // The insides of the far walls are seen: the same outline.
        ("flipped.stl", &flipped, usual, &[inside_out], Some("gear.stl")),
        ("flipped.stl", &flipped, flip, &[], Some("gear.stl")),
        ("flipped.stl", &flipped, fix, &[], Some("gear.stl")),
        ("flipped.stl", &flipped, both_sides, &[], Some("gear.stl")),
        ("gear.stl", &gear, flip, &[inside_out], None),
        ("mixed.stl", &mixed(), usual, &["edges between faces of opposite winding: "], None),
        ("mixed.stl", &mixed(), fix, &[], Some("gear.stl")),
        ("mixed.stl", &mixed(), both_sides, &[], Some("gear.stl")),
        ("cube.obj", &cube, usual, &[], None),
        ("open.obj", &open, usual, &["open edges: 6, the first at line 8; "], None),
        ("open.obj", &open, both_sides, &[], Some("cube.obj")),
        ("cube.stl", &cube, usual, &[], None),
        // A sliver far away moves no frame.
        ("sliver.stl", &with(&cube, &[sliver]), usual, &["faces without area: 1, "], Some("cube.stl")),
        ("shared.obj", &shared, usual, &["edges of more than two faces: 2, ", "open edges: 2, "], None),
        ("shared.obj", &shared, both_sides, &[], None),
        ("flat.obj", &flat, usual, &[], None),
        (
            "more.obj",
            &more,
            usual,
            &["faces without area: 2, the first at line 60; ", twice],
            Some("flat.obj"),
        ),
        ("large.stl", &torus(3.0, 1.0, 225, 223), usual, &["size in flash: ", many], None),
    ] {
        let bytes = if name.ends_with("obj") { obj(body).into() } else { stl(body) };
        let (pixels, warnings) = agreed(&file(name, bytes), options);
        let is_said = |start: &&str| warnings.iter().any(|warning| warning.starts_with(*start));
        assert!(
            warnings.len() == said.len() && said.iter().all(is_said),
            "{name}, {options:?}: {warnings:?}"
        );
        if let Some(same) = same {
            let other = pictures.iter().find(|(other, _)| *other == same).map(|(_, pixels)| pixels);
            assert!(other == Some(&pixels), "{name}, {options:?} is not {same}");
        }
        pictures.push((name, pixels));
    }
    let of =
        |name: &str| pictures.iter().find(|(other, _)| *other == name).map(|(_, pixels)| pixels).unwrap();
    let [standing, lying] = ["tower.stl", "tower.obj"].map(|name| size(of(name)));
    assert!(standing[1] > standing[0] && lying[1] < lying[0]);
    assert!(!of("open.obj").contains(&true) && of("mixed.stl") != of("gear.stl"));
    assert!(of("large.stl").iter().filter(|drawn| **drawn).count() > 2000);
    // From 20 degrees above, some rows show the background through the hole. In mesh order, without depth, walls would hide it.
    let gear = of("gear.stl");
    let holes = gear.chunks(SIZE.width as usize).filter(|row| {
        let first = row.iter().position(|drawn| *drawn);
        first.is_some_and(|first| row[first..].windows(2).filter(|two| two[0] != two[1]).count() > 1)
    });
    assert!((4..20).contains(&holes.count()));
    // The gear's bounding sphere takes at most 31/32 of the height, and the gear is almost as wide as its sphere.
    let [width, height] = size(gear);
    assert!(height < 117 && width < 117 && width > 95, "{width} × {height}");
}

#[test]
fn materials_are_one_picture_in_render_and_viewer() {
    file("tools.mtl", "newmtl a\nKd 0 1 0\nnewmtl b\nKd 1 0 1\n");
    let text = obj(&cuboid([2.0; 3]));
    let half = text.match_indices("v ").nth(18).unwrap().0; // after six of twelve triangles: front, back and right
    let text = format!("mtllib tools.mtl\nusemtl a\n{}usemtl b\n{}", &text[..half], &text[half..]);
    let path = file("materials.obj", text);
    let (pixels, said) = agreed(&path, &NONE);
    assert!(said.is_empty(), "{said:?}");
    let mesh = pinhole_import::import(&path, &NONE).unwrap();
    assert_eq!(mesh.palette, [[0, 255, 0], [255, 0, 255]]);
    let source = Source::read(&path, &NONE).unwrap();
    let state = source.state();
    let mut viewer = Viewer::new(source, SIZE);
    viewer.draw(&state).unwrap();
    let (rendered, _) = rendered(&path, &NONE).unwrap();
    let is_green = |c: &Rgb888| c.g() > c.r().max(c.b());
    let is_magenta = |c: &Rgb888| c.g() < c.r().min(c.b());
    let counts = [viewer.pixels(), &rendered[..]].map(|pixels| {
        let (green, magenta) =
            (pixels.iter().filter(|c| is_green(c)), pixels.iter().filter(|c| is_magenta(c)));
        [green.count(), magenta.count()]
    });
    let all = pixels.iter().filter(|drawn| **drawn).count();
    for [green, magenta] in counts {
        // The front and the right side are green, the top is magenta, and no drawn pixel has another colour.
        assert!(
            green > magenta && magenta > 500 && (green + magenta).abs_diff(all) <= 3,
            "{green} {magenta} {all}"
        );
    }
    assert!(counts[0][0].abs_diff(counts[1][0]) <= 3, "{counts:?}");
}

/// One of each reader; the importer's own tests have the others.
#[test]
fn what_is_no_model_is_refused_in_the_same_line() {
    let mut short = stl(&gear());
    short.truncate(5000);
    for (name, bytes, what) in [
        ("empty.obj", vec![], "has no faces: export the model as a mesh"),
        ("index.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 7\n".to_vec(), "names a vertex that does not exist"),
        ("short.stl", short, "copy or export it again"),
        ("really.obj", stl(&gear()), "is binary, not text"),
        ("part.step", b"ISO-10303-21;".to_vec(), "is not a model this program reads: export .obj or .stl"),
    ] {
        refused(&file(name, bytes), what);
    }
}
