//! Where the instructions of depth-tested faces go.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::measure::Named;
use bench::{firmware, frames, profile, scene};

firmware!(memory: frames::Memory = frames::Memory::NEW, {
    let scenes: &[Named] = &[("S2", &scene::CUBE), ("S3", &scene::TORUS), ("S4", &scene::ICO)];
    profile::depth(scenes, &[16, 30, 60, 120, 180, 240], memory)
});
