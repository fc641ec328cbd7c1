//! Whole frames in bands: faces or edges are binned once, then drawn band by band.

use crate::measure::Display;
use crate::scene::{area, Scene, BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::draw::{ActiveFace, BinnedEdges, SmoothEdge};
use pinhole::{bands::SmoothFrame, color::Color, prelude::*, shading::SpanShader};

/// Bytes of the colour strip, for bands of `rows` rows.
pub const fn bytes(rows: u32) -> usize {
    Frame::<Rgb565>::strip_bytes(SIZE, rows)
}
/// Pixels of the depth strip, for bands of `rows` rows.
pub const fn pixels(rows: u32) -> usize {
    (SIZE * rows) as usize
}

/// Buffers that the caller provides for a frame in bands. The strips' lengths determine the rows of a band.
pub struct Storage<'s> {
    pub corners: &'s mut [ScreenVertex],
    pub bin_storage: &'s mut [u16],
    pub strip: &'s mut [u8],
    pub depth: &'s mut [u16],
}

/// Hands each band of a picture to `draw`.
pub fn each_band<C: Color>(
    size: Size,
    background: C,
    strip: &mut [u8],
    mut draw: impl FnMut(&mut Band<'_, C>) -> Option<()>,
) -> Option<()> {
    let mut frame = Frame::new(Rectangle::new(Point::zero(), size), background);
    while let Some(mut band) = frame.next_band(strip).ok()? {
        draw(&mut band)?;
    }
    Some(())
}

/// Draws edges, and hands each band to `send`.
pub fn wireframe(
    instance: &MeshInstance<'_>,
    size: Size,
    Storage { corners, bin_storage, strip, .. }: Storage<'_>,
    mut draw: impl FnMut(&mut BinnedEdges<'_, i16, false>, &mut Band<'_, Rgb565>),
) -> Option<()> {
    let mut edges = instance.transform(corners).bin_edges(bin_storage).ok()?;
    each_band(size, BACKGROUND, strip, |band| {
        draw(&mut edges, band);
        Some(())
    })?;
    black_box(edges.statistics());
    Some(())
}

/// Draws the edges that no face hides into each band, as into any target, and hands it to `send`.
pub fn hidden<C: Color>(
    instance: &MeshInstance<'_>,
    [stroke, background]: [C; 2],
    size: Size,
    edge_bins: &mut [u16],
    Storage { corners, bin_storage, strip, depth }: Storage<'_>,
    mut send: impl FnMut(&Band<'_, C>),
) -> Option<()> {
    let transformed = instance.transform_depth(corners);
    let mut faces = transformed.bin_faces(bin_storage).ok()?;
    let mut edges = transformed.bin_edges(edge_bins).ok()?;
    each_band(size, background, strip, |band| {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        faces.depth_only(&mut depth);
        let Ok(()) = edges.hidden_line(stroke, &mut band.depth_tested(&mut depth));
        send(band);
        Some(())
    })?;
    black_box(edges.statistics());
    Some(())
}

/// What smooth edges take beside it: the rows that wait, bins, and entries for edges that are set up.
pub struct EdgeStorage<'s> {
    pub kept: &'s mut [u8],
    pub bins: &'s mut [u16],
    pub list: &'s mut [SmoothEdge],
}

/// Draws faces in bands, smooths their silhouettes and the edges that are creases, and hands each band to `send`.
pub fn smooth(
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> Rgb565,
    is_crease: impl FnMut(usize) -> bool,
    size: Size,
    Storage { corners, bin_storage, strip, depth }: Storage<'_>,
    EdgeStorage { kept, bins, list }: EdgeStorage<'_>,
    mut send: impl FnMut(&Band<'_, Rgb565>),
) -> Option<()> {
    let transformed = instance.transform_depth(corners);
    let mut faces = transformed.bin_faces(bin_storage).ok()?;
    let mut edges = transformed.bin_smooth_edges(is_crease, bins).ok()?;
    edges.keep_in(list);
    let area = Rectangle::new(Point::zero(), size);
    let mut frame = SmoothFrame::new(area, BACKGROUND, kept, depth).ok()?;
    while let Some(mut band) = frame.next_band(strip).ok()? {
        let (mut pixels, mut depth) = band.new_rows();
        let Ok(()) = faces.draw(&shade, &mut pixels.depth_tested(&mut depth));
        send(&band.smooth(|pass| edges.draw(pass)));
    }
    black_box(faces.statistics());
    Some(())
}

/// [`smooth`] for a lit scene, perhaps with the creases at which colours differ.
pub fn lit_smooth(
    scene: &Scene,
    light: &Lambert,
    to: Storage<'_>,
    edges: EdgeStorage<'_>,
    has_creases: bool,
    display: &mut Display,
) -> Option<()> {
    let (instance, shade) = (scene.place(), scene.shade(light));
    let is_crease = |edge| has_creases && contrasts(edge, instance.mesh(), &shade);
    let send = |band: &Band<'_, Rgb565>| display.take_bytes(band.bytes());
    smooth(&instance, &shade, is_crease, area().size, to, edges, send)
}

/// Whether the faces beside an edge differ by two levels of a channel of five bits.
#[inline(never)]
fn contrasts(edge: usize, mesh: &Mesh<'_>, shade: impl Fn(usize) -> Rgb565) -> bool {
    let Some(&faces) = mesh.edge_faces().get(edge) else { return true };
    let [one, other] = faces.map(|face| shade(face.into()));
    let [r, g, b] =
        [RgbColor::r, RgbColor::g, RgbColor::b].map(|channel| channel(&one).abs_diff(channel(&other)));
    r >= 2 || g >= 4 || b >= 2
}

/// Draws the faces of a lit scene of twice the picture's width and height in bands, and puts the mean of each four pixels into `means`.
pub fn sampled(
    scene: &Scene,
    light: &Lambert,
    Storage { corners, bin_storage, strip, depth }: Storage<'_>,
    means: &mut [u8],
    display: &mut Display,
) -> Option<()> {
    let (instance, shade) = (scene.place(), scene.shade(light));
    let mut faces = instance.transform_depth(corners).bin_faces(bin_storage).ok()?;
    each_band(area().size * 2, BACKGROUND, strip, |band| {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        let Ok(()) = faces.draw(&shade, &mut band.pixels().depth_tested(&mut depth));
        let row = bytes(2);
        let rows = band.bytes().chunks_exact(2 * row).zip(means.chunks_exact_mut(bytes(1)));
        for (rows, means) in rows {
            let (upper, lower) = rows.split_at_checked(row)?;
            let samples = upper.as_chunks().0.iter().zip(lower.as_chunks().0);
            for (mean, samples) in means.as_chunks_mut().0.iter_mut().zip(samples) {
                *mean = mean_of(samples).to_be_bytes();
            }
        }
        display.take_bytes(means.get(..band.bytes().len() / 4)?);
        Some(())
    })?;
    black_box(faces.statistics());
    Some(())
}

/// The mean of two pixels above two others, as in the book's cookbook.
fn mean_of((&[a, b, c, d], &[e, f, g, h]): (&[u8; 4], &[u8; 4])) -> u16 {
    const APART: u32 = 0x07e0_f81f;
    let sum = [[a, b], [c, d], [e, f], [g, h]].iter().fold(0x0040_1002, |sum, &bytes| {
        let bits = u32::from(u16::from_be_bytes(bytes));
        sum + ((bits | bits << 16) & APART)
    });
    let mean = (sum >> 2) & APART;
    (mean | mean >> 16) as u16
}

/// Defines two functions that draw faces in bands, with a list of active faces or without one: any faces, with each band handed to
/// `send`, and those of a lit scene.
macro_rules! faces {
    ($name:ident, $lit:ident ($($list:ident: $entry:ty)?), $transform:ident, |$band:ident $(, $depth:ident)?| $target:expr) => {
        pub fn $name<S: SpanShader<Rgb565>>(
            instance: &MeshInstance<'_>,
            shade: impl Fn(usize) -> S,
            size: Size,
            Storage { corners, bin_storage, strip, depth: _depths }: Storage<'_>,
            $($list: &mut [$entry],)?
            mut send: impl FnMut(&Band<'_, Rgb565>),
        ) -> Option<()> {
            let mut faces = instance.$transform(corners).bin_faces(bin_storage).ok()?$(.with_active_faces($list))?;
            each_band(size, BACKGROUND, strip, |$band| {
                $(let mut $depth = DepthBuffer::new($band.area(), _depths).ok()?;)?
                let Ok(()) = faces.draw(&shade, $target);
                send($band);
                Some(())
            })?;
            black_box(faces.statistics());
            Some(())
        }

        pub fn $lit(
            scene: &Scene, light: &Lambert, to: Storage<'_>, $($list: &mut [$entry],)? display: &mut Display
        ) -> Option<()> {
            let send = |band: &Band<'_, Rgb565>| display.take_bytes(band.bytes());
            $name(&scene.place(), scene.shade(light), area().size, to, $($list,)? send)
        }
    };
}

faces!(solid, lit_solid(), transform, |band| &mut band.pixels());
faces!(depth, lit_depth(), transform_depth, |band, depth| &mut band.pixels().depth_tested(&mut depth));
faces!(active, lit_active(list: ActiveFace<Rgb565, 0>), transform, |band| &mut band.pixels());
faces!(active_depth, lit_active_depth(list: ActiveFace<Rgb565>), transform_depth, |band, depth| {
    &mut band.pixels().depth_tested(&mut depth)
});

/// A frame of a lit scene with a list of active faces.
pub type ActiveFrame<const WORDS: usize> =
    fn(&Scene, &Lambert, Storage<'_>, &mut [ActiveFace<Rgb565, WORDS>], &mut Display) -> Option<()>;
