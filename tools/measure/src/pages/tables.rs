//! The tables by their names, from the rows of `docs/data`.

use pinhole_apps_support::grouped;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

type Result<T> = std::result::Result<T, String>;

pub(super) fn table_of(name: &str) -> Result<String> {
    match name {
        "comparison" => comparison(),
        "scenes" => scenes(),
        "frames" => frames(),
        "cycles per instruction" => cycles_per_instruction(),
        "features" => features(),
        "vertex errors" => vertex_errors(),
        "depth errors" => depth_errors(),
        "texture errors" => texture_errors(),
        _ => match name.strip_prefix("growth ") {
            Some(way) => growth(way),
            None => {
                let figures = Figures::named(name)?;
                Ok(table(&figures.header(), figures.lines()?))
            }
        },
    }
}

/// The rows of a file; a figure that is not there is null.
struct Rows(Vec<Value>);

impl Rows {
    fn read(file: &str) -> Result<Self> {
        let path = format!("docs/data/{file}.json");
        let parsed: Value = serde_json::from_str(&super::read(&path)?).map_err(|e| format!("{path}: {e}"))?;
        Ok(Self(parsed["rows"].as_array().ok_or(format!("{path}: no rows"))?.clone()))
    }

    fn all(&self, values: &[(&str, &str)]) -> Vec<&Value> {
        let has = |row: &&Value| values.iter().all(|(column, value)| row[*column] == *value);
        self.0.iter().filter(has).collect()
    }

    /// The row with these values.
    fn row(&self, values: &[(&str, &str)]) -> &Value {
        self.all(values).first().copied().unwrap_or(&Value::Null)
    }

    fn cell(&self, scene: &str, variant: &str, core: &str) -> &Value {
        self.row(&[("scene", scene), ("variant", variant), ("core", core)])
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// A cell of a table: a text as it is, a number grouped, nothing as a dash.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "–".into(),
        Value::String(text) => text.clone(),
        number => number.as_i64().map_or_else(|| number.to_string(), signed),
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
fn table(header: &[&str], lines: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|---|{}\n", header.join(" | "), "--:|".repeat(header.len() - 1));
    for line in lines {
        text += &format!("| {} |\n", line.join(" | "));
    }
    text
}

/// A table of `tables.json`, each cell of which is a figure of the row in the data that its row and its column name.
#[derive(Deserialize)]
struct Figures {
    data: String,
    /// The columns of the data that a row names, and those that a column names. What a row has for `*` takes its place in the values of a
    /// column.
    keys: Vec<String>,
    of: Vec<String>,
    /// Headings before the figures: of what a row says, if it begins with that, and of its name.
    first: Vec<String>,
    /// Heading, values of `of`, and the figure's column; or heading, `÷`, and the headings of the columns whose ratio it shows.
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
            let star = self.keys.iter().zip(values).find(|pair| pair.0 == "*").map_or("", |pair| pair.1);
            let figure = |column: &Vec<String>| {
                let [_, of @ .., figure] = &column[..] else { return &Value::Null };
                let of: Vec<String> = of.iter().map(|value| value.replace('*', star)).collect();
                let keys = self.keys.iter().chain(&self.of).zip(values.iter().chain(&of));
                let keys = keys.filter(|(key, _)| *key != "*");
                let keys: Vec<_> = keys.map(|(key, value)| (key.as_str(), value.as_str())).collect();
                &data.row(&keys)[figure]
            };
            let under = |heading: &String| self.columns.iter().find(|column| column[0] == *heading);
            let cell = |column: &Vec<String>| match &column[..] {
                [_, sign, above, below] if sign == "÷" => {
                    let [above, below] = [above, below]
                        .map(|heading| under(heading).map_or(f64::NAN, |of| number(figure(of))));
                    format!("{:.2}", above / below)
                }
                _ => shown(figure(column)),
            };
            let name = (self.keys == ["scene", "variant"]).then(|| named(&values[0], &values[1]));
            says.iter().cloned().chain(name).chain(self.columns.iter().map(cell)).collect()
        };
        Ok(self.rows.iter().map(line).collect())
    }
}

const CORES: [&str; 4] = ["M0", "M3", "M4F", "RV32"];

/// The scene, with the variant unless that is `plain`.
fn named(scene: &str, variant: &str) -> String {
    format!("{scene} {variant}").trim_end_matches(" plain").into()
}

