//! The importer's remedies in the words and the buttons of the page.

use crate::json::{list, object, text};
use pinhole_import::{ImportError, Remedy, Warning};
use std::fmt;

/// The button of a remedy, if the page has one: its name, and the parts of a choice that it sets, with values in JSON.
fn button(remedy: Remedy) -> Option<(&'static str, &'static [(&'static str, &'static str)])> {
    Some(match remedy {
        Remedy::TwoSided => ("use faces from behind", &[("two-sided", "1")]),
        Remedy::FixWinding => ("use winding outwards", &[("fix-winding", "1")]),
        Remedy::FixWindingNotFlip => {
            ("use winding outwards instead of reversed faces", &[("fix-winding", "1"), ("flip", "0")])
        }
        Remedy::Flip => ("use reversed faces", &[("flip", "1")]),
        Remedy::NotFlip => ("leave out reversed faces", &[("flip", "0")]),
        Remedy::NoEdges | Remedy::NoEdgeFaces => {
            ("draw flat faces", &[("style", "\"flat\""), ("smooth-edges", "0")])
        }
        // The page finds the number of faces.
        Remedy::Decimate(_) if cfg!(feature = "decimate") => ("decimate it", &[("decimate", "0")]),
        _ => return None,
    })
}

/// A remedy in words: the name of its button where there is one.
pub(crate) fn words(remedy: Remedy) -> String {
    match (button(remedy), remedy) {
        (Some((name, _)), _) => name.into(),
        (None, Remedy::TextureColors(_)) => "drop it on this page".into(),
        (None, other) => other.to_string(),
    }
}

/// The buttons of the remedies, as JSON.
fn buttons(remedies: &[Remedy]) -> impl Iterator<Item = String> + '_ {
    remedies.iter().filter_map(|&remedy| button(remedy)).map(|(name, parts)| {
        let parts: Vec<_> = parts.iter().map(|(part, value)| (*part, (*value).into())).collect();
        object(&[("name", text(name)), ("changes", object(&parts))])
    })
}

/// Why something cannot be drawn or made: a message, and the remedies that the importer has.
#[derive(Debug, PartialEq)]
pub struct Refusal {
    message: String,
    remedies: Vec<Remedy>,
}

impl Refusal {
    /// The message and the buttons of the remedies, as JSON.
    pub(crate) fn json(&self) -> String {
        about(&self.message, &self.remedies)
    }
}

/// A message and the buttons of its remedies, as JSON.
pub(crate) fn about(message: &str, remedies: &[Remedy]) -> String {
    object(&[("remedies", list(buttons(remedies))), ("message", text(message))])
}

impl From<String> for Refusal {
    fn from(message: String) -> Self {
        Self { message, remedies: Vec::new() }
    }
}

impl From<&str> for Refusal {
    fn from(message: &str) -> Self {
        message.to_string().into()
    }
}

impl From<ImportError> for Refusal {
    fn from(error: ImportError) -> Self {
        Self { message: error.worded(words), remedies: error.problem.remedies() }
    }
}

impl From<&Warning> for Refusal {
    fn from(warning: &Warning) -> Self {
        Self { message: warning.worded(words), remedies: warning.remedies() }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

#[cfg(test)]
mod tests {
    use super::{buttons, words};
    use pinhole_import::Remedy;

    #[test]
    fn a_remedy_is_a_button_where_the_page_has_one() {
        let both = r#"{"name":"use winding outwards instead of reversed faces","changes":{"fix-winding":1,"flip":0}}"#;
        let flat = r#"{"name":"draw flat faces","changes":{"style":"flat","smooth-edges":0}}"#;
        let remedies = [Remedy::CloseSurface, Remedy::FixWindingNotFlip, Remedy::NoEdgeFaces];
        assert_eq!(buttons(&remedies).collect::<Vec<_>>(), [both, flat]);
        assert_eq!(words(Remedy::TwoSided), "use faces from behind");
        assert_eq!(words(Remedy::CloseSurface), "close the surface");
    }
}
