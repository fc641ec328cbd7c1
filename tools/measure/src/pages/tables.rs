//! The tables by their names, from the rows of `docs/data`.

use pinhole_apps_support::grouped::grouped;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

type Result<T> = std::result::Result<T, String>;

pub(super) fn table_of(name: &str) -> Result<String> {
    match name {
        "comparison" => comparison(),
        "scenes" => scenes(),
        "frames" => frames(),
        "bands" => bands(),
        "cores" => cores(),
        "cycles per instruction" => cycles_per_instruction(),
        "features" => features(),
        "vertex errors" => vertex_errors(),
        "depth errors" => depth_errors(),
        "texture errors" => texture_errors(),
        _ => match name.strip_prefix("growth ") {
            Some(way) => growth(way),
            None => Figures::named(name)?.table(),
        },
    }
}

/// Columns and their values.
struct Row(Map<String, Value>);

impl Row {
    fn get(&self, column: &str) -> Option<&Value> {
        self.0.get(column)
    }

    fn number(&self, column: &str) -> Result<f64> {
        self.get(column).and_then(Value::as_f64).ok_or_else(|| format!("no {column} in {:?}", self.0))
    }

    fn list(&self, column: &str) -> Vec<Value> {
        self.get(column).and_then(Value::as_array).cloned().unwrap_or_default()
    }

    fn text(&self, column: &str) -> String {
        shown(self.get(column))
    }

    fn texts<const N: usize>(&self, columns: [&str; N]) -> [String; N] {
        columns.map(|column| self.text(column))
    }

    fn has(&self, values: &[(&str, &str)]) -> bool {
        values.iter().all(|(column, value)| self.get(column) == Some(&Value::from(*value)))
    }
}

/// The rows of a file.
struct Rows(Vec<Row>);

impl Rows {
    fn read(file: &str) -> Result<Self> {
        let path = format!("docs/data/{file}.json");
        let parsed =
            serde_json::from_str::<Value>(&super::read(&path)?).map_err(|e| format!("{path}: {e}"))?;
        let rows: Vec<_> =
            serde_json::from_value(parsed["rows"].clone()).map_err(|e| format!("{path}: {e}"))?;
        Ok(Self(rows.into_iter().map(Row).collect()))
    }

    /// The row with these values.
    fn row(&self, values: &[(&str, &str)]) -> Result<&Row> {
        self.0.iter().find(|row| row.has(values)).ok_or_else(|| format!("no row {values:?}"))
    }

    fn cell(&self, scene: &str, variant: &str, core: &str) -> Result<&Row> {
        self.row(&[("scene", scene), ("variant", variant), ("core", core)])
    }

    /// The figure of a cell, or a dash.
    fn figure(&self, scene: &str, variant: &str, core: &str, column: &str) -> String {
        shown(self.cell(scene, variant, core).ok().and_then(|row| row.get(column)))
    }
}

/// A cell of a table: a text as it is, a number grouped, nothing as a dash.
fn shown(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "–".into(),
        Some(Value::String(text)) => text.clone(),
        Some(number) => match number.as_i64() {
            Some(whole) => signed(whole),
            None => number.to_string(),
        },
    }
}

fn signed(number: i64) -> String {
    format!("{}{}", if number < 0 { "−" } else { "" }, grouped(number.unsigned_abs()))
}

/// A number as three digits and a power of ten.
fn decimal(number: f64) -> String {
    let text = format!("{number:.2e}");
    let raised = |c: char| "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip("-0123456789".chars()).find(|(_, plain)| *plain == c);
    match text.split_once('e') {
        Some((digits, "0")) => digits.to_string(),
        Some((digits, power)) => {
            format!("{digits}·10{}", power.chars().filter_map(raised).map(|(c, _)| c).collect::<String>())
        }
        None => text,
    }
}

/// A table of Markdown; columns but the first are aligned to the right.
fn table(header: &[&str], lines: impl IntoIterator<Item = Vec<String>>) -> Result<String> {
    let mut text = format!("| {} |\n|---|{}\n", header.join(" | "), "--:|".repeat(header.len() - 1));
    for line in lines {
        text += &format!("| {} |\n", line.join(" | "));
    }
    Ok(text)
}

/// A table of `tables.json`, each cell of which is a figure of the row in the data that its row and its column name.
#[derive(Deserialize)]
struct Figures {
    data: String,
    /// The columns of the data that a row names, and those that a column names.
    keys: Vec<String>,
    of: Vec<String>,
    /// Headings before the figures: of what a row says, if it begins with that, and of its name.
    first: Vec<String>,
    /// Heading, values of `of`, and the figure's column.
    columns: Vec<Vec<String>>,
    rows: Vec<Vec<String>>,
}

