//! Frames as a user's firmware draws them, to be timed: the object is placed, the picture cleared, and everything drawn into
//! bands or into a whole picture.

use crate::bands;
use crate::board::{println, Clock};
use crate::measure::Display;
use crate::scene::{area, Model, Scene, BACKGROUND, CUBE, LINE, SIZE, TORUS};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Rgb565;
use pinhole::{DepthBuffer, Lambert, Picture, ScreenVertex};

const PIXELS: usize = (SIZE * SIZE) as usize;
/// Of the torus.
const CORNERS: usize = 500;

/// Memory for a whole frame and for bands.
pub struct Memory {
    pixels: [Rgb565; PIXELS],
    depth: [u16; PIXELS],
    corners: [ScreenVertex; CORNERS],
    bands: bands::Memory,
}

impl Memory {
    pub const NEW: Self = Self {
        pixels: [BACKGROUND; PIXELS],
        depth: [0; PIXELS],
        corners: [ScreenVertex::EMPTY; CORNERS],
        bands: bands::Memory::NEW,
    };
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    Wireframe,
    Plain,
    Depth,
}

impl Variant {
    /// The name of the cell's variant that draws so.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wireframe => "wire",
            Self::Plain => "plain",
            Self::Depth => "z",
        }
    }
}

/// The scene and the way it is drawn.
pub struct Timed {
    pub scene: &'static str,
    pub variant: Variant,
    pub model: &'static Model,
}

pub const TIMED: [Timed; 5] = [
    Timed { scene: "S1", variant: Variant::Wireframe, model: &CUBE },
    Timed { scene: "S2", variant: Variant::Plain, model: &CUBE },
    Timed { scene: "S2", variant: Variant::Depth, model: &CUBE },
    Timed { scene: "S3", variant: Variant::Plain, model: &TORUS },
    Timed { scene: "S3", variant: Variant::Depth, model: &TORUS },
];

/// The images: how many rows a band has, or the picture as a whole.
pub const IMAGES: [(&str, Option<u32>); 3] =
    [("timed_8", Some(8)), ("timed_16", Some(16)), ("timed_whole", None)];

impl Timed {
    /// Sets the scene up and hands `draw` what draws a frame of it.
    fn set_up<T>(
        &self,
        rows: Option<u32>,
        memory: &mut Memory,
        draw: impl FnOnce(&mut dyn FnMut(&mut Display)) -> T,
    ) -> Option<T> {
        let scene = Scene::new(self.model)?;
        let light = scene.light()?;
        let mut good = true;
        let drawn = draw(&mut |display| {
            let (scene, light) = (black_box(&scene), black_box(&light));
            good &= match rows {
                Some(rows) => self.in_bands(scene, light, rows, memory, display),
                None => self.whole(scene, light, memory, display),
            }
            .is_some();
        });
        good.then_some(drawn)
    }

    /// The instructions of a frame.
    pub fn count(&self, rows: Option<u32>, memory: &mut Memory, clock: &mut Clock) -> Option<u32> {
        let mut display = Display::default();
        self.set_up(rows, memory, |frame| clock.count(&mut || frame(&mut display)))?
    }

    /// The CRC-32 of its pixels.
    pub fn checksum(&self, rows: Option<u32>, memory: &mut Memory) -> Option<u32> {
        self.set_up(rows, memory, |frame| Display::default().look(frame))
    }

    fn in_bands(
        &self,
        scene: &Scene,
        light: &Lambert,
        rows: u32,
        memory: &mut Memory,
        display: &mut Display,
    ) -> Option<()> {
        let storage = memory.bands.rows(rows)?;
        match self.variant {
            Variant::Wireframe => bands::wireframe(scene, LINE, storage, display),
            Variant::Plain => bands::solid(scene, light, storage, display),
            Variant::Depth => bands::depth(scene, light, storage, display),
        }
    }

    fn whole(
        &self,
        scene: &Scene,
        light: &Lambert,
        Memory { pixels, depth, corners, .. }: &mut Memory,
        display: &mut Display,
    ) -> Option<()> {
        let mut picture = Picture::new(pixels, black_box(Size::new(SIZE, SIZE))).ok()?;
        let Ok(()) = picture.clear(BACKGROUND);
        let instance = scene.place();
        let drawn = match self.variant {
            Variant::Wireframe => instance.wireframe(LINE, corners, &mut picture.pixels()).map(|_| ()),
            Variant::Plain => instance.solid(scene.shade(light), corners, &mut picture.pixels()).map(|_| ()),
            Variant::Depth => {
                let mut depth = DepthBuffer::new(area(), depth).ok()?;
                instance
                    .depth_tested(scene.shade(light), corners, &mut depth, &mut picture.pixels())
                    .map(|_| ())
            }
        };
        let Ok(()) = drawn;
        display.take_pixels(pixels);
        Some(())
    }
}

/// Prints the instructions of each of [`TIMED`], a line each, then their checksums: what is counted comes first, so that who records
/// it need not wait for the rest.
pub fn print(rows: Option<u32>, memory: &mut Memory, clock: &mut Clock) -> Option<()> {
    for timed in &TIMED {
        println!("{}", timed.count(rows, memory, clock)?);
    }
    for timed in &TIMED {
        println!("{:08x}", timed.checksum(rows, memory)?);
    }
    Some(())
}
