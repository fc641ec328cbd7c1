//! `docs/footprint.md`.

use crate::cross::Build;
use crate::footprint::{Footprint, Size, BUILDS, IMAGES, STACK};
use crate::grouped::grouped;
use crate::page::BUILT;
use std::fmt::Write;

const HEAD: &str = "\
# Footprint

What each feature takes of flash, RAM and stack. This page is written by

```sh
tools/bench/run
```

and CI runs that with `--check`: it fails where flash is 5 % above `tools/bench/footprint.txt` or,
with the same compiler, a figure is not within 2 % (or 64 bytes) of this page's. ";

const FLASH: &str = "
## Flash

Code, constants and start values of a firmware with one purpose, less those of one that does nothing: it has the same
mesh, start and end. Fat LTO. The display is a stub. Each turns a cube by an angle and places it before a
camera, which is a constant of 224 bytes; the second row makes it at run time (`look_at` and `perspective`), which
costs the difference, once, in any other. *Everything* draws wireframes, hidden and depth-tested lines, flat faces,
smooth faces with dither and depth, painter's order and points, in bands and dirty rectangles, from two cameras, one of them made at run
time. The goals are those of thumbv7m at opt-level 3; where a figure is above its goal, it is not reached yet. Inks and colours are type parameters: each way to draw is linked for each ink that a firmware uses it with.

| bytes | goal |";

const STACK_TEXT: &str = "
## RAM and stack

Of the same images: variables (vertices, records of faces, the strips of colour and depth, which are 8 rows of 240 pixels here), and the stack,
painted first and looked at afterwards: from the top of RAM to the deepest byte that changed while the program ran,
set-up and the program's own frames included. There is no heap.

| bytes |";

const FILES: &str = "
## Where the code comes from

In bytes of code on thumbv7m at opt-level 3, by the module of the library that an instruction was written for,
wherever it was inlined: the innermost one, when code of Rust's own library was inlined there. The rest is the compiler's
routines and the firmware's own. CI fails if an image holds a byte that it has no use for: a wireframe of triangles,
planes, depth and `shade`; flat faces of smooth shades and dither; those without depth of depth; and if the dithered image does not hold all of these, for then the check would be blind.

| bytes of |";

pub(crate) fn text(compiler: &str, footprint: &Footprint) -> String {
    let size = |name, build| footprint.sizes.get(&(name, build)).copied();
    let number = |bytes: Option<u64>| bytes.map_or("–".into(), grouped);
    let builds = |text: &mut String, columns: &str| {
        for Build { target, level } in BUILDS {
            let core = target.trim_end_matches("-none-eabi");
            let _ = write!(text, " {core}, {level}{columns} |");
        }
    };
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{FLASH}");
    builds(&mut text, "");
    let _ = writeln!(text, "\n|---|--:|{}", "--:|".repeat(BUILDS.len()));
    for image in IMAGES {
        let _ = write!(text, "| {} | {} |", image.says, image.goal.map_or(String::new(), grouped));
        for build in BUILDS {
            let _ = write!(text, " {} |", number(size(image.name, build).map(|size| size.flash)));
        }
        text.push('\n');
    }
    text += STACK_TEXT;
    text += " variables |";
    builds(&mut text, ": stack");
    let _ = writeln!(text, "\n|---|--:|{}", "--:|".repeat(BUILDS.len()));
    for image in IMAGES {
        let variables = size(image.name, BUILDS[0]).map(|Size { variables, .. }| variables);
        let _ = write!(text, "| {} | {} |", image.says, number(variables));
        for build in BUILDS {
            let _ = write!(text, " {} |", number(size(image.name, build).map(|size| size.stack)));
        }
        text.push('\n');
    }
    let _ = writeln!(text, "\nThe goal is {} bytes of stack on thumbv7m at opt-level 3.", grouped(STACK));
    text += FILES;
    for image in IMAGES {
        let _ = write!(text, " {} |", image.says);
    }
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(IMAGES.len()));
    for module in MODULES {
        let _ = write!(text, "| `{}` |", module.trim_end_matches('/'));
        for image in IMAGES {
            let _ = write!(
                text,
                " {} |",
                number(footprint.code.get(image.name).map(|code| code.of_file(module)))
            );
        }
        text.push('\n');
    }
    text
}

const MODULES: &[&str] = &[
    "math/",
    "raster/line.rs",
    "raster/edge.rs",
    "raster/halves.rs",
    "raster/side.rs",
    "raster/stretch.rs",
    "raster/triangle.rs",
    "raster/plane.rs",
    "raster/",
    "scene/",
    "camera/",
    "clip.rs",
    "shade/",
    "output/",
    "render/",
];
