//! How choices are parsed, and what they draw.

use pinhole_planner::{Choice, Planner, Style, DISPLAYS, READY};
use serde_json::Value;

fn choice(text: &str) -> Choice {
    Choice::parse(text).expect(text)
}

/// The costs of a choice.
fn costs(planner: &mut Planner, text: &str) -> Value {
    let costs = planner.costs(&choice(text)).expect(text);
    serde_json::from_str(&costs).expect("JSON")
}

/// The way to draw that is chosen.
fn chosen(planner: &mut Planner, text: &str) -> Value {
    let costs = costs(planner, text);
    let way = costs["ways"].as_array().and_then(|ways| ways.iter().find(|way| way["chosen"] == 1));
    way.expect("a chosen way").clone()
}

#[test]
fn a_message_names_the_part_and_what_may_stand_there() {
    let message = |text: &str| Choice::parse(text).expect_err(text);
    assert_eq!(message("zoom=5"), "zoom=5: not a whole number from 20 to 2000");
    assert_eq!(message("style=3d"), "style=3d: none of wireframe, hidden-line, flat, gouraud, textured");
    assert_eq!(
        message("light=0,0,0"),
        "light=0,0,0: not a direction: three whole numbers from -99 to 99, not all 0, such as 2,3,4"
    );
    assert_eq!(message("colour=ffffff"), "colour=ffffff: no such part");
    assert_eq!(message("color=+fffff"), "color=+fffff: not a colour: six hexadecimal digits");
    assert_eq!(message("yaw=NaN"), "yaw=NaN: not a number of degrees from -360 to 360");
    assert_eq!(message("flat"), "a part without `=`: write name=value");
}

#[test]
fn a_projection_has_directions_of_its_own_that_others_replace() {
    let isometric = choice("projection=isometric");
    assert_eq!(Choice::parse("yaw=45&pitch=35.26&projection=isometric"), Ok(isometric));
}

#[test]
fn no_file_is_a_message() {
    let file = choice("mesh=file");
    let drawn = Planner::default().draw(&file);
    assert_eq!(drawn, Err("no file: drop an STL or OBJ file, or choose a mesh".into()));
}

#[test]
fn a_model_has_the_colors_of_its_material_library() {
    let mut planner = Planner::default();
    let model = "mtllib part.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nusemtl leaf\nf 1 2 3 4\n";
    planner.load("part.obj", model.into());
    let middle = |planner: &mut Planner| -> [u8; 4] {
        let (pixels, _) = planner.draw(&choice("mesh=file&projection=front&ambient=256")).expect("a picture");
        let at = 4 * (120 * 240 + 100);
        std::array::from_fn(|channel| pixels[at + channel])
    };
    assert_eq!(middle(&mut planner), [255, 215, 0, 255], "the page's colour");
    planner.load("part.mtl", b"newmtl leaf\nKd 0 1 0\n".into());
    assert_eq!(middle(&mut planner), [0, 255, 0, 255]);
}

