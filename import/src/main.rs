//! `pinhole-import MODEL.obj -o OUT.rs`: a model as Rust source.

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// Turn a model into Rust source for pinhole.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// The model to read (.obj)
    model: PathBuf,
    /// The Rust file to write
    #[arg(short, long, value_name = "OUT.rs")]
    output: PathBuf,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
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

fn run(Arguments { model, output }: &Arguments) -> Result<String, String> {
    let mesh = pinhole_import::read(model).map_err(|e| e.to_string())?;
    mesh.mesh().map_err(|e| format!("{}: {e:?}", model.display()))?;
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
