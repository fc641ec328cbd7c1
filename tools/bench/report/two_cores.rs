//! Instructions of each core when two draw one frame, and the page of them: `docs/cores.md`.

use crate::bands::Lines;
use crate::core::{Core, CORES};
use crate::cross::BENCH;
use crate::grouped::grouped;
use crate::page::BUILT;
use crate::Result;
use std::fmt::Write;

/// The most that a frame by two cores may take of one core's instructions.
const MOST: f64 = 0.62;

/// The results by core, scene and way.
pub(crate) struct Frame {
    core: &'static str,
    scene: &'static str,
    way: &'static str,
    one: u64,
    first: u64,
    second: u64,
    frame: u64,
}

impl Frame {
    fn share(&self) -> f64 {
        self.frame as f64 / self.one as f64
    }
}

/// The code of these cores, run on two Cortex-M33.
fn cores() -> impl Iterator<Item = Core> {
    CORES.into_iter().filter(|core| matches!(core.name, "M0" | "M3"))
}

/// Runs the firmware, which fails if the picture of two cores differs from that of one. `host` has the host's checksums.
pub(crate) fn measure(host: &Lines, failures: &mut Vec<String>) -> Result<Vec<Frame>> {
    let mut frames = Vec::new();
    for core in cores() {
        core.build().cargo_in(&format!("{BENCH}/cores"), "build", &[])?;
        let mut lines = Lines::new();
        crate::bands::parse(&core.run_on("two-M33", &core.build().image("two_cores"))?, &mut lines)?;
        for scene in ["S3", "S4"] {
            for way in ["solid", "depth"] {
                let part = |part: &str| -> Result<u64> {
                    let (instructions, crc) =
                        lines.get(&format!("{scene},{way},{part}")).ok_or("a line for each part")?;
                    if host.get(&format!("{scene},{way},band16")).map(|line| &line.1) != Some(crc) {
                        return Err(format!("{scene},{way} by two cores: not the host's picture").into());
                    }
                    Ok(*instructions)
                };
                let (one, first, second) = (part("one")?, part("first")?, part("second")?);
                let frame = Frame { core: core.name, scene, way, one, first, second, frame: part("frame")? };
                if frame.share() > MOST {
                    failures.push(format!(
                        "{scene},{way},{}: two cores take {:.3} of one core's instructions, {MOST} are allowed",
                        core.name,
                        frame.share()
                    ));
                }
                frames.push(frame);
            }
        }
    }
    Ok(frames)
}

const HEAD: &str = "\
# Two cores

What each of two cores takes of a frame. This page is written by

```sh
tools/bench/run cores
```

and CI runs it with `--check`: the check fails where a frame by two cores takes more than 0.62 of one core's instructions, where its picture is
not that of one core or, with the same compiler, a figure is not within 2 % of this page's. ";

const TABLE: &str = "
The frames are those of [bands.md](bands.md), in bands of 16 rows: the first core has the even bands, the second the odd ones. Vertices and
culling are divided in halves; placing the mesh and sorting the visible faces are left to the first core. *Frame* is the time until both are
done, in instructions: of each stage that both do at once, the longer part counts, so it includes what one core waits for the other. Not
included are starting the second core and passing work to it, some 50 instructions for each of three stages.

Instructions of a core are counted while the other one waits, each part by itself: an emulator that runs two cores has one clock for both. The code is
that of an M0 and an M3, on QEMU's mps2-an521, which has two Cortex-M33. There both cores then draw the frames together, with the even and the odd
bands, and (M3) with bands from a counter: each picture has the checksum of one core's. Instructions are not cycles: on a chip both cores share memory.

| scene | code for | one core | first core | second core | frame | frame / one core |
|---|---|--:|--:|--:|--:|--:|
";

pub(crate) fn text(compiler: &str, frames: &[Frame]) -> String {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{TABLE}");
    for frame in frames {
        let what = match frame.scene {
            "S3" => "S3, torus, 1000 triangles",
            _ => "S4, sphere, 5780 triangles",
        };
        let depth = if frame.way == "depth" { "depth" } else { "no depth" };
        let [one, first, second, both] = [frame.one, frame.first, frame.second, frame.frame].map(grouped);
        let _ = writeln!(
            text,
            "| {what}, {depth} | {} | {one} | {first} | {second} | {both} | {:.3} |",
            frame.core,
            frame.share()
        );
    }
    text
}
