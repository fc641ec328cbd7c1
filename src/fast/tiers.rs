//! The tiers of fast triangles, chosen by core: see the table in [`fast`](super).

#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) use with_division::{Low, LowSpans, Small};
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use without_division::{Low, LowSpans, Small};

#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
mod with_division {
    use crate::fast::edge20::{OneDivision, TwoDivisions};
    pub(crate) use crate::fast::small_triangle::LowSpans;
    use crate::fast::small_triangle::SmallTriangle;

    /// Triangles of at most 32 × 30 pixels that lie inside the scissor: most triangles of a mesh.
    pub(crate) type Small = SmallTriangle<OneDivision, false>;
    /// Triangles of at most 32 rows that lie between the left and right border of the scissor, but may begin above it or end
    /// below it.
    pub(crate) type Low = SmallTriangle<TwoDivisions, true>;
}

#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
mod without_division {
    use crate::fast::bresenham_triangle::BresenhamTriangle;
    pub(crate) use crate::fast::bresenham_triangle::LowSpans;

    /// Triangles of at most 31 rows that lie inside the scissor.
    pub(crate) type Small = BresenhamTriangle<false>;
    /// Triangles of at most 31 rows that lie between the left and right border of the scissor, but may begin above it or end
    /// below it.
    pub(crate) type Low = BresenhamTriangle<true>;
}
