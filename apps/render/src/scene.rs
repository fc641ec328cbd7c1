//! Scene files: meshes, matrices and the size of the picture, as plain numbers.

use crate::camera;
use crate::fog::FogStyle;
use crate::json::{self, Color, Whole};
use crate::light::{self, Lights};
use crate::meshes::{Entry, Face, Meshes};
use crate::sprites::{self, SceneSprites};
use crate::texture::{self, SceneTexture};
use pinhole_import::Triangles;
use serde::Deserialize;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub type Matrix = [[f64; 4]; 4];

pub(crate) const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// The largest width and height of a picture.
pub const LARGEST: u32 = 4096;

/// The colours of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Colors {
    /// The colour of each triangle in full light; empty if triangles have none.
    pub faces: Vec<[u8; 3]>,
    /// The light that each triangle emits; empty if none does.
    pub emission: Vec<[u8; 3]>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[usize; 3]>,
    pub model: Matrix,
    pub view: Matrix,
    pub projection: Matrix,
    pub width: u32,
    pub height: u32,
    /// x, y, width, height.
    pub viewport: [i32; 4],
    /// Whether back faces are culled.
    pub cull: bool,
    pub colors: Colors,
    /// The texture on the triangles, or none.
    pub texture: Option<SceneTexture>,
    pub lights: Lights,
    /// Fog in pictures, unless an option sets it.
    pub fog: Option<FogStyle>,
    /// Pictures at points of the world.
    pub sprites: Vec<SceneSprites>,
    /// The files of meshes that the scene names, and the files that these name.
    pub mesh_files: Vec<PathBuf>,
}

/// A scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    mesh: Option<String>,
    vertices: Option<Vec<[f64; 3]>>,
    triangles: Option<Vec<Face>>,
    meshes: Option<Vec<Entry>>,
    model: Option<Matrix>,
    camera: Option<Value>,
    view: Option<Matrix>,
    projection: Option<Matrix>,
    width: Whole<1, { LARGEST as i32 }>,
    height: Whole<1, { LARGEST as i32 }>,
    viewport: Option<[Whole<{ -1 << 30 }, { 1 << 30 }>; 4]>,
    cull: Option<Cull>,
    colors: Option<Vec<Color>>,
    emission: Option<Vec<Color>>,
    uv: Option<Value>,
    texture: Option<Value>,
    wrap: Option<texture::Wrap>,
    lights: Option<Vec<Value>>,
    fog: Option<[f64; 2]>,
    sprites: Option<Vec<sprites::Entry>>,
    /// Texts that describe the scene to people, and are ignored.
    #[serde(rename = "name")]
    _name: Option<String>,
    #[serde(rename = "source")]
    _source: Option<String>,
    #[serde(rename = "licence")]
    _licence: Option<String>,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Cull {
    None,
    Back,
}

impl Scene {
    /// Reads a `.json` scene and the mesh it names. The error names file and field.
    pub fn read(file: &Path) -> Result<Self, String> {
        let mut scene: File = json::read(file)?;
        let problem = |e: String| format!("{}: {e}", file.display());
        let folder = file.parent().unwrap_or(Path::new(""));
        let own = Entry {
            mesh: scene.mesh.take(),
            vertices: scene.vertices.take(),
            triangles: scene.triangles.take(),
            colors: scene.colors.take(),
            emission: scene.emission.take(),
            model: None,
        };
        let meshes = match scene.meshes.take() {
            None => Meshes::one(own, "", folder, &problem)?,
            Some(_) if own.mesh.is_some() || own.vertices.is_some() || own.triangles.is_some() => {
                return Err(problem("meshes: is given together with mesh, vertices or triangles".into()))
            }
            Some(meshes) => {
                let mut meshes = Meshes::several(meshes, folder, &problem)?;
                meshes.set_colors([own.colors, own.emission], "").map_err(problem)?;
                meshes
            }
        };
        Self::of(scene, meshes, folder).map_err(problem)
    }

    fn of(scene: File, meshes: Meshes, folder: &Path) -> Result<Self, String> {
        let Meshes { triangles, colors, files } = meshes;
        let fields = texture::Fields { uv: scene.uv, texture: scene.texture, wrap: scene.wrap };
        let texture = texture::read(fields, folder, &triangles)?;
        let sprites = sprites::read(scene.sprites.unwrap_or_default(), folder)?;
        let (width, height) = (scene.width.0, scene.height.0);
        let viewport = scene.viewport.map_or([0, 0, width, height], |viewport| viewport.map(|side| side.0));
        let model = scene.model.unwrap_or(IDENTITY);
        let [view, projection] = match (scene.camera, scene.view, scene.projection) {
            (None, view, projection) => {
                [view.ok_or("view: is missing")?, projection.ok_or("projection: is missing")?]
            }
            (Some(camera), None, None) => {
                let [_, _, across, down] = viewport.map(|side| side.max(1) as u32);
                let positions =
                    triangles.positions.iter().map(|&vertex| in_the_world(&model, vertex)).collect();
                let world = Triangles { positions, faces: triangles.faces.clone() };
                let points = sprites.iter().flat_map(|entry| entry.points.iter().copied());
                camera::read(camera, [across, down], world, points)?
            }
            _ => return Err("camera: is given together with view or projection".into()),
        };
        let Triangles { positions: vertices, faces: triangles } = triangles;
        Ok(Self {
            vertices,
            triangles,
            colors,
            model,
            view,
            projection,
            width: width as u32,
            height: height as u32,
            viewport,
            cull: scene.cull == Some(Cull::Back),
            texture,
            lights: scene.lights.map_or(Ok(Lights::default()), light::read)?,
            fog: scene.fog.map(FogStyle::between).transpose().map_err(|e| format!("fog: {e}"))?,
            sprites,
            mesh_files: files,
        })
    }

