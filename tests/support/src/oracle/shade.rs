//! Colours in exact fractions: the level of a channel at the centre of a pixel, and Bayer's pattern from its recursion.

use super::coverage::{edge, P};

/// The channels of a target: the highest level of each, one for greys.
#[derive(Clone, Copy, Debug)]
pub struct Depths(pub &'static [i128]);

/// A number of levels, as numerator and positive denominator.
pub type Fraction = (i128, i128);

/// Red, green and blue of 0 … 255 at a light of 0 … 256.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    pub rgb: [u8; 3],
    pub level: u16,
}

/// The common denominator of all levels.
const UNIT: i128 = 255 * 256 * 256;

impl Depths {
    /// Levels of each channel; the luma of Rec. 601 with weights 77, 150 and 29 of 256.
    pub fn levels(&self, colour: Lit) -> Vec<Fraction> {
        let [r, g, b] = colour.rgb.map(|c| i128::from(c) * i128::from(colour.level));
        match *self.0 {
            [max] => vec![(max * (77 * r + 150 * g + 29 * b), UNIT)],
            _ => self.0.iter().zip([r, g, b]).map(|(max, v)| (max * 256 * v, UNIT)).collect(),
        }
    }

    /// Levels of each channel at a point of a triangle in sub-pixels: the corners' levels weighted by areas.
    pub fn over(&self, t: [P; 3], colours: [Lit; 3], p: P) -> Vec<Fraction> {
        let [a, b, c] = t;
        let whole = i128::from(edge(a, b, c));
        let weights = [edge(p, b, c), edge(a, p, c), edge(a, b, p)].map(|w| i128::from(w) * whole.signum());
        let corners = colours.map(|colour| self.levels(colour));
        (0..self.0.len())
            .map(|channel| {
                let sum = weights.iter().zip(&corners).map(|(w, levels)| w * levels[channel].0).sum();
                (sum, UNIT * whole.abs())
            })
            .collect()
    }
}

/// `|level − exact|`, as a real: exact but for the last division.
pub fn distance(level: i128, (n, d): Fraction) -> f64 {
    (level * d - n).abs() as f64 / d as f64
}

/// The ranks 0 … n² − 1 of a pattern of n × n places, row by row: Bayer's recursion,
/// `D(2n) = [4·D(n) + 0, 4·D(n) + 2; 4·D(n) + 3, 4·D(n) + 1]`.
pub fn bayer(n: usize) -> Vec<Vec<i128>> {
    if n == 1 {
        return vec![vec![0]];
    }
    let quarter = bayer(n / 2);
    let quarters = [[0, 2], [3, 1]];
    let rank =
        |x: usize, y: usize| 4 * quarter[y % (n / 2)][x % (n / 2)] + quarters[y / (n / 2)][x / (n / 2)];
    (0..n).map(|y| (0..n).map(|x| rank(x, y)).collect()).collect()
}

/// The level that a pixel takes: `⌊exact + (2·rank + 1)/128⌋`, where `exact` may be off by `slack`.
pub fn dithered((n, d): Fraction, rank: i128, slack: Fraction) -> core::ops::RangeInclusive<i128> {
    // Over 128·d·slack.1.
    let sum = (128 * n + (2 * rank + 1) * d) * slack.1;
    let (whole, slack) = (128 * d * slack.1, 128 * d * slack.0);
    (sum - slack).div_euclid(whole)..=(sum + slack).div_euclid(whole)
}
