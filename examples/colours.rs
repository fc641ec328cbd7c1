//! A contact sheet of one scene in seven pixel formats, rounded and dithered:
//!
//! ```text
//! cargo run --release --example colours -- --help
//! ```

use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_6X13_BOLD};
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb666, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    prelude::*,
    shading::{Dithered, SpanShader},
    Angle,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::sheet::{write, BACKGROUND, FAINT, INK};
use pinhole_apps_support::{command, still};
use std::error::Error;
use std::process::ExitCode;

const PICTURE: Size = Size::new(168, 128);
const GAP: u32 = 8;
const CAPTION: u32 = 17;
const HEADER: u32 = 24;

/// Rows of a band.
const ROWS: u32 = 8;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Draws a contact sheet of one scene in seven pixel formats, rounded and dithered";
        let file = Generated::arguments("--example colours", about, "docs/colours.png")?;
        file.finish(&sheet().map_err(|e| e.to_string())?)
    })
}

/// A pixel format: its name, its bits, and the rounded and the dithered picture.
type Row = (&'static str, &'static str, [Vec<Rgb888>; 2]);

/// All the pictures as a PNG file.
fn sheet() -> Result<Vec<u8>, Box<dyn Error>> {
    let scene = Scene::new(PICTURE)?;
    let formats: [Row; 7] = [
        ("Rgb888", "24 bits", pictures::<Rgb888>(&scene)?),
        ("Rgb666", "18 bits", pictures::<Rgb666>(&scene)?),
        ("Rgb565", "16 bits", pictures::<Rgb565>(&scene)?),
        ("Gray8", "8 bits", pictures::<Gray8>(&scene)?),
        ("Gray4", "4 bits", pictures::<Gray4>(&scene)?),
        ("Gray2", "2 bits", pictures::<Gray2>(&scene)?),
        ("BinaryColor", "1 bit", pictures::<BinaryColor>(&scene)?),
    ];
    // Four columns and two rows of pairs; the last cell is the legend.
    let pair = Size::new(PICTURE.width + GAP, 2 * (PICTURE.height + CAPTION) + GAP);
    let size = Size::new(4 * pair.width + GAP, HEADER + 2 * pair.height + GAP);
    let mut sheet = Canvas::new(size, BACKGROUND);
    let title = format!("pinhole: one scene in every colour, drawn in bands of {ROWS} rows");
    write(&title, Point::new(GAP as i32, 7), &FONT_6X13_BOLD, INK, &mut sheet);
    let corner = |cell: u32| {
        let offset = Size::new(cell % 4, cell / 4).component_mul(pair);
        Point::new(GAP as i32, HEADER as i32) + offset
    };
    for (cell, (name, bits, pictures)) in (0..).zip(formats) {
        let mut at = corner(cell);
        for (picture, how) in pictures.into_iter().zip(["rounded", "dithered"]) {
            sheet.fill_contiguous(&Rectangle::new(at, PICTURE), picture)?;
            let below = at + Point::new(0, PICTURE.height as i32 + 3);
            write(name, below, &FONT_6X10, INK, &mut sheet);
            let details = format!("{bits}, {how}");
            let aside = below + Point::new(6 * (name.len() as i32 + 1), 0);
            write(&details, aside, &FONT_6X10, FAINT, &mut sheet);
            at.y += (PICTURE.height + CAPTION) as i32;
        }
    }
    let lines = [
        "Gouraud shading: light at",
        "the vertices, from above",
        "and the left, and linear",
        "between them; a wall with",
        "a colour at each corner.",
        "",
        "Rounded: to the nearest",
        "level of each channel.",
        "Dithered: 8 x 8 Bayer,",
        "63 more shades between",
        "any two levels.",
    ];
    for (line, text) in (0..).zip(lines) {
        write(text, corner(7) + Point::new(4, 4 + 13 * line), &FONT_6X10, FAINT, &mut sheet);
    }
    still::png(size, sheet.pixels())
}

fn pictures<C: Color + Into<Rgb888>>(scene: &Scene) -> Result<[Vec<Rgb888>; 2], Box<dyn Error>>
where
    Gouraud: SpanShader<C, Ink = C>,
    Lit: SpanShader<C, Ink = C>,
    Dithered<Gouraud>: SpanShader<C, Ink = C>,
    Dithered<Lit>: SpanShader<C, Ink = C>,
{
    let nearest = picture::<C, _, _>(scene, (|shader| shader, |shader| shader))?;
    Ok([nearest, picture::<C, _, _>(scene, (Gouraud::dithered, Lit::dithered))?])
}

/// The scene in one pixel format, drawn in bands.
fn picture<C, I, L>(scene: &Scene, shaders: Shaders<I, L>) -> Result<Vec<Rgb888>, Box<dyn Error>>
where
    C: Color + Into<Rgb888>,
    I: SpanShader<C, Ink = C>,
    L: SpanShader<C, Ink = C>,
{
    let mut pixels = Vec::new();
    scene.draw(ROWS, shaders, |band| pixels.extend(band.colors().map(Into::into)))?;
    Ok(pixels)
}

