//! The last step of the pipeline: a triangle or a line, clipped to the screen, becomes pixels.
//!
//! The plain path is the loop over spans at the end of each function; it draws into any target and defines the picture. The
//! call before that loop attaches a fast path, which may decline. All fast paths decline with `--cfg pinhole_plain`, and for
//! targets whose pixels do not lie in memory.

use crate::color::StoredPixel;
use crate::fast::{
    self, depth_fill, fog_fill, kept_fill, line_fill, line_pixels, shaded_fill, solid_fill, table_fill,
};
use crate::raster::{self, DepthTriangle, Gradient, Pixel, Scissor, Span, Triangle};
use crate::shading::SpanShader;
use crate::surface::{drawable, each_run, DepthTarget, PixelStore, Target};
use embedded_graphics_core::pixelcolor::PixelColor;

/// Fills the pixels of a triangle inside the scissor, which lies in the target. `is_clipped`: whether the triangle probably has
/// rows outside the scissor, as most triangles in a band have; it changes no pixel, only which path is tried.
#[inline(always)]
pub(super) fn fill<T: Target, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> Result<(), T::Error> {
    if S::LEAVES_OUT || S::BLENDS {
        return fill_kept(triangle, shader, scissor, target);
    }
    if let Some(color) = shader.solid_color() {
        if solid_fill::triangle(triangle, color, scissor, is_clipped, target) {
            return Ok(());
        }
        return fill_spans(triangle, color, scissor, target);
    }
    if fog_fill::triangle(triangle, shader, scissor, target) {
        return Ok(());
    }
    let setup = shader.set_up(triangle);
    if shaded_fill::triangle::<T, S>(triangle, &setup, scissor, target) {
        return Ok(());
    }
    fast::spans(triangle, scissor).try_for_each(|span| target.fill_run(span, S::span(&setup, span)))
}

/// The plain path of [`fill`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans<T: Target>(
    triangle: &Triangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    fast::spans(triangle, scissor).try_each(|Span { x, y, width, .. }| fill_row(target, x, y, width, color))
}

/// Fills the pixels of a triangle inside the scissor that are nearer than the depth buffer. The scissor lies in the target and
/// in the depth buffer. `is_clipped` is that of [`fill`].
#[inline(always)]
pub(super) fn fill_nearer<T: Target, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    if S::LEAVES_OUT || S::BLENDS || !S::WRITES_DEPTH {
        return fill_kept_nearer(triangle, shader, scissor, depth, target);
    }
    if let Some(color) = shader.solid_color() {
        if depth_fill::triangle_nearer(triangle, color, scissor, is_clipped, depth, target) {
            return Ok(());
        }
        return fill_spans_nearer(triangle, color, scissor, depth, target);
    }
    if let Some(shader) = shader.table()
        && table_fill::triangle_nearer(triangle, &shader, scissor, is_clipped, depth, target)
    {
        return Ok(());
    }
    if fog_fill::triangle_nearer(triangle, shader, scissor, is_clipped, depth, target) {
        return Ok(());
    }
    let setup = shader.set_up(&triangle.triangle);
    if shaded_fill::triangle_nearer::<T, S>(triangle, &setup, scissor, depth, target) {
        return Ok(());
    }
    shade_spans_nearer(triangle, scissor, depth, target, |span| S::span(&setup, span))
}

/// The plain path of [`fill_nearer`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans_nearer<T: Target>(
    triangle: &DepthTriangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let mut spans = fast::spans(&triangle.triangle, scissor);
    if spans.is_empty() {
        return Ok(()); // no pixel: the gradient is not set up
    }
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    // The spans of a triangle are one row high: stated for the target's code, which is inlined here.
    spans.try_for_each(|span| {
        depth.buffer.test(span, &gradient, |run| target.fill(Span { height: 1, ..run }, color))
    })
}

/// Fills a span of one row.
#[inline(always)]
fn fill_row<T: Target>(target: &mut T, x: i32, y: i32, width: i32, color: T::Color) -> Result<(), T::Error> {
    target.fill(Span { x, y, width, height: 1 }, color)
}

