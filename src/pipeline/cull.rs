//! The one rule by which faces are culled: the sign of their area on the screen.

/// Which faces are culled, by their winding on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Culls back faces: right for closed meshes, whose back faces are hidden by front faces.
    #[default]
    Back,
    /// Culls nothing: both sides of each face are drawn.
    None,
}

/// Which way a face or a polygon is turned.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Facing {
    /// The face is turned towards the viewer, or back faces are not culled.
    Front,
    /// Without area: it covers no pixel.
    EdgeOn,
    /// Away from the viewer: a back face, to be culled.
    Away,
}

impl Cull {
    /// Which way a face with this signed area is turned: a positive area is counter-clockwise with y up.
    #[inline(always)]
    pub(super) fn facing(self, area: i64) -> Facing {
        // The sign decides for most faces, so the test for zero comes last.
        if area < 0 {
            if self == Self::Back {
                return Facing::Away;
            }
        } else if area == 0 {
            return Facing::EdgeOn;
        }
        Facing::Front
    }
}
