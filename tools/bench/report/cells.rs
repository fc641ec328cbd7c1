//! The cells: each scene on each core, from a firmware of its own, and whether its picture is the host's.

use crate::core::{Core, CORES};
use crate::cross::Build;
use crate::data::{row, Row};
use crate::side_by_side::side_by_side;
use crate::{elf, Result};
use bench::cells::{Known, CELLS, METHODS};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// Opt-levels: for speed, and for size. The name of a variant at the latter ends with [`SMALL_SUFFIX`].
const FAST: &str = "3";
const SMALL: &str = "s";
const SMALL_SUFFIX: &str = "-s";

/// The cells that are measured at opt-level s too where no variant is named: one for each way to draw.
const MAIN: [(&str, &str); 10] = [
    ("S1", "plain"),
    ("S2", "z"),
    ("S3", "plain"),
    ("S3", "z"),
    ("S6", "dt"),
    ("S8", "z"),
    ("C1", "plain"),
    ("C1", "z"),
    ("T1", "plain"),
    ("F50", "z"),
];

/// A scene drawn in a variant, on a core.
pub(crate) struct Cell {
    pub(crate) scene: &'static str,
    /// The variant, and [`FAST`] or [`SMALL`].
    variant: &'static str,
    level: &'static str,
    pub(crate) core: Core,
    pub(crate) instructions: u64,
    /// Code and constants in bytes, without those of a firmware that draws nothing.
    flash: u64,
    /// Variables in bytes: picture, depth and vertices among them.
    ram: u64,
    /// The deepest stack in bytes, with set-up and the firmware's own frames.
    stack: u64,
    crc: u32,
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, core, instructions, flash, ram, stack, crc, .. } = self;
        let (variant, core) = (self.variant(), core.name);
        write!(f, "{scene},{variant},{core},{instructions},{flash},{ram},{stack},{crc:08x}")
    }
}

impl Cell {
    /// The variant, with its opt-level.
    pub(crate) fn variant(&self) -> String {
        named(self.variant, self.level)
    }

    pub(crate) fn row(&self) -> Row {
        row([
            ("scene", json!(self.scene)),
            ("variant", json!(self.variant())),
            ("core", json!(self.core.name)),
            ("instructions", json!(self.instructions)),
            ("flash", json!(self.flash)),
            ("ram", json!(self.ram)),
            ("stack", json!(self.stack)),
            ("crc", json!(format!("{:08x}", self.crc))),
        ])
    }

    /// A copy of the image, which is not replaced when the cell is built at another opt-level.
    pub(crate) fn image(&self) -> PathBuf {
        self.core.build().image(&bin(self.scene, self.variant)).with_extension(self.level)
    }
}

/// A variant at an opt-level.
fn named(variant: &str, level: &str) -> String {
    match level {
        SMALL => format!("{variant}{SMALL_SUFFIX}"),
        _ => variant.into(),
    }
}

/// The scenes, variants and cores that the command line names. If it names none of a kind, all of that kind are measured, except
/// that only the [`MAIN`] cells are measured at opt-level s, and textures by other methods only on the M3.
#[derive(Default)]
pub(crate) struct Choice {
    scenes: Vec<String>,
    variants: Vec<String>,
    cores: Vec<String>,
}

impl Choice {
    /// `Err` lists the known names, if one of `names` is unknown.
    pub(crate) fn new(names: &[&str]) -> Result<Self> {
        let unique = |name: fn(&Known) -> &'static str| {
            let mut names: Vec<&str> = CELLS.iter().map(name).collect();
            names.sort();
            names.dedup();
            names
        };
        let (scenes, variants) = (unique(|cell| cell.0), unique(|cell| cell.1));
        let cores = CORES.map(|core| core.name);
        let mut choice = Self::default();
        for &name in names {
            let to = if scenes.contains(&name) {
                &mut choice.scenes
            } else if cores.contains(&name) {
                &mut choice.cores
            } else if variants.contains(&name.strip_suffix(SMALL_SUFFIX).unwrap_or(name)) {
                &mut choice.variants
            } else {
                return Err(format!(
                    "there is no scene, variant or core {name}: {scenes:?}, {variants:?} and with {SMALL_SUFFIX}, {cores:?}"
                )
                .into());
            };
            to.push(name.into());
        }
        Ok(choice)
    }

    fn has(&self, &(scene, variant, _): &Known, level: &'static str, core: Core) -> bool {
        let is_named = |names: &[String], name: &str| names.is_empty() || names.iter().any(|one| one == name);
        let is_chosen_variant = match self.variants.is_empty() {
            true if METHODS.contains(&variant) => level == FAST && core.name == "M3",
            true => level == FAST || MAIN.contains(&(scene, variant)),
            false => self.variants.contains(&named(variant, level)),
        };
        is_chosen_variant && is_named(&self.scenes, scene) && is_named(&self.cores, core.name)
    }
}

