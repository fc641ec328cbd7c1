//! Faces and sprites in fog.

use super::levels::{FogLevel, FogLevels, LevelRuns};
use super::table::{FogTable, LEVELS};
use crate::color::{Color, InkKind, Mixer};
use crate::raster::{Gradient, Span, Triangle};
use crate::shading::shader::{inner_with_corners, DepthLevels, FastPath};
use crate::shading::{CornerValues, Shader, SpanShader};
use core::cell::Cell;
use embedded_graphics_core::pixelcolor::PixelColor;

/// A shader in fog: its colours are mixed with the fog's colour by the depth of each pixel. It wraps any shader (colours, smooth,
/// lit, textured and translucent faces, with colour keys and screen doors), in any draw call, into every target whose colours can
/// be [mixed](Color).
///
/// A face without fog is drawn by the wrapped shader alone. A face of one colour whose pixels have one level of fog is filled
/// with one colour. A face of one colour in several levels, on a target whose pixels lie in memory, is filled level by level: a
/// colour is mixed only where the level changes. For all other faces, each pixel is mixed; a texture that repeats is drawn there by runs of
/// one level.
///
/// **Draw calls** in one piece transform vertices with depth and clip at the far plane. In bands, bin faces of
/// [`transform_depth`](crate::draw::MeshInstance::transform_depth); of `transform`, `cargo build` stops (`cargo check` does not). [`fill_triangle`](crate::draw::fill_triangle) has no depth,
/// and stops the build, too.
///
/// **Sprites.** It wraps the picture of a [`Sprite`](crate::sprite::Sprite), too, such as a tree: `Sprite::new(Fogged::new(picture, &table))`. All
/// pixels of a sprite have the level of its point, by its depth as [`FogTable::factor`] takes it.
///
/// **Order of wrappers.** `ScreenDoor` and `Translucent` may be inside or outside: fog changes a shader's own colours before they are mixed with
/// the stored pixels.
///
/// **Error.** A pixel's factor is the factor at the exact distance of a point within 1/256 pixel and 1/64 step of depth from it,
/// rounded to the nearest 1/32; in the last step before the far plane within 0.54 step, since depth ends at 65534.46. For
/// triangles larger than 512 pixels no more than 1/64 step has been seen, and ¼ is proved. Each channel is then rounded to the
/// nearest level of the target. [`FogTable`] says what a step of depth is in distance. If all three
/// corners fall into the same fog level, the whole triangle is filled with that level.
///
/// ```
/// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
/// use pinhole::{fog::{Fog, FogTable}, prelude::*, Angle};
/// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(9), Angle::ZERO, Angle::degrees(27));
/// let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(100))?;
/// let camera = Camera::new(&view, &lens, &viewport);
/// const FLOOR: [[i16; 3]; 4] = [[-90, 0, 0], [90, 0, 0], [90, 0, -90], [-90, 0, -90]];
/// let mesh = Mesh::new(&FLOOR, 0, &[[0, 1, 2], [0, 2, 3]])?;
/// let instance = camera.place(&mesh, &Affine::identity());
/// let fog = Fog::new(Scalar::from_int(10), Scalar::from_int(40))?;
/// let table = FogTable::new(&fog, &camera, Rgb565::WHITE)?;
/// let mut pixels = [Rgb565::BLACK; 64 * 64];
/// let mut picture = Picture::new(&mut pixels, Size::new(64, 64))?;
/// instance.faces(|_face| Fogged::new(Rgb565::RED, &table)).draw(&mut picture.pixels())?;
/// let greens: std::collections::BTreeSet<_> = pixels.iter().filter(|c| c.r() == 31).map(|c| c.g()).collect();
/// assert!(greens.len() > 12); // from red to white
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Fogged<'t, S, C> {
    pub(in crate::shading) shader: S,
    table: &'t FogTable<C>,
    /// At the corners, in 16.8.
    depths: [i32; 3],
    /// The least and the highest level at a corner: 0 … 32.
    levels: [u8; 2],
}

