//! `pinhole-import MODEL -o OUT.rs`: a model as Rust source.

use clap::builder::PossibleValuesParser;
use clap::parser::ValueSource;
use clap::{value_parser, Arg, ArgAction, ArgMatches, Command};
use indicatif::{ProgressBar, ProgressStyle};
use pinhole_import::host::{self, complain, say, warn};
use pinhole_import::{arguments, Centre, Edges, ImportedMesh, IndexedPicture, Options, Report};
use pinhole_import::{Step, TextureFormat, Topology};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

fn main() -> ExitCode {
    match run(&command().get_matches()).and_then(say) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            complain(problem);
            ExitCode::from(2)
        }
    }
}

fn command() -> Command {
    let path = |name: &'static str| Arg::new(name).required(true).value_parser(value_parser!(PathBuf));
    let flag = |name: &'static str| Arg::new(name).long(name).action(ArgAction::SetTrue);
    let word = |name: &'static str, value: &'static str| Arg::new(name).long(name).value_name(value);
    let choice = |name: &'static str, values: &[&'static str]| {
        Arg::new(name).long(name).value_parser(PossibleValuesParser::new(values.to_vec()))
    };
    // Negative numbers too, so that the message says why they make no sense, not that they are unexpected.
    let number =
        |name, value| word(name, value).allow_negative_numbers(true).value_parser(value_parser!(f64));
    let triangles = |text: &str| text.parse::<usize>().map_err(|_| "give a whole number of triangles");
    Command::new("pinhole-import")
        .about("Turns a model into Rust source for pinhole")
        .version(env!("CARGO_PKG_VERSION"))
        .arg(path("MODEL").help("The model to read: .obj, or .stl, binary or ASCII"))
        .arg(path("output").short('o').long("output").value_name("OUT.rs").help("The Rust file to write"))
        .arg(word("name", "NAME").default_value("MESH").help("The constant's name"))
        .arg(choice("edges", &["all", "feature", "creases-first", "none"]).default_value("all").help(
            "Which edges: all of all triangles; feature, edges where the surface turns by more than --feature-angle, \
             or ends, so that flat faces have no diagonals; creases-first, all edges, feature edges first, and their number \
             NAME_CREASES, for smooth edges; or none",
        ))
        .arg(number("feature-angle", "DEGREES").default_value("30").help(
            "How far the surface turns at a feature edge or crease, 0 to 180",
        ))
        .arg(flag("edge-faces").help("The two faces beside each edge, for hidden lines and smooth edges: 4 bytes an edge"))
        .arg(choice("normals", &["face", "vertex", "both", "none"]).default_value("face").help(
            "For light by faces, or smooth by vertices: 6 bytes each",
        ))
        .arg(flag("planes").help("The plane of each face, for early back-face culling: 2 bytes a face"))
        .arg(flag("clusters").help(
            "Order faces into clusters, for meshes much of which is out of view or turned away: 2.5 bytes a face, with planes",
        ))
        .arg(choice("texture", &["2", "4", "16", "256"]).value_name("COLORS").help(
            "Write the picture of the materials (map_Kd, PNG or BMP) as texels of 1, 2, 4 or 8 bits and a palette",
        ))
        .arg(word("texture-color", "TYPE").help(
            "The type of the palette's colours [default: embedded_graphics::pixelcolor::Rgb565]",
        ))
        .arg(flag("texture-mips").help("Mip levels beside the picture, in as many bytes again, against sparkling in the distance"))
        .args(arguments::arguments())
        .arg(choice("centre", &["box", "origin"]).default_value("box").help(
            "What becomes the origin: the centre of the bounding box, or the file's origin",
        ))
        .arg(number("fit", "LENGTH").help("Scale so that the longest side has this length, before --decimate"))
        .arg(flag("keep-order").help("Leave faces and vertices in the file's order"))
        .arg(word("decimate", "N").allow_negative_numbers(true).value_parser(triangles).help(DECIMATE))
        .arg(flag("arrays").help("Write VERTICES, FACES and so on as constants of their own, for code that reads the lists"))
}

const DECIMATE: &str = if cfg!(feature = "decimate") {
    "Reduce to at most N triangles"
} else {
    "Reduce to at most N triangles. Not in this build: install with --features decimate, which needs a C++ compiler"
};

fn options(given: &ArgMatches) -> Options {
    let word = |name: &str| given.get_one::<String>(name).map_or("", String::as_str);
    let degrees = given.get_one("feature-angle").copied().unwrap_or(30.0);
    Options {
        fit: given.get_one("fit").copied(),
        decimate: given.get_one("decimate").copied(),
        centre: if word("centre") == "origin" { Centre::Origin } else { Centre::Box },
        reorder: !given.get_flag("keep-order"),
        edges: match word("edges") {
            "feature" => Edges::Feature { degrees },
            "creases-first" => Edges::CreasesFirst { degrees },
            "none" => Edges::None,
            _ => Edges::All,
        },
        edge_faces: given.get_flag("edge-faces"),
        normals: matches!(word("normals"), "face" | "both"),
        planes: given.get_flag("planes"),
        clusters: given.get_flag("clusters"),
        vertex_normals: matches!(word("normals"), "vertex" | "both"),
        texture: texture(given),
        ..arguments::options(given)
    }
}

fn texture(given: &ArgMatches) -> Option<TextureFormat> {
    let word = |name: &str| given.get_one::<String>(name);
    let colors = word("texture")?.parse().ok()?; // one of the choices
    let color = word("texture-color").cloned().unwrap_or(TextureFormat::default().color);
    Some(TextureFormat { colors, color, mip_levels: given.get_flag("texture-mips") })
}

