//! What the measuring firmwares share. They also run on the host, where they count nothing and draw the same pictures:
//! `report` compares the two.
#![cfg_attr(target_os = "none", no_std)]

pub mod bands;
pub mod board;
pub mod cells;
pub mod frames;
pub mod image;
pub mod lists;
pub mod measure;
pub mod profile;
pub mod scene;
pub mod stack;

/// A program over variables, each in a static of its own: the linker says so if they do not fit, and those that start
/// with zeros take no flash.
#[macro_export]
macro_rules! firmware {
    ($($name:ident: $type:ty = $start:expr,)* $body:block) => {
        fn run($($name: &mut $type),*) -> Option<()> $body

        #[cfg(target_os = "none")]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            $(
                #[allow(non_upper_case_globals)] // the name is the argument's
                static mut $name: $type = $start;
            )*
            $crate::stack::paint();
            let good = run($($name),*).is_some();
            $crate::board::end_with_stack(good)
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            $crate::board::end(run($(&mut *Box::<$type>::new($start)),*).is_some())
        }
    };
}
