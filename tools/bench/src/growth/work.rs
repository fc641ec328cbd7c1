//! Counts the work of a frame on the host: vertices, faces, rows, pixels.

use super::texture::{coordinates, TEXELS_OF_UNIT};
use super::watch::Watch;
use super::{Case, Way, PAINTED_CORNERS, SMALL};
use crate::scene::{BACKGROUND, LINE};
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{Cull, Mesh, MeshInstance, Projected};
use std::collections::BTreeSet;

/// The work of one frame. Where lines are drawn, *faces* are edges.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    pub vertices: u32,
    pub faces: u32,
    pub drawn: u32,
    /// Drawn faces that are higher than [`LOW`], cross the left or right border of the picture, or are cut; drawn edges that
    /// cross any border.
    pub large: u32,
    /// Drawn faces whose corners are on the screen, but all beyond one border of the picture: left out before their edges are set up.
    pub beside: u32,
    /// Faces with all corners on the outer side of one clip plane: rejected by the vertices' bits.
    pub outside: u32,
    /// Other faces with a corner that must be clipped, drawn or culled; edges with an end that must be clipped.
    pub clipped: u32,
    /// `clipped` faces or edges that are drawn.
    pub cut: u32,
    pub rows: u32,
    pub pixels: u32,
    /// Pixels of the picture, which are cleared.
    pub area: u32,
    pub bands: u32,
    /// Faces that touch a band, summed over all bands; `met_large`: the large ones that are not cut; `met_cut`: the cut ones.
    pub met: u32,
    pub met_large: u32,
    pub met_cut: u32,
    /// Faces over which texture coordinates are not interpolated linearly: those that touch a band, summed over all bands, and
    /// their rows and pixels.
    pub perspective: Perspective,
    /// Room for vertices in the painter.
    pub room: u32,
    /// Edges of the mesh, and what is drawn of them, where lines are drawn in bands.
    pub edges: EdgeWork,
}

/// The work of edges in bands.
#[derive(Clone, Copy, Debug, Default)]
pub struct EdgeWork {
    pub all: u32,
    /// Edges with an end that must be clipped.
    pub clipped: u32,
    /// `clipped` edges of which a part is left.
    pub cut: u32,
    /// Edges that touch a band, summed over all bands.
    pub met: u32,
    /// Drawn faces beside an edge, summed over the edges in each band.
    pub beside: u32,
    pub pixels: u32,
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Perspective {
    pub met: u32,
    pub rows: u32,
    pub pixels: u32,
}

/// Rows up to which a triangle between the left and right border of the picture takes a fast path:
/// `src/fast/edge20.rs`, and on a Cortex-M0 `src/fast/bresenham_triangle.rs`.
const LOW: u32 = 31;

/// The names of the counts of [`Work::counts`].
pub const fn names(way: Way) -> &'static [&'static str] {
    match way {
        Way::Lines => &[
            "frame",
            "vertex",
            "edge drawn",
            "edge across the border: more",
            "edge to be clipped: more",
            "edge cut: more",
            "pixel of a line",
            "pixel of the picture",
        ],
        // The room for vertices takes so much of a frame that nothing else is seen that each frame has.
        Way::Painted => &[
            "room for a vertex",
            "vertex",
            "face left out",
            "face drawn",
            "large face drawn: more",
            "face outside",
            "face to be clipped: more",
            "face cut: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
        ],
        Way::Faces | Way::Depth => &[
            "frame",
            "vertex",
            "face left out",
            "face drawn",
            "large face drawn: more",
            "face outside",
            "face to be clipped: more",
            "face cut: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
        ],
        // Of front faces, nearly all that have to be clipped are cut, and few are outside.
        Way::PlaneCulled | Way::FacingDepth => &[
            "frame",
            "vertex",
            "face left out",
            "face drawn",
            "face beside the picture",
            "large face drawn: more",
            "face cut: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
        ],
        Way::LineBands(_) => &[
            "frame",
            "vertex",
            "edge to be clipped",
            "edge cut: more",
            "edge in a band",
            "pixel of a line",
            "pixel of the picture",
            "band",
        ],
        Way::HiddenBands(_) | Way::FewHiddenBands(_) => &[
            "frame",
            "vertex",
            "face",
            "face cut: more",
            "face in a band",
            "large face in a band: more",
            "cut face in a band: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
            "band",
            "edge to be clipped",
            "edge in a band",
            "drawn face beside an edge in a band",
            "pixel of a line",
        ],
        Way::Bands(_) => &[
            "frame",
            "vertex",
            "face",
            "face outside",
            "face to be clipped: more",
            "face cut: more",
            "face in a band",
            "large face in a band: more",
            "cut face in a band: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
            "band",
        ],
        // Finding the few faces that are cut costs little beside drawing them.
        Way::TexturedBands(_) => &[
            "frame",
            "vertex",
            "face",
            "face in a band",
            "large face in a band: more",
            "cut face in a band: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
            "band",
            "face in perspective in a band: more",
            "row of a face in perspective: more",
            "pixel of a face in perspective: more",
        ],
        // A face is stored once, also one that is cut, and looked at in each band.
        Way::PaintedBands(_) => &[
            "room for a vertex",
            "vertex",
            "face",
            "face drawn",
            "face cut: more",
            "drawn face, for each band of the picture",
            "face in a band",
            "large face in a band: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
            "band",
        ],
        Way::FacingBands(_)
        | Way::SmoothBands(_)
        | Way::DitheredBands(_)
        | Way::SmoothDitheredBands(_)
        | Way::PlainBands(_) => &[
            "frame",
            "vertex",
            "face",
            "face cut: more",
            "face in a band",
            "large face in a band: more",
            "cut face in a band: more",
            "row of a face",
            "pixel of a face",
            "pixel of the picture",
            "band",
        ],
    }
}

