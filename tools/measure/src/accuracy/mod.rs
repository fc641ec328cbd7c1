//! The errors of the library's integers against f64: docs/data/accuracy.json. The tables of docs/accuracy.md have the largest of them.

mod population;
mod sweep;
mod textures;

use clap::{ArgMatches, Command};
use pinhole_apps_support::command::complain;
use pinhole_apps_support::generated::Generated;
use population::{DESIGNS, POPULATIONS, RANGES};
use serde_json::{json, Value};
use std::process::ExitCode;
use sweep::{Pair, Sweep};

const PROGRAM: &str = "-p pinhole-measure -- accuracy";

pub(crate) fn command() -> Command {
    let about = "Measures the errors of the library's integers against f64";
    Generated::command("accuracy", about, "docs/data/accuracy.json")
}

pub(crate) fn run(given: &mut ArgMatches) -> Result<ExitCode, String> {
    let data = Generated::from(PROGRAM, given);
    let measured = Measured::new()?;
    if let Some(bound) = measured.broken() {
        complain(bound);
        return Ok(ExitCode::from(1));
    }
    let rows: Vec<_> = measured.rows().iter().map(Value::to_string).collect();
    let command = format!("cargo run --release {PROGRAM}");
    let text = format!("{{\n\"command\": \"{command}\",\n\"rows\": [\n{}\n]\n}}\n", rows.join(",\n"));
    data.finish_page(&text)
}

struct Measured {
    sweeps: Vec<Sweep>,
    /// For each ratio of far to near the errors of depth in all populations: of points and objects up to 16 times their distance, and
    /// up to 300.
    depths: Vec<[Pair; 2]>,
    textures: Vec<textures::Measured>,
}

/// The objects of the two columns of depths.
const OBJECTS: [&str; 2] = ["points and r/z ≤ 16", "r/z ≤ 300"];
/// The bounds that [`pinhole::draw::MeshInstance::project`] and [`pinhole::Camera::project`] document, in px and in depth steps; the latter from
/// a ratio of far to near on.
const PLACE: f64 = 1.0 / 256.0;
const DEPTH: (f64, f64) = (1.0, 2.0);

impl Measured {
    fn new() -> Result<Self, String> {
        // Each population has its own random numbers, so the order of threads changes nothing.
        let (sweeps, textures) = std::thread::scope(|scope| {
            let sweeps = POPULATIONS.each_ref().map(|population| scope.spawn(|| sweep::sweep(population)));
            let textures = textures::measure();
            (sweeps.map(|thread| thread.join()), textures)
        });
        let ended = |thread: std::thread::Result<Result<Sweep, String>>| {
            thread.unwrap_or_else(|_| Err("a sweep ended early".into()))
        };
        let mut sweeps = sweeps.into_iter().map(ended).collect::<Result<Vec<_>, _>>()?;
        let mut depths: Vec<[Pair; 2]> = RANGES.iter().map(|_| Default::default()).collect();
        for sweep in &mut sweeps {
            let of_all = depths.iter_mut().flatten().flatten();
            for (all, one) in of_all.zip(sweep.depths.iter_mut().flatten().flatten()) {
                all.append(std::mem::take(one));
            }
        }
        Ok(Self { sweeps, depths, textures: textures? })
    }

    /// A row for each measurement: the largest error, the 99.9th percentile and the root mean square.
    fn rows(&self) -> Vec<Value> {
        let mut rows = Vec::new();
        for (population, sweep) in POPULATIONS.iter().zip(&self.sweeps) {
            for ((_, mesh, _), [before, after]) in DESIGNS.into_iter().zip(&sweep.places) {
                rows.push(json!({"error": "vertex, px", "population": population.name, "mesh": mesh,
                    "before_snap": before.figures(), "after_snap": after.figures()}));
            }
        }
        let steepest = self.sweeps.iter().fold(0f64, |a, sweep| a.max(sweep.per_ratio));
        rows.push(json!({"error": "vertex, px for each unit of r/z", "before_snap": rounded(steepest)}));
        for (far, pairs) in RANGES.into_iter().zip(&self.depths) {
            for (objects, [before, after]) in OBJECTS.into_iter().zip(pairs) {
                rows.push(json!({"error": "depth, steps", "far_by_near": far, "objects": objects,
                    "before_rounding": before.figures(), "after_rounding": after.figures()}));
            }
        }
        rows.extend(self.textures.iter().flat_map(textures::Measured::rows));
        rows
    }

    /// A bound that does not hold.
    fn broken(&self) -> Option<String> {
        let bounded = RANGES.iter().zip(&self.depths).filter(|(far, _)| **far >= DEPTH.1);
        let depths = bounded.flat_map(|(_, pairs)| pairs).map(|pair| ("depth", "steps", pair, DEPTH.0));
        let places = self.sweeps.iter().flat_map(|sweep| &sweep.places);
        let places = places.map(|pair| ("vertex", "px", pair, PLACE));
        for (what, unit, [_, after], bound) in places.chain(depths) {
            if after.largest() > bound {
                return Some(format!("a {what} is {} {unit} off, the bound is {bound}", after.largest()));
            }
        }
        self.textures.iter().find_map(textures::Measured::broken)
    }
}

/// Millions of errors: those of one cell of a table.
#[derive(Clone, Default)]
pub(crate) struct Errors {
    all: Vec<f32>,
    squares: f64,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.all.push(error as f32);
        self.squares += error * error;
    }

    fn count(&self) -> usize {
        self.all.len()
    }

    fn append(&mut self, other: Self) {
        self.all.extend(other.all);
        self.squares += other.squares;
    }

    fn largest(&self) -> f64 {
        self.all.iter().fold(0f32, |a, &b| a.max(b)).into()
    }

    /// The maximum, the 99.9th percentile and the root mean square, of three digits each.
    fn figures(&self) -> [f64; 3] {
        let mut all = self.all.clone();
        let percentile = (all.len() - all.len() / 1000).checked_sub(1);
        let nearly = percentile.map_or(0.0, |at| *all.select_nth_unstable_by(at, f32::total_cmp).1);
        let mean = (self.squares / all.len().max(1) as f64).sqrt();
        [self.largest(), nearly.into(), mean].map(rounded)
    }
}

/// A number of three digits.
fn rounded(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}
