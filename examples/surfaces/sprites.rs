//! Sprites among solid faces: a wood, and a fountain of sparks in smoke.

use super::bodies::{floor, torus};
use super::{camera, scene, view, Drawn, CLAY, NIGHT};
use embedded_graphics::geometry::{AnchorPoint, Size};
use embedded_graphics::pixelcolor::Rgb888;
use pinhole::{
    color::Half, prelude::*, shading::Translucent, sprite::SpriteSource, target::Pixels, texture::ColorKeyed,
    Angle,
};
use std::error::Error;
use std::f64::consts::TAU;

const KEY: Rgb888 = Rgb888::new(255, 0, 255);

/// A conifer of 32 × 64 texels.
fn conifer() -> [[Rgb888; 32]; 64] {
    let mut texels = [[KEY; 32]; 64];
    for (row, line) in texels.iter_mut().enumerate() {
        for (column, texel) in line.iter_mut().enumerate() {
            let away = (2 * column as i32 - 31).abs();
            let noise = (column * 7 + row * 13 + column * row) as u8 % 16;
            // Four skirts of branches, each wider than the one above, over a trunk.
            let reach = [3, 3, 8, 12][row.min(55) / 14] + (row.min(55) % 14) as i32 * 3 / 2;
            if row < 56 && away <= reach.min(30) {
                let shade = 60 + 4 * (row % 14) as u8 + noise;
                *texel = Rgb888::new(shade / 3, shade, shade / 2 - if column < 16 { 0 } else { 14 });
            } else if row >= 56 && away < 6 {
                *texel = Rgb888::new(84 + noise, 58, 40);
            }
        }
    }
    texels
}

/// A puff of smoke: a disc without its corners, whose rim is ragged.
#[derive(Clone, Copy)]
struct Puff(u8);

impl SpriteSource for Puff {
    type Color = Rgb888;
    type Ink = Option<Rgb888>;

    fn picture_size(&self) -> Size {
        Size::new(16, 16)
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<Rgb888> {
        let away = [column, row].map(|c| (2 * c as i32 - 15).pow(2)).iter().sum::<i32>();
        let ragged = (column * 5 + row * 11 + column * row) % 7 * 9;
        (away + (ragged as i32) < 240).then(|| Rgb888::new(self.0, self.0, self.0 + 12))
    }
}

/// A lit floor and a torus, with depth, and then sprites among them.
fn among_solids(
    height: f64,
    ground: Rgb888,
    draw: impl FnOnce(&Camera, &mut DepthBuffer<'_>, &mut Pixels<'_, Rgb888>) -> Result<(), Box<dyn Error>>,
) -> Drawn {
    let camera = camera(&view([0.0, 1.7, 4.6], 0.0)?, 1.0, 24.0)?;
    let at = Vector3::from_f32(0.0, height as f32, 0.0)?;
    let turned = Affine::rotation_x(Angle::degrees(62)).rotate_z(Angle::degrees(-14)).translate(at);
    let level = Affine::translation(Vector3::from_f32(0.0, -0.8, 0.0)?);
    scene(NIGHT, |scene| {
        for (body, model, color) in [(floor(24, 6.0, 0), level, ground), (torus(40, 20), turned, CLAY)] {
            let (mesh, table) = (body.mesh()?, ShadeTable::new(color));
            let light = Lambert::new(&model, Vector3::from_ints(-2, 4, 3), 40)?;
            let levels: Vec<u16> = body.normals.iter().map(|&normal| light.level(normal)).collect();
            let shader = |face: usize| table.lit(mesh.corners_of(face, &levels));
            scene.draw(&camera.place(&mesh, &model), body.vertices.len(), shader)?;
        }
        draw(&camera, &mut scene.depth, &mut scene.picture.pixels())
    })
}

/// Numbers of 0 … 1 without a pattern.
fn scattered(index: usize, of: usize) -> f64 {
    (index as f64 * [0.754_877_666, 0.569_840_291, 0.438_579_021][of % 3] + 0.37).fract()
}

/// Trees of equal height around a torus: they shrink with distance, and hide it and are hidden.
pub(crate) fn wood() -> Drawn {
    let conifer = conifer();
    among_solids(-0.1, Rgb888::new(120, 150, 96), |camera, depth, target| {
        let points: Vec<[i16; 3]> = (0..70)
            .map(|i| [-5.5 + 11.0 * scattered(i, 0), -0.8, -5.5 + 7.6 * scattered(i, 1)])
            .filter(|[x, _, z]| x.hypot(*z) > 0.9)
            .map(|point| point.map(|c| (c * 4096.0).round() as i16))
            .collect();
        let mesh = Mesh::new(&points, -12, &[])?;
        let tree = Sprite::new(ColorKeyed::new(&conifer, KEY))
            .with_height(Scalar::from_ratio(13, 10))
            .with_anchor(AnchorPoint::BottomCenter);
        camera.place_sprites(&mesh, &Affine::identity()).draw(|_| tree, &mut target.depth_tested(depth))?;
        Ok(())
    })
}

/// Sparks of 1 to 3 pixels that rise through a torus, and puffs of smoke that are half mixed with what is behind them.
pub(crate) fn fountain() -> Drawn {
    among_solids(0.0, Rgb888::new(88, 84, 104), |camera, depth, target| {
        let sparks: Vec<[i16; 3]> = (0..420)
            .map(|i| {
                let (age, turn) = (scattered(i, 0), scattered(i, 1) * TAU);
                let speed = 0.5 + 0.5 * scattered(i, 2);
                let away = 1.5 * age * speed;
                [away * turn.cos(), -0.6 + 4.4 * age - 3.6 * age * age, away * turn.sin()]
            })
            .map(|point| point.map(|c| (c * 4096.0).round() as i16))
            .collect();
        let mesh = Mesh::new(&sparks, -12, &[])?;
        let spark = |i: usize| {
            let age = scattered(i, 0);
            let color = Rgb888::new(255, (240.0 - 190.0 * age) as u8, (150.0 - 140.0 * age) as u8);
            Sprite::square(color, [3, 2, 2, 1][(age * 3.9) as usize])
        };
        camera.place_sprites(&mesh, &Affine::identity()).draw(spark, &mut target.depth_tested(depth))?;
        // From far to near, as what is behind has to be drawn before.
        for z in -6..6 {
            for x in -1..2 {
                let number = (3 * z + x + 30) as usize;
                let [dx, dy] = [0, 1].map(|of| scattered(number, of) as f32 - 0.5);
                let at = Point3::from_f32(x as f32 * 1.1 + dx, 1.0 + 0.9 * dy, z as f32 * 0.18)?;
                let size = Scalar::try_from(0.5 + 0.4 * scattered(number, 2))?;
                let puff = Sprite::new(Translucent::new(Puff(120 + 20 * (number % 4) as u8), Half))
                    .with_size(size, size);
                camera.place_sprite(at).draw(|_| puff, &mut target.depth_tested(depth))?;
            }
        }
        Ok(())
    })
}
