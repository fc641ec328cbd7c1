//! Errors on the screen by the hundred thousand.

use crate::number::decimal;

/// The largest error, and the error that one vertex in a thousand exceeds, in pixels.
#[derive(Clone, Copy, Default)]
pub(crate) struct Figures {
    pub(crate) largest: f64,
    pub(crate) nearly: f64,
}

impl Figures {
    pub(crate) fn of(errors: &mut [f32]) -> Self {
        if errors.is_empty() {
            return Self::default();
        }
        let n = errors.len();
        let (_, &mut nearly, above) = errors.select_nth_unstable_by(n - n / 1000 - 1, f32::total_cmp);
        let largest = above.iter().fold(nearly, |a, &b| a.max(b));
        Self { largest: largest.into(), nearly: nearly.into() }
    }

    /// Two cells of a table.
    pub(crate) fn cells(&self) -> String {
        format!("{} | {}", decimal(self.largest), decimal(self.nearly))
    }
}

/// Errors before and after the snap.
#[derive(Clone, Copy, Default)]
pub(crate) struct Pair {
    pub(crate) before: Figures,
    pub(crate) after: Figures,
}

/// Errors by class, in the order of [`sweep::CLASSES`](crate::sweep::CLASSES).
pub(crate) type Classes = [Pair; crate::sweep::CLASSES.len()];

/// The errors of a design.
#[derive(Clone, Default)]
pub(crate) struct Errors {
    pub(crate) classes: Classes,
}

impl Errors {
    /// The worst of all classes.
    pub(crate) fn worst(&self) -> Pair {
        let most = |f: fn(&Pair) -> f64| self.classes.iter().map(f).fold(0.0, f64::max);
        Pair {
            before: Figures { largest: most(|p| p.before.largest), nearly: most(|p| p.before.nearly) },
            after: Figures { largest: most(|p| p.after.largest), nearly: most(|p| p.after.nearly) },
        }
    }
}
