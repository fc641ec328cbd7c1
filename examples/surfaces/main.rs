//! A contact sheet of lights, material captures, textures, fog and sprites:
//!
//! ```text
//! cargo run --release --example surfaces -- --help
//! ```

mod bodies;
mod misty;
mod sprites;

use bodies::{ball, floor, torus};
use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_6X13_BOLD};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    light::{BlinnPhong, Matcap, PointLight},
    mesh::FaceColors,
    prelude::*,
    shading::SpanShader,
    texture::{BilinearTexels, MipPicture, MipTexels},
    Angle,
};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::sheet::{write, BACKGROUND, FAINT, INK};
use pinhole_apps_support::{command, still};
use std::error::Error;
use std::process::ExitCode;

const PICTURE: Size = Size::new(176, 132);
const GAP: u32 = 8;
const CAPTION: u32 = 17;
const HEADER: u32 = 24;
const COLUMNS: u32 = 3;

const NIGHT: Rgb888 = Rgb888::new(24, 28, 40);
const CLAY: Rgb888 = Rgb888::new(226, 140, 84);
const TEAL: Rgb888 = Rgb888::new(20, 132, 140);

/// A view, its camera, and how the body is turned.
type Usual = (ViewTransform, Camera, Affine<Model, World>);

type Drawn = Result<Vec<Rgb888>, Box<dyn Error>>;

fn main() -> ExitCode {
    command::run(|| {
        let about = "Draws a contact sheet of lights, material captures, textures, fog and sprites";
        let file = Generated::arguments("--example surfaces", about, "docs/surfaces.png")?;
        file.finish(&sheet().map_err(|e| e.to_string())?)
    })
}

fn sheet() -> Result<Vec<u8>, Box<dyn Error>> {
    let cells: [(&str, &str, Drawn); 9] = [
        ("PointLight", "two lamps", lamps()),
        ("FaceColors", "emitting light", emission()),
        ("BlinnPhong", "highlight, ^32", highlight()),
        ("Matcap", "64 x 64 texels", matcap()),
        ("Texture", "rolled camera", rolled()),
        ("Fogged", "texture, per pixel", misty::by_pixel()),
        ("VertexFog", "light per vertex", misty::by_vertex()),
        ("Sprite", "32 x 64 texels", sprites::wood()),
        ("Sprite", "points, half mixed", sprites::fountain()),
    ];
    let cell = PICTURE + Size::new(GAP, CAPTION + GAP);
    let rows = (cells.len() as u32).div_ceil(COLUMNS);
    let size = Size::new(COLUMNS * cell.width + GAP, HEADER + rows * cell.height + GAP);
    let mut sheet = Canvas::new(size, BACKGROUND);
    let title = "pinhole: lights, a material capture, textures, fog, sprites";
    write(title, Point::new(GAP as i32, 7), &FONT_6X13_BOLD, INK, &mut sheet);
    for (index, (name, details, pixels)) in (0..).zip(cells) {
        let at = Point::new(GAP as i32, HEADER as i32)
            + Size::new(index % COLUMNS, index / COLUMNS).component_mul(cell);
        sheet.fill_contiguous(&Rectangle::new(at, PICTURE), pixels?)?;
        let below = at + Point::new(0, PICTURE.height as i32 + 3);
        write(name, below, &FONT_6X10, INK, &mut sheet);
        let aside = below + Point::new(6 * (name.len() as i32 + 1), 0);
        write(details, aside, &FONT_6X10, FAINT, &mut sheet);
    }
    still::png(size, sheet.pixels())
}

/// The view from an eye to the origin, rolled by an angle.
fn view(eye: [f64; 3], roll: f64) -> Result<ViewTransform, Box<dyn Error>> {
    let [x, y, z] = eye.map(Scalar::try_from);
    let up = Vector3::from_f32(roll.to_radians().sin() as f32, roll.to_radians().cos() as f32, 0.0)?;
    Ok(ViewTransform::look_at(Point3::new(x?, y?, z?), Point3::from_ints(0, 0, 0), up)?)
}

