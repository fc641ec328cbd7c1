//! Fog by pixel and by vertex.

use super::bodies::{floor, torus};
use super::{bricks, camera, scene, view, Drawn, CLAY};
use embedded_graphics::pixelcolor::Rgb888;
use pinhole::space::{Model, World};
use pinhole::{
    fog::{Fog, FogTable, VertexFog},
    prelude::*,
    Angle,
};
use std::error::Error;

const MIST: Rgb888 = Rgb888::new(188, 196, 208);

fn range(start: f64, end: f64) -> Result<Fog, Box<dyn Error>> {
    Ok(Fog::new(Scalar::try_from(start)?, Scalar::try_from(end)?)?)
}

/// The bricks of the rolled camera, up to the fog in which the horizon lies.
pub(crate) fn by_pixel() -> Drawn {
    let body = floor(1, 60.0, 1920);
    let bricks = bricks();
    let texture = Texture::new(&bricks);
    let camera = camera(&view([0.0, 0.8, 4.0], 17.0)?, 0.125, 64.0)?;
    let table = FogTable::new(&range(2.0, 14.0)?, &camera, MIST)?;
    let mesh = body.mesh()?;
    let shader = |face: usize| Fogged::new(texture.at(mesh.corners_of(face, &body.uv)), &table);
    scene(MIST, |scene| scene.draw(&camera.place(&mesh, &Affine::identity()), body.vertices.len(), shader))
}

/// A camera, and how bodies before it are placed.
type Row = (Camera, [Affine<Model, World>; 5]);

/// A row of tori away from the camera, the nearest first.
fn row() -> Result<Row, Box<dyn Error>> {
    let camera = camera(&view([0.0, 1.7, 4.6], 0.0)?, 1.0, 40.0)?;
    let mut z = 1.4_f32;
    let mut models = [Affine::identity(); 5];
    for model in &mut models {
        let away = Vector3::from_f32(0.7 * (1.4 - z) - 1.1, 0.0, z)?;
        *model = Affine::rotation_x(Angle::degrees(50)).translate(away);
        z -= 2.4;
    }
    Ok((camera, models))
}

/// Light and fog at each vertex, smooth in between.
pub(crate) fn by_vertex() -> Drawn {
    let body = torus(40, 20);
    let (camera, models) = row()?;
    let fog = range(2.5, 13.0)?;
    let mesh = body.mesh()?;
    scene(MIST, |scene| {
        for model in &models {
            let light = Lambert::new(model, Vector3::from_ints(-2, 4, 3), 40)?;
            let fog = VertexFog::new(&fog, &camera, model, mesh.exponent());
            let shade = |vertex: usize| {
                let color = Flat::lit(CLAY, light.level(body.normals[vertex]));
                color.in_fog(MIST, fog.factor(body.vertices[vertex]))
            };
            let colors: Vec<Flat> = (0..body.vertices.len()).map(shade).collect();
            let shader =
                |face: usize| Gouraud::new(mesh.faces()[face].map(|vertex| colors[usize::from(vertex)]));
            scene.draw(&camera.place(&mesh, model), body.vertices.len(), shader)?;
        }
        Ok(())
    })
}