impl Work {
    /// The counts, in the order of [`names`].
    pub fn counts(&self, way: Way) -> Vec<f64> {
        let Self { vertices, faces, drawn, large, beside, outside, clipped, cut, rows, pixels, area, .. } =
            *self;
        let Self { bands, met, met_large, met_cut, .. } = *self;
        let counts = match way {
            Way::Lines => vec![1, vertices, drawn, large, clipped, cut, pixels, area],
            Way::Faces | Way::Depth | Way::Painted => {
                let of_faces = [faces - drawn - outside, drawn - beside, large, outside + beside];
                let first = if way == Way::Painted { self.room } else { 1 };
                [&[first, vertices], &of_faces[..], &[clipped, cut, rows, pixels, area]].concat()
            }
            Way::PlaneCulled | Way::FacingDepth => {
                vec![1, vertices, faces - drawn, drawn - beside, beside, large, cut, rows, pixels, area]
            }
            Way::LineBands(_) => {
                let EdgeWork { clipped, cut, met, pixels, .. } = self.edges;
                vec![1, vertices, clipped, cut, met, pixels, area, bands]
            }
            Way::Bands(_) => {
                let of_faces = [1, vertices, faces - outside, outside, clipped, cut];
                [&of_faces[..], &[met, met_large, met_cut, rows, pixels, area, bands]].concat()
            }
            Way::HiddenBands(_) | Way::FewHiddenBands(_) => {
                let of_faces = [1, vertices, faces, cut, met, met_large, met_cut];
                let EdgeWork { clipped, met: in_bands, beside, pixels: of_lines, .. } = self.edges;
                let of_edges = [clipped, in_bands, beside, of_lines];
                [&of_faces[..], &[rows, pixels, area, bands], &of_edges].concat()
            }
            Way::TexturedBands(_) => {
                let all = [1, vertices, faces, met, met_large, met_cut, rows, pixels, area, bands];
                let Perspective { met, rows, pixels } = self.perspective;
                [&all[..], &[met, rows, pixels]].concat()
            }
            Way::PaintedBands(_) => {
                let stored = [self.room, vertices, faces, drawn, cut, drawn * bands];
                [&stored[..], &[met, met_large + met_cut, rows, pixels, area, bands]].concat()
            }
            Way::FacingBands(_)
            | Way::SmoothBands(_)
            | Way::DitheredBands(_)
            | Way::SmoothDitheredBands(_)
            | Way::PlainBands(_) => {
                vec![1, vertices, faces, cut, met, met_large, met_cut, rows, pixels, area, bands]
            }
        };
        counts.into_iter().map(f64::from).collect()
    }

