//! Every drawing entry of pinhole, exported with inputs the compiler knows nothing about, and a panic handler that calls
//! a function which exists nowhere: if the library asks for that function, a panic is reachable. `check` looks.
//!
//! An entry is not fit to be called; it only has to be compiled. With panic = "unwind" (clippy and the like) the crate is
//! an ordinary one, for there a panic handler of its own would need more than stable Rust has.
#![cfg_attr(panic = "abort", no_std)]

#[path = "../../../examples/show/canvas.rs"]
#[allow(dead_code)] // entries are given their canvas
mod canvas;
mod draw;
mod set_up;
mod targets;

#[cfg(panic = "abort")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "Rust" {
        fn pinhole_panic_is_reachable() -> !;
    }
    // SAFETY: it is never linked, so never called.
    unsafe { pinhole_panic_is_reachable() }
}

unsafe extern "Rust" {
    /// A number of which nothing is known. It exists nowhere either.
    safe fn any() -> i32;
}

/// The path to a panic by which `check` tests itself.
#[cfg(feature = "provoke")]
#[unsafe(no_mangle)]
fn entry_provoke(list: &[u32], index: usize) -> u32 {
    list[index]
}
