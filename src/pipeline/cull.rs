//! The one rule by which faces are culled: the sign of their area on the screen.

/// Which faces are culled, by their winding on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Culls back faces: right for closed meshes, whose back faces are hidden by front faces.
    #[default]
    Back,
    /// Culls front faces, so that only the inside of a closed mesh is drawn: the first of two draw calls for glass, whose back
    /// faces show through its front faces ([`Translucent`](crate::Translucent)).
    Front,
    /// Culls nothing: both sides of each face are drawn.
    None,
}

/// Which way a face or a polygon is turned.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Facing {
    /// The face has a side that is drawn turned to the viewer.
    Drawn,
    /// Without area: it covers no pixel.
    EdgeOn,
    /// The face has the side turned to the viewer that is culled.
    Culled,
}

impl Cull {
    /// Which way a face with this signed area is turned: a positive area is counter-clockwise with y up.
    #[inline(always)]
    pub(super) fn facing(self, area: i64) -> Facing {
        let is_culled = match self {
            Self::Back => area < 0,
            Self::Front => area > 0,
            Self::None => false,
        };
        // The sign decides for most faces, so the test for zero comes last.
        match area {
            _ if is_culled => Facing::Culled,
            0 => Facing::EdgeOn,
            _ => Facing::Drawn,
        }
    }
}
