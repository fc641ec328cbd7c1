//! The README's table: error, speed and memory compared with other libraries, from the generated pages.

use crate::grouped::grouped;
use crate::page::{number, Page};

const BEGIN: &str = "<!-- table: cargo run --release -p pinhole-pages -->\n";
const END: &str = "<!-- end of table -->\n";

/// Memory of other libraries for the torus with depth: measured once, with the targets of `tools/bench/targets.txt`.
const CODE: &str = "small3dlib 6 KB, tgx 31 to 45 KB";
const RAM: &str = "tgx 230 KB, small3dlib 345 KB";

pub(crate) fn with_table() -> Result<String, String> {
    let readme = super::read("README.md")?;
    let parts = readme.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = parts.ok_or("README.md: no place for the table")?;
    Ok([before, BEGIN, &table()?, END, after].concat())
}

fn table() -> Result<String, String> {
    let mut lines = vec!["| | pinhole | others |".into(), "|---|--:|---|".into()];
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
    let [ours, float, fixed] = designs.map(|design| page.cell(&design, "D max"));
    let (ours, float, fixed) = (ours?, float?, fixed?);
    lines.push(format!(
        "| how far a corner of an object in view is off, at most, in pixels | {ours} | matrices of f32 {float}, of Q16.16 {fixed} |"
    ));
    Ok(())
}

fn speed(lines: &mut Vec<String>) -> Result<(), String> {
    let page = Page::read("docs/speed.md")?;
    for (what, core) in [
        ("instructions for a frame of 1000 lit triangles with a depth buffer, on a Cortex-M0", "M0"),
        ("– on a Cortex-M3", "M3"),
        ("– on a Cortex-M4 whose FPU only the others use", "M4F"),
    ] {
        let row = page.row("The cells", &["S3", "z", core])?;
        let best = match row.get("best rival")? {
            "S3L" => "small3dlib",
            "TGX" => "tgx",
            "3DG" => "embedded-3dgfx",
            other => return Err(format!("docs/speed.md: {other} has no name for the README")),
        };
        lines.push(format!(
            "| {what} | {} | {best} {} |",
            row.get("instructions")?,
            row.after("best rival")?
        ));
    }
    Ok(())
}

fn memory(lines: &mut Vec<String>) -> Result<(), String> {
    let bands = Page::read("docs/bands.md")?;
    let ram = bands.row("RAM", &["S3"])?.get("together")?;
    lines.push(format!(
        "| RAM for that frame in bands, with the stack, in bytes | {ram} | a whole frame: {RAM} |"
    ));
    let speed = Page::read("docs/speed.md")?;
    let torus = speed.row("Memory", &["S3", "z"])?;
    let code = number(torus.get("flash")?)? - number(torus.get("of that, data")?)?;
    lines.push(format!("| code for that frame, not in bands, in bytes | {} | {CODE} |", grouped(code)));
    Ok(())
}
