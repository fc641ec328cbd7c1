//! Fails where a public function of the library is reached by no entry of the no-panic proof:
//!
//! ```text
//! nopanic-interface RUSTDOC_JSON SYMBOLS EXEMPT
//! ```
//!
//! RUSTDOC_JSON lists the public functions. SYMBOLS is what `nm --demangle` prints for the entries, linked without
//! optimisation and without unreachable functions: a function that is in no call chain from an entry is not there.
//! EXEMPT lists the functions that need no entry, each with its reason. No name of the library stands in this program.

mod interface;
mod symbols;

use std::collections::BTreeSet;
use std::process::ExitCode;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A function by the paths under which it is defined, without generic arguments: the same in rustdoc's JSON and in symbols.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Function {
    /// A function outside of any `impl`.
    Free(String),
    /// A method of a type, inherent or of a trait.
    Method { of: String, of_trait: Option<String>, name: String },
    /// A method of a trait for whichever type: a provided method, or one of `impl<T> Trait for T`.
    Any { of_trait: String, name: String },
}

impl std::fmt::Display for Function {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Free(path) => f.write_str(path),
            Self::Method { of, of_trait: None, name } => write!(f, "{of}::{name}"),
            Self::Method { of, of_trait: Some(of_trait), name } => write!(f, "<{of} as {of_trait}>::{name}"),
            Self::Any { of_trait, name } => write!(f, "{of_trait}::{name}"),
        }
    }
}

/// A line of the list of exemptions, `PATTERN: REASON`. A `*` at either end of the pattern stands for any text.
struct Exemption<'t>(&'t str);

impl<'t> Exemption<'t> {
    fn new(line: &'t str) -> Result<Self> {
        match line.split_once(": ") {
            Some((pattern, reason)) if !reason.trim().is_empty() => Ok(Self(pattern)),
            _ => Err(format!("exemption without a reason: {line}").into()),
        }
    }

    fn is_for(&self, function: &Function) -> bool {
        let name = function.to_string();
        match (self.0.strip_prefix('*'), self.0.strip_suffix('*')) {
            (Some(end), None) => name.ends_with(end),
            (None, Some(start)) => name.starts_with(start),
            (Some(_), Some(_)) => name.contains(self.0.trim_matches('*')),
            (None, None) => name == self.0,
        }
    }
}

fn run(arguments: &[String]) -> Result<bool> {
    let [json, listing, exempt] = arguments else {
        return Err("usage: nopanic-interface RUSTDOC_JSON SYMBOLS EXEMPT".into());
    };
    let read = |path: &String| std::fs::read_to_string(path).map_err(|error| format!("{path}: {error}"));
    let public = interface::functions(&serde_json::from_str(&read(json)?)?)?;
    let (listing, exempt) = (read(listing)?, read(exempt)?);
    let reached = symbols::functions(&listing);
    if public.len() < 100 || reached.len() < public.len() / 2 {
        let (public, reached) = (public.len(), reached.len());
        return Err(format!(
            "{public} public functions, {reached} reached: the input is not what it should be"
        )
        .into());
    }
    let lines = exempt.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let exemptions = lines.map(Exemption::new).collect::<Result<Vec<_>>>()?;
    let (with, without): (BTreeSet<_>, BTreeSet<_>) =
        public.into_iter().partition(|function| reached.contains(function));
    let (exempted, missing): (Vec<_>, Vec<_>) =
        without.iter().partition(|function| exemptions.iter().any(|exemption| exemption.is_for(function)));
    for function in &missing {
        eprintln!("nopanic: no entry reaches the public function {function}: add one in tools/nopanic/src");
    }
    let unused =
        exemptions.iter().filter(|exemption| !exempted.iter().any(|function| exemption.is_for(function)));
    let unused: Vec<_> = unused.map(|exemption| exemption.0).collect();
    for pattern in &unused {
        eprintln!("nopanic: the exemption {pattern} is for no function that lacks an entry: remove it");
    }
    println!("nopanic: entries reach {} public functions, {} are exempt", with.len(), exempted.len());
    Ok(missing.is_empty() && unused.is_empty())
}

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("nopanic-interface: {error}");
            ExitCode::from(2)
        }
    }
}
