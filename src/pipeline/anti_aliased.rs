//! Anti-aliased lines into memory, with and without a depth test.
//!
//! Without a depth test, most lines are drawn by `fast::anti_aliased_line`. There is no path for a `DrawTarget`: targets whose pixels cannot be read do not compile with a stroke that is anti-aliased.

use super::drawable::StrokeFor;
use crate::camera::UnpackedVertex;
use crate::color::{Access, StoredPixel};
use crate::fast::anti_aliased_line::{anti_aliased_edge, anti_aliased_line};
use crate::fast::table_line::table_line;
use crate::math::hints::keep_rolled;
use crate::raster::{
    areas_at, rest, share, weighted_area, Column, LineArea, LineCoverage, LineDepth, LineEnds, Pixel, Scissor,
};
use crate::shading::{rests_of_line, StrokeKind};
use crate::surface::{DepthBuffer, Memory, Surface};
use embedded_graphics_core::pixelcolor::PixelColor;

/// How many pixels an edge reaches beyond the rows and columns of its ends' pixels. A pixel of which a part is covered has its centre
/// within 1.21 pixels of the line, and a pixel of which a part belongs to the line within ⅔ pixel before its end: together they are
/// within 1.38 pixels of the end, which may lie on the border of its pixel.
pub(super) const BEYOND: i32 = 1;

/// [`BEYOND`] of an edge with areas from a table: it begins up to ¼ pixel before its end, where its middle may lie in the row
/// before, and covers a part of the row before that one.
pub(super) const BEYOND_BY_TABLE: i32 = 2;

/// [`BEYOND`] of the edges of a stroke.
pub(super) const fn beyond<C: PixelColor, K: StrokeKind<C>>() -> i32 {
    match (K::BY_TABLE, <K::Access as Access>::READS) {
        (true, _) => BEYOND_BY_TABLE,
        (false, true) => BEYOND,
        (false, false) => 0,
    }
}

/// Draws a line between the centres of two pixels, from border to border.
#[inline(always)]
pub(super) fn line_between_pixels<T: Surface, K: StrokeFor<T>>(
    ends: [Pixel; 2],
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    // Pixels may lie beyond the guard band, within 2¹⁵.
    let ends = ends.map(|p| [p.x, p.y].map(|v| 256 * i32::from(v) + 128));
    let line = LineCoverage::new(ends, 0, scissor);
    all_columns(line.clone(), &line.area(), scissor, stroke, target);
}

/// Draws an edge of a mesh without a depth test, if it reaches into the viewport.
#[inline(never)] // one copy for all callers
pub(super) fn edge<T: Surface, K: StrokeFor<T>>(
    ends: &[UnpackedVertex; 2],
    viewport: &Scissor,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    let ends = subpixels(ends);
    if K::BY_TABLE {
        let (line, halves) = LineCoverage::between_ends(ends, scissor);
        if line.first < line.end
            && !table_line(&line, halves, stroke, target)
            && meet(ends, BEYOND_BY_TABLE, viewport)
        {
            by_parts(line.split(halves), &line.area(), &[LineEnds::HALF; 2], scissor, stroke, target);
        }
        return;
    }
    let line = LineCoverage::new(ends, BEYOND, scissor);
    if !line.inside && !meet(ends, BEYOND, viewport) {
        return;
    }
    let area = line.area();
    let (at_ends, parts) = LineEnds::new(ends, &line, &area);
    if !anti_aliased_edge(&parts, &area, &at_ends, scissor, stroke, target) {
        // Copied, so that what the fast path takes has no address, and lies in registers.
        by_parts(parts.clone(), &area, &at_ends.clone(), scissor, stroke, target);
    }
}

/// Draws an edge by its parts: the columns at its start, those in its middle, and those at its end.
#[inline(never)] // most edges are drawn by the fast path
fn by_parts<T: Surface, K: StrokeFor<T>>(
    [start, middle, end]: [LineCoverage; 3],
    area: &LineArea,
    at_ends: &[LineEnds; 2],
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    for (part, at_end) in [start, end].iter().zip(at_ends) {
        keep_rolled();
        if part.first < part.end && (part.inside || part.meets(scissor)) {
            by_pixels(part, area, Some(at_end), scissor, stroke, target);
        }
    }
    if middle.first < middle.end {
        all_columns(middle, area, scissor, stroke, target);
    }
}

