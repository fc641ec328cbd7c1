//! The work of a frame in the terms of docs/growth.md: the numbers of vertices, faces, rows, pixels and so on, each of which
//! costs instructions.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::BinaryColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;
use pinhole::{Cull, Mesh, MeshInstance, Projected, ScreenVertex, Statistics};

/// The work of a frame of faces.
pub(crate) struct FaceWork {
    vertices: u32,
    all: u32,
    drawn: u32,
    large: u32,
    outside: u32,
    clipped: u32,
    cut: u32,
    rows: u32,
    pixels: u32,
    size: Size,
    /// The drawn faces that clipping does not cut.
    extents: Vec<Extent>,
    /// Whether each face is drawn.
    is_drawn: Vec<bool>,
}

/// A drawn face.
struct Extent {
    /// The first and the last row.
    rows: [i32; 2],
    pixels: f64,
    is_large: bool,
    /// Whether texture coordinates are not interpolated linearly over it.
    is_in_perspective: bool,
}

/// The work of a frame of lines.
pub(crate) struct LineWork {
    vertices: u32,
    drawn: u32,
    across: u32,
    clipped: u32,
    cut: u32,
    pixels: u32,
    size: Size,
    /// The first and the last row of each edge that is not clipped, and the number of drawn faces beside the edge.
    extents: Vec<([i32; 2], u32)>,
}

/// A triangle of at most this many rows between the left and the right border takes a fast path.
const LOW: i32 = 31;

/// Draws the faces of an instance into a counting target. Also returns the drawn faces.
fn watched(instance: &MeshInstance<'_>, size: Size) -> (Watch, Statistics, Vec<usize>) {
    let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().cache_len()];
    let (mut watch, mut seen) = (Watch::new(size), Vec::new());
    let shade = |face: usize| {
        seen.push(face);
        BinaryColor::On
    };
    let Ok(statistics) = instance.solid(shade, &mut cache, &mut watch);
    (watch, statistics, seen)
}

impl FaceWork {
    /// Counts the work of the faces of an instance on a display of a size. `is_linear`: whether texture coordinates are interpolated
    /// linearly over a face with these corners.
    pub(crate) fn new(
        instance: &MeshInstance<'_>,
        size: Size,
        is_linear: &dyn Fn(usize, [Projected; 3]) -> bool,
    ) -> Self {
        let mesh = instance.mesh();
        let (watch, statistics, seen) = watched(instance, size);
        let points: Vec<Option<Projected>> =
            (0..mesh.vertices().len()).map(|vertex| instance.project(vertex).ok()).collect();
        let corners = |face: &[u16; 3]| -> Option<[Projected; 3]> {
            let [a, b, c] = face.map(|vertex| points.get(usize::from(vertex)).copied().flatten());
            Some([a?, b?, c?])
        };
        let must_be_clipped = mesh.faces().iter().filter(|face| corners(face).is_none()).count() as u32;
        // Faces in front of the near plane or beyond the far plane count in `must_be_clipped`, but need no clipping.
        let outside = match must_be_clipped {
            0 => statistics.outside,
            _ => watched(&instance.with_cull(Cull::None), size).1.outside,
        };
        let (mut extents, mut large) = (Vec::new(), 0);
        let mut is_drawn = vec![false; mesh.faces().len()];
        for face in seen {
            if let Some(is_drawn) = is_drawn.get_mut(face) {
                *is_drawn = true;
            }
            let Some(corners) = mesh.faces().get(face).and_then(corners) else {
                large += 1;
                continue;
            };
            let [x, y] = [0, 1].map(|axis| {
                reach(corners.map(|seen| if axis == 0 { seen.point.x() } else { seen.point.y() }))
            });
            let [width, height] = [size.width, size.height].map(|side| (side as i32) << 8); // at most 1024
            let is_beside = x[0] > width || x[1] < 0 || y[0] > height || y[1] < 0;
            let is_within = x[0] >= 0 && x[1] <= width;
            let is_low = is_within && y[1] - y[0] <= LOW << 8;
            let is_large = !(is_beside || is_low);
            large += u32::from(is_large);
            // The rows whose centres, at half a pixel, lie between the first and the last point.
            let row = |at: i32| (at + 127) >> 8;
            let rows = [row(y[0]).max(0), (row(y[1]) - 1).min(size.height as i32 - 1)];
            let is_in_perspective = !is_linear(face, corners);
            // Half the area of the face's bounding rectangle; for a face across the border, only the part of the rectangle
            // inside.
            let pixels =
                if is_in_perspective { area(corners) * inside(x, width) * inside(y, height) } else { 0.0 };
            extents.push(Extent { rows, pixels, is_large, is_in_perspective });
        }
        Self {
            vertices: mesh.vertices().len() as u32, // at most 65 536, as faces
            all: mesh.faces().len() as u32,
            drawn: statistics.drawn,
            large,
            outside,
            clipped: must_be_clipped.saturating_sub(outside),
            cut: statistics.clipped,
            rows: watch.rows,
            pixels: watch.pixels,
            size,
            extents,
            is_drawn,
        }
    }

