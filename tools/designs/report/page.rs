//! The page.

use crate::about::ALL;
use crate::edges::TURNS;
use crate::grouped::grouped;
use crate::number::decimal;
use crate::speed::CORES;
use crate::sweep::{CLASSES, COUNT};
use crate::{rule, Measured};
use std::fmt::Write;

/// The line that says what built the firmware.
const BUILT: &str = "Built with ";

/// Whether the page's figures are this compiler's.
pub(crate) fn is_of(page: &str, compiler: &str) -> bool {
    page.contains(&format!("{BUILT}{compiler}."))
}

/// Lines that are not the same, old and new.
pub(crate) fn differences(old: &str, new: &str) -> Vec<String> {
    let longest = old.lines().count().max(new.lines().count());
    let lines = |text: &str| {
        text.lines()
            .map(str::to_string)
            .chain(std::iter::repeat(String::new()))
            .take(longest)
            .collect::<Vec<_>>()
    };
    let (old, new) = (lines(old), lines(new));
    old.iter()
        .zip(&new)
        .filter(|(old, new)| old != new)
        .map(|(old, new)| format!("- {old}\n+ {new}"))
        .collect()
}

pub(crate) fn text(compiler: &str, measured: &[Measured]) -> String {
    let mut text = include_str!("page.md")
        .replace("{count}", &grouped(COUNT as u64))
        .replace("{turns}", &TURNS.to_string())
        .replace("{built}", &format!("{BUILT}{compiler}."))
        .replace("{table}", &table(measured))
        .replace("{classes}", &classes(measured))
        .replace("{designs}", &designs())
        .replace("{rule}", &verdict(measured))
        .replace("{floats}", &list(&rule::floats_ahead(measured)))
        .replace("{cheap}", &list(&rule::cheap_on_m0(measured)));
    // The table's lines, by name.
    for (number, about) in ALL.iter().enumerate() {
        text = text.replace(&format!("{{{}}}", about.id), &(number + 1).to_string());
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn table(measured: &[Measured]) -> String {
    let mut text = String::from("| | design |");
    for (core, _) in CORES {
        let _ = write!(text, " {core} |");
    }
    text.push_str(" max | 99.9 % | snapped | edges | far out |\n|--:|---|");
    text.push_str(&"--:|".repeat(CORES.len() + 5));
    for (number, one) in measured.iter().enumerate() {
        let _ = write!(text, "\n| {} | {} |", number + 1, one.about.name);
        for speed in one.speed {
            let _ = write!(text, " {} |", grouped(speed.round() as u64));
        }
        let worst = one.errors.worst();
        let [near, far] = one.edges.shift;
        let _ = write!(
            text,
            " {} | {} | {} | {} |",
            worst.before.cells(),
            decimal(worst.after.largest),
            decimal(near),
            decimal(far)
        );
    }
    text
}

fn classes(measured: &[Measured]) -> String {
    let mut text = String::from("| | design |");
    for class in &CLASSES {
        let _ = write!(text, " {} max | 99.9 % |", class.population.name);
    }
    text.push_str("\n|--:|---|");
    text.push_str(&"--:|".repeat(2 * CLASSES.len()));
    for (number, one) in measured.iter().enumerate() {
        let _ = write!(text, "\n| {} | {} |", number + 1, one.about.name);
        for class in one.errors.classes {
            let _ = write!(text, " {} |", class.before.cells());
        }
    }
    text
}

fn designs() -> String {
    let lines = ALL
        .iter()
        .enumerate()
        .map(|(number, about)| format!("{}. {}. {}", number + 1, about.name, about.what));
    lines.collect::<Vec<_>>().join("\n")
}

fn verdict(measured: &[Measured]) -> String {
    match rule::broken(measured)[..] {
        [] => "It holds.".to_string(),
        ref broken => format!("It does **not** hold yet:\n\n{}", list(broken)),
    }
}

fn list(items: &[String]) -> String {
    items.iter().map(|item| format!("* {item}")).collect::<Vec<_>>().join("\n")
}
