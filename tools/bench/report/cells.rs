//! The cells: each scene on each core, from a firmware of its own, and whether its picture is the host's.

use crate::core::{run, side_by_side, Build, Core, CORES};
use crate::{elf, Result};
use bench::cells::{Known, ACCURACIES, CELLS};
use serde_json::{json, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::PathBuf;

/// Opt-levels: for speed, and for size. The name of a variant at the latter ends with [`SMALL_SUFFIX`].
const FAST: &str = "3";
const SMALL: &str = "s";
const SMALL_SUFFIX: &str = "-s";

/// The cells that are measured at opt-level s too where no variant is named: one for each way to draw.
const MAIN: [&str; 10] =
    ["S1 plain", "S2 z", "S3 plain", "S3 z", "S6 dt", "S8 z", "C1 plain", "C1 z", "T1 plain", "F50 z"];

/// The columns that are printed: the bytes of flash are those beyond a firmware that draws nothing; RAM are variables; the stack is
/// the deepest, with set-up and the firmware's own frames.
const COLUMNS: [&str; 8] = ["scene", "variant", "core", "instructions", "flash", "ram", "stack", "crc"];

/// A scene drawn in a variant, on a core.
pub(crate) struct Cell {
    pub(crate) scene: &'static str,
    /// The variant, with its opt-level.
    pub(crate) variant: String,
    pub(crate) core: Core,
    pub(crate) instructions: u64,
    /// A copy of the image, which is not replaced when the cell is built at another opt-level.
    pub(crate) image: PathBuf,
    pub(crate) row: Value,
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&COLUMNS.map(|column| self.row[column].to_string().replace('"', "")).join(","))
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
/// that only the [`MAIN`] cells are measured at opt-level s, and textures by other accuracies only on the M3.
struct Choice<'n>([Vec<&'n str>; 3]);

impl<'n> Choice<'n> {
    /// `Err` lists the known names, if one of `names` is unknown.
    fn new(names: &[&'n str]) -> Result<Self> {
        let of_cells = |names: fn(&Known) -> Vec<String>| CELLS.iter().flat_map(names).collect();
        let known: [BTreeSet<String>; 3] = [
            of_cells(|cell| vec![cell.0.into()]),
            of_cells(|cell| [FAST, SMALL].map(|level| named(cell.1, level)).into()),
            CORES.map(|core| core.name.into()).into(),
        ];
        let mut choice = Self(Default::default());
        for &name in names {
            let kind = known.iter().position(|known| known.contains(name));
            let kind = kind.ok_or_else(|| format!("there is no scene, variant or core {name}: {known:?}"))?;
            choice.0[kind].push(name);
        }
        Ok(choice)
    }

    fn has(&self, &(scene, variant, _): &Known, level: &'static str, core: Core) -> bool {
        let Self([scenes, variants, cores]) = self;
        let is_named = |names: &[&str], name: &str| names.is_empty() || names.contains(&name);
        let is_chosen_variant = match variants.is_empty() {
            true if ACCURACIES.contains(&variant) => level == FAST && core.name == "M3",
            true => level == FAST || MAIN.contains(&format!("{scene} {variant}").as_str()),
            false => variants.contains(&named(variant, level).as_str()),
        };
        is_chosen_variant && is_named(scenes, scene) && is_named(cores, core.name)
    }
}

/// Measures and prints the cells that these names choose, core by core.
pub(crate) fn measure(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Cell>> {
    let (choice, mut pictures, mut cells) = (Choice::new(names)?, BTreeMap::new(), Vec::new());
    for core in CORES {
        for level in [FAST, SMALL] {
            let chosen: Vec<Known> =
                CELLS.iter().filter(|cell| choice.has(cell, level, core)).copied().collect();
            if !chosen.is_empty() {
                cells.extend(on(core, level, &chosen, &mut pictures, failures)?);
            }
        }
    }
    Ok(cells)
}

/// The rows of the cells that these names choose.
pub(crate) fn rows(names: &[&str], failures: &mut Vec<String>) -> Result<Vec<Value>> {
    Ok(measure(names, failures)?.into_iter().map(|cell| cell.row).collect())
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
    const EMPTY: &str = "cell-empty-plain";
    let build = Build { level, ..core.build() };
    let bin = |scene: &str, variant: &str| format!("cell-{scene}-{variant}");
    let bins = these.iter().map(|(scene, variant, _)| bin(scene, variant)).chain([EMPTY.into()]);
    build.cargo("build", &bins.map(|bin| format!("--bin={bin}")).collect::<Vec<_>>())?;
    let empty = elf::sizes(&build.image(EMPTY))?.flash;
    let image = |scene, variant| build.image(&bin(scene, variant));
    let printed = side_by_side(these, |(scene, variant, _)| run(core.name, &image(scene, variant)))?;
    let mut cells = Vec::new();
    for (&(scene, variant, on_host), printed) in these.iter().zip(printed) {
        let fields: Vec<&str> = printed.trim().split(',').collect();
        let [instructions, stack, crc] = fields[..] else {
            return Err(format!("{scene},{variant}: {printed}").into());
        };
        let instructions: u64 = instructions.parse()?;
        let elf::Sizes { flash, statics, .. } = elf::sizes(&image(scene, variant))?;
        let copy = image(scene, variant).with_extension(level);
        std::fs::copy(image(scene, variant), &copy)?;
        let named = named(variant, level);
        let (flash, stack) = (flash.saturating_sub(empty), stack.parse::<u64>()?);
        let row = json!({"scene": scene, "variant": named, "core": core.name, "instructions": instructions,
            "flash": flash, "ram": statics, "stack": stack, "crc": crc});
        let cell = Cell { scene, variant: named, core, instructions, image: copy, row };
        println!("{cell}");
        let host = *pictures.entry((scene, variant)).or_insert_with(|| on_host().map(|counted| counted.crc));
        if host != u32::from_str_radix(crc, 16).ok() {
            failures.push(format!("{cell}: not the host's picture, which is {host:08x?}"));
        }
        cells.push(cell);
    }
    Ok(cells)
}
