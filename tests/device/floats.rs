//! Names of routines for floating point in software.

/// Whether a symbol belongs to software floating point: the names of the ARM ABI, of libgcc, of Rust's own
/// implementation, and of the printing and parsing of floats.
pub(crate) fn is_float_routine(name: &str) -> bool {
    if let Some(name) = name.strip_prefix("__aeabi_") {
        return ["f", "d", "cf", "cd", "h2f"].iter().any(|prefix| name.starts_with(prefix))
            || ["2f", "2d", "2f_vfp", "2d_vfp"].iter().any(|suffix| name.ends_with(suffix));
    }
    if let Some(name) = name.strip_prefix("__") {
        // f(loat) of s(ingle), d(ouble), t(etra) or h(alf) width.
        return ["sf", "df", "tf", "hf"].iter().any(|part| name.contains(part));
    }
    let rust = ["compiler_builtins5float", "compiler_builtins4math", "fmt5float", "flt2dec", "dec2flt"];
    rust.iter().any(|part| name.contains(part))
}

/// The check itself must be able to fail.
#[test]
fn float_routines_are_known_by_name() {
    let routines = "__aeabi_fadd __aeabi_dmul __aeabi_cfcmple __aeabi_i2f __aeabi_ul2d __aeabi_f2iz __aeabi_d2f __addsf3 __mulsf3 \
        __divdf3 __floatunsisf __fixsfsi __extendsfdf2 __unordsf2 __powisf2 \
        _ZN17compiler_builtins5float3add8__addsf317h0 _ZN4core3num7flt2dec8strategy5grisu";
    for name in routines.split_whitespace() {
        assert!(is_float_routine(name), "{name}");
    }
    let others = "__aeabi_idiv __aeabi_uidivmod __aeabi_ldivmod __aeabi_lmul __aeabi_llsl __aeabi_memcpy4 __aeabi_memclr \
        __muldi3 __udivmodsi4 __ashldi3 __pre_init __sbss __INTERRUPTS Reset main DefaultHandler_ __udivdi3 __clzsi2";
    for name in others.split_whitespace() {
        assert!(!is_float_routine(name), "{name}");
    }
}
