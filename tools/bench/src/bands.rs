//! Whole frames in bands: faces or edges are binned once, then drawn band by band.

use crate::measure::Display;
use crate::scene::{area, Scene, BACKGROUND, SIZE};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    color::Color,
    draw::{ActiveFace, BinnedEdges},
    prelude::*,
    shading::SpanShader,
};

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
    mut draw: impl FnMut(&mut BinnedEdges<'_>, &mut Band<'_, Rgb565>),
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

/// Draws faces without depth, and hands each band to `send`.
pub fn solid<S: SpanShader<Rgb565>>(
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> S,
    size: Size,
    Storage { corners, bin_storage, strip, .. }: Storage<'_>,
    mut send: impl FnMut(&Band<'_, Rgb565>),
) -> Option<()> {
    let mut faces = instance.transform(corners).bin_faces(bin_storage).ok()?;
    each_band(size, BACKGROUND, strip, |band| {
        let Ok(()) = faces.draw(&shade, &mut band.pixels());
        send(band);
        Some(())
    })?;
    black_box(faces.statistics());
    Some(())
}

/// Draws faces with depth, and hands each band to `send`.
pub fn depth<S: SpanShader<Rgb565>>(
    instance: &MeshInstance<'_>,
    shade: impl Fn(usize) -> S,
    size: Size,
    Storage { corners, bin_storage, strip, depth }: Storage<'_>,
    mut send: impl FnMut(&Band<'_, Rgb565>),
) -> Option<()> {
    let mut faces = instance.transform_depth(corners).bin_faces(bin_storage).ok()?;
    each_band(size, BACKGROUND, strip, |band| {
        let mut depth = DepthBuffer::new(band.area(), depth).ok()?;
        let Ok(()) = faces.draw(&shade, &mut band.pixels().depth_tested(&mut depth));
        send(band);
        Some(())
    })?;
    black_box(faces.statistics());
    Some(())
}

/// A frame of a lit scene.
pub type LitFrame = fn(&Scene, &Lambert, Storage<'_>, &mut Display) -> Option<()>;

/// Defines a frame of a lit scene, with a list of active faces or without one.
macro_rules! lit {
    ($name:ident($($list:ident: $entry:ty)?), $transform:ident, $bin:ident, |$band:ident $(, $depth:ident)?| $target:expr) => {
        pub fn $name(
            scene: &Scene,
            light: &Lambert,
            Storage { corners, bin_storage, strip, depth: _depths }: Storage<'_>,
            $($list: &mut [$entry],)?
            display: &mut Display,
        ) -> Option<()> {
            let instance = scene.place();
            let mut faces = instance.$transform(corners).$bin(bin_storage $(, $list)?).ok()?;
            each_band(area().size, BACKGROUND, strip, |$band| {
                $(let mut $depth = DepthBuffer::new($band.area(), _depths).ok()?;)?
                let Ok(()) = faces.draw(scene.shade(light), $target);
                display.take_bytes($band.bytes());
                Some(())
            })?;
            black_box(faces.statistics());
            Some(())
        }
    };
}

lit!(lit_solid(), transform, bin_faces, |band| &mut band.pixels());
lit!(lit_depth(), transform_depth, bin_faces, |band, depth| &mut band.pixels().depth_tested(&mut depth));
lit!(lit_active(list: ActiveFace<Rgb565>), transform, bin_active_faces, |band| &mut band.pixels());
lit!(lit_active_depth(list: ActiveFace<Rgb565, 3>), transform_depth, bin_active_faces, |band, depth| {
    &mut band.pixels().depth_tested(&mut depth)
});
