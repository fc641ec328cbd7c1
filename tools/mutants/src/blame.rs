//! Which mutants a compiler's errors are about.

use std::collections::BTreeSet;
use std::fs;
use std::io::{stdin, BufRead};
use std::path::Path;

use serde_json::Value;

/// Prints the number of the innermost mutant at each error of standard input. An error in none may follow from another; fails
/// where all are.
pub(crate) fn blame(tree: &Path) {
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
