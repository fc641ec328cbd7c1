//! The surface before rounding: equal positions are welded; then it is turned, scaled and, on request, decimated.

use crate::edges::Sides;
use crate::grid::{extent, Grid};
use crate::normals::on_one_line;
use crate::parts::{reversed, Parts};
use crate::weld::{weld, Key, Welded};
use crate::{decimate, Axis, Options, Problem, Triangles, Warning};

pub(crate) struct Exact {
    /// How many vertices and triangles the file has.
    pub(crate) read: [usize; 2],
    /// Its sources are triangles of the file, or [`NOWHERE`](crate::model::NOWHERE) after decimation.
    pub(crate) welded: Welded,
    /// The positions of the welded vertices, and then of the two ends of each line.
    pub(crate) positions: Vec<[f64; 3]>,
    /// By what the file's units are multiplied.
    pub(crate) scale: f64,
    /// Faces taken away by decimation, and an estimate of how far the surface moved; it makes other faces even if it takes none away.
    pub(crate) decimated: Option<(usize, f64)>,
}

impl Exact {
    /// Welds equal positions, and leaves out triangles without area: they must not influence the grid either.
    pub(crate) fn weld(read: Triangles, lines: Vec<[[f64; 3]; 2]>) -> Result<Self, Problem> {
        let Triangles { positions, faces } = read;
        // Adding 0.0 makes one of the two zeros.
        let bits: Vec<Key> = positions.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
        let position = |p: Key| p.map(f64::from_bits);
        let welded = weld(&bits, &faces, &position, &|corners| on_one_line(corners.map(position)));
        drop(bits);
        if welded.faces.is_empty() && lines.is_empty() {
            return Err(Problem::NoArea(faces.len()));
        }
        let read = [positions.len(), faces.len()];
        let of_faces = welded.vertices.iter().map(|&vertex| positions[vertex]);
        let positions = of_faces.chain(lines.into_iter().flatten()).collect();
        Ok(Exact { read, welded, positions, scale: 1.0, decimated: None })
    }

    /// Turns, scales and reverses the surface, as the options say.
    pub(crate) fn place(&mut self, up: Axis, options: &Options) -> Result<(), Problem> {
        self.scale = options.fit.map_or(1.0, |side| side / extent(&self.positions));
        for position in &mut self.positions {
            *position = up.to_y(*position).map(|c| c * self.scale);
        }
        if self.scale == 0.0 || self.positions.iter().flatten().any(|c| !c.is_finite()) {
            return Err(Problem::Options("the length to fit and the model's are too far apart"));
        }
        if options.flip {
            self.welded.faces.iter_mut().for_each(|face| *face = reversed(*face));
        }
        Ok(())
    }

    /// Reduces the surface to about `wanted` triangles; a warning, if more are left.
    pub(crate) fn decimate(&mut self, wanted: usize, options: &Options) -> Result<Option<Warning>, Problem> {
        let Exact { welded, positions, .. } = self;
        let ends_of_lines = positions.split_off(welded.vertices.len());
        if options.fix_winding {
            // meshopt takes an edge between faces of opposite winding for a border, and keeps it.
            let vertices = Grid::around(positions, options)?.round(positions);
            let parts = Parts::of(&welded.faces, &vertices, &Sides::of(&welded.faces));
            let faces = welded.faces.iter_mut().enumerate();
            let wrong = faces.filter(|(face, _)| parts.is_wrong(*face));
            wrong.for_each(|(_, corners)| *corners = reversed(*corners));
        }
        self.decimated = Some(decimate::decimate(welded, positions, wanted)?);
        positions.extend(ends_of_lines);
        match welded.faces.len() {
            0 => Err(Problem::Options("decimation to so few triangles leaves none: allow more")),
            faces => Ok((faces > wanted).then_some(Warning::DecimatedLess { faces })),
        }
    }
}
