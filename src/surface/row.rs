//! Functions that write and read rows of pixels as displays take them: see [`Color`].

use super::block_fill::{fill, fill_words};
use crate::color::{Color, StoredPixel};
use crate::math::hints::keep_rolled;
use bytemuck::pod_align_to_mut;

/// Whether pixels are whole bytes, so that rows follow each other without gaps.
pub(super) const fn is_whole_bytes<C: Color>() -> bool {
    C::FORMAT.bits().is_multiple_of(8)
}

/// The number of bytes of a row of `width` pixels.
pub(super) const fn row_bytes<C: Color>(width: u32) -> usize {
    const {
        assert!(
            matches!(C::FORMAT.bits(), 1 | 2 | 4 | 8 | 12 | 16 | 24 | 32),
            "in bands a pixel has 1, 2, 4, 8, 12, 16, 24 or 32 bits: see `Format::padded_to`"
        )
    };
    let bytes = (width as u64 * C::FORMAT.bits() as u64).div_ceil(8); // 32 + 6 bits
    if bytes < usize::MAX as u64 {
        bytes as usize
    } else {
        usize::MAX // longer than any strip
    }
}

/// Sets pixels `from..to` of a row, in which they lie, to one colour.
#[inline(always)]
pub(super) fn fill_pixels<C: Color>(row: &mut [u8], from: usize, to: usize, color: C) {
    let bits = color.to_bits();
    let [_, a, b, c] = bits.to_be_bytes();
    match C::FORMAT.bits() {
        8 => fill_cells(row, from, to, [c]),
        12 => fill_twelve(row, from, to, bits),
        16 => fill_cells(row, from, to, [b, c]),
        24 => fill_cells(row, from, to, [a, b, c]),
        32 => fill_cells(row, from, to, bits.to_be_bytes()),
        _ => fill_packed::<C>(row, from, to, bits),
    }
}

/// Fills bytes that hold whole pixels, each in whole bytes, with one colour: words of four bytes where a pixel repeats in a word. Cells of bytes are not aligned,
/// so that a Cortex-M0 stores them byte by byte: clearing the strips of a frame took 215 000 of the 1 853 000 instructions of S3 with
/// depth in bands of 8 rows there, and takes 33 000 by words.
#[inline(always)]
pub(super) fn fill_all<C: Color>(bytes: &mut [u8], color: C) {
    let bits = color.to_bits();
    let word = match C::FORMAT.bits().next_multiple_of(8) {
        8 => (bits & 0xff) * 0x0101_0101,
        16 => (bits & 0xffff) * 0x0001_0001,
        32 => bits,
        _ => return fill_pixels(bytes, 0, bytes.len() / 3, color),
    };
    let (before, words, after) = pod_align_to_mut::<u8, u32>(bytes);
    // The word that follows the bytes before it, at most three.
    let next = word.rotate_left(8 * (before.len() as u32 & 3));
    fill_words(words, next.to_be());
    for (ends, word) in [(before, word), (after, next)] {
        for (byte, value) in ends.iter_mut().zip(word.to_be_bytes()) {
            keep_rolled();
            *byte = value;
        }
    }
}

/// The cells `from..to` of a row of bytes, if the row has them.
#[inline(always)]
fn cells<const N: usize>(row: &mut [u8], from: usize, to: usize) -> &mut [[u8; N]] {
    // No product wraps: the row lies in memory.
    let run = row.get_mut(from.wrapping_mul(N)..to.wrapping_mul(N)).unwrap_or_default();
    run.as_chunks_mut().0
}

/// Sets the cells `from..to` of a row, if the row has them.
#[inline(always)]
fn fill_cells<const N: usize>(row: &mut [u8], from: usize, to: usize, cell: [u8; N]) {
    fill_run(cells(row, from, to), cell);
}

#[inline(never)] // its loops need the registers of the loops that draw
fn fill_run<const N: usize>(run: &mut [[u8; N]], cell: [u8; N]) {
    fill(run, cell);
}

/// The number of pixels in a byte, for formats of fewer than 8 bits.
const fn per_byte<C: Color>() -> u32 {
    match C::FORMAT.bits() {
        1 => 8,
        2 => 4,
        _ => 2,
    }
}

