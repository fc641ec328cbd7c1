//! The loaded model, and the page's queries about it.

use crate::chip;
use crate::choice::{Choice, Style, TURNS};
use crate::cost;
use crate::display::{Format, DISPLAYS};
use crate::draw;
use crate::film::Film;
use crate::firmware;
use crate::json::{list, object, object_of_numbers, text};
use crate::projections::Named;
use crate::ready::{self, READY};
use crate::refused;
use crate::texture::{Pattern, TextureImage, BY_SIDES};
use crate::warning::{about, words, Refusal};
use pinhole_import::{import_bytes, Axis, ImportedMesh, Options, Warning};
use std::borrow::Cow;
use std::path::PathBuf;

/// The frames of a GIF file: every third step of a turn.
const FRAMES: u32 = TURNS / 3;

/// The loaded file, and the mesh that was made last, from this file or a ready mesh.
#[derive(Default)]
pub struct Planner {
    file: Option<(String, Vec<u8>)>,
    /// The material libraries that were loaded, by their names.
    libraries: Vec<(String, Vec<u8>)>,
    /// The loaded picture.
    picture: TextureImage,
    /// The mesh, with the name and the options that it was made from.
    mesh: Option<(String, Options, ImportedMesh)>,
    /// A GIF file in the making, of the loaded file and picture.
    film: Option<Film>,
}

impl Planner {
    /// Takes a file, which choices then name `file`, or a material library (MTL), which belongs to the files that name it. Folders
    /// in the name are left out.
    pub fn load(&mut self, name: &str, bytes: Vec<u8>) {
        let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
        if name.to_ascii_lowercase().ends_with(".mtl") {
            self.libraries.insert(0, (name.into(), bytes)); // before an older one of this name
        } else {
            self.file = Some((name.into(), bytes));
        }
        self.mesh = None;
        self.film = None;
    }

    /// Takes a picture for textures: red, green, blue and opacity of each texel, row by row. Fails if a side is none that a texture
    /// can have.
    pub fn load_picture(&mut self, bytes: &[u8], width: usize) -> Result<(), Refusal> {
        self.picture = TextureImage::from_rgba(bytes, width)?;
        self.film = None;
        Ok(())
    }

    /// Draws a frame of a choice. Returns red, green, blue and opacity of each pixel, row by row, and a description of the frame
    /// as JSON. The error says why the choice or the model cannot be drawn, with a remedy.
    pub fn draw(&mut self, choice: &Choice) -> Result<(Vec<u8>, String), Refusal> {
        self.mesh(choice)?;
        let mesh = self.made()?;
        let drawn =
            draw::draw(mesh, choice, &self.image(choice)).map_err(|problem| too_many(mesh, problem))?;
        let statistics = drawn.statistics;
        let counts = [
            ("drawn", statistics.drawn),
            ("culled", statistics.culled),
            ("outside", statistics.outside),
            ("clipped", statistics.clipped),
            ("degenerate", statistics.degenerate),
        ];
        let counts = object_of_numbers(&[], &counts.map(|(name, count)| (name, f64::from(count))));
        let what = object(&[
            ("width", choice.size.width.to_string()),
            ("height", choice.size.height.to_string()),
            ("bytes", drawn.bytes.to_string()),
            ("statistics", counts),
            ("model", model(mesh, choice)),
        ]);
        Ok((drawn.pixels, what))
    }

    /// Draws and encodes the next frame of a turn of the model, for a GIF file. `begins` is the choice of a new film; with
    /// `None`, the film begun last continues. Returns the number of frames done and the number of all frames. Fails as
    /// [`draw`](Self::draw) does.
    pub fn film(&mut self, begins: Option<&Choice>) -> Result<[u32; 2], Refusal> {
        let film = match begins {
            Some(choice) => Some(Film::new(choice.clone(), FRAMES)?),
            None => self.film.take(),
        };
        let mut film = film.ok_or("no film was begun")?;
        let turn = (film.choice.turn as u32 + film.done * (TURNS / FRAMES)) % TURNS; // `turn` is not negative
        let (pixels, _) = self.draw(&Choice { turn: turn as i32, ..film.choice.clone() })?;
        film.add(&pixels)?;
        let frames = [film.done, film.frames];
        self.film = Some(film);
        Ok(frames)
    }

    /// The GIF file of the film, with the frames drawn so far. Fails if no film was begun.
    pub fn gif(&mut self) -> Result<Vec<u8>, Refusal> {
        Ok(self.film.take().ok_or("no film was begun")?.finish()?)
    }

    /// What a frame by a choice costs in RAM, flash and time, as JSON. Fails as [`draw`](Self::draw) does.
    pub fn costs(&mut self, choice: &Choice) -> Result<String, Refusal> {
        self.mesh(choice)?;
        let mesh = self.made()?;
        cost::costs(mesh, choice, &self.image(choice)).map_err(|problem| too_many(mesh, problem))
    }

    /// A file of a firmware template, changed for a choice; for textured faces also `src/texture.rs`, made from the template's
    /// `src/picture.rs`. Fails as [`draw`](Self::draw) does, and for a choice that no
    /// template draws.
    pub fn firmware(&mut self, choice: &Choice, path: &str, template: &str) -> Result<String, Refusal> {
        if path == "src/texture.rs" {
            self.mesh(choice)?;
            let image = self.image(choice).into_owned();
            let (.., mesh) = self.mesh.as_mut().ok_or("no mesh")?;
            return Ok(firmware::texture(template, mesh, &image, choice.format));
        }
        let model = firmware::model_file(&self.source(choice)?.0);
        let mesh = self.mesh(choice)?;
        let sphere = mesh.mesh().map_err(refused::mesh)?.bounding_sphere();
        Ok(firmware::file(path, template, choice, model, &sphere)?)
    }

