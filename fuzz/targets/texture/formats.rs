//! Faces of any scene, in every format: what a face shows is looked up in the stored texels, by the coordinates that the face shows
//! when its texels are numbered.

use super::{shown, Numbered};
use crate::fuzzed::place::Place;
use crate::fuzzed::scene::input::Scene;
use crate::fuzzed::Bytes;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{
    color::Unmixed,
    prelude::*,
    shading::SpanShader,
    texture::{Accuracy, ColorKeyed, IndexedTexels, TexelSlice, Texels},
};
use support::bridge::ways::{in_memory, Drawn};
use support::oracle::rng::Rng;

/// A colour of no texel and no palette: their blue is at most 127.
const SKY: Rgb888 = Rgb888::new(1, 2, 255);

/// Texels whose colour is their number and their level of light.
#[derive(Clone, Copy)]
struct Leveled([u32; 2]);

impl Texels for Leveled {
    type Color = Rgb888;
    type Ink = Rgb888;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        self.0
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        self.lit_texel(u, v, 255)
    }

    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Rgb888 {
        let [w, h] = self.0;
        let number = (v >> (32 - h)) << w | u >> (32 - w);
        Rgb888::new(level as u8, (number % 251) as u8, 9)
    }
}

/// How many bytes say what texture there is.
const HEAD: usize = 24;

struct Textures<'a> {
    scene: &'a Scene,
    place: Place<Rgb888>,
    uv: Vec<[[i16; 2]; 3]>,
    bits: [u32; 2],
    exponent: i8,
    accuracy: Accuracy,
    clamped: bool,
    seed: u32,
    /// What each face shows alone, in 2⁻¹² of the sides.
    alone: Vec<[Drawn<Rgb888>; 2]>,
}

pub(crate) fn check(data: &[u8]) {
    let (head, tail) = data.split_at(data.len().min(HEAD));
    let Some(scene) = Scene::read(tail) else { return };
    let Some(area) = scene.rectangle() else { return };
    let mut b = Bytes::new(head);
    let kind = b.byte();
    let format = kind / 2 % 8;
    let seed = b.u32();
    let mut rng = Rng::new(seed.into());
    // Few bytes say the coordinates of all corners: one corner's are given, others lie within some reach.
    let (reach, at) = (i64::from(b.u16()), [b.i16(), b.i16()]);
    let uv = scene
        .faces
        .iter()
        .map(|_| {
            [(); 3]
                .map(|()| at.map(|at| (i64::from(at) + rng.int(-reach, reach)).clamp(-32_768, 32_767) as i16))
        })
        .collect();
    let bits = [b.below(6), b.below(6)].map(|bits| 3 + bits as u32);
    let mut textures = Textures {
        place: Place { area, sky: SKY, rows: 1 + u32::from(b.byte() % 20) },
        uv,
        bits,
        exponent: -(b.below(16) as i8),
        accuracy: b.of(&[Accuracy::Quarter, Accuracy::Eighth, Accuracy::Sixteenth]),
        clamped: kind & 1 != 0 && matches!(format, 1 | 6),
        seed,
        scene: &scene,
        alone: Vec::new(),
    };
    textures.draw_alone();
    match format {
        0 => textures.in_type(),
        1 => textures.slice(),
        2 => textures.indexed::<8>(),
        3 => textures.indexed::<4>(),
        4 => textures.indexed::<2>(),
        5 => textures.indexed::<1>(),
        6 => textures.keyed_by_color(),
        _ => textures.lit(),
    }
}

