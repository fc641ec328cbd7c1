//! What the measuring firmwares share. They also run on the host, where they count nothing and draw the same pictures:
//! `report` compares the two.
#![cfg_attr(target_os = "none", no_std)]

pub mod board;
#[allow(dead_code)] // shared with the examples, which use more of it
#[path = "../../../examples/show/canvas.rs"]
mod canvas;
pub mod frames;
pub mod image;
pub mod scene;
pub mod stack;

/// A program over a memory of its own, which lies in a static: the linker says so if it does not fit.
#[macro_export]
macro_rules! firmware {
    ($memory:ty, $run:expr) => {
        #[cfg(target_os = "none")]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            static mut MEMORY: $memory = <$memory>::NEW;
            let run: fn(&mut $memory) -> Option<()> = $run;
            $crate::board::end(run(MEMORY).is_some())
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            let run: fn(&mut $memory) -> Option<()> = $run;
            $crate::board::end(run(&mut Box::new(<$memory>::NEW)).is_some())
        }
    };
}
