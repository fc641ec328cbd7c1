// A head-up display over a torus: the time of the last 60 frames as a graph, frames per second, and the statistics of the
// library. 240 × 240 pixels, with depth and smooth shading, in bands of 8 rows.
use core::fmt::Write;
use embedded_graphics::mono_font::{ascii::FONT_8X13, MonoTextStyle};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::{prelude::*, primitives::Rectangle, text::Text};
use pinhole::{math::Sphere, meshes::TORUS, prelude::*, Angle};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
const CAMERA: Camera = {
    let Ok(viewport) = Viewport::new(SCREEN.top_left, SCREEN.size) else { panic!("the size") };
    let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_ratio(5, 4) };
    let (fov, yaw, pitch) = (Angle::degrees(30), Angle::ZERO, Angle::degrees(40));
    let Ok(camera) = Camera::framing(&sphere, &viewport, fov, yaw, pitch) else { panic!("the view") };
    camera
};

/// All memory that a frame needs, and the microseconds that each of the last 60 frames took.
pub struct Hud(MeshBuffers!(TORUS), StripBuffers!(Rgb565, 240, 8), [u32; 60]);

impl Hud {
    pub const fn new() -> Self {
        Self(mesh_buffers!(TORUS), strip_buffers!(Rgb565, 240, 8), [0; 60])
    }

    /// Draws a frame with the torus turned by `turn`. `micros` is the time that the previous frame took, in microseconds.
    pub fn draw<D: DrawTarget<Color = Rgb565>>(
        &mut self,
        turn: Angle,
        micros: u32,
        to: &mut D,
    ) -> Result<(), D::Error> {
        let (Self(mesh, strip, times), mut levels) = (self, [0; TORUS.vertices().len()]);
        times.rotate_left(1);
        times[59] = micros;
        let model = Affine::rotation_x(turn).rotate_z(turn + turn);
        let light = Lambert::new(&model, Vector3::from_ints(2, 3, 4), 60).expect("a direction");
        light.levels(TORUS.vertex_normals(), &mut levels);
        let instance = CAMERA.place(&TORUS, &model);
        let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).expect("room");
        let (mut text, counts) = (heapless::String::<64>::new(), faces.statistics());
        let (ms, fps) = (micros / 1000, 1_000_000 / micros.max(1));
        write!(text, "{ms} ms, {fps} fps\n{} faces\n{} culled", counts.drawn, counts.culled).expect("short");

        let mut frame = Frame::new(SCREEN, Rgb565::BLACK);
        while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
            let shade = |face| Gouraud::lit(Rgb888::CSS_MEDIUM_TURQUOISE, TORUS.corners_of(face, &levels));
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(&mut depth));
            let Ok(_) = Text::new(&text, Point::new(6, 16), MonoTextStyle::new(&FONT_8X13, Rgb565::WHITE))
                .draw(&mut band);
            for (x, &micros) in (0..).zip(times.iter()) {
                // A pixel for each millisecond; red where a frame took longer than a thirtieth of a second.
                let (height, late) = (micros / 1000, micros > 33_333);
                let bar = Rectangle::new(Point::new(6 + 2 * x, 234 - height as i32), Size::new(1, height));
                let Ok(()) =
                    band.fill_solid(&bar, if late { Rgb565::CSS_TOMATO } else { Rgb565::CSS_LIME_GREEN });
            }
            band.send(to)?;
        }
        Ok(())
    }
}