/// Sets pixels `from..to` of fewer than 8 bits each: parts of the first and the last byte, and the bytes between.
#[inline(never)]
fn fill_packed<C: Color>(row: &mut [u8], from: usize, to: usize, bits: u32) {
    let per_byte = per_byte::<C>() as usize;
    // A factor that repeats the pixel's bits through a byte.
    let ones = match C::FORMAT.bits() {
        1 => 0xff,
        2 => 0x55,
        _ => 0x11,
    };
    let pattern = ((bits & ((1 << C::FORMAT.bits()) - 1)) * ones) as u8; // below 2⁸
    let (first, last) = (from / per_byte, to / per_byte); // a power of two: shifts, no divisions

    // The bits of a byte from this pixel to the last one.
    let from_on = |x: usize| 0xff_u8.checked_shr((x % per_byte) as u32 * C::FORMAT.bits()).unwrap_or(0);
    let mut put = |index: usize, mask: u8| {
        if let Some(byte) = row.get_mut(index) {
            *byte = (*byte & !mask) | (pattern & mask);
        }
    };
    if first == last {
        return put(first, from_on(from) & !from_on(to));
    }
    put(first, from_on(from));
    put(last, !from_on(to));
    if let Some(bytes) = row.get_mut(first + 1..last) {
        bytes.fill(pattern);
    }
}

/// Sets pixels `from..to` of 12 bits each: pairs of three bytes, and half a pair at an odd end.
#[inline(never)]
fn fill_twelve(row: &mut [u8], mut from: usize, mut to: usize, bits: u32) {
    let bits = bits & 0xfff;
    let [_, a, b, c] = (bits << 12 | bits).to_be_bytes();
    // No product wraps if the row has the pixels.
    let first = |x: usize| (x / 2).wrapping_mul(3);
    if from < to && from % 2 == 1 {
        if let Some([_, middle, last, ..]) = row.get_mut(first(from)..) {
            (*middle, *last) = (*middle & 0xf0 | b & 0x0f, c);
        }
        from = from.wrapping_add(1);
    }
    if from < to && to % 2 == 1 {
        to = to.wrapping_sub(1);
        if let Some([first, middle, ..]) = row.get_mut(first(to)..) {
            (*first, *middle) = (a, *middle & 0x0f | b & 0xf0);
        }
    }
    fill_cells(row, from / 2, to / 2, [a, b, c]);
}

/// Sets pixel `x` of a row, if the row has it.
#[inline(always)]
pub(super) fn set_pixel<C: Color>(row: &mut [u8], x: usize, color: C) {
    let bits = color.to_bits();
    match C::FORMAT.bits() {
        8 => set_cell(row, x, [bits as u8]),
        12 => fill_twelve(row, x, x.wrapping_add(1), bits),
        16 => set_cell(row, x, (bits as u16).to_be_bytes()),
        24 => {
            let [_, a, b, c] = bits.to_be_bytes();
            set_cell(row, x, [a, b, c]);
        }
        32 => set_cell(row, x, bits.to_be_bytes()),
        _ => fill_packed::<C>(row, x, x.wrapping_add(1), bits),
    }
}

#[inline(always)]
fn set_cell<const N: usize>(row: &mut [u8], x: usize, cell: [u8; N]) {
    if let [pixel] = cells(row, x, x.wrapping_add(1)) {
        *pixel = cell;
    }
}

/// Sets pixels `from..to` of a row to colours from left to right, until either ends.
#[inline(always)]
pub(super) fn copy_pixels<C: Color>(row: &mut [u8], from: usize, to: usize, colors: impl Iterator<Item = C>) {
    match C::FORMAT.bits() {
        8 => copy_cells(row, from, to, colors.map(|c| [c.to_bits() as u8])),
        16 => copy_cells(row, from, to, colors.map(|c| (c.to_bits() as u16).to_be_bytes())),
        24 => copy_cells(
            row,
            from,
            to,
            colors.map(|c| {
                let [_, x, y, z] = c.to_bits().to_be_bytes();
                [x, y, z]
            }),
        ),
        32 => copy_cells(row, from, to, colors.map(|c| c.to_bits().to_be_bytes())),
        _ => (from..to).zip(colors).for_each(|(x, color)| set_pixel(row, x, color)),
    }
}

