//! The work of a frame: how many vertices, faces, rows, pixels and so on it has. `tools/bench/run growth` measures how many instructions each
//! of them takes (docs/growth.md), and the planner estimates frames by these figures.

use core::cell::RefCell;
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::BinaryColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::{camera::Projected, prelude::*};

/// The counts of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    /// Room for vertices in the painter. At first, as many as the mesh has.
    pub room: u32,
    vertices: u32,
    /// Pixels of the picture, which are cleared.
    area: u32,
    bands: u32,
    faces: FaceWork,
    edges: EdgeWork,
}

#[derive(Clone, Copy, Debug, Default)]
struct FaceWork {
    all: u32,
    drawn: u32,
    /// Drawn faces that are higher than [`LOW`], cross the left or right border of the picture, or are cut.
    large: u32,
    /// Drawn faces whose corners are on the screen, but all beyond one border of the picture: left out before their edges are set up.
    beside: u32,
    /// Faces with all corners on the outer side of one clip plane: rejected by the vertices' bits.
    outside: u32,
    /// Faces with a corner that must be clipped.
    with_far_corner: u32,
    /// Such faces that are not outside, drawn or culled.
    clipped: u32,
    /// `clipped` faces that are drawn.
    cut: u32,
    rows: u32,
    pixels: u32,
    /// Faces that touch a band, summed over all bands; `met_large`: the large ones that are not cut; `met_cut`: the cut ones.
    met: u32,
    met_large: u32,
    met_cut: u32,
    /// Faces over which texture coordinates are not interpolated linearly: those that touch a band, summed over all bands, and
    /// their rows and pixels.
    perspective: [u32; 3],
}

#[derive(Clone, Copy, Debug, Default)]
struct EdgeWork {
    drawn: u32,
    /// Edges on the screen that cross a border of the picture.
    across: u32,
    /// Edges with an end that must be clipped.
    clipped: u32,
    /// `clipped` edges of which a part is left.
    cut: u32,
    pixels: u32,
    /// Edges that touch a band, summed over all bands.
    met: u32,
    /// Drawn faces beside an edge, summed over the edges in each band.
    beside: u32,
    /// Edges that are smoothed, also those beside the picture.
    smoothed: u32,
    /// Pixels along smoothed edges in the picture, in the direction in which these are longer.
    smoothed_pixels: u32,
    /// Smoothed edges that touch a band, summed over all bands.
    smoothed_met: u32,
    /// How often smoothed edges are set up that were set up in the band before, because the list has no entry for them.
    again: u32,
    /// Pixels of the rows that wait for the next band.
    waiting: u32,
}

