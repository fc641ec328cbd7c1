//! Statistics of millions of errors, and their format.

/// The figures of one cell of a table.
#[derive(Clone, Default)]
pub(crate) struct Errors {
    all: Vec<f32>,
    squares: f64,
}

impl Errors {
    pub(crate) fn add(&mut self, error: f64) {
        self.all.push(error as f32);
        self.squares += error * error;
    }

    pub(crate) fn count(&self) -> usize {
        self.all.len()
    }

    pub(crate) fn append(&mut self, other: Self) {
        self.all.extend(other.all);
        self.squares += other.squares;
    }

    pub(crate) fn largest(&self) -> f64 {
        self.all.iter().fold(0f32, |a, &b| a.max(b)).into()
    }

    /// The maximum, the 99.9th percentile and the root mean square: three cells of three digits each. There must be at least
    /// one error.
    pub(crate) fn cells(&mut self) -> String {
        let n = self.all.len();
        let (_, nearly, above) = self.all.select_nth_unstable_by(n - n / 1000 - 1, f32::total_cmp);
        let nearly = *nearly;
        let largest = above.iter().fold(nearly, |a, &b| a.max(b));
        let mean = (self.squares / n as f64).sqrt();
        format!("{} | {} | {}", decimal(largest.into()), decimal(nearly.into()), decimal(mean))
    }
}

/// Formats a number as three digits and a power of ten.
pub(crate) fn decimal(v: f64) -> String {
    let text = format!("{v:.2e}");
    match text.split_once('e') {
        Some((digits, "0")) => digits.to_string(),
        Some((digits, power)) => format!("{digits}·10{}", raised(power)),
        None => text,
    }
}

/// Formats a number as a power of two, its exponent rounded up to a tenth; 0 stays 0.
pub(crate) fn binary(v: f64) -> String {
    if v == 0.0 {
        return "0".to_string();
    }
    let tenths = (v.log2() * 10.0 - 1e-6).ceil() / 10.0;
    let text = format!("{tenths:.1}");
    format!("2{}", raised(text.trim_end_matches(".0")))
}

fn raised(text: &str) -> String {
    let sign = |c: char| match c {
        '-' => '⁻',
        '.' => '·',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        other => other,
    };
    text.chars().map(sign).collect()
}