#[inline(always)]
fn copy_cells<const N: usize>(row: &mut [u8], from: usize, to: usize, values: impl Iterator<Item = [u8; N]>) {
    for (cell, value) in cells(row, from, to).iter_mut().zip(values) {
        *cell = value;
    }
}

/// The bits of a pixel of whole bytes, most significant byte first.
#[inline(always)]
pub(super) fn bits_of_bytes(pixel: &[u8]) -> u32 {
    pixel.iter().fold(0, |bits, &byte| bits << 8 | u32::from(byte))
}

/// The colour of pixel `x` of a row, if the row has it.
#[inline(always)]
pub(super) fn get_pixel<C: Color>(row: &[u8], x: usize) -> Option<C> {
    let bytes = |n: usize| {
        let from = x.wrapping_mul(n);
        Some(bits_of_bytes(row.get(from..from.wrapping_add(n))?))
    };
    let bits = match C::FORMAT.bits() {
        8 => bytes(1)?,
        12 => {
            let first = (x / 2).wrapping_mul(3).wrapping_add(x % 2);
            let &[high, low] = row.get(first..)?.first_chunk()?;
            let bits = u32::from(high) << 8 | u32::from(low);
            if x.is_multiple_of(2) {
                bits >> 4
            } else {
                bits & 0xfff
            }
        }
        16 => bytes(2)?,
        24 => bytes(3)?,
        32 => bytes(4)?,
        _ => {
            let per_byte = per_byte::<C>() as usize;
            let down = 8 - C::FORMAT.bits() - (x % per_byte) as u32 * C::FORMAT.bits(); // 0 … 7
            u32::from(*row.get(x / per_byte)?) >> down & ((1 << C::FORMAT.bits()) - 1)
        }
    };
    Some(C::from_bits(bits))
}

/// Packs rows of pixels of `N` bytes each, in place: a packed pixel lies at or before its bytes. Unused bits at the end of a row become zero.
pub(super) fn pack<C: StoredPixel<[u8; N]> + Color, const N: usize>(
    strip: &mut [u8],
    width: usize,
    rows: usize,
) {
    let mut to = 0;
    for row in 0..rows {
        let (mut bits, mut count) = (0_u32, 0);
        for x in 0..width {
            let from = row.wrapping_mul(width).wrapping_add(x).wrapping_mul(N); // in the strip, or nothing is read
            let cell = strip.get(from..).and_then(<[u8]>::first_chunk);
            bits = bits << (C::FORMAT.bits() & 15) | cell.map_or(0, |&cell| C::load(cell).to_bits());
            count += C::FORMAT.bits(); // at most 7 and 12
            while count >= 8 {
                count -= 8;
                put(strip, &mut to, bits >> (count & 15));
            }
        }
        if count > 0 {
            put(strip, &mut to, bits << ((8 - count) & 7));
        }
    }
}