    /// With rows and large faces as one guesses them who knows pixels and faces alone: by the height of a face, on average.
    #[must_use]
    pub fn guessed(self, rows_of_root: f64) -> Self {
        let Self { cut, met, met_cut, .. } = self;
        let (drawn, pixels) = (f64::from(self.drawn - self.beside), f64::from(self.pixels));
        let rows = rows_of_root * (drawn * pixels).sqrt();
        let part = ((rows / drawn - SOME) / (ALL - SOME)).clamp(0.0, 1.0);
        let large = (part * drawn).round() as u32;
        let met_large = (part * f64::from(met - met_cut)).round() as u32;
        Self { rows: rows.round() as u32, large: large.max(cut.min(self.large)), met_large, ..self }
    }
}

/// Where faces are so high on average, some of them are large, and where they are so high, all.
pub const SOME: f64 = 8.0;
pub const ALL: f64 = 48.0;

/// How a face is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Low,
    Large,
    Cut,
    Beside,
}

/// Where something lies, along one side of the picture.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lies {
    Inside,
    Across,
    Beside,
}

impl Lies {
    fn new<const N: usize>((side, places): (i32, [i32; N])) -> Self {
        match reach(places) {
            [from, to] if from >= 0 && to <= side => Self::Inside,
            [from, to] if from > side || to < 0 => Self::Beside,
            _ => Self::Across,
        }
    }
}

fn reach<const N: usize>(places: [i32; N]) -> [i32; 2] {
    places.into_iter().fold([i32::MAX, i32::MIN], |[from, to], at| [from.min(at), to.max(at)])
}

impl Case {
    pub fn work(&self, way: Way) -> Option<Work> {
        let scene = self.scene(way)?;
        let by_planes = scene.place().with_cull(self.cull);
        let instance = by_planes.without_planes();
        let mesh = instance.mesh();
        let [width, height] = self.size;
        let mut watch = Watch::new(Size::new(width, height));
        let room = if self.is_small() { SMALL } else { PAINTED_CORNERS } as u32;
        let vertices = mesh.vertices().len() as u32;
        let work = Work { vertices, area: width * height, room, ..Work::default() };
        if way == Way::Lines {
            let Ok(statistics) = instance.wireframe(LINE, &mut [], &mut watch);
            let (large, clipped) = self.edges(&instance);
            let (faces, drawn) = (mesh.edges().len() as u32, statistics.drawn);
            let cut = statistics.clipped;
            return Some(Work { faces, drawn, large, clipped, cut, pixels: watch.pixels, ..work });
        }

        if let Way::LineBands(rows) = way {
            let (edges, bands) = (self.edges_in_bands(way, rows, &[])?, height.div_ceil(rows));
            return Some(Work { faces: edges.all, edges, bands, ..work });
        }

        let mut seen = Vec::new();
        let shade = |face| {
            seen.push(face);
            BACKGROUND
        };
        let Ok(statistics) = match way.asks_planes() {
            true => by_planes.solid(shade, &mut [], &mut watch),
            false => instance.solid(shade, &mut [], &mut watch),
        };
        let kinds: Vec<Kind> = seen.iter().map(|&face| self.kind(&instance, face)).collect();
        let of = |kind| kinds.iter().filter(|&&of| of == kind).count() as u32;
        let (outside, clipped) = match way.asks_planes() {
            // Back faces are culled before.
            true => (statistics.outside, of(Kind::Cut)),
            // Back faces are culled after those outside are rejected.
            false => {
                let all = 0..mesh.faces().len();
                let clipped = all.filter(|&face| self.kind(&instance, face) == Kind::Cut).count() as u32;
                let (both, mut watch) =
                    (instance.with_cull(Cull::None), Watch::new(Size::new(width, height)));
                let Ok(statistics) = both.solid(|_| BACKGROUND, &mut [], &mut watch);
                (statistics.outside, clipped - statistics.outside)
            }
        };
        let work = Work {
            faces: mesh.faces().len() as u32,
            drawn: statistics.drawn,
            large: of(Kind::Large) + of(Kind::Cut),
            beside: of(Kind::Beside),
            outside,
            clipped,
            cut: statistics.clipped,
            rows: watch.runs,
            pixels: watch.pixels,
            ..work
        };
        let (Way::Bands(rows)
        | Way::FacingBands(rows)
        | Way::SmoothBands(rows)
        | Way::DitheredBands(rows)
        | Way::SmoothDitheredBands(rows)
        | Way::TexturedBands(rows)
        | Way::PlainBands(rows)
        | Way::PaintedBands(rows)
        | Way::HiddenBands(rows)
        | Way::FewHiddenBands(rows)) = way
        else {
            return Some(work);
        };
        let edges = match way {
            Way::HiddenBands(_) | Way::FewHiddenBands(_) => self.edges_in_bands(way, rows, &seen)?,
            _ => EdgeWork::default(),
        };

        let (mut met, drawn) = ([0; 4], seen.clone());
        for (face, kind) in seen.into_iter().zip(kinds) {
            met[kind as usize] += self.bands(face, rows)?;
        }
        let [low, met_large, met_cut, _] = met;
        let bands = height.div_ceil(rows);
        let perspective = match way {
            Way::TexturedBands(_) => self.in_perspective(&instance, rows, &drawn)?,
            _ => Perspective::default(),
        };
        let met_all = low + met_large + met_cut;
        Some(Work { edges, bands, met: met_all, met_large, met_cut, perspective, ..work })
    }

