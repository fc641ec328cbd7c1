//! ASCII STL as people write it to binary STL, and what is wrong with it by lines.
//!
//! Taken are key words in any case, any number of words in a line, also all of them, several solids (they become one), facets
//! without a sound normal (which exporters write for slivers), a start without `solid`, an end without `endsolid`, comments
//! after `#`, lines of colours, other text behind a statement in its line, and `end` apart from what it ends.

use super::{COUNT, HEADER};
use crate::text::{a_vertex_needs_numbers, before_comment, number};
use crate::Problem;

/// An ASCII file converted to binary STL, and the line in which each facet begins.
pub(super) struct Text {
    pub(super) binary: Vec<u8>,
    pub(super) lines: Vec<u32>,
    /// The last line, if the file ends without `endsolid`.
    pub(super) unended: Option<usize>,
    /// How many lines of colours there are, and the number of the first.
    pub(super) colors: Option<(usize, usize)>,
}

/// A problem, and the line where it is, if known.
type Refusal = (Problem, Option<usize>);

/// Reads it all.
pub(super) fn to_binary(text: &str) -> Result<Text, Refusal> {
    let mut words = Words { line: 0, colors: None, words: "".split_ascii_whitespace(), lines: text.lines() };
    let mut out = Text { binary: vec![0; HEADER + COUNT], lines: Vec::new(), unended: None, colors: None };
    let mut ended = false;
    while let Some(word) = words.next() {
        ended = is(word, "endsolid");
        if is(word, "facet") {
            out.lines.push(words.line as u32);
            facet(&mut words, &mut out.binary)?;
            words.end_statement();
        } else if is(word, "solid") || ended {
            words.skip_name();
        } else {
            return Err(words.refuse("neither `facet` nor `endsolid` stands here"));
        }
    }
    out.colors = words.colors;
    out.unended = (!ended).then_some(words.line);
    // Files are short enough that 32 bits hold the count.
    out.binary[HEADER..HEADER + COUNT].copy_from_slice(&(out.lines.len() as u32).to_le_bytes());
    Ok(out)
}

/// What stands between `facet` and `endfacet`.
fn facet(words: &mut Words<'_>, out: &mut Vec<u8>) -> Result<(), Refusal> {
    // The normal may be anything, and may be missing: it is not used.
    let mut word = words.next();
    for _ in 0..4 {
        if word.is_some_and(|word| !is(word, "outer")) {
            word = words.next();
        }
    }
    words.expect(word, "outer", "after the facet's normal should stand `outer loop`")?;
    words.expect_next("loop", "after `outer` should stand `loop`")?;
    words.end_statement();
    out.extend([0; 12]);
    for _ in 0..3 {
        words.expect_next("vertex", "a facet has three vertices, each `vertex x y z`")?;
        let line = Some(words.line); // where a number is missing, its word is of the next line
        for _ in 0..3 {
            let Some(word) = words.next() else { return Err(words.ended()) };
            match number(word).map(|number| number as f32) {
                Some(number) if number.is_finite() => out.extend(number.to_le_bytes()),
                Some(_) => return Err((Problem::NotFinite, line)),
                None => return Err((a_vertex_needs_numbers(word), line)),
            }
        }
        words.end_statement();
    }
    out.extend([0; 2]);
    words.expect_next("endloop", "after three vertices should stand `endloop`: a facet is a triangle")?;
    words.end_statement();
    words.expect_next("endfacet", "after `endloop` should stand `endfacet`")
}

fn is(word: &str, wanted: &str) -> bool {
    word.eq_ignore_ascii_case(wanted)
}

/// The words that a statement begins with.
const STATEMENTS: [&str; 8] = ["solid", "facet", "outer", "vertex", "end", "endloop", "endfacet", "endsolid"];

/// The words of a text, without comments and the lines of colours that some programs write.
struct Words<'t> {
    /// The number of the last word's line.
    line: usize,
    /// How many lines of colours were skipped, and the number of the first.
    colors: Option<(usize, usize)>,
    words: std::str::SplitAsciiWhitespace<'t>,
    lines: std::str::Lines<'t>,
}

impl<'t> Words<'t> {
    fn next(&mut self) -> Option<&'t str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(if is(word, "end") { self.joined(word) } else { word });
            }
            self.words = before_comment(self.lines.next()?).split_ascii_whitespace();
            self.line += 1;
            if self.peek().is_some_and(|word| is(word, "color") || is(word, "colour")) {
                self.colors.get_or_insert((0, self.line)).0 += 1;
                self.words = "".split_ascii_whitespace();
            }
        }
    }

    /// The next word of the line.
    fn peek(&self) -> Option<&'t str> {
        self.words.clone().next()
    }

    /// `end` and the word that follows it in the line as one word, if they are one elsewhere.
    fn joined(&mut self, end: &'t str) -> &'t str {
        let words = [("loop", "endloop"), ("facet", "endfacet"), ("solid", "endsolid")];
        let joined = words.into_iter().find(|(apart, _)| self.peek().is_some_and(|word| is(word, apart)));
        joined.map_or(end, |(_, joined)| {
            self.words.next();
            joined
        })
    }

    /// Skips what stands in the line behind a statement, up to the next statement.
    fn end_statement(&mut self) {
        while self.peek().is_some_and(|word| !STATEMENTS.iter().any(|statement| is(word, statement))) {
            self.words.next();
        }
    }

    /// The name of a solid is the rest of its line, whatever words these are; but facets, if they stand there, are none.
    fn skip_name(&mut self) {
        let mut rest = self.words.clone();
        let has_facets = rest.any(|word| is(word, "facet")) && rest.any(|word| is(word, "outer"));
        while self.peek().is_some_and(|word| !(has_facets && is(word, "facet"))) {
            self.words.next();
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
