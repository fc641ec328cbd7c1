//! Pictures as firmware draws them: by the build script and the drawing code of `boards/any-cortex-m`, which are compiled here,
//! too, or by those of a project that was made from a template, which are compiled when they are needed (`apps/preview`).

use embedded_graphics::pixelcolor::Rgb565;
use pinhole::{draw::Statistics, Angle};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{ImportedMesh, Options};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

#[allow(dead_code, unreachable_pub)] // as a file of its own it is right; the bytes are the firmware's
#[path = "../../../boards/common/one-strip/src/picture.rs"]
mod picture;
#[allow(dead_code, unreachable_pub)] // its `main` is for cargo
#[path = "../../../boards/common/all/build.rs"]
mod script;

crate::draws_into_a_target!(picture);

/// Frames of a turn, as the templates' `main.rs` have it.
pub const FRAMES: u32 = 120;

/// Rows of a band. Any number gives the same pixels.
pub const ROWS: u32 = 8;

/// The parts of a firmware project that draw its picture, compiled for the host.
pub struct Code {
    /// The folder of the project, if it is not the template that this program has.
    pub project: Option<&'static str>,
    /// The importer's options in the build script.
    pub options: fn() -> Options,
    /// Draws the model, turned by an angle: the first frame is at angle 0. The error is what the firmware would log before it
    /// stops.
    pub draw: fn(&ImportedMesh, Angle, &mut Canvas<Rgb565>) -> Result<Statistics, String>,
}

/// The template `boards/any-cortex-m`.
pub const TEMPLATE: Code = Code { project: None, options: script::options, draw };

/// The importer's options in the build script, changed by the options that were given here.
pub fn options(code: &Code, given: &Options) -> Options {
    let own = (code.options)();
    Options {
        up: given.up.or(own.up),
        flip: given.flip || own.flip,
        fix_winding: given.fix_winding || own.fix_winding,
        two_sided: given.two_sided || own.two_sided,
        root: given.root.clone().or(own.root),
        ..own
    }
}

/// Defines `draw`, which draws a model by a module made of a `picture.rs` into any target in 16-bit colour, for a `picture.rs`
/// that has `camera` and `draw`.
#[macro_export]
macro_rules! draws_into_a_target {
    ($picture:ident) => {
        $crate::draws!($picture, |mesh, color, turn, display, screen, buffers| {
            let $crate::firmware::Buffers { cache, bins, strip, depths, .. } = &mut buffers;
            let mut memory = $picture::Memory::new(cache, bins, strip, depths);
            let camera = $picture::camera(&mesh, screen)?;
            let send = |area: &_, pixels: &[u8]| {
                let pixels = pixels.as_chunks().0.iter().map(|&pixel| u16::from_be_bytes(pixel));
                let colors =
                    pixels.map(|pixel| embedded_graphics::pixelcolor::raw::RawU16::new(pixel).into());
                display.fill_contiguous(area, colors).map_err(|_| "the display refused the pixels")
            };
            Ok($picture::draw(&mesh, color, &camera, turn, &mut memory, screen, send)?.statistics)
        });
    };
}

/// Like [`draws_into_a_target!`], for a `picture.rs` that passes its bands to DMA: one that has `Picture` and `Turned`. One that
/// smooths edges has a field `smoothing`, whose type is named, too: `draws_bands!(picture, Deg0, Smoothing)`.
#[macro_export]
macro_rules! draws_bands {
    ($picture:ident) => {
        $crate::draws_bands!($picture, Deg0);
    };
    ($picture:ident, $rotation:ident $(, $smoothing:ident)?) => {
        $crate::draws!($picture, |mesh, color, turn, display, screen, buffers| {
            let $crate::firmware::Buffers { ref mut cache, ref mut bins, ref mut strip, ref mut depths, .. } = buffers;
            let rotation = pinhole::camera::Rotation::$rotation;
            let mut picture = $picture::Picture::new(&mesh, screen, rotation, cache, bins, depths)?;
            $(
                let $crate::firmware::Buffers { creases, edge_bins: ref mut bins, ref mut kept, .. } = buffers;
                picture.smoothing = $picture::$smoothing { creases, bins, kept, list: &mut [] };
            )?
            let mut turned = picture.turned(turn)?;
            while let Some(band) = turned.next_band(color, strip)? {
                band.send(display).map_err(|_| "the display refused the pixels")?;
            }
            Ok(turned.statistics())
        });
    };
}

/// Defines `draw`, given how a frame is drawn with its memory.
#[doc(hidden)]
#[macro_export]
macro_rules! draws {
    ($picture:ident, |$mesh:ident, $color:ident, $turn:ident, $display:ident, $screen:ident, $buffers:ident| $frame:block) => {
        /// Draws the model, turned by an angle, as firmware does. The error is the message that the firmware would log before it
        /// stops.
        pub fn draw<D>(
            model: &pinhole_import::ImportedMesh,
            $turn: pinhole::Angle,
            $display: &mut D,
        ) -> Result<pinhole::draw::Statistics, String>
        where
            D: embedded_graphics::draw_target::DrawTarget<Color = embedded_graphics::pixelcolor::Rgb565>,
        {
            let $mesh = model.mesh().map_err(|e| e.to_string())?;
            let colors = model.colors().map_err(|e| e.to_string())?;
            let $color = |face: usize, level: u16| match colors {
                Some(colors) => colors.lit(face, level),
                None => pinhole::color::Color::dim($picture::COLOR, level),
            };
            let $screen = $display.bounding_box();
            let mut $buffers = $crate::firmware::Buffers::new(model, &$mesh, $screen.size.width);
            $frame
        }
    };
}

