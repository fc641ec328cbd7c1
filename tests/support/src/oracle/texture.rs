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
