//! The ways to draw a scene: into a picture in memory, and into a DrawTarget that is not this library's.

use super::{count, count_screen, draw_faces, drawn, Counted, Frame, Memory, Plain, Screen, Smooth, TORUS};
use crate::lists::TORUS_NORMALS;
use crate::scene::{self, Model, Scene};
use core::hint::black_box;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::{raw::RawU16, Rgb565, Rgb888, RgbColor};
use pinhole::raster::ScreenPoint;
use pinhole::{
    draw::{draw_line, fill_triangle, ShaderFor, StrokeFor},
    prelude::*,
    target::Pixels,
};

/// The functions of a module, each of which draws by `$count` into `$target` of what that hands out, a `$type`.
macro_rules! ways {
    ($module:ident, $count:path, for<$life:lifetime> $type:ty, |$surface:ident| $target:expr) => {
        pub(super) mod $module {
            use super::*;

            /// All edges of a model.
            #[inline(always)]
            pub(in super::super) fn wire<const N: usize>(
                model: &'static Model,
                stroke: impl for<$life> StrokeFor<$type>,
                Plain { frame, corners, .. }: &mut Plain<N>,
            ) -> Option<Counted> {
                let scene = Scene::new(model)?;
                let instance = scene.place();
                $count(frame, &mut |$surface| {
                    drawn(black_box(&instance).edges(|_| black_box(stroke)).cached(corners).draw($target))
                })
            }

            /// A light level for each face, culled by planes or not.
            #[inline(always)]
            pub(in super::super) fn flat<const CULLED_BY: u8, const N: usize, const DEPTH_ROWS: usize>(
                model: &'static Model,
                Memory { frame, depth, corners }: &mut Memory<N, DEPTH_ROWS>,
            ) -> Option<Counted> {
                let scene = Scene::new(model)?;
                let (light, instance) = (scene.light()?, scene.place());
                $count(frame, &mut |$surface| {
                    let (instance, light) = black_box((&instance, &light));
                    let shade = scene::flat_of_normals(instance.mesh().normals(), light);
                    let faces = instance.faces(shade).cached(corners);
                    match CULLED_BY {
                        0 => draw_faces(faces, depth, $target),
                        1 => draw_faces(faces.culled_by_planes(), depth, $target),
                        _ => draw_faces(faces.culled_by_clusters(), depth, $target),
                    }
                })
            }

            /// The light at each vertex, and between them smoothly; culled by planes.
            #[inline(always)]
            pub(in super::super) fn smooth<const DEPTH_ROWS: usize>(
                model: &'static Model,
                Smooth { memory, levels }: &mut Smooth<TORUS, DEPTH_ROWS>,
            ) -> Option<Counted> {
                let Memory { frame, depth, corners } = memory;
                let scene = Scene::new(model)?;
                let (light, instance) = (scene.light()?, scene.place());
                let white = ShadeTable::new(Rgb888::WHITE);
                $count(frame, &mut |$surface| {
                    let (instance, light, white) = black_box((&instance, &light, &white));
                    light.levels(black_box(&TORUS_NORMALS), levels);
                    let shade = |face| white.lit(instance.mesh().corners_of(face, levels));
                    draw_faces(instance.faces(shade).culled_by_planes().cached(corners), depth, $target)
                })
            }

            #[inline(always)]
            pub(in super::super) fn triangle(
                corners: &'static [i16; 6],
                shader: impl for<$life> ShaderFor<$type>,
                frame: &mut Frame,
            ) -> Option<Counted> {
                $count(frame, &mut |$surface| {
                    let Ok(()) = fill_triangle(points(black_box(corners))?, black_box(shader), $target);
                    Some(())
                })
            }

            #[inline(always)]
            pub(in super::super) fn lines<const N: usize>(
                lines: &'static [[i16; 4]; N],
                stroke: impl for<$life> StrokeFor<$type>,
                frame: &mut Frame,
            ) -> Option<Counted> {
                $count(frame, &mut |$surface| {
                    let stroke = black_box(stroke);
                    let target = $target;
                    for &[x0, y0, x1, y1] in black_box(lines) {
                        let [from, to] = [[x0, y0], [x1, y1]].map(|[x, y]| Point::new(x.into(), y.into()));
                        let Ok(()) = draw_line(from, to, stroke, target);
                    }
                    Some(())
                })
            }

            #[inline(always)]
            pub(in super::super) fn triangles<const N: usize>(
                triangles: &'static [[i16; 6]; N],
                colours: &'static [u16; N],
                frame: &mut Frame,
            ) -> Option<Counted> {
                $count(frame, &mut |$surface| {
                    let target = $target;
                    for (triangle, &colour) in black_box(triangles).iter().zip(black_box(colours)) {
                        let colour = Rgb565::from(RawU16::new(colour));
                        let Ok(()) = fill_triangle(points(triangle)?, colour, target);
                    }
                    Some(())
                })
            }
        }
    };
}

ways!(picture, count, for<'s> Pixels<'s, Rgb565>, |surface| &mut surface.pixels());
ways!(screen, count_screen, for<'s> Screen<'s>, |surface| &mut *surface);

#[inline(always)]
fn points(&[ax, ay, bx, by, cx, cy]: &[i16; 6]) -> Option<[ScreenPoint; 3]> {
    let at = |x: i16, y: i16| ScreenPoint::from_subpixels(i32::from(x) << 8, i32::from(y) << 8);
    Some([at(ax, ay)?, at(bx, by)?, at(cx, cy)?])
}
