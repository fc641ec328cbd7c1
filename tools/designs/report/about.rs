//! What the page says of each design, in the order in which they are measured.

/// The numbers that a design calculates with, which decide its colour in the plot and its part in the rule.
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
    /// Scaled depth, which is not possible for every object.
    Scaled,
}

pub(crate) struct About {
    /// The name in `designs::list`.
    pub(crate) id: &'static str,
    pub(crate) family: Family,
    pub(crate) name: &'static str,
    pub(crate) what: &'static str,
}

impl About {
    /// Whether depth is as exact as with 30-bit rows.
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
        "Line {default} with vertices of 32 bits."
    "f32-matrix" Float "f32, 4×4 matrix, three divisions":
        "Model, view and projection multiplied in f32, with absolute translations, as other libraries do it. No range test: the \
         conversion to integers saturates."
    "f32-eye" Float "f32, eye first, one division":
        "Three rows from the eye, with focal length and sub-pixels folded in: f32 at its best. No range test either."
    "q16-naive" Sixteen "Q16.16, `>> 16` after each product":
        "The usual first attempt: world vertices, a view matrix with −R·eye in it, a 64-bit division for each coordinate. \
         No range test."
    "q16-mismatch" Sixteen "Q16.16, translation from the exact rotation":
        "Sums of 64 bits, but −R·eye is computed from the exact R while the rows are rounded, so that the two do not cancel far \
         from the origin."
    "q16-eye" Sixteen "Q16.16 rows, eye first":
        "The eye is subtracted first; then sums and divisions of 64 bits."
    "q30-view16" Sixteen "Q2.30 rows, eye first, view in Q16.16":
        "Finer rows, so that the rounding of the view point is the error that is left."
    "i16-q14" Short "`i16` × Q14":
        "One 32-bit product for each coefficient, table and one Newton step, 16 × 16 bits for x/w. Nothing is wider than \
         32 bits."
    "i10" Short "10-bit vertices × Q20":
        "The code of line {i16-q14}; a coefficient has as many bits more as a vertex has fewer."
    "i8" Short "`i8` vertices × Q22": "The code of line {i16-q14}, with 3 bytes a vertex."
    "i16-wide" Short "`i16` × Q14, wide quotient":
        "The code of line {i16-q14}, but with two Newton steps, rounded to 16 bits, and 32 × 16 bits for x/w: a few \
         instructions more for each coordinate."
    "i10-wide" Short "10-bit vertices × Q20, wide quotient": "The code of line {i16-wide}."
    "i8-wide" Short "`i8` vertices × Q22, wide quotient": "The code of line {i16-wide}, with 3 bytes a vertex."
    "i16-split" Short "`i16` × (15 + 14 bits)":
        "Rows of 29 bits in two pieces, 257-entry table with interpolation, 16 × 16 bits for x/w."
    "i16-table" Thirty "30-bit rows, table alone": "The library's numbers in a bare loop; 1/w from a table of 256 bytes."
    "i16-newton1" Thirty "30-bit rows, 1 Newton step": "1/w to 17 bits."
    "i16-newton2" Thirty "30-bit rows, 2 Newton steps":
        "1/w to 28 bits and more: the library's numbers in a loop for perspectives alone, without far plane and depth."
    "i16-divided" Thirty "30-bit rows, u32 division and a step": "For cores that divide in hardware."
    "i16-exact" Thirty "30-bit rows, exact division": "A 64-bit division for each coordinate."
    "i16-4bits" Thirty "30-bit rows, 2 steps, 4 sub-pixel bits": "Line {i16-newton2} with a snap to 1/16 px."
    "i32-newton2" World "world `I16F16`, 2 Newton steps":
        "World vertices; the eye is subtracted first, each vertex is scaled to 31 bits, and rows are Q2.30."
    "i32-divided" World "world `I16F16`, u32 division and a step": "The code of line {i32-newton2}, for cores that divide in hardware."
    "i32-exact" World "world `I16F16`, exact division": "The code of line {i32-newton2}, with a 64-bit division for each coordinate."
    "scaled-q14" Scaled "scaled depth, `i16` × Q14":
        "Only for objects whose farthest vertex is less than twice as far away as the nearest: w needs no normalising."
    "scaled-newton2" Scaled "scaled depth, 30-bit rows, 2 steps": "Only for the objects of line {scaled-q14}."
};
