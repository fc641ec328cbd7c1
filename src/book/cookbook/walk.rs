// A walk through a town of 50 boxes: 320 × 240 pixels, with depth, in bands of 8 rows.
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use pinhole::{meshes::CUBE, prelude::*, Angle};

const SIZE: Size = Size::new(320, 240);
const COLORS: [Rgb565; 5] = [
    Rgb565::CSS_SALMON,
    Rgb565::CSS_KHAKI,
    Rgb565::CSS_SANDY_BROWN,
    Rgb565::CSS_CADET_BLUE,
    Rgb565::CSS_THISTLE,
];
const LENS: Projection = {
    let [near, far] = [Scalar::from_int(1), Scalar::from_int(80)];
    let Ok(lens) = Projection::perspective(Angle::degrees(50), SIZE, near, far) else { panic!("near < far") };
    lens
};

pub type Town = Scene<'static, Rgb565, 50>;

/// Ten rows of five houses, in metres: 2 to 3 wide, 2 to 8 high.
pub fn build() -> Town {
    let mut town = Town::new();
    for house in 0..50 {
        let width = Scalar::from_ratio(house * 5 % 4, 6) + Scalar::ONE; // half of it, as the cube is 2 wide
        let height = Scalar::from_ratio(house * house * 7 % 13 + 4, 4);
        let [x, z] = [house % 5 * 6 - 15, 20 - house / 5 * 6].map(Scalar::from_int);
        let model = Affine::scale_axes(width, height, width).translate(Vector3::new(x, height, z));
        town.add(Object::new(&CUBE, model, COLORS[(house * 3 + house / 5) as usize % 5]))
            .expect("room for 50");
    }
    town
}

/// The town from `eye` in the direction `heading`: 0 is north, −z, and a quarter turn is west, −x.
pub fn draw<D: DrawTarget<Color = Rgb565>>(
    town: &Town,
    (eye, heading): (Point3<World>, Angle),
    display: &mut D,
) -> Result<Statistics, D::Error> {
    let mut buffers = mesh_buffers!([CUBE; 50]);
    let mut strip = strip_buffers!(Rgb565, SIZE.width, 8);
    let back = Vector3::new(heading.sin(), Scalar::ZERO, heading.cos()); // against the gaze
    let view = ViewTransform::from_reference(eye, back, Vector3::from_ints(0, 1, 0)).expect("a level gaze");
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a small display");
    let camera = Camera::new(&view, &LENS, &viewport);
    let placed = town.place(&camera);
    let mut houses = placed.bin_faces(&mut buffers.cache, &mut buffers.bins).expect("room for all houses");
    // No house is turned, so one light serves all.
    let light = Lambert::new(&Affine::identity(), Vector3::from_ints(3, 4, 2), 130).expect("a direction");

    let mut frame = Frame::new(Rectangle::new(Point::zero(), SIZE), Rgb565::CSS_LIGHT_SKY_BLUE);
    while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
        // As the gaze is level, the horizon is in the middle.
        let ground = Rectangle::new(Point::new(0, 120), Size::new(320, 120));
        let Ok(()) = band.fill_solid(&ground, Rgb565::new(11, 28, 10));
        let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
        let shade = |_, house: &Object<'_, Rgb565>| {
            let color = house.material;
            move |face: usize| color.dim(light.level(CUBE.normals()[face]))
        };
        let Ok(()) = houses.draw(shade, &mut band.pixels().depth_tested(&mut depth));
        band.send(display)?;
    }
    Ok(houses.statistics())
}
