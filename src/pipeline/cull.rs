//! The one rule by which faces are culled: the sign of their area on the screen.

/// Which faces are culled, by their winding on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Culls back faces: right for closed meshes, whose back faces are hidden by front faces.
    #[default]
    Back,
    /// Culls front faces, so that only the inside of a closed mesh is drawn: the first of two draw calls for glass, whose back
    /// faces show through its front faces ([`Translucent`](crate::shading::Translucent)).
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
        // The sign first: it decides for most faces, and comparing it costs less than reading the rule.
        match area {
            ..0 if self == Self::Back => Facing::Culled,
            1.. if self == Self::Front => Facing::Culled,
            0 => Facing::EdgeOn,
            _ => Facing::Drawn,
        }
    }
}
