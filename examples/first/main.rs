//! A pyramid, printed as text.

use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
use pinhole::{prelude::*, Angle};

// A pyramid. Faces are counter-clockwise seen from outside.
const VERTICES: [[i16; 3]; 5] = [[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1], [0, 2, 0]];
const EDGES: [[u16; 2]; 8] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];
const FACES: [[u16; 3]; 6] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 64 × 64 pixels that can be printed; a display's driver is a DrawTarget, too.
    let mut display = MockDisplay::<BinaryColor>::new();
    display.set_allow_overdraw(true);

    let mesh = Mesh::new(&VERTICES, 0, &FACES)?.with_edges(&EDGES)?;
    let viewport = Viewport::new(Point::zero(), display.size())?;
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)?;

    let pyramid = camera.place(&mesh, &Affine::rotation_y(Angle::degrees(10)));
    pyramid.edges(|_| BinaryColor::On).draw(&mut display)?;
    println!("{display:?}");
    Ok(())
}
