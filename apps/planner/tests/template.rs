//! By default the page draws what the templates for firmware draw, by their own code.

use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, Rgb888, RgbColor};
use embedded_graphics::prelude::{Point, Size};
use embedded_graphics::primitives::Rectangle;
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{Edges, Options};
use pinhole_planner::{Choice, Planner};
use pinhole_render::firmware::TEMPLATE;

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right
#[path = "../../../boards/stm32-ssd1306/src/picture.rs"]
mod hidden_lines;
#[allow(dead_code, unreachable_pub)] // its `main` is for cargo
#[path = "../../../boards/stm32-ssd1306/build.rs"]
mod hidden_lines_script;

#[test]
fn the_default_picture_is_the_templates() {
    let gear = concat!(env!("CARGO_MANIFEST_DIR"), "/../../boards/common/all/model.stl");
    let mesh = pinhole_import::import(gear.as_ref(), &(TEMPLATE.options)()).expect("the gear");
    for (turn, [width, height]) in [(0, [240, 240]), (7, [240, 240]), (33, [320, 240])] {
        let mut canvas = Canvas::new(Size::new(width, height), Rgb565::BLACK);
        (TEMPLATE.draw)(&mesh, pinhole::Angle::turns(turn, 120), &mut canvas).expect("a frame");
        let expected: Vec<u8> = canvas
            .pixels()
            .iter()
            .flat_map(|&color| {
                let color = Rgb888::from(color);
                [color.r(), color.g(), color.b(), 255]
            })
            .collect();
        let choice = Choice::parse(&format!("width={width}&height={height}&turn={turn}")).expect("a choice");
        let (pixels, _) = Planner::default().draw(&choice).expect("a picture");
        assert!(pixels == expected, "step {turn} of a turn on {width} × {height} pixels");
    }
}

/// With the page's angle of edges, which the firmware that the page saves has, too.
#[test]
fn hidden_lines_are_the_templates() {
    let gear = concat!(env!("CARGO_MANIFEST_DIR"), "/../../boards/common/all/model.stl");
    let options = Options { edges: Edges::Feature { degrees: 1.0 }, ..hidden_lines_script::options() };
    let imported = pinhole_import::import(gear.as_ref(), &options).expect("the gear");
    let mesh = imported.mesh().expect("a mesh");
    let (mut face_bins, mut edge_bins) = (vec![0; mesh.face_bins_len()], vec![0; mesh.edge_bins_len()]);
    let mut cache = vec![pinhole::camera::ScreenVertex::EMPTY; mesh.vertices().len()];
    let mut depths = vec![0; hidden_lines::PIXELS];
    let bins = [&mut face_bins[..], &mut edge_bins[..]];
    let mut picture = hidden_lines::Picture::new(&mesh, &mut cache, bins, &mut depths).expect("a picture");
    // The text in the upper left corner is drawn by the firmware alone.
    let text = Rectangle::new(Point::zero(), Size::new(18, 10));
    for turn in [0, 7, 33] {
        let mut turned = picture.turned(turn).expect("a frame");
        let mut frame = hidden_lines::frame(hidden_lines::SCREEN);
        let (mut strip, mut expected) = ([0; hidden_lines::PIXELS / 8], Vec::new());
        for _ in 0..hidden_lines::SCREEN.size.height / hidden_lines::ROWS {
            let band = turned.next_band(&mut frame, &mut strip).expect("a band");
            expected.extend(band.colors());
        }
        let choice = format!("width=128&height=64&format=mono&style=hidden-line&color=ffffff&turn={turn}");
        let choice = Choice::parse(&choice).expect("a choice");
        let (pixels, _) = Planner::default().draw(&choice).expect("a picture");
        let found = pixels.chunks_exact(4).map(|pixel| BinaryColor::from(pixel.first() == Some(&255)));
        let differ = found.zip(expected).enumerate().filter(|(at, (found, expected))| {
            let point = Point::new((at % 128) as i32, (at / 128) as i32);
            found != expected && !text.contains(point)
        });
        assert_eq!(differ.count(), 0, "step {turn} of a turn");
    }
}
