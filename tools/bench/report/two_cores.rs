//! Instructions of each core when two draw one frame.

use crate::core::CORES;
use crate::data::{self, row, Row};
use crate::Result;
use serde_json::json;
use std::collections::BTreeMap;

/// The most that a frame by two cores may take of one core's instructions.
const MOST: f64 = 0.62;

/// Runs the firmware, which fails if the picture of two cores differs from that of one, with the code for an M0 and for an M3 on two
/// Cortex-M33. The picture must be that of the cells.
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<Vec<Row>> {
    let (mut rows, cells) = (Vec::new(), data::read("cells")?);
    for core in CORES.into_iter().filter(|core| ["M0", "M3"].contains(&core.name)) {
        core.build().cargo("build", &["--package=cores".into()])?;
        let printed = core.run_on("two-M33", &core.build().image("two_cores"))?;
        let mut lines = BTreeMap::new();
        for line in printed.lines() {
            let fields: Vec<&str> = line.split(',').collect();
            let [scene, way, part, instructions, crc] = fields[..] else { return Err(line.into()) };
            lines.insert((scene, way, part), (instructions.parse::<u64>()?, crc));
        }
        for (scene, way, variant) in
            [("S3", "solid", "plain"), ("S3", "depth", "z"), ("S4", "solid", "plain"), ("S4", "depth", "z")]
        {
            let part = |part: &'static str| lines.get(&(scene, way, part)).copied().ok_or(part);
            let [one, first, second, frame] =
                [part("one")?, part("first")?, part("second")?, part("frame")?].map(|line| line.0);
            let crc = json!(part("frame")?.1);
            let is_cell =
                |row: &&Row| row["scene"] == scene && row["variant"] == variant && row["core"] == core.name;
            if cells.iter().find(is_cell).and_then(|row| row.get("crc")) != Some(&crc) {
                failures
                    .push(format!("{scene} {variant} by two cores: not the picture of one core, but {crc}"));
            }
            let share = frame as f64 / one as f64;
            if share > MOST {
                failures.push(format!(
                    "{scene} {variant} {}: two cores take {share:.4} of one core's instructions, {MOST} are allowed",
                    core.name
                ));
            }
            rows.push(row(
                json!({"scene": scene, "variant": variant, "core": core.name, "one": one, "first": first,
                "second": second, "frame": frame, "crc": crc}),
            ));
        }
    }
    Ok(rows)
}
