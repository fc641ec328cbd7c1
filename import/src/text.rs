//! Text out of the bytes of a file.

use crate::Problem;
use std::borrow::Cow;

/// Whether the bytes are text in UTF-16, by the mark at their beginning.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// The text of UTF-8 or, with a mark, of UTF-16, without the mark, and without the zeros or Ctrl-Z that some programs write behind
/// the end; where nothing but carriage returns ends lines, as on old Macs, they end as elsewhere.
pub(crate) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes).into(),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes).into(),
        [0xef, 0xbb, 0xbf, rest @ ..] | rest => String::from_utf8_lossy(without_end(rest)),
    };
    if text.contains('\r') && !text.contains('\n') {
        text.replace('\r', "\n").into()
    } else {
        text
    }
}

/// The bytes of a text without zeros and Ctrl-Z at the end; all of them, if there is nothing else.
pub(crate) fn without_end(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|byte| !b"\0\x1a".contains(byte));
    bytes.get(..end.map_or(bytes.len(), |last| last + 1)).unwrap_or_default()
}

/// A decimal number: as [`str::parse`] reads it where it has at most 19 digits and an exponent from −19 to 19, otherwise nearly. That reads
/// all of them exactly by 16 KB of code and tables, which the planner's page would load. A word for what is not finite is NaN.
pub fn number(text: &str) -> Option<f64> {
    const MOST: u64 = 10_u64.pow(18);
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    if ["inf", "infinity", "nan"].iter().any(|word| unsigned.eq_ignore_ascii_case(word)) {
        return Some(f64::NAN);
    }
    let (digits, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let mut exponent: i32 = exponent.parse().ok()?;
    let (mut mantissa, mut is_fraction, mut has_digit) = (0, false, false);
    for byte in digits.bytes() {
        match byte {
            b'0'..=b'9' => {
                has_digit = true;
                // Digits beyond 19 are left out.
                let is_kept = mantissa < MOST;
                mantissa = if is_kept { 10 * mantissa + u64::from(byte - b'0') } else { mantissa };
                exponent = exponent.saturating_add(i32::from(!is_kept) - i32::from(is_fraction));
            }
            b'.' if !is_fraction => is_fraction = true,
            _ => return None,
        }
    }
    let shift = mantissa.leading_zeros();
    let power = 10_u64.checked_pow(exponent.unsigned_abs()).map(u128::from);
    let number = match power {
        _ if mantissa == 0 => 0.0,
        Some(power) if exponent >= 0 => (u128::from(mantissa) * power) as f64,
        // A quotient of 63 bits at least, whose last one says that there is more.
        Some(power) => {
            let dividend = u128::from(mantissa << shift) << 64;
            let quotient = (dividend / power) | u128::from(dividend % power != 0);
            quotient as f64 * 0.5_f64.powi(64 + shift as i32)
        }
        None => mantissa as f64 * 10_f64.powi(exponent),
    };
    has_digit.then_some(if text.starts_with('-') { -number } else { number })
}

/// A line of numbers or indices without its comment, and without spaces around it.
pub(crate) fn before_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).filter_map(|pair| pair.first_chunk().copied().map(unit));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// The problem of a vertex whose coordinates are not three numbers. `found` is the text in their place: a comma is named, as
/// programs in some languages write it before the fraction, and spreadsheets between numbers.
pub(crate) fn a_vertex_needs_numbers(found: &str) -> Problem {
    Problem::Syntax(match found.contains(',') {
        true => "a vertex needs three numbers such as `1.5 0 2`, without commas: replace them, or export the model again",
        false => "a vertex needs three numbers",
    })
}

#[cfg(test)]
mod tests {
    use super::number;
    use support::oracle::rng::Rng;

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let mut rng = Rng::new(1);
        let mut below = |most: u64| rng.next() % most;
        for _ in 0..100_000 {
            let digits = below(10_u64.pow(9)) * 10_u64.pow(9) + below(10_u64.pow(9));
            let digits = (digits / 10_u64.pow(below(18) as u32)).to_string();
            let (whole, fraction) = digits.split_at(below(digits.len() as u64 + 1) as usize);
            let sign = ["", "-", "+"][below(3) as usize];
            let exponent = below(20 - fraction.len() as u64) as i64 * [1, -1][below(2) as usize];
            for text in [format!("{sign}{whole}.{fraction}"), format!("{sign}{whole}.{fraction}e{exponent}")]
            {
                let expected = text.parse::<f64>().ok();
                assert_eq!(number(&text).map(f64::to_bits), expected.map(f64::to_bits), "{text}");
            }
        }
        for text in ["", ".", "-", "e5", "1e", "1.2.3", "1,5", "0x1", "1e5.0", " 1", "--1", "1_0"] {
            assert_eq!((number(text), text.parse::<f64>().ok()), (None, None), "{text}");
        }
        let long = ["123456789012345678901234567890", "0.1234567890123456789012345"];
        for text in ["1e25", "1.5E-30", "7e-300", "0e999"].into_iter().chain(long) {
            let (found, expected) =
                (number(text).unwrap_or(f64::NAN), text.parse::<f64>().unwrap_or_default());
            assert!((found - expected).abs() <= expected * 1e-14, "{text}: {found}");
        }
        assert_eq!(number("1e400"), Some(f64::INFINITY));
        assert!(["nan", "-Inf", "+infinity"].iter().all(|text| number(text).is_some_and(|c| !c.is_finite())));
    }
}
