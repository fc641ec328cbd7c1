//! How numbers are written.

/// Two digits: as a decimal fraction where that is short, else with a power of ten.
pub(crate) fn decimal(v: f64) -> String {
    if v == 0.0 {
        return "–".to_string();
    }
    let text = format!("{v:.1e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    match power.parse::<i32>().unwrap_or(0) {
        power @ ..=-3 => format!("{digits}·10⁻{}", raised(-power)),
        power @ -2..=-1 => format!("{v:.0$}", (1 - power) as usize),
        0 => digits.to_string(),
        _ => format!("{v:.0}"),
    }
}

fn raised(n: i32) -> String {
    n.to_string()
        .chars()
        .map(|c| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c as usize - '0' as usize])
        .collect()
}
