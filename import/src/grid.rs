//! The grid onto which a model is rounded.

use crate::{Centre, Options, Problem, Remedy};

pub(crate) struct Grid {
    /// The longest side of the bounding box.
    pub(crate) extent: f64,
    /// The point that becomes the origin: it is subtracted from every vertex.
    pub(crate) centre: [f64; 3],
    pub(crate) exponent: i8,
    /// `2^exponent`.
    step: f64,
    /// The option that gives a finer grid, if one does.
    pub(crate) finer: Option<Remedy>,
    /// Whether the grid is that of the file's origin, so that parts with other centres lie on it, too: the centre is a grid point.
    is_common: bool,
}

impl Grid {
    /// The finest power-of-two grid that holds all positions within ±32767 ([`quantise`](crate::quantise)), or that of the step
    /// that the options give.
    pub(crate) fn around(positions: &[[f64; 3]], options: &Options) -> Result<Grid, Problem> {
        let (low, high) = bounds(positions);
        let extent = extent(positions);
        if extent == 0.0 {
            return Err(Problem::NoFaces);
        }
        let mut middle = match options.centre {
            Centre::Box => [0, 1, 2].map(|axis| low[axis] / 2.0 + high[axis] / 2.0),
            Centre::Origin => [0.0; 3],
        };
        // The steps of an `I16F16`, where that holds the centre.
        let of_fixed = (extent >= 1.0 / 64.0 && middle.iter().all(|c| c.abs() < 32767.0)).then_some(-16);
        let given = options.exponent();
        if let Some(step) = of_fixed.max(given).map(power_of_two) {
            middle = middle.map(|c| (c / step).round() * step + 0.0); // no -0
        }
        let half =
            (0..3).map(|axis| (high[axis] - middle[axis]).max(middle[axis] - low[axis])).fold(0.0, f64::max);
        let exponent = finest(half).filter(|&e| e > i8::MIN).ok_or(Problem::Extent(extent))?;
        if given.is_some_and(|given| given < exponent) {
            return Err(Problem::Step(exponent));
        }
        let finer = match given {
            Some(given) if given > exponent => Some(Remedy::Step(exponent)),
            _ if options.centre == Centre::Origin && finest(extent / 2.0) < Some(exponent) => {
                Some(Remedy::CentreBox)
            }
            _ => None,
        };
        let exponent = given.unwrap_or(exponent);
        let is_common = given.is_some();
        Ok(Grid { extent, centre: middle, exponent, step: power_of_two(exponent), finer, is_common })
    }

    /// The nearest grid points. Every difference fits ±32767 by the choice of the exponent.
    pub(crate) fn round(&self, positions: &[[f64; 3]]) -> Vec<[i16; 3]> {
        let round = |position: &[f64; 3]| match self.is_common {
            // Half steps go up, wherever the centre is, and nothing but a sum is rounded.
            true => [0, 1, 2].map(|axis| {
                ((position[axis] / self.step + 0.5).floor() - self.centre[axis] / self.step) as i16
            }),
            false => self.in_steps(position).map(|c| c.round() as i16),
        };
        positions.iter().map(round).collect()
    }

    /// A position in steps from the centre.
    pub(crate) fn in_steps(&self, position: &[f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| (position[axis] - self.centre[axis]) / self.step)
    }

    /// The position of a grid point.
    pub(crate) fn position(&self, rounded: &[i16; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| f64::from(rounded[axis]) * self.step + self.centre[axis])
    }

    /// The largest distance along an axis between a position and its grid point.
    pub(crate) fn error(&self, position: &[f64; 3], rounded: &[i16; 3]) -> f64 {
        (0..3)
            .map(|axis| position[axis] - self.centre[axis] - f64::from(rounded[axis]) * self.step)
            .fold(0.0, |largest, e| e.abs().max(largest))
    }
}

/// The least exponent of steps of which a length takes 32767 at most.
#[inline(never)] // the page of the planner loads this code
fn finest(length: f64) -> Option<i8> {
    (i8::MIN..=i8::MAX).find(|&e| (length / power_of_two(e)).round() <= 32767.0)
}

/// The corners of the bounding box.
fn bounds(positions: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for p in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    (low, high)
}

/// The longest side of the bounding box; 0 where there is none.
pub(crate) fn extent(positions: &[[f64; 3]]) -> f64 {
    let (low, high) = bounds(positions);
    (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max)
}

/// `2^exponent`, exactly.
pub(crate) fn power_of_two(exponent: i8) -> f64 {
    2f64.powi(i32::from(exponent))
}
