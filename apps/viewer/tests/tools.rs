//! One model in all tools: what `pinhole-import` gives to firmware, what the template for firmware draws, what `pinhole-render`
//! draws, and what `pinhole-viewer` shows are one picture, with the same warnings in the same words, or the same refusal.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;
use pinhole::{Affine, Angle, Camera, DepthBuffer, ScreenVertex, Viewport};
use pinhole_apps_support::bodies::{cuboid, gear, obj, reversed, stl, Body};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{ImportedMesh, Options};
use pinhole_render::model::{self, Fit, Look};
use pinhole_render::paint::{Mode, Subject};
use pinhole_render::picture::{picture, Format};
use pinhole_render::projections::Named;
use pinhole_render::quantised::Quantised;
use pinhole_render::{firmware, import, style};
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

/// The pixels of a mesh as firmware draws it: with the library's default culling and framing, and a depth buffer.
fn in_firmware(mesh: &ImportedMesh) -> Vec<bool> {
    let mesh = mesh.mesh().unwrap();
    let usual = Named::ALL[0];
    let [yaw, pitch, field_of_view] =
        [usual.yaw, usual.pitch, usual.field_of_view()].map(|degrees| Angle::degrees(degrees as i32));
    let viewport = Viewport::new(Point::zero(), SIZE).unwrap();
    let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch).unwrap();

    let mut canvas = Canvas::new(SIZE, Rgb888::BLACK);
    let mut storage = vec![0; canvas.pixels().len()];
    let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), SIZE), &mut storage).unwrap();
    let mut corners = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let instance = camera.place(&mesh, &Affine::identity());
    let Ok(_) = instance.depth_tested(|_| Rgb888::WHITE, &mut corners, &mut depth, &mut canvas);
    canvas.pixels().iter().map(|pixel| *pixel == Rgb888::WHITE).collect()
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
    let style = style::chosen(Mode::Solid, Format::Rgb888, None, None, false);
    let (pixels, _) =
        picture(&Subject::new(&used, Mode::Solid), (&used, &quantised), &style, Format::Rgb888)?;
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
    let firmware = in_firmware(&mesh);
    for shown in [in_render(file, options), in_viewer(file, options), in_template(file, options)] {
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
        let differ = differ(&pixels, &firmware);
        assert!(differ <= 3, "{}: {differ} pixels differ, with {options:?}", file.display());
    }
    (firmware, said)
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

fn rows(pixels: &[bool]) -> usize {
    pixels.chunks(SIZE.width as usize).filter(|row| row.contains(&true)).count()
}

fn columns(pixels: &[bool]) -> usize {
    let width = SIZE.width as usize;
    (0..width).filter(|&x| pixels.iter().skip(x).step_by(width).any(|drawn| *drawn)).count()
}

#[test]
fn up_is_z_of_stl_and_y_of_obj_in_all_tools() {
    let tower = cuboid([1.0, 1.0, 3.0]);
    let (stl, obj) = (file("tower.stl", stl(&tower)), file("tower.obj", obj(&tower)));
    let (standing, said) = agreed(&stl, &NONE);
    assert_eq!(said, Vec::<String>::new());
    assert!(rows(&standing) > columns(&standing), "{} {}", rows(&standing), columns(&standing));
    let (lying, _) = agreed(&obj, &NONE);
    assert!(rows(&lying) < columns(&lying), "{} {}", rows(&lying), columns(&lying));
    // Either axis, if the options name it.
    let up = |axis| Options { up: Some(axis), ..Options::default() };
    assert!(agreed(&stl, &up(pinhole_import::Axis::Y)).0 == lying);
    assert!(agreed(&obj, &up(pinhole_import::Axis::Z)).0 == standing);
    for axis in pinhole_import::Axis::ALL.map(|(_, axis)| axis) {
        agreed(&obj, &up(axis));
    }
}

#[test]
fn a_sound_part_with_a_hole_is_one_picture_without_a_word() {
    let (pixels, said) = agreed(&file("gear.stl", stl(&gear())), &NONE);
    assert_eq!(said, Vec::<String>::new());
    // From 20 degrees above, some rows show the background through the hole. In mesh order, without depth, walls would hide it.
    let width = SIZE.width as usize;
    let row = |y: usize| &pixels[y * width..(y + 1) * width];
    let holes = (0..SIZE.height as usize).filter(|&y| {
        let first = row(y).iter().position(|drawn| *drawn);
        first.is_some_and(|first| row(y)[first..].windows(2).filter(|two| two[0] != two[1]).count() > 1)
    });
    assert!((4..20).contains(&holes.count()));
    // The gear's bounding sphere takes at most 31/32 of the height, and the gear is almost as wide as its sphere.
    assert!(rows(&pixels) < 117 && columns(&pixels) < 117 && columns(&pixels) > 95, "{}", columns(&pixels));
}

