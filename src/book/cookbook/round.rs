// A torus that turns on a round display of 240 × 240 pixels, with depth, in bands of 8 rows. Each band is as wide as the glass is there.
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use pinhole::{meshes::TORUS, prelude::*, Angle};

const SIDE: u32 = 240;
const ROWS: u32 = 8;

/// All memory that a frame needs, on the stack or in a static.
pub type Memory = (MeshBuffers!(TORUS), StripBuffers!(Rgb565, SIDE, ROWS));

/// The pixels of a band that a round glass shows a part of: the chord of the row nearest to the middle.
pub fn chord(top: u32, rows: u32) -> Rectangle {
    // From the middle of the glass to a row, in half pixels: the radius is `SIDE`.
    let border = |row: u32| (2 * row + 1).abs_diff(SIDE).saturating_sub(1);
    let nearest = (top..top + rows).map(border).min().unwrap_or(0);
    let left = SIDE.saturating_sub((SIDE * SIDE - nearest * nearest).isqrt() + 1) / 2;
    Rectangle::new(Point::new(left as i32, top as i32), Size::new(SIDE - 2 * left, rows))
}

pub fn draw<D: DrawTarget<Color = Rgb565>>(
    turn: Angle,
    memory: &mut Memory,
    to: &mut D,
) -> Result<(), D::Error> {
    let (mesh, strip) = memory;
    let viewport = Viewport::new(Point::zero(), Size::new(SIDE, SIDE)).expect("a small display");
    let (fov, yaw, pitch) = (Angle::degrees(40), Angle::ZERO, Angle::degrees(35));
    let camera = Camera::framing(&TORUS.bounding_sphere(), &viewport, fov, yaw, pitch).expect("a radius");
    let model = Affine::rotation_x(turn);
    let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), 48).expect("a direction");
    let instance = camera.place(&TORUS, &model);
    let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).expect("room");

    for top in (0..SIDE).step_by(ROWS as usize) {
        let mut frame = Frame::new(chord(top, ROWS), Rgb565::new(2, 5, 5));
        while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
            let shade = |face: usize| Rgb565::CSS_GOLD.dim(light.level(TORUS.normals()[face]));
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
            band.send(to)?;
        }
    }
    Ok(())
}
