// A logo that turns, with a label that follows one of its corners: 240 × 240 pixels, with depth, in bands of 8 rows.
use embedded_graphics::mono_font::{ascii::FONT_9X15_BOLD, MonoTextStyle};
use embedded_graphics::primitives::{Line, PrimitiveStyle, Rectangle};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, text::Text};
use pinhole::{math::Sphere, prelude::*, Angle};

const SIZE: Size = Size::new(240, 240);
const COLORS: [Rgb565; 3] = [Rgb565::CSS_TOMATO, Rgb565::CSS_GOLD, Rgb565::CSS_DEEP_SKY_BLUE];

/// A ring with six sides. Four corners of each side, by radius and z; from corner to corner a quad of two faces.
const PROFILE: [[i32; 2]; 4] = [[100, 26], [56, 26], [56, -26], [100, -26]];
type Parts = ([[i16; 3]; 24], [[u16; 3]; 48], [[i16; 3]; 48]);
const RING: Parts = {
    let (mut vertices, mut faces, mut normals, mut i) = ([[0; 3]; 24], [[0; 3]; 48], [[0; 3]; 48], 0);
    while i < 24 {
        let (sin, cos) = Angle::turns(i as i32 / 4, 6).sin_cos(); // in 2⁻³⁰
        let [radius, z] = PROFILE[i % 4];
        vertices[i] =
            [((radius * (cos >> 15)) >> 15) as i16, ((radius * (sin >> 15)) >> 15) as i16, z as i16];
        let (a, b) = (i as u16, i as u16 / 4 * 4 + (i as u16 + 1) % 4);
        let (c, d) = ((b + 4) % 24, (a + 4) % 24); // of the next side
        (faces[2 * i], faces[2 * i + 1]) = ([a, d, c], [a, c, b]);
        let (sin, cos) = Angle::turns(i as i32 / 4 * 2 + 1, 12).sin_cos();
        let (x, y) = ((cos / 32_769) as i16, (sin / 32_769) as i16); // 1 becomes 32 767
        normals[2 * i] = [[0, 0, 32_767], [-x, -y, 0], [0, 0, -32_767], [x, y, 0]][i % 4];
        normals[2 * i + 1] = normals[2 * i];
        i += 1;
    }
    (vertices, faces, normals)
};
const LOGO: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&RING.0, 0, &RING.1) else { panic!("faces") };
    let Ok(mesh) = mesh.with_normals(&RING.2) else { panic!("normals") };
    mesh
};
const CAMERA: Camera = {
    let Ok(viewport) = Viewport::new(Point::zero(), SIZE) else { panic!("the size") };
    let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(120) };
    let (fov, yaw, pitch) = (Angle::degrees(28), Angle::ZERO, Angle::degrees(20));
    let Ok(camera) = Camera::framing(&sphere, &viewport, fov, yaw, pitch) else { panic!("the view") };
    camera
};

/// All memory that a frame needs, on the stack or in a static.
pub type Memory = (MeshBuffers!(LOGO), StripBuffers!(Rgb565, SIZE.width, 8));

pub fn draw<D: DrawTarget<Color = Rgb565>>(
    turn: Angle,
    memory: &mut Memory,
    to: &mut D,
) -> Result<(), D::Error> {
    let (mesh, strip) = memory;
    let model = Affine::identity().rotate_z(Angle::degrees(15)).rotate_y(turn);
    let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), 70).expect("a direction");
    let instance = CAMERA.place(&LOGO, &model);
    let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).expect("room");
    let corner = instance.project(20).map_or(Point::zero(), Point::from); // in front, at the lower right
    let at = Point::new(corner.x.clamp(4, 170), 228);

    let mut frame = Frame::new(Rectangle::new(Point::zero(), SIZE), Rgb565::new(2, 5, 5));
    while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
        let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
        let shade = |face: usize| COLORS[face / 8 % 3].dim(light.level(LOGO.normals()[face]));
        let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
        // The label goes on top of what the band shows.
        let style = PrimitiveStyle::with_stroke(Rgb565::WHITE, 1);
        let Ok(()) = Line::new(corner, at - Point::new(-31, 12)).into_styled(style).draw(&mut band);
        let Ok(_) =
            Text::new("pinhole", at, MonoTextStyle::new(&FONT_9X15_BOLD, Rgb565::WHITE)).draw(&mut band);
        band.send(to)?;
    }
    Ok(())
}
