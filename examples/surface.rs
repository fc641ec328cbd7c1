//! Ripples on water: a height field whose vertices change in every frame, coloured by height, lit, and dithered to a colour type
//! of its own, of eight bits a pixel, drawn in bands; an animated GIF and a contact sheet:
//!
//! ```text
//! cargo run --release --example surface -- --help
//! ```

use clap::Command;
use embedded_graphics::pixelcolor::raw::RawU8;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use pinhole::{
    Affine, Angle, Camera, Color, DepthBuffer, Flat, Format, Frame, Gouraud, Lambert, Mesh, Point3,
    Projection, Scalar, ScreenVertex, Statistics, Vector3, ViewTransform, Viewport,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::command::Film;
use pinhole_apps_support::{command, film};
use std::error::Error;
use std::process::ExitCode;

/// Rows of a band.
const ROWS: u32 = 16;

/// A colour type of our own: three bits of red, three of green, two of blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rgb332(u8);

impl PixelColor for Rgb332 {
    type Raw = RawU8;
}

impl Color for Rgb332 {
    const FORMAT: Format = Format::rgb(3, 3, 2);

    fn to_bits(self) -> u32 {
        self.0.into()
    }

    fn from_bits(bits: u32) -> Self {
        Self(bits as u8)
    }
}

impl From<Rgb332> for Rgb565 {
    fn from(color: Rgb332) -> Self {
        let [r, g, b] = color.channels().map(u32::from);
        Rgb565::new((r * 31 / 7) as u8, (g * 63 / 7) as u8, (b * 31 / 3) as u8)
    }
}

/// Vertices along a side, and what lies between two of them, in units of 2⁻¹³.
const SIDE: usize = 33;
const STEP: i32 = 1024;
const EXPONENT: i8 = -13;
const VERTICES: usize = SIDE * SIDE;
const FIELDS: usize = (SIDE - 1) * (SIDE - 1);

/// Two triangles for each field between four vertices.
const FACES: [[u16; 3]; 2 * FIELDS] = {
    let mut faces = [[0; 3]; 2 * FIELDS];
    let mut field = 0;
    while field < FIELDS {
        let a = (field / (SIDE - 1) * SIDE + field % (SIDE - 1)) as u16;
        let above = a + SIDE as u16;
        faces[2 * field] = [a, a + 1, above + 1];
        faces[2 * field + 1] = [a, above + 1, above];
        field += 1;
    }
    faces
};

/// What changes in every frame: 12 bytes per vertex.
struct Water {
    vertices: [[i16; 3]; VERTICES],
    normals: [[i16; 3]; VERTICES],
}

impl Water {
    /// A wave that runs outwards from the centre and fades, in integers.
    fn height(x: i32, y: i32, phase: Angle) -> i32 {
        let distance = (x * x + y * y).isqrt();
        let wave = Angle::from_bits((distance as u32) << 19) - phase; // one in 8192 units
        let (sine, _) = wave.sin_cos(); // in 2⁻³⁰
        let strength = 3600 * 8192 / (8192 + distance);
        ((i64::from(sine) * i64::from(strength)) >> 30) as i32
    }

    /// Moves all vertices.
    fn ripple(&mut self, phase: Angle) {
        for (i, (vertex, normal)) in self.vertices.iter_mut().zip(&mut self.normals).enumerate() {
            let [x, y] = [i % SIDE, i / SIDE].map(|i| (i as i32 - SIDE as i32 / 2) * STEP);
            let at = |dx: i32, dy: i32| Self::height(x + dx, y + dy, phase);
            *vertex = [x, y, at(0, 0)].map(|c| c as i16); // within ±16384
            let steep = [at(-STEP, 0) - at(STEP, 0), at(0, -STEP) - at(0, STEP), 2 * STEP];
            let length = steep.iter().map(|c| c * c).sum::<i32>().isqrt();
            *normal = steep.map(|c| (c * 32_767 / (length + 1)) as i16);
        }
    }
}

/// Colours from valleys to crests.
fn colour(height: i16) -> Rgb888 {
    const STOPS: [Rgb888; 5] = [
        Rgb888::new(30, 30, 150),
        Rgb888::new(20, 120, 200),
        Rgb888::new(60, 210, 140),
        Rgb888::new(250, 220, 80),
        Rgb888::new(255, 120, 60),
    ];
    // 1024 units from stop to stop, the middle one at rest.
    let level = (i32::from(height) + 2048).clamp(0, 4095);
    let (stop, part) = (level as usize / 1024, level % 1024);
    let mix = |of: fn(&Rgb888) -> u8| {
        let [a, b] = [stop, stop + 1].map(|i| i32::from(of(&STOPS[i])));
        (a + (b - a) * part / 1024) as u8
    };
    Rgb888::new(mix(Rgb888::r), mix(Rgb888::g), mix(Rgb888::b))
}

fn draw(water: &Water, camera: &Camera, display: &mut Canvas<Rgb565>) -> Result<Statistics, Box<dyn Error>> {
    let mesh = Mesh::new(&water.vertices, EXPONENT, &FACES)?.with_vertex_normals(&water.normals)?;
    let model = Affine::identity();
    let mut levels = [0; VERTICES];
    Lambert::new(&model, Vector3::from_ints(-2, 1, 3), 90)?.levels(mesh.vertex_normals(), &mut levels);
    // Vertex colours: by height, dimmed by light.
    let mut colours = [Flat::default(); VERTICES];
    for (flat, (&[_, _, height], level)) in colours.iter_mut().zip(water.vertices.iter().zip(levels)) {
        *flat = Flat::lit(colour(height), level);
    }

    // On a microcontroller these are statics.
    let size = display.size();
    let (mut cache, mut bins) = ([ScreenVertex::EMPTY; VERTICES], vec![0; mesh.face_bins_len()]);
    let mut strip = vec![0; Frame::<Rgb332>::strip_bytes(size.width, ROWS)];
    let mut depths = vec![0; (size.width * ROWS) as usize];

    let instance = camera.place(&mesh, &model);
    let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bins)?;
    let mut frame = Frame::new(display.bounding_box(), Rgb332::from_channels([1, 1, 1]));
    while let Some(mut band) = frame.next_band(&mut strip)? {
        let mut depth = DepthBuffer::new(band.area(), &mut depths)?;
        let smooth = |face| Gouraud::new(mesh.corners_of(face, &colours)).dithered();
        faces.depth_tested(smooth, &mut depth, &mut band)?;
        // For a display with this colour type: band.send(display).
        display.fill_contiguous(&band.area(), band.colors().map(Rgb565::from))?;
    }
    Ok(faces.statistics())
}

