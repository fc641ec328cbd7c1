//! Bresenham's midpoint lines, one span per run of pixels, with exact clipping.
//!
//! From the smaller end, the pixel after i major steps has made
//! `k(i) = ⌈(2·m·i − L) / (2·L)⌉` minor steps, with L the major and m the minor extent: that is
//! `i·m/L` rounded to nearest with ties down, the midpoint rule in closed form. Clipping inverts
//! it, so the error term can start at any pixel of the line. (Bresenham, *Algorithm for computer
//! control of a digital plotter*, 1965; Kuzmin, *Bresenham's line generation algorithm with
//! built-in clipping*, 1995.)

use super::{Pixel, Scissor, Span};
use crate::math::hints::keep_rolled;
use crate::math::num::divide_word;

/// Calls `span` for each run of pixels along the major axis of the line from `a` to `b`, both included, inside the scissor:
/// rules L1 to L3. A horizontal or vertical line is a single span.
///
/// A pixel costs one addition and one comparison; set-up divides only if the line is clipped.
///
/// # Errors
///
/// The first error of `span`; no further span is computed.
#[inline(always)]
pub(crate) fn line<E>(
    a: Pixel,
    b: Pixel,
    scissor: &Scissor,
    span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    LineSpans::new(&LineSetup::new(a, b), scissor).try_for_each(span)
}

/// Set-up of a line. It starts at its smaller end, the one with the smaller x, and has one pixel per step along its major axis;
/// the pixels of steps `first` to `last` are drawn.
pub(crate) struct LineSetup {
    /// The smaller end, in pixels.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// Whether the major axis is y, and whether y decreases along the line.
    pub(crate) tall: bool,
    pub(crate) up: bool,
    /// The major and the minor extent: `length` ≥ `rise` ≥ 0, both below 2¹⁶.
    pub(crate) length: i32,
    pub(crate) rise: i32,
    /// The larger end, in pixels.
    pub(crate) end: (i32, i32),
    /// The steps to draw; none if `first > last`.
    pub(crate) first: i32,
    pub(crate) last: i32,
}

impl LineSetup {
    /// The line between two pixels, not clipped.
    #[inline(always)]
    pub(crate) fn new(a: Pixel, b: Pixel) -> Self {
        Self::between((a.x.into(), a.y.into()), (b.x.into(), b.y.into()))
    }

    /// The line between two pixels, not clipped: column and row of each, in 16 bits.
    #[inline(always)]
    pub(crate) fn between((ax, ay): (i32, i32), (bx, by): (i32, i32)) -> Self {
        // Ends sorted by x; with equal x both directions give the same pixels.
        let (x, y, end) = if ax <= bx { (ax, ay, (bx, by)) } else { (bx, by, (ax, ay)) };
        let (width, dy) = (end.0 - x, end.1 - y); // 0 ≤ width < 2¹⁶, |dy| < 2¹⁶
        let height = dy.abs();
        let tall = height > width;
        let (length, rise) = if tall { (height, width) } else { (width, height) };
        Self { x, y, tall, up: dy < 0, length, rise, end, first: 0, last: length }
    }

    /// Whether all pixels of the line lie in the scissor.
    #[inline(always)]
    pub(crate) fn lies_in(&self, scissor: &Scissor) -> bool {
        let &Self { x, y, up, end, .. } = self;
        let (top, bottom) = if up { (end.1, y) } else { (y, end.1) };
        x >= scissor.left && end.0 < scissor.right && top >= scissor.top && bottom < scissor.bottom
    }

    /// The part of the line that lies in the scissor.
    #[inline(always)]
    pub(crate) fn clipped(&self, scissor: &Scissor) -> Self {
        let Self { x, y, tall, up, length, rise, .. } = *self;
        // The first and the last step inside the scissor's columns and rows; |·| ≤ 2¹⁷.
        let columns = (scissor.left - x, scissor.right - 1 - x);
        let rows = if up {
            (y - (scissor.bottom - 1), y - scissor.top)
        } else {
            (scissor.top - y, scissor.bottom - 1 - y)
        };
        let (major, minor) = if tall { (rows, columns) } else { (columns, rows) };
        let (mut first, mut last) = (major.0.max(0), major.1.min(length));
        if minor.0 > rise || minor.1 < 0 {
            last = -1;
        }
        // k(i) ≥ K first holds for i = ⌊(2K − 1)·L / 2m⌋ + 1, and k(i) ≤ K last for
        // i = ⌊(2K + 1)·L / 2m⌋: here m > 0, since 0 < K ≤ m or 0 ≤ K < m.
        if first <= last && minor.0 > 0 {
            first = first.max(invert(2 * minor.0 - 1, length, rise) + 1);
        }
        if first <= last && minor.1 < rise {
            last = last.min(invert(2 * minor.1 + 1, length, rise));
        }
        Self { first, last, ..*self }
    }