    fn area(&self) -> u32 {
        self.size.width * self.size.height
    }

    /// The counts of a frame in one piece, in the order of docs/growth.md.
    pub(crate) fn whole(&self) -> [f64; 11] {
        let left_out = self.all.saturating_sub(self.drawn + self.outside);
        [
            1,
            self.vertices,
            left_out,
            self.drawn,
            self.large,
            self.outside,
            self.clipped,
            self.cut,
            self.rows,
            self.pixels,
            self.area(),
        ]
        .map(f64::from)
    }

    /// The counts of a frame in bands of `rows` rows, in the order of docs/growth.md.
    pub(crate) fn in_bands(&self, rows: u32) -> [f64; 13] {
        let (mut all, mut large) = (0, 0);
        for extent in &self.extents {
            all += met(extent.rows, rows);
            large += if extent.is_large { met(extent.rows, rows) } else { 0 };
        }
        let bands = self.size.height.div_ceil(rows.max(1));
        // A cut face is clipped again in each band that it may reach; here, in all of them.
        let cut = self.cut * bands;
        [
            1,
            self.vertices,
            self.all.saturating_sub(self.outside),
            self.outside,
            self.clipped,
            self.cut,
            all + cut,
            large,
            cut,
            self.rows,
            self.pixels,
            self.area(),
            bands,
        ]
        .map(f64::from)
    }
}

