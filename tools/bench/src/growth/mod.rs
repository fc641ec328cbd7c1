//! How a frame's instructions grow with vertices, triangles, pixels and bands: cases that have more of one and less of
//! another. The firmware counts them; the host draws them too, and says what there was to do.

mod cases;
mod shapes;
mod texture;
#[cfg(not(target_os = "none"))]
mod watch;
#[cfg(not(target_os = "none"))]
mod work;

pub use cases::{Case, CASES};
#[cfg(not(target_os = "none"))]
pub use work::{names, Work, ALL, SOME};

use self::texture::textured;
use crate::board::Clock;
use crate::scene::{flat_dithered, flat_of_normals, smooth, Scene, BACKGROUND, LINE};
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Affine, Angle, BinnedFaces, Cull, DepthBuffer, FacePlanes, Frame, Lambert, Mesh, MeshInstance, Painter,
    Picture, ScreenVertex, SpanShader, Vector3, WithPlanes,
};

/// The number of pixels of the largest picture.
const PIXELS: usize = 480 * 320;
/// The number of vertices of the largest mesh.
const CORNERS: usize = 10_000;
/// The bins of the faces of the largest mesh, with one more for every 16.
const BIN_STORAGE: usize = 20_000 + 20_000 / 16;
/// The bins of the edges of the largest mesh, with one more for every 16.
const EDGE_BIN_STORAGE: usize = 30_000 + 30_000 / 16;
/// The vertices that a painter stores: those of the largest mesh, and those of faces that are cut.
const PAINTED_CORNERS: usize = CORNERS + 2_000;
/// The visible faces of any mesh, and the triangles of those that are cut.
const PAINTED_FACES: usize = 12_000;
/// The vertices and faces of the painter for small meshes: the room that a painter has costs time.
const SMALL: usize = 1_600;
/// The bytes of the highest band.
const STRIP: usize = Frame::<Rgb565>::strip_bytes(480, 48);

pub struct Memory {
    pixels: [Rgb565; PIXELS],
    depth: [u16; PIXELS],
    corners: [ScreenVertex; CORNERS],
    bin_storage: [u16; BIN_STORAGE],
    edge_bin_storage: [u16; EDGE_BIN_STORAGE],
    strip: [u8; STRIP],
    painter: Painter<Rgb565, PAINTED_CORNERS, PAINTED_FACES>,
    small_painter: Painter<Rgb565, SMALL, SMALL>,
}

impl Memory {
    pub const NEW: Self = Self {
        pixels: [BACKGROUND; PIXELS],
        depth: [0; PIXELS],
        corners: [ScreenVertex::EMPTY; CORNERS],
        bin_storage: [0; BIN_STORAGE],
        edge_bin_storage: [0; EDGE_BIN_STORAGE],
        strip: [0; STRIP],
        painter: Painter::new(),
        small_painter: Painter::new(),
    };
}

/// How a case is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Lines,
    Faces,
    Depth,
    /// Faces, with early culling by face planes.
    PlaneCulled,
    /// Faces with depth, with early culling by face planes.
    FacingDepth,
    /// Faces with depth, in bands of this many rows.
    Bands(u32),
    /// Faces with depth in bands of this many rows, with early culling by face planes.
    FacingBands(u32),
    /// All edges as lines, in bands of this many rows.
    LineBands(u32),
    /// The edges that faces do not hide, in bands of this many rows, of a mesh with the faces beside all edges.
    HiddenBands(u32),
    /// [`HiddenBands`](Self::HiddenBands), of a mesh with a quarter of its edges.
    FewHiddenBands(u32),
    /// Faces without depth, in bands of this many rows.
    PlainBands(u32),
    /// Faces in painter's order.
    Painted,
    /// Faces in painter's order, in bands of this many rows.
    PaintedBands(u32),
    /// Smooth faces with depth, in bands of this many rows.
    SmoothBands(u32),
    /// Flat faces in dithered colours with depth, in bands of this many rows.
    DitheredBands(u32),
    /// Smooth faces in dithered colours with depth, in bands of this many rows.
    SmoothDitheredBands(u32),
    /// Lit faces with a picture on them, with depth, in bands of this many rows.
    TexturedBands(u32),
}

