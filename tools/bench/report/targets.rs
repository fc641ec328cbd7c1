//! `targets.txt`: what each cell is measured against.

use crate::cells::Cell;
use crate::Result;

const TARGETS: &str = include_str!("../targets.txt");

/// In instructions a frame.
pub(crate) struct Target {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    pub(crate) core: &'static str,
    pub(crate) target: u64,
    pub(crate) stretch: u64,
    /// The best rival.
    pub(crate) rival: &'static str,
    pub(crate) best: u64,
    /// Of embedded-3dgfx.
    pub(crate) gfx: u64,
}

impl Target {
    /// Whether a number of instructions is at most 1.12 times the target, the limit of every cell.
    pub(crate) const fn is_near(&self, instructions: u64) -> bool {
        instructions * 100 <= self.target * 112
    }
}

/// One for each of the 33 cells.
pub(crate) fn targets() -> Result<Vec<Target>> {
    let lines = TARGETS.lines().filter(|line| !line.starts_with('#'));
    let target = |line: &'static str| {
        let fields: Vec<&'static str> = line.split(' ').collect();
        let [scene, variant, core, target, stretch, rival, best, gfx] = fields[..] else {
            return Err(format!("targets.txt: {line}").into());
        };
        let (target, stretch) = (target.parse()?, stretch.parse()?);
        Ok(Target { scene, variant, core, target, stretch, rival, best: best.parse()?, gfx: gfx.parse()? })
    };
    lines.map(target).collect()
}

/// Fails for each of the cells that is beyond 1.12 times its target, whatever the compiler.
pub(crate) fn limit(cells: &[Cell], targets: &[Target], failures: &mut Vec<String>) {
    for Cell { scene, variant, core, instructions, .. } in cells {
        let of = targets.iter().find(|of| (of.scene, of.variant, of.core) == (*scene, *variant, core.name));
        if let Some(of) = of.filter(|of| !of.is_near(*instructions)) {
            failures.push(format!(
                "{scene} {variant} {}: {instructions} instructions, beyond 1.12 times the target, {}",
                core.name, of.target
            ));
        }
    }
}
