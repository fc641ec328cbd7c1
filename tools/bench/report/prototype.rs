//! The figures of the prototype by which the targets were set: a throw-away program that fills triangles as exactly, but
//! has no near plane, does not test which vertices must be clipped, and knows the picture's width at compile time.
//! They were measured when the targets were set.

use crate::stages::Stage;

/// Instructions for one thing of a stage: from, to.
pub(crate) type Noted = (f64, f64);

/// The noted figures. With depth, *sides* includes *planes*.
pub(crate) fn prototype(stage: Stage, scene: &str, variant: &str, core: &str) -> Option<Noted> {
    let mesh = matches!(scene, "S1" | "S2" | "S3" | "S4" | "S8");
    let flat = scene != "S8"; // of smooth colours nothing was noted
    let just = |instructions| Some((instructions, instructions));
    match (core, stage, variant) {
        ("M3", Stage::Vertices, _) => just(56.0),
        ("M3", Stage::Faces, _) if mesh => just(32.0),
        ("M3", Stage::PassingOn, _) if mesh && flat => just(18.0),
        ("M3", Stage::Sides, "z") if flat => just(318.0),
        ("M3", Stage::Sides, "plain") if scene != "S1" => Some((205.0, 236.0)),
        ("M3", Stage::Rows, "z") if flat => just(25.0),
        ("M3", Stage::Rows, "plain") => just(16.0),
        ("M3", Stage::Pixels, "z") if flat => Some((10.0, 11.0)),
        ("M3", Stage::Pixels, "plain") => just(0.5),
        ("M3", Stage::Clears, _) => just(22_600.0),
        ("M3", Stage::Lines, _) => just(50.0),
        ("M3", Stage::LinePixels, _) => just(5.4),
        ("M0", Stage::Vertices, _) => just(186.0),
        ("M0", Stage::Pixels, "z") if flat => just(13.0),
        ("M0", Stage::Clears, _) => just(38_000.0),
        ("M0", Stage::LinePixels, _) => just(13.0),
        _ => None,
    }
}
