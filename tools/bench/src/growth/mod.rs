//! How a frame's instructions grow with vertices, triangles, pixels and bands: cases that have more of one and less of
//! another. The firmware counts them; the host draws them too, and says what there was to do.

pub(crate) mod cases;
mod texture;
#[cfg(feature = "report")]
mod work;

pub use cases::{Case, CASES};
pub use texture::{coordinates, UNIT};

use self::texture::textured;
use crate::bands::{self, EdgeStorage, Storage};
use crate::board::Clock;
use crate::scene::{flat_dithered, flat_of_normals, smooth, Scene, BACKGROUND, LINE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    draw::{Cull, SmoothEdge},
    prelude::*,
    Angle,
};

/// The number of pixels of the largest picture.
const PIXELS: usize = 480 * 320;
/// The number of vertices of the largest mesh.
const CORNERS: usize = 10_000;
/// Bin storage for the faces of the largest mesh.
const BIN_STORAGE: usize = 20_000 + 20_000 / 16 + 32;
/// Bin storage for the edges of the largest mesh.
const EDGE_BIN_STORAGE: usize = 30_000 + 30_000 / 16 + 32;
/// The vertices that a painter stores: those of the largest mesh, and those of faces that are cut.
const PAINTED_CORNERS: usize = CORNERS + 2_000;
/// The visible faces of any mesh, and the triangles of those that are cut.
const PAINTED_FACES: usize = 12_000;
/// The vertices and faces of the painter for small meshes: the room that a painter has costs time.
const SMALL: usize = 1_600;
/// Bin storage for the smoothed edges of the largest mesh.
const SMOOTH_BIN_STORAGE: usize = EDGE_BIN_STORAGE + 2 * 30_000 / 16;
/// The bytes of the highest band, with two rows that wait.
const STRIP: usize = Frame::<Rgb565>::strip_bytes(480, 48 + 2);

pub struct Memory {
    pixels: [Rgb565; PIXELS],
    depth: [u16; PIXELS],
    buffers: MeshBuffers<CORNERS, BIN_STORAGE, SMOOTH_BIN_STORAGE>,
    strip: [u8; STRIP],
    kept: [u8; Frame::<Rgb565>::strip_bytes(480, 2)],
    list: [SmoothEdge; LIST],
    painter: Painter<Rgb565, PAINTED_CORNERS, PAINTED_FACES>,
    small_painter: Painter<Rgb565, SMALL, SMALL>,
}

impl Memory {
    pub const NEW: Self = Self {
        pixels: [BACKGROUND; PIXELS],
        depth: [0; PIXELS],
        buffers: MeshBuffers::new(),
        strip: [0; STRIP],
        kept: [0; Frame::<Rgb565>::strip_bytes(480, 2)],
        list: [SmoothEdge::EMPTY; LIST],
        painter: Painter::new(),
        small_painter: Painter::new(),
    };
}

/// Entries for edges that are set up.
const LIST: usize = 16;

/// How a case is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Lines,
    Faces,
    Depth,
    /// Faces with depth.
    Bands,
    /// All edges as lines.
    LineBands,
    /// The edges that faces do not hide, of a mesh with the faces beside all edges.
    HiddenBands,
    /// [`HiddenBands`](Self::HiddenBands), of a mesh with a quarter of its edges.
    FewHiddenBands,
    /// Smooth faces with depth.
    SmoothBands,
    /// Flat faces in dithered colours with depth.
    DitheredBands,
    /// Smooth faces in dithered colours with depth.
    SmoothDitheredBands,
    /// Lit faces with a picture on them, with depth.
    TexturedBands,
    /// Smoothing the silhouettes of faces with depth: what it takes beside [`Bands`](Self::Bands).
    Silhouettes,
    /// Smoothing silhouettes and all creases.
    Creases,
    /// Faces without depth.
    PlainBands,
    /// Faces in painter's order.
    Painted,
    PaintedBands,
}

/// A kind, in bands of this many rows or in one piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    pub kind: Kind,
    pub rows: Option<u32>,
}