#[test]
fn slivers_far_away_move_no_frame() {
    let mut body = cuboid([2.0, 2.0, 2.0]);
    let (alone, _) = agreed(&file("alone.stl", stl(&body)), &NONE);
    body.push([[0.0; 3], [900.0, 0.0, 0.0], [1800.0, 0.0, 0.0]]);
    let (pixels, said) = agreed(&file("sliver.stl", stl(&body)), &NONE);
    assert_eq!(said, ["faces without area: 1, the first at triangle 13; dropped, which changes no picture"]);
    assert!(differ(&pixels, &alone) == 0);
}

#[test]
fn models_inside_out_are_so_everywhere_and_flip_mends_them() {
    let gear_file = file("sound.stl", stl(&gear()));
    let sound = agreed(&gear_file, &NONE).0;
    let flipped = file("flipped.stl", stl(&reversed(&gear())));
    // The picture shows the insides of the far walls, in their light: the same outline in other colours.
    let (pixels, said) = agreed(&flipped, &NONE);
    assert!(
        said.len() == 1 && said[0].starts_with("parts inside out: 1 of 1, the first at triangle 1;"),
        "{said:?}"
    );
    assert!(said[0].contains("use --flip"), "{said:?}");
    assert!(pixels == sound);
    let colours = |file: &Path, options: &Options| rendered(file, options).unwrap().0;
    let right = colours(&gear_file, &NONE);
    let others = right.iter().zip(colours(&flipped, &NONE)).filter(|(a, b)| *a != b).count();
    assert!(others > 2000, "{others}");
    for options in [&*FLIP, &*FIX] {
        assert_eq!(agreed(&flipped, options), (sound.clone(), vec![]), "{options:?}");
        assert!(colours(&flipped, options) == right, "{options:?}");
    }
    assert!(colours(&flipped, &BOTH_SIDES) == right);
    assert_eq!(agreed(&flipped, &BOTH_SIDES), (sound, vec![]));
    // For a model that --flip turned inside out, the warning says to leave --flip out.
    let (_, said) = agreed(&gear_file, &FLIP);
    let wanted = "parts inside out: 1 of 1, the first at triangle 1; the outside shows nothing: leave out --flip, unless it is \
                  a room seen from inside";
    assert_eq!(said, [wanted]);
}

#[test]
fn mixed_winding_is_so_everywhere_and_can_be_fixed() {
    let sound = agreed(&file("straight.stl", stl(&gear())), &NONE).0;
    let mut mixed = gear();
    for (number, [_, b, c]) in mixed.iter_mut().enumerate() {
        if number % 5 < 2 {
            std::mem::swap(b, c);
        }
    }
    let mixed = file("mixed.stl", stl(&mixed));
    let (pixels, said) = agreed(&mixed, &NONE);
    assert!(said.len() == 1 && said[0].starts_with("edges between faces of opposite winding: "), "{said:?}");
    assert!(said[0].ends_with("; some faces will be culled: use --fix-winding"), "{said:?}");
    assert!(differ(&pixels, &sound) > 0);
    assert_eq!(agreed(&mixed, &FIX), (sound.clone(), vec![]));
    assert_eq!(agreed(&mixed, &BOTH_SIDES), (sound, vec![]));
}

#[test]
fn open_models_show_nothing_from_behind_unless_two_sided() {
    // A box without the three sides that are seen from the right, the front and above.
    let open: Body = cuboid([2.0; 3])
        .into_iter()
        .enumerate()
        .filter(|(i, _)| ![0, 1, 4, 5, 8, 9].contains(i))
        .map(|(_, t)| t)
        .collect();
    let open = file("open.obj", obj(&open));
    let (pixels, said) = agreed(&open, &NONE);
    assert_eq!(pixels.iter().filter(|drawn| **drawn).count(), 0, "{said:?}");
    assert_eq!(
        said,
        ["open edges: 6, the first at line 8; faces show nothing from behind: close the surface, or use --two-sided"]
    );
    let whole = agreed(&file("closed.obj", obj(&cuboid([2.0; 3]))), &NONE).0;
    let (pixels, said) = agreed(&open, &BOTH_SIDES);
    assert_eq!((differ(&pixels, &whole), said), (0, vec![]), "the same outline");
}

#[test]
fn what_is_no_surface_is_named_and_drawn() {
    // Two boxes that share an edge, and a fin on one of them.
    let mut bodies = cuboid([2.0; 3]);
    bodies.extend(cuboid([-2.0, -2.0, 2.0]).iter().map(|&[a, b, c]| [a, b, c]));
    bodies.push([[2.0, 2.0, 0.0], [2.0, 2.0, 2.0], [3.0, 3.0, 1.0]]);
    let path = file("shared.obj", obj(&bodies));
    let (pixels, said) = agreed(&path, &NONE);
    assert!(pixels.contains(&true));
    let wanted = ["edges of more than two faces: 2, ", "open edges: 2, "];
    assert!(wanted.iter().all(|start| said.iter().any(|s| s.starts_with(start))), "{said:?}");
    let (both, said) = agreed(&path, &BOTH_SIDES);
    assert_eq!(said, Vec::<String>::new());
    assert!(both.iter().zip(&pixels).all(|(both, one)| *both || !one));
}

