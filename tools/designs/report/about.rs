//! What the page says of each design, in the order in which they are measured.

/// What a design calculates in, and what becomes of it in the plot and in the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Family {
    /// The library itself.
    Default,
    Float,
    /// Q16.16 with divisions of 64 bits.
    Sixteen,
    /// 32-bit products only.
    Short,
    /// 30-bit rows, i16 vertices.
    Thirty,
    /// 30-bit rows, world coordinates of 32 bits.
    World,
    /// Not for every object.
    Scaled,
}

pub(crate) struct About {
    /// As in `designs::list`.
    pub(crate) id: &'static str,
    pub(crate) family: Family,
    pub(crate) name: &'static str,
    pub(crate) what: &'static str,
}

impl About {
    /// Whether depth is as exact as 30-bit rows have it.
    pub(crate) fn exact_depth(&self) -> bool {
        matches!(self.family, Family::Default | Family::Thirty | Family::World)
    }

    /// Whether it could take the default's place: integers, every object.
    pub(crate) fn competes(&self) -> bool {
        !matches!(self.family, Family::Default | Family::Float | Family::Scaled)
    }
}

macro_rules! about {
    ($($id:literal $family:ident $name:literal: $what:literal)*) => {
        &[$(About { id: $id, family: Family::$family, name: $name, what: $what }),*]
    };
}

pub(crate) const ALL: &[About] = about! {
    "default" Default "**the library, `i16` mesh**":
        "`MeshInstance::transform`: rows of 30 bits with one exponent per object, focal length and viewport folded in, the eye \
         subtracted first in 64 bits, high words of the sums, 8-bit table and two Newton steps for 1/w. Any projection, \
         far plane, corners packed with room for depth."
    "default-fixed" Default "**the library, `I16F16` mesh**":
        "The same with vertices of 32 bits."
    "f32-matrix" Float "f32, 4×4 matrix, three divisions":
        "Model, view and projection multiplied in f32, absolute translations in them, as other libraries do it. No range \
         test: the conversion to integers saturates."
    "f32-eye" Float "f32, eye first, one division":
        "Three rows from the eye, focal length and sub-pixels folded in: f32 at its best. No range test either."
    "q16-naive" Sixteen "Q16.16, `>> 16` after each product":
        "The usual first attempt: world vertices, a view matrix with −R·eye in it, a 64-bit division for each coordinate. \
         No range test."
    "q16-mismatch" Sixteen "Q16.16, translation from the exact rotation":
        "Sums of 64 bits, but −R·eye is of the exact R and the rows are rounded: the two do not cancel far from the \
         origin."
    "q16-eye" Sixteen "Q16.16 rows, eye first":
        "The eye is subtracted, then sums of 64 bits; 64-bit divisions."
    "q30-view16" Sixteen "Q2.30 rows, eye first, view in Q16.16":
        "Finer rows; now the rounding of the view point is what is left."
    "i16-q14" Short "`i16` × Q14":
        "One 32-bit product for each coefficient, table and one Newton step, 16 × 16 bits for x/w. Nothing is wider than \
         32 bits."
    "i10" Short "10-bit vertices × Q20": "The same code; what the vertex has fewer, the coefficient has more."
    "i8" Short "`i8` vertices × Q22": "The same, 3 bytes a vertex."
    "i16-wide" Short "`i16` × Q14, wide quotient":
        "As line {i16-q14}, but two Newton steps, rounded to 16 bits, and 32 × 16 bits for x/w: a few instructions more \
         for each coordinate."
    "i10-wide" Short "10-bit vertices × Q20, wide quotient": "The same."
    "i8-wide" Short "`i8` vertices × Q22, wide quotient": "The same."
    "i16-split" Short "`i16` × (15 + 14 bits)":
        "Rows of 29 bits in two pieces, 257-entry table with interpolation, 16 × 16 bits for x/w."
    "i16-table" Thirty "30-bit rows, table alone": "The default's numbers in a bare loop; 1/w from a table of 256 bytes."
    "i16-newton1" Thirty "30-bit rows, 1 Newton step": "1/w to 17 bits."
    "i16-newton2" Thirty "30-bit rows, 2 Newton steps":
        "1/w to 28 bits and more: the default's numbers in a loop for perspectives alone, without far plane and depth."
    "i16-divided" Thirty "30-bit rows, u32 division and a step": "For cores that divide in hardware."
    "i16-exact" Thirty "30-bit rows, exact division": "A 64-bit division for each coordinate."
    "i16-4bits" Thirty "30-bit rows, 2 steps, 4 sub-pixel bits": "Only the snap differs."
    "i32-newton2" World "world `I16F16`, 2 Newton steps":
        "World vertices, the eye first, each scaled to 31 bits, rows in Q2.30."
    "i32-divided" World "world `I16F16`, u32 division and a step": "The same."
    "i32-exact" World "world `I16F16`, exact division": "The same."
    "scaled-q14" Scaled "scaled depth, `i16` × Q14":
        "Only where the farthest vertex is less than twice as far as the nearest: w needs no normalising."
    "scaled-newton2" Scaled "scaled depth, 30-bit rows, 2 steps": "The same condition."
};
