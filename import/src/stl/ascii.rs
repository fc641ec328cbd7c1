//! ASCII STL as people write it to ASCII STL as `stl_io` reads it, and what is wrong with it by lines.
//!
//! Taken are key words in any case, any number of words in a line, several solids (they become one), facets without a sound
//! normal (which exporters write for slivers), and an end without `endsolid`.

use crate::Problem;

/// The text for `stl_io`, and the line in which each facet begins.
pub(super) struct Text {
    pub(super) canonical: String,
    pub(super) lines: Vec<u32>,
}

/// What is wrong, and in which line.
type Refusal = (Problem, Option<usize>);

/// Reads it all.
pub(super) fn canonical(text: &str) -> Result<Text, Refusal> {
    let mut words = Words { line: 0, words: Vec::new().into_iter(), lines: text.lines() };
    let mut out = Text { canonical: String::from("solid \n"), lines: Vec::new() };
    while let Some(word) = words.next() {
        if is(word, "facet") {
            out.lines.push(words.line as u32);
            facet(&mut words, &mut out.canonical)?;
        } else if !is(word, "solid") && !is(word, "endsolid") {
            return Err(words.refuse("neither `facet` nor `endsolid` stands here"));
        }
    }
    out.canonical.push_str("endsolid\n");
    Ok(out)
}

/// What stands between `facet` and `endfacet`.
fn facet(words: &mut Words<'_>, out: &mut String) -> Result<(), Refusal> {
    // The normal may be anything, and may be missing: it is not used.
    let mut word = words.next();
    for _ in 0..4 {
        if word.is_some_and(|word| !is(word, "outer")) {
            word = words.next();
        }
    }
    words.expect(word, "outer", "after the facet's normal should stand `outer loop`")?;
    words.expect_next("loop", "after `outer` should stand `loop`")?;
    out.push_str("facet normal 0 0 0\nouter loop\n");
    for _ in 0..3 {
        words.expect_next("vertex", "a facet has three vertices, each `vertex x y z`")?;
        let line = Some(words.line); // where a number is missing, its word is of the next line
        out.push_str("vertex");
        for _ in 0..3 {
            let Some(word) = words.next() else { return Err(words.ended()) };
            match word.parse::<f32>() {
                Ok(number) if number.is_finite() => {}
                Ok(_) => return Err((Problem::NotFinite, line)),
                Err(_) => return Err((Problem::Syntax("a vertex needs three numbers"), line)),
            }
            out.push(' ');
            out.push_str(word);
        }
        out.push('\n');
    }
    words.expect_next("endloop", "after three vertices should stand `endloop`: a facet is a triangle")?;
    words.expect_next("endfacet", "after `endloop` should stand `endfacet`")?;
    out.push_str("endloop\nendfacet\n");
    Ok(())
}

fn is(word: &str, wanted: &str) -> bool {
    word.eq_ignore_ascii_case(wanted)
}

/// The words of a text, without the names of solids.
struct Words<'t> {
    /// The number of the last word's line.
    line: usize,
    words: std::vec::IntoIter<&'t str>,
    lines: std::str::Lines<'t>,
}

impl<'t> Words<'t> {
    fn next(&mut self) -> Option<&'t str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let line = self.lines.next()?;
            self.line += 1;
            let mut words: Vec<_> = line.trim_start_matches('\u{feff}').split_whitespace().collect();
            if words.first().is_some_and(|&first| is(first, "solid") || is(first, "endsolid")) {
                words.truncate(1); // a name may be any words
            }
            self.words = words.into_iter();
        }
    }

    fn expect_next(&mut self, wanted: &str, what: &'static str) -> Result<(), Refusal> {
        let word = self.next();
        self.expect(word, wanted, what)
    }

    fn expect(&self, word: Option<&str>, wanted: &str, what: &'static str) -> Result<(), Refusal> {
        match word {
            Some(word) if is(word, wanted) => Ok(()),
            Some(_) => Err(self.refuse(what)),
            None => Err(self.ended()),
        }
    }

    fn refuse(&self, what: &'static str) -> Refusal {
        (Problem::Syntax(what), Some(self.line))
    }

    fn ended(&self) -> Refusal {
        self.refuse("the file ends within a facet")
    }
}
