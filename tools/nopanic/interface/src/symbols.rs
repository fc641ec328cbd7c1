//! Functions from demangled symbols, such as `<pinhole::Mesh<i16> as core::clone::Clone>::clone`.

use crate::Function;
use std::collections::BTreeSet;

/// The functions in nm's listing: an address, a letter and a name on each line.
pub(crate) fn functions(listing: &str) -> BTreeSet<Function> {
    let names = listing.lines().filter_map(|line| line.splitn(3, ' ').nth(2));
    names.flat_map(function).collect()
}

/// The function of a symbol; a method of a trait is a method of that trait for any type, too.
fn function(symbol: &str) -> Vec<Function> {
    let Some(inner) = symbol.strip_prefix('<') else { return vec![Function::Free(plain(symbol))] };
    let Some(end) = outside(inner, 1).find(|&(_, c, depth)| c == '>' && depth == 0).map(|(at, ..)| at) else {
        return Vec::new();
    };
    let (inner, rest) = (&inner[..end], &inner[end + 1..]);
    let name = plain(rest).trim_start_matches(':').to_string();
    let between = outside(inner, 0).find(|&(at, _, depth)| depth == 0 && inner[at..].starts_with(" as "));
    match between {
        None => vec![Function::Method { of: plain(inner), of_trait: None, name }],
        Some((at, ..)) => {
            let (of, of_trait) = (plain(&inner[..at]), plain(&inner[at + " as ".len()..]));
            let any = Function::Any { of_trait: of_trait.clone(), name: name.clone() };
            vec![Function::Method { of, of_trait: Some(of_trait), name }, any]
        }
    }
}

/// A path without its generic arguments.
fn plain(path: &str) -> String {
    let kept = outside(path, 0).filter(|&(_, c, depth)| depth == 0 && c != '>');
    kept.map(|(_, c, _)| c).collect::<String>().replace("::::", "::").trim_end_matches(':').to_string()
}

/// The characters with their places and how many `<` are open after each, counted from `open`.
fn outside(text: &str, open: usize) -> impl Iterator<Item = (usize, char, usize)> + '_ {
    let (mut depth, mut before) = (open, ' ');
    text.char_indices().map(move |(at, c)| {
        match c {
            '<' => depth += 1,
            // Not the arrow of a function's type.
            '>' if before != '-' => depth = depth.saturating_sub(1),
            _ => {}
        }
        before = c;
        (at, c, depth)
    })
}

#[cfg(test)]
mod tests {
    use super::function;

    #[test]
    fn symbols_lose_their_generic_arguments() {
        let names = |symbol| function(symbol).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(names("krate::scene::edges::<12>"), ["krate::scene::edges"]);
        assert_eq!(names("<krate::Affine<krate::A, krate::B>>::then::<krate::C>"), ["krate::Affine::then"]);
        assert_eq!(
            names("<krate::target::Pixels<Rgb, [u8; 2]> as krate::target::Surface>::fill"),
            ["<krate::target::Pixels as krate::target::Surface>::fill", "krate::target::Surface::fill"]
        );
        assert_eq!(names("<krate::Plane>::at::{closure#0}"), ["krate::Plane::at::{closure#0}"]);
        assert_eq!(
            names("<fn(u8) -> krate::A as core::ops::FnOnce<(u8,)>>::call_once")[1],
            "core::ops::FnOnce::call_once"
        );
    }
}
