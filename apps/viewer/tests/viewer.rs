//! What keys do, and what is sent to the display for them. No window is needed.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole_apps_support::testing;
use pinhole_import::Options;
use pinhole_viewer::{Action, Placement, Source, State, Viewer};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const SIZE: Size = Size::new(96, 72);

fn read(file: &Path) -> Result<Source, String> {
    Source::read(file, &Options::default())
}

fn pressed(keys: &str) -> State {
    let mut state = Source::built_in().state();
    press(&mut state, keys);
    state
}

fn press(state: &mut State, keys: &str) {
    keys.split_whitespace().for_each(|name| state.apply(State::key(name).unwrap()));
}

fn viewer() -> Viewer {
    Viewer::new(Source::built_in(), SIZE)
}

/// The pixels of a display that was dark before.
fn alone(state: &State) -> Vec<Rgb888> {
    let mut viewer = viewer();
    viewer.draw(state).unwrap();
    viewer.pixels().to_vec()
}

/// The colours among the pixels.
fn colours(pixels: &[Rgb888]) -> BTreeSet<[u8; 3]> {
    pixels.iter().map(|c| [c.r(), c.g(), c.b()]).collect()
}

#[test]
fn keys_go_round_and_back() {
    let first = pressed("");
    for (key, count) in [("p", 21), ("P", 21), ("c", 7), ("C", 7), ("b", 5), ("B", 5), ("t", 4), ("o", 2)] {
        let mut state = first;
        let mut met = vec![state];
        for _ in 1..count {
            press(&mut state, key);
            assert!(!met.contains(&state), "{key}");
            met.push(state);
        }
        press(&mut state, key);
        assert_eq!(state, first, "{key} {count} times");
    }
    for key in ["d", "a", "n", "k", "r", "i", "h", "space"] {
        assert_ne!(pressed(key), first);
        assert_eq!(pressed(&format!("{key} {key}")), first);
    }
    // Smooth edges: of faces, of lines; not in two colours.
    let is_smoothed = |keys: &str| alone(&pressed(keys)) != alone(&pressed(&format!("a {keys}")));
    assert_eq!(["", "f", "w", "l", "c c c c"].map(is_smoothed), [true, true, true, true, false]);
    let modes: Vec<_> = ["s", "f", "g", "w", "l"].map(pressed).to_vec();
    assert!((1..5).all(|i| !modes[..i].contains(&modes[i])));
    assert_eq!(pressed("w p c b k left + 0"), first);
    assert_eq!(pressed("right left"), first);
    assert_eq!(State::key("nothing"), None);
    assert_eq!((State::key("x"), State::key("q")), (Some(Action::Screenshot), Some(Action::Quit)));
}

#[test]
fn the_mouse_holds_what_it_drags() {
    let mut state = pressed("");
    state.drag(10, 4);
    // Half a degree for each pixel; a drag to the right moves the eye to the left.
    let mut by_keys = pressed("left");
    by_keys.apply(Action::Orbit(0.0, 2.0));
    assert_eq!(state, by_keys);
    // The eye does not go over the top, and a whole turn ends where it began.
    (0..99).for_each(|_| state.drag(0, 20));
    let top = state;
    state.drag(0, 20);
    assert_eq!(state, top);
    state.drag(720, 0);
    assert_eq!(state, top);
}

#[test]
fn turning_goes_on_by_itself() {
    let mut state = pressed("");
    state.tick();
    assert_eq!(state, pressed(""));
    press(&mut state, "space");
    (0..360).for_each(|_| state.tick());
    let before = alone(&pressed(""));
    assert!(alone(&state) == before, "once around");
    state.tick();
    assert!(alone(&state) != before);
}