fn camera(view: &ViewTransform, near: f64, far: f64) -> Result<Camera, Box<dyn Error>> {
    let viewport = Viewport::new(Point::zero(), PICTURE)?;
    let [near, far] = [Scalar::try_from(near)?, Scalar::try_from(far)?];
    let projection = Projection::perspective(Angle::degrees(38), PICTURE, near, far)?;
    Ok(Camera::new(view, &projection, &viewport))
}

/// Where most bodies stand, and how they are turned.
fn usual() -> Result<Usual, Box<dyn Error>> {
    let view = view([0.0, 2.0, 2.9], 0.0)?;
    let camera = camera(&view, 1.0, 9.0)?;
    Ok((view, camera, Affine::rotation_x(Angle::degrees(20)).rotate_z(Angle::degrees(-18))))
}

/// A picture with a depth buffer, into which instances of meshes are drawn, each with the shaders of its faces.
struct Scene<'a> {
    picture: Picture<'a, Rgb888>,
    depth: DepthBuffer<'a>,
}

/// Draws a cell of the sheet on a background of one colour.
fn scene(background: Rgb888, draw: impl FnOnce(&mut Scene<'_>) -> Result<(), Box<dyn Error>>) -> Drawn {
    let mut pixels = vec![background; (PICTURE.width * PICTURE.height) as usize];
    let mut depths = vec![0; pixels.len()];
    let depth = DepthBuffer::new(Rectangle::new(Point::zero(), PICTURE), &mut depths)?;
    draw(&mut Scene { picture: Picture::new(&mut pixels, PICTURE)?, depth })?;
    Ok(pixels)
}

impl Scene<'_> {
    fn draw<S: SpanShader<Rgb888>>(
        &mut self,
        instance: &MeshInstance<'_>,
        vertices: usize,
        shader: impl Fn(usize) -> S,
    ) -> Result<(), Box<dyn Error>> {
        let mut cache = vec![ScreenVertex::EMPTY; vertices];
        instance
            .faces(shader)
            .cached(&mut cache)
            .draw(&mut self.picture.pixels().depth_tested(&mut self.depth))?;
        Ok(())
    }
}

/// A torus with a highlight, by light levels at its vertices.
fn highlight() -> Drawn {
    let body = torus(40, 20);
    let (view, camera, model) = usual()?;
    let [_, _, [x, y, z, _], _] = view.to_matrix().map(|row| row.map(|c| c as f32));
    let viewer = Vector3::from_f32(x, y, z)?;
    let light = BlinnPhong::new(&model, Vector3::from_ints(-2, 4, 3), viewer, 40, 32)?;
    let table = ShadeTable::with_highlight(TEAL, Rgb888::WHITE);
    let levels: Vec<u16> = body.normals.iter().map(|&normal| light.level(normal)).collect();
    let mesh = body.mesh()?;
    let shader = |face: usize| table.lit(mesh.corners_of(face, &levels));
    scene(NIGHT, |scene| scene.draw(&camera.place(&mesh, &model), body.vertices.len(), shader))
}

/// Two lamps over a floor, one of them behind a torus.
fn lamps() -> Drawn {
    let (_, camera, model) = usual()?;
    let lamps = [[-0.9, 0.5, 0.6], [0.9, 0.7, -0.6]];
    let table = ShadeTable::new(Rgb888::new(250, 210, 150));
    let level = Affine::translation(Vector3::from_f32(0.0, -0.6, 0.0)?);
    scene(NIGHT, |scene| {
        for (body, model) in [(floor(32, 2.0, 0), level), (torus(40, 20), model)] {
            let mesh = body.mesh()?;
            let mut levels = vec![16; body.vertices.len()];
            for [x, y, z] in lamps {
                let at = Point3::from_f32(x, y, z)?;
                let lamp = PointLight::new(&model, mesh.exponent(), at, Scalar::from_ratio(9, 5), 256);
                for (level, (&vertex, &normal)) in
                    levels.iter_mut().zip(body.vertices.iter().zip(&body.normals))
                {
                    *level = (*level + lamp.level(vertex, normal)).min(256);
                }
            }
            let shader = |face: usize| table.lit(mesh.corners_of(face, &levels));
            scene.draw(&camera.place(&mesh, &model), body.vertices.len(), shader)?;
        }
        Ok(())
    })
}

