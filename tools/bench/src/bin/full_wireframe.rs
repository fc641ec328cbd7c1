#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::{firmware, frames, scene};

firmware!(frames::Memory, |memory| {
    let scenes: &[frames::Named] = &[("S1", &scene::CUBE)];
    frames::measure("wireframe,full", scenes, memory, frames::wireframe)
});