/// What a constant of the formula is for, such as "vertex", and how many of these a frame has.
pub type Term = (&'static str, fn(&Work) -> u32);

const FRAME: Term = ("frame", |_| 1);
const VERTEX: Term = ("vertex", |work| work.vertices);
const FACE: Term = ("face", |work| work.faces.all);
const CLIPPED: Term = ("face to be clipped: more", |work| work.faces.clipped);
const FACE_CUT: Term = ("face cut: more", |work| work.faces.cut);
const ROW: Term = ("row of a face", |work| work.faces.rows);
const PIXEL: Term = ("pixel of a face", |work| work.faces.pixels);
const AREA: Term = ("pixel of the picture", |work| work.area);
const BAND: Term = ("band", |work| work.bands);
const IN_BAND: Term = ("face in a band", |work| work.faces.met);
const LARGE_IN_BAND: Term = ("large face in a band: more", |work| work.faces.met_large);
const CUT_IN_BAND: Term = ("cut face in a band: more", |work| work.faces.met_cut);
const EDGE_CLIPPED: Term = ("edge to be clipped", |work| work.edges.clipped);
const EDGE_CUT: Term = ("edge cut: more", |work| work.edges.cut);
const EDGE_IN_BAND: Term = ("edge in a band", |work| work.edges.met);
const EDGE_PIXEL: Term = ("pixel of a line", |work| work.edges.pixels);
// A painter's room for vertices takes so many instructions that what each frame costs beside it cannot be told apart.
const ROOM: Term = ("room for a vertex", |work| work.room);

/// The constants of a way to draw, by its name in `docs/data/growth.json`; none of an unknown one.
pub fn terms(way: &str) -> Vec<Term> {
    let in_bands = [IN_BAND, LARGE_IN_BAND, CUT_IN_BAND, ROW, PIXEL, AREA, BAND];
    let of_faces = [&[FRAME, VERTEX, FACE, FACE_CUT][..], &in_bands].concat();
    match way {
        "lines" => vec![
            FRAME,
            VERTEX,
            ("edge drawn", |work| work.edges.drawn),
            ("edge across the border: more", |work| work.edges.across),
            ("edge to be clipped: more", |work| work.edges.clipped),
            EDGE_CUT,
            EDGE_PIXEL,
            AREA,
        ],
        "line-bands" => vec![FRAME, VERTEX, EDGE_CLIPPED, EDGE_CUT, EDGE_IN_BAND, EDGE_PIXEL, AREA, BAND],
        "hidden-bands" => {
            let beside: Term = ("drawn face beside an edge in a band", |work| work.edges.beside);
            [&of_faces[..], &[EDGE_CLIPPED, EDGE_IN_BAND, beside, EDGE_PIXEL]].concat()
        }
        "faces" | "depth" | "painted" => vec![
            if way == "painted" { ROOM } else { FRAME },
            VERTEX,
            ("face left out", |work| work.faces.all.saturating_sub(work.faces.drawn + work.faces.outside)),
            ("face drawn", |work| work.faces.drawn - work.faces.beside),
            ("large face drawn: more", |work| work.faces.large),
            ("face outside", |work| work.faces.outside + work.faces.beside),
            CLIPPED,
            FACE_CUT,
            ROW,
            PIXEL,
            AREA,
        ],
        "bands" => {
            let inside: Term = ("face", |work| work.faces.all.saturating_sub(work.faces.outside));
            let outside: Term = ("face outside", |work| work.faces.outside);
            [&[FRAME, VERTEX, inside, outside, CLIPPED, FACE_CUT][..], &in_bands].concat()
        }
        // Finding the few faces that are cut costs little beside drawing them.
        "textured-bands" => {
            let in_perspective: [Term; 3] = [
                ("face in perspective in a band: more", |work| work.faces.perspective[0]),
                ("row of a face in perspective: more", |work| work.faces.perspective[1]),
                ("pixel of a face in perspective: more", |work| work.faces.perspective[2]),
            ];
            [&[FRAME, VERTEX, FACE][..], &in_bands, &in_perspective].concat()
        }
        // A face is stored once, also one that is cut, and looked at in each band.
        "painted-bands" => vec![
            ROOM,
            VERTEX,
            FACE,
            ("face drawn", |work| work.faces.drawn),
            FACE_CUT,
            ("drawn face, for each band of the picture", |work| work.faces.drawn * work.bands),
            IN_BAND,
            ("large face in a band: more", |work| work.faces.met_large + work.faces.met_cut),
            ROW,
            PIXEL,
            AREA,
            BAND,
        ],
        // What smoothing takes beside drawing.
        "smooth-edges" => vec![
            FRAME,
            FACE,
            ("face with a corner to be clipped: more", |work| work.faces.with_far_corner),
            ("smoothed edge", |work| work.edges.smoothed),
            ("smoothed edge in a band", |work| work.edges.smoothed_met),
            ("smoothed edge set up again", |work| work.edges.again),
            ("pixel along a smoothed edge", |work| work.edges.smoothed_pixels),
            BAND,
            ("column of the rows that wait", |work| work.edges.waiting),
        ],
        "smooth-bands" | "dithered-bands" | "smooth-dithered-bands" | "plain-bands" => of_faces,
        _ => Vec::new(),
    }
}

/// A triangle of at most this many rows between the left and the right border takes a fast path: `src/fast/edge20.rs`, and on a
/// Cortex-M0 `src/fast/bresenham_triangle.rs`.
const LOW: i32 = 31;

/// Places a mesh as the frame shows it.
pub type Place<'p> = &'p dyn for<'m> Fn(&'m Mesh<'m>) -> MeshInstance<'m>;

/// A frame of a mesh, in one piece or in bands of any height.
pub struct Frame {
    /// What does not depend on bands.
    work: Work,
    size: Size,
    drawn: Vec<Drawn>,
    edges: Vec<Edge>,
}

/// An edge of the mesh.
struct Edge {
    /// The first and last row.
    extent: [i32; 2],
    /// The number of drawn faces beside it.
    beside: u32,
    /// Whether it is smoothed, and in the picture.
    is_smoothed: bool,
    is_wide: bool,
}

/// Entries of the list of smoothed edges that are set up.
pub const LIST: u32 = 16;

/// A drawn face, or all drawn edges.
#[derive(Default)]
struct Drawn {
    face: usize,
    /// `None`: beside the picture.
    size: Option<FaceSize>,
    /// The first and the last row of its bounds.
    extent: [i32; 2],
    is_in_perspective: bool,
    rows: u32,
    pixels: u32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum FaceSize {
    Low,
    Large,
    Cut,
}

impl Frame {
    /// Counts the work of a mesh's faces and edges in a picture of a size. `is_linear`: whether texture coordinates are interpolated
    /// linearly over a face with these corners. Edges before edge `creases` are smoothed where both of their faces are drawn.
    pub fn new<'m>(
        mesh: &'m Mesh<'m>,
        size: Size,
        place: Place<'_>,
        is_linear: &dyn Fn(usize, [Projected; 3]) -> bool,
        creases: usize,
    ) -> Self {
        let instance = place(mesh);
        let points: Vec<Option<Projected>> =
            (0..mesh.vertices().len()).map(|vertex| instance.project(vertex).ok()).collect();
        let point = |vertex: u16| points.get(usize::from(vertex)).copied().flatten();
        let corners = |face: &[u16; 3]| {
            let [a, b, c] = face.map(point);
            Some([a?, b?, c?])
        };
        let (mut drawn, statistics) = faces(&instance, size);
        let mut is_drawn = vec![false; mesh.faces().len()];
        for one in &mut drawn {
            if let Some(is_drawn) = is_drawn.get_mut(one.face) {
                *is_drawn = true;
            }
            let corners = mesh.faces().get(one.face).and_then(corners);
            let lies = corners.map(|corners| Lies::new(corners, size));
            one.size = lies.map_or(Some(FaceSize::Cut), |lies| lies.size());
            one.extent = match lies {
                Some(lies) if lies.is_inside => lies.rows(),
                _ => rows_of_face(mesh, one.face, place).unwrap_or(NO_ROWS),
            };
            one.is_in_perspective = corners.is_none_or(|corners| !is_linear(one.face, corners));
        }
        let must_be_clipped = mesh.faces().iter().filter(|face| corners(face).is_none()).count() as u32;
        // Faces before the near plane or beyond the far plane count as such, too, and back faces are culled after those outside.
        let outside = match must_be_clipped {
            0 => statistics.outside,
            _ => faces(&instance.with_cull(Cull::None), size).1.outside,
        };
        let of = |size| drawn.iter().filter(|one| one.size == size).count() as u32;
        let faces = FaceWork {
            all: mesh.faces().len() as u32,
            drawn: statistics.drawn,
            large: of(Some(FaceSize::Large)) + of(Some(FaceSize::Cut)),
            beside: of(None),
            outside,
            with_far_corner: must_be_clipped,
            clipped: must_be_clipped.saturating_sub(outside),
            cut: statistics.clipped,
            rows: drawn.iter().map(|one| one.rows).sum(),
            pixels: drawn.iter().map(|one| one.pixels).sum(),
            ..FaceWork::default()
        };
        let mut edges = EdgeWork::default();
        let mut of_mesh = Vec::new();
        for (index, edge) in mesh.edges().iter().enumerate() {
            let lies = match edge.map(point) {
                [Some(a), Some(b)] => Some(Lies::new([a, b], size)),
                _ => None,
            };
            edges.clipped += u32::from(lies.is_none());
            edges.across += u32::from(lies.is_some_and(|lies| !lies.is_inside && !lies.is_beside));
            let extent = match lies {
                Some(Lies { y, is_inside: true, .. }) => y.map(|at| (at >> 8).min(size.height as i32 - 1)),
                _ => rows_of_edge(mesh, index, place).unwrap_or(NO_ROWS),
            };
            let beside = mesh.edge_faces().get(index).into_iter().flatten();
            let beside = beside.filter(|&&face| is_drawn.get(usize::from(face)) == Some(&true));
            let beside = beside.count() as u32;
            let is_smoothed = beside == 1 || beside == 2 && index < creases;
            let [width, height] = lies.map_or([0, extent[1] + 1 - extent[0]], |lies| lies.sides(size));
            edges.smoothed += u32::from(is_smoothed);
            let is_smoothed = is_smoothed && extent != NO_ROWS && lies.is_none_or(|lies| !lies.is_beside);
            edges.smoothed_pixels += if is_smoothed { width.max(height) as u32 } else { 0 };
            of_mesh.push(Edge { extent, beside, is_smoothed, is_wide: width >= height });
        }
        let lines = RefCell::new(vec![Drawn::default()]);
        let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
        let Ok(statistics) =
            instance.edges(|_| BinaryColor::On).cached(&mut cache).draw(&mut Watch { size, drawn: &lines });
        edges.pixels = lines.into_inner().iter().map(|lines| lines.pixels).sum();
        (edges.drawn, edges.cut) = (statistics.drawn, statistics.clipped);
        let vertices = mesh.vertices().len() as u32; // at most 65 536, as faces
        let area = size.width * size.height;
        let work = Work { room: vertices, vertices, area, bands: 0, faces, edges };
        Self { work, size, drawn, edges: of_mesh }
    }

    /// The work in bands of so many rows, or in one piece.
    pub fn work(&self, rows: Option<u32>) -> Work {
        let mut work = self.work;
        let Some(rows) = rows else { return work };
        let bands = self.size.height.div_ceil(rows.max(1));
        work.bands = bands;
        let Work { faces, edges, .. } = &mut work;
        for one in &self.drawn {
            let met = met(one.extent, rows);
            faces.met += if one.size.is_some() { met } else { 0 };
            match one.size {
                Some(FaceSize::Large) => faces.met_large += met,
                Some(FaceSize::Cut) => faces.met_cut += met,
                _ => {}
            }
            if one.is_in_perspective {
                let counts = [met, one.rows, one.pixels];
                faces.perspective.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
            }
        }
        edges.waiting = bands.saturating_sub(1) * self.size.width;
        // Of each band, the smoothed edges in it, and how often those are set up that continue from the band above.
        let mut in_bands = vec![[0; 2]; bands as usize];
        for &Edge { extent, beside, is_smoothed, is_wide } in &self.edges {
            let met = met(extent, rows);
            edges.met += met;
            edges.beside += beside * met;
            let first = (extent[0].max(0) as u32 / rows.max(1)) as usize;
            for (at, counts) in
                in_bands.iter_mut().skip(first).take(met as usize).enumerate().filter(|_| is_smoothed)
            {
                let [all, set_ups] = counts;
                *all += 1;
                *set_ups += if at > 0 { 1 + u32::from(is_wide) } else { 0 };
            }
        }
        for [all, set_ups] in in_bands {
            edges.smoothed_met += all;
            // As many edges as there are entries keep theirs.
            edges.again += (set_ups * all.saturating_sub(LIST)).checked_div(all).unwrap_or(0);
        }
        work
    }
}

/// The drawn faces, each with its rows and pixels.
fn faces(instance: &MeshInstance<'_>, size: Size) -> (Vec<Drawn>, Statistics) {
    let drawn = RefCell::new(Vec::new());
    let shade = |face| {
        drawn.borrow_mut().push(Drawn { face, ..Drawn::default() });
        BinaryColor::On
    };
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
    let Ok(statistics) = instance.faces(shade).cached(&mut cache).draw(&mut Watch { size, drawn: &drawn });
    (drawn.into_inner(), statistics)
}

const NO_ROWS: [i32; 2] = [0, -1];

/// Where a face or an edge lies, in sub-pixels.
#[derive(Clone, Copy)]
struct Lies {
    x: [i32; 2],
    y: [i32; 2],
    is_inside: bool,
    /// Whether it lies between the left and the right border.
    is_between: bool,
    /// Whether it lies beyond one border.
    is_beside: bool,
}

impl Lies {
    fn new<const N: usize>(corners: [Projected; N], size: Size) -> Self {
        let x = reach(corners.map(|corner| corner.point.x()));
        let y = reach(corners.map(|corner| corner.point.y()));
        let [width, height] = [size.width, size.height].map(|side| (side as i32) << 8); // at most 1024
        let is_between = x[0] >= 0 && x[1] <= width;
        let is_beside = x[0] > width || x[1] < 0 || y[0] > height || y[1] < 0;
        Self { x, y, is_inside: is_between && y[0] >= 0 && y[1] <= height, is_between, is_beside }
    }

    /// The first and last row whose pixels' centres a face may cover.
    fn rows(&self) -> [i32; 2] {
        let [columns, rows] = [self.x, self.y].map(|[from, to]| [(from + 127) >> 8, ((to + 127) >> 8) - 1]);
        if columns[1] < columns[0] {
            NO_ROWS
        } else {
            rows
        }
    }

    /// The columns and rows that an edge touches in a picture of a size.
    fn sides(&self, size: Size) -> [i32; 2] {
        [(self.x, size.width), (self.y, size.height)].map(|([from, to], side)| {
            let at = |at: i32| (at >> 8).clamp(0, side as i32 - 1); // at most 1024
            at(to) - at(from) + 1
        })
    }

    fn size(&self) -> Option<FaceSize> {
        let is_low = self.is_between && self.y[1] - self.y[0] <= LOW << 8;
        (!self.is_beside).then_some(if is_low { FaceSize::Low } else { FaceSize::Large })
    }
}

/// The least and the largest of some coordinates.
pub fn reach<const N: usize>(places: [i32; N]) -> [i32; 2] {
    places.into_iter().fold([i32::MAX, i32::MIN], |[from, to], at| [from.min(at), to.max(at)])
}

/// The first and last row of a face: those of the bins of a mesh that has no other face.
fn rows_of_face(mesh: &Mesh<'_>, face: usize, place: Place<'_>) -> Option<[i32; 2]> {
    let alone = Mesh::new(mesh.vertices(), mesh.exponent(), mesh.faces().get(face..=face)?).ok()?;
    let (instance, mut bins) = (place(&alone), vec![0; alone.face_bins_len()]);
    Some(rows_of(&instance.transform(&mut []).bin_faces(&mut bins).ok()?.bounds()))
}

/// The first and last row of an edge: those of the bins of a mesh that has no other edge.
fn rows_of_edge(mesh: &Mesh<'_>, edge: usize, place: Place<'_>) -> Option<[i32; 2]> {
    let alone = Mesh::new(mesh.vertices(), mesh.exponent(), &[]).ok()?;
    let alone = alone.with_edges(mesh.edges().get(edge..=edge)?).ok()?;
    let (instance, mut bins) = (place(&alone), vec![0; alone.edge_bins_len()]);
    Some(rows_of(&instance.transform(&mut []).bin_edges(&mut bins).ok()?.bounds()))
}

fn rows_of(bounds: &Rectangle) -> [i32; 2] {
    let (top, height) = (bounds.top_left.y, bounds.size.height as i32);
    [top, top + height - 1]
}

/// The number of bands of `rows` rows that the rows `first` to `last` touch.
fn met([first, last]: [i32; 2], rows: u32) -> u32 {
    let band = |row: i32| row / rows.max(1) as i32; // at most 1024
    if last < first {
        0
    } else {
        (band(last) - band(first) + 1) as u32
    }
}

/// A target that counts what is drawn on it, for the last face.
struct Watch<'d> {
    size: Size,
    drawn: &'d RefCell<Vec<Drawn>>,
}

impl Watch<'_> {
    fn add(&self, rows: u32, pixels: u32) {
        if let Some(last) = self.drawn.borrow_mut().last_mut() {
            last.rows += rows;
            last.pixels += pixels;
        }
    }
}

impl OriginDimensions for Watch<'_> {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Watch<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        // The pixels of a line, which lie in the picture.
        self.add(0, pixels.into_iter().count() as u32);
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: BinaryColor) -> Result<(), Infallible> {
        // One row of a face; where a large one is as wide as the picture, many.
        self.add(area.size.height, area.size.width * area.size.height);
        Ok(())
    }
}
