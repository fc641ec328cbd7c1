//! Instructions of each core when two draw one frame.

use crate::core::{run, CORES};
use crate::data;
use crate::{Result, CELL};
use serde_json::{json, Value};

/// The most that a frame by two cores may take of one core's instructions.
const MOST: f64 = 0.62;

/// Runs the firmware, which fails if the picture of two cores differs from that of one, with the code for an M0 and for an M3 on two
/// Cortex-M33. The picture must be that of the cells.
pub(crate) fn rows(failures: &mut Vec<String>) -> Result<Vec<Value>> {
    let (mut rows, cells) = (Vec::new(), data::read("cells")?);
    for core in CORES.into_iter().filter(|core| ["M0", "M3"].contains(&core.name)) {
        core.build().cargo("build", &["--package=cores".into()])?;
        let printed = run("two-M33", &core.build().image("two_cores"))?;
        let lines: Vec<Vec<&str>> = printed.lines().map(|line| line.split(',').collect()).collect();
        // For each scene and way a line for each part.
        for parts in lines.chunk_by(|a, b| a[..2] == b[..2]) {
            let [scene, way, .., crc] = parts[0][..] else { return Err(printed.into()) };
            let variant = if way == "depth" { "z" } else { "plain" };
            let mut row = json!({"scene": scene, "variant": variant, "core": core.name, "crc": crc});
            for part in parts {
                row[part[2]] = part[3].parse::<u64>()?.into();
            }
            let is_cell = |cell: &&Value| CELL.iter().all(|key| cell[*key] == row[*key]);
            if cells.iter().find(is_cell).is_none_or(|cell| cell["crc"] != crc) {
                failures
                    .push(format!("{scene} {variant} by two cores: not the picture of one core, but {crc}"));
            }
            let [one, frame] = ["one", "frame"].map(|part| row[part].as_f64().unwrap_or(f64::NAN));
            let share = frame / one;
            if share.is_nan() || share > MOST {
                failures.push(format!(
                    "{scene} {variant} {}: two cores take {share:.4} of one core's instructions, {MOST} are allowed",
                    core.name
                ));
            }
            rows.push(row);
        }
    }
    Ok(rows)
}
