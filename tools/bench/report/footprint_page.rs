//! `docs/footprint.md`.

use crate::cross::Build;
use crate::footprint::{Addition, Footprint, Image, Size, ADDITIONS, BUILDS, IMAGES, STACK};
use crate::grouped::grouped;
use crate::page::BUILT;
use std::fmt::Write;

const HEAD: &str = "\
# Footprint

Flash, RAM and stack of each feature. This page is written by

```sh
tools/bench/run
```

and CI runs it with `--check`: the check fails if flash, variables or stack are 5 % above `tools/bench/footprint.txt` or,
with the same compiler, a goal that was met is missed, or a figure is not within 2 % (or 64 bytes) of this page's. It also fails
if an image holds a floating-point routine. ";

const FLASH: &str = "
## Flash

Code, constants and start values of a single-purpose firmware, minus an empty one, which has the same mesh, start and end.
Fat LTO. The display is a stub. Each firmware rotates a cube and draws it with a camera, which is a constant of 224
bytes; the second row makes it at run time (`look_at` and `perspective`): add this difference once to any other row.
The image *everything* draws wireframes, hidden and depth-tested lines, flat faces, smooth faces with dither and depth, painter's order
and points, in bands and dirty rectangles, from two cameras, one of them made at run time. The goals are for thumbv7m at
opt-level 3.

Rows with `pixels()` draw into a band's memory (`&mut band.pixels()`), as the templates do: faster, and larger. The other rows in bands
draw into it as into any DrawTarget (`&mut band`). *By planes* is the only image whose mesh has planes (`Mesh::with_planes`).
*Without clipping* is `MeshInstance::without_clipping()`: of the two frames, only the cube that stays in view is drawn whole.
Flat faces that are not in bands are lit by `RigidLambert`, which takes rotations. All other faces, and those with depth in a picture in
memory or in painter's order, are lit by `Lambert`, which also takes stretched objects. The mesh of hidden lines has the faces beside its
edges. Rows with figures at opt-level 3 alone, and the column for RISC-V, are for `apps/planner`, which compares ways
to draw; its tests link other firmware and compare it with these figures.
`Camera::framing` makes the camera that frames a mesh, as the templates do.

The target, the shader, and the closure that gives a face its shader are type parameters: each closure type instantiates the
drawing code again, even if two closures return equal colours. A call in a loop over objects is linked once, and so are
several calls with one named function.

| bytes | goal |";

const ADDED: &str = "
## What a feature adds

Two images each that draw alike, one of them with one feature more: what the feature adds to flash on thumbv7m at opt-level 3, and
what of this is code that runs for faces, rows and pixels (`clip.rs`, `raster`, `surface`, `fast`, `pipeline`). CI fails if a feature adds
more than its limit in `tools/bench/report/footprint.rs`.

- **Screen door, half mixed, transparent colour**: less than nothing. One loop, which asks for each pixel whether it is drawn, is in place of
  the loops for opaque faces; the patterns of a screen door take 520 bytes. A firmware that also draws opaque faces links both, as
  it does for any two shaders.
- **Fog by vertex**: set-up alone, which is `VertexFog::new` with a division, and `VertexFog::factors`. Faces, rows and pixels are drawn by the code of the
  shade table.
- **Fog by pixel**: `FogTable::new`; depth at vertices and over faces, which a depth buffer needs as well; loops that fill level by level, beside
  those for faces in one level, which are the loops of flat faces.
- **Sprites**: their points, their size on the screen, and their rows of texels. No code of faces is linked.

| bytes | beyond | flash | code that draws |
|---|---|--:|--:|
";

const STACK_TEXT: &str = "
## RAM and stack

Variables of these images: vertex caches, bin storage, and the strips of colour and depth, which are 8 rows of 240 pixels here. The
stack is filled with a pattern before the run, and measured from the top of RAM to the deepest byte that changed,
set-up and the program's own frames included. There is no heap. Each image draws two frames in a loop, and so does the empty
one: the cube, and a cube twice as large, of which the near plane clips visible faces. So these figures include clipping.

| bytes |";

const FILES: &str = "
## Where the code comes from

In bytes of code on thumbv7m at opt-level 3, by the module of the library that an instruction was written for,
wherever it was inlined: the innermost module, where code of Rust's own library was inlined. The rest is the compiler's
routines and the firmware's own code. CI fails if an image holds a byte that it does not use: a wireframe a byte of triangles,
planes, depth or `shade`; flat faces a byte of smooth shading or dither; faces without depth a byte of depth. It also fails if the dithered image does not hold bytes of all of these: then the check would see nothing.

| bytes of |";

pub(crate) fn text(compiler: &str, footprint: &Footprint) -> String {
    let size = |name, build| footprint.sizes.get(&(name, build)).copied();
    let number = |bytes: Option<u64>| bytes.map_or("–".into(), grouped);
    let builds = |text: &mut String, columns: &str| {
        for Build { target, level } in BUILDS {
            let core = target.split('-').next().unwrap_or(target);
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
    let flash = |image: &Image| Some((size(image.name, BUILDS[0])?.flash, image.goal?));
    let _ = writeln!(text, "\n{}", standing(flash));
    text += ADDED;
    for addition in ADDITIONS {
        let &Addition { feature, without, .. } = addition;
        let says = IMAGES.iter().find(|image| image.name == without).map_or(without, |image| image.says);
        let [flash, drawing] =
            footprint.added(addition).map_or(["–".into(), "–".into()], |added| added.map(signed));
        let _ = writeln!(text, "| {feature} | {says} | {flash} | {drawing} |");
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
    let stack = |image: &Image| Some((size(image.name, BUILDS[0])?.stack, STACK));
    let goal = grouped(STACK);
    let _ =
        writeln!(text, "\nThe goal is {goal} bytes of stack on thumbv7m at opt-level 3. {}", standing(stack));
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

fn signed(bytes: i64) -> String {
    let sign = if bytes < 0 { "-" } else { "" };
    format!("{sign}{}", grouped(bytes.unsigned_abs()))
}

/// Which goals are met and which are not, of images with a figure and a goal for it.
fn standing(figure: impl Fn(&Image) -> Option<(u64, u64)>) -> String {
    let of = |met: bool| {
        let with = |image: &&Image| figure(image).is_some_and(|(is, goal)| (is <= goal) == met);
        let says: Vec<_> = IMAGES.iter().filter(with).map(|image| image.says).collect();
        if says.is_empty() {
            "none".into()
        } else {
            says.join("; ")
        }
    };
    format!("**Met** by: {}. **Not met** by: {}.", of(true), of(false))
}

const MODULES: &[&str] = &[
    "math/",
    "raster/line.rs",
    "raster/edge.rs",
    "fast/small_triangle.rs",
    "fast/edge20.rs",
    "raster/trapezoid.rs",
    "raster/triangle.rs",
    "raster/gradient_setup.rs",
    "raster/",
    "scene/",
    "camera/",
    "clip.rs",
    "shading/",
    "surface/",
    "fast/",
    "pipeline/",
];
