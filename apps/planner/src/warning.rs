//! The importer's warnings, and the remedies that they name.

/// The remedies for which the page has a button: options of the importer.
const REMEDIES: [(&str, &str); 3] =
    [("--two-sided", "two-sided"), ("--fix-winding", "fix-winding"), ("--flip", "flip")];

/// The remedies that a message names: the part of a choice, and its value.
pub(crate) fn remedies(message: &str) -> Vec<(&'static str, bool)> {
    // "leave out --flip", "use --fix-winding instead of --flip".
    let is_left_out = |option: &str| {
        ["leave out ", "instead of "].iter().any(|words| message.contains(&format!("{words}{option}")))
    };
    let named = REMEDIES.iter().filter(|(option, _)| message.contains(option));
    named.map(|(option, part)| (*part, !is_left_out(option))).collect()
}

#[cfg(test)]
mod tests {
    use super::remedies;

    #[test]
    fn a_remedy_is_what_the_message_says() {
        let open = "open edges: 4; faces show nothing from behind: close the surface, or use --two-sided";
        assert_eq!(remedies(open), [("two-sided", true)]);
        assert_eq!(remedies("the outside shows nothing: leave out --flip"), [("flip", false)]);
        let both = "their outside shows nothing: use --fix-winding instead of --flip";
        assert_eq!(remedies(both), [("fix-winding", true), ("flip", false)]);
        assert_eq!(remedies("size in flash: 200000 bytes"), []);
    }
}
