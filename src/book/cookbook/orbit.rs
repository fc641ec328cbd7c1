// Twelve bars, one a month. An encoder turns the view around them, and a touch picks a bar: 240 × 240 pixels, with depth, in
// bands of 8 rows.
use core::fmt::Write;
use embedded_graphics::mono_font::{ascii::FONT_10X20, MonoTextStyle};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle, text::Text};
use pinhole::{math::Sphere, meshes::CUBE, prelude::*, Angle};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));

pub struct Chart {
    pub values: [u8; 12],
    pub yaw: Angle,
    pub picked: Option<usize>,
}

impl Chart {
    /// The encoder: 24 clicks are a turn.
    pub fn turn(&mut self, clicks: i8) {
        self.yaw = self.yaw + Angle::turns(clicks.into(), 24);
    }

    /// The touch screen: picks the bar that is seen at this pixel.
    pub fn touch(&mut self, at: Point) {
        let opaque = |_bar, _object: &Object<'_, ()>| |_face| Rgb565::BLACK; // a bar is seen in each pixel that it covers
        let cache = &mut [ScreenVertex::EMPTY; CUBE.vertices().len()];
        let picked = self.bars().place(&self.camera()).pick(opaque, cache, at);
        self.picked = picked.map(|picked| picked.object);
    }

    fn bars(&self) -> Scene<'static, (), 12> {
        let mut bars = Scene::new();
        for (bar, &value) in self.values.iter().enumerate() {
            let (x, z) = (3 * (bar as i16 % 4) - 4, 3 * (bar as i16 / 4) - 3);
            let height = Scalar::from_ratio(value.into(), 24); // half of it, as the cube is 2 high
            let up = Vector3::new(x.into(), height, z.into());
            let model = Affine::scale_axes(Scalar::ONE, height, Scalar::ONE).translate(up);
            bars.add(Object::new(&CUBE, model, ())).expect("room for 12");
        }
        bars
    }

    fn camera(&self) -> Camera {
        let viewport = Viewport::new(SCREEN.top_left, SCREEN.size).expect("a small display");
        let sphere = Sphere { centre: Point3::from_ints(1, 1, 0), radius: Scalar::from_int(7) };
        Camera::framing(&sphere, &viewport, Angle::degrees(30), self.yaw, Angle::degrees(28))
            .expect("a radius")
    }

    pub fn draw<D: DrawTarget<Color = Rgb565>>(&self, display: &mut D) -> Result<(), D::Error> {
        let mut strip = strip_buffers!(Rgb565, 240, 8);
        let mut buffers = mesh_buffers!([CUBE; 12]);
        let (scene, camera) = (self.bars(), self.camera());
        let placed = scene.place(&camera);
        let mut bars = placed.bin_faces(&mut buffers.cache, &mut buffers.bins).expect("room for all bars");
        let light = Lambert::new(&Affine::identity(), Vector3::from_ints(2, 4, 3), 120).expect("a direction");
        let mut text = heapless::String::<16>::new();
        if let Some(bar) = self.picked {
            write!(text, "{}: {} kWh", bar + 1, self.values[bar]).expect("at most 11 characters");
        }

        let mut frame = Frame::new(SCREEN, Rgb565::new(3, 6, 6));
        while let Some(mut band) = frame.next_band(&mut strip.colors).expect("room for a row") {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).expect("room for a row");
            let shade = |bar: usize, _: &Object<'_, ()>| {
                let picked = self.picked == Some(bar);
                let color = if picked { Rgb565::CSS_ORANGE } else { Rgb565::CSS_LIGHT_STEEL_BLUE };
                move |face: usize| color.dim(light.level(CUBE.normals()[face]))
            };
            let Ok(()) = bars.draw(shade, &mut band.pixels().depth_tested(&mut depth));
            let style = MonoTextStyle::new(&FONT_10X20, Rgb565::CSS_ORANGE);
            let Ok(_) = Text::new(&text, Point::new(8, 22), style).draw(&mut band);
            band.send(display)?;
        }
        Ok(())
    }
}