impl Figures {
    fn named(name: &str) -> Result<Self> {
        let tables: BTreeMap<String, Self> =
            serde_json::from_str(include_str!("tables.json")).map_err(|e| format!("tables.json: {e}"))?;
        tables.into_iter().find(|table| table.0 == name).map(|table| table.1).ok_or("unknown".into())
    }

    fn header(&self) -> Vec<&str> {
        let columns = self.columns.iter().filter_map(|column| column.first());
        self.first.iter().chain(columns).map(String::as_str).collect()
    }

    fn lines(&self) -> Result<Vec<Vec<String>>> {
        let data = Rows::read(&self.data)?;
        let line = |row: &Vec<String>| {
            let (says, values) = row.split_at(row.len().saturating_sub(self.keys.len()));
            let figure = |column: &Vec<String>| {
                let [_, of @ .., figure] = &column[..] else { return shown(None) };
                let keys = self.keys.iter().chain(&self.of).zip(values.iter().chain(of));
                let keys: Vec<_> = keys.map(|(key, value)| (key.as_str(), value.as_str())).collect();
                shown(data.row(&keys).ok().and_then(|row| row.get(figure)))
            };
            let name = match values {
                [scene, variant] => Some(named(scene, variant)),
                _ => None,
            };
            says.iter().cloned().chain(name).chain(self.columns.iter().map(figure)).collect()
        };
        Ok(self.rows.iter().map(line).collect())
    }

    fn table(&self) -> Result<String> {
        table(&self.header(), self.lines()?)
    }
}

const CORES: [&str; 4] = ["M0", "M3", "M4F", "RV32"];

/// The scene, with the variant unless that is `plain`.
fn named(scene: &str, variant: &str) -> String {
    if variant == "plain" {
        scene.into()
    } else {
        format!("{scene} {variant}")
    }
}

/// The fastest other library with a projection and faces on a cell, and its instructions.
fn best<'a>(rivals: &'a Rows, scene: &str, variant: &str, core: &str) -> Option<(&'a str, i64)> {
    let cell = [("scene", scene), ("variant", variant), ("core", core)];
    let known = rivals.0.iter().filter(|row| row.has(&cell));
    let known =
        known.filter_map(|row| Some((row.get("library")?.as_str()?, row.get("instructions")?.as_i64()?)));
    known.min_by_key(|of| of.1)
}