#[test]
fn what_was_sent_before_and_now_is_the_whole_picture() {
    // Every frame is made from the last one, by sending the rectangles that differ.
    let mut viewer = viewer();
    let mut state = pressed("");
    let mut sent = Vec::new();
    // A bar ends what is pressed before a frame.
    let keys = " | left | left up | b | w | right | a | right | - - | a | - - - | left | l | g | t | left | t | left | t | t | o | left | o | left | - - - \
                | w | right | g | d | c | down | c | k | c left | c b | right | c | left left | b b | c | p | p | p p p | left | 0 | P | + + + + | up up | 0 a | - - - | left | g | left | a";
    for keys in keys.split('|') {
        press(&mut state, keys);
        sent.push(viewer.draw(&state).unwrap().pixels);
        assert!(viewer.pixels() == alone(&state), "after {keys:?}");
    }
    let all = (SIZE.width * SIZE.height) as usize;
    assert_eq!(sent[0], all, "nothing is known of a new display");
    assert!(sent[1] < all && sent[2] < all, "{sent:?}");
}

#[test]
fn what_is_drawn_already_is_not_sent_again() {
    let mut viewer = viewer();
    let mut state = pressed("");
    let first = viewer.draw(&state).unwrap().clone();
    press(&mut state, "h r i");
    assert_eq!(*viewer.draw(&state).unwrap(), first);
}

#[test]
fn statistics_are_those_of_what_was_sent() {
    // The teapot has 992 faces and 1520 edges. 96 × 72 pixels take two bytes each, and a window takes 11 bytes more.
    let of = |keys: &str| {
        let mut viewer = viewer();
        viewer.draw(&pressed(keys)).unwrap().clone()
    };
    let faces = |keys| {
        let s = of(keys).statistics;
        [s.drawn, s.culled, s.outside, s.degenerate].iter().sum::<u32>()
    };
    assert_eq!((faces("f"), faces("g"), faces("k")), (992, 992, 992));
    // At 391 of its edges the surface turns by at most a degree, by the vertices of assets/teapot.obj: hidden lines leave these out.
    assert_eq!((faces("w"), faces("l")), (1520, 1520 - 391));
    assert_eq!(of("k").statistics.culled, 0);
    // About half the faces of a closed mesh are turned away.
    let culled = of("").statistics.culled;
    assert!((300..700).contains(&culled), "{culled}");
    for (keys, bands, bytes) in [
        ("B B", 72, 2 * 96),
        ("B", 18, 2 * 96),
        ("", 9, 2 * 96),
        ("b", 5, 2 * 96),
        ("b b", 1, 2 * 96),
        ("C C", 9, 3 * 96),     // rgb888
        ("c", 9, 96),           // gray8
        ("c c", 9, 96 / 2),     // gray4
        ("c c c", 9, 96 / 4),   // gray2
        ("c c c c", 9, 96 / 8), // mono
    ] {
        let shown = of(keys);
        assert_eq!((shown.bands, shown.pixels), (bands, 96 * 72), "{keys}");
        assert_eq!(shown.bytes, bytes * 72 + 11 * bands, "{keys}");
        assert_eq!(shown.areas, [Rectangle::new(Point::zero(), SIZE)], "{keys}");
    }
}

#[test]
fn bands_of_any_height_are_one_picture() {
    for keys in ["g", "f", "w", "l", "c c c c", "a g", "a f", "a c c c c"] {
        let whole = alone(&pressed(&format!("{keys} b b")));
        for rows in ["B B", "B", "", "b"] {
            assert!(alone(&pressed(&format!("{keys} {rows}"))) == whole, "{keys} {rows}");
        }
    }
}

