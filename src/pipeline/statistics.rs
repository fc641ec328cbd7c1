//! Statistics: how many primitives a draw call drew, culled and clipped.

/// What the pipeline does with a face.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// With the side turned to the viewer that is culled.
    Culled,
    /// Without area on the screen.
    Degenerate,
    /// Outside the view volume: clipping leaves nothing of it.
    Outside,
    /// Drawn with its own three corners.
    Unclipped,
    /// Clipped, and drawn as a polygon.
    Clipped,
}

impl Outcome {
    #[inline(always)]
    pub(super) fn is_drawn(self) -> bool {
        matches!(self, Self::Unclipped | Self::Clipped)
    }
}

/// How many primitives (faces, edges or points) a draw call drew, and why it did not draw the others.
/// Each primitive is counted in exactly one of `drawn`, `culled`, `outside` and `degenerate`; `clipped` counts the drawn
/// primitives that were clipped.
///
/// *Drawn* means passed to the rasteriser. A drawn face need not cover a pixel: it may lie between pixel centres, or beside the
/// target.
///
/// ```
/// use pinhole::draw::Statistics;
/// let [cube, ball] = [4, 9].map(|drawn| Statistics { drawn, culled: 2 * drawn, ..Statistics::default() });
/// let both = cube + ball; // sums saturate
/// assert_eq!((both.drawn, both.culled, both.outside), (13, 26, 0));
/// let many = Statistics { drawn: u32::MAX - 4, ..both };
/// assert_eq!((both + many).drawn, u32::MAX);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Statistics {
    /// Faces, edges or points passed to the rasteriser, whole or clipped.
    pub drawn: u32,
    /// Back faces, or the faces that [`Cull`](crate::draw::Cull) names.
    pub culled: u32,
    /// Clipped at the near plane, the far plane or the guard band, and drawn; also counted in `drawn`.
    pub clipped: u32,
    /// Outside: clipping at the near plane, the far plane and the guard band leaves nothing.
    pub outside: u32,
    /// Faces without area on the screen.
    pub degenerate: u32,
}

impl core::ops::Add for Statistics {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            drawn: self.drawn.saturating_add(other.drawn),
            culled: self.culled.saturating_add(other.culled),
            clipped: self.clipped.saturating_add(other.clipped),
            outside: self.outside.saturating_add(other.outside),
            degenerate: self.degenerate.saturating_add(other.degenerate),
        }
    }
}

impl Statistics {
    pub(super) const NONE: Self = Self { drawn: 0, culled: 0, clipped: 0, outside: 0, degenerate: 0 };

    /// Counts a face.
    #[inline(always)]
    pub(super) fn count(&mut self, outcome: Outcome) {
        // A slice on a 32-bit core has fewer than 2³² faces, so no count wraps.
        let field = match outcome {
            Outcome::Culled => &mut self.culled,
            Outcome::Degenerate => &mut self.degenerate,
            Outcome::Outside => &mut self.outside,
            Outcome::Unclipped => &mut self.drawn,
            Outcome::Clipped => {
                self.clipped = self.clipped.wrapping_add(1);
                &mut self.drawn
            }
        };
        *field = field.wrapping_add(1);
    }

    /// Completes the counts of a mesh of `faces` faces: each face that was not counted is culled. So a culled face, a
    /// common case, costs no instruction.
    pub(super) fn with_the_rest_culled(self, faces: usize) -> Self {
        // Each count is below 2³², and so is their sum.
        let rest = (faces as u32).wrapping_sub(self.drawn + self.outside + self.degenerate);
        Self { culled: rest, ..self }
    }

    /// Counts an edge that clipping removed or shortened, and returns its ends on the screen. `edge`: the ends, and whether
    /// clipping shortened the edge; `None` if nothing is left of it. [`with_the_rest_drawn`](Self::with_the_rest_drawn) counts
    /// the drawn edges.
    #[inline(always)]
    pub(super) fn count_edge<T>(&mut self, edge: Option<(T, bool)>) -> Option<T> {
        let Some((ends, cut)) = edge else {
            self.outside = self.outside.wrapping_add(1); // at most 2³²
            return None;
        };
        self.clipped = self.clipped.wrapping_add(cut.into());
        Some(ends)
    }

    /// Completes the counts of a mesh of `edges` edges: each edge that was not counted as outside is drawn.
    pub(super) fn with_the_rest_drawn(self, edges: usize) -> Self {
        Self { drawn: (edges as u32).wrapping_sub(self.outside), ..self } // below 2³²
    }
}
