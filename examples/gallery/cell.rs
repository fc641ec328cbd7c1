//! One cell: the house in one view.

use crate::house::{Side, DRAWN, EDGES, EXPONENT, FACES, HOUSE, SIDES, VERTICES};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Circle, Line, PrimitiveStyle, Rectangle};
use pinhole::space::{Model, World};
use pinhole::{prelude::*, target::LeastRun};
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::sheet::INK;
use std::error::Error;

pub(crate) const PAPER: Rgb888 = Rgb888::new(255, 254, 250);
/// Colours of the x, y and z axes.
pub(crate) const AXES: [Rgb888; 3] =
    [Rgb888::new(206, 50, 44), Rgb888::new(24, 138, 64), Rgb888::new(44, 84, 206)];
pub(crate) const MARKED: Rgb888 = Rgb888::new(255, 210, 92);
const WALL: Rgb888 = Rgb888::new(240, 234, 222);
const ROOF: Rgb888 = Rgb888::new(226, 146, 118);
const FLOOR: Rgb888 = Rgb888::new(190, 198, 208);

/// Draws the house as this camera sees it.
pub(crate) fn draw(
    camera: &Camera,
    viewport: &Viewport,
    sheet: &mut Canvas<Rgb888>,
) -> Result<(), Box<dyn Error>> {
    let model = Affine::<Model, World>::identity();
    let house = camera.place(&HOUSE, &model);
    let points: Vec<_> = (0..VERTICES.len()).map(|i| house.project(i).ok().map(|seen| seen.point)).collect();
    let seen = |side: Side| {
        FACES.iter().zip(SIDES).any(|(face, of)| {
            let corners = face.map(|i| points[usize::from(i)]);
            let whole = corners.iter().copied().collect::<Option<Vec<_>>>();
            of == side && whole.is_some_and(|p| is_front(&p))
        })
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
            let colour = match SIDES[face] {
                Side::Front => MARKED,
                Side::Floor => FLOOR,
                Side::RoofLeft | Side::RoofRight => ROOF,
                Side::Back | Side::Left | Side::Right => WALL,
            };
            colour.dim(light.level(SIDES[face].normal()))
        })
        .sorted(&mut painter)?;
    painter.draw(sheet)?;

    let mut edges = |list: &[[u16; 2]], colour: Rgb888, dashed: bool| -> Result<(), Box<dyn Error>> {
        let mesh = Mesh::new(&VERTICES, EXPONENT, &[])?.with_edges(list)?;
        let instance = camera.place(&mesh, &model);
        let mut cache = [ScreenVertex::default(); VERTICES.len()];
        if dashed {
            let mut dashed = Dashed { target: sheet, on: 2, off: 2, at: 0 };
            instance.edges(|_| colour).cached(&mut cache).draw(&mut LeastRun::<_, 1>(&mut dashed))?;
        } else {
            instance.edges(|_| colour).cached(&mut cache).draw(sheet)?;
        }
        Ok(())
    };
    // Edges from the origin have the colour of their axis.
    let colour = |edge: usize| AXES.get(edge).copied().unwrap_or(INK);
    let visible = |[a, b]: [Side; 2]| seen(a) || seen(b);
    for hidden in [true, false] {
        for (i, &(ends, sides)) in EDGES.iter().enumerate().rev() {
            if visible(sides) != hidden {
                edges(&[ends], colour(i), hidden)?;
            }
        }
    }
    let drawn: Vec<_> = DRAWN.iter().filter(|&&(_, side)| seen(side)).map(|&(ends, _)| ends).collect();
    edges(&drawn, INK, false)?;

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
    for ([a, b], _) in EDGES {
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
