//! How far a long computation is, on the terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar on standard error that counts steps, such as frames; where that is no terminal it shows nothing.
pub fn bar(steps: u32, unit: &str) -> ProgressBar {
    let template = format!("{{bar:40}} {{pos}}/{{len}} {unit}, {{eta}} left");
    let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(steps.into()).with_style(style)
}
