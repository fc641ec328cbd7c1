//! JSON for the page.

use std::fmt::Write;

/// A text in quotation marks, with special characters escaped.
pub(crate) fn text(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if u32::from(c) < 32 => _ = write!(out, "\\u{:04x}", u32::from(c)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A list.
pub(crate) fn list(items: impl IntoIterator<Item = String>) -> String {
    enclosed('[', &items.into_iter().collect::<Vec<_>>(), ']')
}

/// An object of names and values.
pub(crate) fn object(members: &[(&str, String)]) -> String {
    object_of_numbers(members, &[])
}

/// An object of names and values, and of names and numbers, which are rounded to hundredths.
pub(crate) fn object_of_numbers(members: &[(&str, String)], numbers: &[(&str, f64)]) -> String {
    let mut parts = Vec::new();
    for (name, value) in members {
        parts.push([&text(name), ":", value].concat());
    }
    for &(name, value) in numbers {
        parts.push([&text(name), ":", &number(value)].concat());
    }
    enclosed('{', &parts, '}')
}

/// A number, rounded to hundredths.
pub(crate) fn number(number: f64) -> String {
    ((number * 100.0).round() / 100.0).to_string()
}

/// Items between marks, with commas.
fn enclosed(start: char, items: &[String], end: char) -> String {
    let mut out = String::from(start);
    out += &items.join(",");
    out.push(end);
    out
}

#[cfg(test)]
mod tests {
    #[test]
    fn marks_are_escaped() {
        assert_eq!(super::text("a \"b\" \\ \n"), "\"a \\\"b\\\" \\\\ \\u000a\"");
        assert_eq!(super::object(&[("a", super::list(["1".into(), "2".into()]))]), "{\"a\":[1,2]}");
    }
}