/// The memory of a frame.
pub struct Buffers {
    /// A vertex cache.
    pub cache: Vec<pinhole::camera::ScreenVertex>,
    /// Bins of faces.
    pub bins: Vec<u16>,
    /// A strip of [`ROWS`] rows.
    pub strip: Vec<u8>,
    /// The depths of its pixels.
    pub depths: Vec<u16>,
    /// The number of edges that come first, as creases.
    pub creases: usize,
    /// Bins of smooth edges.
    pub edge_bins: Vec<u16>,
    /// Two rows of pixels, which wait for the next band where edges are smoothed.
    pub kept: Vec<u8>,
}

impl Buffers {
    /// Memory for a model's mesh on a display `width` pixels wide.
    pub fn new(model: &ImportedMesh, mesh: &pinhole::Mesh<'_>, width: u32) -> Self {
        let rows = |count| vec![0; pinhole::bands::Frame::<Rgb565>::strip_bytes(width, count)];
        Self {
            cache: vec![pinhole::camera::ScreenVertex::EMPTY; mesh.vertices().len()],
            bins: vec![0; mesh.face_bins_len()],
            strip: rows(ROWS),
            depths: vec![0; (width * ROWS) as usize],
            creases: model.creases.unwrap_or(0),
            edge_bins: vec![0; mesh.smooth_bins_len()],
            kept: rows(2),
        }
    }
}

/// The folder of the project that a model lies in, if it draws by other code than the template `boards/any-cortex-m`: the
/// nearest folder that has `build.rs` and `src/picture.rs`.
pub fn project(model: &Path) -> Option<PathBuf> {
    let model = model.canonicalize().ok()?;
    let files = ["src/picture.rs", "build.rs"];
    let folder =
        model.ancestors().skip(1).find(|folder| files.iter().all(|file| folder.join(file).is_file()))?;
    // Without carriage returns, which a checkout may add, and with the model where `boards/new` puts it.
    let text = |text: String| text.replace('\r', "").replace("../common/all/", "");
    let is_ours = |(file, ours): (&str, &str)| {
        std::fs::read_to_string(folder.join(file)).is_ok_and(|theirs| text(theirs) == text(ours.into()))
    };
    let ours = [
        include_str!("../../../boards/common/one-strip/src/picture.rs"),
        include_str!("../../../boards/common/all/build.rs"),
    ];
    (!files.into_iter().zip(ours).all(is_ours)).then(|| folder.to_path_buf())
}

/// The variable that names the project to `pinhole-preview`, when that is built and when it runs.
pub const PROJECT: &str = "PINHOLE_PROJECT";

/// Runs this command line by `pinhole-preview`, which is this program with the code of a project. Fails if the project does not
/// build.
pub fn run_in(project: &Path) -> Result<ExitCode, String> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    if !root.join("apps/preview/Cargo.toml").is_file() {
        return Err(format!(
            "{}: its preview is built in pinhole's repository, which is no longer at {}: install this program again from where it lies",
            project.display(),
            root.display()
        ));
    }
    let here = std::env::current_exe().map_err(|e| format!("this program does not find itself: {e}"))?;
    let folder = here.parent().unwrap_or(Path::new(""));
    // Beside this program where cargo built it, with what both use; for an installed program in the repository.
    let (folder, profile) = match (folder.parent(), folder.file_name().and_then(OsStr::to_str)) {
        (Some(target), Some(profile)) if target.join("CACHEDIR.TAG").is_file() => (folder.into(), profile),
        _ => (root.join("target/release"), "release"),
    };
    let name = format!("pinhole-preview{}", std::env::consts::EXE_SUFFIX);
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    cargo.args(["build", "--quiet", "--package", "pinhole-preview", "--profile"]);
    cargo.arg(if profile == "debug" { "dev" } else { profile });
    if let Some(target_dir) = folder.parent() {
        cargo.arg("--target-dir").arg(target_dir);
    }
    // Not in the folder of the firmware, whose configuration is for the microcontroller.
    cargo.current_dir(root).env(PROJECT, project);
    let needs = "the preview takes the functions that the templates have there: `options` of build.rs, and of src/picture.rs \
                 `camera` and `draw`, or `Picture` and `Turned`";
    match cargo.status() {
        Ok(status) if status.success() => {}
        Ok(_) => {
            return Err(format!("{}: does not build on the host, as said above; {needs}", project.display()))
        }
        Err(e) => {
            return Err(format!("{}: cargo, which builds its preview, does not run: {e}", project.display()))
        }
    }
    let run =
        Command::new(folder.join(&name)).args(std::env::args_os().skip(1)).env(PROJECT, project).status();
    match run {
        Ok(status) => Ok(ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(2))),
        Err(e) => Err(format!("{}: does not run: {e}", folder.join(name).display())),
    }
}
