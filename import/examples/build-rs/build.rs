//! Makes `$OUT_DIR/block.rs` of `block.stl`.

use pinhole_import::{build, Axis, Edges, Options};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The file has z upwards and is in millimetres: 40 wide, 20 deep, 10 high.
    let options = Options {
        up: Axis::Z,
        fit: Some(2.0),
        edges: Edges::Feature { degrees: 30.0 },
        ..Options::default()
    };
    build(Path::new("block.stl"), "BLOCK", &options)?;
    Ok(())
}
