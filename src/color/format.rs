//! Where the channels of a colour lie in its bits.

/// The bits of a colour as a display takes them: how many there are, and which of them are its channels.
///
/// ```
/// use pinhole::color::Format;
/// assert_eq!((Format::rgb(5, 6, 5).bits(), Format::rgb(5, 6, 5).max()), (16, [31, 63, 31]));
/// assert_eq!(Format::rgb(5, 5, 5).padded_to(16).bits(), 16);
/// assert_eq!(Format::rgb(6, 6, 6).in_bytes().bits(), 24);
/// assert_eq!(Format::gray(4).max(), [15, 0, 0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Format {
    bits: u32,
    kind: Kind,
    max: [u8; 3],
    /// The lowest bit of each channel.
    shifts: [u32; 3],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Kind {
    Rgb,
    Gray,
    /// The bits are no channels.
    Indexed,
}

impl Format {
    /// Red in the upper bits, green, and blue in the lower bits, of as many bits each: at most 8, more count as 8.
    pub const fn rgb(red: u32, green: u32, blue: u32) -> Self {
        let [red, green, blue] = [at_most_8(red), at_most_8(green), at_most_8(blue)];
        Self {
            bits: red + green + blue,
            kind: Kind::Rgb,
            max: [max(red), max(green), max(blue)],
            shifts: [green + blue, blue, 0],
        }
    }

    /// [`rgb`](Self::rgb) with blue in the upper bits and red in the lower bits.
    pub const fn bgr(blue: u32, green: u32, red: u32) -> Self {
        let Self { bits, kind, max: [blue, green, red], shifts: [high, middle, low] } =
            Self::rgb(blue, green, red);
        Self { bits, kind, max: [red, green, blue], shifts: [low, middle, high] }
    }

    /// One channel, luma, of at most 8 bits; more count as 8.
    pub const fn gray(bits: u32) -> Self {
        let bits = at_most_8(bits);
        Self { bits, kind: Kind::Gray, max: [max(bits), 0, 0], shifts: [0; 3] }
    }

    /// A number of at most 32 bits in place of channels, such as the particles of e-paper. To be drawn in anything but plain colours, the
    /// type implements [`Color::channels`](crate::color::Color::channels) and [`Color::from_channels`](crate::color::Color::from_channels), with
    /// these highest levels of red, green and blue.
    pub const fn indexed(bits: u32, max: [u8; 3]) -> Self {
        Self { bits: if bits < 32 { bits } else { 32 }, kind: Kind::Indexed, max, shifts: [0; 3] }
    }

    /// The format with unused bits above its own, if it has fewer than `bits`, which are at most 32.
    #[must_use]
    pub const fn padded_to(self, bits: u32) -> Self {
        let bits = if bits < 32 { bits } else { 32 };
        Self { bits: if self.bits < bits { bits } else { self.bits }, ..self }
    }

    /// The format with each channel in the upper bits of a byte of its own, as display controllers take 18-bit colours.
    #[must_use]
    pub const fn in_bytes(self) -> Self {
        let [x, y, z] = [
            7 & self.max[0].leading_zeros(),
            7 & self.max[1].leading_zeros(),
            7 & self.max[2].leading_zeros(),
        ];
        match self.kind {
            Kind::Rgb if self.shifts[0] >= self.shifts[2] => {
                Self { bits: 24, shifts: [16 + x, 8 + y, z], ..self }
            }
            Kind::Rgb => Self { bits: 24, shifts: [x, 8 + y, 16 + z], ..self },
            Kind::Gray => Self { bits: 8, shifts: [x, 0, 0], ..self },
            Kind::Indexed => self,
        }
    }

    /// Bits per pixel.
    #[inline(always)]
    pub const fn bits(self) -> u32 {
        self.bits
    }

    /// The highest levels of red, green and blue; of a grey, the first is the highest luma and the others are 0.
    #[inline(always)]
    pub const fn max(self) -> [u8; 3] {
        self.max
    }

    /// Whether there is one channel, luma, in place of red, green and blue.
    #[inline(always)]
    pub(crate) const fn is_gray(self) -> bool {
        matches!(self.kind, Kind::Gray)
    }

    /// Whether the bits are channels.
    #[inline(always)]
    pub(crate) const fn has_channels(self) -> bool {
        !matches!(self.kind, Kind::Indexed)
    }

