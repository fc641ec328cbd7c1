//! Bresenham's midpoint lines, run by run, with exact clipping.
//!
//! From the smaller end, the pixel after i major steps has made
//! `k(i) = ⌈(2·m·i − L) / (2·L)⌉` minor steps, with L the major and m the minor extent: that is
//! `i·m/L` rounded to nearest with ties down, the midpoint rule in closed form. Clipping inverts
//! it, so the error term can start at any pixel of the line. (Bresenham, *Algorithm for computer
//! control of a digital plotter*, 1965; Kuzmin, *Bresenham's line generation algorithm with
//! built-in clipping*, 1995.)

use super::{Pixel, Scissor, Span};
use crate::math::num::divide;

/// Walks the line from `a` to `b`, both included, inside the scissor: rules L1 to L3. Runs along
/// the major axis leave as one span each; a horizontal or vertical line is a single one.
///
/// One addition and one comparison a pixel; set-up has no division unless the line is clipped.
///
/// # Errors
///
/// The first error of `span`, which ends the walk.
///
/// ```
/// use pinhole::raster::{line, Pixel, Scissor, Span};
/// let scissor = Scissor::new(0, 0, 64, 64);
/// let mut runs = Vec::new();
/// line(Pixel { x: 0, y: 0 }, Pixel { x: 2, y: 1 }, &scissor, |run| -> Result<(), ()> {
///     runs.push((run.x, run.y, run.width));
///     Ok(())
/// })?;
/// assert_eq!(runs, [(0, 0, 2), (2, 1, 1)]); // the tie at x = 1 keeps the smaller step
/// # Ok::<(), ()>(())
/// ```
pub fn line<E>(
    a: Pixel,
    b: Pixel,
    scissor: &Scissor,
    mut span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    let (from, to) = if a <= b { (a, b) } else { (b, a) }; // Pixel orders by (x, y)
    let (x, y) = (i32::from(from.x), i32::from(from.y));
    let (dx, dy) = (i32::from(to.x) - x, i32::from(to.y) - y); // 0 ≤ dx < 2¹⁶, |dy| < 2¹⁶
    let columns = Steps::new(x, false, scissor.left, scissor.right);
    let rows = Steps::new(y, dy < 0, scissor.top, scissor.bottom);
    let tall = dy.abs() > dx;
    let (major, minor) = if tall { (rows, columns) } else { (columns, rows) };
    let (length, rise) = if tall { (dy.abs(), dx) } else { (dx, dy.abs()) };
    let Some(Walk { mut step, last, mut minor_step, mut error }) =
        Walk::clipped(length, rise, &major, &minor)
    else {
        return Ok(());
    };
    // The error term is 2·m·(i + 1) − L − 2·L·k: positive means that the next pixel steps aside.
    let (aside, along) = (2 * (rise - length), 2 * rise); // |·| < 2¹⁸
    loop {
        let first = step;
        // The run ends before the next step aside.
        while error <= 0 && step < last {
            error += along;
            step += 1;
        }
        let count = step - first + 1;
        let start = major.at(first).min(major.at(step));
        let across = minor.at(minor_step);
        span(if tall {
            Span { x: across, y: start, width: 1, height: count }
        } else {
            Span { x: start, y: across, width: count, height: 1 }
        })?;
        if step >= last {
            return Ok(());
        }
        error += aside;
        step += 1;
        minor_step += 1;
    }
}

/// Steps along one axis: where they start, which way they go, and which of them are inside.
#[derive(Clone, Copy)]
struct Steps {
    origin: i32,
    down: bool,
    /// Steps `first` to `last` lie in the scissor; |·| ≤ 2¹⁷.
    first: i32,
    last: i32,
}

impl Steps {
    fn new(origin: i32, down: bool, low: i32, high: i32) -> Self {
        let (first, last) =
            if down { (origin - (high - 1), origin - low) } else { (low - origin, high - 1 - origin) };
        Self { origin, down, first, last }
    }

    fn at(&self, step: i32) -> i32 {
        if self.down {
            self.origin - step
        } else {
            self.origin + step
        }
    }
}

/// The part of a line inside the scissor, with the error term at its first pixel.
struct Walk {
    step: i32,
    last: i32,
    minor_step: i32,
    error: i32,
}

impl Walk {
    /// `length` ≥ `rise` ≥ 0, both below 2¹⁶. `None` when no pixel is inside.
    fn clipped(length: i32, rise: i32, major: &Steps, minor: &Steps) -> Option<Self> {
        if minor.first > rise || minor.last < 0 {
            return None;
        }
        let mut step = major.first.max(0);
        let mut last = major.last.min(length);
        // k(i) ≥ K first holds for i = ⌊(2K − 1)·L / 2m⌋ + 1, and k(i) ≤ K last for
        // i = ⌊(2K + 1)·L / 2m⌋: here m > 0, since 0 < K ≤ m or 0 ≤ K < m.
        let invert = |odd: i32| {
            // odd·L < 2¹⁷ · 2¹⁶; the quotient may pass `length` but not 2³³.
            let product = u64::from(odd.unsigned_abs()) * u64::from(length.unsigned_abs());
            divide(product, 2 * rise.unsigned_abs()).0.min(1 << 20) as i32
        };
        if minor.first > 0 {
            step = step.max(invert(2 * minor.first - 1) + 1);
        }
        if minor.last < rise {
            last = last.min(invert(2 * minor.last + 1));
        }
        if step > last {
            return None;
        }
        if step == 0 {
            return Some(Self { step, last, minor_step: 0, error: 2 * rise - length });
        }
        // k = ⌈(2mi − L)/2L⌉ = ⌊(2mi + L − 1)/2L⌋ with a remainder r, and the error term is
        // 2m(i + 1) − L − 2Lk = r + 1 + 2m − 2L. Here length ≥ step > 0.
        let ahead = 2 * u64::from(rise.unsigned_abs()) * u64::from(step.unsigned_abs());
        let (k, r) = divide(ahead + u64::from(length.unsigned_abs()) - 1, 2 * length.unsigned_abs());
        // k ≤ m < 2¹⁶, r < 2¹⁷.
        Some(Self { step, last, minor_step: k as i32, error: r as i32 + 1 + 2 * (rise - length) })
    }
}
