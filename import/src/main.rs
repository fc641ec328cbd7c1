//! `pinhole-import MODEL -o OUT.rs`: a model as Rust source.

use clap::{value_parser, Arg, Command};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let path = |name: &'static str| Arg::new(name).required(true).value_parser(value_parser!(PathBuf));
    let mut given = Command::new("pinhole-import")
        .about("Turns a model into Rust source for pinhole")
        .version(env!("CARGO_PKG_VERSION"))
        .arg(path("MODEL").help("The model to read (.obj, .stl)"))
        .arg(path("output").short('o').long("output").value_name("OUT.rs").help("The Rust file to write"))
        .get_matches();
    let [model, output] =
        ["MODEL", "output"].map(|name| given.remove_one::<PathBuf>(name).unwrap_or_default());
    match run(&model, &output) {
        Ok(report) => {
            println!("{report}");
            ExitCode::SUCCESS
        }
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::from(2)
        }
    }
}

fn run(model: &Path, output: &Path) -> Result<String, String> {
    let mesh = pinhole_import::read(model).map_err(|e| e.to_string())?;
    mesh.mesh().map_err(|e| format!("{}: {e}", model.display()))?;
    let command = format!("pinhole-import {} -o {}", model.display(), output.display());
    std::fs::write(output, mesh.to_rust(&command))
        .map_err(|e| format!("{}: cannot be written: {e}", output.display()))?;
    let (report, topology) = (mesh.report, mesh.topology());
    Ok(format!(
        "{}: {} vertices, {} faces, {} edges\n\
         read {} vertices and {} triangles; welded {} (and {} by quantising); dropped {} degenerate and {} duplicate faces, {} unused vertices\n\
         step 2^{}; extent {}, largest error of a coordinate {:.3e}; centre {:?}; volume {:.6}\n\
         edges: {} open, {} in more than two faces, {} between faces of opposite winding",
        output.display(),
        mesh.vertices.len(),
        mesh.faces.len(),
        mesh.edges.len(),
        report.vertices_read,
        report.faces_read,
        report.welded,
        report.welded_by_quantising,
        report.degenerate,
        report.duplicate,
        report.unused,
        mesh.exponent,
        report.extent,
        report.error,
        mesh.offset,
        mesh.volume(),
        topology.open,
        topology.crowded,
        topology.twisted,
    ))
}
