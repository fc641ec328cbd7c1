//! A teapot that turns and comes closer, in bands: frames, and what there is to say about them. On the host too, for
//! the test.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{prelude::*, target::BufferError, Angle};

pub(crate) const FRAMES: u32 = 8;
pub(crate) const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
const ROWS: u32 = 8;
const STRIP: usize = Frame::<Gray8>::strip_bytes(AREA.size.width, ROWS);

/// Checked by the compiler.
const TEAPOT: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES) else { panic!() };
    let Ok(mesh) = mesh.with_normals(&teapot::NORMALS) else { panic!() };
    mesh
};

const BIN_STORAGE: usize = TEAPOT.face_bins_len();

/// The memory of a film.
pub(crate) struct Film {
    cache: [ScreenVertex; teapot::VERTICES.len()],
    bins: [u16; BIN_STORAGE],
    strip: [u8; STRIP],
}

impl Film {
    pub(crate) const fn new() -> Self {
        Self {
            cache: [ScreenVertex::EMPTY; teapot::VERTICES.len()],
            bins: [0; BIN_STORAGE],
            strip: [0; STRIP],
        }
    }

    /// Draws a frame; there is no display to send it to. What became of its faces, and how many bands it took.
    pub(crate) fn draw(&mut self, number: u32) -> Result<(Statistics, u32), BufferError> {
        let model = Affine::rotation_y(Angle::turns(number as i32, FRAMES));
        let light = Lambert::new(&model, Vector3::from_ints(1, 2, 3), 48).expect("a direction");
        let shade = |face: usize| Gray8::new(teapot::NORMALS.get(face).map_or(0, |&n| light.level(n) as u8));

        let instance = camera(40 - 4 * number as i16).place(&TEAPOT, &model);
        // Every fourth frame has too little room, to show how it is dropped.
        let room = if number % 4 == 3 { BIN_STORAGE / 2 } else { BIN_STORAGE };
        let bins = self.bins.get_mut(..room).unwrap_or_default();
        let mut faces = instance.transform(&mut self.cache).bin_faces(bins)?;
        let mut frame = Frame::new(AREA, Gray8::BLACK);
        let mut bands = 0;
        while let Some(mut band) = frame.next_band(&mut self.strip).expect("room for a row") {
            let Ok(()) = faces.draw(shade, &mut band.pixels());
            bands += 1;
        }
        Ok((faces.statistics(), bands))
    }
}

pub(crate) fn camera(distance: i16) -> Camera {
    let origin = Point3::from_ints(0, 0, 0);
    let up = Vector3::from_ints(0, 1, 0);
    let view = ViewTransform::look_at(Point3::from_ints(0, 6, distance), origin, up).expect("a direction");
    let (near, far) = (Scalar::from_int(1), Scalar::from_int(100));
    let projection =
        Projection::perspective(Angle::degrees(30), AREA.size, near, far).expect("a field of view");
    Camera::new(&view, &projection, &Viewport::new(AREA.top_left, AREA.size).expect("a picture"))
}
