//! embedded-graphics' own lines and triangles. For S1 it draws the edges between points that pinhole has projected.
#![cfg_attr(target_os = "none", no_std, no_main)]

use bench::board::{println, Clock};
use bench::cells::{count_by, Counted, Frame, CUBE as VERTICES};
use bench::firmware;
use bench::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use bench::scene::{Scene, CUBE, LINE};
use core::hint::black_box;
use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::prelude::{Drawable, Point, Primitive};
use embedded_graphics::primitives::{Line, PrimitiveStyle, Triangle};

firmware!(frame: Frame = Frame::NEW, {
    let mut clock = Clock::new()?;
    tell("S1,plain", cube(frame, &mut clock)?);
    tell("S5,plain", flat_triangle(frame, &mut clock)?);
    tell("S6,plain", lines(frame, &mut clock)?);
    tell("S7,plain", triangles(frame, &mut clock)?);
    Some(())
});

/// The line that `report` reads: `scene,variant,instructions,drawn`.
fn tell(cell: &str, Counted { instructions, drawn, .. }: Counted) {
    println!("{cell},{instructions},{drawn}");
}

#[inline(never)]
fn cube(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    let scene = Scene::new(&CUBE)?;
    let instance = scene.place();
    count_by(clock, frame, &mut |picture| {
        let instance = black_box(&instance);
        let mut points = [Point::zero(); VERTICES];
        for (index, point) in points.iter_mut().enumerate() {
            let pixel = instance.project(index)?.0.pixel();
            *point = Point::new(pixel.x.into(), pixel.y.into());
        }
        let stroke = PrimitiveStyle::with_stroke(black_box(LINE), 1);
        for &[from, to] in instance.mesh().edges() {
            let line = Line::new(*points.get(usize::from(from))?, *points.get(usize::from(to))?);
            let Ok(()) = line.into_styled(stroke).draw(picture);
        }
        Some(())
    })
}

#[inline(never)]
fn flat_triangle(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        let Ok(()) = filled(black_box(&SCREEN), black_box(LINE)).draw(picture);
        Some(())
    })
}

#[inline(never)]
fn lines(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        let stroke = PrimitiveStyle::with_stroke(black_box(LINE), 1);
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            let Ok(()) = Line::new(point(x0, y0), point(x1, y1)).into_styled(stroke).draw(picture);
        }
        Some(())
    })
}

#[inline(never)]
fn triangles(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            let Ok(()) = filled(triangle, RawU16::new(colour).into()).draw(picture);
        }
        Some(())
    })
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
