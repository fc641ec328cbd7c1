//! A scene on every kind of target, in one piece, in parts and in bands: all must be equal.

use super::scene::input::Scene;
use core::fmt::Debug;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    color::{StoredPixel, Unmixed},
    prelude::*,
    shading::{SpanShader, Translucent},
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

    /// What each face draws alone, and how often it covers each pixel.
    pub(crate) fn alone<S: SpanShader<C>>(
        &self,
        scene: &Scene,
        shade: impl Fn(usize) -> S,
    ) -> Vec<[Drawn<C>; 2]> {
        let more = |_: C, stored: C| C::from_bits((stored.to_bits() + 1).min(2));
        let (none, count) = (C::from_bits(0), Translucent::new(C::from_bits(0), more));
        let alone = |face| {
            scene.with_instance(&scene.faces[face..=face], &[], |instance| {
                let own = ways::in_memory(instance, self.area, self.sky, &|_| shade(face));
                [own, ways::in_memory(instance, self.area, none, &|_| count)]
            })
        };
        (0..scene.faces.len()).map(alone).collect()
    }

    /// Compares the pictures of all faces with what each draws [`alone`](Self::alone), face over face without depth, and with depth where it is
    /// nearer. `mix` makes the pixel of a number of the face's colour and the one before it, and says whether the face stores its depth; or
    /// leaves the pixel as it was.
    ///
    /// Rounding may fold the fan of a face that is cut to a sliver. Which colours a pixel shows that it covers twice, the face alone does not
    /// tell: such pixels are not compared.
    pub(crate) fn compare(
        &self,
        drawn: &Drawn<C>,
        alone: &[[Drawn<C>; 2]],
        mix: impl Fn(usize, C, C) -> Option<(C, bool)>,
        what: &dyn Debug,
    ) {
        let (mut solid, mut deep) = (vec![self.sky; drawn.solid.len()], vec![self.sky; drawn.solid.len()]);
        let mut depths = vec![DepthBuffer::NOTHING; solid.len()];
        for i in 0..solid.len() {
            for [own, _] in alone {
                if own.solid[i] != self.sky {
                    solid[i] = mix(i, own.solid[i], solid[i]).map_or(solid[i], |(color, _)| color);
                }
                let is_nearer = own.deep[i] != self.sky && own.depths[i] < depths[i];
                if let Some((color, stores)) = is_nearer.then(|| mix(i, own.deep[i], deep[i])).flatten() {
                    (deep[i], depths[i]) = (color, if stores { own.depths[i] } else { depths[i] });
                }
            }
            let is_folded = |[_, count]: &[Drawn<C>; 2]| {
                [count.solid[i], count.deep[i]].iter().any(|count| count.to_bits() > 1)
            };
            if alone.iter().any(is_folded) {
                (solid[i], deep[i], depths[i]) = (drawn.solid[i], drawn.deep[i], drawn.depths[i]);
            }
        }
        assert!(drawn.solid == solid, "{what:?}");
        assert!(drawn.deep == deep && drawn.depths == depths, "with depth: {what:?}");
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
