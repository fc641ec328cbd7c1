//! Scene files: meshes, matrices and the size of the picture, as plain numbers.

use crate::camera;
use crate::fog::FogStyle;
use crate::json::Field;
use crate::light::{self, Lights};
use crate::meshes::{matrix, parse, Meshes};
use crate::sprites::{self, SceneSprites};
use crate::texture::{self, SceneTexture};
use pinhole_import::Triangles;
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
    /// The texture on all triangles, or none.
    pub texture: Option<SceneTexture>,
    pub lights: Lights,
    /// Fog in pictures, unless an option sets it.
    pub fog: Option<FogStyle>,
    /// Pictures at points of the world.
    pub sprites: Vec<SceneSprites>,
    /// The files of meshes that the scene names, and their material libraries.
    pub mesh_files: Vec<PathBuf>,
}

impl Scene {
    /// Reads a `.json` scene and the mesh it names. The error names file and field.
    pub fn read(file: &Path) -> Result<Self, String> {
        let json = parse(file)?;
        let problem = |e: String| format!("{}: {e}", file.display());
        let root = Field::root(&json);
        let known = [
            "mesh",
            "vertices",
            "triangles",
            "meshes",
            "model",
            "camera",
            "view",
            "projection",
            "width",
            "height",
            "viewport",
            "cull",
            "colors",
            "emission",
            "uv",
            "texture",
            "wrap",
            "lights",
            "fog",
            "sprites",
        ];
        let [mesh, vertices, triangles, meshes, model, camera, view, projection, width, height, viewport, cull, colors, emission, uv, texture, wrap, lights, fog, sprites] =
            root.fields(known).map_err(problem)?;
        let folder = file.parent().unwrap_or(Path::new(""));
        let own = [mesh, vertices, triangles];
        let mut meshes = match meshes {
            None => Meshes::one(&root, own, folder, &problem)?,
            Some(meshes) if own.iter().all(Option::is_none) => Meshes::several(&meshes, folder, &problem)?,
            Some(_) => {
                return Err(problem("meshes: is given together with mesh, vertices or triangles".into()))
            }
        };
        let rest = || -> Result<Self, String> {
            meshes.set_colors([colors, emission])?;
            let Meshes { triangles, colors, files } = meshes;
            let texture = texture::read([uv, texture, wrap], folder, &triangles)?;
            let sprites = sprites.map_or(Ok(Vec::new()), |field| sprites::read(&field, folder))?;
            let size = |field: Option<Field<'_>>, name| root.needed(field, name)?.integer(1, LARGEST.into());
            let (width, height) = (size(width, "width")? as u32, size(height, "height")? as u32); // at most 4096
            let viewport = match viewport {
                Some(field) => field.array(|f| f.integer(-1 << 30, 1 << 30))?.map(|v| v as i32), // 31 bits
                None => [0, 0, width as i32, height as i32],
            };
            let model = model.map_or(Ok(IDENTITY), |model| matrix(&model))?;
            let [view, projection] = match (camera, view, projection) {
                (None, view, projection) => {
                    [matrix(&root.needed(view, "view")?)?, matrix(&root.needed(projection, "projection")?)?]
                }
                (Some(camera), None, None) => {
                    let [_, _, across, down] = viewport.map(|side| side.max(1) as u32);
                    let positions =
                        triangles.positions.iter().map(|&vertex| in_the_world(&model, vertex)).collect();
                    let world = Triangles { positions, faces: triangles.faces.clone() };
                    let points = sprites.iter().flat_map(|entry| entry.points.iter().copied());
                    camera::read(&camera, [across, down], world, points)?
                }
                (Some(camera), ..) => {
                    return Err(camera.error("is given together with view or projection"));
                }
            };
            let cull = cull.map_or(Ok(false), |field| field.one_of(&[("none", false), ("back", true)]))?;
            let between = |field: Field<'_>| {
                FogStyle::between(field.array(|distance| distance.number())?).map_err(|e| field.error(e))
            };
            let Triangles { positions: vertices, faces: triangles } = triangles;
            Ok(Self {
                vertices,
                triangles,
                colors,
                model,
                view,
                projection,
                width,
                height,
                viewport,
                cull,
                texture,
                lights: lights.map_or(Ok(Lights::default()), |lights| light::read(&lights))?,
                fog: fog.map(between).transpose()?,
                sprites,
                mesh_files: files,
            })
        };
        rest().map_err(problem)
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

fn in_the_world(model: &Matrix, vertex: [f64; 3]) -> [f64; 3] {
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