/// The README's: speed and memory of a whole frame and of one in bands, and those of other libraries, which draw whole frames.
fn comparison() -> Result<String> {
    let (cells, rivals) = (Rows::read("cells")?, Rows::read("rivals")?);
    let ways = ["z", "bands8-z"];
    let mut lines = Vec::new();
    for core in ["M0", "M3", "M4F"] {
        let (library, count) = best(&rivals, "S3", "z", core).ok_or("no other library")?;
        let [whole, banded] = ways.map(|way| cells.figure("S3", way, core, "instructions"));
        let other = format!("{library} {}", signed(count));
        lines.push(vec![format!("instructions, Cortex-{core}"), whole, banded, other]);
    }
    let others = |columns: &[&str]| {
        let bytes = |row: &&Row| columns.iter().map(|column| row.get(column)?.as_i64()).sum::<Option<i64>>();
        let mut peers: Vec<&Row> = rivals.0.iter().filter(|row| row.get("code").is_some()).collect();
        peers.sort_by_key(bytes);
        let one =
            |peer: &&Row| format!("{} {} KB", peer.text("library"), (bytes(peer).unwrap_or(0) + 500) / 1000);
        peers.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    for (what, columns, without, of_others) in [
        ("bytes of RAM, stack included", &["ram", "stack"][..], 0, &["depth", "frame"][..]),
        ("bytes of code, without the mesh", &["flash"], TORUS, &["code"]),
    ] {
        let mut line = vec![what.to_string()];
        for way in ways {
            let cell = cells.cell("S3", way, "M3")?;
            let bytes = columns.iter().map(|column| cell.number(column)).sum::<Result<f64>>()?;
            line.push(signed(bytes as i64 - without));
        }
        line.push(others(of_others));
        lines.push(line);
    }
    table(&["", "whole frame", "bands of 8 rows", "other libraries, whole frame"], lines)
}

/// The torus in flash: 500 vertices of 6 bytes, and 1000 faces with a normal and a plane.
const TORUS: i64 = 500 * 6 + 1000 * (6 + 6 + 2);

/// The instructions of the cells that other libraries can draw, and those of the fastest.
fn scenes() -> Result<String> {
    let (figures, rivals) = (Figures::named("instructions")?, Rows::read("rivals")?);
    let others = ["M0", "M4F"];
    let mut lines = figures.lines()?;
    for (line, row) in lines.iter_mut().zip(&figures.rows) {
        let [scene, variant] = &row[..] else { return Err(format!("{row:?}: no cell")) };
        line.extend(others.map(|core| {
            let other = best(&rivals, scene, variant, core);
            other.map_or("–".into(), |(library, count)| format!("{library} {}", signed(count)))
        }));
    }
    table(&[&figures.header()[..], &["best other, M0", "best other, M4F"]].concat(), lines)
}

/// S3 with depth and S1 on each chip in bands.
fn frames() -> Result<String> {
    let (chips, frames) = (Rows::read("chips")?, Rows::read("frames")?);
    let mut lines = Vec::new();
    for chip in chips.0.iter().filter(|chip| chip.get("rows").is_some()) {
        for (scene, variant) in [("S1", "wire"), ("S3", "z")] {
            let name = chip.text("chip");
            let is_it = |frame: &&Row| {
                frame.has(&[("chip", &name), ("scene", scene), ("variant", variant)])
                    && frame.get("rows") == chip.get("rows")
            };
            let frame = frames.0.iter().find(is_it).ok_or("a frame is missing")?;
            let figures = frame.texts(["rows", "drawing_ms", "waits_percent", "fps_blocking", "fps_dma"]);
            lines.push([name, named(scene, variant)].into_iter().chain(figures).collect());
        }
    }
    let header = ["chip", "scene", "rows", "drawing, ms", "waits, %", "fps, blocking", "fps, DMA"];
    table(&header, lines)
}

fn bands() -> Result<String> {
    let cells = Rows::read("cells")?;
    let mut lines = Vec::new();
    for (depth, what) in [("", "without depth"), ("-z", "with depth")] {
        for core in CORES {
            let count =
                |variant: &str| cells.cell("S3", &format!("{variant}{depth}"), core)?.number("instructions");
            let [full, high, low] = [count("full")?, count("bands16")?, count("bands8")?];
            let mut line = vec![format!("{what}, {core}")];
            line.extend([full, high, low].map(|count| signed(count as i64)));
            line.extend([high, low].map(|count| format!("{:.2}", count / full)));
            lines.push(line);
        }
    }
    let header =
        ["S3", "in one piece", "bands of 16 rows", "of 8 rows", "16 rows / one piece", "8 rows / one piece"];
    table(&header, lines)
}

fn cores() -> Result<String> {
    let mut lines = Vec::new();
    for row in Rows::read("cores")?.0 {
        let [scene, variant, core, one, frame] = row.texts(["scene", "variant", "core", "one", "frame"]);
        let share = row.number("frame")? / row.number("one")?;
        lines.push(vec![
            format!("{}, code for {core}", named(&scene, &variant)),
            one,
            frame,
            format!("{share:.2}"),
        ]);
    }
    table(&["scene", "one core", "two cores", "two / one"], lines)
}

fn cycles_per_instruction() -> Result<String> {
    let line = |row: &Row| {
        let [all, least, most, ideal] =
            ["cycles", "least", "most", "cycles_without_waits"].map(|column| row.list(column));
        let of = |at: usize| {
            let one = shown(all.get(at));
            match (least.get(at), most.get(at)) {
                (Some(least), Some(most)) => format!("{one} ({least}–{most})"),
                _ if ideal.get(at) == all.get(at) => one,
                _ => format!("{one}, {} without waits", shown(ideal.get(at))),
            }
        };
        vec![row.text("chip"), row.text("mhz"), of(0), of(1), of(2)]
    };
    table(&["chip", "MHz", "lines", "faces", "faces with depth"], Rows::read("chips")?.0.iter().map(line))
}

/// The constants of a way to draw on all cores.
fn growth(way: &str) -> Result<String> {
    let rows = Rows::read("growth")?;
    let cores = CORES.map(|core| rows.row(&[("way", way), ("core", core)]));
    let cores = cores.into_iter().collect::<Result<Vec<_>>>()?;
    let line = |name: String, figure: &dyn Fn(&Row) -> String| {
        std::iter::once(name).chain(cores.iter().map(|core| figure(core))).collect()
    };
    let names = cores[0].list("names");
    let constants = names.iter().enumerate();
    let mut lines: Vec<Vec<String>> = constants
        .map(|(at, name)| line(shown(Some(name)), &|core| shown(core.list("constants").get(at))))
        .collect();
    if way != "placing" {
        let largest =
            |core: &Row, column: &str| core.list(column).get(1).and_then(Value::as_f64).unwrap_or(0.0);
        lines.push(line("largest error of a frame, %".into(), &|core| {
            let fitted = largest(core, "mean_and_largest_error_in_the_fit");
            fitted.max(largest(core, "mean_and_largest_error_elsewhere")).to_string()
        }));
    }
    table(&["", "M0", "M3", "M4F", "RV32"], lines)
}

/// A feature, an image with it, and one that draws alike without it.
const FEATURES: [[&str; 3]; 6] = [
    ["a screen door", "screen_door", "color"],
    ["half mixed", "half", "color"],
    ["a transparent colour", "keyed", "textured"],
    ["fog by vertex", "vertex_fog", "shades"],
    ["fog by pixel", "fogged", "color"],
    ["sprites", "sprites", "place"],
];

fn features() -> Result<String> {
    let rows = Rows::read("footprint")?;
    let mut lines = Vec::new();
    for [feature, with, without] in FEATURES {
        let of = |image| rows.row(&[("image", image), ("target", "thumbv7m-none-eabi"), ("level", "3")]);
        let (with, without) = (of(with)?, of(without)?);
        let added = with.number("flash")? - without.number("flash")?;
        lines.push(vec![feature.into(), without.text("says"), signed(added as i64)]);
    }
    table(&["feature", "beyond", "flash"], lines)
}

/// The largest of the three figures of an error: the others are a percentile and the root mean square.
fn largest(row: &Row, column: &str) -> f64 {
    row.list(column).first().and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// The rows of an error, grouped by a column's values.
fn errors<'a>(all: &'a Rows, error: &str, column: &str) -> Vec<(String, Vec<&'a Row>)> {
    let mut groups: Vec<(String, Vec<&Row>)> = Vec::new();
    for row in all.0.iter().filter(|row| row.has(&[("error", error)])) {
        let value = row.text(column);
        match groups.iter_mut().find(|group| group.0 == value) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((value, vec![row])),
        }
    }
    groups
}

