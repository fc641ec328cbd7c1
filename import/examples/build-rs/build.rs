//! Makes `$OUT_DIR/block.rs` of `block.stl`.

use pinhole_import::{build, Edges, Options};
use std::path::Path;

fn main() {
    // z is up, as in STL files that nothing else is said of; the unit is a millimetre: 40 wide, 20 deep, 10 high.
    let options = Options { fit: Some(2.0), edges: Edges::Feature { degrees: 30.0 }, ..Options::default() };
    build(Path::new("block.stl"), "BLOCK", &options);
}
