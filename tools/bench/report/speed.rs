//! Instructions and RAM on the emulated M3, and whether the pictures are the host's.

use crate::cross::{Build, BENCH};
use crate::{elf, Result};
use std::collections::BTreeMap;
use std::process::{Command, Stdio};

/// The firmwares that count, each of one way to draw.
const BINS: &[&str] = &["full_empty", "full_empty_depth", "full_wireframe", "full_solid", "full_depth"];

/// `scene,way,how` of a line, with its number and its picture's checksum.
pub(crate) type Lines = BTreeMap<String, (u64, String)>;

pub(crate) struct Speed {
    pub(crate) lines: Lines,
}

impl Speed {
    pub(crate) fn instructions(&self, scene: &str, way: &str, how: &str) -> Option<u64> {
        self.lines.get(&format!("{scene},{way},{how}")).map(|line| line.0)
    }
}

fn parse(text: &str, lines: &mut Lines) -> Result<()> {
    for line in text.lines() {
        let (key, rest) =
            line.match_indices(',').nth(2).map(|(at, _)| line.split_at(at)).ok_or("three keys")?;
        let (number, checksum) = rest[1..].split_once(',').ok_or("a checksum")?;
        lines.insert(key.to_string(), (number.parse()?, checksum.to_string()));
    }
    Ok(())
}

/// The same programs here.
pub(crate) fn host() -> Result<Lines> {
    let mut lines = Lines::new();
    for bin in BINS {
        let mut command = Command::new("cargo");
        command.args(["run", "--quiet", "--locked", "--release", "--bin", bin]).current_dir(BENCH);
        let output = command.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
        if !output.status.success() {
            return Err(format!("{bin} on the host: {}", output.status).into());
        }
        parse(&String::from_utf8(output.stdout)?, &mut lines)?;
    }
    Ok(lines)
}

pub(crate) fn measure(build: Build, host: &Lines, failures: &mut Vec<String>) -> Result<Speed> {
    let mut lines = Lines::new();
    for bin in BINS {
        parse(&build.run(bin)?, &mut lines)?;
    }
    for (key, (_, checksum)) in &lines {
        if host.get(key).map(|line| &line.1) != Some(checksum) {
            failures.push(format!("{key}: not the host's picture"));
        }
    }
    let _ = elf::sizes;
    Ok(Speed { lines })
}
