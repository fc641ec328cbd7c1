//! The emulated cores, and the images that are built for them.

use crate::cross::Build;
use crate::{Result, M0, M3, RV32};
use std::path::Path;
use std::process::{Command, Stdio};

/// At opt-level 3, the level for speed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Core {
    pub(crate) name: &'static str,
    target: &'static str,
}

pub(crate) const CORES: [Core; 4] = [
    Core { name: "M0", target: M0 },
    Core { name: "M3", target: M3 },
    Core { name: "M4F", target: "thumbv7em-none-eabihf" },
    Core { name: "RV32", target: RV32 },
];

impl Core {
    pub(crate) const fn build(self) -> Build {
        Build { target: self.target, level: "3" }
    }

    /// Runs a firmware and returns its output.
    pub(crate) fn run(self, image: &Path) -> Result<String> {
        self.run_on(self.name, image)
    }

    /// Runs a firmware for this core on a board of `tools/bench/emulate` and returns its output.
    pub(crate) fn run_on(self, board: &str, image: &Path) -> Result<String> {
        let output = emulate(board, image).output()?;
        let (printed, console) = (String::from_utf8(output.stdout)?, String::from_utf8_lossy(&output.stderr));
        if !output.status.success() {
            let image = image.display();
            return Err(format!("{image} on {board}: {}\n{printed}{console}", output.status).into());
        }
        Ok(printed)
    }

    /// The board of this core; further arguments are QEMU's.
    pub(crate) fn emulate(self, image: &Path) -> Command {
        emulate(self.name, image)
    }
}

/// The emulated core of this name.
pub(crate) fn emulated(name: &str) -> Result<Core> {
    Ok(CORES.into_iter().find(|core| core.name == name).ok_or_else(|| format!("no core {name}"))?)
}

fn emulate(board: &str, image: &Path) -> Command {
    let mut command = Command::new("bash");
    command.arg("emulate").arg(board).arg(image);
    command.current_dir(crate::cross::BENCH).stdin(Stdio::null());
    command
}
