//! Levels of colours in exact fractions, and Bayer's pattern from its recursion.

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