    /// The number of edges that cross the border of the picture, and of edges with an end that must be clipped.
    fn edges(&self, instance: &MeshInstance<'_>) -> (u32, u32) {
        let (mut across, mut clipped) = (0, 0);
        let [width, height] = self.size.map(|side| (side as i32) << 8);
        for edge in instance.mesh().edges() {
            match edge.map(|vertex| instance.project(vertex.into())) {
                [Ok(a), Ok(b)] => {
                    let lies = [(width, [a.point.x(), b.point.x()]), (height, [a.point.y(), b.point.y()])]
                        .map(Lies::new);
                    across += u32::from(lies.contains(&Lies::Across) && !lies.contains(&Lies::Beside));
                }
                _ => clipped += 1,
            }
        }
        (across, clipped)
    }

    /// The work of edges in bands of so many rows; `seen`: the faces that are drawn.
    fn edges_in_bands(&self, way: Way, rows: u32, seen: &[usize]) -> Option<EdgeWork> {
        let all = self.what.mesh(way)?;
        let [width, height] = self.size;
        let mut watch = Watch::new(Size::new(width, height));
        let Ok(statistics) = self.scene(way)?.place().without_planes().wireframe(LINE, &mut [], &mut watch);
        let drawn: BTreeSet<usize> = seen.iter().copied().collect();
        let mut work = EdgeWork {
            all: all.edges().len() as u32,
            cut: statistics.clipped,
            pixels: watch.pixels,
            ..EdgeWork::default()
        };
        for (edge, &ends) in all.edges().iter().enumerate() {
            let alone = Mesh::new(all.vertices(), all.exponent(), &[]).ok()?;
            let scene = self.scene_of(alone.with_edges(all.edges().get(edge..=edge)?).ok()?)?;
            let (instance, mut bin_storage) = (scene.place(), [0; 2]);
            let bounds = instance.transform(&mut []).bin_edges(&mut bin_storage).ok()?.bounds();
            let met = bands_of(&bounds, rows);
            let is_clipped = ends.iter().any(|&vertex| instance.project(vertex.into()).is_err());
            work.clipped += u32::from(is_clipped);
            work.met += met;
            let beside = all.edge_faces().get(edge).into_iter().flatten();
            work.beside += met * beside.filter(|&&face| drawn.contains(&usize::from(face))).count() as u32;
        }
        Some(work)
    }

