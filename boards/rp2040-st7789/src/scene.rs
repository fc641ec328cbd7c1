//! A lit cube, and the memory that drawing it takes.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor, WebColors};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Affine, Angle, Band, BinnedFaces, Camera, Dim, Frame, Lambert, Mesh, MeshInstance, Point3, Projection,
    Scalar, ScreenVertex, Vector3, ViewTransform, Viewport,
};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
const ROWS: u32 = 8;
pub const BANDS: u32 = SCREEN.size.height / ROWS;
/// A transfer gives back what it sent: after a shorter band the strip would be shorter.
const _: () = assert!(SCREEN.size.height % ROWS == 0);
pub const FIRST_BAND: Rectangle = Rectangle::new(Point::zero(), Size::new(SCREEN.size.width, ROWS));
pub const STRIP: usize = Frame::<Rgb565>::strip_bytes(SCREEN.size.width, ROWS);

const VERTICES: [[i16; 3]; 8] =
    [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1], [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]];
/// Two for each side.
const FACES: [[u16; 3]; 12] = [
    [0, 1, 2],
    [0, 2, 3],
    [5, 4, 7],
    [5, 7, 6],
    [1, 5, 6],
    [1, 6, 2],
    [4, 0, 3],
    [4, 3, 7],
    [3, 2, 6],
    [3, 6, 7],
    [4, 5, 1],
    [4, 1, 0],
];
const ONE: i16 = i16::MAX;
/// Of each side, in 2⁻¹⁵.
const NORMALS: [[i16; 3]; 6] =
    [[0, 0, ONE], [0, 0, -ONE], [ONE, 0, 0], [-ONE, 0, 0], [0, ONE, 0], [0, -ONE, 0]];
/// Checked by the compiler.
const CUBE: Mesh<'static> = match Mesh::new(&VERTICES, 0, &FACES) {
    Ok(mesh) => mesh,
    Err(_) => panic!("no sound mesh"),
};

/// It stands still: the compiler makes it.
const CAMERA: Camera = {
    let (eye, origin, up) =
        (Point3::from_ints(0, 3, 6), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0));
    let Ok(view) = ViewTransform::look_at(eye, origin, up) else { panic!("the direction") };
    let (near, far) = (Scalar::const_from_int(1), Scalar::const_from_int(12));
    let Ok(lens) = Projection::perspective(Angle::degrees(35), SCREEN.size, near, far) else {
        panic!("the lens")
    };
    let Ok(viewport) = Viewport::new(SCREEN.top_left, SCREEN.size) else { panic!("the screen") };
    Camera::new(&view, &lens, &viewport)
};

pub struct Scene {
    instance: MeshInstance<'static>,
    corners: [ScreenVertex; VERTICES.len()],
    /// One for each face, and one for every 16 of them.
    bin_storage: [u16; FACES.len() + 1],
}

/// The cube of a frame, as far as it is drawn.
pub struct Turned<'a> {
    frame: Frame<Rgb565>,
    faces: BinnedFaces<'a>,
    light: Lambert,
}

impl Scene {
    pub fn new() -> Self {
        let instance = CAMERA.place(&CUBE, &Affine::identity());
        Self { instance, corners: [ScreenVertex::EMPTY; VERTICES.len()], bin_storage: [0; FACES.len() + 1] }
    }

    /// A frame: vertices are transformed and faces sorted out, once.
    pub fn turned(&mut self, turn: Angle) -> Turned<'_> {
        let model = Affine::rotation_y(turn);
        self.instance = CAMERA.place(&CUBE, &model);
        Turned {
            frame: Frame::new(SCREEN, Rgb565::BLACK),
            faces: self.instance.transform(&mut self.corners).bin_faces(&mut self.bin_storage).unwrap(),
            light: Lambert::new(&model, Vector3::from_ints(2, 3, 4), 40).unwrap(),
        }
    }
}

impl Turned<'_> {
    /// The next of the frame's bands, drawn.
    pub fn next_band<'s>(&mut self, strip: &'s mut [u8]) -> Band<'s, Rgb565> {
        let mut band = self.frame.next_band(strip).unwrap().expect("one of BANDS");
        let shade = |face: usize| Rgb565::CSS_GOLD.dim(self.light.level(NORMALS[face / 2]));
        let Ok(_) = self.faces.solid(shade, &mut band.pixels());
        band
    }
}