/// Refuses options that would change nothing.
fn refuse_idle(given: &ArgMatches) -> Result<(), String> {
    let typed = |name| given.value_source(name) == Some(ValueSource::CommandLine);
    let word = |name: &str| given.get_one::<String>(name).map_or("", String::as_str);
    let has_idle_angle = typed("feature-angle") && !matches!(word("edges"), "feature" | "creases-first");
    let what = "--feature-angle: is that of --edges feature or creases-first: give one of them, too";
    refuse(has_idle_angle, what)?;
    for option in ["texture-color", "texture-mips"] {
        let what = format!("--{option}: is that of --texture COLORS: give this, too");
        refuse(typed(option) && !typed("texture"), what)?;
    }
    let has_idle_name = typed("name") && given.get_flag("arrays");
    refuse(has_idle_name, "--name: is that of a mesh, and --arrays writes lists, whose names are fixed")
}

fn refuse(is_wrong: bool, what: impl Into<String>) -> Result<(), String> {
    (!is_wrong).then_some(()).ok_or_else(|| what.into())
}

fn run(given: &ArgMatches) -> Result<String, String> {
    refuse_idle(given)?;
    let path = |name: &str| given.get_one::<PathBuf>(name).cloned().unwrap_or_default();
    let (model, output) = (path("MODEL"), path("output"));
    let name = given.get_one::<String>("name").map_or("MESH", String::as_str);

    let what = "-: standard input is not read, as the name tells the format: name a file (.obj, .stl)";
    refuse(model.as_os_str() == "-", what)?;
    let what = "--output: - is no file, and standard output has the report: name a file";
    refuse(output.as_os_str() == "-", what)?;
    let what = "is the model itself, or a file that it names: name another output";
    let apart = |input: &Path| refuse(host::is_same(input, &output), format!("{}: {what}", output.display()));
    apart(&model)?;
    let bar = progress();
    let mesh = pinhole_import::import_with(&model, &options(given), |step| {
        bar.set_message(doing(step));
        bar.inc(1);
    });
    bar.finish_and_clear();
    let mesh = mesh.map_err(|e| e.to_string())?;
    mesh.files.iter().try_for_each(|file| apart(file))?;
    warn(&model, &mesh.warnings);

    let root = path("root");
    let command = command_line([&model, &output, &root]);
    let source = if given.get_flag("arrays") {
        mesh.to_rust(&command)
    } else {
        mesh.to_rust_mesh(name, &model, &command)
            .ok_or_else(|| format!("--name {name}: is not a constant's: capital letters, digits and _"))?
    };
    host::write(&output, source.as_bytes())
        .map_err(|e| format!("{}: cannot be written: {e}", output.display()))?;
    Ok(format!("{}: {}", output.display(), report(&mesh)))
}

/// On standard error, and only where that is a terminal.
fn progress() -> ProgressBar {
    let bar = ProgressBar::new(6);
    if let Ok(style) = ProgressStyle::with_template("{spinner} {bar:20} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

fn doing(step: Step) -> &'static str {
    match step {
        Step::Read => "reading",
        Step::Weld => "welding vertices",
        Step::Decimate => "taking triangles away",
        Step::Quantise => "rounding to the grid",
        Step::Order => "ordering faces",
        Step::Derive => "finding edges and normals",
        _ => "working",
    }
}

/// The command line, for the header of the file. Of paths it has only the files' names, so it is equal on every machine.
fn command_line(paths: [&Path; 3]) -> String {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    std::env::args_os().skip(1).fold("pinhole-import".to_string(), |line, word| {
        let mut word = word.to_string_lossy().into_owned();
        for path in paths {
            let start = word.strip_suffix(&*path.to_string_lossy());
            // The path alone, or behind an option: `--root=PATH`, `-oPATH`.
            if let Some(start) = start.filter(|start| start.is_empty() || start.starts_with('-')) {
                word = start.to_string() + &name(path);
            }
        }
        line + " " + &word
    })
}

fn report(mesh: &ImportedMesh) -> String {
    let Report { vertices_read, faces_read, welded, welded_by_quantising, .. } = mesh.report;
    let Report { degenerate, duplicate, unused, extent, error, fetches: [before, after], .. } = mesh.report;
    let Report { reversed, backs, decimated, decimation_error, .. } = mesh.report;
    let Topology { open, crowded, twisted } = mesh.topology();
    let (size, exponent, centre, volume) = (mesh.size(), mesh.exponent, mesh.offset, mesh.volume());
    let mut text = format!(
        "{size}\n\
         read {vertices_read} vertices and {faces_read} triangles; merged {welded} duplicate vertices ({welded_by_quantising} after rounding); dropped {degenerate} degenerate and {duplicate} duplicate faces, {unused} unused vertices\n\
         step 2^{exponent}; extent {extent}, largest error of a coordinate {error:.3e}; centre {centre:?}; volume {volume:.6}\n\
         edges: {open} open, {crowded} in more than two faces, {twisted} between faces of opposite winding\n\
         vertices fetched for a face, with a cache of 16: {before:.2} in the file's order, {after:.2} in the mesh's"
    );
    if let Some(picture @ IndexedPicture { width, height, palette, error, .. }) = &mesh.picture {
        let (colours, bytes) = (palette.len(), picture.flash_bytes());
        text += &format!(
            "\ntexture of {width} x {height} texels, {colours} colours: {bytes} bytes of flash; largest error of a channel {error} of 255"
        );
    }
    if reversed > 0 {
        text += &format!("\nreversed {reversed} faces");
    }
    if backs > 0 {
        text += &format!("\nadded {backs} backs of faces");
    }
    if decimated > 0 {
        text += &format!(
            "\ndecimation took {decimated} faces away, and moved the surface by about {decimation_error:.1e}"
        );
    }
    text
}
