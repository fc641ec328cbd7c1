#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{firmware, frames, scene};

firmware!(frames::Memory, |memory| {
    let scenes: &[frames::Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];
    frames::measure("solid,full", scenes, memory, frames::solid)
});
