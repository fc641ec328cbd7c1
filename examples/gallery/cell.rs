//! One cell: the house in one view.

use crate::house::{face_of, look, DRAWN, EDGES, EXPONENT, FACES, VERTICES};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Circle, Line, PrimitiveStyle, Rectangle};
use pinhole::space::{Model, World};
use pinhole::{mesh::edge_faces, prelude::*, target::LeastRun};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::sheet::INK;
use std::error::Error;

pub(crate) const PAPER: Rgb888 = Rgb888::new(255, 254, 250);
/// Colours of the x, y and z axes.
pub(crate) const AXES: [Rgb888; 3] =
    [Rgb888::new(206, 50, 44), Rgb888::new(24, 138, 64), Rgb888::new(44, 84, 206)];

/// Draws the house as this camera sees it.
pub(crate) fn draw(
    camera: &Camera,
    viewport: &Viewport,
    sheet: &mut Canvas<Rgb888>,
) -> Result<(), Box<dyn Error>> {
    let model = Affine::<Model, World>::identity();
    let body = Mesh::new(&VERTICES, EXPONENT, &FACES)?;
    let house = camera.place(&body, &model);
    let points: Vec<_> = (0..VERTICES.len()).map(|i| house.project(i).ok().map(|seen| seen.point)).collect();
    let seen = |face: u16| {
        let corners = FACES[usize::from(face)].map(|corner| points[usize::from(corner)]);
        corners.iter().copied().collect::<Option<Vec<_>>>().is_some_and(|corners| is_front(&corners))
    };
    let cell = viewport.area();

    for (axis, point) in camera.vanishing_points().into_iter().enumerate() {
        if let Some(point) = point {
            rays(axis, point, &points, &mut sheet.clipped(&cell))?;
        }
    }

    let light = Lambert::new(&model, Vector3::from_ints(3, 5, 6), 176)?;
    let mut painter = Painter::<Rgb888, 64, 64>::new();
    house
        .faces(|face| {
            let (normal, colour) = look(face);
            colour.dim(light.level(normal))
        })
        .sorted(&mut painter)?;
    painter.draw(sheet)?;

    let mut line = |ends: [u16; 2], colour: Rgb888, dashed: bool| -> Result<(), Box<dyn Error>> {
        let ends = [ends];
        let mesh = Mesh::new(&VERTICES, EXPONENT, &[])?.with_edges(&ends)?;
        let line = camera.place(&mesh, &model);
        if dashed {
            let mut dashed = Dashed { target: sheet, on: 2, off: 2, at: 0 };
            line.edges(|_| colour).draw(&mut LeastRun::<_, 1>(&mut dashed))?;
        } else {
            line.edges(|_| colour).draw(sheet)?;
        }
        Ok(())
    };
    let beside = edge_faces(&EDGES, &FACES);
    // Edges from the origin have the colour of their axis.
    let colour = |edge: usize| AXES.get(EDGES.len() - 1 - edge).copied().unwrap_or(INK);
    for hidden in [true, false] {
        for (edge, &ends) in EDGES.iter().enumerate() {
            if beside[edge].into_iter().any(seen) != hidden {
                line(ends, colour(edge), hidden)?;
            }
        }
    }
    for (drawn, &ends) in DRAWN.iter().enumerate() {
        if seen(face_of(drawn)) {
            line(ends, INK, false)?;
        }
    }

    for (axis, point) in camera.vanishing_points().into_iter().enumerate() {
        if let Some(point) = point {
            mark(place(point), AXES[axis], &mut sheet.clipped(&cell))?;
        }
    }
    Ok(())
}

/// Whether the corners of a face, with y down, run counter-clockwise with y up.
fn is_front(corners: &[pinhole::raster::ScreenPoint]) -> bool {
    let [a, b, c] = [0, 1, 2].map(|i| (i64::from(corners[i].x()), i64::from(corners[i].y())));
    (b.0 - a.0) * (c.1 - a.1) < (b.1 - a.1) * (c.0 - a.0)
}

fn place([x, y]: [i32; 2]) -> Point {
    Point::new(x >> 8, y >> 8)
}

/// Draws a vanishing point.
pub(crate) fn mark<D: DrawTarget<Color = Rgb888>>(
    at: Point,
    colour: Rgb888,
    target: &mut D,
) -> Result<(), D::Error> {
    Circle::with_center(at, 7).into_styled(PrimitiveStyle::with_stroke(colour, 1)).draw(target)?;
    Pixel(at, colour).draw(target)
}

/// Draws the rays from the edges along an axis to their vanishing point.
fn rays<D: DrawTarget<Color = Rgb888>>(
    axis: usize,
    vanishing: [i32; 2],
    points: &[Option<pinhole::raster::ScreenPoint>],
    target: &mut D,
) -> Result<(), D::Error> {
    // Rays to a vanishing point farther away look parallel.
    const FARTHEST: i32 = 8192 * 256;
    let [x, y] = vanishing;
    if x.abs() > FARTHEST || y.abs() > FARTHEST {
        return Ok(());
    }
    let target = &mut Dashed { target, on: 1, off: 2, at: 0 };
    for [a, b] in EDGES {
        let ends = [a, b].map(usize::from);
        let along = ends.map(|i| VERTICES[i]);
        let moved: Vec<_> = (0..3).filter(|&i| along[0][i] != along[1][i]).collect();
        let [Some(from), Some(to)] = ends.map(|i| points[i]) else { continue };
        if moved != [axis] {
            continue;
        }
        let away =
            |p: pinhole::raster::ScreenPoint| i64::from(p.x() - x).pow(2) + i64::from(p.y() - y).pow(2);
        let start = if away(from) < away(to) { from } else { to };
        Line::new(start.into(), place(vanishing))
            .into_styled(PrimitiveStyle::with_stroke(AXES[axis], 1))
            .draw(target)?;
    }
    Ok(())
}

/// A target that draws dashed lines: `on` pixels are drawn, the next `off` are not. It takes lines in runs ([`LeastRun`]), from their
/// first end on: a line in one call goes downwards or to the right.
pub(crate) struct Dashed<'t, D> {
    pub(crate) target: &'t mut D,
    pub(crate) on: u32,
    pub(crate) off: u32,
    pub(crate) at: u32,
}

impl<D: DrawTarget> DrawTarget for Dashed<'_, D> {
    type Color = D::Color;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<D::Color>>>(&mut self, pixels: I) -> Result<(), D::Error> {
        let (on, off, at) = (self.on, self.off, &mut self.at);
        self.target.draw_iter(pixels.into_iter().filter(|_| {
            *at = (*at + 1) % (on + off);
            *at < on
        }))
    }
}

impl<D: Dimensions> Dimensions for Dashed<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.target.bounding_box()
    }
}