/// Draws the columns of a line whose pixels belong to the line.
#[inline(never)] // one copy for all callers
fn all_columns<T: Surface, K: StrokeFor<T>>(
    mut line: LineCoverage,
    area: &LineArea,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    if !line.inside {
        line = line.clipped(scissor);
        if (line.tall || K::BY_TABLE) && !line.inside {
            line = ends_of_line(line, area, scissor, stroke, target);
        }
    }
    if line.first < line.end && !anti_aliased_line(&line, area, scissor, stroke, target) {
        // Copied, so that the line itself has no address, and its fields lie in registers.
        by_pixels(&line.clone(), area, None, scissor, stroke, target);
    }
}

/// Draws the columns of a line that may have pixels outside the scissor, and returns the line's other columns.
#[cold]
#[inline(never)]
fn ends_of_line<T: Surface, K: StrokeFor<T>>(
    line: LineCoverage,
    area: &LineArea,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) -> LineCoverage {
    let interior = line.interior(scissor);
    by_pixels(&line.part(line.first..interior.first), area, None, scissor, stroke, target);
    by_pixels(&line.part(interior.end..line.end), area, None, scissor, stroke, target);
    interior
}

/// Mixes the pixels of a line that lie in the scissor. `ends`: the weights of the pixels, if the columns lie at an end.
#[inline(never)]
fn by_pixels<T: Surface, K: StrokeFor<T>>(
    line: &LineCoverage,
    area: &LineArea,
    ends: Option<&LineEnds>,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
) {
    mix_columns::<false, _, _, _>(line, area, ends, scissor, stroke, target, |_| (), |(), _, _, _| true);
}

/// Mixes the pixels of a line inside the scissor, which lies in the target, for which `is_visible` is true, given x, y and the
/// share of the line's colour, in 2⁻¹⁶. `ends`: as in [`by_pixels`].
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn mix_columns<const UNROLLED: bool, T: Surface, K: StrokeFor<T>, D: Copy>(
    line: &LineCoverage,
    area: &LineArea,
    ends: Option<&LineEnds>,
    scissor: &Scissor,
    stroke: K,
    target: &mut T,
    mut depth: impl FnMut(i32) -> D,
    mut is_visible: impl FnMut(D, i32, i32, i32) -> bool,
) {
    let Some((_, memory)) = target.memory().map(Memory::split) else { return };
    let (cells, scratch) = memory.parts();
    let (layout, color, mix) = (scratch.layout, stroke.color(), stroke.mixer());
    // Without a branch, from which LLVM would make two loops.
    let [tall, wide] = [line.tall, !line.tall].map(i32::from);
    // The table has the weights of ends, too, which are one half.
    let (rests, exact) = (rests_of_line::<_, K>(line.slope())[usize::from(ends.is_some())], *area);
    let ends = ends.filter(|_| !K::BY_TABLE);
    let areas = move |fraction| match K::BY_TABLE {
        true => areas_at(rests, fraction, K::SHARE_BITS),
        false => exact.column(fraction),
    };
    for Column { column, first, areas } in line.columns_by(areas) {
        let own = depth(column);
        for (at, area) in (first..).zip(areas) {
            if !UNROLLED {
                keep_rolled();
            }
            if share(area, K::SHARE_BITS) == 0 {
                continue;
            }
            let weight = ends.map_or(LineEnds::ALL, |ends| ends.weight([column, at]));
            let row = if line.rises { !at } else { at };
            let (x, y) = (column * wide + row * tall, column * tall + row * wide);
            if weight != 0
                && scissor.rows().contains(&y)
                && scissor.columns().contains(&x)
                && let Some(cell) = cells.get_mut(layout.at(x, y))
            {
                let below = T::Color::load(*cell);
                let share = match weight {
                    LineEnds::ALL => area,
                    // Shares of an opaque colour leave factors of the stored colour. Shares of a translucent one nearly add up.
                    _ if K::IS_OPAQUE || mix(below, 0) == color => weighted_area(area, weight),
                    _ => (area * weight) >> 4,
                };
                if is_visible(own, x, y, share) {
                    *cell = mix(below, rest(share, K::SHARE_BITS)).stored();
                }
            }
        }
    }
}

/// The ends of an edge in 1/256 pixel.
#[inline(always)]
fn subpixels(ends: &[UnpackedVertex; 2]) -> [[i32; 2]; 2] {
    ends.map(|end| [end.point.x, end.point.y])
}

/// Whether an edge may reach into the viewport.
#[inline(always)]
fn meet(ends: [[i32; 2]; 2], beyond: i32, viewport: &Scissor) -> bool {
    let [[ax, ay], [bx, by]] = ends.map(|end| end.map(|v| v >> 8));
    let pixels = Scissor::unclamped(ax.min(bx), ay.min(by), ax.max(bx) + 1, ay.max(by) + 1);
    !pixels.grown(beyond).intersection(viewport).is_empty()
}

