//! Draws the sprites of a scene after its faces or edges, band by band.

use crate::bands::{around, in_memory, Colour};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::sprites::{Anchor, SceneSprites, SpriteSize};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    color::Alpha,
    draw::SpriteFor,
    fog::FogTable,
    prelude::*,
    shading::Translucent,
    sprite::{PlacedSprites, SpriteSource},
};
use std::convert::Infallible;
use std::rc::Rc;

/// The sprites of a frame: those that are stored, in the scene's order, then those that are mixed with what is behind them, from
/// far to near.
pub(crate) struct Sprites<'t, C> {
    stored: Vec<Placed<Texture<'t, C>>>,
    mixed: Vec<Placed<Translucent<Texture<'t, C>, Alpha>>>,
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
}

impl<C: Colour> SpriteSource for Texels<C> {
    type Color = C;
    type Ink = Option<C>;

    fn picture_size(&self) -> Size {
        self.size
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<C> {
        self.texels.get((row * self.size.width + column) as usize).copied().flatten()
    }
}

/// The picture of a sprite, in fog if the scene has any.
#[derive(Clone)]
enum Texture<'t, C> {
    Clear(Texels<C>),
    InFog(Fogged<'t, Texels<C>, C>),
}

impl<C: Colour> SpriteSource for Texture<'_, C> {
    type Color = C;
    type Ink = Option<C>;

    fn picture_size(&self) -> Size {
        match self {
            Self::Clear(texels) => texels.picture_size(),
            Self::InFog(texels) => texels.picture_size(),
        }
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<C> {
        match self {
            Self::Clear(texels) => texels.texel_at(column, row),
            Self::InFog(texels) => texels.texel_at(column, row),
        }
    }

    fn set_depth(&mut self, depth: u16) {
        match self {
            Self::Clear(texels) => texels.set_depth(depth),
            Self::InFog(texels) => texels.set_depth(depth),
        }
    }
}

impl<'t, C: Colour> Sprites<'t, C> {
    /// The sprites of a scene, in its fog if there is any.
    pub(crate) fn new(
        scene: &Scene,
        quantised: &Quantised,
        fog: Option<&'t FogTable<C>>,
    ) -> Result<Self, String> {
        let (mut stored, mut mixed) = (Vec::new(), Vec::new());
        let (mut bounds, mut statistics) = (Vec::new(), Statistics::default());
        // A target without pixels, where drawing only counts.
        let mut nowhere = Picture::<C>::new(&mut [], Size::zero()).map_err(|e| e.to_string())?;
        for entry in &scene.sprites {
            let ([width, height], texels) = entry.texels();
            let colours = texels.iter().map(|texel| texel.map(|[r, g, b]| Rgb888::new(r, g, b).into()));
            let (size, texels) = (Size::new(width, height), colours.collect::<Rc<[_]>>());
            let depth_tested = entry.depth_tested;
            let camera = quantised.camera().with_far_clip(depth_tested);
            for &point in &entry.points {
                let picture = || {
                    let texels = Texels { size, texels: texels.clone() };
                    match fog {
                        None => Texture::Clear(texels),
                        Some(fog) => Texture::InFog(Fogged::new(texels, fog)),
                    }
                };
                let at = camera.place_sprite(quantised.point(point));
                let sprite = sized(entry, picture(), quantised);
                bounds.push(at.bounds(|_| sprite.clone()));
                let Ok(drawn) = at.draw(|_| sprite.clone(), &mut nowhere);
                statistics = statistics + drawn;
                match entry.alpha {
                    None => stored.push(Placed { at, sprite, depth_tested }),
                    Some(of_32) => {
                        let sprite = sized(entry, Translucent::new(picture(), Alpha::new(of_32)), quantised);
                        mixed.push((scene.depth(point), Placed { at, sprite, depth_tested }));
                    }
                }
            }
        }
        mixed.sort_by(|(a, _), (b, _)| b.total_cmp(a)); // far ones first
        let mixed = mixed.into_iter().map(|(_, placed)| placed).collect();
        Ok(Self { stored, mixed, bounds: around(bounds.into_iter()), statistics })
    }

    /// Draws the sprites into a band with the depths of what is drawn there.
    pub(crate) fn draw(&self, band: &mut Band<'_, C>, depth: &mut DepthBuffer<'_>) {
        self.stored.iter().for_each(|placed| placed.draw(depth, band));
        if !self.mixed.is_empty() {
            in_memory(band, |pixels| self.mixed.iter().for_each(|placed| placed.draw(depth, pixels)));
        }
    }
}

impl<S: Clone> Placed<S> {
    fn draw<T: Surface<Error = Infallible>>(&self, depth: &mut DepthBuffer<'_>, target: &mut T)
    where
        S: SpriteFor<T>,
    {
        let sprite = |_| self.sprite.clone();
        let Ok(_) = match self.depth_tested {
            true => self.at.draw(sprite, &mut target.depth_tested(depth)),
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
