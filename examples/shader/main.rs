//! Custom shaders: a perspective-correct checkerboard, depth fog, and glass that blends with the stored pixels.
//!
//! `cargo run --release --example shader` writes `target/shader/shader.png`. `tests/shading` compares each pixel with an
//! oracle in f64.

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
