//! Instructions and RAM on the emulated M3, and whether the pictures are the host's.

use crate::cross::{Build, BENCH};
use crate::{elf, Result};
use std::collections::BTreeMap;
use std::process::{Command, Stdio};

/// The images that count instructions, one for each way to draw.
const BINS: &[&str] = &[
    "full_empty",
    "full_wireframe",
    "full_solid",
    "full_depth",
    "band_empty",
    "band_wireframe",
    "band_solid",
    "band_depth",
];

/// The results by `scene,way,how`: a number of instructions, and the picture's checksum.
pub(crate) type Lines = BTreeMap<String, (u64, String)>;

pub(crate) struct Speed {
    lines: Lines,
    pub(crate) ram: Vec<Ram>,
}

/// RAM of a scene, depth-tested in bands of 8 rows, in bytes.
pub(crate) struct Ram {
    pub(crate) scene: &'static str,
    pub(crate) statics: u64,
    pub(crate) stack: u64,
    pub(crate) limit: u64,
}

impl Ram {
    pub(crate) fn together(&self) -> u64 {
        self.statics + self.stack
    }
}

/// The images that measure RAM, their scenes, and the limits in bytes.
const RAM: &[(&str, &str, u64)] = &[("ram_s3", "S3", 20 << 10), ("ram_s4", "S4", 40 << 10)];

/// All images, as arguments for cargo.
pub(crate) fn bins() -> Vec<String> {
    BINS.iter().chain(RAM.iter().map(|(bin, ..)| bin)).map(|bin| format!("--bin={bin}")).collect()
}

/// The limit for S3 with depth: instructions in bands of 16 rows, divided by those of a whole frame.
const MOST: f64 = 1.25;

impl Speed {
    pub(crate) fn instructions(&self, scene: &str, way: &str, how: &str) -> Option<u64> {
        self.lines.get(&format!("{scene},{way},{how}")).map(|line| line.0)
    }

    /// Instructions in bands of 16 rows divided by those of a whole frame: with the clears, and without.
    pub(crate) fn ratios(&self, scene: &str, way: &str) -> [Option<f64>; 2] {
        let count = |scene, how| self.instructions(scene, way, how).map(|count| count as f64);
        // An empty wireframe is an empty frame without depth.
        let empty = |how| self.instructions("empty", if way == "depth" { way } else { "solid" }, how);
        let drawing = |how| Some(count(scene, how)? - empty(how)? as f64);
        let all = count(scene, "band16").zip(count(scene, "full"));
        let drawn = drawing("band16").zip(drawing("full"));
        [all, drawn].map(|pair| pair.map(|(bands, full)| bands / full).filter(|ratio| ratio.is_finite()))
    }
}

pub(crate) fn parse(text: &str, lines: &mut Lines) -> Result<()> {
    for line in text.lines() {
        let (key, rest) =
            line.match_indices(',').nth(2).map(|(at, _)| line.split_at(at)).ok_or("three keys")?;
        let (number, checksum) = rest[1..].split_once(',').ok_or("a checksum")?;
        lines.insert(key.to_string(), (number.parse()?, checksum.to_string()));
    }
    Ok(())
}

/// The lines that the images print when they run on the host.
pub(crate) fn host() -> Result<Lines> {
    let cargo = |arguments: &[&str]| -> Result<String> {
        let mut command = Command::new("cargo");
        command.args(arguments).args(["--quiet", "--locked", "--release"]).current_dir(BENCH);
        let output = command.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
        if !output.status.success() {
            return Err(format!("{command:?}: {}", output.status).into());
        }
        Ok(String::from_utf8(output.stdout)?)
    };
    let bins = bins();
    cargo(&["build"].into_iter().chain(bins.iter().map(String::as_str)).collect::<Vec<_>>())?;
    let mut lines = Lines::new();
    for bin in &bins {
        parse(&cargo(&["run", bin])?, &mut lines)?;
    }
    Ok(lines)
}

pub(crate) fn measure(build: Build, host: &Lines, failures: &mut Vec<String>) -> Result<Speed> {
    let mut lines = Lines::new();
    for bin in BINS {
        parse(&build.run(bin)?.0, &mut lines)?;
    }
    let mut ram = Vec::new();
    for &(bin, scene, limit) in RAM {
        let (line, stack) = build.run(bin)?;
        parse(&line, &mut lines)?;
        let statics = elf::sizes(&build.image(bin))?.statics;
        let ram_of_scene = Ram { scene, statics, stack, limit };
        if ram_of_scene.together() > limit {
            failures.push(format!("{scene}: {} bytes of RAM, {limit} are allowed", ram_of_scene.together()));
        }
        ram.push(ram_of_scene);
    }
    for (key, (_, checksum)) in &lines {
        if host.get(key).map(|line| &line.1) != Some(checksum) {
            failures.push(format!("{key}: not the host's picture"));
        }
        // A scene's picture does not depend on how it is drawn.
        let full = key.rsplit_once(',').and_then(|(scene, _)| lines.get(&format!("{scene},full")));
        if full.map(|line| &line.1) != Some(checksum) {
            failures.push(format!("{key}: not the picture that is drawn at once"));
        }
    }
    let speed = Speed { lines, ram };
    match speed.ratios("S3", "depth") {
        [Some(ratio), _] if ratio <= MOST => {}
        ratios => failures.push(format!(
            "S3 in bands of 16 rows takes {ratios:?} times as many instructions: {MOST} are allowed"
        )),
    }
    Ok(speed)
}
