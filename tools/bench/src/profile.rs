//! Where the instructions of depth-tested faces go: scenes that have more of one thing and less of another. A line
//! holds the instructions of a draw, clears excluded, and what it was asked to do: `report` fits the one to the other.

use crate::board::{println, Clock};
use crate::frames::Memory;
use crate::measure::Named;
use crate::scene::Scene;
use crate::tally::Tally;
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Cull, DepthBuffer, Picture};

/// Lines `scene,instructions,vertices,culled,drawn,rows,tested,runs,written`.
pub fn depth(scenes: &[Named], sizes: &[u32], memory: &mut Memory) -> Option<()> {
    let mut clock = Clock::new()?;
    for (name, model) in scenes {
        for &size in sizes {
            case(name, &Scene::sized(model, size)?, size, Cull::Back, memory, &mut clock)?;
            case(name, &Scene::sized(model, size)?, size, Cull::None, memory, &mut clock)?;
        }
        case(name, &Scene::new(model)?.without_faces()?, 8, Cull::Back, memory, &mut clock)?;
    }
    Some(())
}

#[inline(never)]
fn case(
    name: &str,
    scene: &Scene,
    size: u32,
    cull: Cull,
    memory: &mut Memory,
    clock: &mut Clock,
) -> Option<()> {
    let light = scene.light()?;
    let Memory { pixels, depth, corners } = memory;
    let size = Size::new(size, size);
    let area = Rectangle::new(Point::zero(), size);
    let mut picture = Picture::new(pixels, size).ok()?;
    let mut buffer = DepthBuffer::new(area, depth).ok()?;
    let mut statistics = Default::default();
    let instructions = clock.count(&mut || {
        let placed = black_box(scene).place().with_cull(cull);
        let Ok(counts) =
            placed.depth_tested(scene.shade(&light), corners, &mut buffer, &mut picture.pixels());
        statistics = counts;
    })?;
    let placed = scene.place().with_cull(cull);
    let tally = || Tally { size, runs: 0, pixels: 0 };
    let (mut rows, mut seen) = (tally(), tally());
    let Ok(_) = placed.solid(scene.shade(&light), corners, &mut rows);
    let mut buffer = DepthBuffer::new(area, depth).ok()?;
    let Ok(_) = placed.depth_tested(scene.shade(&light), corners, &mut buffer, &mut seen);
    let (vertices, culled, drawn) = (placed.mesh().vertices().len(), statistics.culled, statistics.drawn);
    println!(
        "{name},{instructions},{vertices},{culled},{drawn},{},{},{},{}",
        rows.runs, rows.pixels, seen.runs, seen.pixels
    );
    Some(())
}
