//! Puts many mutants into the sources at once, each behind a switch, so that one build has them all: *mutant schemata* (Untch,
//! Offutt and Harrold, *Mutation Analysis Using Mutant Schemata*, 1993).
//!
//! * `mutants switch ALL TREE` puts the mutants of standard input, lines of a number, a tab and a name, into the sources in
//!   TREE. ALL is what `cargo mutants --list --json` says. `a < b` becomes `(if crate::mutant(7) { a <= b } else { a < b })`.
//!   Writes to `TREE/regions.txt` where each mutant is, and prints the numbers of those in what the compiler may compute, where
//!   a switch is off.
//! * `mutants blame TREE` reads the compiler's messages (`--message-format=json`) and prints the numbers of the mutants that
//!   they are about.
//! * `mutants plain ALL TREE` replaces the source of one mutant, as cargo-mutants does.

mod switch_in;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{stdin, BufRead};
use std::ops::Range;
use std::path::Path;
use std::{env, fs};

use serde_json::Value;

/// A change of the sources.
struct Mutant {
    number: u32,
    /// The bytes of the file that the replacement replaces.
    replaced: Range<usize>,
    replacement: String,
    /// Whether the body of a function is replaced, in place of a part of an expression.
    is_body: bool,
}

/// The byte at a line and a column, which counts characters, both from 1.
fn offset(text: &str, place: &Value) -> usize {
    let number = |name| place[name].as_u64().expect("a line and a column") as usize - 1;
    let line_start = match number("line") {
        0 => 0,
        line => text.match_indices('\n').nth(line - 1).expect("the line").0 + 1,
    };
    let line = &text[line_start..];
    line_start + line.char_indices().nth(number("column")).map_or(line.len(), |(at, _)| at)
}

/// The mutants of standard input by file.
fn wanted(all: &str, tree: &Path) -> BTreeMap<String, Vec<Mutant>> {
    let all: Vec<Value> = serde_json::from_str(&fs::read_to_string(all).expect(all)).expect("a list in JSON");
    let by_name: BTreeMap<_, _> = all.iter().map(|entry| (entry["name"].as_str().unwrap(), entry)).collect();
    let mut files: BTreeMap<String, Vec<Mutant>> = BTreeMap::new();
    for line in stdin().lock().lines() {
        let line = line.expect("UTF-8");
        let (number, name) = line.split_once('\t').expect("a number, a tab and a name");
        let entry = by_name[name];
        let file = entry["file"].as_str().unwrap();
        let text = fs::read_to_string(tree.join(file)).expect(file);
        files.entry(file.to_string()).or_default().push(Mutant {
            number: number.parse().expect("a number"),
            replaced: offset(&text, &entry["span"]["start"])..offset(&text, &entry["span"]["end"]),
            replacement: entry["replacement"].as_str().unwrap().to_string(),
            is_body: entry["genre"] == "FnValue",
        });
    }
    files
}

/// Prints the number of the innermost mutant at each error of standard input. An error in none may follow from another; fails
/// where all are.
fn blame(tree: &Path) {
    let regions = fs::read_to_string(tree.join("regions.txt")).expect("regions.txt");
    let regions: Vec<_> = regions
        .lines()
        .map(|line| {
            let mut words = line.split('\t');
            let mut number = || words.next().unwrap().parse::<usize>().unwrap();
            let (mutant, range) = (number(), number()..number());
            (mutant, range, words.next().unwrap())
        })
        .collect();
    let (mut blamed, mut unplaced) = (BTreeSet::new(), String::new());
    for line in stdin().lock().lines() {
        let message: Value = serde_json::from_str(&line.expect("UTF-8")).expect("JSON");
        let message = &message["message"];
        if message["level"] != "error" {
            continue;
        }
        let spans = message["spans"].as_array().unwrap();
        // "aborting due to 3 previous errors" has no spans.
        let Some(primary) = spans.iter().find(|span| span["is_primary"] == true) else { continue };
        let at = |name: &str| primary[name].as_u64().unwrap() as usize;
        let file = primary["file_name"].as_str().unwrap();
        let innermost = regions
            .iter()
            .filter(|(_, range, of)| {
                file.ends_with(of) && range.start <= at("byte_start") && at("byte_end") <= range.end
            })
            .min_by_key(|(_, range, _)| range.len());
        match innermost {
            Some((mutant, ..)) => _ = blamed.insert(*mutant),
            None => unplaced += message["rendered"].as_str().unwrap(),
        }
    }
    assert!(!blamed.is_empty(), "errors in no mutant:\n{unplaced}");
    for number in blamed {
        println!("{number}");
    }
}

fn main() {
    let arguments: Vec<_> = env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["switch", all, tree] => {
            let mut regions = String::new();
            for (file, mutants) in wanted(all, Path::new(tree)) {
                let path = Path::new(tree).join(&file);
                let switched = switch_in::switch_in(&fs::read_to_string(&path).unwrap(), &mutants);
                fs::write(path, switched.text).unwrap();
                switched.constant.iter().for_each(|number| println!("{number}"));
                for (number, region) in switched.regions {
                    regions += &format!("{number}\t{}\t{}\t{file}\n", region.start, region.end);
                }
            }
            fs::write(Path::new(tree).join("regions.txt"), regions).unwrap();
        }
        ["blame", tree] => blame(Path::new(tree)),
        ["plain", all, tree] => {
            for (file, mutants) in wanted(all, Path::new(tree)) {
                let [mutant] = &mutants[..] else { panic!("more than one mutant") };
                let path = Path::new(tree).join(&file);
                let mut text = fs::read_to_string(&path).unwrap();
                text.replace_range(mutant.replaced.clone(), &mutant.replacement);
                fs::write(path, text).unwrap();
            }
        }
        _ => panic!("see the head of main.rs"),
    }
}
