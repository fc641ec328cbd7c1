//! Faces that leave out pixels, or are mixed with what is behind them: screen doors, and blending by a half and by any share.
//!
//! - What a face draws alone, opaque, is mixed face by face with the pixels before it, by fractions: that is the picture.
//! - A screen door draws the pixels of low ranks in Bayer's matrix, by its recursive definition.
//! - Blended faces are depth-tested and store no depth; the pixels of a screen door store theirs.
//! - Memory and bands of any height show equal pixels, and a screen door also any DrawTarget.

use super::place::Place;
use super::scene::input::Scene;
use super::Bytes;
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use pinhole::{
    color::{Alpha, Half, Unmixed},
    prelude::*,
    shading::{SpanShader, Translucent},
    texture::{ColorKeyed, TexelSlice},
};
use support::bridge::ways::Drawn;
use support::oracle::rng::Rng;

/// Not drawn by any opaque face: their channels are below 31.
const SKY: Rgb565 = Rgb565::new(31, 63, 31);

/// The rank of a pixel in Bayer's matrix of 8 × 8, by its definition: the matrix of half the size times four, plus 0, 2, 3 and 1.
fn rank(x: i32, y: i32) -> u32 {
    let digit = |bit: i32| [[0, 2], [3, 1]][(y >> bit & 1) as usize][(x >> bit & 1) as usize];
    (0..3).fold(0, |rank, bit| 4 * rank + digit(bit))
}

#[derive(Clone, Copy, Debug)]
enum Over {
    Opaque,
    Half,
    /// In 1/32; more counts as 32.
    Share(u8),
}

impl Over {
    fn mixed(self, own: Rgb565, stored: Rgb565) -> Rgb565 {
        let mix = |own: u8, stored: u8| {
            let [own, stored] = [own, stored].map(u32::from);
            (match self {
                Self::Opaque => own,
                Self::Half => own.div_ceil(2) + stored / 2,
                Self::Share(alpha) => {
                    let alpha = u32::from(alpha.min(32));
                    (own * alpha + stored * (32 - alpha) + 16) / 32
                }
            }) as u8
        };
        Rgb565::new(mix(own.r(), stored.r()), mix(own.g(), stored.g()), mix(own.b(), stored.b()))
    }
}

struct Check<'a> {
    scene: &'a Scene,
    place: Place<Rgb565>,
    over: Over,
    /// Of 64 pixels how many are drawn; none: all, without a screen door.
    door: Option<u8>,
}

impl Check<'_> {
    fn on_targets<S: SpanShader<Rgb565, Ink: Unmixed<Rgb565>>>(
        &self,
        shade: impl Fn(usize) -> S,
    ) -> Drawn<Rgb565> {
        self.scene.with_instance(&self.scene.faces, &[], |instance| self.place.everywhere(instance, &shade))
    }

    fn in_memory<S: SpanShader<Rgb565>>(&self, shade: impl Fn(usize) -> S) -> Drawn<Rgb565> {
        self.scene.with_instance(&self.scene.faces, &[], |instance| self.place.in_memory(instance, &shade))
    }

    fn check<S: SpanShader<Rgb565, Ink: Unmixed<Rgb565>>>(&self, shade: impl Fn(usize) -> S)
    where
        ScreenDoor<S>: SpanShader<Rgb565, Ink: Unmixed<Rgb565>>,
    {
        let coverage = self.door.unwrap_or(64);
        let door = |face| ScreenDoor::new(shade(face), coverage);
        let drawn = match (self.over, self.door) {
            (Over::Opaque, _) => self.on_targets(door),
            (Over::Half, None) => self.in_memory(|face| Translucent::new(shade(face), Half)),
            (Over::Share(alpha), None) => {
                self.in_memory(|face| Translucent::new(shade(face), Alpha::new(alpha)))
            }
            // The screen door may be inside or outside.
            (Over::Half, Some(_)) => {
                self.in_memory(|face| ScreenDoor::new(Translucent::new(shade(face), Half), coverage))
            }
            (Over::Share(alpha), Some(_)) => {
                self.in_memory(|face| Translucent::new(door(face), Alpha::new(alpha)))
            }
        };
        self.compare(&drawn, &shade);
        if let (Over::Share(alpha), Some(_)) = (self.over, self.door) {
            let outside = self.in_memory(|face| {
                ScreenDoor::new(Translucent::new(shade(face), Alpha::new(alpha)), coverage)
            });
            assert!(outside == drawn, "the order of screen door and blending shows");
        }
    }

    fn compare<S: SpanShader<Rgb565>>(&self, drawn: &Drawn<Rgb565>, shade: impl Fn(usize) -> S) {
        let (corner, width) = (self.place.area.top_left, self.place.area.size.width as usize);
        let coverage = u32::from(self.door.unwrap_or(64));
        let mix = |i: usize, own, stored| {
            let (x, y) = (corner.x + (i % width) as i32, corner.y + (i / width) as i32);
            let is_opaque = matches!(self.over, Over::Opaque);
            (rank(x, y) < coverage).then(|| (self.over.mixed(own, stored), is_opaque))
        };
        let alone = self.place.alone(self.scene, shade);
        self.place.compare(drawn, &alone, mix, &(self.over, self.door, self.scene));
    }
}

pub(super) fn check(data: &[u8]) {
    let (head, tail) = data.split_at(data.len().min(8));
    let Some(scene) = Scene::read(tail) else { return };
    let Some(area) = scene.rectangle() else { return };
    let mut b = Bytes::new(head);
    let kind = b.byte();
    let over = match b.byte() {
        0..=63 => Over::Opaque,
        64..=127 => Over::Half,
        128..=191 => Over::Share(b.byte() & 31),
        _ => Over::Share(b.byte()),
    };
    let door = (kind & 1 != 0).then(|| b.byte() % 80);
    let place = Place { area, sky: SKY, rows: 1 + u32::from(b.byte() % 20) };
    let check = Check { scene: &scene, place, over, door };
    let mut rng = Rng::new(u64::from(b.u16()));
    let mut color = || Rgb565::new(rng.below(31) as u8, rng.below(62) as u8, rng.below(31) as u8);
    let colors: Vec<Rgb565> = (0..64).map(|_| color()).collect();
    match kind / 2 % 3 {
        0 => check.check(|face| colors[face]),
        1 => check.check(|face| {
            Gouraud::new([0, 1, 2].map(|corner| {
                let color = colors[3 * face + corner];
                // Within the ranges of the flat colours.
                embedded_graphics_core::pixelcolor::Rgb888::new(8 * color.r(), 4 * color.g(), 8 * color.b())
            }))
        }),
        _ => {
            let palette = [colors[0], colors[1]];
            let texels: Vec<Rgb565> =
                colors.iter().map(|color| palette[usize::from(color.r() & 1)]).collect();
            let keyed = ColorKeyed::new(TexelSlice::new(&texels, 8, 8).expect("texels"), palette[0]);
            let texture = Texture::new(keyed);
            check.check(|face| texture.at([[0, 0], [300, face as i16], [17, -500]]));
        }
    }
}
