//! Counts of what a draw call did with the primitives that it was given.

/// What becomes of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Turned away from the viewer.
    Culled,
    /// Without area on the screen.
    Degenerate,
    /// Wholly beyond one of the planes.
    Outside,
    /// Drawn with its own corners.
    Whole,
    /// Drawn as the polygon that planes leave of it.
    Cut,
}

impl Outcome {
    #[inline(always)]
    pub(super) fn is_drawn(self) -> bool {
        matches!(self, Self::Whole | Self::Cut)
    }
}

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

    /// Counts a face.
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

    /// These counts of a mesh of `faces` faces, where each face that was not counted was culled: so the common case, a face
    /// that is turned away, costs no instruction.
    pub(super) fn with_the_rest_culled(self, faces: usize) -> Self {
        // Each count is below 2³², and so is their sum.
        let rest = (faces as u32).wrapping_sub(self.drawn + self.outside + self.degenerate);
        Self { culled: rest, ..self }
    }

    /// Counts an edge that is cut or not drawn and passes on its ends: `edge` has the ends on the screen and whether the edge
    /// was cut, or is `None` when nothing is left of the edge. Edges that are not counted are
    /// [drawn](Self::with_the_rest_drawn).
    #[inline(always)]
    pub(super) fn count_edge<T>(&mut self, edge: Option<(T, bool)>) -> Option<T> {
        let Some((ends, cut)) = edge else {
            self.outside = self.outside.wrapping_add(1); // at most 2³²
            return None;
        };
        self.clipped = self.clipped.wrapping_add(cut.into());
        Some(ends)
    }

    /// These counts of a mesh of `edges` edges, where each edge that was not counted was drawn.
    pub(super) fn with_the_rest_drawn(self, edges: usize) -> Self {
        Self { drawn: (edges as u32).wrapping_sub(self.outside), ..self } // below 2³²
    }
}
