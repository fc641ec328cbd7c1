//! The texture coordinates that a pixel of a face shows, in f64, by one ray per pixel: no clipping and no interpolation in it.

use super::chain::{cross, dot, Affine, Camera, V3};

/// A face and the texture coordinates of its corners, as a camera sees them.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// The corners as x·w, y·w and w, with x and y in pixels.
    corners: [V3; 3],
    /// The texture coordinates of the corners, in texels.
    uv: [[f64; 2]; 3],
}

/// The least and the largest value near a pixel's centre.
pub type Range = (f64, f64);

impl Ray {
    /// From corners in model space, and their coordinates in texels.
    pub fn new(camera: &Camera, model: &Affine, corners: [V3; 3], uv: [[f64; 2]; 3]) -> Self {
        Self { corners: corners.map(|at| camera.homogeneous_screen(camera.clip(model, at))), uv }
    }

    /// u and v in texels of the point on the ray through a point of the screen; `None` where the ray meets the face's plane
    /// behind the eye, or so nearly along the plane that f64 cannot tell.
    pub fn at(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        // The corners' weights in space: Σ weight · corner is a multiple of (x, y, 1).
        let ([a, b, c], p) = (self.corners, [x, y, 1.0]);
        let volume = |a, b, c| dot(a, cross(b, c));
        let weights = [volume(p, b, c), volume(a, p, c), volume(a, b, p)];
        let (sum, size) = (weights.iter().sum::<f64>(), weights.iter().map(|w| w.abs()).sum::<f64>());
        // w at the point is the volume of all three over this sum.
        let ahead = sum.signum() == volume(a, b, c).signum() && sum.abs() > 1e-9 * size;
        ahead.then(|| [0, 1].map(|axis| (0..3).map(|i| weights[i] * self.uv[i][axis]).sum::<f64>() / sum))
    }

    /// By how many texels u or v changes from a pixel to the next, to the right or down, whichever is most.
    pub fn covered(&self, x: i64, y: i64) -> Option<f64> {
        let (x, y, h) = (x as f64 + 0.5, y as f64 + 0.5, 1.0 / 64.0);
        let mut most = 0.0f64;
        for (dx, dy) in [(h, 0.0), (0.0, h)] {
            let (before, after) = (self.at(x - dx, y - dy)?, self.at(x + dx, y + dy)?);
            most = (0..2).map(|axis| (after[axis] - before[axis]).abs() / (2.0 * h)).fold(most, f64::max);
        }
        Some(most)
    }

    /// The mean of a picture that repeats, over `n` × `n` points of a pixel.
    pub fn mean(&self, x: i64, y: i64, n: u32, picture: &dyn Fn([i64; 2]) -> f64) -> Option<f64> {
        let mut sum = 0.0;
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            let [dx, dy] = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(n));
            sum += picture(self.at(x as f64 + dx, y as f64 + dy)?.map(|c| c.floor() as i64));
        }
        Some(sum / f64::from(n * n))
    }

    /// The ranges of u and of v of points within 1/64 pixel, in x and in y, of a pixel's centre.
    pub fn around(&self, x: i64, y: i64) -> Option<[Range; 2]> {
        let (x, y) = (x as f64 + 0.5, y as f64 + 0.5);
        let mut ranges = [(f64::MAX, f64::MIN); 2];
        for (dx, dy) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            for (range, value) in ranges.iter_mut().zip(self.at(x + dx / 64.0, y + dy / 64.0)?) {
                *range = (range.0.min(value), range.1.max(value));
            }
        }
        Some(ranges)
    }
}

/// How far a coordinate is outside of a range, where the picture repeats after `side`.
pub fn off_repeated(shown: f64, (low, high): Range, side: f64) -> f64 {
    let middle = (low + high) / 2.0;
    ((shown - middle + side / 2.0).rem_euclid(side) - side / 2.0).abs() - (high - low) / 2.0
}

/// How far a coordinate is outside of a range, where the edge of a picture from 0 to `side` continues.
pub fn off_clamped(shown: f64, (low, high): Range, side: f64) -> f64 {
    (low.clamp(0.0, side) - shown).max(shown - high.clamp(0.0, side))
}

/// The mean of a picture that repeats, over rows `rows` and over 2ⁿ columns about the centre of one: both of its halves count alike.
pub fn mean_about(column: i64, rows: std::ops::Range<i64>, n: u32, picture: &dyn Fn([i64; 2]) -> f64) -> f64 {
    let (half_columns, rows) =
        (2 * column + 1 - (1 << n)..2 * column + 1 + (1 << n), rows.collect::<Vec<_>>());
    let count = rows.len() as f64 * 2.0 * f64::from(1 << n);
    half_columns
        .map(|half| rows.iter().map(|&row| picture([half.div_euclid(2), row])).sum::<f64>())
        .sum::<f64>()
        / count
}

/// A picture at a point in texels, mixed of the four whose centres are around it.
pub fn bilinear([u, v]: [f64; 2], picture: &dyn Fn([i64; 2]) -> f64) -> f64 {
    let ([left, above], [right, below]) =
        ([u, v].map(|c| (c - 0.5).floor()), [u, v].map(|c| (c - 0.5).rem_euclid(1.0)));
    let row = |y: f64| {
        let [first, second] = [left, left + 1.0].map(|x| picture([x as i64, y as i64]));
        first * (1.0 - right) + second * right
    };
    row(above) * (1.0 - below) + row(above + 1.0) * below
}