/// A torus in the dusk: its hull has the light of a lamp, its windows and a stripe emit light of their own.
fn emission() -> Drawn {
    const AROUND: usize = 40;
    const ACROSS: usize = 20;
    let body = torus(AROUND, ACROSS);
    let (_, camera, model) = usual()?;
    let light = Lambert::new(&model, Vector3::from_ints(-2, 4, 3), 16)?;
    let levels: Vec<u16> = body.normals.iter().map(|&normal| light.level(normal) / 2).collect();
    // The hull, windows, a stripe.
    let palette = [[120, 128, 140], [40, 48, 60], [70, 30, 10]];
    let emission = [[0, 0, 0], [150, 190, 150], [180, 70, 10]];
    let faces: Vec<u8> = (0..body.faces.len() / 2)
        .map(|field| (field / ACROSS, field % ACROSS))
        .map(|(along, across)| match across {
            2 | 18 if along % 2 == 0 => 1,
            6 => 2,
            _ => 0,
        })
        .flat_map(|color| [color; 2])
        .collect();
    let colors = FaceColors::new(&palette, &faces)?.with_emission(&emission)?;
    let mesh = body.mesh()?;
    let shader = |face: usize| {
        let lit = Gouraud::lit(colors.color(face), mesh.corners_of(face, &levels));
        lit.emitting(colors.emission(face))
    };
    scene(Rgb888::new(12, 14, 22), |scene| {
        scene.draw(&camera.place(&mesh, &model), body.vertices.len(), shader)
    })
}

fn matcap() -> Drawn {
    let body = torus(40, 20);
    let (view, camera, model) = usual()?;
    let matcap = Matcap::new(&view, &model);
    let coords: Vec<_> = body.normals.iter().map(|&normal| matcap.coords(normal)).collect();
    let ball = ball();
    let texture = Texture::new(&ball).with_exponent(Matcap::EXPONENT)?;
    let mesh = body.mesh()?;
    let shader = |face: usize| texture.at(mesh.corners_of(face, &coords));
    scene(NIGHT, |scene| scene.draw(&camera.place(&mesh, &model), body.vertices.len(), shader))
}

/// Tiles of 64 × 64 texels: bricks in two tones, with light mortar.
fn bricks() -> [[Rgb888; 64]; 64] {
    let mut texels = [[Rgb888::new(206, 196, 180); 64]; 64];
    for (v, row) in texels.iter_mut().enumerate() {
        for (u, texel) in row.iter_mut().enumerate() {
            let (course, shift) = (v / 16, v / 16 % 2 * 16);
            let (along, number) = ((u + shift) % 32, (u + shift) / 32 % 2 + course);
            if v % 16 > 1 && along > 1 {
                let tone = [0, 22, 10, 34][number * 7 % 4] + (u * 7 + v * 13) as u8 % 8;
                *texel = Rgb888::new(150 + tone, 66 + tone, 44 + tone / 2);
            }
        }
    }
    texels
}

/// A floor of two triangles to the horizon, seen by a rolled camera.
fn rolled() -> Drawn {
    let body = floor(1, 60.0, 1920);
    let bricks = MipPicture::build(bricks());
    let texture = Texture::new(BilinearTexels::new(MipTexels::new(&bricks)));
    let view = view([0.0, 0.8, 4.0], 17.0)?;
    let camera = camera(&view, 0.125, 64.0)?;
    let mesh = body.mesh()?;
    let shader = |face: usize| texture.at(mesh.corners_of(face, &body.uv));
    scene(NIGHT, |scene| scene.draw(&camera.place(&mesh, &Affine::identity()), body.vertices.len(), shader))
}
