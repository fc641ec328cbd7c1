//! Links anew when the memory's layout has changed, which cargo does not watch by itself.

fn main() {
    println!("cargo::rerun-if-changed=memory.x");
}
