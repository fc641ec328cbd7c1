use embedded_graphics_core::{pixelcolor::Rgb565, prelude::*};
use pinhole::*;

const VERTICES: [[i16; 3]; 5] = [[-1, -1, 1], [1, -1, 1], [1, -1, -1], [-1, -1, -1], [0, 1, 0]]; // a pyramid
const FACES: [[u16; 3]; 6] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]];

/// Draws a frame, and sends it band by band.
pub fn draw<D: DrawTarget<Color = Rgb565>>(display: &mut D, turn: Angle) -> Result<(), D::Error> {
    let screen = display.bounding_box();
    let viewport = Viewport::new(screen.top_left, screen.size).expect("at most 8192 pixels away");
    let [eye, origin] = [Point3::from_ints(0, 3, 7), Point3::from_ints(0, 0, 0)];
    let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0)).expect("not straight up");
    let [near, far] = [1, 12].map(Scalar::from_num);
    let projection = Projection::perspective(Angle::degrees(30), screen.size, near, far).expect("near < far");
    let mesh = Mesh::new(&VERTICES, 0, &FACES).expect("faces of these vertices");

    let (mut cache, mut bins) = ([ScreenVertex::EMPTY; 5], [0; 7]); // one per vertex; one per face, and one per 16 faces
    let mut strip = [0; Frame::<Rgb565>::strip_bytes(320, 8)]; // the widest display, and 8 rows
    let instance = Camera::new(&view, &projection, &viewport).place(&mesh, &Affine::rotation_y(turn));
    let mut faces = instance.transform(&mut cache).bin_faces(&mut bins).expect("room for the faces");
    let mut frame = Frame::new(screen, Rgb565::BLACK);
    while let Some(mut band) = frame.next_band(&mut strip).expect("room for a row") {
        let Ok(_) = faces.solid(|face| Rgb565::CSS_GOLD.dim(256 - 40 * face as u16), &mut band.pixels());
        band.send(display)?;
    }
    Ok(())
}
