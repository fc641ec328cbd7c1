//! The end of a program on an emulated board.

use semihosting::sys::arm_compat::sys_writec;

/// The emulator's exit code is that of the program.
pub fn end(well: bool) -> ! {
    semihosting::process::exit(i32::from(!well))
}

/// Prints how deep the stack was since it was painted, in eight hexadecimal digits, and ends. Without the
/// library's formatting: it would be in every image, and hide what one of them takes of it.
#[inline(never)]
pub fn end_with_stack(well: bool) -> ! {
    let deepest = crate::stack::deepest() as u32;
    for shift in (0..8).rev() {
        sys_writec(b"0123456789abcdef"[(deepest >> (4 * shift) & 15) as usize]);
    }
    sys_writec(b'\n');
    end(well)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    end(false)
}