impl<'t, S, C> Fogged<'t, S, C> {
    /// A shader in the fog of a table.
    pub const fn new(shader: S, table: &'t FogTable<C>) -> Self {
        Self { shader, table, depths: [0; 3], levels: [0; 2] } // until a draw call knows the depths
    }

    /// Sets the level to that of a depth, 0 … 65535, and returns the wrapped picture.
    pub(in crate::shading) fn set_level_of(&mut self, depth: u16) -> &mut S {
        self.levels = [LEVELS as u8 - self.table.factor(depth); 2];
        &mut self.shader
    }

    /// The only level of the triangle, if its corners have one.
    #[inline(always)]
    fn level(&self) -> Option<u8> {
        let [least, most] = self.levels;
        (least == most).then_some(least)
    }
}

impl<S, C: Color> Fogged<'_, S, C> {
    /// A colour in the lowest level.
    #[inline(always)]
    pub(in crate::shading) fn in_nearest_level(&self, color: C) -> C {
        let [least, _] = self.levels;
        mixed(color, self.table.color, least)
    }
}

impl<S: Shader, C: PixelColor> Shader for Fogged<'_, S, C> {
    type Varying = S::Varying;
    const NEEDS_DEPTH: bool = true;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self { shader: self.shader.sub_face(corners), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        let shader = inner_with_corners(&self.shader, corners);
        let depths @ [a, b, c] = corners.depths();
        // 16.8, 24 bits: as a value at a pixel, 16.16.
        let at_pixel = |depth: i32| ((depth as u32) << 8).saturating_add(Gradient::DEPTH_BIAS);
        let (least, most) = (at_pixel(a.min(b).min(c)), at_pixel(a.max(b).max(c)));
        // Most triangles have few levels: the highest is searched from the lowest on.
        let least = FogLevel::new(self.table.level(least), &self.table.bounds);
        let levels = [least.level(), least.at(most, &self.table.bounds).level()];
        Self { shader, depths, levels, ..*self }
    }
}

// The fog's colour is not printed: it need not implement `Format`.
defmt_format!(
    [S: defmt::Format, C] Fogged<'_, S, C>, self,
    "{} in levels {} of fog", self.shader, self.levels
);

/// A [`Fogged`] shader set up for a triangle.
#[derive(Debug)]
pub struct FoggedSetup<'t, P, C> {
    own: P,
    table: &'t FogTable<C>,
    depth: Gradient,
    /// The level where the last search ended: the next one begins there.
    level: Cell<FogLevel>,
}

impl<'t, P, C: Color> FoggedSetup<'t, P, C> {
    /// The level of each pixel from `x` on.
    #[inline(always)]
    fn levels(&self, x: i32, y: i32) -> FogLevels<'t> {
        let (bounds, depth) = (&self.table.bounds, self.depth.at(x, y));
        let level = self.level.get().at(depth, bounds);
        self.level.set(level);
        FogLevels { bounds, level, depth, step: self.depth.step() }
    }

    /// A colour in a level of fog.
    #[inline(always)]
    fn mixed(&self, color: C, level: u8) -> C {
        mixed(color, self.table.color, level)
    }
}

/// A colour in a level of fog.
#[inline(always)]
fn mixed<C: Color>(color: C, fog: C, level: u8) -> C {
    color.mix(fog, LEVELS as u8 - level)
}

impl<'t, C: Color, S: SpanShader<C>> SpanShader<C> for Fogged<'t, S, C> {
    type Ink = S::Ink;
    type Setup = FoggedSetup<'t, S::Setup, C>;
    type FastPath = Self;
    const WRITES_DEPTH: bool = S::WRITES_DEPTH;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        let depth = match self.level() {
            // The depth at which the level begins, everywhere.
            Some(level) => {
                let origin = self.table.bounds.get(usize::from(level)).copied().unwrap_or_default();
                Gradient { origin, ..Gradient::default() }
            }
            None => Gradient::of_depth(triangle, &self.depths),
        };
        let [least, _] = self.levels;
        let level = Cell::new(FogLevel::new(least, &self.table.bounds));
        FoggedSetup { own: self.shader.set_up(triangle), table: self.table, depth, level }
    }

    #[inline(always)]
    fn span(setup: &Self::Setup, span: Span) -> impl Iterator<Item = S::Ink> {
        S::span(&setup.own, span)
            .zip(setup.levels(span.x, span.y))
            .map(move |(ink, level)| ink.map(|color| setup.mixed(color, level)))
    }

    #[inline(always)]
    fn solid(&self) -> Option<S::Ink> {
        let level = self.level()?;
        Some(self.shader.solid()?.map(|color| mixed(color, self.table.color, level)))
    }
}

