// Two cubes that pierce each other, with 2 × 2 samples a pixel: bands of a frame twice as wide and high, of which each four samples become
// a pixel. 160 × 128 pixels, with depth, in bands of 4 rows.
use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::{prelude::*, primitives::Rectangle};
use pinhole::{math::Sphere, meshes::CUBE, prelude::*, Angle};

/// The display, and the samples across and down.
const SIZE: Size = Size::new(160, 128);
const SAMPLES: Size = Size::new(2 * SIZE.width, 2 * SIZE.height);
const CAMERA: Camera = {
    let Ok(viewport) = Viewport::new(Point::zero(), SAMPLES) else { panic!("the size") };
    let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_ratio(7, 4) };
    let (fov, yaw, pitch) = (Angle::degrees(30), Angle::ZERO, Angle::degrees(25));
    let Ok(camera) = Camera::framing(&sphere, &viewport, fov, yaw, pitch) else { panic!("the view") };
    camera
};

/// All memory that a frame needs, on the stack or in a static.
pub type Memory = (MeshBuffers!([CUBE; 2]), StripBuffers!(Rgb565, SAMPLES.width, 2 * 4));

pub fn draw<D: DrawTarget<Color = Rgb565>>(
    turn: Angle,
    (buffers, strip): &mut Memory,
    display: &mut D,
) -> Result<(), D::Error> {
    let mut cubes = Scene::<(Rgb565, Lambert), 2>::new();
    for (color, lean) in [(Rgb565::CSS_GOLD, 0), (Rgb565::CSS_STEEL_BLUE, 50)] {
        let model = Affine::rotation_x(Angle::degrees(lean)).rotate_z(Angle::degrees(lean)).rotate_y(turn);
        let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), 60).expect("a direction");
        cubes.add(Object::new(&CUBE, model, (color, light))).expect("room for 2");
    }
    let placed = cubes.place(&CAMERA);
    let mut faces = placed.bin_faces(&mut buffers.cache, &mut buffers.bins).expect("room for both");
    let shade = |_, cube: &Object<'_, (Rgb565, Lambert)>| {
        let (color, light) = cube.material;
        move |face: usize| color.dim(light.level(CUBE.normals()[face]))
    };

    let mut frame = Frame::new(Rectangle::new(Point::zero(), SAMPLES), Rgb565::new(2, 5, 5));
    while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
        let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
        let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
        let row = 2 * SAMPLES.width as usize; // bytes
        let pixels = band.bytes().chunks_exact(2 * row).flat_map(|rows| {
            let (upper, lower) = rows.split_at(row);
            upper.as_chunks().0.iter().zip(lower.as_chunks().0).map(mean)
        });
        let Rectangle { top_left, size } = band.area();
        display.fill_contiguous(&Rectangle::new(top_left / 2, size / 2), pixels)?;
    }
    Ok(())
}

/// The mean of two samples above two others. In 32 bits their channels lie so far apart that there is room for the sums of four.
pub fn mean((&[a, b, c, d], &[e, f, g, h]): (&[u8; 4], &[u8; 4])) -> Rgb565 {
    const APART: u32 = 0x07e0_f81f; // green, red and blue
    let half = 0x0040_1002; // 2 of 4 in each channel, to round to the nearest
    let sum = [[a, b], [c, d], [e, f], [g, h]].iter().fold(half, |sum, &bytes| {
        let bits = u32::from(u16::from_be_bytes(bytes));
        sum + ((bits | bits << 16) & APART)
    });
    let mean = (sum >> 2) & APART;
    RawU16::new((mean | mean >> 16) as u16).into()
}