/// Writes the lowest byte of `bits`.
fn put(strip: &mut [u8], to: &mut usize, bits: u32) {
    if let Some(byte) = strip.get_mut(*to) {
        *byte = bits as u8;
    }
    *to = to.wrapping_add(1); // at most as long as the strip
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Format;
    use embedded_graphics_core::pixelcolor::{
        Bgr565, Bgr666, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb565, Rgb666, Rgb888,
    };

    /// Two pixels in three bytes.
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Rgb444(u16);

    impl PixelColor for Rgb444 {
        type Raw = ();
    }

    impl Color for Rgb444 {
        const FORMAT: Format = Format::rgb(4, 4, 4);

        fn to_bits(self) -> u32 {
            self.0.into()
        }

        fn from_bits(bits: u32) -> Self {
            Self(bits as u16)
        }
    }

    /// Long enough for a partly covered byte at both ends and two whole bytes between. Test rows have one byte more than it
    /// needs.
    const WIDTH: usize = 33;

    /// The bits of a row, the most significant bit of each byte first.
    type Bits = [bool; 8 * (3 * WIDTH + 1)];

    fn put(bits: &mut Bits, x: usize, size: usize, value: u32) {
        for bit in 0..size {
            bits[x * size + bit] = value >> (size - 1 - bit) & 1 == 1;
        }
    }

    fn read(bits: &Bits, x: usize, size: usize) -> u32 {
        (0..size).fold(0, |value, bit| value << 1 | u32::from(bits[x * size + bit]))
    }

    /// Every function that writes or reads a row, at all offsets, against a row that is written bit by bit.
    fn check<C: Color + core::fmt::Debug>(size: usize, colors: &[C]) {
        assert_eq!(C::FORMAT.bits() as usize, size);
        let bytes = row_bytes::<C>(WIDTH as u32);
        assert_eq!(bytes, (WIDTH * size).div_ceil(8));
        for (i, &color) in colors.iter().enumerate() {
            assert_eq!(C::from_bits(color.to_bits()), color);
            assert!(size == 32 || color.to_bits() < 1 << size, "{color:?}");
            // All bytes at once, at every alignment and length of whole pixels.
            for (from, pixels) in (0..4).flat_map(|from| (0..WIDTH).map(move |pixels| (from, pixels))) {
                let (mut all, mut each) = ([0xa5; 4 * WIDTH], [0xa5; 4 * WIDTH]);
                if is_whole_bytes::<C>() {
                    fill_all(&mut all[from..from + pixels * size / 8], color);
                    fill_pixels(&mut each[from..], 0, pixels, color);
                }
                assert_eq!(all, each);
            }
            for from in 0..=WIDTH {
                for to in from..=WIDTH {
                    // Before the call the row is neither all zeros nor all ones.
                    let mut filled = [0xa5; 3 * WIDTH + 1];
                    let mut copied = filled;
                    let mut wanted: Bits = core::array::from_fn(|bit| 0xa5 >> (7 - bit % 8) & 1 == 1);
                    let mut wanted_copy = wanted;
                    // The iterator of colours ends before the run does, except for short runs.
                    let end = to - (to - from) / 3;
                    for x in from..to {
                        put(&mut wanted, x, size, color.to_bits());
                        if x < end {
                            put(&mut wanted_copy, x, size, colors[(i + x) % colors.len()].to_bits());
                        }
                    }
                    fill_pixels(&mut filled[..bytes], from, to, color);
                    let run = (from..end).map(|x| colors[(i + x) % colors.len()]);
                    copy_pixels(&mut copied[..bytes], from, to, run);
                    for (row, wanted) in [(filled, wanted), (copied, wanted_copy)] {
                        for (bit, wanted) in wanted.into_iter().enumerate() {
                            assert_eq!(
                                row[bit / 8] >> (7 - bit % 8) & 1 == 1,
                                wanted,
                                "{from}..{to}, bit {bit}"
                            );
                        }
                        for x in 0..WIDTH {
                            assert_eq!(
                                get_pixel::<C>(&row[..bytes], x),
                                Some(C::from_bits(read(&wanted, x, size)))
                            );
                        }
                    }
                }
            }
        }
        // Nothing is written or read beyond the end.
        let (mut row, color) = ([0; 3 * WIDTH], colors[0]);
        set_pixel(&mut row[..bytes], 8 * bytes, color);
        copy_pixels(&mut row[..bytes], 8 * bytes, 8 * bytes + 1, [color].into_iter());
        assert_eq!((row, get_pixel::<C>(&row[..bytes], 8 * bytes)), ([0; 3 * WIDTH], None));
    }

    #[test]
    fn rows_are_the_bits_of_their_pixels() {
        check(1, &[BinaryColor::On, BinaryColor::Off, BinaryColor::Off]);
        check(2, &[3, 0, 1, 2].map(Gray2::new));
        check(4, &[15, 0, 9, 6, 3].map(Gray4::new));
        check(8, &[255, 0, 0x5a].map(Gray8::new));
        check(12, &[0xf81, 0x2c7, 0x05e].map(Rgb444));
        check(16, &[Rgb565::new(31, 0, 21), Rgb565::new(0, 63, 1)]);
        check(16, &[Bgr565::new(31, 0, 21), Bgr565::new(0, 63, 1)]);
        check(24, &[Rgb888::new(1, 2, 255), Rgb888::new(250, 128, 0)]);
        check(24, &[Rgb666::new(63, 1, 0), Rgb666::new(2, 0, 62)]);
        check(24, &[Bgr666::new(63, 1, 0), Bgr666::new(2, 0, 62)]);
    }
}
