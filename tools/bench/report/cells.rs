//! The cells of the table: each scene on each core, from a firmware of its own, and whether its picture is the host's.

use crate::core::{Core, CORES};
use crate::side_by_side::side_by_side;
use crate::{elf, Result};
use bench::cells::{Known, CELLS, NO_PLANES};
use std::collections::BTreeMap;
use std::fmt;

/// One line of the table.
pub(crate) struct Cell {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    pub(crate) core: Core,
    pub(crate) instructions: u64,
    /// In bytes: code and constants, more than a firmware has that draws nothing.
    pub(crate) flash: u64,
    /// In bytes: variables, among them the picture, depth and the vertices.
    pub(crate) ram: u64,
    /// In bytes: at its deepest, set-up and the firmware's own frames included.
    pub(crate) stack: u64,
    pub(crate) crc: u32,
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, variant, core, instructions, flash, ram, stack, crc } = self;
        let core = core.name;
        write!(f, "{scene},{variant},{core},{instructions},{flash},{ram},{stack},{crc:08x}")
    }
}

/// The scenes, variants and cores that the command line names. A kind of which it names none is not limited.
#[derive(Default)]
pub(crate) struct Choice {
    names: Vec<String>,
}

impl Choice {
    /// `Err` lists the known names, if one of `names` is unknown.
    pub(crate) fn new(names: Vec<String>) -> Result<Self> {
        let known = |name: &&String| Self::all().iter().flatten().any(|known| known == *name);
        match names.iter().find(|name| !known(name)) {
            Some(name) => {
                Err(format!("no scene, variant or core is called {name}: {:?}", Self::all()).into())
            }
            None => Ok(Self { names }),
        }
    }

    fn all() -> [Vec<&'static str>; 3] {
        let unique = |mut names: Vec<&'static str>| {
            names.sort();
            names.dedup();
            names
        };
        [
            unique(CELLS.iter().map(|cell| cell.0).collect()),
            unique(CELLS.iter().map(|cell| cell.1).collect()),
            CORES.map(|core| core.name).to_vec(),
        ]
    }

    fn has(&self, name: &str) -> bool {
        let all = Self::all();
        let kind = all.iter().find(|kind| kind.contains(&name));
        let mut asked =
            self.names.iter().filter(|asked| kind.is_some_and(|kind| kind.contains(&asked.as_str())));
        let mut asked = asked.by_ref().peekable();
        asked.peek().is_none() || asked.any(|asked| asked == name)
    }
}

/// The name of a cell's image.
pub(crate) fn bin(scene: &str, variant: &str) -> String {
    let scene = scene.to_lowercase();
    if variant == "plain" {
        format!("cell_{scene}")
    } else {
        format!("cell_{scene}_{variant}")
    }
}

/// Measures the chosen cells, core by core, and hands each to `each`.
pub(crate) fn measure(choice: &Choice, failures: &mut Vec<String>, mut each: impl FnMut(Cell)) -> Result<()> {
    let chosen: Vec<Known> = CELLS
        .iter()
        .copied()
        .filter(|(scene, variant, _)| choice.has(scene) && choice.has(variant))
        .collect();
    let mut pictures = Pictures::new();
    for core in CORES.into_iter().filter(|core| choice.has(core.name)) {
        on(core, &chosen, bin, &mut pictures, failures)?.into_iter().for_each(&mut each);
    }
    Ok(())
}

/// Measures the cells with early culling by face planes once more without it, on the cores that have targets, and prints them
/// to stderr: the table does not list them.
pub(crate) fn measure_without_planes(failures: &mut Vec<String>) -> Result<Vec<Cell>> {
    let no_planes = |scene: &str, variant: &str| bin(scene, variant) + "_no_planes";
    let (mut pictures, mut cells) = (Pictures::new(), Vec::new());
    for core in CORES.into_iter().filter(|core| core.name != "RV32") {
        cells.extend(on(core, NO_PLANES, no_planes, &mut pictures, failures)?);
    }
    cells.iter().for_each(|cell| eprintln!("without planes: {cell}"));
    Ok(cells)
}

/// Checksums of the host's pictures, by scene and variant.
type Pictures = BTreeMap<(&'static str, &'static str), Option<u32>>;

/// Builds and runs `these` cells on one core.
fn on(
    core: Core,
    these: &[Known],
    bin: fn(&str, &str) -> String,
    pictures: &mut Pictures,
    failures: &mut Vec<String>,
) -> Result<Vec<Cell>> {
    let bins = these.iter().map(|(scene, variant, _)| bin(scene, variant)).chain(["cell_empty".into()]);
    core.build().cargo("build", &bins.map(|bin| format!("--bin={bin}")).collect::<Vec<_>>())?;
    let empty = elf::sizes(&core.build().image("cell_empty"))?.flash;
    let image = |scene, variant| core.build().image(&bin(scene, variant));
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
            core,
            instructions: instructions.parse()?,
            flash: flash.saturating_sub(empty),
            ram: statics,
            stack: stack.parse()?,
            crc: u32::from_str_radix(crc, 16)?,
        };
        let host = *pictures.entry((scene, variant)).or_insert_with(|| on_host().map(|counted| counted.crc));
        if host != Some(cell.crc) {
            failures.push(format!("{cell}: not the host's picture, which is {host:08x?}"));
        }
        cells.push(cell);
    }
    Ok(cells)
}