    /// The work of those drawn faces over which texture coordinates are not interpolated linearly.
    fn in_perspective(&self, instance: &MeshInstance<'_>, rows: u32, drawn: &[usize]) -> Option<Perspective> {
        let all = self.what.mesh(Way::Faces)?;
        let is_linear = |face: usize| {
            let normal = all.normals().get(face).copied().unwrap_or_default();
            let corners = all.faces().get(face).copied().unwrap_or_default();
            let distances = corners.map(|vertex| instance.project(vertex.into()).ok().map(distance));
            let [Some(a), Some(b), Some(c)] = distances else { return false };
            let (near, far) = (a.min(b).min(c), a.max(b).max(c));
            let uv = coordinates(&instance.mesh(), face, normal);
            // A quarter of a texel is what a texture's coordinates may be off.
            (0..2).all(|axis| {
                let [least, most] = reach(uv.map(|uv| uv[axis].into()));
                let texels = f64::from(most - least) * TEXELS_OF_UNIT;
                texels * (far - near) / (4.0 * near) < 0.25
            })
        };
        let [width, height] = self.size;
        let (mut watch, mut met) = (Watch::new(Size::new(width, height)), 0);
        for &face in drawn.iter().filter(|&&face| !is_linear(face)) {
            met += self.bands(face, rows)?;
            let alone = Mesh::new(all.vertices(), all.exponent(), all.faces().get(face..=face)?).ok()?;
            let scene = self.scene_of(alone)?;
            let Ok(_) = scene.place().with_cull(self.cull).solid(|_| BACKGROUND, &mut [], &mut watch);
        }
        Some(Perspective { met, rows: watch.runs, pixels: watch.pixels })
    }

    fn kind(&self, instance: &MeshInstance<'_>, face: usize) -> Kind {
        let corners = instance.mesh().faces().get(face).copied().unwrap_or_default();
        let [Ok(a), Ok(b), Ok(c)] = corners.map(|vertex| instance.project(vertex.into())) else {
            return Kind::Cut;
        };
        let (x, y) = ([a, b, c].map(|seen| seen.point.x()), [a, b, c].map(|seen| seen.point.y()));
        let [across, down] = self.size.map(|side| (side as i32) << 8);
        let (x, height) = (Lies::new((across, x)), reach(y)[1] - reach(y)[0]);
        match (x, Lies::new((down, y))) {
            (Lies::Beside, _) | (_, Lies::Beside) => Kind::Beside,
            (Lies::Inside, _) if height <= (LOW as i32) << 8 => Kind::Low,
            _ => Kind::Large,
        }
    }

    /// The number of bands that a drawn face touches.
    fn bands(&self, face: usize, rows: u32) -> Option<u32> {
        let all = self.what.mesh(Way::Faces)?;
        let alone = Mesh::new(all.vertices(), all.exponent(), all.faces().get(face..=face)?).ok()?;
        let scene = self.scene_of(alone)?;
        let instance = scene.place().with_cull(self.cull);
        let (transformed, mut bin_storage) = (instance.transform(&mut []), [0; 2]);
        Some(bands_of(&transformed.bin_faces(&mut bin_storage).ok()?.bounds(), rows))
    }
}

/// The distance of a vertex along the direction of view, by its depth between the near and the far plane of the scenes' camera.
fn distance(seen: Projected) -> f64 {
    let [near, far] = [0.5, 20.0];
    far * near / (far - (far - near) * f64::from(seen.depth) / 65535.0)
}

/// The number of bands that a rectangle touches.
fn bands_of(bounds: &Rectangle, rows: u32) -> u32 {
    let (top, height) = (bounds.top_left.y as u32, bounds.size.height);
    if height == 0 {
        0
    } else {
        (top + height - 1) / rows - top / rows + 1
    }
}
