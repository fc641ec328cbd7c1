//! Instructions a vertex, and whether a device computes what the host does.

use crate::{about, cross, Result};
use designs::count::{count, Counted, COUNT};

/// A core's name and its compiler target.
pub(crate) const CORES: [(&str, &str); 4] = [
    ("M0", "thumbv6m-none-eabi"),
    ("M3", "thumbv7m-none-eabi"),
    ("M4F", "thumbv7em-none-eabihf"),
    ("RV32", "riscv32imc-unknown-none-elf"),
];

/// Instructions a vertex of every design, in the order of [`about::ALL`].
pub(crate) fn measure() -> Result<Vec<[f64; CORES.len()]>> {
    let mut host: Vec<Counted> = Vec::new();
    count(&mut |counted| host.push(counted)).ok_or("a design fails on the host")?;
    if !host.iter().map(|counted| counted.id).eq(about::ALL.iter().map(|about| about.id)) {
        return Err("the designs and what the page says of them differ".into());
    }
    cross::build("count", &CORES.map(|(_, target)| target))?;
    let mut speeds = vec![[0.0; CORES.len()]; host.len()];
    for (core, (name, target)) in CORES.into_iter().enumerate() {
        let printed = cross::run("count", target)?;
        if printed.lines().count() != host.len() {
            return Err(format!("{name} prints {} designs", printed.lines().count()).into());
        }
        for ((line, host), speed) in printed.lines().zip(&host).zip(&mut speeds) {
            let [id, instructions, checksum] = line.split(',').collect::<Vec<_>>()[..] else {
                return Err(format!("{name} prints {line}").into());
            };
            if id != host.id || checksum != format!("{:08x}", host.checksum) {
                return Err(format!("{name} computes {line}, the host {host:?}").into());
            }
            speed[core] = instructions.parse::<f64>()? / COUNT as f64;
        }
    }
    Ok(speeds)
}
