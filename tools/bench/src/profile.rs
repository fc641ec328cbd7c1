//! Where the instructions of depth-tested faces go: scenes that have more of one thing and less of another. A line
//! holds the instructions of a draw, clears excluded, and what it was asked to do: `report` fits the one to the other.

use crate::board::{println, Clock};
use crate::frames::Memory;
use crate::measure::Named;
use crate::scene::{Model, Scene, SIZE};
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::{Cull, DepthBuffer, Picture};

/// Counts what is drawn on it.
struct Tally {
    size: Size,
    runs: u32,
    pixels: u32,
}

impl OriginDimensions for Tally {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Tally {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        self.runs += 1;
        self.pixels += area.size.width;
        Ok(())
    }
}

/// The faces of a scene that are drawn, and the pixels that they cover together.
pub fn covered(model: &'static Model) -> Option<[u32; 2]> {
    let scene = Scene::new(model)?;
    let light = scene.light()?;
    let mut tally = Tally { size: Size::new(SIZE, SIZE), runs: 0, pixels: 0 };
    let Ok(statistics) = scene.place().solid(scene.shade(&light), &mut [], &mut tally);
    Some([statistics.drawn, tally.pixels])
}

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