/// The ways to draw, grouped by the constants that they share.
pub const WAYS: [&[Way]; 16] = [
    &[Way::Lines],
    &[Way::Faces],
    &[Way::Depth],
    &[Way::PlaneCulled],
    &[Way::FacingDepth],
    &[Way::Bands(8), Way::Bands(16), Way::Bands(48)],
    &[Way::FacingBands(8), Way::FacingBands(16), Way::FacingBands(48)],
    &[Way::LineBands(8), Way::LineBands(48)],
    &[Way::HiddenBands(8), Way::HiddenBands(48), Way::FewHiddenBands(8), Way::FewHiddenBands(48)],
    &[Way::SmoothBands(8), Way::SmoothBands(48)],
    &[Way::DitheredBands(8), Way::DitheredBands(48)],
    &[Way::SmoothDitheredBands(8), Way::SmoothDitheredBands(48)],
    &[Way::TexturedBands(8), Way::TexturedBands(48)],
    &[Way::PlainBands(8), Way::PlainBands(48)],
    &[Way::Painted],
    &[Way::PaintedBands(8), Way::PaintedBands(48)],
];

const LEVEL: [[i32; 3]; 3] = [[1 << 16, 0, 0], [0, 1 << 16, 0], [0, 0, 1 << 16]];

impl Way {
    /// Whether faces alone are drawn.
    pub fn is_of_faces(self) -> bool {
        !matches!(self, Self::Lines | Self::LineBands(_) | Self::HiddenBands(_) | Self::FewHiddenBands(_))
    }

    fn asks_planes(self) -> bool {
        matches!(self, Self::PlaneCulled | Self::FacingDepth | Self::FacingBands(_))
    }
}

impl core::fmt::Display for Way {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Lines => f.write_str("lines"),
            Self::Faces => f.write_str("faces"),
            Self::Depth => f.write_str("depth"),
            Self::PlaneCulled => f.write_str("faces by planes"),
            Self::FacingDepth => f.write_str("depth by planes"),
            Self::Bands(rows) => write!(f, "bands of {rows} rows"),
            Self::FacingBands(rows) => write!(f, "bands of {rows} rows by planes"),
            Self::LineBands(rows) => write!(f, "lines in bands of {rows} rows"),
            Self::HiddenBands(rows) => write!(f, "hidden lines in bands of {rows} rows"),
            Self::FewHiddenBands(rows) => write!(f, "few hidden lines in bands of {rows} rows"),
            Self::SmoothBands(rows) => write!(f, "smooth in bands of {rows} rows"),
            Self::DitheredBands(rows) => write!(f, "dithered in bands of {rows} rows"),
            Self::SmoothDitheredBands(rows) => write!(f, "smooth and dithered in bands of {rows} rows"),
            Self::TexturedBands(rows) => write!(f, "textured in bands of {rows} rows"),
            Self::PlainBands(rows) => write!(f, "without depth in bands of {rows} rows"),
            Self::Painted => f.write_str("painter's order"),
            Self::PaintedBands(rows) => write!(f, "painter's order in bands of {rows} rows"),
        }
    }
}

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
    /// The ways in which it is drawn, as indices into [`WAYS`]: not by planes if both sides of faces show.
    pub fn ways(&self) -> impl Iterator<Item = Way> {
        let asked = self.cull == Cull::Back;
        WAYS.into_iter().flatten().copied().filter(move |way| asked || !way.asks_planes())
    }

    fn scene(&self, way: Way) -> Option<Scene<WithPlanes>> {
        self.scene_of(self.what.mesh(way)?)
    }

    fn scene_of<P: FacePlanes>(&self, mesh: Mesh<'static, i16, P>) -> Option<Scene<P>> {
        // Turned as S3's torus; what is land stays level.
        let axes = black_box(if self.level { LEVEL } else { crate::scene::TORUS.axes });
        let [width, height] = self.size;
        Scene::viewed(mesh, axes, black_box(self.eye), black_box(Size::new(width, height)))
    }

    /// The instructions of a whole frame, its clears too.
    pub fn count(&self, way: Way, memory: &mut Memory, clock: &mut Clock) -> Option<u32> {
        let scene = self.scene(way)?;
        let (by_planes, light) = (scene.place().with_cull(self.cull), scene.light()?);
        let instance = by_planes.without_planes();
        let size = Size::new(self.size[0], self.size[1]);
        let (instance, by_planes, light, size) = black_box((&instance, &by_planes, &light, size));
        let mesh = instance.mesh();
        let mut good = None;
        let instructions = clock.count(&mut || {
            good = match way {
                Way::Lines => lines(instance, size, memory),
                Way::Faces => faces(instance, light, size, memory),
                Way::Depth => depth(instance, light, size, memory),
                Way::PlaneCulled => faces(by_planes, light, size, memory),
                Way::FacingDepth => depth(by_planes, light, size, memory),
                Way::Bands(rows) => bands(instance, light, size, rows, memory),
                Way::FacingBands(rows) => bands(by_planes, light, size, rows, memory),
                Way::LineBands(rows) => line_bands(instance, size, rows, memory),
                Way::HiddenBands(rows) | Way::FewHiddenBands(rows) => {
                    hidden_bands(instance, size, rows, memory)
                }
                Way::SmoothBands(rows) => shaded_bands(instance, smooth(&mesh, light), size, rows, memory),
                Way::DitheredBands(rows) => {
                    shaded_bands(instance, flat_dithered(mesh.normals(), light), size, rows, memory)
                }
                Way::SmoothDitheredBands(rows) => {
                    let shade = |face| smooth(&mesh, light)(face).dithered();
                    shaded_bands(instance, shade, size, rows, memory)
                }
                Way::TexturedBands(rows) => {
                    let shade = textured(&mesh, light);
                    shade.and_then(|shade| shaded_bands(instance, shade, size, rows, memory))
                }
                Way::PlainBands(rows) => plain_bands(instance, light, size, rows, memory),
                Way::Painted if self.is_small() => {
                    painted(instance, light, size, &mut memory.pixels, &mut memory.small_painter)
                }
                Way::Painted => painted(instance, light, size, &mut memory.pixels, &mut memory.painter),
                Way::PaintedBands(rows) => {
                    let strip = strip_of(&mut memory.strip, size, rows);
                    strip.and_then(|strip| match self.is_small() {
                        true => painted_bands(instance, light, size, strip, &mut memory.small_painter),
                        false => painted_bands(instance, light, size, strip, &mut memory.painter),
                    })
                }
            }
        })?;
        good.map(|()| instructions)
    }
}

