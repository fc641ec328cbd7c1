//! `pinhole-render` with a scene's numbers beside its pictures, for programs that judge them.

mod faces;
mod used;

use clap::{ArgMatches, Command};
use faces::Seen;
use pinhole_render::arguments;
use pinhole_render::firmware::TEMPLATE;
use pinhole_render::program::{self, Output};
use std::process::ExitCode;

const OUTPUTS: &[Output] = &[
    Output {
        name: "ids",
        help: "Write the index of the visible triangle of each pixel, or -1: a little-endian i32, row by row from the top",
        needs_faces: true,
        bytes: |scene, quantised| {
            let drawn = faces::indices(scene, quantised)?;
            let index = |seen: &Option<Seen>| seen.map_or(-1, |Seen(index)| index);
            let ids = drawn.pixels.iter().map(index).flat_map(i32::to_le_bytes);
            Ok((ids.collect(), Some(drawn.statistics)))
        },
    },
    Output {
        name: "depth",
        help: "Write the depth of each pixel: a little-endian u16 from 0 (near) to 65534 (far), linear in z/w; 65535 where nothing \
               is drawn",
        needs_faces: true,
        bytes: |scene, quantised| {
            let drawn = faces::indices(scene, quantised)?;
            Ok((drawn.depth.iter().flat_map(|depth| depth.to_le_bytes()).collect(), Some(drawn.statistics)))
        },
    },
    Output {
        name: "texels",
        help: "Write the texel in each pixel: a little-endian u16, 0 where no triangle is, otherwise 32768 and the texel's number, \
               row * W + column",
        needs_faces: false,
        bytes: |scene, quantised| {
            let (numbers, statistics) = faces::texels(scene, quantised)?;
            Ok((numbers.iter().flat_map(|number| number.to_le_bytes()).collect(), Some(statistics)))
        },
    },
    Output {
        name: "used",
        help: "Write the scene after rounding to the crate's number formats; drawing this file gives the same bits",
        needs_faces: false,
        bytes: |scene, _| Ok((used::json(scene).into_bytes(), None)),
    },
];

pub(crate) fn command() -> Command {
    arguments::command(OUTPUTS).about(
        "Draws as pinhole-render does, and writes numbers: of triangles alone, without sprites; those of a model are those of the \
         file, in its order, then the backs of --two-sided, and its default --size is 320x240",
    )
}

pub(crate) fn run(given: ArgMatches) -> Result<ExitCode, String> {
    program::drawn(given, &TEMPLATE, OUTPUTS)
}
