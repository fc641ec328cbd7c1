//! Arithmetic on colours against integers: each channel is compared with its exact value, of colours taken apart by
//! embedded-graphics.

use core::fmt::Debug;
use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb555, Rgb565,
    Rgb666, Rgb888, RgbColor,
};
use pinhole::color::{BlendMode, Color, Format, Half};
use support::oracle::rng::Rng;
use tricolor::Tricolor;

/// The planner's colours of e-paper.
#[allow(unreachable_pub)]
#[path = "../../apps/planner/src/tricolor.rs"]
mod tricolor;

macro_rules! own_colors {
    ($($name:ident: $format:expr;)*) => {$(
        #[derive(Clone, Copy, Debug, PartialEq)]
        struct $name(u32);

        impl PixelColor for $name {
            type Raw = ();
        }

        impl Color for $name {
            const FORMAT: Format = $format;

            fn to_bits(self) -> u32 {
                self.0
            }

            fn from_bits(bits: u32) -> Self {
                Self(bits)
            }
        }
    )*};
}

own_colors! {
    Rgb444: Format::rgb(4, 4, 4);
    Rgb332: Format::rgb(3, 3, 2);
    Bgr233: Format::bgr(2, 3, 3).padded_to(16);
    Rgb888In32: Format::rgb(90, 9, 8).padded_to(99);
    Gray4Upper: Format::gray(4).in_bytes();
    Gray4Lower: Format::gray(4).padded_to(8);
    Sixteen: Format::indexed(4, [0; 3]).padded_to(2);
    Words: Format::indexed(99, [1; 3]);
}

/// Compares the arithmetic on pairs of colours with that on their channels. `parts` takes a colour apart, `max` is the highest level of
/// each channel, and coverage is known in steps of `step`/256.
fn check<C: Color + Debug>(parts: impl Fn(C) -> [u8; 3], max: [u8; 3], step: u16) {
    assert_eq!(C::FORMAT.max(), max);
    let mut random = Rng::new(5);
    let bits = ((1_u64 << C::FORMAT.bits()) - 1) as u32;
    for i in 0..3_000 {
        // All bits, none, and random ones.
        let pair = [0, 1].map(|side| match i >> side & 15 {
            0 => C::from_bits(bits),
            1 => C::from_bits(0),
            _ => C::from_bits(random.bits() & bits),
        });
        check_pair(pair, (random.bits() % 33) as u8, &parts, max, step, &mut random);
    }
    // All pairs of levels of each channel with every alpha, beside random levels of the others, or the highest: their sums must not
    // carry into a neighbour.
    for (channel, &max_level) in max.iter().enumerate() {
        for (own, stored) in (0..=max_level).flat_map(|own| (0..=max_level).map(move |stored| (own, stored)))
        {
            let full = if random.below(4) == 0 { bits } else { 0 };
            let pair = [own, stored].map(|level| {
                let mut levels = parts(C::from_bits(random.bits() & bits | full));
                levels[channel] = level;
                C::from_channels(levels)
            });
            (0..=32).for_each(|alpha| check_pair(pair, alpha, &parts, max, step, &mut random));
        }
    }
}

/// Compares all arithmetic on a pair of colours, with this share of the first, and a random coverage and light.
fn check_pair<C: Color + Debug>(
    [own, stored]: [C; 2],
    alpha: u8,
    parts: impl Fn(C) -> [u8; 3],
    max: [u8; 3],
    step: u16,
    random: &mut Rng,
) {
    let coverage = random.below(257) as u16;
    let rounded = (coverage + step / 2) / step * step;
    // Of 256, rarely more.
    let lights = [300, 300, 300, 1 << 16][random.below(4)];
    let level = random.below(lights) as u16;
    let (mixed, over) = (parts(own.mix(stored, alpha)), parts(own.over(stored, coverage)));
    let (half, dimmed, sum) =
        (parts(Half.blend(own, stored)), parts(own.dim(level)), parts(own.emitting(stored)));
    assert_eq!(C::from_channels(own.channels()), own);
    assert_eq!(own.channels(), parts(own));
    let [alpha, rounded, light] = [alpha.into(), rounded, level.min(256)].map(u32::from);
    for channel in 0..3 {
        let [own, stored] = [parts(own), parts(stored)].map(|parts| u32::from(parts[channel]));
        let found = [mixed, over, half, dimmed, sum].map(|levels| u32::from(levels[channel]));
        let wanted = [
            (own * alpha + stored * (32 - alpha) + 16) / 32,
            (own * rounded + stored * (256 - rounded) + 128) / 256,
            own.div_ceil(2) + stored / 2,
            (own * light + 128) / 256,
            (own + stored).min(max[channel].into()),
        ];
        assert_eq!(found, wanted, "{own} {stored} {alpha} {coverage} {level}");
    }
}