fn lines(instance: &MeshInstance<'_>, size: Size, memory: &mut Memory) -> Option<()> {
    let mut picture = Picture::new(&mut memory.pixels, size).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    let Ok(statistics) = instance.wireframe(LINE, &mut memory.corners, &mut picture.pixels());
    black_box(statistics);
    Some(())
}

fn faces<P: FacePlanes>(
    instance: &MeshInstance<'_, i16, P>,
    light: &Lambert,
    size: Size,
    memory: &mut Memory,
) -> Option<()> {
    let mut picture = Picture::new(&mut memory.pixels, size).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    let shade = flat_of_normals(instance.mesh().normals(), light);
    let Ok(statistics) = instance.solid(shade, &mut memory.corners, &mut picture.pixels());
    black_box(statistics);
    Some(())
}

fn depth<P: FacePlanes>(
    instance: &MeshInstance<'_, i16, P>,
    light: &Lambert,
    size: Size,
    memory: &mut Memory,
) -> Option<()> {
    let Memory { pixels, depth, corners, .. } = memory;
    let mut picture = Picture::new(pixels, size).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), depth).ok()?;
    let shade = flat_of_normals(instance.mesh().normals(), light);
    let Ok(statistics) = instance.depth_tested(shade, corners, &mut depth, &mut picture.pixels());
    black_box(statistics);
    Some(())
}

fn bands<P: FacePlanes>(
    instance: &MeshInstance<'_, i16, P>,
    light: &Lambert,
    size: Size,
    rows: u32,
    memory: &mut Memory,
) -> Option<()> {
    let Memory { depth, corners, bin_storage, strip, .. } = memory;
    let faces = instance.bin_faces_with_depth(corners, bin_storage).ok()?;
    in_bands(faces, instance, light, size, strip_of(strip, size, rows)?, depth)
}

/// For bands of so many rows.
fn strip_of(strip: &mut [u8], size: Size, rows: u32) -> Option<&mut [u8]> {
    strip.get_mut(..Frame::<Rgb565>::strip_bytes(size.width, rows))
}

