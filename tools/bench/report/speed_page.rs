//! `docs/speed.md`.

use crate::cells::{Cell, FAST};
use crate::grouped::grouped;
use crate::page::BUILT;
use crate::rivals::Rival;
use crate::targets::{Open, Target, Times};
use crate::user_page;
use bench::cells::{data, planes, CELLS};
use std::fmt::Write;

const HEAD: &str = "\
# How fast it is

Instructions per frame on emulated microcontrollers, compared with targets and with other libraries. This page is
written by

```sh
tools/bench/run
```

which also prints one line per cell: `scene,variant,core,instructions,flash,ram,stack,crc`.
`tools/bench/run cells S3 M0` measures some of them. ";

const COUNTED: &str = "
## What is counted

One frame of 240 × 240 pixels of Rgb565 in RAM, the second of two, from the mesh in flash to the last pixel: vertices, faces, the
light on each face (S8: at each vertex), pixels; with *z* the clearing of the depth buffer too. Not counted: the clearing
of the picture, and the set-up before a frame: camera, light, the model's transform, S8's shade table. The library is used as
anyone would use it: the size of the picture is a variable, everything is clipped, statistics are counted; the
compiler knows none of the numbers. Opt-level 3, fat LTO.

The torus and the icosphere have a normal and a plane (`Mesh::with_planes`, 2 bytes) with each face, and are so drawn by
early back-face culling: most back faces are culled before their vertices are transformed, and a vertex that only back
faces use is never transformed. Figures for these meshes without planes are [below](#by-planes-and-without).

[profile.md](profile.md) shows where the instructions of a frame go, stage by stage; with [growth.md](growth.md) you can estimate
your own scene.

Instructions are not cycles: see [cycles](#cycles) and [frames per second](#frames-per-second) below. Instructions are counted
by the clock of the emulator (QEMU), which advances by a fixed time per instruction, and is compared with a loop of known length
in every run; RV32 has its own instruction counter. The counts are equal in every run. Every picture equals that of the
program on the host, compared by checksum.

M0: thumbv6m. M3: thumbv7m. M4F: thumbv7em with FPU, which the library does not use. RV32: rv32imc.

| scene | |
|---|---|
| S1 | cube, wireframe |
| S2 | cube, flat Lambert |
| S3 | torus of 1000 triangles, flat Lambert |
| S4 | icosphere of 5780 triangles, flat Lambert |
| S5 | one triangle over the whole picture, 2D |
| S6 | 1000 lines, 2D |
| S7 | 1000 triangles of about 98 pixels, 2D |
| S8 | torus, Gouraud, a light level at each vertex, colours by a shade table |

A shade table has 256 colours: a channel of a pixel is within ½ + MAX/510 of its level, MAX/510 being 0.12 for Rgb565's green.
`Gouraud::lit` comes within ½ + 2⁻⁹ level, for more instructions: [what was tried](profile.md#what-was-tried).
";

const CELLS_HEAD: &str = "
## The cells

*Best rival* is the fastest of S3L (small3dlib), TGX (tgx) and 3DG (embedded-3dgfx 0.7.2) on that scene and core, each
measured once, when the targets were set, on equal scenes and the same emulator; the versions of S3L and TGX were not noted. S8 of S3L
was measured later, with a table of colours like ours. The lines and triangles of embedded-graphics itself, which need our projection in
S1, are [below](#rivals-in-the-same-run).
*Of target* is below 1 where the target is beaten; *best rival / ours* is the best rival's instructions divided by ours.

| scene | | core | instructions | target | stretch | of target | best rival | | best rival / ours |
|---|---|---|--:|--:|--:|--:|---|--:|--:|
";

const RIVALS: &str = "
## Rivals in the same run

Published crates that build as they are: embedded-3dgfx 0.7.2 (3DG; features `row_width_240`, `lighting`; its depth has 32 bits, which takes
fewer instructions than its 16) and the lines and filled triangles of embedded-graphics 0.8.2 (EG; the points of each line by one `draw_iter`), at the
same level of optimisation, counted by the same clock. Each draws into this library's picture and into the DrawTarget of
[`dt`](#any-drawtarget), and the table has the smaller of both counts; ours is that of `Picture::pixels`, which rivals cannot use. Each
draws the same scene, and the number of pixels differs by at most 8 %: both round corners to pixels and fill all edges. 3DG
records and executes (without depth: draws what it has recorded); S1 of EG has its lines between points that we project.
*Then* is 3DG's figure from when the targets were set, measured by another program, which may have used 3DG differently.

| scene | | core | ours | 3DG | then | 3DG / ours | EG | EG / ours |
|---|---|---|--:|--:|--:|--:|--:|--:|
";

const NO_PLANES: &str = "
## By planes and without

S3, S4 and S8 as above, and again from the same mesh without planes: the
same pose and frame, and the same picture, compared by checksum. S1 and S2 are always drawn without planes. *Flash* is the
additional flash of culling by planes, in bytes: the planes, 2 for each face, and code.

| scene | | core | by planes | of target | without | of target | by planes / without | flash: planes | code |
|---|---|---|--:|--:|--:|--:|--:|--:|--:|
";

const RISCV: &str = "
## RISC-V

| scene | | RV32 | of the M3's |
|---|---|--:|--:|
";

const MEMORY: &str = "
## Memory

On the M3, in bytes. Flash: code and constants, with the mesh or list, minus a firmware that counts an empty frame. RAM: the picture
(115 200), the depth buffer (115 200), 8 bytes per vertex, and 2 more for S8's light levels. Stack: at its deepest, with the set-up of
camera and light and the firmware's own frames. Drawing in bands needs a fraction of this RAM: [bands.md](bands.md).

| scene | | flash | of that, data | RAM | stack |
|---|---|--:|--:|--:|--:|
";

/// All numbers of the page.
pub(crate) struct Figures<'f> {
    pub(crate) cells: &'f [Cell],
    /// The cells with early culling by face planes, measured without it.
    pub(crate) without: &'f [Cell],
    pub(crate) targets: &'f [Target],
    pub(crate) open: &'f [Open],
    pub(crate) times: &'f [Times],
    pub(crate) rivals: &'f [Rival],
}

impl Figures<'_> {
    pub(crate) fn rival(&self, name: &str, scene: &str, variant: &str, core: &str) -> Option<u64> {
        let same = |rival: &&Rival| {
            (rival.name, &*rival.scene, &*rival.variant, rival.core.name) == (name, scene, variant, core)
        };
        self.rivals.iter().find(same).map(|rival| rival.instructions)
    }

    /// A cell at opt-level 3.
    pub(crate) fn cell(&self, scene: &str, variant: &str, core: &str) -> Option<&Cell> {
        self.at(scene, variant, FAST, core)
    }

    pub(crate) fn at(&self, scene: &str, variant: &str, level: &str, core: &str) -> Option<&Cell> {
        named(self.cells, scene, variant, level, core)
    }

    pub(crate) fn open(&self, scene: &str, variant: &str, level: &str, core: &str) -> Option<&Open> {
        let same = |of: &&Open| (of.scene, of.variant, of.level, of.core) == (scene, variant, level, core);
        self.open.iter().find(same)
    }

    pub(crate) fn times(&self, scene: &str, variant: &str, core: &str) -> Option<&Times> {
        self.times.iter().find(|of| (of.scene, of.variant, of.core) == (scene, variant, core))
    }

    fn without(&self, of: &Target) -> Option<&Cell> {
        named(self.without, of.scene, of.variant, FAST, of.core)
    }

    /// How many cells are at or below their target, and how many within 1.12 times of it; without planes, if so asked.
    fn reached(&self, planes: bool) -> [usize; 2] {
        let mut reached = [0; 2];
        for of in self.targets {
            let cell = self.cell(of.scene, of.variant, of.core);
            let without = self.without(of).filter(|_| !planes);
            if let Some(cell) = without.or(cell) {
                reached[0] += usize::from(cell.instructions <= of.target);
                reached[1] += usize::from(of.is_near(cell.instructions));
            }
        }
        reached
    }
}

fn named<'c>(cells: &'c [Cell], scene: &str, variant: &str, level: &str, core: &str) -> Option<&'c Cell> {
    let same = |cell: &&Cell| {
        (cell.scene, cell.variant, cell.level, cell.core.name) == (scene, variant, level, core)
    };
    cells.iter().find(same)
}

pub(crate) fn text(compiler: &str, figures: &Figures<'_>) -> String {
    let mut text = format!("{HEAD}{BUILT}{compiler}.\n{COUNTED}");
    cells(&mut text, figures);
    text += &user_page::text(figures);
    no_planes(&mut text, figures);
    rivals(&mut text, figures);
    text += RISCV;
    for (scene, variant, _) in CELLS {
        let count = |core| figures.cell(scene, variant, core).map(|cell| cell.instructions);
        if let (Some(riscv), Some(m3)) = (count("RV32"), count("M3")) {
            let _ = writeln!(
                text,
                "| {scene} | {} | {} | {} |",
                shown(variant),
                grouped(riscv),
                ratio(riscv, m3)
            );
        }
    }
    text += MEMORY;
    for (scene, variant, _) in CELLS {
        if let Some(cell) = figures.cell(scene, variant, "M3") {
            let [flash, data, ram, stack] =
                [cell.flash, data(scene) as u64, cell.ram, cell.stack].map(grouped);
            let _ = writeln!(text, "| {scene} | {} | {flash} | {data} | {ram} | {stack} |", shown(variant));
        }
    }
    text
}

fn cells(text: &mut String, figures: &Figures<'_>) {
    *text += CELLS_HEAD;
    for of in figures.targets {
        let Some(cell) = figures.cell(of.scene, of.variant, of.core) else { continue };
        let [ours, target, stretch, best] = [cell.instructions, of.target, of.stretch, of.best].map(grouped);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {ours} | {target} | {stretch} | {} | {} | {best} | {} |",
            of.scene,
            shown(of.variant),
            of.core,
            ratio(cell.instructions, of.target),
            of.rival,
            ratio(of.best, cell.instructions),
        );
    }
    let (all, [reached, within]) = (figures.targets.len(), figures.reached(true));
    let _ = writeln!(
        text,
        "\nOf {all} cells {reached} are at or below their target, and {within} within 1.12 times of it; `tools/bench/run` fails \
         where one is not.\nStage by stage, with the least that they must do and what was tried, those above their target are in\n\
         [profile.md](profile.md#above-the-target)."
    );
}