const CLAY: Rgb888 = Rgb888::new(255, 178, 92);

/// The shaders of the wall and of the teapot.
type Shaders<I, L> = (fn(Gouraud) -> I, fn(Lit) -> L);

/// A wall across the picture, counter-clockwise from the lower left.
const WALL: [[i16; 3]; 4] = [[-34, -36, -18], [34, -36, -18], [34, 22, -18], [-34, 22, -18]];
const WALL_FACES: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const WALL_COLOURS: [Rgb888; 4] = [
    Rgb888::new(226, 120, 160),
    Rgb888::new(60, 48, 120),
    Rgb888::new(10, 40, 80),
    Rgb888::new(110, 190, 220),
];

/// A teapot in front of a wall, with light per vertex and colours per corner.
struct Scene {
    area: Rectangle,
    camera: Camera,
    model: Affine<Model, World>,
    /// Light levels at the teapot's vertices.
    levels: Vec<u16>,
}

impl Scene {
    fn new(size: Size) -> Result<Self, Box<dyn Error>> {
        let viewing = ViewTransform::look_at(
            Point3::from_ints(0, 15, 42),
            Point3::from_f32(1.2, -0.6, 0.0)?,
            Vector3::from_ints(0, 1, 0),
        )?;
        let projection =
            Projection::perspective(Angle::degrees(31), size, Scalar::from_int(10), Scalar::from_int(90))?;
        let camera = Camera::new(&viewing, &projection, &Viewport::new(Point::zero(), size)?);
        let model = Affine::<Model, World>::rotation_y(Angle::degrees(-25));
        // The light comes from above, the left and the front.
        let light = Lambert::new(&model, Vector3::from_ints(-3, 4, 3), 40)?;
        let mut levels = vec![0; teapot::VERTICES.len()];
        light.levels(&vertex_normals(), &mut levels);
        Ok(Self { area: Rectangle::new(Point::zero(), size), camera, model, levels })
    }

    /// Draws in bands of `rows` rows; `shaders` makes the shaders.
    fn draw<C: Color, I: SpanShader<C, Ink = C>, L: SpanShader<C, Ink = C>>(
        &self,
        rows: u32,
        (smooth, lit): Shaders<I, L>,
        mut send: impl FnMut(&Band<'_, C>),
    ) -> Result<(), Box<dyn Error>> {
        let pot = Mesh::new(&teapot::VERTICES, teapot::EXPONENT, &teapot::FACES)?;
        let wall = Mesh::new(&WALL, 0, &WALL_FACES)?;
        let (mut pot_cache, mut wall_cache) =
            ([ScreenVertex::EMPTY; teapot::VERTICES.len()], [ScreenVertex::EMPTY; 4]);
        let (mut pot_bins, mut wall_bins) = (vec![0; 2 * teapot::FACES.len()], [0; 3]);

        // The inside is visible through the gap around the lid.
        let instance = self.camera.place(&pot, &self.model).with_cull(Cull::None);
        let projected = instance.transform_depth(&mut pot_cache);
        let mut pot_faces = projected.bin_faces(&mut pot_bins)?;
        let instance = self.camera.place(&wall, &Affine::identity());
        let mut wall_faces = instance.transform_depth(&mut wall_cache).bin_faces(&mut wall_bins)?;

        let width = self.area.size.width;
        let mut strip = vec![0; Frame::<C>::strip_bytes(width, rows)];
        let mut depths = vec![0; (width * rows) as usize];
        let mut frame = Frame::new(self.area, C::from_channels([0; 3]));
        while let Some(mut band) = frame.next_band(&mut strip)? {
            let mut depth = DepthBuffer::new(band.area(), &mut depths)?;
            let colours = |face: usize| WALL_FACES[face].map(|i| WALL_COLOURS[usize::from(i)]);
            wall_faces
                .draw(|face| smooth(Gouraud::new(colours(face))), &mut band.depth_tested(&mut depth))?;
            let pot = |face| lit(Gouraud::lit(CLAY, pot.corners_of(face, &self.levels)));
            pot_faces.draw(pot, &mut band.depth_tested(&mut depth))?;
            send(&band);
        }
        Ok(())
    }
}

/// Vertex normals: the mean of the normals of adjacent faces, weighted by area.
fn vertex_normals() -> Vec<[i16; 3]> {
    let mut sums = vec![[0i64; 3]; teapot::VERTICES.len()];
    for face in teapot::FACES {
        let [a, b, c] = face.map(|i| teapot::VERTICES[usize::from(i)].map(i64::from));
        let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for index in face {
            for (sum, part) in sums[usize::from(index)].iter_mut().zip(cross) {
                *sum += part;
            }
        }
    }
    let unit = |sum: [i64; 3]| {
        let length = sum.iter().map(|c| c * c).sum::<i64>().isqrt().max(1);
        sum.map(|c| (c * 32_767 / length) as i16)
    };
    sums.into_iter().map(unit).collect()
}
