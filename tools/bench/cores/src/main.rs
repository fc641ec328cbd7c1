//! Frames of scenes S3 and S4 by two cores: one transformed and binned mesh, each core its bands of 16 rows.
//!
//! First the second core waits, and the first one does each core's part alone: these instructions are counted. Then both cores
//! run, and the picture must have the checksum of one core's. Lines are `scene,way,part,instructions,crc`: *one* is the frame on
//! one core, *first* and *second* are each core's part, and *frame* is the time of the frame: of what both do at once, the longer
//! part counts.
#![no_std]
#![no_main]

mod board;
#[path = "../../../../boards/rp2040-two-cores/src/both_cores.rs"]
mod both_cores;
mod frames;

use bench::bands::{bytes, pixels, LitFrame, Storage};
use bench::board::{end, println};
use bench::measure::Display;
use bench::scene::{Model, Scene, ICO, SIZE, TORUS};
use board::{start_second, Clock, STACK};
use both_cores::OtherCore;
use core::hint::black_box;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use frames::{Cores, Memory, Solid, Way, WithDepth, ROWS};
use pinhole::{camera::ScreenVertex, light::Lambert};

/// Bytes of a row.
const ROW: usize = bytes(1);

/// A frame's pixels as both cores store them, four bytes in a word.
type Pixels = [AtomicU32; bytes(SIZE) / 4];

/// Both parts on the first core, one after the other, and counted.
struct Counted<'c> {
    clock: &'c Clock,
    /// The instructions of the second core's parts, and those for which the first core waits for it.
    second: u32,
    waits: u32,
}

impl Cores for Counted<'_> {
    fn both(&mut self, ours: impl FnOnce(), theirs: impl FnOnce() + Send) {
        let ours = self.clock.count(ours);
        let theirs = self.clock.count(theirs);
        self.second += theirs;
        self.waits += theirs.saturating_sub(ours);
    }
}

impl Cores for OtherCore {
    fn both(&mut self, ours: impl FnOnce(), theirs: impl FnOnce() + Send) {
        OtherCore::both(self, ours, theirs);
    }
}

struct Case {
    scene: Scene,
    light: Lambert,
}

impl Case {
    fn new(model: &'static Model) -> Option<Self> {
        let scene = Scene::new(model)?;
        Some(Self { light: scene.light()?, scene })
    }

    /// Its checksum, when one core draws it.
    fn checksum<W: Way>(&self, memory: &mut Memory) -> Option<u32> {
        let mut good = None;
        let crc = Display::default().look(&mut |display| good = self.one(W::ONE, memory, display));
        good.map(|()| crc)
    }

    #[inline(never)]
    fn one(&self, one: LitFrame, memory: &mut Memory, display: &mut Display) -> Option<()> {
        let Memory { corners, bin_storage, strips: [strip, _], depths: [depth, _], .. } = memory;
        one(
            black_box(&self.scene),
            black_box(&self.light),
            Storage { corners, bin_storage, strip, depth },
            display,
        )
    }

    /// Prints the instructions of each core's part: no other core runs.
    fn count<W: Way>(&self, name: &str, memory: &mut Memory, clock: &Clock) -> Option<()> {
        let crc = self.checksum::<W>(memory)?;
        let (mut good, mut display) = (None, Display::default());
        let alone = clock.count(|| good = self.one(W::ONE, memory, &mut display));
        good?;
        let mut cores = Counted { clock, second: 0, waits: 0 };
        let take = |_: u32, bytes: &[u8]| {
            black_box(bytes);
        };
        let all = clock.count(|| {
            good = W::frame(black_box(&self.scene), black_box(&self.light), memory, &mut cores, &take);
        });
        good?;
        let Counted { second, waits, .. } = cores;
        let first = all - second;
        for (part, instructions) in
            [("one", alone), ("first", first), ("second", second), ("frame", first + waits)]
        {
            println!("{name},{},{part},{instructions},{crc:08x}", W::NAME);
        }
        Some(())
    }

    /// Draws a frame by both cores. `None` unless it has the checksum of one core's.
    fn draw<W: Way>(&self, memory: &mut Memory, other: &mut OtherCore, pixels: &Pixels) -> Option<()> {
        pixels.iter().for_each(|word| word.store(!0, Relaxed));
        let take = |index: u32, band: &[u8]| {
            let words = pixels.iter().skip(index as usize * bytes(ROWS) / 4);
            for (word, bytes) in words.zip(band.as_chunks().0) {
                word.store(u32::from_ne_bytes(*bytes), Relaxed);
            }
        };
        W::frame(&self.scene, &self.light, memory, other, &take)?;
        let crc = Display::default().look(&mut |display| {
            for words in pixels.chunks(ROW / 4) {
                let mut row = [0; ROW];
                for (bytes, word) in row.as_chunks_mut().0.iter_mut().zip(words) {
                    *bytes = word.load(Relaxed).to_ne_bytes();
                }
                display.take_bytes(&row);
            }
        });
        (crc == self.checksum::<W>(memory)?).then_some(())
    }
}

fn run(memory: &mut Memory, pixels: &Pixels) -> Option<()> {
    let clock = Clock::new()?;
    let scenes = || [("S3", &TORUS), ("S4", &ICO)];
    for (name, model) in scenes() {
        let case = Case::new(model)?;
        case.count::<Solid>(name, memory, &clock)?;
        case.count::<WithDepth>(name, memory, &clock)?;
    }
    let start = || {
        start_second();
        Ok::<(), ()>(())
    };
    let mut other = OtherCore::new(start).ok()?;
    for (_, model) in scenes() {
        let case = Case::new(model)?;
        case.draw::<Solid>(memory, &mut other, pixels)?;
        case.draw::<WithDepth>(memory, &mut other, pixels)?;
    }
    // As `boards/rp2040-two-cores` reserves it, with a quarter to spare; less than a KB would not be a drawing.
    (1024..=3072).contains(&STACK.used()).then_some(())
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory {
        corners: [ScreenVertex::EMPTY; frames::VERTICES],
        bin_storage: [0; frames::BIN_STORAGE],
        cursor: [0; frames::CURSOR],
        strips: [[0; bytes(ROWS)]; 2],
        depths: [[0; pixels(ROWS)]; 2],
    };
    static PIXELS: Pixels = [const { AtomicU32::new(0) }; bytes(SIZE) / 4];
    end(run(MEMORY, &PIXELS).is_some())
}