/// The plain path of [`fill_nearer`] for colours that vary.
#[inline(never)] // its stack frame is gone when it returns
fn shade_spans_nearer<T: Target, R: Iterator<Item = T::Color>>(
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    span_colors: impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    let mut spans = fast::spans(&triangle.triangle, scissor);
    spans.try_for_each(|span| shade_span_nearer(span, &gradient, depth, target, &span_colors))
}

#[inline(never)] // its large stack frame does not exist while the next span is computed
fn shade_span_nearer<T: Target, R: Iterator<Item = T::Color>>(
    span: Span,
    gradient: &Gradient,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    span_colors: &impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    depth.buffer.test(span, gradient, |visible| target.fill_run(visible, span_colors(visible)))
}

/// [`fill`] for a shader that leaves out pixels, or blends.
#[inline(never)] // its stack frame is gone when it returns
fn fill_kept<T: Target, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    let setup = shader.set_up(triangle);
    let merge = merge::<T, S>(&setup);
    if !S::LEAVES_OUT
        && let Some(own) = shader.solid_color().map(StoredPixel::stored)
        && kept_fill::solid_triangle(triangle, scissor, target, move |stored| merge(own, stored))
    {
        return Ok(());
    }
    if kept_fill::triangle(triangle, scissor, target, |span| S::kept(&setup, span), merge) {
        return Ok(());
    }
    fast::spans(triangle, scissor).try_for_each(|span| {
        let mut is_kept = kept_pixels::<T::Color, S>(&setup, span);
        let kept = (0..span.width as u16).map(|_| is_kept()); // the guard band is narrower than 2¹⁶
        each_run(span, kept, |run| draw_run::<T, S>(&setup, run, target))
    })
}

/// [`fill_nearer`] for a shader that leaves out pixels, or blends, or whose depth is not stored.
#[inline(never)] // its stack frame is gone when it returns
fn fill_kept_nearer<T: Target, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let setup = shader.set_up(&triangle.triangle);
    let runs = |span| S::kept(&setup, span);
    let merge = merge::<T, S>(&setup);
    let is_drawn = match S::WRITES_DEPTH {
        true => kept_fill::triangle_nearer::<true, _, _, _>(triangle, scissor, depth, target, runs, merge),
        false => kept_fill::triangle_nearer::<false, _, _, _>(triangle, scissor, depth, target, runs, merge),
    };
    if is_drawn {
        return Ok(());
    }
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    fast::spans(&triangle.triangle, scissor).try_for_each(|span| {
        let is_kept = kept_pixels::<T::Color, S>(&setup, span);
        depth
            .buffer
            .test_kept(span, &gradient, is_kept, S::WRITES_DEPTH, |run| draw_run::<T, S>(&setup, run, target))
    })
}

/// Whether a shader draws the pixels of a span: each call answers for the next one, from left to right.
#[inline(always)]
pub(super) fn kept_pixels<C: PixelColor, S: SpanShader<C>>(
    setup: &S::Setup,
    span: Span,
) -> impl FnMut() -> bool {
    let mut colors = S::kept(setup, span).flat_map(|(width, run)| run.take(width as usize));
    move || colors.next().flatten().is_some()
}

/// Draws one run of kept pixels, for a shader that leaves out pixels or blends.
#[inline(always)]
fn draw_run<T: Target, S: SpanShader<T::Color>>(
    setup: &S::Setup,
    run: Span,
    target: &mut T,
) -> Result<(), T::Error> {
    if !S::BLENDS {
        return target.fill_run(run, S::span(setup, run));
    }
    if let Some(row) = target.memory().and_then(|memory| memory.row(run.x, run.y, run.width)) {
        let (own, merge) = (S::span(setup, run).map(StoredPixel::stored), merge::<T, S>(setup));
        row.iter_mut().zip(own).for_each(|(pixel, own)| *pixel = merge(own, *pixel));
    }
    Ok(())
}

/// A function that returns the cell to store in a pixel, from the shader's own and the stored one.
#[inline(always)]
fn merge<T: Target, S: SpanShader<T::Color>>(
    setup: &S::Setup,
) -> impl Fn(Cell<T>, Cell<T>) -> Cell<T> + Copy {
    const {
        let readable = !S::BLENDS || <T::Store as PixelStore>::READABLE;
        assert!(readable, "this shader reads pixels: draw into a Picture, or into the pixels() of a Band");
    }
    let blend = S::blend(setup);
    move |own, stored| match S::BLENDS {
        true => blend(T::Color::load(own), T::Color::load(stored)).stored(),
        false => own,
    }
}