/// From above, with z up.
fn camera(size: Size) -> Result<Camera, Box<dyn Error>> {
    let eye = Point3::from_f32(2.6, -5.2, 4.4)?;
    let viewing =
        ViewTransform::look_at(eye, Point3::from_f32(-0.15, 0.0, -0.3)?, Vector3::from_ints(0, 0, 1))?;
    let projection =
        Projection::perspective(Angle::degrees(41), size, Scalar::from_int(2), Scalar::from_int(14))?;
    Ok(Camera::new(&viewing, &projection, &Viewport::new(Point::zero(), size)?))
}

fn film(Film { size, frames, out }: &Film) -> Result<(), Box<dyn Error>> {
    let (size, frames) = (Size::new_equal(*size), *frames);
    command::folder(out)?;
    let camera = camera(size)?;
    let (gif, sheet) = (out.join("surface.gif"), out.join("contact-sheet.png"));
    let palette: Vec<Rgb565> = (0..=255).map(|bits| Rgb332(bits).into()).collect();
    let mut film = film::Gif::create(&gif, size, &palette)?;
    let mut water = Water { vertices: [[0; 3]; VERTICES], normals: [[0; 3]; VERTICES] };
    let (mut total, mut sample) = (Statistics::default(), Vec::new());
    for frame in 0..frames {
        water.ripple(Angle::turns(frame as i32, frames));
        let mut canvas = Canvas::new(size, Rgb565::BLACK);
        total = total.and(draw(&water, &camera, &mut canvas)?);
        film.add(canvas.pixels())?;
        if film::on_sheet(frame, frames, 4) {
            sample.push(canvas);
        }
    }
    film.finish()?;
    film::write_sheet(&sheet, size, &sample)?;
    command::say(gif.display())?;
    command::say(sheet.display())?;
    let Statistics { drawn, culled, .. } = total;
    command::say(format_args!(
        "{frames} frames in bands of {ROWS} rows: {drawn} faces drawn, {culled} culled"
    ))?;
    Ok(())
}

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let about =
            "Draws ripples on a height field that changes in every frame: an animated GIF and a contact sheet";
        let command = Command::new("surface").about(about);
        let command =
            Film::arguments(command, "Frames of a ripple's period, 2 to 720", "24", "target/surface");
        film(&Film::from(&mut command::matches(command)?))?;
        Ok(ExitCode::SUCCESS)
    })
}
