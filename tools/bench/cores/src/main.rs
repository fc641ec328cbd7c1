//! Scene S3 with depth by two cores: one transformed and binned mesh, each core its bands of 16 rows. The picture must have the checksum
//! of one core's, several times over. `tools/bench/run bands` counts the instructions of both on one core.
#![no_std]
#![no_main]

mod board;
#[path = "../../../../boards/rp2040-two-cores/src/both_cores.rs"]
mod both_cores;

use bench::board::end;
use bench::cells::{Both, TwoCores, TORUS, TORUS_BINS};
use bench::measure::Display;
use bench::scene::{Scene, TORUS as MODEL};
use board::{start_second, STACK};
use both_cores::OtherCore;

type Memory = TwoCores<TORUS_BINS, TORUS>;

/// The checksum of a frame.
fn checksum(memory: &mut Memory, scene: &Scene, both: Both<'_>) -> Option<u32> {
    let (light, mut good) = (scene.light()?, None);
    let crc = Display::default().look(&mut |display| good = memory.frame(scene, &light, display, both));
    good.map(|()| crc)
}

fn run(memory: &mut Memory) -> Option<()> {
    let scene = Scene::new(&MODEL)?;
    let alone = checksum(memory, &scene, &mut |_, first, second| {
        first();
        second();
    })?;
    let start = || {
        start_second();
        Ok::<(), ()>(())
    };
    let mut other = OtherCore::new(start).ok()?;
    for _ in 0..8 {
        let by_both = checksum(memory, &scene, &mut |_, first, second| other.both(first, second))?;
        (by_both == alone).then_some(())?;
    }
    // As `boards/rp2040-two-cores` reserves it, with a quarter to spare; less than half a KB would not be a drawing.
    (512..=3072).contains(&STACK.used()).then_some(())
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::NEW;
    end(run(MEMORY).is_some())
}