#[test]
fn degenerate_and_doubled_faces_change_no_picture() {
    let body = cuboid([3.0, 2.0, 1.0]);
    let alone = agreed(&file("clean.obj", obj(&body)), &NONE).0;
    let mut more = body.clone();
    more.extend([body[3], body[3], [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]], [[3.0, 2.0, 0.0]; 3]]);
    let (pixels, said) = agreed(&file("more.obj", obj(&more)), &NONE);
    assert_eq!(
        said,
        [
            "faces without area: 2, the first at line 60; dropped, which changes no picture",
            "duplicate faces: 2, the first at line 52; dropped, which changes no picture",
        ]
    );
    assert!(pixels == alone);
}

/// A height field of n × n vertices.
fn field(n: usize) -> String {
    let mut text = String::new();
    for (x, y) in (0..n).flat_map(|y| (0..n).map(move |x| (x, y))) {
        text += &format!("v {x} {} {y}\n", 20.0 * (x as f64 / 40.0).sin() * (y as f64 / 30.0).cos());
    }
    for a in (0..n - 1).flat_map(|y| (0..n - 1).map(move |x| n * y + x + 1)) {
        text += &format!("f {} {} {}\nf {} {} {}\n", a, a + n, a + n + 1, a, a + n + 1, a + 1);
    }
    text
}

#[test]
fn a_hundred_thousand_triangles_are_one_picture_and_a_warning_of_their_size() {
    let (pixels, said) = agreed(&file("large.obj", field(225)), &NONE);
    assert!(pixels.iter().filter(|drawn| **drawn).count() > 2000);
    assert_eq!(said.len(), 3, "{said:?}");
    assert!(said[0].starts_with("open edges: 896, "), "{said:?}");
    assert!(
        said[2].starts_with("100352 faces, more than the 65535 that can be drawn in bands: "),
        "{said:?}"
    );
    // 225² vertices, 2·224² faces and normals, and 3·224² + 2·224 edges.
    let (edges, others) = (4 * (3 * 224 * 224 + 2 * 224), 6 * 225 * 225 + 12 * 2 * 224 * 224);
    let size = format!(
        "size in flash: {} bytes, {edges} of them for edges; if that is too much, use pinhole-import --edges none",
        edges + others
    );
    assert!(said[1].starts_with(&size), "{said:?}");
}

#[test]
fn more_vertices_than_a_mesh_has_are_refused_for_firmware_and_shown_as_such() {
    let path = file("vast.obj", field(300));
    let decimate = pinhole_import::Remedy::Decimate(0);
    let problem =
        format!("has 90000 vertices, more than the 65536 of a mesh: {decimate}, or split the model");
    let error = pinhole_import::import(&path, &NONE).unwrap_err().to_string();
    assert_eq!(error, format!("{}: {problem}", path.display()));
    let (rendered, said) = in_render(&path, &NONE).unwrap();
    let (viewed, said_too) = in_viewer(&path, &NONE).unwrap();
    assert_eq!(said, said_too);
    assert_eq!(said.last(), Some(&format!("not for firmware: {problem}")));
    assert_eq!(in_template(&path, &NONE).unwrap_err(), error);
    assert!(rendered == viewed && rendered.iter().filter(|drawn| **drawn).count() > 2000);
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

#[test]
fn what_is_no_model_is_refused_in_the_same_line() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let mut not_a_number = stl(&cuboid([1.0; 3]));
    not_a_number[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let mut short = stl(&gear());
    short.truncate(5000);
    let again = "repair or export the model again";
    let as_mesh = "has no faces: export the model as a mesh";
    for (name, bytes, what) in [
        ("nan.obj", format!("{three}v NaN 0 0\nf 1 2 4\n").into_bytes(), again),
        ("nan.stl", not_a_number, again),
        ("empty.obj", vec![], as_mesh),
        ("points.obj", three.into(), as_mesh),
        ("empty.stl", stl(&[]), as_mesh),
        ("none.stl", b"solid a\nendsolid a\n".to_vec(), as_mesh),
        ("nothing.stl", vec![], "nothing.stl: is empty: copy or export it again"),
        ("short.stl", short, "copy or export it again"),
        ("line.obj", format!("{three}f 1 2 1\n").into_bytes(), "no face with an area"),
        ("index.obj", format!("{three}f 1 2 7\n").into_bytes(), "names a vertex that does not exist"),
        (
            "picture.obj",
            b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec(),
            "is binary, not text, as byte 8 is zero: export .obj or .stl",
        ),
        (
            "really.stl",
            field(5).into_bytes(),
            "is text, but no ASCII STL, which begins with `solid`: if it is an OBJ file, name it .obj",
        ),
        ("really.obj", stl(&gear()), "is binary, not text"),
        ("part.step", b"ISO-10303-21;".to_vec(), "is not a model this program reads: export .obj or .stl"),
    ] {
        refused(&file(name, bytes), what);
    }
}
