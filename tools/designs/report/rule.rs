//! What the tool asserts: no other integer design beats the default in both speed and error.

use crate::about::Family;
use crate::number::decimal;
use crate::speed::CORES;
use crate::Measured;

/// The largest errors of two designs must differ by more than this factor: two random samples of one design differ as much.
const SAME: f64 = 1.1;

/// How code is arranged alone moves a count by this much.
const FASTER: f64 = 0.95;

/// The class of objects that the camera sees whole.
const SEEN_WHOLE: usize = 3;

/// What the library promises for a vertex, and what the page says that 8-bit vertices would keep for these: pixels.
const PROMISE: f64 = 1.0 / 256.0;

/// The library with `i16` vertices.
pub(crate) fn default(measured: &[Measured]) -> &Measured {
    &measured[0]
}

/// Cores on which it takes clearly fewer instructions than the default, in the order of [`CORES`].
pub(crate) fn faster(one: &Measured, default: &Measured) -> Vec<usize> {
    (0..CORES.len()).filter(|&core| one.speed[core] < FASTER * default.speed[core]).collect()
}

pub(crate) fn broken(measured: &[Measured]) -> Vec<String> {
    let default = default(measured);
    let no_worse = |one: &Measured| {
        let (one, default) = (one.errors.worst(), default.errors.worst());
        one.before.largest <= SAME * default.before.largest
            && one.after.largest <= SAME * default.after.largest
    };
    let beats = |one: &&Measured| one.about.competes() && no_worse(one);
    let mut broken = Vec::new();
    for one in measured.iter().filter(beats) {
        for core in faster(one, default) {
            broken.push(format!(
                "{}: {} takes {:.0} instructions a vertex, the library {:.0}, with errors up to {} and {} px",
                CORES[core].0,
                one.about.name,
                one.speed[core],
                default.speed[core],
                decimal(one.errors.worst().before.largest),
                decimal(default.errors.worst().before.largest),
            ));
        }
    }
    for id in ["default", "i8-wide"] {
        let after = |one: &Measured| one.errors.classes[SEEN_WHOLE].after.largest;
        if !measured.iter().any(|one| one.about.id == id && after(one) <= PROMISE) {
            broken.push(format!("{id} is off by more than 1/256 px"));
        }
    }
    broken
}

/// Of designs in f32: where they are ahead, with figures.
pub(crate) fn floats_ahead(measured: &[Measured]) -> Vec<String> {
    let default = default(measured);
    let floats = measured.iter().filter(|one| one.about.family == Family::Float);
    floats
        .flat_map(|one| faster(one, default).into_iter().map(move |core| (one, core)))
        .map(|(one, core)| {
            format!(
                "{} on an {}: {:.0} instructions in place of {:.0}, errors up to {} px in place of {} before the snap, \
                 and {} in place of {} for an object that the camera sees whole",
                one.about.name,
                CORES[core].0,
                one.speed[core],
                default.speed[core],
                decimal(one.errors.worst().before.largest),
                decimal(default.errors.worst().before.largest),
                decimal(one.errors.classes[SEEN_WHOLE].before.largest),
                decimal(default.errors.classes[SEEN_WHOLE].before.largest),
            )
        })
        .collect()
}

/// An error that one may want to have: pixels.
const WORTH: f64 = 0.05;

/// Designs of fewer bits, with small errors, that are faster on an M0, with figures.
pub(crate) fn cheap_on_m0(measured: &[Measured]) -> Vec<String> {
    let default = default(measured);
    let m0 = 0;
    let error = |one: &Measured| one.errors.classes[SEEN_WHOLE].before.largest;
    let cheap = |one: &&Measured| {
        let narrow = matches!(one.about.family, Family::Short | Family::Scaled);
        narrow && one.speed[m0] < 0.9 * default.speed[m0] && error(one) <= WORTH
    };
    let sentence = |one: &Measured| {
        format!(
            "{}: {:.0} instructions in place of {:.0}; at most {} px off for an object that the camera sees whole ({} px with \
             the snap), {} px for any",
            one.about.name,
            one.speed[m0],
            default.speed[m0],
            decimal(error(one)),
            decimal(one.errors.classes[SEEN_WHOLE].after.largest),
            decimal(one.errors.worst().before.largest),
        )
    };
    measured.iter().filter(cheap).map(sentence).collect()
}