    /// The levels of the channels in these bits.
    #[inline(always)]
    pub(super) fn unpack(self, bits: u32) -> [u8; 3] {
        let ([i, j, k], [x, y, z]) = (self.shifts, self.max);
        [(bits >> i) as u8 & x, (bits >> j) as u8 & y, (bits >> k) as u8 & z]
    }

    /// The bits with these levels, each at most its [`max`](Self::max).
    #[inline(always)]
    pub(super) fn pack(self, [r, g, b]: [u8; 3]) -> u32 {
        let [i, j, k] = self.shifts;
        match self.kind {
            Kind::Rgb => u32::from(r) << i | u32::from(g) << j | u32::from(b) << k,
            _ => u32::from(r) << i,
        }
    }

    /// The bits of the channels, without the highest bit of each.
    #[inline(always)]
    pub(super) const fn low(self) -> u32 {
        let [i, j, k] = self.shifts;
        let [x, y, z] = self.max;
        (x as u32 >> 1) << i | (y as u32 >> 1) << j | (z as u32 >> 1) << k
    }

    /// The words in which channels are mixed side by side.
    pub(super) const fn words(self) -> Words {
        let ([x, y, z], [i, j, k]) = (self.max, self.shifts);
        let [x, y, z] = [Word::new(x, i), Word::new(y, j), Word::new(z, k)];
        let outer = if i > k { z.and(x) } else { x.and(z) };
        let spread = if i > k { z.and(x).and(y.moved()) } else { x.and(z).and(y.moved()) };
        match self.kind {
            Kind::Rgb if self.bits <= 16 && spread.has_room(5) => {
                Words { is_spread: true, words: [spread, NONE, NONE] }
            }
            Kind::Rgb if outer.has_room(8) => Words { is_spread: false, words: [outer, y, NONE] },
            _ => Words { is_spread: false, words: [x, y, z] },
        }
    }
}

const fn at_most_8(bits: u32) -> u32 {
    if bits < 8 {
        bits
    } else {
        8
    }
}

/// The largest number of at most 8 bits.
const fn max(bits: u32) -> u8 {
    ((1 << bits) - 1) as u8
}

/// Channels in words, so that those of one word are multiplied at once.
#[derive(Clone, Copy)]
pub(crate) struct Words {
    /// The middle channel lies 16 bits higher than in the colour, beside the others in the only word.
    pub(super) is_spread: bool,
    pub(super) words: [Word; 3],
}

/// Channels in one word.
#[derive(Clone, Copy)]
pub(crate) struct Word {
    /// All bits of the channels.
    pub(super) mask: u32,
    /// The lowest bit of each channel.
    pub(super) lowest: u32,
    /// The number of free bits above each channel, at least.
    room: u32,
}

const NONE: Word = Word { mask: 0, lowest: 0, room: 32 };

impl Word {
    const fn new(max: u8, shift: u32) -> Self {
        match max {
            0 => NONE,
            _ => Self {
                mask: (max as u32) << shift,
                lowest: 1 << shift,
                room: (max as u32).leading_zeros() - shift,
            },
        }
    }

    /// This word and one whose channels lie above.
    const fn and(self, above: Self) -> Self {
        let below = if above.mask == 0 { 32 } else { above.mask.trailing_zeros() };
        let own = 32 - self.mask.leading_zeros();
        let between = below.saturating_sub(own);
        let room = if self.room < between { self.room } else { between };
        let room = if room < above.room { room } else { above.room };
        Self { mask: self.mask | above.mask, lowest: self.lowest | above.lowest, room }
    }

    /// The word 16 bits higher.
    const fn moved(self) -> Self {
        Self { mask: self.mask << 16, lowest: self.lowest << 16, room: self.room.saturating_sub(16) }
    }

    const fn has_room(self, bits: u32) -> bool {
        self.room >= bits
    }

    /// `share` parts of 2^`bits` of the channels of `own`, and the rest of `stored`, rounded to nearest, ties up. There are `bits` free bits
    /// above each channel: a channel below 2^n becomes at most 2^bits·(2^n − 1) + 2^(bits − 1) < 2^(n + bits).
    #[inline(always)]
    pub(super) const fn mix(self, own: u32, stored: u32, share: u32, bits: u32) -> u32 {
        let Self { mask, lowest, .. } = self;
        let own = (own & mask).wrapping_mul(share).wrapping_add(lowest << (bits - 1));
        (own.wrapping_add((stored & mask).wrapping_mul((1u32 << bits).wrapping_sub(share))) >> bits) & mask
    }
}
