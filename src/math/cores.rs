//! Chooses between two implementations of the same arithmetic by the core that is compiled for. Other files
//! choose between whole functions or modules by the same conditions.
//!
//! With `--cfg pinhole_plain` every core gets the plain functions.

/// A Cortex-M0: no division, no 64-bit product, no count of leading zeros, eight registers in most instructions. Not a
/// Cortex-M23 (ARMv8-M Baseline), which divides and has atomics but no 64-bit products: it computes the same bits, slower.
pub(crate) const CORTEX_M0: bool =
    cfg!(all(target_arch = "arm", not(target_has_atomic = "32"), not(pinhole_plain)));

/// Whether an instruction counts leading zeros. RV32IMC has none.
pub(crate) const COUNTS_LEADING_ZEROS: bool =
    !CORTEX_M0 && !cfg!(all(target_arch = "riscv32", not(pinhole_plain)));

#[cfg(not(all(
    any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))),
    not(pinhole_plain)
)))]
pub(crate) use super::form::WideForm as LinearForm;
/// The linear form by which this build transforms vertices: in 16-bit halves on a Cortex-M0, whose products have 32 bits, and
/// on RV32, where a 64-bit sum takes four instructions.
#[cfg(all(
    any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))),
    not(pinhole_plain)
))]
pub(crate) use super::halfword::HalfwordForm as LinearForm;
