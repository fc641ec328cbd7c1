//! Checks that the drawn scenes are the ones for which the targets were set.

use bench::{cells, scene, tally};

/// Whether these are the scenes that `scenes.json` speaks of: as many faces to the front, and pixels that they cover. Its
/// vertices are not rounded to 16 bits, so a face on the edge may turn over, and a few pixels with it: 0.2 %.
pub(crate) fn compare_models(failures: &mut Vec<String>) {
    for (name, model) in [("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)] {
        let covered = tally::covered(model).unwrap_or_default();
        for (have, want) in covered.into_iter().zip(model.reference) {
            if have.abs_diff(want) * 500 > want {
                failures
                    .push(format!("{name}: {have} front faces or pixels covered, but {want} in scenes.json"));
            }
        }
    }
}

/// The pixels that S1, S5, S6 and S7 write, as counted when the targets were set.
const WRITTEN: [u32; 4] = [973, 57_600, 53_274, 97_947];

/// Whether these are the scenes that the targets speak of. In S1 a corner rounded to 16 bits may move a line by a pixel.
pub(crate) fn compare_lists(failures: &mut Vec<String>) {
    let in_view = cells::f50_in_view();
    if in_view != Some(25) {
        failures.push(format!("F50: {in_view:?} cubes in view, where half of them should be"));
    }
    let written = tally::written().unwrap_or_default();
    for (have, want) in written.into_iter().zip(WRITTEN) {
        if have.abs_diff(want) * 100 > want {
            failures
                .push(format!("S1, S5, S6 or S7: {have} pixels written, where the targets are for {want}"));
        }
    }
}
