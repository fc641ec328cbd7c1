//! What the measuring firmwares share. They also run on the host, where they count nothing and draw the same pictures:
//! `report` compares the two.
#![cfg_attr(target_os = "none", no_std)]

pub mod bands;
pub mod board;
pub mod cells;
pub mod growth;
pub mod image;
pub mod measure;
pub mod report;
pub mod scene;
/// How deep the stack was: painted first, looked at afterwards. A file outside of this package, as it needs `unsafe`.
#[cfg(target_os = "none")]
#[path = "../../stack.rs"]
pub mod stack;

/// What S5, S6 and S7 draw, the normals at the torus's vertices for S8, pictures, and what is at vertices. Integers of triangles are
/// corners of pixels, those of lines are pixels.
pub mod lists {
    use embedded_graphics_core::pixelcolor::Rgb565;
    include!(concat!(env!("OUT_DIR"), "/lists.rs"));
}

/// Whether two names are equal: several images are built from one file, and each chooses its part by its name when it is compiled.
pub const fn is_equal(a: &str, b: &str) -> bool {
    let (a, b, mut same) = (a.as_bytes(), b.as_bytes(), 0);
    while same < a.len() && same < b.len() && a[same] == b[same] {
        same += 1;
    }
    same == a.len() && same == b.len()
}

/// A program over variables, each in a static of its own: the linker says so if they do not fit, and those that start
/// with zeros take no flash.
#[macro_export]
macro_rules! firmware {
    ($($name:ident: $type:ty = $start:expr,)* $body:block) => {
        fn run($($name: &mut $type),*) -> Option<()> $body

        #[cfg(all(target_arch = "arm", target_os = "none"))]
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

        // Its entry hands out no references to statics.
        #[cfg(all(target_arch = "riscv32", target_os = "none"))]
        #[riscv_rt::entry]
        fn main() -> ! {
            use core::cell::RefCell;
            use critical_section::Mutex;
            $(
                #[allow(non_upper_case_globals)] // the name is the argument's
                static $name: Mutex<RefCell<$type>> = Mutex::new(RefCell::new($start));
            )*
            $crate::stack::paint();
            let good = critical_section::with(|token| run($(&mut $name.borrow_ref_mut(token)),*).is_some());
            $crate::board::end_with_stack(good)
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            $crate::board::end(run($(&mut *Box::<$type>::new($start)),*).is_some())
        }
    };
}
