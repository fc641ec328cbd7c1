// A gauge on a monochrome display of 128 × 64 pixels: a dial and a needle in perspective, and the value as text. Only the
// rectangles that a new value changes are drawn and sent.
use core::fmt::Write;
use embedded_graphics::mono_font::{ascii::FONT_6X13_BOLD, MonoTextStyle};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb888};
use embedded_graphics::{prelude::*, primitives::Rectangle, text::*};
use pinhole::bands::{DirtyRegions, Tracked, TransferCost};
use pinhole::{math::Sphere, prelude::*, Angle};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
/// 21 marks over half a turn from left to right, every fifth one longer, and the outline: vertices and edges.
const DIAL: ([[i16; 3]; 42], [[u16; 2]; 42]) = {
    let (mut vertices, mut edges, mut i) = ([[0; 3]; 42], [[0; 2]; 42], 0);
    while i < 42 {
        let (sin, cos) = Angle::turns(20 - i as i32 / 2, 40).sin_cos(); // in 2⁻³⁰
        let radius = [100, if i % 10 == 1 { 80 } else { 92 }][i % 2];
        vertices[i] = [((radius * (cos >> 15)) >> 15) as i16, ((radius * (sin >> 15)) >> 15) as i16, 0];
        edges[i] = [i as u16 / 2 * 2, (i as u16 + 1) % 42];
        i += 1;
    }
    (vertices, edges)
};
/// From the tip to the tail runs a ridge with a slope on each side: the left one is shown white, the right one grey.
const WEDGE: [[i16; 3]; 5] = [[0, 74, 6], [0, 0, 12], [-10, 0, 0], [0, -16, 4], [10, 0, 0]];
pub const NEEDLE: Mesh<'static> = match Mesh::new(&WEDGE, 0, &[[0, 2, 1], [2, 3, 1], [0, 1, 4], [4, 1, 3]]) {
    Ok(mesh) => mesh,
    Err(_) => panic!("faces"),
};
const CAMERA: Camera = {
    let Ok(viewport) = Viewport::new(SCREEN.top_left, SCREEN.size) else { panic!("the size") };
    let sphere = Sphere { centre: Point3::from_ints(0, 28, 0), radius: Scalar::from_int(52) };
    let (fov, yaw, pitch) = (Angle::degrees(20), Angle::ZERO, Angle::degrees(-35));
    let Ok(camera) = Camera::framing(&sphere, &viewport, fov, yaw, pitch) else { panic!("the view") };
    camera
};

/// The rectangles to send, and the values that the display shows by needle and by text.
pub struct Gauge(DirtyRegions<4>, Tracked<u8>, Tracked<u8>);

impl Gauge {
    pub const fn new() -> Self {
        // For an SSD1306: 6 bytes of commands before each rectangle, and 8 rows in a byte.
        let dirty = DirtyRegions::new(SCREEN, TransferCost::new(1, 6)).with_steps(1, 8);
        Self(dirty, Tracked::new(), Tracked::new())
    }

    /// Shows a value, 0 to 100.
    pub fn set<D: DrawTarget<Color = BinaryColor>>(&mut self, value: u8, to: &mut D) -> Result<(), D::Error> {
        let Self(dirty, shown_needle, shown_text) = self;
        let (mut mesh, mut strip) = (mesh_buffers!(NEEDLE), strip_buffers!(BinaryColor, 128, 16, no depth));
        let model = Affine::rotation_z(Angle::turns(50 - i32::from(value), 200)); // at 50 the needle points up
        let shade = |face| Dithered(Flat::lit(Rgb888::WHITE, if face < 2 { 256 } else { 110 }));
        let instance = CAMERA.place(&NEEDLE, &model);
        let mut needle = instance.transform(&mut mesh.cache).bin_faces(&mut mesh.bins).expect("room");
        let marks = Mesh::new(&DIAL.0, 0, &[]).and_then(|mesh| mesh.with_edges(&DIAL.1)).expect("edges");
        let dial = CAMERA.place(&marks, &Affine::identity());
        let mut text = heapless::String::<8>::new();
        write!(text, "{value} km/h").expect("at most eight characters");
        let style = MonoTextStyle::new(&FONT_6X13_BOLD, BinaryColor::On);
        let text = Text::with_alignment(&text, Point::new(64, 61), style, Alignment::Center);

        shown_needle.show(value, needle.bounds(), dirty);
        shown_text.show(value, text.bounding_box(), dirty);
        for area in dirty.take() {
            let mut frame = Frame::new(area, BinaryColor::Off);
            while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
                let Ok(_) = dial.edges(|_| BinaryColor::On).draw(&mut band);
                let Ok(()) = needle.draw(shade, &mut band);
                let Ok(_) = text.draw(&mut band);
                band.send(to)?;
            }
        }
        Ok(())
    }
}