fn in_bands<P: FacePlanes>(
    mut faces: BinnedFaces<'_, i16, true>,
    instance: &MeshInstance<'_, i16, P>,
    light: &Lambert,
    size: Size,
    strip: &mut [u8],
    depth: &mut [u16],
) -> Option<()> {
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        let Ok(()) = faces.depth_tested(
            flat_of_normals(instance.mesh().normals(), light),
            &mut depth,
            &mut band.pixels(),
        );
        black_box(band.bytes());
    }
    black_box(faces.statistics());
    Some(())
}

/// Into a band as into any target, as line drawings for displays of one bit are.
fn line_bands(instance: &MeshInstance<'_>, size: Size, rows: u32, memory: &mut Memory) -> Option<()> {
    let Memory { corners, edge_bin_storage, strip, .. } = memory;
    let transformed = instance.transform(corners);
    let mut edges = transformed.bin_edges(edge_bin_storage).ok()?;
    let strip = strip_of(strip, size, rows)?;
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let Ok(()) = edges.draw(LINE, &mut band);
        black_box(band.bytes());
    }
    black_box(edges.statistics());
    Some(())
}

/// Depths of the faces, and then the edges, into a band as into any target.
fn hidden_bands(instance: &MeshInstance<'_>, size: Size, rows: u32, memory: &mut Memory) -> Option<()> {
    let Memory { depth, corners, bin_storage, edge_bin_storage, strip, .. } = memory;
    let transformed = instance.transform_depth(corners);
    let mut faces = transformed.bin_faces(bin_storage).ok()?;
    let mut edges = transformed.bin_edges(edge_bin_storage).ok()?;
    let strip = strip_of(strip, size, rows)?;
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        faces.depth_only(&mut depth);
        let Ok(()) = edges.hidden_line(LINE, &mut depth, &mut band);
        black_box(band.bytes());
    }
    black_box(edges.statistics());
    Some(())
}

fn shaded_bands<S: SpanShader<Rgb565>>(
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> S,
    size: Size,
    rows: u32,
    memory: &mut Memory,
) -> Option<()> {
    let Memory { depth, corners, bin_storage, strip, .. } = memory;
    let mut faces = instance.transform_depth(corners).bin_faces(bin_storage).ok()?;
    let strip = strip_of(strip, size, rows)?;
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        let Ok(()) = faces.depth_tested(&shade, &mut depth, &mut band.pixels());
        black_box(band.bytes());
    }
    black_box(faces.statistics());
    Some(())
}

fn plain_bands(
    instance: &MeshInstance<'_>,
    light: &Lambert,
    size: Size,
    rows: u32,
    memory: &mut Memory,
) -> Option<()> {
    let Memory { corners, bin_storage, strip, .. } = memory;
    let mut faces = instance.transform(corners).bin_faces(bin_storage).ok()?;
    let strip = strip_of(strip, size, rows)?;
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let Ok(()) = faces.solid(flat_of_normals(instance.mesh().normals(), light), &mut band.pixels());
        black_box(band.bytes());
    }
    black_box(faces.statistics());
    Some(())
}

fn painted<const V: usize, const F: usize>(
    instance: &MeshInstance<'_>,
    light: &Lambert,
    size: Size,
    pixels: &mut [Rgb565],
    painter: &mut Painter<Rgb565, V, F>,
) -> Option<()> {
    let mut picture = Picture::new(pixels, size).ok()?;
    let Ok(()) = picture.clear(BACKGROUND);
    painter.add(instance, flat_of_normals(instance.mesh().normals(), light)).ok()?;
    let Ok(statistics) = painter.draw(&mut picture.pixels());
    black_box(statistics);
    Some(())
}

fn painted_bands<const V: usize, const F: usize>(
    instance: &MeshInstance<'_>,
    light: &Lambert,
    size: Size,
    strip: &mut [u8],
    painter: &mut Painter<Rgb565, V, F>,
) -> Option<()> {
    painter.clear();
    painter.add(instance, flat_of_normals(instance.mesh().normals(), light)).ok()?;
    let order = painter.order();
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), BACKGROUND);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let Ok(()) = order.draw(&mut band.pixels());
        black_box(band.bytes());
    }
    black_box(order.statistics());
    painter.clear();
    Some(())
}