/// Ways to draw that share their constants: their name, their kinds, and the rows of bands.
type Group = (&'static str, &'static [Kind], &'static [Option<u32>]);

pub const WAYS: [Group; 14] = [
    ("lines", &[Kind::Lines], WHOLE),
    ("faces", &[Kind::Faces], WHOLE),
    ("depth", &[Kind::Depth], WHOLE),
    ("bands", &[Kind::Bands], &[Some(8), Some(16), Some(48)]),
    ("line-bands", &[Kind::LineBands], IN_BANDS),
    ("hidden-bands", &[Kind::HiddenBands, Kind::FewHiddenBands], IN_BANDS),
    ("smooth-bands", &[Kind::SmoothBands], IN_BANDS),
    ("dithered-bands", &[Kind::DitheredBands], IN_BANDS),
    ("smooth-dithered-bands", &[Kind::SmoothDitheredBands], IN_BANDS),
    ("textured-bands", &[Kind::TexturedBands], IN_BANDS),
    ("smooth-edges", &[Kind::Silhouettes, Kind::Creases], IN_BANDS),
    ("plain-bands", &[Kind::PlainBands], IN_BANDS),
    ("painted", &[Kind::Painted], WHOLE),
    ("painted-bands", &[Kind::PaintedBands], IN_BANDS),
];
const WHOLE: &[Option<u32>] = &[None];
const IN_BANDS: &[Option<u32>] = &[Some(8), Some(48)];

/// All ways, group by group.
pub fn ways() -> impl Iterator<Item = Way> {
    let of_kind =
        |rows: &'static [Option<u32>]| move |&kind| rows.iter().map(move |&rows| Way { kind, rows });
    WAYS.into_iter().flat_map(move |(_, kinds, rows)| kinds.iter().flat_map(of_kind(rows)))
}

const LEVEL: [[i32; 3]; 3] = [[1 << 16, 0, 0], [0, 1 << 16, 0], [0, 0, 1 << 16]];

/// The instructions of what comes before a frame: turning the object and placing it before the camera; and turning its light.
pub fn placing(clock: &mut Clock) -> Option<[u32; 2]> {
    let camera = crate::scene::TORUS.camera()?;
    let (mesh, turn, light) =
        black_box((crate::scene::TORUS.mesh, Angle::turns(23, 120), Vector3::from_ints(2, 3, 4)));
    let place = clock.count(&mut || {
        let model = Affine::rotation_y(turn);
        black_box((camera.place(&mesh, &model), model));
    })?;
    let (model, mut good) = (black_box(Affine::rotation_y(turn)), None);
    let light = clock.count(&mut || {
        let light = Lambert::new(&model, light, 48).ok();
        black_box(&light);
        good = light.map(|_| ());
    })?;
    good.map(|()| [place, light])
}

impl Case {
    fn scene(&self, way: Way) -> Option<Scene> {
        self.scene_of(self.mesh(way.kind)?)
    }

    fn scene_of(&self, mesh: Mesh<'static>) -> Option<Scene> {
        // Turned as S3's torus; what is land stays level.
        let axes = black_box(if self.level { LEVEL } else { crate::scene::TORUS.axes });
        let [width, height] = self.size;
        Scene::viewed(mesh, axes, black_box(self.eye), black_box(Size::new(width, height)))
    }

    /// The instructions of a whole frame, its clears too, or of smoothing its edges alone.
    pub fn count(&self, way: Way, memory: &mut Memory, clock: &mut Clock) -> Option<u32> {
        let instructions = self.count_frame(way, self.cull_of(way.kind), memory, clock)?;
        match way.kind {
            Kind::Silhouettes | Kind::Creases => {
                let bands = Way { kind: Kind::Bands, ..way };
                Some(instructions - self.count_frame(bands, self.cull_of(way.kind), memory, clock)?)
            }
            _ => Some(instructions),
        }
    }

    fn count_frame(&self, way: Way, cull: Cull, memory: &mut Memory, clock: &mut Clock) -> Option<u32> {
        let scene = self.scene(way)?;
        let (instance, light) = (scene.place().with_cull(cull), scene.light()?);
        let size = Size::new(self.size[0], self.size[1]);
        let (instance, light, size) = black_box((&instance, &light, size));
        let (is_small, mut good) = (self.is_small(), None);
        let instructions = clock.count(&mut || {
            good = match way.rows {
                None => in_one_piece(instance, way.kind, light, size, is_small, memory),
                Some(rows) => in_bands(instance, way.kind, light, (size, rows), is_small, memory),
            }
        })?;
        good.map(|()| instructions)
    }
}

fn in_one_piece(
    instance: &MeshInstance<'_>,
    kind: Kind,
    light: &Lambert,
    size: Size,
    is_small: bool,
    memory: &mut Memory,
) -> Option<()> {
    let shade = flat_of_normals(instance.mesh().normals(), light);
    let Memory { pixels, depth, buffers: MeshBuffers { cache, .. }, painter, small_painter, .. } = memory;
    let mut picture = Picture::new(pixels, size).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    let drawn = match kind {
        Kind::Lines => instance.edges(|_| LINE).cached(cache).draw(&mut picture.pixels()),
        Kind::Depth => {
            let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), depth).ok()?;
            instance.faces(shade).cached(cache).draw(&mut picture.pixels().depth_tested(&mut depth))
        }
        Kind::Painted if is_small => {
            instance.faces(shade).sorted(small_painter).ok()?;
            small_painter.draw(&mut picture.pixels())
        }
        Kind::Painted => {
            instance.faces(shade).sorted(painter).ok()?;
            painter.draw(&mut picture.pixels())
        }
        _ => instance.faces(shade).cached(cache).draw(&mut picture.pixels()),
    };
    let Ok(statistics) = drawn;
    black_box(statistics);
    Some(())
}