fn no_planes(text: &mut String, figures: &Figures<'_>) {
    *text += NO_PLANES;
    let mut beyond = Vec::new();
    for of in figures.targets {
        let with = figures.cell(of.scene, of.variant, of.core);
        let Some((with, without)) = with.zip(figures.without(of)) else { continue };
        let (variant, planes) = (shown(of.variant), planes(of.scene) as u64);
        let code = with.flash as i64 - without.flash as i64 - planes as i64;
        let _ = writeln!(
            text,
            "| {} | {variant} | {} | {} | {} | {} | {} | {} | {} | {}{} |",
            of.scene,
            of.core,
            grouped(with.instructions),
            ratio(with.instructions, of.target),
            grouped(without.instructions),
            ratio(without.instructions, of.target),
            ratio(with.instructions, without.instructions),
            grouped(planes),
            if code < 0 { "-" } else { "" },
            grouped(code.unsigned_abs()),
        );
        if !of.is_near(without.instructions) {
            beyond.push([of.scene, variant, of.core].join(" ").replace("  ", " "));
        }
    }
    let (all, [reached, within]) = (figures.targets.len(), figures.reached(false));
    let _ = write!(
        text,
        "\nWithout planes {reached} of all {all} cells would be at or below their target, and {within} within 1.12 times of it"
    );
    *text += &match beyond.is_empty() {
        true => ".\n".into(),
        false => format!("; beyond that:\n{}.\n", beyond.join(", ")),
    };
}

fn rivals(text: &mut String, figures: &Figures<'_>) {
    *text += RIVALS;
    for of in figures.targets {
        let Some(cell) = figures.cell(of.scene, of.variant, of.core) else { continue };
        let (ours, then) = (grouped(cell.instructions), grouped(of.gfx));
        let rival = |name| match figures.rival(name, of.scene, of.variant, of.core) {
            Some(count) => [grouped(count), ratio(count, cell.instructions)],
            None => ["–", "–"].map(str::to_string),
        };
        let ([gfx, times], [graphics, other_times]) = (rival("3DG"), rival("EG"));
        let (scene, variant, core) = (of.scene, shown(of.variant), of.core);
        let _ = writeln!(
            text,
            "| {scene} | {variant} | {core} | {ours} | {gfx} | {then} | {times} | {graphics} | {other_times} |"
        );
    }
}

pub(crate) fn shown(variant: &str) -> &str {
    if variant == "plain" {
        ""
    } else {
        variant
    }
}

pub(crate) fn ratio(a: u64, b: u64) -> String {
    format!("{:.2}", a as f64 / b as f64)
}
