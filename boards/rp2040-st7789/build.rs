//! Tells the linker where `memory.x` is, and links again when it changes, which cargo does not watch by itself.

fn main() {
    println!("cargo::rustc-link-search={}", std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    println!("cargo::rerun-if-changed=memory.x");
}
