//! The one rule by which faces are culled: the sign of their area on the screen.

/// Which faces are culled by their winding on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Back faces: right for closed meshes.
    #[default]
    Back,
    /// No face: both sides of a face are drawn.
    None,
}

/// How a face or a polygon turns on the screen.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Facing {
    /// To be drawn.
    Front,
    /// Without area: it covers no pixel.
    EdgeOn,
    /// Turned away from the viewer, and culled for that.
    Away,
}

impl Cull {
    /// How a face with this signed area turns: positive areas are counter-clockwise with y up.
    #[inline(always)]
    pub(super) fn facing(self, area: i64) -> Facing {
        // Most faces are in front or away, which the sign alone tells: zero comes last.
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
