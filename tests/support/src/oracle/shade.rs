//! The channels of colours, mixed levels, and Bayer's pattern from its recursion.

/// The channels of a target: the highest level of each, one for greys.
#[derive(Clone, Copy, Debug)]
pub struct Depths(pub &'static [i128]);

/// Red, green and blue of 0 … 255 at a light of 0 … 256.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    pub rgb: [u8; 3],
    pub level: u16,
}

/// Two levels, mixed in 1/32 parts to nearest.
pub fn mixed(own: u8, other: u8, parts: u8) -> u8 {
    let [own, other, parts] = [own, other, parts].map(u32::from);
    ((own * parts + other * (32 - parts) + 16) / 32) as u8
}

/// Half of two levels, the own one rounded up.
pub fn halved(own: u8, other: u8) -> u8 {
    own.div_ceil(2) + other / 2
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
