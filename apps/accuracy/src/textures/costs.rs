//! What the methods cost, as `tools/bench/run cells X1 X2 X3 X4 plain eighth sixteenth each every16 M3` prints it.

use super::methods::METHODS;

/// Scene, and instructions of a frame on an M3, in the order of [`METHODS`].
const FRAMES: [(&str, [u32; METHODS.len()]); 4] = [
    ("X1", [807_466, 804_293, 1_335_118, 2_335_533, 1_809_783]),
    ("X2", [738_846, 738_712, 738_710, 4_097_027, 1_279_449]),
    ("X3", [801_064, 942_471, 1_145_305, 1_715_339, 616_005]),
    ("X4", [1_090_377, 1_223_509, 1_388_392, 2_156_171, 755_821]),
];

/// Instructions for each of the pixels that a method, by its place in [`METHODS`], draws of a scene.
pub(crate) fn per_pixel(cell: &str, method: usize, pixels: usize) -> Option<f64> {
    let (_, frames) = FRAMES.iter().find(|(known, _)| *known == cell)?;
    Some(f64::from(*frames.get(method)?) / pixels as f64)
}