    /// Transforms a vertex to clip space in f64.
    pub fn clip(&self, vertex: [f64; 3]) -> [f64; 4] {
        transform([&self.model, &self.view, &self.projection], vertex)
    }

    /// How each triangle faces the eye: 1 is its front, -1 its back, and 0 is edge-on, or a triangle without area, within the
    /// rounding of f64.
    pub fn facings(&self) -> Vec<i8> {
        let points: Vec<_> = self.vertices.iter().map(|&vertex| self.clip(vertex)).collect();
        // Determinant of the rows (x, y, w): positive where the corners run counter-clockwise on the screen, for any sign of w.
        let facing = |t: &[usize; 3]| {
            let [[a, b, c], [d, e, f], [g, h, i]] =
                t.map(|corner| points[corner]).map(|[x, y, _, w]| [x, y, w]);
            let products = [a * e * i, b * f * g, c * d * h, -c * e * g, -b * d * i, -a * f * h];
            let (sum, size): (f64, f64) = (products.iter().sum(), products.iter().map(|p| p.abs()).sum());
            match sum.abs() > size * 2f64.powi(-44) {
                // 2^9 roundings
                true => sum.signum() as i8,
                false => 0,
            }
        };
        self.triangles.iter().map(facing).collect()
    }

    /// A vertex in world coordinates.
    pub fn in_the_world(&self, vertex: [f64; 3]) -> [f64; 3] {
        in_the_world(&self.model, vertex)
    }

    /// A point of the world in clip space, in f64.
    pub(crate) fn clip_of_world(&self, point: [f64; 3]) -> [f64; 4] {
        transform([&self.view, &self.projection], point)
    }

    /// The depth of a point of the world, z/w: 1 at the far plane, −1 at the near plane and before it.
    pub(crate) fn depth(&self, point: [f64; 3]) -> f64 {
        depth(self.clip_of_world(point))
    }

    /// The distance of a point of the world before the camera.
    pub(crate) fn distance(&self, point: [f64; 3]) -> f64 {
        0.0 - transform([&self.view], point)[2]
    }

    /// Maps a clip point to the screen, in pixels.
    pub fn screen(&self, clip: [f64; 4]) -> [f64; 2] {
        let [x, y, _, w] = clip;
        let [left, top, width, height] = self.viewport.map(f64::from);
        [left + (x / w + 1.0) * width / 2.0, top + (1.0 - y / w) * height / 2.0]
    }

    /// The files of pictures that the scene names.
    pub fn pictures(&self) -> impl Iterator<Item = &Path> {
        let texture = self.texture.iter().filter_map(|texture| texture.picture.as_ref());
        let sprites = self.sprites.iter().filter_map(SceneSprites::file);
        texture.map(|(_, file)| file.as_path()).chain(sprites)
    }

    /// The longest side of the mesh's bounding box.
    pub fn extent(&self) -> f64 {
        let (low, high) = self.bounds();
        (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max)
    }

    /// The mesh's bounding box; the origin, where there are no vertices.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        bounds(&self.vertices)
    }
}

pub(crate) fn in_the_world(model: &Matrix, vertex: [f64; 3]) -> [f64; 3] {
    let [x, y, z, _] = transform([model], vertex); // the last row is that of a point
    [x, y, z]
}

/// The matrix that applies `first`, then `then`.
pub(crate) fn product(then: &Matrix, first: &Matrix) -> Matrix {
    then.map(|row| [0, 1, 2, 3].map(|column| (0..4).map(|i| row[i] * first[i][column]).sum()))
}

/// A point after some matrices.
fn transform<const N: usize>(matrices: [&Matrix; N], [x, y, z]: [f64; 3]) -> [f64; 4] {
    let along = |p: [f64; 4], m: &Matrix| m.map(|row| row.iter().zip(p).map(|(a, b)| a * b).sum());
    matrices.into_iter().fold([x, y, z, 1.0], along)
}

/// The depth z/w of a clip point: −1 at the near plane and before it.
pub(crate) fn depth([_, _, z, w]: [f64; 4]) -> f64 {
    if w > 0.0 {
        (z / w).clamp(-1.0, 1.0)
    } else {
        -1.0
    }
}

pub fn bounds(vertices: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let Some(&first) = vertices.first() else { return ([0.0; 3], [0.0; 3]) };
    let along = |pick: fn(f64, f64) -> f64| {
        vertices.iter().fold(first, |a, b| [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])])
    };
    (along(f64::min), along(f64::max))
}
