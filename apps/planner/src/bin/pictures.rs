//! Draws every ready mesh in every style on every display, and prints a checksum of each picture: `CHOICE CHECKSUM`. If the input
//! has lines of choices, draws those instead.

use pinhole_planner::{Choice, Planner, Style, DISPLAYS, READY};
use std::process::ExitCode;

fn main() -> ExitCode {
    match print() {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn print() -> Result<(), String> {
    let mut planner = Planner::default();
    for choice in choices() {
        let (pixels, _) = Choice::parse(&choice)
            .map_err(Into::into)
            .and_then(|choice| planner.draw(&choice))
            .map_err(|problem| format!("{choice}: {problem}"))?;
        println!("{choice} {:08x}", checksum(&pixels));
    }
    Ok(())
}

/// Every mesh, display and style, dithered and not; every mesh decimated; sharp edges alone; smooth edges; then every projection, moved and magnified.
fn choices() -> Vec<String> {
    let mut choices = Vec::new();
    for (mesh, _) in &READY {
        for display in &DISPLAYS {
            let (width, height, format) = (display.width, display.height, display.format.name());
            for (style, of) in Style::ALL {
                let dithers: &[u8] = if of.is_of_lines() { &[0] } else { &[0, 1] };
                for dither in dithers {
                    choices.push(format!(
                        "mesh={mesh}&width={width}&height={height}&format={format}&style={style}&dither={dither}&turn=7"
                    ));
                }
            }
        }
    }
    // Decimation is a feature, which both builds have or neither.
    if cfg!(feature = "decimate") {
        for (mesh, _) in &READY {
            for faces in [12, 60, 150, 400] {
                choices.push(format!("mesh={mesh}&decimate={faces}&style=gouraud"));
                choices.push(format!("mesh={mesh}&decimate={faces}&fix-winding=1&style=hidden-line"));
            }
        }
    }
    for mesh in ["gear", "cylinder", "teapot"] {
        for style in ["wireframe", "hidden-line"] {
            choices.push(format!("mesh={mesh}&style={style}&edges=30"));
        }
    }
    for mesh in ["gear", "teapot"] {
        for format in ["rgb565", "gray2", "gray4"] {
            for style in ["flat", "gouraud", "textured"] {
                choices.push(format!("mesh={mesh}&format={format}&style={style}&smooth-edges=1"));
            }
        }
    }
    for texture in ["checker", "grid"] {
        for mesh in ["torus", "gear", "cube"] {
            choices.push(format!("mesh={mesh}&style=textured&texture={texture}&projection=reverse&zoom=150"));
        }
    }
    for projection in Planner::projections() {
        choices.push(format!("projection={projection}"));
        choices
            .push(format!("projection={projection}&zoom=170&x=-120&y=250&style=gouraud&background=204080"));
    }
    choices
}

/// FNV-1a of 32 bits (Fowler, Noll and Vo).
fn checksum(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0x811c_9dc5, |sum, &byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}