impl<'t, C: Color, S: SpanShader<C>> FastPath<C, Self> for Fogged<'t, S, C> {
    #[inline(always)]
    fn runs(
        setup: &FoggedSetup<'t, S::Setup, C>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Ink>)> {
        let mut x = span.x;
        S::FastPath::runs(&setup.own, span).map(move |(width, inks)| {
            let levels = setup.levels(x, span.y);
            x = x.wrapping_add(width);
            (width, inks.zip(levels).map(move |(ink, level)| ink.map(|color| setup.mixed(color, level))))
        })
    }

    #[inline(always)]
    fn look_up(setup: &FoggedSetup<'t, S::Setup, C>) -> Option<impl Fn([u32; 2]) -> S::Ink + Copy> {
        let own = S::FastPath::look_up(&setup.own).filter(|_| S::FastPath::ONE_NUMBER)?;
        let mix = setup.table.color.run_mixer();
        Some(move |[number, share]: [u32; 2]| own([number, 0]).map(|color| mix(color, share)))
    }

    #[inline(always)]
    fn lines(setup: &FoggedSetup<'t, S::Setup, C>, span: Span) -> impl Iterator<Item = (i32, [[u32; 2]; 2])> {
        let (depth, step) = (setup.depth.at(span.x, span.y), setup.depth.step());
        let levels = LevelRuns { bounds: &setup.table.bounds, level: &setup.level, depth, step };
        FogLines {
            lines: S::FastPath::lines(&setup.own, span),
            width: 0,
            line: [0; 2],
            levels,
            bits: C::SHARE_BITS,
        }
    }

    #[inline(always)]
    fn levels(shader: &Self) -> Option<DepthLevels<'_, impl Fn(u8) -> C + Copy>> {
        let own = shader.shader.solid().and_then(InkKind::own)?;
        let ([first, _], fade) = (shader.levels, own.fade(shader.table.color));
        let color = move |level| fade(LEVELS as u8 - level);
        Some(DepthLevels { depths: shader.depths, bounds: &shader.table.bounds, first, color })
    }

    #[inline(always)]
    fn inner(shader: &Self) -> Option<&impl SpanShader<C, Ink = S::Ink>> {
        match shader.levels {
            [_, 0] => Some(&shader.shader),
            _ => None,
        }
    }
}

/// The lines of a shader that takes [one number](FastPath::ONE_NUMBER), cut where the level of fog changes. The second number is the
/// share of the shader's own colour, in 2^−`bits`.
struct FogLines<'s, R> {
    lines: R,
    /// The rest of the current line: its width in pixels, its number at the next pixel, and the change of the number from pixel to pixel.
    width: i32,
    line: [u32; 2],
    levels: LevelRuns<'s>,
    bits: u32,
}

impl<R: Iterator<Item = (i32, [[u32; 2]; 2])>> Iterator for FogLines<'_, R> {
    type Item = (i32, [[u32; 2]; 2]);

    #[inline(always)]
    fn next(&mut self) -> Option<(i32, [[u32; 2]; 2])> {
        if self.width <= 0 {
            let (width, [[at, _], [step, _]]) = self.lines.next()?;
            (self.width, self.line) = (width, [at, step]);
        }
        let ((width, level), [at, step]) = (self.levels.next_run(self.width), self.line);
        (self.width, self.line) =
            (self.width - width, [at.wrapping_add(step.wrapping_mul(width as u32)), step]);
        let share = (LEVELS as u32 - level) << (self.bits - 5);
        Some((width, [[at, share], [step, 0]]))
    }
}
