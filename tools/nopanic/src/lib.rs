//! Every drawing entry of pinhole, exported with inputs the compiler knows nothing about, and a panic handler that calls
//! a function which exists nowhere: if the library asks for that function, a panic is reachable. `check` looks.
//!
//! An entry is not fit to be called; it only has to be compiled. With panic = "unwind" (clippy and the like) the crate is
//! an ordinary one, for there a panic handler of its own would need more than stable Rust has.
//!
//! With the feature `provoke` the only entry is one that can panic, by which `check` tests itself.
#![cfg_attr(panic = "abort", no_std)]

/// Exports a function for each row, `NAME(ARGUMENTS) -> RESULT { BODY }`.
#[cfg(not(feature = "provoke"))]
macro_rules! entries {
    ($($name:ident$(<$life:lifetime>)?($($argument:ident: $type:ty),*) $(-> $result:ty)? { $($body:tt)* })*) => {$(
        #[unsafe(no_mangle)]
        fn $name$(<$life>)?($($argument: $type),*) $(-> $result)? {
            $($body)*
        }
    )*};
}

#[cfg(not(feature = "provoke"))]
mod draw;
#[cfg(not(feature = "provoke"))]
mod inputs;
#[cfg(not(feature = "provoke"))]
mod set_up;
#[cfg(not(feature = "provoke"))]
mod shaders;
#[cfg(not(feature = "provoke"))]
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

#[cfg(not(feature = "provoke"))]
unsafe extern "Rust" {
    /// A number that the compiler knows nothing of. This function exists nowhere, either.
    safe fn any() -> i32;
}

#[cfg(feature = "provoke")]
#[unsafe(no_mangle)]
fn entry_provoke(list: &[u32], index: usize) -> u32 {
    list[index]
}