fn in_bands(
    instance: &MeshInstance<'_>,
    kind: Kind,
    light: &Lambert,
    (size, rows): (Size, u32),
    is_small: bool,
    memory: &mut Memory,
) -> Option<()> {
    let Memory { depth, buffers: MeshBuffers { cache, bins, edge_bins }, strip, kept, list, .. } = memory;
    let is_smoothed = matches!(kind, Kind::Silhouettes | Kind::Creases);
    let strip =
        strip.get_mut(..Frame::<Rgb565>::strip_bytes(size.width, rows + 2 * u32::from(is_smoothed)))?;
    let (mesh, mut storage) = (instance.mesh(), Storage { corners: cache, bin_storage: bins, strip, depth });
    let flat = flat_of_normals(mesh.normals(), light);
    let send = |band: &Band<'_, Rgb565>| {
        black_box(band.bytes());
    };
    match kind {
        // Into a band as into any target, as line drawings for displays of one bit are.
        Kind::LineBands => {
            storage.bin_storage = edge_bins;
            bands::wireframe(instance, size, storage, |edges, band| {
                let Ok(()) = edges.draw(LINE, band);
                send(band);
            })
        }
        Kind::HiddenBands | Kind::FewHiddenBands => {
            bands::hidden(instance, [LINE, BACKGROUND], size, edge_bins, storage, send)
        }
        Kind::SmoothBands => bands::depth(instance, smooth(mesh, light), size, storage, send),
        Kind::DitheredBands => {
            bands::depth(instance, flat_dithered(mesh.normals(), light), size, storage, send)
        }
        Kind::SmoothDitheredBands => {
            bands::depth(instance, |face| Dithered(smooth(mesh, light)(face)), size, storage, send)
        }
        Kind::TexturedBands => bands::depth(instance, textured(mesh, light)?, size, storage, send),
        Kind::Silhouettes | Kind::Creases => {
            let (is_crease, edges) = (|_| kind == Kind::Creases, EdgeStorage { kept, bins: edge_bins, list });
            bands::smooth(instance, flat, is_crease, size, storage, edges, send)
        }
        Kind::PlainBands => bands::solid(instance, flat, size, storage, send),
        Kind::PaintedBands => match is_small {
            true => painted_bands(instance, flat, size, storage.strip, &mut memory.small_painter),
            false => painted_bands(instance, flat, size, storage.strip, &mut memory.painter),
        },
        _ => bands::depth(instance, flat, size, storage, send),
    }
}

fn painted_bands<const V: usize, const F: usize>(
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> Rgb565,
    size: Size,
    strip: &mut [u8],
    painter: &mut Painter<Rgb565, V, F>,
) -> Option<()> {
    painter.clear();
    instance.faces(shade).sorted(painter).ok()?;
    let order = painter.order();
    bands::each_band(size, BACKGROUND, strip, |band| {
        let Ok(()) = order.draw(&mut band.pixels());
        black_box(band.bytes());
        Some(())
    })?;
    black_box(order.statistics());
    painter.clear();
    Some(())
}
