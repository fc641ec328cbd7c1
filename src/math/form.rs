//! Linear forms over mesh vertices: the multiply-accumulate of the vertex loop.

/// Homogeneous clip coordinates x, y, d, w as integers; the [`VertexTransform`](crate::camera) that made them has their
/// exponents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ClipCoords {
    /// d is 0 on the near plane, positive inside.
    pub(crate) xydw: [i32; 4],
}

/// A type of vertex coordinates: `i16`, in the mesh's unit of 2^exponent, or [`Scalar`](crate::Scalar), ±32768 in steps of 2⁻¹⁶. Sealed: no
/// other type can implement it.
#[diagnostic::on_unimplemented(
    message = "vertices cannot have coordinates of `{Self}`",
    label = "not `i16` or `Scalar`",
    note = "use `i16` with a power-of-two unit (`Mesh::new`), or `Scalar` (`Mesh::from_fixed`); pinhole-import rounds OBJ and STL files to `i16`"
)]
pub trait Coordinate: Copy + Send + Sync + core::fmt::Debug + sealed::Sealed {
    /// The coordinate times a power of two.
    #[doc(hidden)]
    fn times(self, factor: i32) -> i32;
    /// Whether the coordinate has 16 bits.
    #[doc(hidden)]
    const NARROW: bool;
    /// The type in which a mesh stores coordinates: the type itself, but for [`Inside`].
    #[doc(hidden)]
    type Stored: Coordinate<Stored = Self::Stored>;
    /// Whether faces and edges are clipped.
    #[doc(hidden)]
    const CLIPS: bool = true;
}

/// Marks a [`MeshInstance`](crate::draw::MeshInstance) that is not clipped, as its second parameter: `MeshInstance<Inside<i16>>`.
/// [`MeshInstance::without_clipping`](crate::draw::MeshInstance::without_clipping) makes it. No value of this type exists.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Inside<V>(core::marker::PhantomData<V>);

impl<V: Coordinate> Coordinate for Inside<V> {
    fn times(self, _: i32) -> i32 {
        0 // never called: a mesh stores `Stored`
    }
    const NARROW: bool = V::NARROW;
    type Stored = V::Stored;
    const CLIPS: bool = false;
}

impl Coordinate for i16 {
    fn times(self, factor: i32) -> i32 {
        i32::from(self).wrapping_mul(factor) // `Mesh` bounds the factor so that no bit is lost
    }
    const NARROW: bool = true;
    type Stored = Self;
}

/// A public trait that no other crate can name.
pub(super) mod sealed {
    pub trait Sealed {}
    impl Sealed for i16 {}
    impl<V> Sealed for super::Inside<V> {}
}

/// A linear form for cores with a 64-bit multiply-accumulate, `⌊(Σ linear · v · 2⁻³¹) + offset · 2⁻³² + ½⌋`; the offset is
/// truncated to 15 bits below the unit. Coordinates v are [justified](Self::justify) to the top of 32 bits.
#[allow(dead_code)] // where `cores` does not choose it, only tests use it
#[derive(Clone, Copy, Debug)]
#[repr(C)] // in the order in which they are loaded
pub(crate) struct WideForm {
    /// The constant in 2⁻³², with the half that rounds.
    offset: i64,
    /// The coefficients, each below 2³⁰ − 2¹⁵ in absolute value, times 2.
    doubled: [i32; 3],
}

#[allow(dead_code)] // where `cores` does not choose it, only tests use it
impl WideForm {
    /// The factor that justifies coordinates: 2^`shift`, where a left shift by `shift` brings the largest coordinate to the top
    /// of 32 bits.
    pub(crate) const fn justify(shift: u32, _narrow: bool) -> i32 {
        1 << (shift & 31)
    }

    pub(crate) const ZERO: Self = Self { offset: 0, doubled: [0; 3] };

    pub(crate) fn new([a, b, c]: [i32; 3], offset: i64) -> Self {
        Self { doubled: [a << 1, b << 1, c << 1], offset: truncated(offset) }
    }

    /// The coefficients, and the offset in units, rounded to nearest.
    pub(crate) fn numbers(&self) -> ([i32; 3], i32) {
        (self.doubled.map(|m| m >> 1), (self.offset >> 32) as i32)
    }

    /// Evaluates the form at a justified vertex, rounded once. The result fits because exponents are chosen so; partial sums
    /// may wrap.
    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], _narrow: bool) -> i32 {
        dot_product(self.doubled, self.offset, v)
    }
}

/// Adds the rounding half to an offset in 2⁻³² and clears the 17 bits that a [`HalfwordForm`](super::halfword::HalfwordForm)
/// has no room for, so that both forms give the same bits.
pub(super) fn truncated(offset: i64) -> i64 {
    offset.wrapping_add(1 << 31) >> 17 << 17
}

/// `⌊(offset + a·x + b·y + c·z) / 2³²⌋`, wrapping.
#[inline(always)]
pub(super) fn dot_product([a, b, c]: [i32; 3], offset: i64, [x, y, z]: [i32; 3]) -> i32 {
    let sum = offset
        .wrapping_add(i64::from(a) * i64::from(x))
        .wrapping_add(i64::from(b) * i64::from(y))
        .wrapping_add(i64::from(c) * i64::from(z));
    (sum >> 32) as i32
}
