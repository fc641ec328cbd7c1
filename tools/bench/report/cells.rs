//! The cells of the table: each scene on each core, from a firmware of its own, and whether its picture is the host's.

use crate::core::{Core, CORES};
use crate::cross::Build;
use crate::side_by_side::side_by_side;
use crate::{elf, Result};
use bench::cells::{Known, CELLS, NO_PLANES, TEXTURE_METHODS, USER_CELLS};
use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// Opt-levels: for speed, and for size. The name of a variant at the latter ends with [`SMALL_SUFFIX`].
pub(crate) const FAST: &str = "3";
pub(crate) const SMALL: &str = "s";
const SMALL_SUFFIX: &str = "-s";

/// The cells that are measured at opt-level s too where no variant is named: one for each way to draw.
pub(crate) const MAIN: [(&str, &str); 10] = [
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

/// One line of the table.
pub(crate) struct Cell {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    /// [`FAST`] or [`SMALL`].
    pub(crate) level: &'static str,
    pub(crate) core: Core,
    pub(crate) instructions: u64,
    /// Code and constants in bytes, without those of a firmware that draws nothing.
    pub(crate) flash: u64,
    /// Variables in bytes: picture, depth and vertices among them.
    pub(crate) ram: u64,
    /// The deepest stack in bytes, with set-up and the firmware's own frames.
    pub(crate) stack: u64,
    pub(crate) crc: u32,
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, variant, level, core, instructions, flash, ram, stack, crc } = self;
        let (variant, core) = (named(variant, level), core.name);
        write!(f, "{scene},{variant},{core},{instructions},{flash},{ram},{stack},{crc:08x}")
    }
}

fn all() -> impl Iterator<Item = &'static Known> {
    CELLS.iter().chain(USER_CELLS).chain(TEXTURE_METHODS)
}

/// A variant at an opt-level.
pub(crate) fn named(variant: &str, level: &str) -> String {
    match level {
        SMALL => format!("{variant}{SMALL_SUFFIX}"),
        _ => variant.into(),
    }
}

/// The variant and opt-level of a name.
pub(crate) fn split(name: &str) -> (&str, &'static str) {
    match name.strip_suffix(SMALL_SUFFIX) {
        Some(variant) => (variant, SMALL),
        None => (name, FAST),
    }
}

/// The scenes, variants and cores that the command line names. If it names none of a kind, all of that kind are measured, except
/// that only the [`MAIN`] cells are measured at opt-level s.
#[derive(Default)]
pub(crate) struct Choice {
    scenes: Vec<String>,
    variants: Vec<String>,
    cores: Vec<String>,
}

impl Choice {
    /// `Err` lists the known names, if one of `names` is unknown.
    pub(crate) fn new(names: Vec<String>) -> Result<Self> {
        let unique = |name: fn(&Known) -> &'static str| {
            let mut names: Vec<&str> = all().map(name).collect();
            names.sort();
            names.dedup();
            names
        };
        let (scenes, variants) = (unique(|cell| cell.0), unique(|cell| cell.1));
        let cores = CORES.map(|core| core.name);
        let mut choice = Self::default();
        for name in names {
            let (variant, _) = split(&name);
            if scenes.contains(&name.as_str()) {
                choice.scenes.push(name);
            } else if cores.contains(&name.as_str()) {
                choice.cores.push(name);
            } else if variants.contains(&variant) {
                choice.variants.push(name);
            } else {
                return Err(format!(
                    "there is no scene, variant or core {name}: {scenes:?}, {variants:?} and with {SMALL_SUFFIX}, {cores:?}"
                )
                .into());
            }
        }
        Ok(choice)
    }

    fn has(&self, scene: &str, variant: &str, level: &'static str) -> bool {
        // No page lists these cells, so a run for the pages does not measure them.
        let is_method = TEXTURE_METHODS.iter().any(|cell| (cell.0, cell.1) == (scene, variant));
        if is_method && self.scenes.is_empty() && self.variants.is_empty() {
            return false;
        }
        (self.scenes.is_empty() || self.scenes.iter().any(|name| name == scene))
            && match self.variants.is_empty() {
                true => level == FAST || MAIN.contains(&(scene, variant)),
                false => self.variants.contains(&named(variant, level)),
            }
    }

    fn has_core(&self, core: Core) -> bool {
        self.cores.is_empty() || self.cores.iter().any(|name| name == core.name)
    }
}

/// The name of a cell's image.
pub(crate) fn bin(scene: &str, variant: &str) -> String {
    let scene = scene.to_lowercase();
    if variant == "plain" {
        format!("cell_{scene}")
    } else {
        format!("cell_{scene}_{}", variant.replace('-', "_"))
    }
}

/// A copy of a cell's image, which is not replaced when the cell is built at another opt-level.
pub(crate) fn kept(cell: &Cell) -> PathBuf {
    cell.core.build().image(&bin(cell.scene, cell.variant)).with_extension(cell.level)
}

/// Measures the chosen cells, core by core, and hands each to `each`.
pub(crate) fn measure(choice: &Choice, failures: &mut Vec<String>, mut each: impl FnMut(Cell)) -> Result<()> {
    let mut pictures = Pictures::new();
    for core in CORES.into_iter().filter(|&core| choice.has_core(core)) {
        for level in [FAST, SMALL] {
            let chosen = |(scene, variant, _): &Known| choice.has(scene, variant, level);
            let chosen: Vec<Known> = all().copied().filter(chosen).collect();
            on(core, level, &chosen, bin, &mut pictures, failures)?.into_iter().for_each(&mut each);
        }
    }
    Ok(())
}

/// Measures the cells with early culling by face planes once more without it, on the cores that have targets, and prints them
/// to stderr: the table does not list them.
pub(crate) fn measure_without_planes(failures: &mut Vec<String>) -> Result<Vec<Cell>> {
    let no_planes = |scene: &str, variant: &str| bin(scene, variant) + "_no_planes";
    let (mut pictures, mut cells) = (Pictures::new(), Vec::new());
    for core in CORES.into_iter().filter(|core| core.name != "RV32") {
        cells.extend(on(core, FAST, NO_PLANES, no_planes, &mut pictures, failures)?);
    }
    cells.iter().for_each(|cell| eprintln!("without planes: {cell}"));
    Ok(cells)
}

/// Checksums of the host's pictures, by scene and variant.
type Pictures = BTreeMap<(&'static str, &'static str), Option<u32>>;

/// Builds and runs `these` cells on one core, at one opt-level.
fn on(
    core: Core,
    level: &'static str,
    these: &[Known],
    bin: fn(&str, &str) -> String,
    pictures: &mut Pictures,
    failures: &mut Vec<String>,
) -> Result<Vec<Cell>> {
    if these.is_empty() {
        return Ok(Vec::new());
    }
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
        std::fs::copy(image(scene, variant), kept(&cell))?;
        let host = *pictures.entry((scene, variant)).or_insert_with(|| on_host().map(|counted| counted.crc));
        if host != Some(cell.crc) {
            failures.push(format!("{cell}: not the host's picture, which is {host:08x?}"));
        }
        cells.push(cell);
    }
    Ok(cells)
}
