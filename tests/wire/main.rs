//! Counts the bytes that go over the wire to a display, and writes docs/wire.md:
//!
//! ```text
//! cargo run --release --example wire -- --help
//! ```

#[allow(dead_code, unreachable_pub)] // a firmware draws by it
#[path = "../../src/book/cookbook/round.rs"]
mod round;

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use mipidsi::models::{ILI9341Rgb565, ILI9341Rgb666, ST7789};
use pinhole_apps_support::command;
use pinhole_apps_support::generated::Generated;
use pinhole_apps_support::grouped;
use std::fmt::Write as _;
use std::process::ExitCode;
use support::panel::films::{
    film, in_bands, line_traffic, lines, pixel_bytes, reference, strip, sum, Colour, Cost, Film, Way, FRAMES,
    ROWS,
};
use support::panel::screen::{Kind, Screen};

fn main() -> ExitCode {
    command::run(|| {
        let about = "Counts the bytes that a display driver sends, and writes a page of tables";
        let file = Generated::arguments("--example wire", about, "docs/wire.md")?;
        file.finish_page(&page())
    })
}

const HEAD: &str = "\
# On the wire

The bytes of a frame on an 8-bit SPI bus between the microcontroller and its display: pixels and commands, as the driver
[mipidsi](https://docs.rs/mipidsi) 0.10 sends them to a display in memory, which decodes them. `cargo run --release --example wire` writes this
page; `tests/device/wire.rs` asserts the promised limits.

A **window** is one rectangle: 11 bytes of commands (column range, row range, memory write), then its pixels.
**Frames a second** are SPI clock ÷ (8 × bytes): the bus alone. A real one has gaps between bytes and transfers, and the
frame is drawn first, or by DMA at the same time; so this is what the bus allows, never more.
";

const FULL: &str = "\
## Full frames

All pixels are sent, changed or not. In bands the strip is the only memory for pixels; sent in one, a frame needs a framebuffer. The
share is in bytes of the pixels.

| panel | sent in | strip, bytes | bytes a frame | windows | share | at 20 MHz | at 40 MHz |
|---|---|---|---|---|---|---|---|
";

const FILMS: &str = "\
## Films

Means over a film, without the first frame (all of the screen); in brackets the largest frame. Bands and dirty
rectangles use a strip of ROWS rows. *Spans* draws straight onto the display: cleared, then each run of equal pixels a
`fill_solid`. That flickers, as the display shows the cleared screen first. Where the cube turns by 5° or more, dirty rectangles take at
most 5 % more bytes than the bounding rectangle of all pixels that change.
";

const ROUND: &str = "\
## A round glass

A glass of 240 × 240 pixels that is round, as a GC9A01's, shows 79 % of them. Each band is as wide as the glass is at the band's widest row, by
`chord` of the book's cookbook.

| bands of | bytes a frame | windows | share | at 20 MHz | at 40 MHz |
|---|---|---|---|---|---|
";

const LINES: &str = "\
## Lines

Lines from the middle of the panel to every eighth point of its border, drawn straight onto the display. A target that can fail,
such as this driver, gets a `fill_solid` for each run; one that cannot, as it lies in memory, one `draw_iter` for each line.

| panel | a line is | bytes a line | windows a line |
|---|---|---|---|
";

fn page() -> String {
    let mut page = format!("{HEAD}\n{FULL}");
    full::<ST7789>(&mut page);
    full::<ILI9341Rgb565>(&mut page);
    full::<ILI9341Rgb666>(&mut page);
    let _ = write!(page, "\n{}", FILMS.replace("ROWS", &ROWS.to_string()));
    let spin = Film::Cube { axis: [0, 1, 0], turn: FRAMES };
    let films = [
        (spin, "the spinning cube (S2), 5° a frame"),
        (Film::Small, "a small cube flies before one that stands still"),
    ];
    for (what, name) in films {
        films_of::<ST7789>(&mut page, what, name);
    }
    let _ = write!(page, "\n{ROUND}");
    on_a_round_glass(&mut page);
    let _ = write!(page, "\n{LINES}");
    lines_on::<ST7789>(&mut page);
    lines_on::<ILI9341Rgb666>(&mut page);
    page
}

/// Frames a second that a bus allows, at 20 and at 40 MHz.
fn rates(bytes: f64) -> String {
    let rate = |megahertz: f64| megahertz * 1e6 / (8.0 * bytes);
    format!("{:.1} | {:.1}", rate(20.0), rate(40.0))
}

fn full<M: Kind<ColorFormat: Colour>>(page: &mut String) {
    let mut screen = Screen::<M>::new();
    let area = screen.display.bounding_box();
    let pixels = pixel_bytes::<M::ColorFormat>(M::SIZE);
    let things = Film::Small.frame(M::SIZE, 0);
    for rows in [M::SIZE.height, 40, 8, 1] {
        let mut strip = strip::<M::ColorFormat>(M::SIZE.width, rows);
        in_bands(&things, area, &mut strip, &mut screen.display).expect("a bus that works");
        screen.assert_shows(&reference(&things, M::SIZE), ("bands", rows));
        let (bytes, windows) = screen.count();
        let name = match rows {
            1 => "bands of 1 row".to_string(),
            _ if rows == M::SIZE.height => "one".to_string(),
            _ => format!("bands of {rows} rows"),
        };
        let _ = writeln!(
            page,
            "| {} | {name} | {} | {} | {windows} | {:.4} | {} |",
            M::NAME,
            grouped(strip.len() as u64),
            grouped(bytes as u64),
            bytes as f64 / pixels as f64,
            rates(bytes as f64)
        );
    }
}

fn on_a_round_glass(page: &mut String) {
    let mut screen = Screen::<ST7789>::new();
    let pixels = pixel_bytes::<Rgb565>(ST7789::SIZE);
    let things = Film::Small.frame(ST7789::SIZE, 0);
    for rows in [16, 8, 4, 1] {
        let mut strip = strip::<Rgb565>(ST7789::SIZE.width, rows);
        for top in (0..ST7789::SIZE.height).step_by(rows as usize) {
            let area = round::chord(top, rows);
            in_bands(&things, area, &mut strip, &mut screen.display).expect("a bus that works");
        }
        let (bytes, windows) = screen.count();
        let name = if rows == 1 { "1 row".to_string() } else { format!("{rows} rows") };
        let _ = writeln!(
            page,
            "| {name} | {} | {windows} | {:.2} | {} |",
            grouped(bytes as u64),
            bytes as f64 / pixels as f64,
            rates(bytes as f64)
        );
    }
}

fn films_of<M: Kind<ColorFormat: Colour>>(page: &mut String, what: Film, name: &str) {
    let _ = write!(
        page,
        "\n### {}: {name}\n\n\
        | sent as | bytes a frame | windows a frame | at 20 MHz | at 40 MHz |\n|---|---|---|---|---|\n",
        M::NAME
    );
    for (way, name) in [
        (Way::DirtyRegions, "dirty rectangles"),
        (Way::Bands, "full frames in bands"),
        (Way::Spans, "spans, on the cleared screen"),
    ] {
        let costs = film::<M>(what, FRAMES, way);
        let mean = |of: fn(&Cost) -> usize| of(&sum(&costs)) as f64 / costs.len() as f64;
        let most = |of: fn(&Cost) -> usize| grouped(costs.iter().map(of).max().unwrap_or(0) as u64);
        let bytes = mean(|cost| cost.bytes);
        let _ = writeln!(
            page,
            "| {name} | {} ({}) | {} ({}) | {} |",
            grouped(bytes.round() as u64),
            most(|cost| cost.bytes),
            grouped(mean(|cost| cost.windows).round() as u64),
            most(|cost| cost.windows),
            rates(bytes)
        );
    }
}

fn lines_on<M: Kind<ColorFormat: Colour>>(page: &mut String) {
    let count = lines(M::SIZE).len() as f64;
    for (name, (bytes, windows)) in [
        ("a `fill_solid` for each run", line_traffic::<M, 1>()),
        ("one `draw_iter`", line_traffic::<M, { u16::MAX }>()),
    ] {
        let (bytes, windows) = (bytes as f64 / count, windows as f64 / count);
        let _ = writeln!(page, "| {} | {name} | {bytes:.0} | {windows:.0} |", M::NAME);
    }
}
