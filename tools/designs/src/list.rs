//! All designs, in the order of the page.

use crate::chain::Design;
use crate::divide::{Divided, Exact, OneStep, Table, TwoSteps};
use crate::float::{EyeRelative, Matrix};
use crate::scaled::{ScaledShort, ScaledThirty};
use crate::short::{OneProduct, TwoProducts};
use crate::sixteen::{EyeFirst, Mismatched, Naive};
use crate::thirty::Thirty;
use crate::world::BlockScaled;

/// A function over all designs. `id` is the design's name, which the programs exchange.
pub trait Visit {
    fn visit<D: Design>(&mut self, id: &'static str);
}

pub fn all(visitor: &mut impl Visit) {
    visitor.visit::<Matrix>("f32-matrix");
    visitor.visit::<EyeRelative>("f32-eye");
    visitor.visit::<Naive>("q16-naive");
    visitor.visit::<Mismatched>("q16-mismatch");
    visitor.visit::<EyeFirst<16>>("q16-eye");
    visitor.visit::<EyeFirst<30>>("q30-view16");
    visitor.visit::<OneProduct<16, i16, false>>("i16-q14");
    visitor.visit::<OneProduct<10, i16, false>>("i10");
    visitor.visit::<OneProduct<8, i8, false>>("i8");
    visitor.visit::<OneProduct<16, i16, true>>("i16-wide");
    visitor.visit::<OneProduct<10, i16, true>>("i10-wide");
    visitor.visit::<OneProduct<8, i8, true>>("i8-wide");
    visitor.visit::<TwoProducts>("i16-split");
    visitor.visit::<Thirty<Table, 8>>("i16-table");
    visitor.visit::<Thirty<OneStep, 8>>("i16-newton1");
    visitor.visit::<Thirty<TwoSteps, 8>>("i16-newton2");
    visitor.visit::<Thirty<Divided, 8>>("i16-divided");
    visitor.visit::<Thirty<Exact, 8>>("i16-exact");
    visitor.visit::<Thirty<TwoSteps, 4>>("i16-4bits");
    visitor.visit::<BlockScaled<TwoSteps>>("i32-newton2");
    visitor.visit::<BlockScaled<Divided>>("i32-divided");
    visitor.visit::<BlockScaled<Exact>>("i32-exact");
    visitor.visit::<ScaledShort>("scaled-q14");
    visitor.visit::<ScaledThirty>("scaled-newton2");
}