/// The stored form of a target's pixels.
type Cell<T> = <<T as Target>::Store as PixelStore>::Cell;

/// Draws a line inside the scissor, which lies in the target.
#[inline(always)]
pub(super) fn line<T: Target>(
    target: &mut T,
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
) -> Result<(), T::Error> {
    if line_fill::line_into_memory(from, to, scissor, color, target) {
        return Ok(());
    }
    if let Some(result) = line_pixels::line_by_pixels(from, to, scissor, color, target) {
        return result;
    }
    raster::line(from, to, scissor, |span| target.fill(span, color))
}

/// [`line`] for bands, which cut most lines: [`line_pixels`] would decline, so its code is not linked.
#[inline(always)]
pub(super) fn line_in_band<T: Target>(
    target: &mut T,
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
) -> Result<(), T::Error> {
    if line_fill::line_into_memory(from, to, scissor, color, target) {
        return Ok(());
    }
    raster::line(from, to, scissor, |span| target.fill(span, color))
}

/// The part of a target inside the guard band, in which 2D drawing is done. `Memory` stores it, so that it is not computed for
/// each triangle.
#[inline(always)]
pub(super) fn scissor_of<T: Target>(target: &mut T) -> Scissor {
    match target.memory() {
        Some(memory) => *memory.drawable(),
        None => drawable(&target.area()),
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::camera::{Camera, Projection, ViewTransform, Viewport};
    use crate::color::{Color, StoredPixel};
    use crate::math::random::Random;
    use crate::math::{Angle, Point3, Scalar, Vector3};
    use crate::raster::{area, ScreenPoint};
    use crate::shading::{CornerValues, Fog, FogTable, Fogged, Gouraud, ScreenDoor, ShadeTable, Shader};
    use crate::shading::{Texels, Texture};
    use crate::surface::{DepthBuffer, Memory, PictureError};
    use core::convert::Infallible;
    use embedded_graphics_core::geometry::{Point, Size};
    use embedded_graphics_core::pixelcolor::{Gray8, Rgb565, Rgb888, WebColors};
    use embedded_graphics_core::primitives::Rectangle;
    use std::vec;
    use std::vec::Vec;

    /// A target that takes spans and sets pixels one by one: only plain paths draw into it.
    struct Plain<C> {
        area: Rectangle,
        pixels: Vec<C>,
    }

    impl<C: Color> Plain<C> {
        fn set(&mut self, x: i32, y: i32, color: C) {
            let Rectangle { top_left, size } = self.area;
            let (column, row) = ((x - top_left.x) as usize, (y - top_left.y) as usize);
            assert!(column < size.width as usize && row < size.height as usize, "({x}, {y})");
            self.pixels[row * size.width as usize + column] = color;
        }
    }

    impl<C: Color> Target for Plain<C> {
        type Color = C;
        type Error = Infallible;
        type Store = [C; 0];

        fn area(&self) -> Rectangle {
            self.area
        }

        fn fill(&mut self, Span { x, y, width, height }: Span, color: C) -> Result<(), Infallible> {
            (y..y + height).for_each(|y| (x..x + width).for_each(|x| self.set(x, y, color)));
            Ok(())
        }

        fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = C>) -> Result<(), Infallible> {
            assert_eq!(span.height, 1);
            let colors: Vec<C> = colors.take(span.width as usize).collect();
            assert_eq!(colors.len(), span.width as usize);
            (span.x..).zip(colors).for_each(|(x, color)| self.set(x, span.y, color));
            Ok(())
        }
    }

    /// A target whose pixels lie in memory, and whose `fill` and `fill_run` are [`Memory`]'s.
    struct Direct<'a, Cell> {
        memory: Memory<&'a mut [Cell]>,
    }

    impl<'a> Target for Direct<'a, [u8; 2]> {
        type Color = Rgb565;
        type Error = Infallible;
        type Store = &'a mut [[u8; 2]];

        fn area(&self) -> Rectangle {
            self.memory.area()
        }

        fn fill(&mut self, span: Span, color: Rgb565) -> Result<(), Infallible> {
            self.memory.fill(span, color.stored());
            Ok(())
        }

        fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = Rgb565>) -> Result<(), Infallible> {
            self.memory.fill_run(span, colors.map(StoredPixel::stored));
            Ok(())
        }

        fn memory(&mut self) -> Option<&mut Memory<&'a mut [[u8; 2]]>> {
            Some(&mut self.memory)
        }
    }

    /// Calls `draw` for a plain target and one in memory, each with a depth buffer of this rectangle; compares pixels and
    /// depths.
    struct Twins {
        area: Rectangle,
        plain: Plain<Rgb565>,
        cells: Vec<[u8; 2]>,
        depths: [Vec<u16>; 2],
    }

    trait Draw {
        fn draw<T: Target<Color = Rgb565, Error = Infallible>>(
            &self,
            target: &mut T,
            depth: &mut DepthBuffer<'_>,
        );
    }

    impl Twins {
        fn new(area: Rectangle, depth_area: Rectangle) -> Self {
            let pixels = |area: Rectangle| (area.size.width * area.size.height) as usize;
            Self {
                area,
                plain: Plain { area, pixels: vec![Rgb565::load([0, 0]); pixels(area)] },
                cells: vec![[0; 2]; pixels(area)],
                depths: [(); 2].map(|()| vec![u16::MAX; pixels(depth_area)]),
            }
        }

        fn compare(&mut self, depth_area: Rectangle, frames: &[impl Draw]) -> Result<usize, PictureError> {
            let [plain_depth, depth] = &mut self.depths;
            let mut plain_depth = DepthBuffer::new(depth_area, plain_depth).expect("as many numbers");
            let mut depth = DepthBuffer::new(depth_area, depth).expect("as many numbers");
            let mut drawn = 0;
            for draw in frames {
                draw.draw(&mut self.plain, &mut plain_depth);
                let mut target = Direct { memory: Memory::new(&mut self.cells[..], self.area)? };
                draw.draw(&mut target, &mut depth);
                let colors = self.cells.iter().map(|&cell| Rgb565::load(cell));
                assert!(colors.eq(self.plain.pixels.iter().copied()));
                assert!(depth.values() == plain_depth.values());
                drawn = self.cells.iter().filter(|cell| **cell != [0; 2]).count();
            }
            Ok(drawn)
        }
    }

    /// One item: a triangle or a line, with a shader chosen by `kind`.
    struct Item {
        kind: usize,
        points: [ScreenPoint; 3],
        depths: [i32; 3],
        levels: [u16; 3],
        color: u16,
        uv: [[i16; 2]; 3],
        fog: Fog,
    }

    /// Texels whose colour says the upper bits of both coordinates.
    #[derive(Clone, Copy)]
    struct Bits;

    impl Texels for Bits {
        type Color = Rgb565;

        fn size_bits(&self) -> [u32; 2] {
            [6, 5]
        }

        fn texel(&self, u: u32, v: u32) -> Rgb565 {
            Rgb565::from_bits((u >> 16 ^ v >> 21 ^ v >> 16) & 0xffff)
        }
    }

    impl Item {
        fn camera() -> Camera {
            let [near, far] = [1, 100].map(Scalar::from_int);
            let view = ViewTransform::look_at(
                Point3::from_ints(0, 0, 0),
                Point3::from_ints(0, 0, -1),
                Vector3::from_ints(0, 1, 0),
            );
            let lens = Projection::perspective(Angle::degrees(60), AREA.size, near, far).unwrap();
            Camera::new(&view.unwrap(), &lens, &Viewport::new(Point::zero(), AREA.size).unwrap())
        }
    }

    /// A colour whose depth is tested and not stored.
    #[derive(Clone, Copy)]
    struct Tested(Rgb565);

    impl Shader for Tested {
        type Varying = ();

        fn sub_face(&self, _: [(); 3]) -> Self {
            *self
        }
    }

    impl SpanShader<Rgb565> for Tested {
        type Setup = Rgb565;
        const WRITES_DEPTH: bool = false;

        fn set_up(&self, _: &Triangle<'_>) -> Rgb565 {
            self.0
        }

        fn span(color: &Rgb565, _: Span) -> impl Iterator<Item = Rgb565> {
            core::iter::repeat(*color)
        }

        fn solid_color(&self) -> Option<Rgb565> {
            Some(self.0)
        }
    }

    impl Draw for Item {
        fn draw<T: Target<Color = Rgb565, Error = Infallible>>(
            &self,
            target: &mut T,
            depth: &mut DepthBuffer<'_>,
        ) {
            let viewport = Scissor::new(-200, -200, 200, 200);
            let scissor = scissor_of(target).clipped_to(&viewport);
            let depth_scissor = depth.scissor().clipped_to(&scissor);
            let area = area(&self.points);
            let color = Rgb565::from_bits(self.color.into());
            let table = ShadeTable::new(Rgb888::CSS_GOLD);
            let (table, smooth) = (table.lit(self.levels), Gouraud::lit(Rgb888::CSS_CORAL, self.levels));
            let triangle =
                DepthTriangle { triangle: Triangle::new(self.points, area, &viewport), depths: self.depths };
            let (flat, mut depth) = (&triangle.triangle, DepthTarget::new(depth, target));
            let depth = &mut depth;
            let [from, to, _] = self.points.map(|point| point.pixel());
            let is_clipped = area & 1 == 0; // no pixel depends on it
            let Ok(()) = match self.kind {
                0 => line(target, from, to, &scissor, color),
                _ if area == 0 => Ok(()),
                1 => fill(flat, &color, &scissor, is_clipped, target),
                2 => fill(flat, &table, &scissor, is_clipped, target),
                3 => fill(flat, &smooth, &scissor, is_clipped, target),
                4 => fill_nearer(&triangle, &color, &depth_scissor, is_clipped, depth, target),
                5 => fill_nearer(&triangle, &table, &depth_scissor, is_clipped, depth, target),
                7 => fill(flat, &ScreenDoor::new(smooth, 40), &scissor, is_clipped, target),
                8 => {
                    let door = ScreenDoor::new(smooth, self.color as u8 & 63);
                    fill_nearer(&triangle, &door, &depth_scissor, is_clipped, depth, target)
                }
                10 | 11 => {
                    let fog =
                        FogTable::new(&self.fog, &Self::camera(), Rgb565::CSS_LIGHT_STEEL_BLUE).unwrap();
                    let fogged =
                        Fogged::new(color, &fog).with_corners(&CornerValues::new(self.depths, [1; 3]));
                    match self.kind {
                        10 => fill(flat, &fogged, &scissor, is_clipped, target),
                        _ => fill_nearer(&triangle, &fogged, &depth_scissor, is_clipped, depth, target),
                    }
                }
                12..=14 => {
                    // Linear, on small triangles in one word; in perspective; linear in 32 bits.
                    let face = Texture::new(Bits).at(self.uv);
                    let unequal = self.levels.map(|level| (1 + i32::from(level)) << 21);
                    let w = [[1 << 29; 3], unequal, [1 << 29; 3]][self.kind - 12];
                    let face = face.with_corners(&CornerValues::new(self.depths, w));
                    let clamped = Texture::new(Bits).clamped_at(self.uv);
                    let clamped = clamped.with_corners(&CornerValues::new(self.depths, w));
                    match (self.kind, is_clipped) {
                        (14, _) => {
                            fill_nearer(&triangle, &clamped, &depth_scissor, is_clipped, depth, target)
                        }
                        (_, true) => fill(flat, &face, &scissor, is_clipped, target),
                        (_, false) => {
                            fill_nearer(&triangle, &face, &depth_scissor, is_clipped, depth, target)
                        }
                    }
                }
                9 => fill_nearer(&triangle, &Tested(color), &depth_scissor, is_clipped, depth, target),
                _ => fill_nearer(&triangle, &smooth, &depth_scissor, is_clipped, depth, target),
            };
        }
    }

    fn items(random: &mut Random, count: usize, kinds: &[usize]) -> Vec<Item> {
        let mut items = Vec::new();
        for i in 0..count {
            // Small triangles, low triangles, and triangles that extend far beyond the target.
            let reach = [2_000, 6_000, 60_000, 700][random.below(4) as usize];
            let center = [0; 2].map(|_| random.within(20_000));
            let mut point = || {
                let [x, y] = center.map(|v| v + random.within(reach));
                ScreenPoint::from_subpixels(x, y).expect("in the guard band")
            };
            let points = [point(), point(), point()];
            let farthest = i64::from(crate::raster::FARTHEST);
            items.push(Item {
                kind: kinds[i % kinds.len()],
                points,
                depths: [0; 3].map(|_| random.below(farthest + 1) as i32),
                levels: [0; 3].map(|_| random.below(257) as u16),
                color: random.below(1 << 16) as u16,
                // Often less than one side of the picture, 1024 units.
                uv: [0; 3].map(|_| [0; 2].map(|_| random.within([500, 5_000][i & 1]) as i16)),
                fog: {
                    // From all levels in a few steps of depth to levels over most of the range.
                    let start = 1 + random.below(40);
                    let [start, end] =
                        [start, start + 1 + random.below(50)].map(|v| Scalar::from_int(v as i32));
                    Fog::linear(start, end).unwrap()
                },
            });
        }
        items
    }

    /// All kinds of items.
    const ALL: &[usize] = &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14];

    const AREA: Rectangle = Rectangle::new(Point::new(-45, -33), Size::new(97, 71));

    #[test]
    fn memory_gets_the_pixels_and_depths_of_the_plain_path() {
        let random = &mut Random(25);
        let one_row_more = Rectangle::new(AREA.top_left, AREA.size + Size::new(0, 1));
        let elsewhere = Rectangle::new(Point::new(-60, -20), Size::new(97, 60));
        for depth_area in [AREA, one_row_more, elsewhere] {
            for kinds in [
                &[0][..],
                &[1],
                &[2],
                &[3],
                &[4],
                &[5],
                &[6],
                &[7],
                &[8],
                &[4, 9],
                &[10],
                &[11],
                &[12],
                &[13],
                &[14],
                ALL,
            ] {
                let mut drawn = 0;
                for _ in 0..12 {
                    let items = items(random, 60, kinds);
                    drawn += Twins::new(AREA, depth_area).compare(depth_area, &items).expect("cells");
                }
                assert!(drawn > 1_000, "{kinds:?}: {drawn}");
            }
        }
    }

    /// A shader that does not write depth is tested against the depth buffer, and leaves it unchanged.
    #[test]
    fn depth_is_tested_and_not_stored() {
        let random = &mut Random(27);
        let mut drawn = 0;
        for _ in 0..12 {
            let mut twins = Twins::new(AREA, AREA);
            let behind = items(random, 60, &[4]);
            twins.compare(AREA, &behind).expect("cells");
            let (depths, pixels) = (twins.depths[0].clone(), twins.plain.pixels.clone());
            for item in items(random, 60, &[9]) {
                let mut buffer = DepthBuffer::new(AREA, &mut twins.depths[0]).expect("as many numbers");
                buffer.values_mut().copy_from_slice(&depths);
                item.draw(&mut twins.plain, &mut buffer);
                assert!(buffer.values() == depths);
            }
            drawn += twins.plain.pixels.iter().zip(&pixels).filter(|(new, old)| new != old).count();
        }
        assert!(drawn > 1_000, "{drawn}");
    }

    #[test]
    fn thin_and_wide_targets_get_the_pixels_of_the_plain_path() {
        let random = &mut Random(26);
        for size in [Size::new(1, 300), Size::new(2, 90), Size::new(399, 3), Size::new(64, 1)] {
            let area = Rectangle::new(Point::new(-20, -2), size);
            for _ in 0..20 {
                let items = items(random, 60, ALL);
                Twins::new(area, area).compare(area, &items).expect("cells");
            }
        }
    }

    /// The pixel store `[Color; 0]` marks a target without memory: its `memory` returns `None`.
    #[test]
    fn a_target_without_memory_hands_out_none() {
        let mut plain = Plain { area: AREA, pixels: vec![Gray8::new(0); 97 * 71] };
        assert!(plain.memory().is_none());
        assert_eq!(scissor_of(&mut plain), drawable(&AREA));
    }
}
