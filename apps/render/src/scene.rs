//! Scene files: meshes, matrices and the size of the picture, as plain numbers.

use crate::fog::FogStyle;
use crate::json::{Field, Json};
use crate::sprites::{self, SceneSprites};
use crate::texture::{self, SceneTexture};
use pinhole_import::Triangles;
use std::path::{Path, PathBuf};

pub type Matrix = [[f64; 4]; 4];

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
    /// Fog in pictures, unless an option sets it.
    pub fog: Option<FogStyle>,
    /// Pictures at points of the world.
    pub sprites: Vec<SceneSprites>,
    /// The mesh file, if the scene names one.
    pub mesh_file: Option<PathBuf>,
}

impl Scene {
    /// Reads a `.json` scene and the mesh it names. The error names file and field.
    pub fn read(file: &Path) -> Result<Self, String> {
        let json = parse(file)?;
        let problem = |e: String| format!("{}: {e}", file.display());
        let [mesh, vertices, triangles, model, view, projection, width, height, viewport, cull, colors, emission, uv, texture, wrap, fog, sprites] =
            Field::root(&json)
                .fields([
                    "mesh",
                    "vertices",
                    "triangles",
                    "model",
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
                    "fog",
                    "sprites",
                ])
                .map_err(problem)?;
        let mut mesh_file = None;
        let triangles = match (mesh, vertices, triangles) {
            (Some(mesh), None, None) => {
                // Errors of the mesh name the mesh file.
                let name = mesh.text().map_err(problem)?;
                if name.is_empty() {
                    return Err(problem(mesh.error("is empty and should name a file")));
                }
                let path = file.parent().unwrap_or(Path::new("")).join(name);
                read_mesh(mesh_file.insert(path))?
            }
            (None, vertices, triangles) => lists(vertices, triangles).map_err(problem)?,
            _ => return Err(problem("mesh: is given together with vertices or triangles".into())),
        };
        let folder = file.parent().unwrap_or(Path::new(""));
        let texture = texture::read([uv, texture, wrap], folder, &triangles).map_err(problem)?;
        let sprites =
            sprites.map_or(Ok(Vec::new()), |field| sprites::read(&field, folder)).map_err(problem)?;
        let Triangles { positions: vertices, faces: triangles } = triangles;
        let rest = || -> Result<Self, String> {
            let size = |field: Option<Field<'_>>, name| needed(field, name)?.integer(1, LARGEST.into());
            let (width, height) = (size(width, "width")?, size(height, "height")?);
            let viewport = match viewport {
                Some(field) => field.array(|f| f.integer(-1 << 30, 1 << 30))?.map(|v| v as i32), // 31 bits
                None => [0, 0, width as i32, height as i32],
            };
            let cull = cull.map_or(Ok(false), |field| field.one_of(&[("none", false), ("back", true)]))?;
            let colors =
                Colors { faces: colors_of(&triangles, colors)?, emission: colors_of(&triangles, emission)? };
            let between = |field: Field<'_>| {
                FogStyle::between(field.array(|distance| distance.number())?).map_err(|e| field.error(e))
            };
            Ok(Self {
                vertices,
                triangles,
                colors,
                model: matrix(needed(model, "model")?)?,
                view: matrix(needed(view, "view")?)?,
                projection: matrix(needed(projection, "projection")?)?,
                width: width as u32, // at most 4096
                height: height as u32,
                viewport,
                cull,
                texture,
                fog: fog.map(between).transpose()?,
                sprites,
                mesh_file,
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
        let [x, y, z, _] = transform([&self.model], vertex); // the last row is that of a point
        [x, y, z]
    }

    /// The depth of a point of the world, z/w: 1 at the far plane, −1 at the near plane and before it.
    pub(crate) fn depth(&self, point: [f64; 3]) -> f64 {
        depth(transform([&self.view, &self.projection], point))
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

/// Reads a scene's mesh of any format, as it is in the file: the scene says how it lies and whether back faces are culled.
fn read_mesh(file: &Path) -> Result<Triangles, String> {
    if !file.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
        let mesh = pinhole_import::read_triangles(file).map_err(|e| e.to_string())?;
        // The importer's message.
        return if mesh.faces.is_empty() {
            Err(format!("{}: has no faces: export the model as a mesh", file.display()))
        } else {
            Ok(mesh)
        };
    }
    let json = parse(file)?;
    let [vertices, triangles] = Field::root(&json)
        .fields(["vertices", "triangles"])
        .map_err(|e| format!("{}: {e}", file.display()))?;
    lists(vertices, triangles).map_err(|e| format!("{}: {e}", file.display()))
}

fn parse(file: &Path) -> Result<Json, String> {
    let text = std::fs::read(file).map_err(|e| format!("{}: cannot be read: {e}", file.display()))?;
    Json::parse(&text).map_err(|e| format!("{}: {e}", file.display()))
}

fn needed<'a>(field: Option<Field<'a>>, name: &str) -> Result<Field<'a>, String> {
    field.ok_or_else(|| format!("{name}: is missing"))
}

/// A colour for each triangle, or nothing.
fn colors_of(triangles: &[[usize; 3]], field: Option<Field<'_>>) -> Result<Vec<[u8; 3]>, String> {
    let Some(field) = field else { return Ok(Vec::new()) };
    let channel = |f: Field<'_>| f.integer(0, 255).map(|c| c as u8);
    let colors = field.list()?.map(|color| color.array(channel)).collect::<Result<Vec<_>, _>>()?;
    if colors.len() != triangles.len() {
        let (colors, triangles) = (colors.len(), triangles.len());
        return Err(field.error(format_args!("has {colors} colours, but there are {triangles} triangles")));
    }
    Ok(colors)
}

fn matrix(field: Field<'_>) -> Result<Matrix, String> {
    field.array(|row| row.array(|f| f.number()))
}

fn lists(vertices: Option<Field<'_>>, triangles: Option<Field<'_>>) -> Result<Triangles, String> {
    let vertices = needed(vertices, "vertices")?;
    let positions = vertices.list()?.map(|v| v.array(|f| f.number())).collect::<Result<Vec<_>, _>>()?;
    let corner = |f: Field<'_>| match positions.len() {
        0 => Err(f.error("names a vertex, and there are none")),
        count => f.integer(0, count as i64 - 1).map(|i| i as usize), // not negative
    };
    let triangles = needed(triangles, "triangles")?;
    let faces = triangles.list()?.map(|t| t.array(corner)).collect::<Result<Vec<_>, _>>()?;
    if faces.is_empty() {
        return Err(triangles.error("has no faces"));
    }
    Ok(Triangles { positions, faces })
}
