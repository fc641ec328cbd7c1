//! The README's table: error, speed and memory compared with other libraries, from the generated pages.

use crate::grouped::grouped;
use crate::page::{number, Page};

const BEGIN: &str = "<!-- table: cargo run --release -p pinhole-pages -->\n";
const END: &str = "<!-- end of table -->\n";

/// Memory of other libraries for the torus with depth: its header says how it was measured.
const PEERS: &str = "tools/bench/peers.txt";

pub(crate) fn with_table() -> Result<String, String> {
    let readme = super::read("README.md")?;
    let parts = readme.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = parts.ok_or("README.md: no place for the table")?;
    Ok([before, BEGIN, &table()?, END, after].concat())
}

fn table() -> Result<String, String> {
    let mut lines = vec!["| | pinhole | other libraries |".into(), "|---|--:|---|".into()];
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
        "| largest vertex error before the snap to 1/256 pixel | {ours} | f32 matrices {float}, Q16.16 matrices {fixed} |"
    ));
    Ok(())
}

fn speed(lines: &mut Vec<String>) -> Result<(), String> {
    let page = Page::read("docs/speed.md")?;
    for core in ["M0", "M3", "M4F"] {
        let row = page.row("The cells", &["S3", "z", core])?;
        let best = match row.get("best rival")? {
            "S3L" => "small3dlib",
            "TGX" => "tgx",
            "3DG" => "embedded-3dgfx",
            other => return Err(format!("docs/speed.md: {other} has no name for the README")),
        };
        lines.push(format!(
            "| instructions, Cortex-{core} | {} | {best} {} |",
            row.get("instructions")?,
            row.after("best rival")?
        ));
    }
    Ok(())
}

fn memory(lines: &mut Vec<String>) -> Result<(), String> {
    let peers = Peer::all()?;
    let others = |bytes: fn(&Peer) -> u64| {
        let mut all: Vec<&Peer> = peers.iter().collect();
        all.sort_by_key(|peer| bytes(peer));
        let one = |peer: &&Peer| format!("{} {} KB", peer.library, (bytes(peer) + 500) / 1000);
        all.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    let bands = Page::read("docs/bands.md")?;
    let ram = bands.row("RAM", &["S3"])?.get("together")?;
    lines.push(format!(
        "| RAM with stack, bytes | {ram} in bands | whole frame: {} |",
        others(|peer| peer.depth + peer.frame)
    ));
    let speed = Page::read("docs/speed.md")?;
    let torus = speed.row("Memory", &["S3", "z"])?;
    let code = number(torus.get("flash")?)? - number(torus.get("of that, data")?)?;
    lines.push(format!("| code, bytes | {} | {} |", grouped(code), others(|peer| peer.code)));
    Ok(())
}

/// A library's memory, in bytes.
struct Peer {
    library: String,
    code: u64,
    depth: u64,
    frame: u64,
}

impl Peer {
    fn all() -> Result<Vec<Self>, String> {
        let text = super::read(PEERS)?;
        let peer = |line: &str| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let unread = || format!("{PEERS}: {line}: is not a library and its code, depth and frame");
            let [library, code, depth, frame] = words[..] else { return Err(unread()) };
            let bytes = |word: &str| word.parse::<u64>().map_err(|_| unread());
            Ok(Self {
                library: library.into(),
                code: bytes(code)?,
                depth: bytes(depth)?,
                frame: bytes(frame)?,
            })
        };
        text.lines().filter(|line| !line.starts_with('#')).map(peer).collect()
    }
}
