//! The model: a file, or the teapot of the examples.

use crate::state::State;
use crate::watch::{Before, Watch};
use embedded_graphics::geometry::Size;
use pinhole_apps_support::files;
use pinhole_import::{Axis, Options, Preview, Triangles};
use pinhole_render::import;
use pinhole_render::model::{self, Fit, Look};
use pinhole_render::scene::{Colors, Matrix, Scene};
use pinhole_render::sprites::SceneSprites;
use pinhole_render::texture::{self, SceneTexture};
use std::path::{Path, PathBuf};

/// A mesh, with a camera if its file has one.
pub struct Source {
    mesh: Triangles,
    colors: Colors,
    texture: Option<SceneTexture>,
    up: Axis,
    own: Option<Scene>,
    /// The file, unless the mesh is built in.
    file: Option<PathBuf>,
    /// The importer's result for a model file, with its warnings.
    imported: Option<Preview>,
    /// The options of the import.
    options: Options,
    /// The files, as they were before they were read.
    watch: Watch,
}

impl Source {
    /// Reads the files that `pinhole-render` reads: `.obj` and `.stl`, imported as the options say, or a scene (`.json`), which
    /// is drawn as it stands. The error names the file and the problem.
    pub fn read(file: &Path, options: &Options) -> Result<Self, String> {
        let before = Before::reading(file);
        let source = Self::unwatched(file, options)?;
        let beside: Vec<_> = source.beside().map(Path::to_path_buf).collect();
        Ok(Self { watch: Watch::of(before, beside.into_iter()), ..source })
    }

    /// Reads the files again if they have changed and nobody is writing them. `None` where they have not.
    pub(crate) fn changed(&mut self) -> Option<Result<Self, String>> {
        let file = self.file.as_deref().filter(|_| self.watch.has_changed())?;
        Some(Self::read(file, &self.options))
    }

    fn unwatched(file: &Path, options: &Options) -> Result<Self, String> {
        if file.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            let own = Scene::read(file)?;
            let positions = own.vertices.iter().map(|&vertex| own.in_the_world(vertex)).collect();
            let mesh = Triangles { positions, faces: own.triangles.clone() };
            let (colors, texture, file) = (own.colors.clone(), own.texture.clone(), Some(file.into()));
            let scene = Self { mesh, colors, texture, up: Axis::Y, own: Some(own), file, ..Self::built_in() };
            return Ok(Self { options: options.clone(), ..scene });
        }
        let mut model = import::read(file, options)?;
        let texture = texture::of_model(&model);
        let mesh = std::mem::take(&mut model.triangles);
        let (colors, file) = (import::colors(&mut model), Some(file.into()));
        let (up, imported, options) = (model.up, Some(model), options.clone());
        Ok(Self { mesh, colors, texture, up, file, imported, options, ..Self::built_in() })
    }

    /// The teapot of the examples.
    pub fn built_in() -> Self {
        let step = f64::from(teapot::EXPONENT).exp2();
        let mesh = Triangles {
            positions: teapot::VERTICES.iter().map(|v| v.map(|c| f64::from(c) * step)).collect(),
            faces: teapot::FACES.iter().map(|face| face.map(usize::from)).collect(),
        };
        Self {
            mesh,
            colors: Colors::default(),
            texture: None,
            up: Axis::Y,
            own: None,
            file: None,
            imported: None,
            options: Options::default(),
            watch: Watch::default(),
        }
    }

    /// Warnings about a model, in the importer's words.
    pub fn warnings(&self) -> impl Iterator<Item = String> + '_ {
        self.imported.iter().flat_map(|model| &model.warnings).map(ToString::to_string)
    }

    /// The size of this model in the flash of a firmware, as a sentence.
    pub fn size_in_firmware(&self) -> Option<String> {
        self.imported.as_ref().and_then(import::size)
    }

    /// The file that is shown, unless the mesh is built in.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// The size of the picture in the scene file.
    pub fn size(&self) -> Option<Size> {
        self.own.as_ref().map(|own| Size::new(own.width, own.height))
    }

    /// Checks that an output is none of the input files. The error names the output.
    pub fn apart_from(&self, output: &Path) -> Result<(), String> {
        let mut inputs = self.file.as_deref().into_iter().chain(self.beside());
        inputs.try_for_each(|input| files::apart(input, [output]))
    }

    /// The files that the file names: meshes, material libraries and pictures.
    fn beside(&self) -> impl Iterator<Item = &Path> {
        let meshes = self.own.iter().flat_map(|own| &own.mesh_files);
        let files = self.imported.iter().flat_map(|model| &model.files);
        let pictures = self.own.iter().flat_map(Scene::pictures);
        meshes.chain(files).map(PathBuf::as_path).chain(pictures)
    }

    /// A message with the name of the file.
    pub fn named(&self, problem: &str) -> String {
        self.file.as_ref().map_or(problem.into(), |file| format!("{}: {problem}", file.display()))
    }

    /// The initial state.
    pub fn state(&self) -> State {
        State::new(self.own.is_some(), self.own.as_ref().is_none_or(|own| own.cull))
    }

    /// The scene with the camera of a state.
    pub(crate) fn scene(&self, state: &State, size: Size) -> Result<Scene, String> {
        let scene = match (state.projection, &self.own) {
            (None, Some(own)) => turned(own, state, size),
            (projection, _) => {
                let projection = projection.unwrap_or(pinhole_render::projections::Named::ALL[0]);
                let look = Look {
                    projection,
                    yaw: state.yaw,
                    pitch: state.pitch,
                    field_of_view: projection.field_of_view(),
                    width: size.width,
                    height: size.height,
                    up: self.up,
                    fit: Fit::Sphere { zoom: state.zoom },
                };
                let scene = model::scene(self.mesh.clone(), self.colors.clone(), &look)?;
                let sprites = self.own.as_ref().map_or(Vec::new(), |own| own.sprites.clone());
                Scene { texture: self.texture.clone(), sprites, ..scene }
            }
        };
        Ok(Scene { cull: state.cull, ..scene })
    }
}

