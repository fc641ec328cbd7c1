//! What became of the primitives.

use super::fan::Outcome;

/// Counts of what a draw did, in faces, edges, segments of a poly-line or points. Each one handed in is in exactly
/// one of `drawn`, `culled`, `outside` and `degenerate`; `clipped` counts those of the drawn that were cut first.
///
/// Drawn means handed to the rasteriser: a face between four pixel centres, or beside the target,
/// is drawn and covers none.
///
/// ```
/// use pinhole::Statistics;
/// let [cube, ball] = [4, 9].map(|drawn| Statistics { drawn, culled: 2 * drawn, ..Statistics::default() });
/// let both = cube.and(ball);
/// assert_eq!((both.drawn, both.culled, both.outside), (13, 26, 0));
/// let many = Statistics { drawn: u32::MAX - 4, ..both };
/// assert_eq!(both.and(many).drawn, u32::MAX);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Statistics {
    /// Rasterised.
    pub drawn: u32,
    /// Turned away from the viewer.
    pub culled: u32,
    /// Cut by the near plane, the far plane or the guard band, and drawn.
    pub clipped: u32,
    /// Wholly in front of the near plane, beyond the far plane or outside the guard band.
    pub outside: u32,
    /// BinnedFaces without area on the screen.
    pub degenerate: u32,
}

impl Statistics {
    pub(super) const NONE: Self = Self { drawn: 0, culled: 0, clipped: 0, outside: 0, degenerate: 0 };

    /// Both together, saturating.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            drawn: self.drawn.saturating_add(other.drawn),
            culled: self.culled.saturating_add(other.culled),
            clipped: self.clipped.saturating_add(other.clipped),
            outside: self.outside.saturating_add(other.outside),
            degenerate: self.degenerate.saturating_add(other.degenerate),
        }
    }

    #[inline(always)]
    pub(super) fn count(&mut self, outcome: Outcome) {
        // At most 2³² faces would fit a slice of a 32-bit core: no sum wraps.
        let field = match outcome {
            Outcome::Culled => &mut self.culled,
            Outcome::Degenerate => &mut self.degenerate,
            Outcome::Outside => &mut self.outside,
            Outcome::Whole => &mut self.drawn,
            Outcome::Cut => {
                self.clipped = self.clipped.wrapping_add(1);
                &mut self.drawn
            }
        };
        *field = field.wrapping_add(1);
    }

    /// Of so many faces, those that were not counted were turned away.
    pub(super) fn with_the_rest_culled(self, faces: usize) -> Self {
        // All of them are below 2³², and these among them.
        let rest = (faces as u32).wrapping_sub(self.drawn + self.outside + self.degenerate);
        Self { culled: rest, ..self }
    }

    /// Counts an edge that is not drawn, or cut first: of this place on the screen, and whether it was cut, or `None` when
    /// nothing is left. The others are [drawn](Self::with_the_rest_drawn).
    #[inline(always)]
    pub(super) fn count_edge<T>(&mut self, edge: Option<(T, bool)>) -> Option<T> {
        let Some((ends, cut)) = edge else {
            self.outside = self.outside.wrapping_add(1); // at most 2³²
            return None;
        };
        self.clipped = self.clipped.wrapping_add(cut.into());
        Some(ends)
    }

    /// Of so many edges, those that were not counted were drawn.
    pub(super) fn with_the_rest_drawn(self, edges: usize) -> Self {
        Self { drawn: (edges as u32).wrapping_sub(self.outside), ..self } // below 2³²
    }
}
