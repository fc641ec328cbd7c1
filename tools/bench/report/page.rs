//! Code that the pages share: the line about the compiler, and the comparison with an older page.

use crate::grouped::SPACE;

/// The line that says what built the firmware.
pub(crate) const BUILT: &str = "Built with ";

/// The difference allowed for a number of bytes where 2 % are less: small functions come and go.
const BYTES: f64 = 64.0;

/// Fails for each line of the new page whose words differ from the old page, or a number by more than 2 %.
pub(crate) fn compare(page: &str, old: &str, new: &str, compiler: &str, failures: &mut Vec<String>) {
    if !old.contains(&format!("{BUILT}{compiler}.")) {
        eprintln!("{page} is another compiler's: nothing is compared with it.");
        return;
    }
    if old.lines().count() != new.lines().count() {
        failures.push(format!("{}: not current, it has other lines: tools/bench/run", page));
        return;
    }
    for (old, new) in old.lines().zip(new.lines()) {
        if !alike(old, new) {
            failures.push(format!("{}: not current:\n  is   {old}\n  now  {new}", page));
        }
    }
}

fn alike(old: &str, new: &str) -> bool {
    let words = |line: &str| -> Vec<String> { line.split(' ').map(str::to_string).collect() };
    let (old, new) = (words(old), words(new));
    let number = |word: &str| word.replace(SPACE, "").parse::<f64>().ok();
    old.len() == new.len()
        && old.iter().zip(&new).all(|(old, new)| match (number(old), number(new)) {
            (Some(o), Some(n)) => {
                let whole = !old.contains('.');
                (n - o).abs() <= (0.02 * o.abs()).max(if whole { BYTES } else { 0.0 })
            }
            _ => old == new,
        })
}