impl FaceWork {
    /// The counts of a frame of textured faces in bands of `rows` rows, in the order of docs/growth.md.
    pub(crate) fn textured_in_bands(&self, rows: u32) -> [f64; 13] {
        let [frame, vertices, _, _, _, _, met_all, large, cut, of_faces, pixels, area, bands] =
            self.in_bands(rows);
        let mut in_perspective = [cut, 0.0, 0.0];
        for extent in self.extents.iter().filter(|extent| extent.is_in_perspective) {
            let height = (extent.rows[1] - extent.rows[0] + 1).max(0);
            let counts = [met(extent.rows, rows).into(), height.into(), extent.pixels];
            in_perspective.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
        let [met, rows, inside] = in_perspective;
        let all = f64::from(self.all);
        [frame, vertices, all, met_all, large, cut, of_faces, pixels, area, bands, met, rows, inside]
    }

    /// The counts of a frame in painter's order, in one piece, in the order of docs/growth.md. The cache has room for all
    /// vertices.
    pub(crate) fn painted(&self) -> [f64; 11] {
        let mut counts = self.whole();
        counts[0] = counts[1];
        counts
    }

    /// The counts of a frame in painter's order, in bands of `rows` rows, in the order of docs/growth.md.
    pub(crate) fn painted_in_bands(&self, rows: u32) -> [f64; 12] {
        let [_, vertices, _, _, _, cut, met, large, cut_in_bands, of_faces, pixels, area, bands] =
            self.in_bands(rows);
        let [all, drawn] = [self.all, self.drawn].map(f64::from);
        let large = large + cut_in_bands;
        [vertices, vertices, all, drawn, cut, drawn * bands, met, large, of_faces, pixels, area, bands]
    }

    /// The counts of a frame of faces with another shading, or without depth, in bands of `rows` rows, in the order of
    /// docs/growth.md.
    pub(crate) fn shaded_in_bands(&self, rows: u32) -> [f64; 11] {
        let [frame, vertices, _, _, _, cut, met, large, cut_in_bands, of_faces, pixels, area, bands] =
            self.in_bands(rows);
        let all = f64::from(self.all);
        [frame, vertices, all, cut, met, large, cut_in_bands, of_faces, pixels, area, bands]
    }
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

/// The counts of a frame of hidden lines in bands of `rows` rows, in the order of docs/growth.md.
pub(crate) fn hidden_in_bands(faces: &FaceWork, lines: &LineWork, rows: u32) -> [f64; 15] {
    let [frame, vertices, all, cut, met, large, cut_in_bands, of_faces, pixels, area, bands] =
        faces.shaded_in_bands(rows);
    let (edges, beside) = lines.met(rows);
    let [clipped, edges, beside, of_lines] = [lines.clipped, edges, beside, lines.pixels].map(f64::from);
    [
        frame,
        vertices,
        all,
        cut,
        met,
        large,
        cut_in_bands,
        of_faces,
        pixels,
        area,
        bands,
        clipped,
        edges,
        beside,
        of_lines,
    ]
}

impl LineWork {
    /// Counts the work of the edges of an instance on a display of a size. `faces` is the work of its faces, if they hide lines.
    pub(crate) fn new(instance: &MeshInstance<'_>, size: Size, faces: Option<&FaceWork>) -> Self {
        let mesh = instance.mesh();
        let mut watch = Watch::new(size);
        let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
        let Ok(statistics) = instance.wireframe(BinaryColor::On, &mut cache, &mut watch);
        let (mut across, mut clipped, mut extents) = (0, 0, Vec::new());
        let is_drawn = |face: u16| faces.and_then(|work| work.is_drawn.get(usize::from(face)).copied());
        for (index, edge) in mesh.edges().iter().enumerate() {
            match edge.map(|vertex| instance.project(vertex.into())) {
                [Ok(a), Ok(b)] => {
                    let sides = [
                        (size.width, reach([a.point.x(), b.point.x()])),
                        (size.height, reach([a.point.y(), b.point.y()])),
                    ];
                    let within =
                        |&(side, [from, to]): &(u32, [i32; 2])| from >= 0 && to <= (side as i32) << 8;
                    let beside = |&(side, [from, to]): &(u32, [i32; 2])| from > (side as i32) << 8 || to < 0;
                    let is_beside = sides.iter().any(beside);
                    across += u32::from(!sides.iter().all(within) && !is_beside);
                    if !is_beside {
                        let [(_, _), (height, [from, to])] = sides;
                        let rows = [(from >> 8).max(0), (to >> 8).min(height as i32 - 1)]; // at most 1024
                        let faces = mesh.edge_faces().get(index).copied().unwrap_or([<Mesh<'_>>::NO_FACE; 2]);
                        let drawn = faces.into_iter().filter(|&face| is_drawn(face) == Some(true)).count();
                        extents.push((rows, drawn as u32)); // at most 2
                    }
                }
                _ => clipped += 1,
            }
        }
        Self {
            vertices: mesh.vertices().len() as u32,
            drawn: statistics.drawn,
            across,
            clipped,
            cut: statistics.clipped,
            pixels: watch.pixels,
            size,
            extents,
        }
    }

    fn area(&self) -> u32 {
        self.size.width * self.size.height
    }

    /// The counts of a frame in one piece, in the order of docs/growth.md.
    pub(crate) fn whole(&self) -> [f64; 8] {
        [1, self.vertices, self.drawn, self.across, self.clipped, self.cut, self.pixels, self.area()]
            .map(f64::from)
    }

    /// The edges in each band of `rows` rows, summed over the bands, and the drawn faces beside these edges.
    fn met(&self, rows: u32) -> (u32, u32) {
        // An edge that is cut may reach every band, with two faces beside it.
        let cut = self.cut * self.size.height.div_ceil(rows.max(1));
        self.extents.iter().fold((cut, 2 * cut), |(edges, faces), &(extent, beside)| {
            let met = met(extent, rows);
            (edges + met, faces + met * beside)
        })
    }

    /// The counts of a frame in bands of `rows` rows, in the order of docs/growth.md.
    pub(crate) fn in_bands(&self, rows: u32) -> [f64; 8] {
        let (met, _) = self.met(rows);
        let bands = self.size.height.div_ceil(rows.max(1));
        [1, self.vertices, self.clipped, self.cut, met, self.pixels, self.area(), bands].map(f64::from)
    }
}

/// The area of a triangle, in pixels.
fn area([a, b, c]: [Projected; 3]) -> f64 {
    let side = |to: Projected| {
        [to.point.x() - a.point.x(), to.point.y() - a.point.y()].map(|subpixels| f64::from(subpixels) / 256.0)
    };
    let ([bx, by], [cx, cy]) = (side(b), side(c));
    (bx * cy - by * cx).abs() / 2.0
}

/// The part of the range `from` … `to` that lies between 0 and `side`.
fn inside([from, to]: [i32; 2], side: i32) -> f64 {
    f64::from((to.min(side) - from.max(0)).max(0)) / f64::from((to - from).max(1))
}

fn reach<const N: usize>(places: [i32; N]) -> [i32; 2] {
    places.into_iter().fold([i32::MAX, i32::MIN], |[from, to], at| [from.min(at), to.max(at)])
}

/// A target that counts what is drawn on it.
struct Watch {
    size: Size,
    rows: u32,
    pixels: u32,
}

impl Watch {
    fn new(size: Size) -> Self {
        Self { size, rows: 0, pixels: 0 }
    }
}

impl OriginDimensions for Watch {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Watch {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        // The pixels of a line, which lie in the picture.
        self.pixels += pixels.into_iter().count() as u32;
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: BinaryColor) -> Result<(), Infallible> {
        // One row of a face; for a face wider than the picture, several rows at once.
        self.rows += area.size.height;
        self.pixels += area.size.width * area.size.height;
        Ok(())
    }
}
