//! Statistics of millions of errors.

/// The errors of one cell of a table.
#[derive(Clone, Default)]
pub(super) struct Errors {
    all: Vec<f32>,
    squares: f64,
}

impl Errors {
    pub(super) fn add(&mut self, error: f64) {
        self.all.push(error as f32);
        self.squares += error * error;
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    pub(super) fn append(&mut self, other: Self) {
        self.all.extend(other.all);
        self.squares += other.squares;
    }

    /// Puts the 99.9th percentile in its place, which [`Errors::figures`] needs.
    pub(super) fn sort(&mut self) {
        if let Some(place) = self.percentile() {
            self.all.select_nth_unstable_by(place, f32::total_cmp);
        }
    }

    fn percentile(&self) -> Option<usize> {
        (self.all.len() - self.all.len() / 1000).checked_sub(1)
    }

    pub(super) fn largest(&self) -> f64 {
        self.all.iter().fold(0f32, |a, &b| a.max(b)).into()
    }

    /// The maximum, the 99.9th percentile and the root mean square, of three digits each.
    pub(super) fn figures(&self) -> [f64; 3] {
        let nearly = self.percentile().and_then(|place| self.all.get(place)).copied().unwrap_or_default();
        let mean = (self.squares / self.all.len().max(1) as f64).sqrt();
        [self.largest(), nearly.into(), mean].map(rounded)
    }
}

/// A number of three digits.
pub(super) fn rounded(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}