#[test]
fn overlays_are_in_the_window_and_not_on_the_display() {
    let mut viewer = viewer();
    let shown = |viewer: &Viewer, state: &State| viewer.picture(state, None);
    let mut state = pressed("i"); // without the information
    viewer.draw(&state).unwrap();
    let display = viewer.pixels().to_vec();
    assert!(shown(&viewer, &state) == display);
    for key in ["i", "h", "r"] {
        press(&mut state, key);
        viewer.draw(&state).unwrap();
        assert!(viewer.pixels() == display && shown(&viewer, &state) != display, "{key}");
        press(&mut state, key);
    }
    // A small step: what was sent is less than all, and its corners are outlined.
    press(&mut state, "- - - left r");
    viewer.draw(&state).unwrap();
    press(&mut state, "left");
    let areas = viewer.draw(&state).unwrap().areas.clone();
    let (display, window) = (viewer.pixels(), shown(&viewer, &state));
    for area in &areas {
        let at = area.top_left;
        let place = (at.y as u32 * SIZE.width + at.x as u32) as usize;
        assert_ne!(window[place], display[place], "{area:?}");
    }
    assert!(!areas.is_empty());
}

/// A scene of 64 × 64 pixels without perspective, with these fields.
fn flat(fields: &str) -> String {
    format!(
        r#"{{"view": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "width": 64, "height": 64,
        "projection": [[1,0,0,0],[0,1,0,0],[0,0,-0.4,0],[0,0,0,1]], {fields}}}"#
    )
}

/// A triangle over the lower left half of the clip square.
const HALF: &str = r#""vertices": [[-1, -1, 0], [1, -1, 0], [-1, 1, 0]], "triangles": [[0, 1, 2]]"#;

fn file(name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("viewer");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    std::fs::write(&file, text).unwrap();
    file
}

/// A tetrahedron with the right angles at the origin, `size` wide.
fn tetrahedron(size: f64) -> String {
    format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
}

#[test]
fn a_file_that_changes_is_shown_anew() {
    let (path, state) = (file("changing.obj", tetrahedron(1.0)), pressed(""));
    let picture = |viewer: &mut Viewer| {
        viewer.draw(&state).unwrap();
        viewer.pixels().to_vec()
    };
    let of_now = || picture(&mut Viewer::new(read(&path).unwrap(), SIZE));
    let mut viewer = Viewer::new(read(&path).unwrap(), SIZE);
    assert!(!viewer.reload() && !viewer.reload());
    let first = picture(&mut viewer);
    assert!(first == of_now());
    file("changing.obj", tetrahedron(2.5));
    let second = of_now();
    assert!(first != second);
    // Until the file is read again, the old one is shown; and not while somebody may be writing it.
    assert!(picture(&mut viewer) == first && !viewer.reload());
    assert!(viewer.reload() && !viewer.reload());
    assert!(picture(&mut viewer) == second);
    // A file that cannot be read leaves the picture, says so in the window, and is tried again when it changes.
    file("changing.obj", "v 0 0\n");
    assert!(!viewer.reload() && viewer.reload() && !viewer.reload());
    assert!(picture(&mut viewer) == second);
    let with_notice = viewer.picture(&state, None);
    file("changing.obj", tetrahedron(2.5));
    assert!(!viewer.reload() && viewer.reload());
    assert!(picture(&mut viewer) == second && viewer.picture(&state, None) != with_notice);
}

#[test]
fn a_scene_changes_with_the_mesh_that_it_names() {
    file("part.obj", tetrahedron(1.0));
    let scene = r#"{"mesh": "part.obj", "camera": {}, "width": 96, "height": 72}"#;
    let mut viewer = Viewer::new(read(&file("part.json", scene)).unwrap(), SIZE);
    let state = viewer.source().state();
    viewer.draw(&state).unwrap();
    let before = viewer.pixels().to_vec();
    file("part.obj", tetrahedron(2.5));
    assert!(!viewer.reload() && viewer.reload());
    viewer.draw(&state).unwrap();
    assert!(viewer.pixels() != before);
}

