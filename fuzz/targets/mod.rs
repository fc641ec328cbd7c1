//! What the fuzz targets check of any input. `fuzz/main.rs` has libFuzzer look for inputs; test `properties` takes the known ones and
//! random ones.

mod anti_aliased;
mod place;
mod scene;
mod set_up;
mod smooth;
mod texture;
mod translucent;

/// The name of a target, and its check, which panics if the library is wrong.
pub(crate) type Target = (&'static str, fn(&[u8]));

pub(crate) const TARGETS: [Target; 6] = [
    ("anti_aliased", anti_aliased::check),
    ("scene", scene::check),
    ("set_up", set_up::check),
    ("smooth", smooth::check),
    ("texture", texture::check),
    ("translucent", translucent::check),
];

/// Numbers from the fuzzer's bytes, so that hard ones are dense. Past the end all is zero, so every input means something and a
/// shorter one means a simpler case.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    fn byte(&mut self) -> u8 {
        match self.0.split_first() {
            Some((&first, rest)) => {
                self.0 = rest;
                first
            }
            None => 0,
        }
    }

    fn some<const N: usize>(&mut self) -> [u8; N] {
        core::array::from_fn(|_| self.byte())
    }

    fn i8(&mut self) -> i64 {
        i64::from(self.byte() as i8)
    }

    fn i16(&mut self) -> i16 {
        i16::from_le_bytes(self.some())
    }

    fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.some())
    }

    fn i32(&mut self) -> i32 {
        i32::from_le_bytes(self.some())
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.some())
    }

    /// In `0..n`, n ≤ 256.
    fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    fn of<T: Copy>(&mut self, choice: &[T]) -> T {
        choice[self.below(choice.len())]
    }

    /// A small number, a power of two or its neighbours, an extreme, or any 32 bits.
    fn wild(&mut self) -> i32 {
        match self.byte() {
            k @ 0..=63 => i32::from(k) - 32,
            k @ 64..=159 => {
                let power = 1i64 << (k & 31);
                let near = power + i64::from((k >> 5) - 2) - 1;
                (if self.byte() & 1 == 0 { near } else { -near }) as i32
            }
            k @ 160..=175 => i32::MAX - i32::from(k - 160),
            k @ 176..=191 => i32::MIN + i32::from(k - 176),
            192..=223 => i32::from(self.i16()) << 8,
            _ => self.i32(),
        }
    }
}
