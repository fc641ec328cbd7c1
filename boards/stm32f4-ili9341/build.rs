//! Linker arguments. Given here and not as `rustflags`, they leave core and the dependencies as they are, so that several
//! firmwares share one build of them.

fn main() {
    // Where `memory.x` is. Cargo does not watch that file by itself.
    println!("cargo::rustc-link-search={}", std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    println!("cargo::rerun-if-changed=memory.x");
    // defmt's linker script. `-Tlink.x` of cortex-m-rt comes from the repository's .cargo/config.toml.
    println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
}
