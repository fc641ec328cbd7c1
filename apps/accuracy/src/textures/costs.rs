//! What the methods cost, as `tools/bench/run cells X1 X2 X3 X4 plain eighth sixteenth each every16 M3` prints it.

use super::methods::METHODS;

/// Scene, and instructions of a frame on an M3, in the order of [`METHODS`].
const FRAMES: [(&str, [u32; METHODS.len()]); 4] = [
    ("X1", [672_958, 671_983, 1_161_000, 2_335_533, 1_809_783]),
    ("X2", [489_247, 489_242, 489_242, 4_097_027, 1_279_449]),
    ("X3", [656_651, 774_991, 938_450, 1_715_339, 616_005]),
    ("X4", [971_724, 1_092_838, 1_256_582, 2_156_171, 755_821]),
];

/// Instructions for each pixel that a method, given by its index in [`METHODS`], draws of a scene.
pub(crate) fn per_pixel(cell: &str, method: usize, pixels: usize) -> Option<f64> {
    let (_, frames) = FRAMES.iter().find(|(known, _)| *known == cell)?;
    Some(f64::from(*frames.get(method)?) / pixels as f64)
}
