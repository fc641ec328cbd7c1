//! The source of a file with all its mutants, each behind a switch.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{visit_expr, visit_impl_item_fn, visit_item_fn, visit_trait_item_fn, Visit};
use syn::{Expr, File, ImplItemFn, ItemFn, Signature, TraitItemFn};

use crate::Mutant;

/// A source with switches.
#[derive(Default)]
pub(crate) struct Switched {
    pub(crate) text: String,
    /// The bytes of `text` that have a mutant; first its own, then all of the expression in both forms.
    pub(crate) regions: Vec<(u32, Range<usize>)>,
    /// The mutants of what the compiler may compute, where no switch is: outside of functions, and in `const` ones.
    pub(crate) constant: Vec<u32>,
}

/// A mutant and the bytes of the source that it is chosen for.
struct Site<'a> {
    mutant: &'a Mutant,
    whole: Range<usize>,
    /// The expression ends in a brace, so that no semicolon follows it where it is a statement.
    is_block: bool,
}

/// The expressions and functions of a file.
#[derive(Default)]
struct Parts {
    expressions: Vec<(Range<usize>, bool)>,
    functions: Vec<(Range<usize>, bool)>,
}

impl Parts {
    fn add_function(&mut self, function: &impl Spanned, signature: &Signature) {
        self.functions.push((function.span().byte_range(), signature.constness.is_some()));
    }

    /// Whether the compiler may compute what is in a range.
    fn is_constant(&self, range: &Range<usize>) -> bool {
        let around = self.functions.iter().filter(|(function, _)| contains(function, range));
        around.min_by_key(|(function, _)| function.len()).is_none_or(|(_, is_const)| *is_const)
    }
}

impl<'ast> Visit<'ast> for Parts {
    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        self.add_function(function, &function.sig);
        visit_item_fn(self, function);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        self.add_function(function, &function.sig);
        visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast TraitItemFn) {
        self.add_function(function, &function.sig);
        visit_trait_item_fn(self, function);
    }

    fn visit_expr(&mut self, expression: &'ast Expr) {
        let is_block = matches!(
            expression,
            Expr::Match(_) | Expr::If(_) | Expr::Block(_) | Expr::Loop(_) | Expr::While(_) | Expr::ForLoop(_)
        );
        self.expressions.push((expression.span().byte_range(), is_block));
        visit_expr(self, expression);
    }
}

fn contains(outer: &Range<usize>, inner: &Range<usize>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

/// `source` with `mutants`.
pub(crate) fn switch_in(source: &str, mutants: &[Mutant]) -> Switched {
    let file: File = syn::parse_str(source).expect("a source file");
    let mut parts = Parts::default();
    parts.visit_file(&file);
    let mut sites: Vec<_> = mutants
        .iter()
        .map(|mutant| {
            let around = |(range, _): &&(Range<usize>, bool)| contains(range, &mutant.replaced);
            let (whole, is_block) = match mutant.is_body {
                true => (mutant.replaced.clone(), false),
                false => parts
                    .expressions
                    .iter()
                    .filter(around)
                    .min_by_key(|(range, _)| range.len())
                    .unwrap()
                    .clone(),
            };
            Site { mutant, whole, is_block }
        })
        .collect();
    // The outer ones first.
    sites.sort_by_key(|site| (site.whole.start, usize::MAX - site.whole.end, !site.mutant.is_body));
    let constant = mutants.iter().filter(|mutant| parts.is_constant(&mutant.replaced));
    let mut switched =
        Switched { constant: constant.map(|mutant| mutant.number).collect(), ..Switched::default() };
    let rest = write(source, 0..source.len(), &sites, &mut switched);
    assert!(rest.is_empty(), "a mutant in no expression");
    switched
}

/// Writes `range` of the source with the sites in it, which are the first; returns the others.
fn write<'s, 'm>(
    source: &str,
    range: Range<usize>,
    mut sites: &'s [Site<'m>],
    switched: &mut Switched,
) -> &'s [Site<'m>] {
    let mut at = range.start;
    while let Some((site, others)) = sites.split_first().filter(|(site, _)| contains(&range, &site.whole)) {
        let Site { mutant, whole, is_block } = site;
        switched.text += &source[at..whole.start];
        let start = switched.text.len();
        let (open, close) = match (mutant.is_body, is_block) {
            (true, _) => ("", ""),
            (_, true) => ("{", "}"),
            (_, false) => ("(", ")"),
        };
        switched.text += &format!("{open}if crate::mutant({}) {{", mutant.number);
        let own = switched.text.len();
        if mutant.is_body {
            switched.text += &format!("return {};", mutant.replacement);
        } else {
            switched.text += &source[whole.start..mutant.replaced.start];
            switched.text += &format!(" {} ", mutant.replacement);
            switched.text += &source[mutant.replaced.end..whole.end];
        }
        switched.regions.push((mutant.number, own..switched.text.len()));
        switched.text += if mutant.is_body { "} " } else { "} else {" };
        sites = write(source, whole.clone(), others, switched);
        if !mutant.is_body {
            switched.text += "}";
        }
        switched.text += close;
        switched.regions.push((mutant.number, start..switched.text.len()));
        at = whole.end;
    }
    switched.text += &source[at..range.end];
    sites
}
