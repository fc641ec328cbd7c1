//! `docs/profile.md`.

use crate::page::{grouped, BUILT};
use crate::profile::Profile;
use crate::stages::{Stage, STAGES};
use crate::targets::Target;
use crate::Result;
use bench::tally::{units, Units};
use std::fmt::Write;

pub(crate) fn text(compiler: &str, profiles: &[Profile], targets: &[Target]) -> Result<String> {
    let mut text = format!("{BUILT}{compiler}.\n");
    for p in profiles {
        let u = units(p.cell.scene).unwrap();
        let _ = writeln!(text, "{} {} {} {:?}", p.cell.scene, p.cell.variant, p.cell.core.name, u);
        for s in STAGES {
            let _ = writeln!(text, "   {s:?} {} ", p.of(s));
        }
    }
    Ok(text)
}