/// The largest error of each mesh in all populations.
fn vertex_errors() -> Result<String> {
    let all = Rows::read("accuracy")?;
    let lines = errors(&all, "vertex, px", "mesh").into_iter().map(|(mesh, rows)| {
        let figure = |column| decimal(rows.iter().map(|row| largest(row, column)).fold(0.0, f64::max));
        vec![mesh, figure("before_snap"), figure("after_snap")]
    });
    let per_unit = all.row(&[("error", "vertex, px for each unit of r/z")])?.number("before_snap")?;
    let last = vec!["from r/z = 16 on, for each unit of r/z".into(), decimal(per_unit), "–".into()];
    table(&["mesh", "largest before the snap", "after it"], lines.chain([last]))
}

fn depth_errors() -> Result<String> {
    let all = Rows::read("accuracy")?;
    let lines = errors(&all, "depth, steps", "far_by_near").into_iter().map(|(_, rows)| {
        let far = rows.first().map_or(0.0, |row| row.number("far_by_near").unwrap_or_default());
        let figures = rows.iter().map(|row| decimal(largest(row, "after_rounding")));
        let bound = if far >= 2.0 { "1" } else { "–" };
        [far.to_string()].into_iter().chain(figures).chain([bound.into()]).collect()
    });
    table(&["far ÷ near", "largest, points and r/z ≤ 16", "r/z ≤ 300", "bound"], lines)
}

/// The errors of textures, and behind them the instructions of an M3 for each pixel, where a cell draws the scene.
fn texture_errors() -> Result<String> {
    let (all, cells) = (Rows::read("accuracy")?, Rows::read("cells")?);
    let lines = errors(&all, "texture, texels", "scene").into_iter().map(|(scene, rows)| {
        let mut line = vec![format!("{scene}: {}", rows[0].text("about"))];
        for row in rows {
            let error = decimal(largest(row, "beyond_1/64_px"));
            line.push(match row.get("cell").and_then(Value::as_str) {
                None => error,
                Some(cell) => {
                    let cell = cells.cell(cell, &row.text("variant"), "M3")?;
                    format!("{error}; {:.0}", cell.number("instructions")? / row.number("pixels")?)
                }
            });
        }
        Ok(line)
    });
    table(&["scene", "`Quarter`", "`Eighth`", "`Sixteenth`"], lines.collect::<Result<Vec<_>>>()?)
}