/// The scene of a file, turned about its centre against the movement of the eye, and magnified.
fn turned(own: &Scene, state: &State, size: Size) -> Scene {
    let middle = {
        let (low, high) = own.bounds();
        own.in_the_world([0, 1, 2].map(|i| f64::midpoint(low[i], high[i])))
    };
    let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) =
        ((-state.yaw).to_radians().sin_cos(), state.pitch.to_radians().sin_cos());
    // About the axes of the view: first to the side, then up.
    let turn = [
        [cos_yaw, 0.0, sin_yaw],
        [sin_pitch * sin_yaw, cos_pitch, -sin_pitch * cos_yaw],
        [-cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw],
    ];
    let view = |i: usize, k: usize| own.view[i][k];
    let product = |f: &dyn Fn(usize) -> f64| (0..3).map(f).sum::<f64>();
    // World axes to view axes, the turn, and back.
    let there = [0, 1, 2].map(|i| [0, 1, 2].map(|k| product(&|j| turn[i][j] * view(j, k))));
    let about = [0, 1, 2].map(|i| [0, 1, 2].map(|k| product(&|j| view(j, i) * there[j][k])));
    let mut model: Matrix = own.model;
    for (i, row) in model.iter_mut().take(3).enumerate() {
        for (k, value) in row.iter_mut().enumerate() {
            *value = product(&|j| about[i][j] * (own.model[j][k] - if k == 3 { middle[j] } else { 0.0 }));
        }
        row[3] += middle[i];
    }
    let mut projection = own.projection;
    for value in projection.iter_mut().take(2).flatten() {
        *value *= state.zoom;
    }
    // Sprites turn with the model: their points, not their pictures.
    let along = |i: usize, point: [f64; 3]| product(&|j| about[i][j] * (point[j] - middle[j])) + middle[i];
    let turned = |sprites: &SceneSprites| sprites.at(|point| [0, 1, 2].map(|i| along(i, point)));
    let unturned = state.yaw == 0.0 && state.pitch == 0.0;
    let (model, sprites) = match unturned {
        true => (own.model, own.sprites.clone()),
        false => (model, own.sprites.iter().map(turned).collect()),
    };
    Scene { model, projection, sprites, width: size.width, height: size.height, ..own.clone() }
}
