//! Counts what the scenes draw, to check that they are the scenes of `scenes.json`.

use crate::lists::{LINES, SCREEN, TRIANGLES};
use crate::scene::{Model, Scene, CUBE, ICO, LINE, SIZE, TORUS};
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::raster::{Pixel as End, ScreenPoint};
use pinhole::{draw_line, fill_triangle};

/// Counts what is drawn on it.
struct Tally {
    size: Size,
    rows: u32,
    pixels: u32,
}

impl OriginDimensions for Tally {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Tally {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        self.rows += 1;
        self.pixels += area.size.width * area.size.height;
        Ok(())
    }
}

impl Tally {
    const NEW: Self = Self { size: Size::new(SIZE, SIZE), rows: 0, pixels: 0 };
}

/// The faces of a scene that are drawn, and the pixels that they cover together.
pub fn covered(model: &'static Model) -> Option<[u32; 2]> {
    let mut tally = Tally::NEW;
    let (_, _, drawn) = draw_solid(model, &mut tally)?;
    Some([drawn as u32, tally.pixels])
}

/// The pixels that are written in S1, S5, S6 and S7, again where they were already.
pub fn written() -> Option<[u32; 4]> {
    let mut tallies = [(); 4].map(|()| Tally::NEW);
    let [cube, screen, lines, triangles] = &mut tallies;
    let Ok(_) = Scene::new(&CUBE)?.place().wireframe(LINE, &mut [], cube);
    fill_triangles(&[SCREEN], screen)?;
    draw_lines(lines);
    fill_triangles(&TRIANGLES, triangles)?;
    Some(tallies.map(|tally| tally.pixels))
}

fn flat(&[ax, ay, bx, by, cx, cy]: &[i16; 6]) -> Option<[ScreenPoint; 3]> {
    let at = |x: i16, y: i16| ScreenPoint::from_subpixels(i32::from(x) << 8, i32::from(y) << 8);
    Some([at(ax, ay)?, at(bx, by)?, at(cx, cy)?])
}

/// The counts of a scene. *Faces* are edges where edges are drawn, and lines or triangles for lists.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    pub vertices: u32,
    pub faces: u32,
    pub drawn: u32,
    /// Of all faces that are drawn, hidden later or not.
    pub rows: u32,
    pub pixels: u32,
}

/// Of a scene by its name.
pub fn units(scene: &str) -> Option<Units> {
    let mut tally = Tally::NEW;
    let (vertices, faces, drawn) = match scene {
        "S1" => {
            let Ok(statistics) = Scene::new(&CUBE)?.place().wireframe(LINE, &mut [], &mut tally);
            (CUBE.mesh.vertices().len(), CUBE.mesh.edges().len(), statistics.drawn as usize)
        }
        "S2" => draw_solid(&CUBE, &mut tally)?,
        "S3" | "S8" => draw_solid(&TORUS, &mut tally)?,
        "S4" => draw_solid(&ICO, &mut tally)?,
        "S5" => fill_triangles(&[SCREEN], &mut tally)?,
        "S6" => {
            draw_lines(&mut tally);
            (0, LINES.len(), LINES.len())
        }
        "S7" => fill_triangles(&TRIANGLES, &mut tally)?,
        _ => return None,
    };
    let [vertices, faces, drawn] = [vertices, faces, drawn].map(|count| count as u32);
    Some(Units { vertices, faces, drawn, rows: tally.rows, pixels: tally.pixels })
}

/// Vertices, faces, and drawn faces.
fn draw_solid(model: &'static Model, tally: &mut Tally) -> Option<(usize, usize, usize)> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    let Ok(statistics) = scene.place().solid(scene.shade(&light), &mut [], tally);
    Some((model.mesh.vertices().len(), model.mesh.faces().len(), statistics.drawn as usize))
}

/// Number of vertices, triangles, and triangles drawn: all of the list.
fn fill_triangles(list: &[[i16; 6]], tally: &mut Tally) -> Option<(usize, usize, usize)> {
    for triangle in list {
        let Ok(()) = fill_triangle(flat(triangle)?, LINE, tally);
    }
    Some((0, list.len(), list.len()))
}

fn draw_lines(target: &mut Tally) {
    for &[x0, y0, x1, y1] in &LINES {
        let Ok(()) = draw_line(End { x: x0, y: y0 }, End { x: x1, y: y1 }, LINE, target);
    }
}