/// The fastest other library with a projection and faces on a cell, and its instructions.
fn best(rivals: &Rows, scene: &str, variant: &str, core: &str) -> String {
    let cell = [("scene", scene), ("variant", variant), ("core", core)];
    let best =
        rivals.all(&cell).into_iter().min_by_key(|row| row["instructions"].as_i64().unwrap_or(i64::MAX));
    best.map_or("–".into(), |row| format!("{} {}", shown(&row["library"]), shown(&row["instructions"])))
}

/// The README's: speed and memory of a whole frame and of one in bands, and those of other libraries, which draw whole frames.
fn comparison() -> Result<String> {
    let (cells, rivals) = (Rows::read("cells")?, Rows::read("rivals")?);
    let line = |what: &str, of: &dyn Fn(&str) -> String, others: String| {
        vec![what.to_string(), of("z"), of("bands8-z"), others]
    };
    let mut lines = Vec::new();
    for core in ["M0", "M3", "M4F"] {
        let of = |way: &str| shown(&cells.cell("S3", way, core)["instructions"]);
        lines.push(line(&format!("instructions, Cortex-{core}"), &of, best(&rivals, "S3", "z", core)));
    }
    let mut peers: Vec<&Value> = rivals.0.iter().filter(|row| !row["code"].is_null()).collect();
    for (what, columns, without, of_others) in [
        ("bytes of RAM, stack included", &["ram", "stack"][..], 0, &["depth", "frame"][..]),
        ("bytes of code, without the mesh", &["flash"], TORUS, &["code"]),
    ] {
        let bytes =
            |row: &Value, columns: &[&str]| columns.iter().map(|column| number(&row[*column])).sum::<f64>();
        let of = |way: &str| signed(bytes(cells.cell("S3", way, "M3"), columns) as i64 - without);
        peers.sort_by(|a, b| bytes(a, of_others).total_cmp(&bytes(b, of_others)));
        let one =
            |peer: &&Value| format!("{} {:.0} KB", shown(&peer["library"]), bytes(peer, of_others) / 1000.0);
        lines.push(line(what, &of, peers.iter().map(one).collect::<Vec<_>>().join(", ")));
    }
    Ok(table(&["", "whole frame", "bands of 8 rows", "other libraries, whole frame"], lines))
}

/// The torus in flash: 500 vertices of 6 bytes, and 1000 faces with a normal and a plane.
const TORUS: i64 = 500 * 6 + 1000 * (6 + 6 + 2);

/// The instructions of the cells that other libraries can draw, and those of the fastest.
fn scenes() -> Result<String> {
    let (figures, rivals) = (Figures::named("instructions")?, Rows::read("rivals")?);
    let mut lines = figures.lines()?;
    for (line, row) in lines.iter_mut().zip(&figures.rows) {
        line.extend(["M0", "M4F"].map(|core| best(&rivals, &row[0], &row[1], core)));
    }
    Ok(table(&[&figures.header()[..], &["best other, M0", "best other, M4F"]].concat(), lines))
}

/// S3 with depth and S1 on each chip in bands.
fn frames() -> Result<String> {
    let (chips, frames) = (Rows::read("chips")?, Rows::read("frames")?);
    let mut lines = Vec::new();
    for chip in chips.0.iter().filter(|chip| !chip["rows"].is_null()) {
        for (scene, variant) in [("S1", "wire"), ("S3", "z")] {
            let name = shown(&chip["chip"]);
            let keys = [("chip", name.as_str()), ("scene", scene), ("variant", variant)];
            let frame = frames.all(&keys).into_iter().find(|frame| frame["rows"] == chip["rows"]);
            let frame = frame.ok_or("a frame is missing")?;
            let figures = ["rows", "drawing_ms", "waits_percent", "fps_blocking", "fps_dma"];
            let figures = figures.map(|column| shown(&frame[column]));
            lines.push([name.clone(), named(scene, variant)].into_iter().chain(figures).collect());
        }
    }
    let header = ["chip", "scene", "rows", "drawing, ms", "waits, %", "fps, blocking", "fps, DMA"];
    Ok(table(&header, lines))
}

fn cycles_per_instruction() -> Result<String> {
    let data = Rows::read("chips")?;
    let lines = data.0.iter().map(|row| {
        let of = |at: usize| {
            let [all, least, most, ideal] =
                ["cycles", "least", "most", "cycles_without_waits"].map(|column| &row[column][at]);
            match (all, least, ideal) {
                (all, Value::Number(_), _) => format!("{} ({least}–{most})", shown(all)),
                (all, _, ideal) if all == ideal => shown(all),
                (all, ..) => format!("{}, {} without waits", shown(all), shown(ideal)),
            }
        };
        vec![shown(&row["chip"]), shown(&row["mhz"]), of(0), of(1), of(2)]
    });
    Ok(table(&["chip", "MHz", "lines", "faces", "faces with depth"], lines))
}

