//! The frames of `hello`: the teapot, drawn into memory. Firmware and host tests share this file, so that they can compare
//! pictures by checksums.

use core::convert::Infallible;
use core::fmt;
use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    pixelcolor::{raw::ToBytes, Gray4, GrayColor, Rgb565, RgbColor},
    primitives::Rectangle,
    Pixel,
};
use pinhole::{prelude::*, Angle};

const SIZE: Size = Size::new(128, 64);
const PIXELS: usize = (SIZE.width * SIZE.height) as usize;

/// The number of frames of each kind.
const TURN: u32 = 6;
const KINDS: [&str; 4] = ["solid", "wireframe", "depth", "bands"];
pub(crate) const FRAMES: u32 = TURN * KINDS.len() as u32;

/// Checked by the compiler: an invalid mesh does not compile.
const TEAPOT: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES) else { panic!() };
    let Ok(mesh) = mesh.with_edges(&teapot::EDGES) else { panic!() };
    let Ok(mesh) = mesh.with_normals(&teapot::NORMALS) else { panic!() };
    mesh
};

/// Room for the vertices, and for the corners of faces that the near plane cuts.
const CORNERS: usize = teapot::VERTICES.len() + 300;
const FACES: usize = teapot::FACES.len();
/// Eight rows in 16 greys, two pixels a byte.
const STRIP: usize = Frame::<Gray4>::strip_bytes(SIZE.width, 8);

/// The memory the show needs; firmware keeps it in a `static`.
pub(crate) struct Stage {
    pixels: [Rgb565; PIXELS],
    depth: [u16; PIXELS],
    strip: [u8; STRIP],
    painter: Painter<Rgb565, CORNERS, FACES>,
}

/// The smallest `DrawTarget`: a picture in memory, which the library draws into as into any display.
struct Canvas<'a>(&'a mut [Rgb565; PIXELS]);

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        SIZE
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, colour) in pixels {
            // Negative numbers count as large ones, and what lies beside the picture is left out.
            let (x, y) = (x as u32, y as u32);
            if x < SIZE.width && y < SIZE.height {
                self.0[(y * SIZE.width + x) as usize] = colour;
            }
        }
        Ok(())
    }
}

/// One line about a frame.
pub(crate) struct Report {
    frame: u32,
    checksum: u32,
    statistics: Statistics,
}

impl Stage {
    pub(crate) const fn new() -> Self {
        Self {
            pixels: [Rgb565::BLACK; PIXELS],
            depth: [0; PIXELS],
            strip: [0; STRIP],
            painter: Painter::new(),
        }
    }

    /// Draws one frame. Each kind turns the teapot once around and comes closer all the time, until the near plane and
    /// the edges of the picture cut it.
    pub(crate) fn draw(&mut self, frame: u32) -> Report {
        let step = (frame % TURN) as i16;
        let turn = Angle::turns(step.into(), TURN);
        let model = Affine::rotation_y(turn);
        let instance = camera(40 - 6 * step).place(&TEAPOT, &model);

        let mut canvas = Canvas(&mut self.pixels);
        let Ok(()) = canvas.clear(Rgb565::new(2, 6, 6));
        let light = Lambert::new(&model, Vector3::from_ints(1, 2, 3), 48).expect("light");
        let shade = |face: usize| match teapot::NORMALS.get(face) {
            Some(&normal) => Rgb565::new(31, 52, 14).dim(light.level(normal)),
            None => Rgb565::MAGENTA,
        };
        let mut cache = [ScreenVertex::EMPTY; teapot::VERTICES.len()];
        if frame / TURN == 3 {
            let (statistics, checksum) = self.draw_bands(&instance, |face| shade(face).into());
            return Report { frame, checksum, statistics };
        }
        let Ok(statistics) = match frame / TURN {
            0 => {
                instance.faces(shade).sorted(&mut self.painter).expect("room for the teapot");
                self.painter.draw(&mut canvas)
            }
            1 => instance.edges(|_| Rgb565::CYAN).cached(&mut cache).draw(&mut canvas),
            _ => {
                let area = Rectangle::new(Point::zero(), SIZE);
                let mut depth = DepthBuffer::new(area, &mut self.depth).expect("a depth for each pixel");
                instance.faces(shade).cached(&mut cache).draw(&mut canvas.depth_tested(&mut depth))
            }
        };
        let mut checksum = crc32(self.pixels.iter().flat_map(|pixel| pixel.to_be_bytes()));
        if frame / TURN == 2 {
            checksum ^= crc32(self.depth.iter().flat_map(|depth| depth.to_be_bytes()));
        }
        Report { frame, checksum, statistics }
    }

    /// Draws faces and hidden lines in bands, and computes a checksum of the bytes that a display would get.
    fn draw_bands(
        &mut self,
        instance: &MeshInstance<'_>,
        shade: impl Fn(usize) -> Gray4,
    ) -> (Statistics, u32) {
        let mut cache = [ScreenVertex::EMPTY; teapot::VERTICES.len()];
        // Its memory is enough for the bins and for the depths of a band.
        let (face_bins, rest) = self.depth.split_at_mut(TEAPOT.face_bins_len());
        let (edge_bins, depths) = rest.split_at_mut(TEAPOT.edge_bins_len());
        let transformed = instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(face_bins).expect("room for the teapot");
        let mut edges = transformed.bin_edges(edge_bins).expect("room for its edges");
        let mut frame = Frame::new(Rectangle::new(Point::zero(), SIZE), Gray4::new(2));
        let mut checksum = 0_u32;
        while let Some(mut band) = frame.next_band(&mut self.strip).expect("room for a row") {
            let mut depth = DepthBuffer::new(band.area(), depths).expect("a depth for each pixel");
            let mut target = band.depth_tested(&mut depth);
            let Ok(()) = faces.draw(&shade, &mut target);
            let Ok(()) = edges.hidden_line(Gray4::WHITE, &mut target);
            checksum = checksum.rotate_left(1) ^ crc32(band.bytes().iter().copied());
        }
        (faces.statistics(), checksum)
    }
}

fn camera(distance: i16) -> Camera {
    let eye = Point3::from_ints(0, distance / 3, distance);
    let viewing = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))
        .expect("a direction");
    let (near, far) = (Scalar::from_int(1), Scalar::from_int(100));
    let projection = Projection::perspective(Angle::degrees(30), SIZE, near, far).expect("a field of view");
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a picture");
    Camera::new(&viewing, &projection, &viewport)
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { frame, checksum, statistics } = self;
        let kind = KINDS.get((*frame / TURN) as usize).copied().unwrap_or_default();
        let Statistics { drawn, culled, clipped, outside, degenerate, .. } = statistics;
        write!(
            f,
            "frame {frame:2} {kind:9} crc {checksum:08x}: \
             {drawn} drawn, {culled} culled, {clipped} clipped, {outside} outside, {degenerate} degenerate"
        )
    }
}

/// CRC-32 as in zip and PNG. Bit by bit: a table would be larger than the code.
fn crc32(bytes: impl Iterator<Item = u8>) -> u32 {
    !bytes.fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}
