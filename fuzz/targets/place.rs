//! A scene on every kind of target, in one piece, in parts and in bands: all must be equal.

use core::fmt::Debug;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    color::{StoredPixel, Unmixed},
    prelude::*,
    shading::SpanShader,
};
use support::bridge::ways::{self, Drawn};

/// Draws binned faces with depth into a band.
type DrawDeep<'f, C> = &'f mut dyn FnMut(&mut BinnedFaces<'_>, &mut DepthBuffer<'_>, &mut Band<'_, C>);

/// Where scenes are drawn, before which colour, and in bands of how many rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<C> {
    pub(crate) area: Rectangle,
    pub(crate) sky: C,
    pub(crate) rows: u32,
}

impl<C: Color + Debug> Place<C> {
    /// Into memory, as shaders need it that look at what is there.
    pub(crate) fn in_memory<const N: usize, S: SpanShader<C>>(
        &self,
        instance: &MeshInstance<'_>,
        shade: &dyn Fn(usize) -> S,
    ) -> Drawn<C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let drawn = ways::in_memory(instance, self.area, self.sky, shade);
        let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
        let mut bins = vec![0; instance.mesh().face_bins_len()];
        let mut faces = instance.transform(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = ways::bands(self.area, self.sky, self.rows, &mut |band, _| {
            let Ok(()) = faces.draw(shade, &mut band.pixels());
        });
        assert!(banded == drawn.solid, "bands of {} rows", self.rows);
        self.deep_bands(instance, &drawn, &mut |faces, depth, band| {
            let Ok(()) = faces.draw(shade, &mut band.pixels().depth_tested(depth));
        });
        drawn
    }

    /// Into memory and onto DrawTargets.
    pub(crate) fn everywhere<const N: usize, S: SpanShader<C, Ink: Unmixed<C>>>(
        &self,
        instance: &MeshInstance<'_>,
        shade: &dyn Fn(usize) -> S,
    ) -> Drawn<C>
    where
        C: StoredPixel<[u8; N]>,
    {
        let drawn = self.in_memory(instance, shade);
        assert!(drawn == ways::everywhere(instance, self.area, self.sky, shade));
        self.deep_bands(instance, &drawn, &mut |faces, depth, band| {
            faces.draw(shade, &mut band.depth_tested(depth)).expect("a band refuses nothing");
        });
        drawn
    }

    /// Bands with depth are equal to the whole picture.
    fn deep_bands(&self, instance: &MeshInstance<'_>, drawn: &Drawn<C>, draw: DrawDeep<'_, C>) {
        let mut cache = vec![ScreenVertex::EMPTY; instance.mesh().vertices().len()];
        let mut bins = vec![0; instance.mesh().face_bins_len()];
        let mut faces = instance.transform_depth(&mut cache).bin_faces(&mut bins).expect("room");
        let banded = ways::bands(self.area, self.sky, self.rows, &mut |band, depth| {
            draw(&mut faces, depth, band);
        });
        assert!(banded == drawn.deep, "bands of {} rows, with depth", self.rows);
    }
}