/// By definition: pixel (x, y) of the window shows pixel ((x − left)/factor, (y − top)/factor) of the display, rounded down.
#[test]
fn a_window_of_any_size_shows_whole_pixels_in_its_middle() {
    let (width, height) = (16, 20);
    let pixels: Vec<_> =
        (0..width * height).map(|i| Rgb888::new(i as u8, (i / 256) as u8 + 100, 7)).collect();
    for ([across, down], factor, [left, top]) in [
        ([16, 20], 1, [0, 0]),
        ([32, 40], 2, [0, 0]),
        ([35, 61], 2, [1, 10]),
        ([100, 45], 2, [34, 2]),
        ([48, 60], 3, [0, 0]),
        // Smaller than the display: its upper left part.
        ([10, 13], 1, [0, 0]),
        ([40, 13], 1, [12, 0]),
        ([1, 1], 1, [0, 0]),
    ] {
        let placement = Placement::new(Size::new(width as u32, height as u32), [across as u32, down as u32]);
        let mut window = vec![0xffff_ffff; across * down];
        placement.fill(&pixels, &mut window);
        for (at, cell) in window.iter().enumerate() {
            let (x, y) = ((at % across) as i32 - left, (at / across) as i32 - top);
            let (x, y) = (x.div_euclid(factor), y.div_euclid(factor));
            let is_inside = (0..width).contains(&x) && (0..height).contains(&y);
            let number = y * width + x;
            let wanted = [0, number as u8, (number / 256) as u8 + 100, 7];
            let wanted = if is_inside { u32::from_be_bytes(wanted) } else { 0x0018_1a1e };
            assert_eq!(*cell, wanted, "{at} of {across} x {down}");
            let centre = [(at % across) as f64 + 0.5, (at / across) as f64 + 0.5];
            assert_eq!(placement.pixel(centre), [x, y]);
        }
    }
}

#[test]
fn a_scene_begins_with_its_own_camera() {
    let source = read(&file("scene.json", flat(HALF))).unwrap();
    let size = source.size().unwrap();
    assert_eq!(size, Size::new(64, 64));
    let mut state = source.state();
    let mut viewer = Viewer::new(source, size);
    viewer.draw(&state).unwrap();
    let covered = |viewer: &Viewer| {
        let paper = viewer.pixels()[63];
        viewer.pixels().iter().filter(|c| **c != paper).count()
    };
    // Pixels whose centres have x + y < 0.
    assert_eq!(covered(&viewer), 64 * 63 / 2);
    // Seen from 60 degrees to the side, the triangle is half as wide.
    let middle = covered(&viewer);
    (0..12).for_each(|_| press(&mut state, "right"));
    viewer.draw(&state).unwrap();
    let aside = covered(&viewer);
    assert!(aside.abs_diff(middle / 2) < 64, "{aside} of {middle}");
    // Half as wide and half as high.
    press(&mut state, "0 - - - - - - -");
    viewer.draw(&state).unwrap();
    let small = covered(&viewer) as f64;
    let expected = middle as f64 / 1.1f64.powi(14);
    assert!((small - expected).abs() < 64.0, "{small} {expected}");
    // The next projections are the named ones.
    press(&mut state, "0 p");
    assert_eq!(viewer.draw(&state).unwrap().statistics.drawn, 1);
}

/// A triangle and two sprites in a corner of the clip square, one of which the triangle hides.
fn scene_with_sprites() -> Source {
    let sprites =
        r#""sprites": [{"color": [0, 0, 255], "pixels": 6, "at": [[0.5, 0.5, 0], [-0.5, -0.5, -0.5]]}]"#;
    read(&file("sprites.json", flat(&format!("{HALF}, {sprites}")))).unwrap()
}

#[test]
fn sprites_of_a_scene_turn_with_it() {
    let source = scene_with_sprites();
    let mut state = source.state();
    let mut viewer = Viewer::new(source, Size::new(64, 64));
    // The columns and rows of pixels of the sprites' colour.
    let mut blue = |state: &State| {
        let shown = viewer.draw(state).unwrap();
        assert_eq!((shown.sprites.drawn, shown.statistics.drawn), (2, 1));
        let all = viewer.pixels().iter().enumerate().filter(|(_, &pixel)| pixel == Rgb888::BLUE);
        let all: Vec<_> = all.map(|(at, _)| [at % 64, at / 64]).collect();
        let side = |i: usize| all.iter().map(move |at| at[i]);
        (all.len(), [0, 1].map(|i| [side(i).min().unwrap(), side(i).max().unwrap()]))
    };
    assert_eq!(blue(&state), (36, [[45, 50], [13, 18]]));
    // From 60 degrees to the side, half as far from the middle: upright, and as large. The other one comes out beside the triangle.
    (0..12).for_each(|_| press(&mut state, "right"));
    let (count, [columns, rows]) = blue(&state);
    assert_eq!((rows[0], columns[1]), (13, 42));
    assert!((36..=72).contains(&count), "{count}");
    // The named projections show them, too.
    press(&mut state, "0 p");
    assert!(blue(&state).0 > 0);
}