    /// The mesh of a choice as Rust. Fails as [`draw`](Self::draw) does.
    pub fn rust(&mut self, choice: &Choice) -> Result<String, Refusal> {
        let (name, _) = self.source(choice)?;
        let source = self.mesh(choice)?.to_rust_mesh("MODEL", name.as_ref(), "the planner of pinhole");
        source.ok_or_else(|| "MODEL is no name of a constant".into())
    }

    /// The files that the model takes in the folder of a firmware, by their names: the model's own, and the material libraries that
    /// it uses. Fails if there is no file and, if there are libraries, as [`draw`](Self::draw) does.
    pub fn model(&mut self, choice: &Choice) -> Result<Vec<(String, Vec<u8>)>, Refusal> {
        let (name, bytes) = self.source(choice)?;
        let mut files = vec![(firmware::model_file(&name).to_owned(), bytes)];
        if !self.libraries.is_empty() {
            let used = self.mesh(choice)?.files.clone();
            let library =
                |path: &PathBuf| self.libraries.iter().find(|(name, _)| path.as_os_str() == &name[..]);
            files.extend(used.iter().filter_map(library).cloned());
        }
        Ok(files)
    }

    /// The file of the chosen mesh, with its name.
    fn source(&self, choice: &Choice) -> Result<(String, Vec<u8>), Refusal> {
        match ready::file(&choice.mesh) {
            Some(file) => Ok(file),
            None => self.file.clone().ok_or("no file: drop an STL or OBJ file, or choose a mesh".into()),
        }
    }

    /// The mesh of a choice, made again only if it differs from the last one.
    fn mesh(&mut self, choice: &Choice) -> Result<&ImportedMesh, Refusal> {
        let options = choice.options();
        let is_made = matches!(&self.mesh, Some((name, made, _)) if *name == choice.mesh && *made == options);
        if !is_made {
            let (name, bytes) = self.source(choice)?;
            let mesh = import_bytes(bytes, name.as_ref(), &self.libraries, &options)?;
            self.mesh = Some((choice.mesh.clone(), options, mesh));
        }
        self.made()
    }

    /// The texture of the choice.
    fn image(&self, choice: &Choice) -> Cow<'_, TextureImage> {
        TextureImage::ready(choice).map_or(Cow::Borrowed(&self.picture), Cow::Owned)
    }

    /// The mesh that was made last.
    fn made(&self) -> Result<&ImportedMesh, Refusal> {
        self.mesh.as_ref().map(|(.., mesh)| mesh).ok_or_else(|| "no mesh".into())
    }

    /// The names of the projections.
    pub fn projections() -> impl Iterator<Item = &'static str> {
        Named::ALL.iter().map(|named| named.name)
    }

    /// The options of the page, as JSON.
    pub fn menu() -> String {
        let names = |names: &mut dyn Iterator<Item = &str>| list(names.map(text));
        let displays = DISPLAYS.iter().map(|display| {
            object(&[
                ("name", text(display.name)),
                ("width", display.width.to_string()),
                ("height", display.height.to_string()),
                ("format", text(display.format.name())),
            ])
        });
        let projections = Named::ALL.iter().map(|named| {
            let parts = [
                ("name", text(named.name)),
                ("yaw", named.yaw.to_string()),
                ("pitch", named.pitch.to_string()),
                ("steepest", named.kind.steepest().to_string()),
            ];
            object(&parts)
        });
        object(&[
            ("meshes", names(&mut READY.iter().map(|(name, _)| *name))),
            ("displays", list(displays)),
            ("formats", names(&mut Format::ALL.iter().map(|(name, _)| *name))),
            // The formats in which faces are always dithered.
            ("dithered", {
                let dithered = Format::ALL.iter().filter(|(_, format)| format.always_dithers());
                names(&mut dithered.map(|(name, _)| *name))
            }),
            (
                "mixing",
                names(&mut Format::ALL.iter().filter(|(_, format)| format.mixes()).map(|(name, _)| *name)),
            ),
            ("styles", names(&mut Style::ALL.iter().map(|(name, _)| *name))),
            ("decimates", cfg!(feature = "decimate").to_string()),
            ("textures", names(&mut Pattern::ALL.iter().map(|(name, _)| *name))),
            ("projections", list(projections)),
            ("chips", chip::chips()),
            ("cores", names(&mut chip::CORES.iter().map(|(name, _)| *name))),
            ("axes", names(&mut Axis::ALL.iter().map(|(name, _)| *name))),
        ])
    }
}

/// Why a mesh cannot be drawn: the importer's warning, which has a remedy, where it has too many faces.
fn too_many(mesh: &ImportedMesh, problem: String) -> Refusal {
    let known = mesh.warnings.iter().find(|warning| matches!(warning, Warning::ManyFaces { .. }));
    known.map_or(problem.into(), Refusal::from)
}

/// The size of a model, and the warnings about it.
fn model(mesh: &ImportedMesh, choice: &Choice) -> String {
    let is_laid_on = choice.style == Style::Textured && mesh.texture_faces.is_empty();
    let warnings = mesh.warnings.iter().map(|warning| (warning.worded(words), warning.remedies()));
    let warnings = warnings.chain(is_laid_on.then(|| (BY_SIDES.into(), Vec::new())));
    let warnings = warnings.map(|(message, remedies)| about(&message, &remedies));
    object(&[
        ("vertices", mesh.vertices.len().to_string()),
        ("faces", mesh.faces.len().to_string()),
        ("edges", mesh.edges.len().to_string()),
        // The number of faces without decimation.
        ("all", (mesh.faces.len() + mesh.report.decimated).to_string()),
        ("flash", mesh.flash_bytes().to_string()),
        ("warnings", list(warnings)),
    ])
}
