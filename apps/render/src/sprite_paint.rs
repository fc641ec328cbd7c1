//! Draws the sprites of a scene after its faces or edges, band by band.

use crate::fog::FogStyle;
use crate::paint::{in_memory, Colour};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::sprites::{Anchor, SceneSprites, SpriteSize};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{Band, Blended, DepthBuffer, PlacedSprites, Sprite, SpriteSource, Statistics, Target};
use std::convert::Infallible;
use std::marker::PhantomData;
use std::rc::Rc;

/// The sprites of a frame: those that are stored, in the scene's order, then those that are mixed with what is behind them, from
/// far to near.
pub(crate) struct Sprites<C> {
    stored: Vec<Placed<Texels<C>>>,
    mixed: Vec<Placed<Blended<Texels<C>>>>,
    /// The area that they cover.
    pub(crate) bounds: Rectangle,
    pub(crate) statistics: Statistics,
}

struct Placed<S> {
    at: PlacedSprites<'static>,
    sprite: Sprite<S>,
    depth_tested: bool,
}

/// The texels of a sprite in a display's colours.
#[derive(Clone)]
struct Texels<C> {
    size: Size,
    texels: Rc<[Option<C>]>,
    /// The colour of fog, and 32nds of the sprite's own colour.
    fog: Option<(C, u8)>,
}

impl<C: Colour> SpriteSource for Texels<C> {
    type Color = C;

    fn picture_size(&self) -> Size {
        self.size
    }

    fn color_at(&self, column: u32, row: u32) -> Option<C> {
        let own = self.texels.get((row * self.size.width + column) as usize).copied().flatten()?;
        Some(self.fog.map_or(own, |(fog, of_32)| own.mix(fog, of_32)))
    }
}

impl<C: Colour> Sprites<C> {
    /// The sprites of a scene, in fog of a colour if there is any.
    pub(crate) fn new(scene: &Scene, quantised: &Quantised, fog: Option<&FogStyle>, colour: C) -> Self {
        let (mut stored, mut mixed) = (Vec::new(), Vec::new());
        let mut reach =
            Reach { size: Size::new(scene.width, scene.height), bounds: None, colour: PhantomData };
        let mut statistics = Statistics::default();
        for entry in &scene.sprites {
            let ([width, height], texels) = entry.texels();
            let colours = texels.iter().map(|texel| texel.map(|[r, g, b]| Rgb888::new(r, g, b).into()));
            let (size, texels) = (Size::new(width, height), colours.collect::<Rc<[_]>>());
            let depth_tested = entry.depth_tested;
            let camera = quantised.camera().with_far_clip(depth_tested);
            for &point in &entry.points {
                let fog = fog.map(|fog| (colour, fog.seen(scene, point)));
                let picture = || Texels { size, texels: texels.clone(), fog };
                let at = camera.place_sprite(quantised.point(point));
                let sprite = sized(entry, picture(), quantised);
                let Ok(drawn) = at.draw(|_| sprite.clone(), &mut reach);
                statistics = statistics.and(drawn);
                match entry.alpha {
                    None => stored.push(Placed { at, sprite, depth_tested }),
                    Some(of_32) => {
                        let sprite = sized(entry, Blended::new(picture(), of_32), quantised);
                        mixed.push((scene.depth(point), Placed { at, sprite, depth_tested }));
                    }
                }
            }
        }
        mixed.sort_by(|(a, _), (b, _)| b.total_cmp(a)); // far ones first
        let mixed = mixed.into_iter().map(|(_, placed)| placed).collect();
        let bounds = reach.bounds.map_or(Rectangle::zero(), |[low, high]| Rectangle::with_corners(low, high));
        Self { stored, mixed, bounds, statistics }
    }

    /// Draws the sprites into a band with the depths of what is drawn there.
    pub(crate) fn draw(&self, band: &mut Band<'_, C>, depth: &mut DepthBuffer<'_>) {
        self.stored.iter().for_each(|placed| placed.draw(depth, band));
        if !self.mixed.is_empty() {
            in_memory(band, |pixels| self.mixed.iter().for_each(|placed| placed.draw(depth, pixels)));
        }
    }
}

impl<S: SpriteSource + Clone> Placed<S> {
    fn draw<T: Target<Color = S::Color, Error = Infallible>>(
        &self,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) {
        let sprite = |_| self.sprite.clone();
        let Ok(_) = match self.depth_tested {
            true => self.at.depth_tested(sprite, depth, target),
            false => self.at.draw(sprite, target),
        };
    }
}

/// A picture with the size and the anchor of an entry.
fn sized<S: SpriteSource>(entry: &SceneSprites, picture: S, quantised: &Quantised) -> Sprite<S> {
    let sprite = match entry.anchor {
        Anchor::Named(anchor) => Sprite::new(picture).with_anchor(anchor),
        Anchor::Texel([column, row]) => Sprite::new(picture).with_anchor_at(column, row),
    };
    match entry.size {
        SpriteSize::Pixels(_) => sprite.magnified(entry.magnification().unwrap_or(1)),
        SpriteSize::World([width, height]) => {
            sprite.with_size(quantised.distance(width), quantised.distance(height))
        }
        SpriteSize::Height(height) => sprite.with_height(quantised.distance(height)),
    }
}

/// A picture that stores nothing but the first and the last column and row that are drawn.
struct Reach<C> {
    size: Size,
    bounds: Option<[Point; 2]>,
    colour: PhantomData<C>,
}

impl<C> OriginDimensions for Reach<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Reach<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let area = self.bounding_box();
        for Pixel(point, _) in pixels.into_iter().filter(|Pixel(point, _)| area.contains(*point)) {
            let [low, high] = self.bounds.unwrap_or([point; 2]);
            self.bounds = Some([low.component_min(point), high.component_max(point)]);
        }
        Ok(())
    }
}
