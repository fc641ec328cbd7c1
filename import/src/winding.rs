//! The winding of faces: made consistent and given backs on request, and checked.

use crate::edges::Sides;
use crate::model::Places;
use crate::parts::Parts;
use crate::surface::Surface;
use crate::{Options, Topology, Warning};

pub(crate) struct Winding {
    /// The sides of all faces but backs.
    pub(crate) sides: Sides,
    parts: Parts,
    /// How many faces were reversed.
    pub(crate) reversed: usize,
    /// The faces, ascending, whose backs are the last faces of the surface.
    pub(crate) backs: Vec<usize>,
}

impl Winding {
    /// Winds the faces of a surface and adds backs, as the options say.
    pub(crate) fn of(surface: &mut Surface, options: &Options) -> Self {
        let mut sides = Sides::of(&surface.faces);
        let mut parts = Parts::of(&surface.faces, &surface.vertices, &sides);
        let mut reversed = 0;
        if options.fix_winding {
            for face in (0..surface.faces.len()).filter(|&face| parts.is_wrong(face)) {
                surface.reverse(face);
                reversed += 1;
            }
            sides.reverse(|face| parts.is_wrong(face));
            parts.set_right();
        }
        let backs = if options.two_sided { parts.seen_from_behind() } else { Vec::new() };
        backs.iter().for_each(|&face| surface.add_back(face));
        Winding { sides, parts, reversed, backs }
    }

    /// Where the surface is not closed, or faces are wound against each other or inwards.
    pub(crate) fn warnings(&self, surface: &Surface, places: &Places, is_flipped: bool) -> Vec<Warning> {
        let (Topology { open, crowded, twisted }, faults) =
            self.sides.topology(|face| surface.triangles[face]);
        let at = |triangle: Option<usize>| triangle.map(|triangle| places.of(triangle));
        let is_one_sided = self.parts.parts.iter().all(|part| part.is_one_sided == part.is_mixed);
        let (count, inside_out) = self.parts.inside_out();
        let inside_out = at(inside_out.map(|face| surface.triangles[face]));
        let parts = self.parts.parts.len();
        let warnings = vec![
            at(faults.open).map(|first| Warning::OpenEdges { count: open, first }),
            at(faults.crowded).map(|first| Warning::CrowdedEdges { count: crowded, first }),
            at(faults.twisted).map(|first| Warning::TwistedEdges { count: twisted, first, is_one_sided }),
            inside_out.map(|first| Warning::InsideOut { count, parts, first, is_flipped }),
        ];
        warnings.into_iter().flatten().collect()
    }
}
