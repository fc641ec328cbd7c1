//! The cases of `cases.txt`: what the command says of a file, and what it writes.
#![cfg(feature = "cli")]

use crate::common::folder;
use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A text with those that its names stand for.
fn expanded(text: &str, known: &HashMap<&str, &str>) -> String {
    let mut parts = text.split('$');
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (name, rest) = part.split_at(part.find(|c: char| !c.is_ascii_uppercase()).unwrap_or(part.len()));
        out += &(expanded(known.get(name).unwrap_or_else(|| panic!("${name}")), known) + rest);
    }
    out
}

/// The bytes of an expanded text.
fn bytes(text: &str) -> Vec<u8> {
    let text = text.replace("; ", "\n").replace(';', "\n");
    let mut parts = text.split('{');
    let mut out = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let (number, rest) = part.split_once('}').expect("{byte}");
        out.push(u8::from_str_radix(number, 16).expect("two digits"));
        out.extend(rest.bytes());
    }
    if !text.ends_with('}') {
        out.push(b'\n');
    }
    out
}

/// The items of a list in Rust source, without spaces.
fn list(source: &str, name: &str) -> Option<String> {
    let (_, rest) = source.split_once(&format!("pub const {name}: "))?;
    let (_, rest) = rest.split_once("= [")?;
    let (items, _) = rest.split_once("];")?;
    let items: String = items.split_whitespace().collect();
    Some(items.trim_end_matches(',').into())
}

/// Runs the command in a folder, and tells how what it does differs from what is wanted.
fn differences(folder: &Path, model: &str, options: &str, wanted: &[String]) -> Vec<String> {
    let usual = if options.contains("--name") { "" } else { "--arrays --keep-order" };
    let words = options.split(' ').chain(usual.split(' ')).filter(|word| !word.is_empty());
    let words = words.map(|word| if word.contains("::") { word.into() } else { word.replace('_', " ") });
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole-import"));
    let done = command.current_dir(folder).args([model, "-o", "out.rs"]).args(words).output().unwrap();
    let source = fs::read_to_string(folder.join("out.rs")).unwrap_or_default();
    let _ = fs::remove_file(folder.join("out.rs"));
    let [said, complaint] = [done.stdout, done.stderr].map(|text| String::from_utf8(text).unwrap());
    let mut warnings = complaint.lines().map(|line| line.strip_prefix(&format!("{model}: warning: ")));
    let (mut differ, mut is_refused) = (Vec::new(), false);
    for line in wanted {
        let (kind, text) = line.split_at(1);
        let text = text.trim_start();
        let is_so = match kind {
            "!" if text == "*" => warnings.by_ref().all(|warning| warning.is_some()),
            "!" => warnings.next() == Some(Some(text)),
            ">" => said.contains(text),
            "|" => source.contains(text),
            "-" => !source.contains(text),
            "=" => text
                .split_once(' ')
                .is_some_and(|(name, items)| list(&source, name).as_deref() == Some(items)),
            "x" => {
                is_refused = true;
                complaint.trim_end() == format!("{model}{text}")
            }
            "X" => {
                is_refused = true;
                complaint.contains(text)
            }
            _ => false,
        };
        differ.extend(
            (!is_so)
                .then(|| format!("{line}: {:?}", list(&source, text.split(' ').next().unwrap_or_default()))),
        );
    }
    let is_all = is_refused || warnings.next().is_none();
    if !is_all
        || done.status.code() != Some(if is_refused { 2 } else { 0 })
        || is_refused != source.is_empty()
    {
        differ.push(format!("{:?}", done.status.code()));
    }
    if !differ.is_empty() {
        differ.push(format!("{said}{complaint}"));
    }
    differ
}

/// The lines of a block that are wanted of its run in line `at`.
fn wanted<'b>(lines: &[&'b str], at: usize) -> Vec<&'b str> {
    lines[at + 1..].iter().map_while(|line| line.strip_prefix("    ")).collect()
}

#[test]
fn what_is_said_and_written_is_as_in_the_table() {
    let (mut known, mut problems, mut runs) = (HashMap::new(), Vec::new(), 0);
    for block in include_str!("cases.txt").split("\n\n") {
        let (folder, mut model) = (folder("cases"), "");
        let lines: Vec<&str> = block.lines().filter(|line| !line.starts_with('#')).collect();
        for (at, line) in lines.iter().enumerate() {
            let (options, wanted) = if line.starts_with("    ") {
                continue;
            } else if let Some(options) = line.strip_prefix("  $") {
                (options.trim(), wanted(&lines, at))
            } else if let Some((name, text)) =
                line.split_once(" = ").filter(|(name, _)| !name.contains([' ', '.']))
            {
                known.insert(name, text);
                continue;
            } else {
                let (name, text) = line.split_once(": ").unwrap_or_else(|| panic!("{line}"));
                let (text, wanted) =
                    text.split_once(" => ").map_or((text, None), |(text, of)| (text, Some(of)));
                let file = folder.join(name);
                fs::create_dir_all(file.parent().unwrap()).unwrap();
                fs::write(file, bytes(&expanded(text, &known))).unwrap();
                if name.ends_with(".obj") || name.ends_with(".stl") {
                    model = name;
                }
                let Some(wanted) = wanted else { continue };
                match wanted.split(" & ").collect::<Vec<_>>() {
                    all if all[0].starts_with("$ -") => (&all[0][2..], all[1..].to_vec()),
                    all => ("", all),
                }
            };
            let wanted: Vec<String> = wanted.into_iter().map(|line| expanded(line, &known)).collect();
            runs += 1;
            let differ = differences(&folder, model, options, &wanted);
            if !differ.is_empty() {
                problems.push(format!("{line}\n{}", differ.join("\n")));
            }
        }
    }
    assert!(runs > 200 && problems.is_empty(), "{runs} runs\n{}", problems.join("\n"));
}