#[test]
fn arithmetic_is_that_of_the_channels() {
    macro_rules! rgb {
        ($($color:ty: $step:literal;)*) => {$(
            check::<$color>(
                |color| [color.r(), color.g(), color.b()],
                [<$color>::MAX_R, <$color>::MAX_G, <$color>::MAX_B],
                $step,
            );
        )*};
    }
    rgb! {
        Rgb555: 8;
        Bgr555: 8;
        Rgb565: 8;
        Bgr565: 8;
        Rgb666: 1;
        Bgr666: 1;
        Rgb888: 1;
        Bgr888: 1;
    }
    check::<BinaryColor>(|color| [u8::from(color == BinaryColor::On), 0, 0], [1, 0, 0], 1);
    check::<Gray2>(|color| [color.luma(), 0, 0], [3, 0, 0], 1);
    check::<Gray4>(|color| [color.luma(), 0, 0], [15, 0, 0], 1);
    check::<Gray8>(|color| [color.luma(), 0, 0], [255, 0, 0], 1);
    check::<Rgb444>(
        |Rgb444(bits)| [bits >> 8, bits >> 4 & 15, bits & 15].map(|level| level as u8),
        [15; 3],
        1,
    );
}

/// Levels that no particles have are those of other particles: the levels are compared before that.
#[test]
fn a_colour_that_is_a_number_is_mixed_by_its_channels() {
    use Tricolor::{Black, Red, White};
    assert_eq!((White.dim(128), White.dim(127), Red.dim(200)), (White, Black, Red));
    assert_eq!((Red.emitting(White), Black.emitting(Red)), (White, Red));
    assert_eq!((White.mix(Black, 16), White.mix(Black, 15), Red.over(White, 128)), (White, Black, White));
    assert_eq!((Half.blend(Red, Black), Half.blend(Black, White), Red.mix(Black, 15)), (Red, Black, Black));
}

/// Compares the bits of a pixel whose levels are the highest of one channel.
fn check_bits<C: Color>(bits: u32, max: [u8; 3], wanted: [u32; 3]) {
    assert_eq!((C::FORMAT.bits(), C::FORMAT.max()), (bits, max));
    let [x, y, z] = max;
    let found = [[x, 0, 0], [0, y, 0], [0, 0, z]].map(|levels| C::from_channels(levels).to_bits());
    assert_eq!(found, wanted, "{:?}", C::FORMAT);
    assert_eq!(C::from_bits(!0).channels(), max);
}

/// Where the bits of a pixel lie, written out.
#[test]
fn channels_lie_where_displays_take_them() {
    check_bits::<Rgb565>(16, [31, 63, 31], [0xf800, 0x07e0, 0x001f]);
    check_bits::<Bgr565>(16, [31, 63, 31], [0x001f, 0x07e0, 0xf800]);
    check_bits::<Rgb555>(16, [31; 3], [0x7c00, 0x03e0, 0x001f]);
    check_bits::<Bgr555>(16, [31; 3], [0x001f, 0x03e0, 0x7c00]);
    check_bits::<Rgb666>(24, [63; 3], [0xfc_0000, 0x00_fc00, 0x00_00fc]);
    check_bits::<Bgr666>(24, [63; 3], [0x00_00fc, 0x00_fc00, 0xfc_0000]);
    check_bits::<Rgb888>(24, [255; 3], [0xff_0000, 0x00_ff00, 0x00_00ff]);
    check_bits::<Bgr888>(24, [255; 3], [0x00_00ff, 0x00_ff00, 0xff_0000]);
    check_bits::<Rgb444>(12, [15; 3], [0xf00, 0x0f0, 0x00f]);
    check_bits::<Rgb332>(8, [7, 7, 3], [0xe0, 0x1c, 0x03]);
    check_bits::<Bgr233>(16, [7, 7, 3], [0x07, 0x38, 0xc0]);
    check_bits::<Rgb888In32>(32, [255; 3], [0xff_0000, 0x00_ff00, 0x00_00ff]);
    check_bits::<Gray4>(4, [15, 0, 0], [15, 0, 0]);
    check_bits::<Gray4Upper>(8, [15, 0, 0], [0xf0, 0, 0]);
    check_bits::<Gray4Lower>(8, [15, 0, 0], [15, 0, 0]);
    assert_eq!([Words::FORMAT.bits(), Sixteen::FORMAT.bits()], [32, 4]);
}
