//! embedded-graphics' own lines and triangles. For S1 it draws the edges between points that pinhole has projected.
#![cfg_attr(target_os = "none", no_std, no_main)]

use bench::board::{println, Clock};
use bench::cells::{Counted, Frame, CUBE as VERTICES};
use bench::firmware;
use bench::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use bench::scene::{Scene, CUBE, LINE};
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::OriginDimensions;
use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::prelude::{Drawable, Point, PointsIter, Primitive};
use embedded_graphics::primitives::{Line, PrimitiveStyle, Triangle};
use embedded_graphics::Pixel;
use pinhole::MeshInstance;
use rivals::target::{count, Work};

firmware!(frame: Frame = Frame::NEW, {
    let mut clock = Clock::new()?;
    let scene = Scene::new(&CUBE)?;
    tell("S1,plain", count(&mut clock, frame, &mut Cube(scene.place()))?);
    tell("S5,plain", count(&mut clock, frame, &mut Screen)?);
    tell("S6,plain", count(&mut clock, frame, &mut Lines)?);
    tell("S7,plain", count(&mut clock, frame, &mut Triangles)?);
    Some(())
});

/// The line that `report` reads: `scene,variant,instructions,drawn`.
fn tell(cell: &str, Counted { instructions, drawn, .. }: Counted) {
    println!("{cell},{instructions},{drawn}");
}

struct Cube<'s>(MeshInstance<'s>);

impl Work for Cube<'_> {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        let instance = black_box(&self.0);
        let mut points = [Point::zero(); VERTICES];
        for (index, point) in points.iter_mut().enumerate() {
            let pixel = instance.project(index).ok()?.point.pixel();
            *point = Point::new(pixel.x.into(), pixel.y.into());
        }
        let colour = black_box(LINE);
        for &[from, to] in instance.mesh().edges() {
            line(*points.get(usize::from(from))?, *points.get(usize::from(to))?, colour, target);
        }
        Some(())
    }
}

struct Screen;

impl Work for Screen {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        let Ok(()) = filled(black_box(&SCREEN), black_box(LINE)).draw(target);
        Some(())
    }
}

struct Lines;

impl Work for Lines {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        let colour = black_box(LINE);
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            line(point(x0, y0), point(x1, y1), colour, target);
        }
        Some(())
    }
}

struct Triangles;

impl Work for Triangles {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            let Ok(()) = filled(triangle, RawU16::new(colour).into()).draw(target);
        }
        Some(())
    }
}

/// Its points by one `draw_iter`, which takes fewer instructions than a styled line of width 1.
#[inline(always)]
fn line<D>(from: Point, to: Point, colour: Rgb565, target: &mut D)
where
    D: DrawTarget<Color = Rgb565, Error = Infallible>,
{
    let Ok(()) = target.draw_iter(Line::new(from, to).points().map(|point| Pixel(point, colour)));
}

#[inline(always)]
fn filled(
    &[ax, ay, bx, by, cx, cy]: &[i16; 6],
    colour: Rgb565,
) -> impl Drawable<Color = Rgb565, Output = ()> {
    Triangle::new(point(ax, ay), point(bx, by), point(cx, cy)).into_styled(PrimitiveStyle::with_fill(colour))
}

fn point(x: i16, y: i16) -> Point {
    Point::new(x.into(), y.into())
}
