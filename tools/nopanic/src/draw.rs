//! Drawing, into three targets in three colours each.

use crate::any;
use crate::canvas::Canvas;
use crate::targets::{Least, Wire};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray8, Rgb565};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::raster::{self, Pixel, Scissor, ScreenPoint, Span};
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Camera, Coordinate, Corner, Cull, DepthBuffer, Dim, Dirty, Lambert, Mesh, Painter, Placed,
    Scalar, WindowCost,
};

/// Things set up elsewhere, so that nothing is known of them here.
struct Scene<'a, C> {
    camera: Camera,
    model: Affine<Model, World>,
    light: Lambert,
    mesh: Mesh<'a>,
    wide_mesh: Mesh<'a, Scalar>,
    colours: &'a [(C, [i16; 3])],
    corners: &'a mut [Corner],
    depth: &'a mut [u16],
    painter: Painter<C, 100, 100>,
}

fn draw<D: DrawTarget<Color: Dim>>(scene: &mut Scene<'_, D::Color>, target: &mut D) {
    let cull = if any() == 0 { Cull::None } else { Cull::Back };
    let placed = scene.camera.place(&scene.mesh, &scene.model).with_cull(cull);
    draw_placed(scene, &placed, target);
    let placed = scene.camera.place(&scene.wide_mesh, &scene.model).with_cull(cull);
    draw_placed(scene, &placed, target);
    match any() {
        0 => scene.painter.clear(),
        _ => report(scene.painter.draw(target)),
    }
}

fn draw_placed<D: DrawTarget<Color: Dim>, V: Coordinate>(
    scene: &mut Scene<'_, D::Color>,
    placed: &Placed<'_, V>,
    target: &mut D,
) {
    let Scene { light, colours, corners, depth, painter, .. } = scene;
    let Some(&(wire, _)) = colours.first() else { return };
    let mut shade = |face: usize| {
        let (colour, normal) = colours.get(face).copied().unwrap_or((wire, [0; 3]));
        colour.dim(light.level(normal))
    };
    report(placed.project(any() as usize).ok_or(()));
    report(placed.wireframe(wire, corners, target));
    report(placed.solid(&mut shade, corners, target));
    report(painter.add(placed, &mut shade));
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    match DepthBuffer::new(area, depth) {
        Ok(mut depth) => {
            report(placed.depth_tested(&mut shade, corners, &mut depth, target));
            report(depth.at(Point::new(any(), any())).ok_or(()));
            depth.clear();
        }
        error => report(error.map(|_| ())),
    }
    report(placed.project_unsnapped(any() as usize).ok_or(()));
    report(placed.points(wire, target));
    report(placed.polyline(wire, target));
}

/// A result is looked at, or computing it might be left out.
fn report<T, E>(result: Result<T, E>) {
    match result {
        Ok(value) => drop(black_box(Some(value))),
        Err(error) => drop(black_box(Some(error))),
    }
}

macro_rules! entries {
    ($($name:ident: $target:ty, $colour:ty;)*) => {$(
        #[unsafe(no_mangle)]
        fn $name(scene: &mut Scene<'_, $colour>, target: &mut $target) {
            draw(scene, target);
        }
    )*};
}

entries! {
    entry_canvas_rgb565: Canvas<'_, Rgb565>, Rgb565;
    entry_canvas_gray8: Canvas<'_, Gray8>, Gray8;
    entry_canvas_binary: Canvas<'_, BinaryColor>, BinaryColor;
    entry_wire_rgb565: Wire<Rgb565>, Rgb565;
    entry_wire_gray8: Wire<Gray8>, Gray8;
    entry_wire_binary: Wire<BinaryColor>, BinaryColor;
    entry_least_rgb565: Least<Rgb565>, Rgb565;
    entry_least_gray8: Least<Gray8>, Gray8;
    entry_least_binary: Least<BinaryColor>, BinaryColor;
}

fn span(span: Span) -> Result<(), i32> {
    black_box(span);
    match any() {
        0 => Ok(()),
        error => Err(error),
    }
}

fn scissor() -> Scissor {
    Scissor::new(any(), any(), any(), any())
}

#[unsafe(no_mangle)]
fn entry_raster_triangle(corners: [ScreenPoint; 3]) -> Result<i64, i32> {
    raster::triangle(corners, &scissor(), span)?;
    Ok(raster::area(&corners))
}

#[unsafe(no_mangle)]
fn entry_raster_line(from: Pixel, to: Pixel) -> Result<(), i32> {
    raster::line(from, to, &scissor(), span)
}

#[unsafe(no_mangle)]
fn entry_raster_pixel(point: ScreenPoint) -> Pixel {
    point.pixel()
}

#[unsafe(no_mangle)]
fn entry_raster_screen_point() -> Option<ScreenPoint> {
    ScreenPoint::from_subpixels(any(), any())
}

#[unsafe(no_mangle)]
fn entry_dirty_new(area: Rectangle) -> Dirty<7> {
    Dirty::new(area, WindowCost::new(any() as u32, any() as u16)).with_steps(any() as u16, any() as u16)
}

#[unsafe(no_mangle)]
fn entry_dirty(dirty: &mut Dirty<7>, rectangle: Rectangle) {
    match any() {
        0 => dirty.invalidate(),
        1 => drop(black_box(dirty.take())),
        _ => dirty.mark(rectangle),
    }
}