/// A model's picture is shown in every projection, if it is asked for.
#[test]
fn a_model_s_picture_is_its_texture() {
    let model = testing::textured(file("textured", "").parent().unwrap());
    let options = Options { texture: Some(pinhole_import::TextureFormat::default()), ..Options::default() };
    for keys in ["C C", "C C p p p"] {
        let mut viewer = Viewer::new(Source::read(&model, &options).unwrap(), SIZE);
        viewer.draw(&pressed(keys)).unwrap();
        let met = colours(viewer.pixels());
        assert!(met.contains(&[255, 0, 0]) && met.contains(&[0, 0, 255]), "{keys}: {met:?}");
    }
    let mut viewer = Viewer::new(read(&model).unwrap(), SIZE);
    viewer.draw(&pressed("C C")).unwrap();
    assert!(!colours(viewer.pixels()).contains(&[255, 0, 0]));
}

#[test]
fn a_scene_s_culling_is_that_of_its_file() {
    // One triangle turned to the eye, and one turned away.
    let mesh = r#""vertices": [[-1, -1, 0], [0, -1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]], "triangles": [[0, 1, 2], [1, 4, 3]]"#;
    for (cull, culled) in [("none", 0), ("back", 1)] {
        let json = flat(&format!(r#"{mesh}, "cull": "{cull}""#));
        let source = read(&file(&format!("cull_{cull}.json"), &json)).unwrap();
        let (mut state, size) = (source.state(), source.size().unwrap());
        let mut viewer = Viewer::new(source, size);
        let mut after = |keys: &str| {
            press(&mut state, keys);
            let statistics = viewer.draw(&state).unwrap().statistics;
            (statistics.drawn, statistics.culled)
        };
        assert_eq!(after(""), (2 - culled, culled), "{cull}");
        // The key turns it over, and there is a way back.
        assert_eq!(after("k"), (1 + culled, 1 - culled), "{cull}");
        assert_eq!(after("0"), (2 - culled, culled), "{cull}");
    }
}

#[test]
fn a_file_that_is_shown_is_not_a_picture_s() {
    let model = file("shown.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let scene = file("shown.json", flat(r#""mesh": "shown.obj""#));
    for (read, kept) in [(&model, &model), (&scene, &scene), (&scene, &model)] {
        let source = self::read(read).unwrap();
        let said = source.apart_from(kept).unwrap_err();
        assert!(said.starts_with(kept.to_str().unwrap()) && said.contains("is the input file"), "{said}");
        source.apart_from(&read.with_extension("png")).unwrap();
    }
}

#[test]
fn what_cannot_be_read_or_drawn_is_named_by_its_file() {
    for (name, text) in [("bad.obj", "v 0 0\n"), ("bad.json", "{}"), ("bad.txt", "")] {
        let error = read(&file(name, text)).err().unwrap();
        assert!(error.contains(&format!("{name}:")) && error.lines().count() == 1, "{error}");
    }
    let scene = file("lopsided.json", flat(HALF).replacen("[1,0,0,0]", "[2,0,0,0]", 1));
    let source = read(&scene).unwrap();
    let state = source.state();
    let said = Viewer::new(source, SIZE).draw(&state).unwrap_err();
    assert!(said.starts_with(&format!("{}: view: ", scene.display())), "{said}");
}
