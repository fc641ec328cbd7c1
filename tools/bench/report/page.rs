//! What the pages have in common: how numbers read, and whether an older page says the same.

/// Between the digits of large numbers: a space that does not break.
const THIN: char = '\u{a0}';
/// The line that says what built the firmware.
pub(crate) const BUILT: &str = "Built with ";

/// 1234567 as 1 234 567.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(THIN);
        }
        text.push(digit);
    }
    text
}

/// What a number of bytes may differ by where 2 % are less: little functions come and go.
const BYTES: f64 = 64.0;

/// The same words, and numbers within 2 %.
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
    let number = |word: &str| word.replace(THIN, "").parse::<f64>().ok();
    old.len() == new.len()
        && old.iter().zip(&new).all(|(old, new)| match (number(old), number(new)) {
            (Some(o), Some(n)) => {
                let whole = !old.contains('.');
                (n - o).abs() <= (0.02 * o.abs()).max(if whole { BYTES } else { 0.0 })
            }
            _ => old == new,
        })
}
