//! `targets.txt`: the targets of the cells.

use crate::cells::{split, Cell, FAST};
use crate::Result;
use bench::cells::USER_CELLS;

const TARGETS: &str = include_str!("../targets.txt");

/// A target of a cell, in instructions a frame.
pub(crate) struct Target {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    pub(crate) core: &'static str,
    pub(crate) target: u64,
    pub(crate) stretch: u64,
    /// The best rival.
    pub(crate) rival: &'static str,
    pub(crate) best: u64,
    /// The instructions of embedded-3dgfx.
    pub(crate) gfx: u64,
}

impl Target {
    /// Whether a number of instructions is at most 1.12 times the target, the limit of every cell.
    pub(crate) const fn is_near(&self, instructions: u64) -> bool {
        instructions * 100 <= self.target * 112
    }
}

/// A target that need not be reached yet: nothing fails beyond it.
pub(crate) struct Open {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    pub(crate) level: &'static str,
    pub(crate) core: &'static str,
    pub(crate) target: u64,
    pub(crate) stretch: u64,
    /// The best rival that was measured once on this cell.
    pub(crate) rival: Option<(&'static str, u64)>,
}

impl Open {
    /// Whether the cell is one of those for which nothing else is a target.
    pub(crate) fn is_user_cell(&self) -> bool {
        USER_CELLS.iter().any(|cell| (cell.0, cell.1) == (self.scene, self.variant))
            || matches!(self.scene, "T1" | "F50")
    }
}

/// How many times the instructions of one piece a frame in bands may take; nothing fails beyond it.
pub(crate) struct Times {
    pub(crate) scene: &'static str,
    pub(crate) variant: &'static str,
    pub(crate) core: &'static str,
    pub(crate) target: f64,
    pub(crate) stretch: f64,
}

/// The lines that do not begin with `#`, as words; of those that begin with this word the rest.
fn lines(first: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let lines = TARGETS.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(' ').collect::<Vec<_>>()).filter_map(move |words| {
        let marked = ["open", "times"].contains(&words[0]);
        match first.is_empty() {
            true => (!marked).then_some(words),
            false => words.strip_prefix(&[first]).map(<[_]>::to_vec),
        }
    })
}

fn unread(words: &[&str]) -> Box<dyn std::error::Error> {
    format!("targets.txt: {}", words.join(" ")).into()
}

pub(crate) fn open() -> Result<Vec<Open>> {
    let open = |words: Vec<&'static str>| {
        let [scene, variant, core, target, stretch, ref rival @ ..] = words[..] else {
            return Err(unread(&words));
        };
        let (variant, level) = split(variant);
        let rival = match *rival {
            [] => None,
            [name, count] => Some((name, count.parse()?)),
            _ => return Err(unread(&words)),
        };
        let (target, stretch) = (target.parse()?, stretch.parse()?);
        Ok(Open { scene, variant, level, core, target, stretch, rival })
    };
    lines("open").map(open).collect()
}

pub(crate) fn times() -> Result<Vec<Times>> {
    let times = |words: Vec<&'static str>| {
        let [scene, variant, core, target, stretch] = words[..] else { return Err(unread(&words)) };
        Ok(Times { scene, variant, core, target: target.parse()?, stretch: stretch.parse()? })
    };
    lines("times").map(times).collect()
}

/// One for each of the 33 cells.
pub(crate) fn targets() -> Result<Vec<Target>> {
    let target = |fields: Vec<&'static str>| {
        let [scene, variant, core, target, stretch, rival, best, gfx] = fields[..] else {
            return Err(unread(&fields));
        };
        let (target, stretch) = (target.parse()?, stretch.parse()?);
        Ok(Target { scene, variant, core, target, stretch, rival, best: best.parse()?, gfx: gfx.parse()? })
    };
    lines("").map(target).collect()
}

/// Fails for each of the cells that is beyond 1.12 times its target, whatever the compiler.
pub(crate) fn limit(cells: &[Cell], targets: &[Target], failures: &mut Vec<String>) {
    for Cell { scene, variant, core, instructions, .. } in cells.iter().filter(|cell| cell.level == FAST) {
        let of = targets.iter().find(|of| (of.scene, of.variant, of.core) == (*scene, *variant, core.name));
        if let Some(of) = of.filter(|of| !of.is_near(*instructions)) {
            failures.push(format!(
                "{scene} {variant} {}: {instructions} instructions, beyond 1.12 times the target, {}",
                core.name, of.target
            ));
        }
    }
}
