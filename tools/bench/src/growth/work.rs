//! Counts the work of a frame on the host: vertices, faces, rows, pixels.

use super::texture::{coordinates, TEXELS_OF_UNIT};
use super::{Case, Kind, Way, PAINTED_CORNERS, SMALL};
use crate::scene::{BACKGROUND, LINE};
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
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

/// A constant of the formula, and how many of it a frame has.
type Term = (&'static str, fn(&Work) -> u32);

const FRAME: Term = ("frame", |_| 1);
const VERTEX: Term = ("vertex", |work| work.vertices);
const FACE: Term = ("face", |work| work.faces);
const FACE_CUT: Term = ("face cut: more", |work| work.cut);
const ROW: Term = ("row of a face", |work| work.rows);
const PIXEL: Term = ("pixel of a face", |work| work.pixels);
const AREA: Term = ("pixel of the picture", |work| work.area);
const BAND: Term = ("band", |work| work.bands);
const IN_BAND: Term = ("face in a band", |work| work.met);
const LARGE_IN_BAND: Term = ("large face in a band: more", |work| work.met_large);
const CUT_IN_BAND: Term = ("cut face in a band: more", |work| work.met_cut);
// The room for vertices takes so much of a frame that nothing else is seen that each frame has.
const ROOM: Term = ("room for a vertex", |work| work.room);

/// The constants of a way to draw.
pub fn terms(kind: Kind) -> Vec<Term> {
    let of_bands = [IN_BAND, LARGE_IN_BAND, CUT_IN_BAND, ROW, PIXEL, AREA, BAND];
    match kind {
        Kind::Lines => vec![
            FRAME,
            VERTEX,
            ("edge drawn", |work| work.drawn),
            ("edge across the border: more", |work| work.large),
            ("edge to be clipped: more", |work| work.clipped),
            ("edge cut: more", |work| work.cut),
            ("pixel of a line", |work| work.pixels),
            AREA,
        ],
        Kind::Faces | Kind::Depth | Kind::Painted => vec![
            if kind == Kind::Painted { ROOM } else { FRAME },
            VERTEX,
            ("face left out", |work| work.faces - work.drawn - work.outside),
            ("face drawn", |work| work.drawn - work.beside),
            ("large face drawn: more", |work| work.large),
            ("face outside", |work| work.outside + work.beside),
            ("face to be clipped: more", |work| work.clipped),
            FACE_CUT,
            ROW,
            PIXEL,
            AREA,
        ],
        Kind::LineBands => vec![
            FRAME,
            VERTEX,
            ("edge to be clipped", |work| work.edges.clipped),
            ("edge cut: more", |work| work.edges.cut),
            ("edge in a band", |work| work.edges.met),
            ("pixel of a line", |work| work.edges.pixels),
            AREA,
            BAND,
        ],
        Kind::HiddenBands | Kind::FewHiddenBands => {
            let of_edges: [Term; 4] = [
                ("edge to be clipped", |work| work.edges.clipped),
                ("edge in a band", |work| work.edges.met),
                ("drawn face beside an edge in a band", |work| work.edges.beside),
                ("pixel of a line", |work| work.edges.pixels),
            ];
            [&[FRAME, VERTEX, FACE, FACE_CUT][..], &of_bands, &of_edges].concat()
        }
        Kind::Bands => {
            let of_faces: [Term; 6] = [
                FRAME,
                VERTEX,
                ("face", |work| work.faces - work.outside),
                ("face outside", |work| work.outside),
                ("face to be clipped: more", |work| work.clipped),
                FACE_CUT,
            ];
            [&of_faces[..], &of_bands].concat()
        }
        // Finding the few faces that are cut costs little beside drawing them.
        Kind::TexturedBands => {
            let in_perspective: [Term; 3] = [
                ("face in perspective in a band: more", |work| work.perspective.met),
                ("row of a face in perspective: more", |work| work.perspective.rows),
                ("pixel of a face in perspective: more", |work| work.perspective.pixels),
            ];
            [&[FRAME, VERTEX, FACE][..], &of_bands, &in_perspective].concat()
        }
        // A face is stored once, also one that is cut, and looked at in each band.
        Kind::PaintedBands => vec![
            ROOM,
            VERTEX,
            FACE,
            ("face drawn", |work| work.drawn),
            FACE_CUT,
            ("drawn face, for each band of the picture", |work| work.drawn * work.bands),
            IN_BAND,
            ("large face in a band: more", |work| work.met_large + work.met_cut),
            ROW,
            PIXEL,
            AREA,
            BAND,
        ],
        Kind::SmoothBands | Kind::DitheredBands | Kind::SmoothDitheredBands | Kind::PlainBands => {
            [&[FRAME, VERTEX, FACE, FACE_CUT][..], &of_bands].concat()
        }
    }
}

/// How a face is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shown {
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
        let instance = scene.place().with_cull(self.cull);
        let mesh = instance.mesh();
        let [width, height] = self.size;
        let mut watch = Watch::new(Size::new(width, height));
        let room = if self.is_small() { SMALL } else { PAINTED_CORNERS } as u32;
        let vertices = mesh.vertices().len() as u32;
        let bands = way.rows.map_or(0, |rows| height.div_ceil(rows));
        let work = Work { vertices, area: width * height, room, bands, ..Work::default() };
        match (way.kind, way.rows) {
            (Kind::Lines, _) => {
                let Ok(statistics) = instance.wireframe(LINE, &mut [], &mut watch);
                let (large, clipped) = self.edges(&instance);
                let (faces, drawn, cut) = (mesh.edges().len() as u32, statistics.drawn, statistics.clipped);
                return Some(Work { faces, drawn, large, clipped, cut, pixels: watch.pixels, ..work });
            }
            (Kind::LineBands, Some(rows)) => {
                let edges = self.edges_in_bands(way, rows, &[])?;
                return Some(Work { faces: edges.all, edges, ..work });
            }
            _ => {}
        }
        let mut seen = Vec::new();
        let shade = |face| {
            seen.push(face);
            BACKGROUND
        };
        let Ok(statistics) = instance.solid(shade, &mut [], &mut watch);
        let kinds: Vec<Shown> = seen.iter().map(|&face| self.kind(&instance, face)).collect();
        let of = |kind| kinds.iter().filter(|&&of| of == kind).count() as u32;
        // Back faces are culled after those outside are rejected.
        let clipped =
            (0..mesh.faces().len()).filter(|&face| self.kind(&instance, face) == Shown::Cut).count() as u32;
        let (both, mut all) = (instance.with_cull(Cull::None), Watch::new(Size::new(width, height)));
        let Ok(of_both) = both.solid(|_| BACKGROUND, &mut [], &mut all);
        let work = Work {
            faces: mesh.faces().len() as u32,
            drawn: statistics.drawn,
            large: of(Shown::Large) + of(Shown::Cut),
            beside: of(Shown::Beside),
            outside: of_both.outside,
            clipped: clipped - of_both.outside,
            cut: statistics.clipped,
            rows: watch.runs,
            pixels: watch.pixels,
            ..work
        };
        let Some(rows) = way.rows else { return Some(work) };
        let edges = match way.kind {
            Kind::HiddenBands | Kind::FewHiddenBands => self.edges_in_bands(way, rows, &seen)?,
            _ => EdgeWork::default(),
        };
        let perspective = match way.kind {
            Kind::TexturedBands => self.in_perspective(&instance, rows, &seen)?,
            _ => Perspective::default(),
        };
        let mut met = [0; 4];
        for (face, kind) in seen.into_iter().zip(kinds) {
            met[kind as usize] += self.bands(face, rows)?;
        }
        let [low, met_large, met_cut, _] = met;
        Some(Work { edges, met: low + met_large + met_cut, met_large, met_cut, perspective, ..work })
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
        let all = self.what.mesh(way.kind)?;
        let [width, height] = self.size;
        let mut watch = Watch::new(Size::new(width, height));
        let Ok(statistics) = self.scene(way)?.place().wireframe(LINE, &mut [], &mut watch);
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
        let all = self.what.mesh(Kind::Faces)?;
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

    fn kind(&self, instance: &MeshInstance<'_>, face: usize) -> Shown {
        let corners = instance.mesh().faces().get(face).copied().unwrap_or_default();
        let [Ok(a), Ok(b), Ok(c)] = corners.map(|vertex| instance.project(vertex.into())) else {
            return Shown::Cut;
        };
        let (x, y) = ([a, b, c].map(|seen| seen.point.x()), [a, b, c].map(|seen| seen.point.y()));
        let [across, down] = self.size.map(|side| (side as i32) << 8);
        let (x, height) = (Lies::new((across, x)), reach(y)[1] - reach(y)[0]);
        match (x, Lies::new((down, y))) {
            (Lies::Beside, _) | (_, Lies::Beside) => Shown::Beside,
            (Lies::Inside, _) if height <= (LOW as i32) << 8 => Shown::Low,
            _ => Shown::Large,
        }
    }

    /// The number of bands that a drawn face touches.
    fn bands(&self, face: usize, rows: u32) -> Option<u32> {
        let all = self.what.mesh(Kind::Faces)?;
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

/// A target that counts what is drawn on it.
struct Watch {
    size: Size,
    runs: u32,
    pixels: u32,
}

impl Watch {
    fn new(size: Size) -> Self {
        Self { size, runs: 0, pixels: 0 }
    }
}

impl OriginDimensions for Watch {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Watch {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        // A line: its pixels lie in the picture.
        self.pixels += pixels.into_iter().count() as u32;
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        // One row of a face; where a large one is as wide as the picture, many.
        self.runs += area.size.height;
        self.pixels += area.size.width * area.size.height;
        Ok(())
    }
}
