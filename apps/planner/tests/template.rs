//! The page draws by default what the templates for firmware draw, by their own code.

use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics::prelude::Size;
use pinhole_apps_support::canvas::Canvas;
use pinhole_planner::{Choice, Planner};
use pinhole_render::firmware::TEMPLATE;

#[test]
fn the_default_picture_is_the_templates() {
    let gear = concat!(env!("CARGO_MANIFEST_DIR"), "/../../boards/any-cortex-m/model.stl");
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
