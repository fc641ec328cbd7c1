//! Shaders of one's own: a perspective-correct checkerboard, fog by depth, and glass that blends with what is there.
//!
//! `cargo run --release --example shader` writes `target/shader/shader.png`. `tests/shading` compares each pixel with an
//! oracle.

mod scene;
mod shaders;

use pinhole_apps_support::still;
use std::error::Error;
use std::fs;

fn main() -> Result<(), Box<dyn Error>> {
    let file = still::png(scene::SIZE, &scene::draw()?)?;
    fs::create_dir_all("target/shader")?;
    fs::write("target/shader/shader.png", file)?;
    println!("target/shader/shader.png");
    Ok(())
}