/// Folders in a name are left out: a ZIP with such a path would be unpacked outside its folder.
#[test]
fn a_firmware_has_the_libraries_that_its_model_uses() {
    let mut planner = Planner::default();
    for name in ["../../part.mtl", r"..\..\other.mtl", "build.mtl"] {
        planner.load(name, b"newmtl leaf\nKd 0 1 0\n".into());
    }
    let model = "mtllib OTHER.mtl part.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nusemtl leaf\nf 1 2 3\n";
    planner.load("/models/part.obj", model.into());
    let mut names = |text: &str| {
        let files = planner.model(&choice(text)).expect("files");
        files.into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert_eq!(names("mesh=file"), ["model.obj", "other.mtl", "part.mtl"]);
    assert_eq!(names("mesh=gear"), ["model.stl"]);
}

#[test]
fn lines_are_where_the_surface_turns_by_more_than_the_angle() {
    // A roof: two slopes that meet at 90 degrees, each of two triangles, so that there is a diagonal on each.
    let roof = "v 0 0 0\nv 4 0 0\nv 4 1 1\nv 0 1 1\nv 4 0 2\nv 0 0 2\nf 1 4 3 2\nf 4 6 5 3\n";
    let mut planner = Planner::default();
    planner.load("roof.obj", roof.into());
    let mut edges = |text: &str| {
        let (_, about) = planner.draw(&choice(&format!("mesh=file&format=mono&{text}"))).expect("a picture");
        let (_, rest) = about.split_once(r#""edges":"#).expect("edges");
        rest.split_once(',').map(|(number, _)| number.parse::<u32>())
    };
    // Six at the border of the sheet, the ridge, and the two diagonals.
    assert_eq!(edges("style=wireframe"), Some(Ok(9)));
    assert_eq!(edges("style=wireframe&edges=1"), Some(Ok(7)));
    assert_eq!(edges("style=hidden-line"), Some(Ok(7)));
    assert_eq!(edges("style=hidden-line&edges=89"), Some(Ok(7)));
    assert_eq!(edges("style=hidden-line&edges=91"), Some(Ok(6)));
    assert_eq!(edges("style=flat&edges=91"), Some(Ok(0)));
}

#[test]
fn a_broken_file_is_a_message_and_a_doubtful_one_a_warning_with_its_remedy() {
    let mut planner = Planner::default();
    let file = choice("mesh=file");
    planner.load("part.stl", b"no model".to_vec());
    let message = planner.draw(&file).map(|_| ()).expect_err("broken").to_string();
    assert!(message.starts_with("part.stl: "), "{message}");

    planner.load("stray.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n".to_vec());
    let message = planner.draw(&file).map(|_| ()).expect_err("stray").to_string();
    assert_eq!(message, "stray.obj:4: the face names a vertex that does not exist: export the model again");

    planner.load("sheet.obj", b"v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n".to_vec());
    let (_, about) = planner.draw(&file).expect("a sheet");
    assert!(
        about.contains(r#""remedies":[{"name":"use faces from behind","changes":{"two-sided":1}}],"message":"open edges: 4"#),
        "{about}"
    );
    let (_, about) = planner.draw(&choice("mesh=file&two-sided=1")).expect("a sheet");
    assert!(about.contains(r#""warnings":[]"#), "{about}");
}

#[test]
fn every_mesh_shows_on_every_display_in_every_style() {
    let mut planner = Planner::default();
    for (mesh, _) in &READY {
        for (style, _) in Style::ALL {
            for display in &DISPLAYS {
                let (width, height, format) = (display.width, display.height, display.format.name());
                let text = format!(
                    "mesh={mesh}&width={width}&height={height}&format={format}&style={style}&color=ffffff"
                );
                let chosen = choice(&text);
                let (pixels, _) = planner.draw(&chosen).expect(&text);
                assert_eq!(pixels.len(), 4 * (width * height) as usize, "{text}");
                let lit = pixels.chunks_exact(4).filter(|pixel| pixel.first() > Some(&0)).count();
                assert!(lit > 100, "{text}: {lit} pixels are not black");
                planner.costs(&chosen).expect(&text);
            }
        }
    }
}

/// A picture without texture coordinates lies upright and unmirrored on all six sides: red grows to the right, green downwards.
#[test]
fn a_picture_laid_on_from_six_sides_is_upright_on_each() {
    let mut planner = Planner::default();
    let texels: Vec<u8> = (0..64).flat_map(|i: u8| [i % 8 * 32, i / 8 * 32, 0, 255]).collect();
    assert!(planner.load_picture(&texels, 7).is_err(), "no power of two");
    planner.load_picture(&texels, 8).expect("a picture");
    for side in ["front", "back", "left", "right", "top", "bottom"] {
        let text = format!("mesh=cube&style=textured&texture=file&ambient=256&projection={side}");
        let (pixels, about) = planner.draw(&choice(&text)).expect(&text);
        assert!(about.contains("no texture coordinates"), "{about}");
        let at = |x: usize, y: usize| &pixels[4 * (240 * y + x)..][..2];
        // The texels are 16 to 20 pixels wide, and repeat.
        let step = |from: u8, to: u8| (24..=128).contains(&to.wrapping_sub(from));
        let [here, right, below] = [at(100, 130), at(125, 130), at(100, 155)];
        assert!(step(here[0], right[0]) && here[1] == right[1], "{side}: {here:?}, right of it {right:?}");
        assert!(step(here[1], below[1]) && here[0] == below[0], "{side}: {here:?}, below it {below:?}");
    }
}

#[test]
fn rows_of_a_band_change_no_pixel() {
    let mut planner = Planner::default();
    let mut drawn = |rows: u32| {
        let text = format!("mesh=teapot&style=gouraud&dither=1&zoom=220&x=300&rows={rows}");
        planner.draw(&choice(&text)).expect(&text).0
    };
    let whole = drawn(240);
    for rows in [1, 7, 8, 48] {
        assert!(drawn(rows) == whole, "bands of {rows} rows");
    }
}

/// Every style has a time of its own on every chip, RISC-V among them, in bands of every compared height.
#[test]
fn each_style_has_its_own_time_on_each_chip() {
    let mut planner = Planner::default();
    let menu: Value = serde_json::from_str(&Planner::menu()).expect("JSON");
    let chips = menu["chips"].as_array().expect("a list");
    let chips: Vec<_> = chips.iter().filter_map(|chip| chip["key"].as_str()).collect();
    assert!(chips.contains(&"esp32c3") && chips.len() >= 8, "{chips:?}");
    for chip in chips {
        let mut cycles = |style: &str| -> f64 {
            let way = chosen(&mut planner, &format!("mesh=torus&rows=8&chip={chip}&{style}"));
            way["cycles"].as_f64().expect("a number")
        };
        let [flat, dithered, smooth, both] =
            ["style=flat", "style=flat&dither=1", "style=gouraud", "style=gouraud&dither=1"].map(&mut cycles);
        assert!(flat < dithered && flat < smooth && dithered < both && smooth < both, "{chip}");
        let [lines, hidden] = ["style=wireframe", "style=hidden-line"].map(&mut cycles);
        assert!(lines < hidden, "{chip}: lines {lines}, hidden lines {hidden}");
        // Without perspective, coordinates are interpolated linearly over each face.
        let [parallel, perspective] =
            ["style=textured&projection=cabinet&zoom=50", "style=textured&zoom=50"].map(&mut cycles);
        assert!(flat < parallel && parallel < perspective, "{chip}: {flat}, {parallel}, {perspective}");
    }
}

/// For flat faces in 16-bit colour all ways to draw are compared, each with its time; for other styles the measured ways.
#[test]
fn ways_to_draw_are_compared() {
    let mut planner = Planner::default();
    let mut names = |text: &str| -> String {
        let costs = costs(&mut planner, text);
        let ways = costs["ways"].as_array().expect("ways");
        ways.iter().map(|way| format!("{}; ", way["name"].as_str().expect("a name"))).collect()
    };
    let measured =
        "bands of 8 rows, with depth; bands of 16 rows, with depth; bands of 48 rows, with depth; ";
    let others =
        "bands of 8 rows, painter's order; bands of 8 rows, without depth; a whole picture, with depth; \
                  a whole picture, painter's order; a whole picture, without depth; ";
    assert_eq!(names("rows=8"), measured.to_owned() + others);
    assert_eq!(names("rows=8&format=mono&height=64"), measured);
    assert!(names("style=wireframe&rows=200").ends_with("; lines in a whole picture; "));
}

/// Code that is copied to RAM takes some, and a band has no more rows than the display.
#[test]
fn what_fits_depends_on_where_the_code_is() {
    let mut planner = Planner::default();
    let mut way = |text: &str| {
        planner.draw(&choice(text)).expect(text);
        chosen(&mut planner, text)
    };
    let large = "mesh=gear&width=240&height=250&rows=248";
    assert_eq!(way(&format!("{large}&chip=rp2040"))["fits"], 1);
    assert_eq!(way(&format!("{large}&chip=rp2040-ram"))["fits"], 0);
    for style in ["flat", "gouraud", "textured", "wireframe", "hidden-line"] {
        assert_eq!(way(&format!("style={style}&height=100&rows=1000"))["rows"], 100, "{style}");
    }
}

/// The matrix has the chosen way on each chip, as the costs on this chip have it, and an own chip has the cycles of its core.
#[test]
fn the_matrix_has_the_costs_on_every_chip() {
    let mut planner = Planner::default();
    let menu: Value = serde_json::from_str(&Planner::menu()).expect("JSON");
    let text = "mesh=torus&width=480&height=320&spi=20&wire=24&mhz=100&ram=128&flash=512";
    let all = costs(&mut planner, text)["chips"].clone();
    let keys: Vec<_> =
        menu["chips"].as_array().expect("chips").iter().map(|chip| chip["key"].clone()).collect();
    assert_eq!(all.as_array().map(Vec::len), Some(keys.len()));
    for (key, on) in keys.iter().zip(all.as_array().expect("costs")) {
        let key = key.as_str().expect("a key");
        assert_eq!(chosen(&mut planner, &format!("{text}&chip={key}")), *on, "{key}");
    }
    // An own chip has half of its clock for SPI, of which the display takes 20 MHz.
    let mut way = |more: &str| chosen(&mut planner, &format!("{text}&{more}"));
    assert_eq!(way("chip=own&core=M4"), way("chip=stm32f411"));
    assert_eq!(way("chip=own&core=M33&mhz=150")["drawing"], way("chip=rp2350-ram")["drawing"]);
    let time = |way: Value| way["drawing"].as_f64().expect("a time");
    assert!(time(way("chip=own&core=M7")) < time(way("chip=own&core=M4")));
    assert_eq!([way("chip=own&ram=8")["fits"].clone(), way("chip=own&flash=8")["fitsFlash"].clone()], [0, 0]);
    // 24 bits a pixel, at 20 MHz, and the commands of the bands.
    let bus = way("chip=stm32h743")["bus"].as_f64().expect("a time");
    assert!((bus - (480.0 * 320.0 * 24.0) / 20e3).abs() < 0.3, "{bus} ms");
}

#[test]
fn faces_are_drawn_in_the_order_that_is_chosen() {
    let mut planner = Planner::default();
    let mut picture = |text: &str| planner.draw(&choice(text)).expect(text).0;
    for mesh in ["sphere", "cube"] {
        let [depth, painter, order] =
            ["depth", "painter", "mesh"].map(|order| picture(&format!("mesh={mesh}&order={order}&turn=7")));
        assert!(depth == painter && depth == order, "{mesh} is convex");
    }
    assert!(picture("mesh=gear&order=mesh") != picture("mesh=gear"), "a gear is not convex");
    let mut name = |text: &str| chosen(&mut planner, text)["name"].to_string();
    assert_eq!(name("order=painter&whole=1"), "\"a whole picture, painter's order\"");
    assert_eq!(name("order=mesh&rows=16"), "\"bands of 16 rows, without depth\"");
    assert_eq!(name("order=mesh&whole=1&style=gouraud"), "\"bands of 8 rows, with depth\"");
}