/// An edge by its parts, and the weights of the pixels at its start and its end.
#[inline(always)]
fn parts_of<C: PixelColor, K: StrokeKind<C>>(
    ends: [[i32; 2]; 2],
    scissor: &Scissor,
) -> (LineArea, [LineEnds; 2], [LineCoverage; 3]) {
    if K::BY_TABLE {
        let (line, halves) = LineCoverage::between_ends(ends, scissor);
        return (line.area(), [LineEnds::HALF; 2], line.split(halves));
    }
    let line = LineCoverage::new(ends, BEYOND, scissor);
    let area = line.area();
    let (at_ends, parts) = LineEnds::new(ends, &line, &area);
    (area, at_ends, parts)
}

/// Draws the pixels of an edge that are as near as the depth buffer, or for which `is_drawn_over` is true, given the stored depth
/// and the pixel. All pixels of a column have the depth of the line in the middle of the column. `stores`: that depth is stored
/// where the line's colour has at least half of a pixel.
#[inline(never)] // one copy for both callers
#[allow(clippy::too_many_arguments)]
pub(super) fn visible_edge<T: Surface, K: StrokeFor<T>>(
    ends: &[UnpackedVertex; 2],
    stores: bool,
    is_drawn_over: &mut dyn FnMut(u16, i32, i32) -> Option<bool>,
    viewport: &Scissor,
    scissor: &Scissor,
    stroke: K,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) {
    let points = subpixels(ends);
    if !meet(points, beyond::<_, K>(), viewport) {
        return;
    }
    let (area, [at_start, at_end], [start, middle, end]) = parts_of::<_, K>(points, scissor);
    let line_depth = LineDepth::on_axis(middle.tall, ends.map(|end| end.point), ends.map(|end| end.depth));
    for (part, ends) in [(start, Some(&at_start)), (middle.clipped(scissor), None), (end, Some(&at_end))] {
        keep_rolled();
        if part.first >= part.end || !part.meets(scissor) {
            continue;
        }
        mix_columns::<true, _, _, _>(
            &part,
            &area,
            ends,
            scissor,
            stroke,
            target,
            |column| line_depth.depth(column),
            |own, x, y, share| {
                let Some([stored]) = depth.row(x, y, 1) else { return false };
                let is_visible = own <= *stored || is_drawn_over(*stored, x, y) == Some(true);
                if is_visible && stores && share >= 1 << 15 {
                    *stored = own;
                }
                is_visible
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Color, Reads};
    use crate::math::random::Random;
    use crate::raster::ScreenPoint;
    use crate::shading::AntiAliased;
    use crate::surface::{Picture, Pixels};
    use embedded_graphics_core::geometry::Size;
    use embedded_graphics_core::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb666, Rgb888};
    use embedded_graphics_core::prelude::{GrayColor, RgbColor};

    const SIZE: Size = Size::new(40, 33);
    /// The pixels of a picture.
    type Cells<C> = [C; 40 * 33];

    /// A stroke that shows each mix, its share and its order: any other gives another pixel, but for one of 2²⁴.
    #[derive(Clone, Copy)]
    struct Trace<const BITS: u32, const BY_TABLE: bool = false>;

    impl<const BITS: u32, const BY_TABLE: bool> StrokeKind<Rgb888> for Trace<BITS, BY_TABLE> {
        type Access = Reads;
        const IS_OPAQUE: bool = true; // both paths then take shares by weight
        const SHARE_BITS: u32 = BITS;
        const BY_TABLE: bool = BY_TABLE;

        fn color(&self) -> Rgb888 {
            Rgb888::WHITE
        }

        fn mixer(self) -> impl Fn(Rgb888, u32) -> Rgb888 + Copy {
            |below, rest| {
                assert!(rest <= 1 << BITS, "{rest}");
                if rest == 1 << BITS {
                    return below; // nothing is covered
                }
                Rgb888::from_bits((below.to_bits() ^ (rest + 1)).wrapping_mul(0x9e_3779) & 0xff_ffff)
            }
        }
    }

    /// How many lines the fast path took, and how many of them are tall.
    #[derive(Default, Debug)]
    struct Taken {
        tall: usize,
        wide: usize,
        edges: usize,
        by_table: usize,
        pixels: usize,
    }

    /// A picture of a background that `draw` draws over.
    fn picture<C: Color>(background: &Cells<C>, draw: impl FnOnce(&mut Pixels<'_, C>)) -> Cells<C> {
        let mut cells = *background;
        draw(&mut Picture::new(&mut cells, SIZE).expect("cells").pixels());
        cells
    }

    /// Draws a line by the fast path and by the plain one, as `line` attaches them, and compares each pixel.
    fn compare<C: Color + core::fmt::Debug, K: StrokeKind<C>>(
        ends: [[i32; 2]; 2],
        scissor: &Scissor,
        stroke: K,
        background: &Cells<C>,
        taken: &mut Taken,
    ) {
        for (ends, beyond) in [(ends, 0), (ends, BEYOND), ([ends[1], ends[0]], BEYOND)] {
            let line = LineCoverage::new(ends, beyond, scissor);
            let inner = line.end - 3 * beyond;
            let whole = line.part((line.first + 3 * beyond).min(inner)..inner);
            let area = &whole.area();
            let equal = |fast: &Cells<C>, plain: &Cells<C>, what: &str| {
                let unequal = fast.iter().zip(plain).position(|(fast, plain)| fast != plain);
                let at = unequal
                    .map(|at| (at % SIZE.width as usize, at / SIZE.width as usize, fast[at], plain[at]));
                assert!(at.is_none(), "{what}, {ends:?}, {beyond}, {scissor:?}: {at:?}");
            };
            let plain = picture(background, |pixels| by_pixels(&whole, area, None, scissor, stroke, pixels));
            let fast =
                picture(background, |pixels| all_columns(whole.clone(), area, scissor, stroke, pixels));
            equal(&fast, &plain, "the line");
            taken.pixels += fast.iter().zip(background).filter(|(fast, below)| fast != below).count();
            // The loop alone, in the parts that it takes.
            let part = if whole.inside { whole } else { whole.clipped(scissor) };
            let part = if part.tall && !part.inside { part.interior(scissor) } else { part };
            if part.first < part.end {
                let mut is_taken = false;
                let fast = picture(background, |pixels| {
                    is_taken = anti_aliased_line(&part, area, scissor, stroke, pixels);
                });
                if is_taken {
                    equal(
                        &fast,
                        &picture(background, |pixels| by_pixels(&part, area, None, scissor, stroke, pixels)),
                        "a part",
                    );
                    *(if part.tall { &mut taken.tall } else { &mut taken.wide }) += 1;
                }
            }
        }
    }

    /// Draws an edge, by the fast path where it is taken, and by the plain one in all parts, and compares each pixel.
    fn compare_edge<C: Color + core::fmt::Debug, K: StrokeKind<C, Access = Reads>>(
        ends: [[i32; 2]; 2],
        scissor: &Scissor,
        stroke: K,
        background: &Cells<C>,
        taken: &mut Taken,
    ) {
        let (area, at_ends, parts) = parts_of::<_, K>(ends, scissor);
        let weights = [Some(&at_ends[0]), None, Some(&at_ends[1])];
        let plain = picture(background, |pixels| {
            for (part, weights) in parts.iter().zip(weights) {
                by_pixels(part, &area, weights, scissor, stroke, pixels);
            }
        });
        let vertices =
            ends.map(|[x, y]| UnpackedVertex { point: ScreenPoint::from_subpixels(x, y).unwrap(), depth: 0 });
        let drawn =
            picture(background, |pixels| edge(&vertices, &Scissor::GUARD_BAND, scissor, stroke, pixels));
        assert!(drawn == plain, "{ends:?} {scissor:?}");
        if K::BY_TABLE {
            taken.by_table += usize::from(parts[1].inside);
            return;
        }
        let mut taken_alone = false;
        let fast = picture(background, |pixels| {
            taken_alone = anti_aliased_edge(&parts, &area, &at_ends, scissor, stroke, pixels);
        });
        assert!(fast == if taken_alone { plain } else { *background }, "{ends:?} {scissor:?}");
        taken.edges += usize::from(taken_alone);
    }

    /// Compares a line in every format, over a background of random colours.
    fn in_all_formats(ends: [[i32; 2]; 2], scissor: &Scissor, random: &mut Random, taken: &mut Taken) {
        fn one<C: Color + core::fmt::Debug>(
            color: C,
            ends: [[i32; 2]; 2],
            scissor: &Scissor,
            random: &mut Random,
            taken: &mut Taken,
        ) {
            let random = [(); 40 * 33].map(|()| C::from_bits(random.bits() & ((1 << C::FORMAT.bits()) - 1)));
            let mix = AntiAliased(color).mixer();
            assert!(random.iter().all(|&below| mix(below, 0) == color)); // IS_OPAQUE
            for background in [[C::from_bits(0); 40 * 33], random] {
                compare_edge(ends, scissor, AntiAliased(color), &background, taken);
                compare(ends, scissor, AntiAliased(color), &background, taken);
                compare_edge(ends, scissor, AntiAliased(color).by_table(), &background, taken);
            }
        }
        one(Gray8::WHITE, ends, scissor, random, taken);
        one(Gray4::new(13), ends, scissor, random, taken);
        one(Gray2::WHITE, ends, scissor, random, taken);
        one(BinaryColor::On, ends, scissor, random, taken);
        one(Rgb565::new(31, 40, 3), ends, scissor, random, taken);
        one(Rgb666::YELLOW, ends, scissor, random, taken);
        one(Rgb888::new(255, 130, 7), ends, scissor, random, taken);
    }

    /// Compares a line in all formats now and then, and by its shares always.
    fn check(ends: [[i32; 2]; 2], scissor: &Scissor, random: &mut Random, taken: &mut Taken) {
        let background = [(); 40 * 33].map(|()| Rgb888::from_bits(random.bits() & 0xff_ffff));
        compare(ends, scissor, Trace::<8>, &background, taken);
        compare(ends, scissor, Trace::<5>, &background, taken);
        compare_edge(ends, scissor, Trace::<8>, &background, taken);
        compare_edge(ends, scissor, Trace::<5>, &background, taken);
        compare(ends, scissor, Trace::<8, true>, &background, taken);
        compare_edge(ends, scissor, Trace::<8, true>, &background, taken);
        compare_edge(ends, scissor, Trace::<5, true>, &background, taken);
        if random.below(20) == 0 {
            in_all_formats(ends, scissor, random, taken);
        }
    }

    fn scissor(random: &mut Random) -> Scissor {
        let picture = Scissor::new(0, 0, 40, 33);
        match random.below(4) {
            0 => picture,
            1 => Scissor::new(3, 2, 36, 30),
            _ => {
                let [left, top] = [40, 33].map(|side| random.below(side) as i32);
                let [width, height] = [0; 2].map(|_| random.below(14) as i32 + 1);
                Scissor::new(left, top, left + width, top + height).intersection(&picture)
            }
        }
    }

    #[test]
    fn the_fast_path_mixes_the_pixels_of_the_plain_one() {
        let random = &mut Random(0xAA17);
        let mut taken = Taken::default();
        for i in 0..3_000 {
            let scissor = scissor(random);
            // Within the picture, across its borders, from beyond one border to beyond another, and over the guard band.
            let reach =
                [20 * 256, 20 * 256, 40 * 256, 200 * 256, 8_000 * 256][if i % 50 == 0 { 4 } else { i % 4 }];
            let mut end = || [20 * 256 + random.within(reach), 16 * 256 + random.within(reach)];
            check([end(), end()], &scissor, random, &mut taken);
        }
        assert!(
            cfg!(pinhole_plain)
                || taken.tall > 3_000 && taken.wide > 3_000 && taken.edges > 300 && taken.pixels > 200_000,
            "{taken:?}"
        );
    }

    #[test]
    fn hard_lines_are_mixed_as_by_the_plain_path() {
        let random = &mut Random(0xAA18);
        let mut taken = Taken::default();
        // Level, diagonal, nearly so, and steep, in all directions; of less than a pixel up to beyond all borders.
        for (x, y) in
            [0, 1, 13, 100, 181, 255, 256].into_iter().flat_map(|slope| [(256, slope), (slope, 256)])
        {
            for [x, y] in [[x, y], [-x, y], [x, -y], [-x, -y]] {
                for length in [0, 1, 2, 5, 12, 60] {
                    // At pixel borders, centres and in between, from the middle and beside each border.
                    let lefts = [20, 0, 1, 38, 39, 2, -1, 20, 20, 41];
                    let tops = [16, 0, 30, 1, 32, 2, 16, -2, 34, 9];
                    for (left, top) in lefts.into_iter().zip(tops) {
                        let at = [left * 256, top * 256]
                            .map(|v| v + [0, 128, random.below(256) as i32][random.below(3) as usize]);
                        let ends = [at, [at[0] + x * length, at[1] + y * length]];
                        let scissor =
                            if random.below(3) == 0 { scissor(random) } else { Scissor::new(0, 0, 40, 33) };
                        check(ends, &scissor, random, &mut taken);
                    }
                }
            }
        }
        assert!(
            cfg!(pinhole_plain)
                || taken.tall > 1_500 && taken.wide > 1_500 && taken.edges > 200 && taken.pixels > 100_000,
            "{taken:?}"
        );
        assert!(taken.by_table > 500, "{taken:?}");
    }
}