/// The constants of a way to draw on all cores.
fn growth(way: &str) -> Result<String> {
    let rows = Rows::read("growth")?;
    let cores = CORES.map(|core| rows.row(&[("way", way), ("core", core)]));
    let names = cores[0]["names"].as_array().ok_or("no such way")?;
    let line = |name: String, figure: &dyn Fn(&Value) -> String| {
        std::iter::once(name).chain(cores.iter().map(|core| figure(core))).collect()
    };
    let constants = names.iter().enumerate();
    let mut lines: Vec<Vec<String>> =
        constants.map(|(at, name)| line(shown(name), &|core| shown(&core["constants"][at]))).collect();
    if way != "placing" {
        lines.push(line("largest error of a frame, %".into(), &|core| {
            let fits = ["mean_and_largest_error_in_the_fit", "mean_and_largest_error_elsewhere"];
            fits.map(|fit| core[fit][1].as_f64().unwrap_or(0.0)).into_iter().fold(0.0, f64::max).to_string()
        }));
    }
    Ok(table(&["", "M0", "M3", "M4F", "RV32"], lines))
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
    let lines = FEATURES.map(|[feature, with, without]| {
        let [with, without] = [with, without]
            .map(|image| rows.row(&[("image", image), ("target", "thumbv7m-none-eabi"), ("level", "3")]));
        let added = number(&with["flash"]) - number(&without["flash"]);
        vec![feature.into(), shown(&without["says"]), signed(added as i64)]
    });
    Ok(table(&["feature", "beyond", "flash"], lines))
}

/// The rows of an error, grouped by a column's values.
fn errors<'a>(all: &'a Rows, error: &str, column: &str) -> Vec<(String, Vec<&'a Value>)> {
    let mut groups: Vec<(String, Vec<&Value>)> = Vec::new();
    for row in all.0.iter().filter(|row| row["error"] == error) {
        let value = shown(&row[column]);
        match groups.iter_mut().find(|group| group.0 == value) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((value, vec![row])),
        }
    }
    groups
}

/// The largest error of each mesh in all populations. The largest of an error's three figures is the first: the others are a percentile
/// and the root mean square.
fn vertex_errors() -> Result<String> {
    let all = Rows::read("accuracy")?;
    let lines = errors(&all, "vertex, px", "mesh").into_iter().map(|(mesh, rows)| {
        let figure = |column| decimal(rows.iter().map(|row| number(&row[column][0])).fold(0.0, f64::max));
        vec![mesh, figure("before_snap"), figure("after_snap")]
    });
    let per_unit = number(&all.row(&[("error", "vertex, px for each unit of r/z")])["before_snap"]);
    let last = vec!["from r/z = 16 on, for each unit of r/z".into(), decimal(per_unit), "–".into()];
    Ok(table(&["mesh", "largest before the snap", "after it"], lines.chain([last])))
}

fn depth_errors() -> Result<String> {
    let all = Rows::read("accuracy")?;
    let lines = errors(&all, "depth, steps", "far_by_near").into_iter().map(|(_, rows)| {
        let far = number(&rows[0]["far_by_near"]);
        let figures = rows.iter().map(|row| decimal(number(&row["after_rounding"][0])));
        let bound = if far >= 2.0 { "1" } else { "–" };
        [far.to_string()].into_iter().chain(figures).chain([bound.into()]).collect()
    });
    Ok(table(&["far ÷ near", "largest, points and r/z ≤ 16", "r/z ≤ 300", "bound"], lines))
}

/// The errors of textures, and behind them the instructions of an M3 for each pixel, where a cell draws the scene.
fn texture_errors() -> Result<String> {
    let (all, cells) = (Rows::read("accuracy")?, Rows::read("cells")?);
    let lines = errors(&all, "texture, texels", "scene").into_iter().map(|(scene, rows)| {
        let figure = |row: &&Value| {
            let error = decimal(number(&row["beyond_1/64_px"][0]));
            let Some(cell) = row["cell"].as_str() else { return error };
            let cell = cells.cell(cell, &shown(&row["variant"]), "M3");
            format!("{error}; {:.0}", number(&cell["instructions"]) / number(&row["pixels"]))
        };
        let name = format!("{scene}: {}", shown(&rows[0]["about"]));
        std::iter::once(name).chain(rows.iter().map(figure)).collect()
    });
    Ok(table(&["scene", "`Quarter`", "`Eighth`", "`Sixteenth`"], lines))
}
