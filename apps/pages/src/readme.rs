//! The README's table: error, speed and memory compared with other libraries, from the generated pages.

use crate::grouped::grouped;
use crate::page::{number, Page};

const BEGIN: &str = "<!-- table: cargo run --release -p pinhole-pages -->\n";
const END: &str = "<!-- end of table -->\n";

/// Memory of other libraries for the torus with depth: measured once, with the targets of `tools/bench/targets.txt`.
const CODE: &str = "S3L 6 K, TGX 31 to 45 K, 3DG 81 K";
const RAM: &str = "TGX 230 K, 3DG 320 K, S3L 345 K";

pub(crate) fn with_table() -> Result<String, String> {
    let readme = super::read("README.md")?;
    let parts = readme.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = parts.ok_or("README.md: no place for the table")?;
    Ok([before, BEGIN, &table()?, END, after].concat())
}

fn table() -> Result<String, String> {
    let mut lines = vec!["| | pinhole | others | ours measured by |".into(), "|---|--:|---|---|".into()];
    errors(&mut lines)?;
    speed(&mut lines)?;
    memory(&mut lines)?;
    lines.push(String::new());
    Ok(lines.join("\n"))
}

fn errors(lines: &mut Vec<String>) -> Result<(), String> {
    let page = Page::read("docs/speed-vs-error.md")?;
    let designs = [
        ["1", "**the library, `i16` mesh**"],
        ["3", "f32, 4×4 matrix, three divisions"],
        ["5", "Q16.16, `>> 16` after each product"],
    ];
    for (what, column) in [
        ("**error** of a vertex in px, at most: an object that the camera sees whole", "D max"),
        ("– any object, up to 16 times as large as it is far", "max"),
    ] {
        let [ours, float, fixed] = designs.map(|design| page.cell(&design, column));
        let (ours, float, fixed) = (ours?, float?, fixed?);
        lines.push(format!(
            "| {what} | {ours} | f32 matrices {float}, Q16.16 {fixed} | `tools/designs/run` |"
        ));
    }
    Ok(())
}

fn speed(lines: &mut Vec<String>) -> Result<(), String> {
    let page = Page::read("docs/speed.md")?;
    for (what, scene, variant, core) in [
        ("**instructions** a frame: cube, wireframe; Cortex-M0", "S1", "", "M0"),
        ("– torus of 1000 triangles, flat; M3", "S3", "", "M3"),
        ("– the same with depth; M0", "S3", "z", "M0"),
        ("– the same; M3", "S3", "z", "M3"),
        ("– the same; M4F, whose FPU only others use", "S3", "z", "M4F"),
        ("– the same, Gouraud; M3", "S8", "z", "M3"),
        ("– the same; M4F", "S8", "z", "M4F"),
    ] {
        let cell = [scene, variant, core];
        let row = page.row("The cells", &cell)?;
        let (best, theirs) = (row.get("best rival")?, row.after("best rival")?);
        let rivals = page.row("Rivals in the same run", &cell)?;
        let published = rivals.get("3DG")?;
        let mut others = match best {
            "3DG" => format!("3DG {published}"),
            _ => format!("{best} {theirs}, 3DG {published}"),
        };
        // embedded-graphics draws lines only.
        let lines_of_2d = rivals.get("EG")?;
        if lines_of_2d != "–" {
            others = format!("EG {lines_of_2d}, {others}");
        }
        let command =
            ["tools/bench/run cells", scene, if variant.is_empty() { "plain" } else { variant }, core];
        lines.push(format!("| {what} | {} | {others} | `{}` |", row.get("instructions")?, command.join(" ")));
    }
    for (what, scene, variant, core) in [
        ("– the torus cut by the near plane, flat, without planes; M4F", "C1", "", "M4F"),
        ("– a cube that turns, wireframe, with the set-up of its transform; M4F", "T1", "", "M4F"),
        ("– 1000 lines into any DrawTarget; M3", "S6", "dt", "M3"),
    ] {
        let row = page.row("As users draw", &[scene, variant, core])?;
        let (once, best) = (row.get("once")?, row.after("once")?);
        let mut others = vec![format!("{once} {best}")];
        for name in ["3DG", "EG"] {
            others.push(format!("{name} {}", row.get(name)?));
        }
        others.retain(|rival| !rival.ends_with('–'));
        let (ours, others) = (row.get("instructions")?, others.join(", "));
        let variant = if variant.is_empty() { "plain" } else { variant };
        lines.push(format!(
            "| {what} | {ours} | {others} | `tools/bench/run cells {scene} {variant} {core}` |"
        ));
    }
    Ok(())
}

fn memory(lines: &mut Vec<String>) -> Result<(), String> {
    let bands = Page::read("docs/bands.md")?;
    let ram = bands.row("RAM", &["S3"])?.get("together")?;
    lines.push(format!("| **RAM** in bytes, stack too: the torus with depth, all of 240 × 240 pixels | {ram} | {RAM} | `tools/bench/run bands` |"));
    let speed = Page::read("docs/speed.md")?;
    let torus = speed.row("Memory", &["S3", "z"])?;
    let code = number(torus.get("flash")?)? - number(torus.get("of that, data")?)?;
    lines.push(format!(
        "| **code** in bytes: the same, not in bands | {} | {CODE} | `tools/bench/run cells S3 z M3` |",
        grouped(code)
    ));
    Ok(())
}