impl Textures<'_> {
    fn texture<S: Texels>(&self, texels: S) -> Texture<S> {
        Texture::new(texels).with_accuracy(self.accuracy).with_exponent(self.exponent).expect("-15 to 0")
    }

    /// Draws into memory; the texture is repeated.
    fn draw<S: Texels<Color = Rgb888>>(&self, texels: S) -> Drawn<Rgb888> {
        let texture = self.texture(texels);
        self.shade(|face| texture.at(self.uv[face]))
    }

    fn shade<S: SpanShader<Rgb888>>(&self, shade: impl Fn(usize) -> S) -> Drawn<Rgb888> {
        self.with_instance(|instance| in_memory(instance, self.place.area, SKY, &shade))
    }

    /// Draws on every target; the texture is repeated or clamped. Two formats do, one of them with a key, which stand for all: each
    /// format, target and way to number texels instantiates the drawing code once more.
    fn draw_everywhere<S: Texels<Color = Rgb888, Ink: Unmixed<Rgb888>>>(&self, texels: S) -> Drawn<Rgb888> {
        let texture = self.texture(texels);
        self.with_instance(|instance| match self.clamped {
            true => self.place.everywhere(instance, &|face| texture.clamped_at(self.uv[face])),
            false => self.place.everywhere(instance, &|face| texture.at(self.uv[face])),
        })
    }

    fn with_instance<R>(&self, draw: impl FnOnce(&MeshInstance<'_>) -> R) -> R {
        self.scene.with_instance(&self.scene.faces, &[], draw)
    }

    fn draw_alone(&mut self) {
        let texture = self.texture(Numbered(self.bits));
        self.alone = match self.clamped {
            true => self.place.alone(self.scene, |face| texture.clamped_at(self.uv[face])),
            false => self.place.alone(self.scene, |face| texture.at(self.uv[face])),
        };
    }

    /// Compares with the texels that the numbers of each face alone stand for; none leaves its pixel alone.
    fn compare(&self, drawn: &Drawn<Rgb888>, texel: impl Fn(usize) -> Option<Rgb888>) {
        let [w, h] = self.bits;
        let mix = |_, own, _| {
            let [u, v] = shown(own);
            texel(((v >> (12 - h)) << w | u >> (12 - w)) as usize).map(|color| (color, true))
        };
        self.place.compare(drawn, &self.alone, mix, self.scene);
    }

    fn sides(&self) -> [usize; 2] {
        self.bits.map(|bits| 1 << bits)
    }

    /// As many random bytes as texels.
    fn bytes(&self) -> Vec<u8> {
        let mut rng = Rng::new(u64::from(self.seed) + 1);
        let [w, h] = self.sides();
        (0..w * h).map(|_| rng.bits() as u8).collect()
    }

    fn colors(&self) -> Vec<Rgb888> {
        self.bytes().iter().enumerate().map(|(i, &byte)| Rgb888::new(byte, i as u8, byte & 127)).collect()
    }

    fn slice(&self) {
        let (colors, [w, h]) = (self.colors(), self.sides());
        let drawn = self.draw_everywhere(TexelSlice::new(&colors, w, h).expect("texels"));
        self.compare(&drawn, |at| Some(colors[at]));
    }

    /// A size in the type: three of them, whatever the input says.
    fn in_type(&mut self) {
        self.bits = [[3, 3], [8, 3], [4, 6]][self.bits[0] as usize % 3];
        self.draw_alone();
        match self.bits {
            [3, 3] => self.array::<8, 8>(),
            [8, 3] => self.array::<256, 8>(),
            _ => self.array::<16, 64>(),
        }
    }

    fn array<const W: usize, const H: usize>(&self) {
        let colors = self.colors();
        let rows: Box<[[Rgb888; W]; H]> =
            Box::new(core::array::from_fn(|y| core::array::from_fn(|x| colors[y * W + x])));
        self.compare(&self.draw(&*rows), |at| Some(colors[at]));
    }

    fn palette<const BITS: u32>() -> Vec<Rgb888> {
        (0..1u32 << BITS).map(|i| Rgb888::new(i as u8, (7 * i) as u8, (i >> 1) as u8)).collect()
    }

    /// The number of a texel's colour: the leftmost texel is in a byte's high bits.
    fn number<const BITS: u32>(bytes: &[u8], at: usize) -> usize {
        let bit = at * BITS as usize;
        usize::from(bytes[bit / 8]) >> (8 - BITS as usize - bit % 8) & ((1 << BITS) - 1)
    }

    fn indexed<const BITS: u32>(&self) {
        let (bytes, palette, [w, h]) = (self.bytes(), Self::palette::<BITS>(), self.sides());
        let drawn = self.draw(IndexedTexels::<_, BITS>::new(&bytes, w, h, &palette).expect("texels"));
        self.compare(&drawn, |at| Some(palette[Self::number::<BITS>(&bytes, at)]));
    }

    fn keyed_by_color(&self) {
        let ([w, h], palette) = (self.sides(), Self::palette::<2>());
        let colors: Vec<Rgb888> = self.bytes().iter().map(|&byte| palette[usize::from(byte & 3)]).collect();
        let key = palette[self.seed as usize & 3];
        let drawn =
            self.draw_everywhere(ColorKeyed::new(TexelSlice::new(&colors, w, h).expect("texels"), key));
        self.compare(&drawn, |at| Some(colors[at]).filter(|&color| color != key));
    }

    /// Each pixel has the texel without light, in the level of light that the shade table of the same levels shows.
    fn lit(&self) {
        let mut rng = Rng::new(u64::from(self.seed) + 2);
        let levels: Vec<[u16; 3]> = self
            .uv
            .iter()
            .map(|_| [(); 3].map(|()| [rng.int(0, 256), 0, 300][rng.below(3)] as u16))
            .collect();
        let texels = Leveled(self.bits);
        let texture = self.texture(texels);
        let lit = self.shade(|face| texture.at(self.uv[face]).lit(levels[face]));
        let table = ShadeTable::from_colors(core::array::from_fn(|i| Rgb888::new(i as u8, 0, 0)));
        let light = self.shade(|face| table.lit(levels[face]));
        let unlit = self.draw(texels);
        for (lit, (light, unlit)) in
            [(&lit.solid, (&light.solid, &unlit.solid)), (&lit.deep, (&light.deep, &unlit.deep))]
        {
            for (lit, (light, unlit)) in lit.iter().zip(light.iter().zip(unlit)) {
                match *unlit == SKY {
                    true => assert_eq!((*lit, *light), (SKY, SKY)),
                    false => assert_eq!(*lit, Rgb888::new(light.r(), unlit.g(), 9), "{:?}", self.scene),
                }
            }
        }
        self.compare(&unlit, |at| Some(Rgb888::new(255, (at % 251) as u8, 9)));
    }
}
