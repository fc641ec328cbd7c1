//! The linker script, for images that are measured and never run: code and constants, then variables.

use std::path::PathBuf;

/// The repository's configuration passes `link.x`, and for RISC-V a script with the regions of memory before it.
const MEMORY: &str =
    "MEMORY { FLASH : ORIGIN = 0, LENGTH = 16M\n RAM : ORIGIN = 0x20000000, LENGTH = 16M }\n";
const SECTIONS: &str = "ENTRY(Reset)
SECTIONS {
  .text : { KEEP(*(.text.Reset)) *(.text .text.*) } > CODE
  .rodata : { *(.rodata .rodata.*) *(.srodata .srodata.*) } > CODE
  .data : { *(.data .data.*) *(.sdata .sdata.*) } > RAM
  .bss (NOLOAD) : { *(.bss .bss.*) *(.sbss .sbss.*) *(COMMON) } > RAM
  /DISCARD/ : { *(.ARM.exidx .ARM.exidx.*) *(.eh_frame .eh_frame_hdr) }
}
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::var("OUT_DIR")?);
    let is_riscv = std::env::var("CARGO_CFG_TARGET_ARCH")? == "riscv32";
    let (memory, code) = if is_riscv { ("", "RAM") } else { (MEMORY, "FLASH") };
    std::fs::write(folder.join("link.x"), memory.to_owned() + &SECTIONS.replace("CODE", code))?;
    println!("cargo::rustc-link-search={}", folder.display());
    let root = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?).join("../../..");
    println!("cargo::rustc-link-search={}", root.display());
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