/// The name of a cell's image.
fn bin(scene: &str, variant: &str) -> String {
    let scene = scene.to_lowercase();
    match variant {
        "plain" => format!("cell_{scene}"),
        _ => format!("cell_{scene}_{}", variant.replace('-', "_")),
    }
}

/// Measures the chosen cells, core by core, and hands each to `each`.
pub(crate) fn measure(choice: &Choice, failures: &mut Vec<String>, mut each: impl FnMut(Cell)) -> Result<()> {
    let mut pictures = BTreeMap::new();
    for core in CORES {
        for level in [FAST, SMALL] {
            let chosen: Vec<Known> =
                CELLS.iter().filter(|cell| choice.has(cell, level, core)).copied().collect();
            if !chosen.is_empty() {
                on(core, level, &chosen, &mut pictures, failures)?.into_iter().for_each(&mut each);
            }
        }
    }
    Ok(())
}

/// Measures and prints the cells that these names choose.
pub(crate) fn named_cells(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Cell>> {
    let mut cells = Vec::new();
    measure(&Choice::new(names)?, failures, |cell| {
        println!("{cell}");
        cells.push(cell);
    })?;
    Ok(cells)
}

/// The rows of the cells that these names choose.
pub(crate) fn rows(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Row>> {
    Ok(named_cells(names, failures)?.iter().map(Cell::row).collect())
}

/// Checksums of the host's pictures, by scene and variant.
type Pictures = BTreeMap<(&'static str, &'static str), Option<u32>>;

/// Builds and runs `these` cells on one core, at one opt-level.
fn on(
    core: Core,
    level: &'static str,
    these: &[Known],
    pictures: &mut Pictures,
    failures: &mut Vec<String>,
) -> Result<Vec<Cell>> {
    let build = Build { level, ..core.build() };
    let bins = these.iter().map(|(scene, variant, _)| bin(scene, variant)).chain(["cell_empty".into()]);
    build.cargo("build", &bins.map(|bin| format!("--bin={bin}")).collect::<Vec<_>>())?;
    let empty = elf::sizes(&build.image("cell_empty"))?.flash;
    let image = |scene, variant| build.image(&bin(scene, variant));
    let printed = side_by_side(these, |(scene, variant, _)| core.run(&image(scene, variant)))?;
    let mut cells = Vec::new();
    for (&(scene, variant, on_host), printed) in these.iter().zip(printed) {
        let fields: Vec<&str> = printed.trim().split(',').collect();
        let [instructions, stack, crc] = fields[..] else {
            return Err(format!("{scene},{variant}: {printed}").into());
        };
        let elf::Sizes { flash, statics, .. } = elf::sizes(&image(scene, variant))?;
        let cell = Cell {
            scene,
            variant,
            level,
            core,
            instructions: instructions.parse()?,
            flash: flash.saturating_sub(empty),
            ram: statics,
            stack: stack.parse()?,
            crc: u32::from_str_radix(crc, 16)?,
        };
        std::fs::copy(image(scene, variant), cell.image())?;
        let host = *pictures.entry((scene, variant)).or_insert_with(|| on_host().map(|counted| counted.crc));
        if host != Some(cell.crc) {
            failures.push(format!("{cell}: not the host's picture, which is {host:08x?}"));
        }
        cells.push(cell);
    }
    Ok(cells)
}
