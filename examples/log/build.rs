//! Linker arguments of the firmware. Given here and not as `rustflags`, they leave core and the dependencies as they are, so
//! that all firmware of the repository shares one build of them.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        // The board's memory.x is in the repository's root.
        println!(
            "cargo::rustc-link-search={}/../..",
            std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it")
        );
        println!("cargo::rerun-if-changed=../../memory.x");
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}
