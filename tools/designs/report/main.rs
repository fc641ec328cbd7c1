//! Measures number designs of the vertex chain and writes `docs/speed-vs-error.md` with its plot. `tools/designs/run`
//! starts it.

use support::bridge;
use support::oracle;
#[allow(dead_code)] // other ways to give a vertex, and classes of depth
#[path = "../../measure/src/accuracy/population.rs"]
mod population;

mod about;
mod cross;
mod edges;
mod errors;
mod exact;
#[path = "../../bench/report/grouped.rs"]
mod grouped;
mod number;
mod page;
mod plot;
mod rule;
mod speed;
mod sweep;

use std::process::ExitCode;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error + Send + Sync>>;

const PAGE: &str = "docs/speed-vs-error.md";
const PLOT: &str = "docs/speed-vs-error.svg";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let check = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => false,
        ["--check"] => true,
        _ => {
            eprintln!("tools/designs/run [--check]");
            return ExitCode::from(2);
        }
    };
    match run(check) {
        Ok(failures) if failures.is_empty() => ExitCode::SUCCESS,
        Ok(failures) => {
            failures.iter().for_each(|failure| eprintln!("designs: {failure}"));
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("designs: {error}");
            ExitCode::from(2)
        }
    }
}

/// The measured speed and errors of a design.
struct Measured {
    about: &'static about::About,
    /// Instructions a vertex, in the order of [`speed::CORES`].
    speed: [f64; speed::CORES.len()],
    errors: errors::Errors,
    edges: edges::Edges,
}

/// Measures everything. Returns what does not hold, one text for each failure.
fn run(check: bool) -> Result<Vec<String>> {
    let compiler = cross::compiler()?;
    // The compilers keep all cores busy; what is measured on the host comes after.
    let speeds = speed::measure()?;
    let (errors, edges) = std::thread::scope(|scope| {
        let edges = scope.spawn(edges::measure);
        let errors = sweep::measure();
        (errors, edges.join())
    });
    let (errors, edges) = (errors?, edges.map_err(|_| "the edges")??);
    let each = about::ALL.iter().zip(speeds).zip(errors).zip(edges);
    let measured: Vec<Measured> =
        each.map(|(((about, speed), errors), edges)| Measured { about, speed, errors, edges }).collect();
    let mut failures = rule::broken(&measured);
    for (file, text) in [(PAGE, page::text(&compiler, &measured)), (PLOT, plot::svg(&measured)?)] {
        let path = cross::root().join(file);
        if !check {
            std::fs::write(&path, text)?;
            println!("{file}");
            continue;
        }
        let old = std::fs::read_to_string(&path).map_err(|error| format!("{file}: {error}"))?;
        let differences: Vec<String> = page::differences(&old, &text);
        if let Some(first) = differences.first() {
            let count = differences.len();
            let what = format!("{file}: not current, {count} lines differ: tools/designs/run\n{first}");
            // Other counts by another compiler are no fault.
            if page::is_of(&std::fs::read_to_string(cross::root().join(PAGE))?, &compiler) {
                failures.push(what);
            } else {
                println!("{what}\n(another compiler's)");
            }
        }
    }
    Ok(failures)
}