    /// The number of minor steps that the line has made at a major step, k(i), and the remainder of its division. The length
    /// must not be 0.
    #[inline(never)] // only clipped lines call it: code size counts
    pub(crate) fn aside(&self, step: i32) -> (i32, i32) {
        // k = ⌈(2mi − L)/2L⌉ = ⌊(2mi + L − 1)/2L⌋ ≤ m < 2¹⁶. Halved, the numerator has 32 bits, and the remainder of L − 1 goes to r.
        let (rise, length) = (self.rise.unsigned_abs(), self.length.unsigned_abs());
        let (k, r) = divide_word(rise * step.unsigned_abs() + ((length - 1) >> 1), length);
        (k as i32, (2 * r + ((length - 1) & 1)) as i32)
    }
}

/// `⌊odd·L / 2m⌋`, at most 2²⁰: the caller does not distinguish results beyond L.
#[inline(never)] // only clipped lines call it: code size counts
fn invert(odd: i32, length: i32, rise: i32) -> i32 {
    // ⌊(odd − 1)/2⌋·L + ⌊L/2⌋ has 32 bits, as both factors have 16; the quotient may pass `length`.
    let [odd, length, rise] = [odd, length, rise].map(i32::unsigned_abs);
    let (quotient, _) = divide_word((odd >> 1) * length + (length >> 1), rise);
    quotient.min(1 << 20) as i32
}

/// The spans of a line inside a scissor, from its smaller end on: one per run of pixels along the major axis.
pub(crate) struct LineSpans {
    /// The smaller end, in pixels.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// Whether the major axis is y, and whether y decreases along the line.
    pub(crate) tall: bool,
    pub(crate) up: bool,
    /// The next step along the major axis, and the last one.
    pub(crate) step: i32,
    pub(crate) last: i32,
    /// The minor steps made so far.
    pub(crate) minor_step: i32,
    /// Bresenham's error term `2·m·(i + 1) − L − 2·L·k` after i major and k minor steps of a line of extents L and m: positive if
    /// the next pixel makes a minor step. A major step alone adds `along`, a major and a minor step add `aside`. All three are below
    /// 2¹⁸ in magnitude.
    pub(crate) error: i32,
    pub(crate) along: i32,
    pub(crate) aside: i32,
}

impl LineSpans {
    /// The spans of all pixels of a line, which [lies in](LineSetup::lies_in) the scissor.
    #[inline(always)]
    pub(crate) fn unclipped(&LineSetup { x, y, tall, up, length, rise, last, .. }: &LineSetup) -> Self {
        let (along, aside) = (2 * rise, 2 * (rise - length));
        Self { x, y, tall, up, step: 0, last, minor_step: 0, error: along - length, along, aside }
    }

    /// The spans of the part of a line that lies in the scissor.
    #[inline(never)]
    pub(crate) fn new(setup: &LineSetup, scissor: &Scissor) -> Self {
        let setup = setup.clipped(scissor);
        let mut spans = Self { step: setup.first, ..Self::unclipped(&setup) };
        if setup.first > 0 && setup.first <= setup.last {
            let (k, r) = setup.aside(setup.first);
            // 2m(i + 1) − L − 2Lk = r + 1 + 2m − 2L, with r < 2¹⁷.
            (spans.minor_step, spans.error) = (k, r + 1 + spans.aside);
        }
        spans
    }
}

impl Iterator for LineSpans {
    type Item = Span;

    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        let (first, last, along) = (self.step, self.last, self.along);
        if first > last {
            return None;
        }
        // The run ends before the next minor step.
        let (mut step, mut error) = (first, self.error);
        while error <= 0 && step < last {
            error += along;
            step += 1;
            keep_rolled(); // runs are short
        }
        let (count, minor_step) = (step - first + 1, self.minor_step);
        (self.step, self.minor_step, self.error) = (step + 1, minor_step + 1, error + self.aside);
        Some(if self.tall {
            let y = if self.up { self.y - step } else { self.y + first };
            Span { x: self.x + minor_step, y, width: 1, height: count }
        } else {
            let y = if self.up { self.y - minor_step } else { self.y + minor_step };
            Span { x: self.x + first, y, width: count, height: 1 }
        })
    }
}
