//! What an anti-aliased line leaves uncovered of the pixels of a column, from a table.
//!
//! `line_area.rs` has the formulas. Here the slope is rounded to one of 16, and the position of the line's middle in its pixel to one of
//! 32: an area changes by at most 0.023 from the middle of a range of slopes to its end, and by 1/64 from the middle of a range of
//! positions. The outermost two of the five pixels of a column, of which at most 0.0215 is covered, are left out. Gupta and Sproull,
//! *Filtering edges for gray-scale displays*, 1981, take the intensities of three pixels a column from a table by their distance from the
//! line.
//!
//! A column that may belong to two lines has half of each, which leaves the square root of what is uncovered: see `line_end.rs`. Such
//! columns are few, so that four slopes are enough.

use super::line_area::rest;
use super::line_end::LEAST_LEFT;
use super::PIXELS;

/// 1 in areas, slopes and positions: 2⁻¹⁶.
const ONE: u64 = 1 << 16;

/// The columns of a line, by the position of the line's middle: what is left uncovered of the middle pixel and of those before and after
/// it, in three bytes. Before and after, 0 stands for a pixel of which nothing is covered, as no line covers all of such a pixel.
pub(crate) type LineRests = [u32; 32];

/// The number of slopes of columns that belong to one line, and of columns of which half belongs to it.
const SLOPES: [usize; 2] = [16, 4];

/// 2.5 KB: columns that belong to a line, then those of which half does.
pub(crate) type LineTable = [LineRests; SLOPES[0] + SLOPES[1]];

/// The table for rests in 2^−`bits`, `bits` 1 … 8. Each slope and each position is the middle of a range.
pub(crate) const fn line_table(bits: u32) -> LineTable {
    let mut table = [[0; 32]; SLOPES[0] + SLOPES[1]];
    let mut index = 0;
    while index < table.len() {
        let is_half = index >= SLOPES[0];
        let (line, slopes) = if is_half { (index - SLOPES[0], SLOPES[1]) } else { (index, SLOPES[0]) };
        let slope = (2 * line as u64 + 1) * ONE / (2 * slopes as u64);
        let height = (ONE * ONE + slope * slope).isqrt();
        let reach = (height + slope) / 2;
        let mut at = 0;
        while at < 32 {
            let position = (2 * at as u64 + 1) * ONE / 64;
            let [before, after] = [beyond(reach, position, slope), beyond(reach, ONE - position, slope)];
            // Less the area of the pixel after the next one.
            let far = [beyond(reach, ONE + position, slope), beyond(reach, 2 * ONE - position, slope)];
            let [before, middle, after] = [
                left(before - far[0], is_half, bits),
                left(height - before - after, is_half, bits),
                left(after - far[1], is_half, bits),
            ];
            let none = 1 << bits;
            table[index][at] = ((before % none) << 16) | (middle << 8) | (after % none);
            at += 1;
        }
        index += 1;
    }
    table
}

/// The columns of a line with a slope in 2⁻³², below 1: those that belong to the line, and those of which half does.
#[inline(always)]
pub(crate) const fn rests_of(table: &LineTable, slope: u32) -> [&LineRests; 2] {
    [&table[(slope >> 28) as usize], &table[SLOPES[0] + (slope >> 30) as usize]]
}

/// The area of a line beyond a border that lies `border` from its middle.
const fn beyond(reach: u64, border: u64, slope: u64) -> u64 {
    match reach.saturating_sub(border) {
        x if x < slope => x * x / (2 * slope),
        x => x - slope / 2,
    }
}

/// What a line leaves of a pixel, of which it covers `area`, in 2^−`bits`.
const fn left(area: u64, is_half: bool, bits: u32) -> u32 {
    let mut area = area as i32;
    if is_half {
        let left = ONE as i32 - area;
        let left = if left < LEAST_LEFT { LEAST_LEFT } else { left };
        area = (ONE - (left as u64 * ONE).isqrt()) as i32;
    }
    rest(area, bits)
}

/// The column in whose middle pixel the line's middle lies at a fraction of its height, in 2⁻³²: before, middle, after.
#[inline(always)]
pub(crate) fn rests_at(line: &LineRests, fraction: u32) -> [u32; 3] {
    let rests = line[(fraction >> 27) as usize];
    [rests >> 16, rests >> 8 & 0xff, rests & 0xff]
}

/// The areas of the column's pixels, in 2⁻¹⁶ and multiples of 2^−`bits`, as [`LineArea::column`](super::LineArea::column) gives them.
#[inline(always)]
pub(crate) fn areas_at(line: &LineRests, fraction: u32, bits: u32) -> [i32; PIXELS] {
    let [before, middle, after] = rests_at(line, fraction);
    let area = |rest: u32| (1 << 16) - ((rest as i32) << (16 - bits));
    let beside = |rest: u32| if rest == 0 { 0 } else { area(rest) };
    [0, beside(before), area(middle), beside(after), 0]
}
