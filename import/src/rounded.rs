//! The surface on the grid: positions that rounding made equal are welded, too.

use crate::exact::Exact;
use crate::grid::Grid;
use crate::model::{Places, TextureFaces};
use crate::normals::cross;
use crate::parts::reversed;
use crate::surface::{key, Surface};
use crate::weld::{weld, Key, Welded};
use crate::{Options, Problem, Warning};

/// What rounding did.
pub(crate) struct Rounded {
    pub(crate) grid: Grid,
    /// Its sources are faces of the exact surface; its own are in the [`Surface`].
    pub(crate) welded: Welded,
    /// Two for each line.
    pub(crate) ends_of_lines: Vec<[i16; 3]>,
    /// The largest error of a coordinate.
    pub(crate) error: f64,
    /// The area of all faces, as a fraction of that before.
    area: f64,
}

impl Rounded {
    /// Rounds a surface to the grid, and looks up the texture coordinates of its faces.
    pub(crate) fn of(
        exact: &Exact,
        texture: Option<&TextureFaces>,
        options: &Options,
    ) -> Result<(Self, Surface), Problem> {
        let (faces, positions) = (&exact.welded.faces, &exact.positions);
        let grid = Grid::around(positions, options)?;
        let mut rounded = grid.round(positions);
        let error = positions.iter().zip(&rounded).map(|(p, r)| grid.error(p, r)).fold(0.0, f64::max);
        let ends_of_lines = rounded.split_off(exact.welded.vertices.len());

        let keys: Vec<Key> = rounded.iter().map(key).collect();
        let vertex = |key: Key| key.map(|c| c as i16); // that of the key
        let is_flat = |corners: [Key; 3]| cross(corners.map(vertex)) == [0, 0, 0];
        let mut welded = weld(&keys, faces, &|key| vertex(key).map(f64::from), &is_flat);
        if welded.faces.is_empty() && ends_of_lines.is_empty() {
            return Err(Problem::TooThin { faces: faces.len(), finer: grid.finer });
        }

        let on_grid = faces.iter().map(|face| face.map(|vertex| rounded[vertex].map(f64::from)));
        let in_file = faces.iter().map(|face| face.map(|vertex| grid.in_steps(&positions[vertex])));
        let area = area(on_grid) / area(in_file);

        let coords = |(face, &source): (usize, &usize)| {
            let TextureFaces { coords, faces } = texture?;
            let of_triangle = faces[exact.welded.sources[source]];
            let of_triangle = of_triangle.map(|i| coords.get(i).copied().unwrap_or_default());
            let coords = exact.welded.values(source, of_triangle);
            Some(welded.values(face, if options.flip { reversed(coords) } else { coords }))
        };
        let surface = Surface {
            vertices: welded.vertices.iter().map(|&v| rounded[v]).collect(),
            triangles: welded.sources.iter().map(|&face| exact.welded.sources[face]).collect(),
            coords: welded.sources.iter().enumerate().filter_map(coords).collect(),
            faces: std::mem::take(&mut welded.faces),
            lines: Vec::new(),
        };
        Ok((Rounded { grid, welded, ends_of_lines, error, area }, surface))
    }

    /// The triangles that were dropped before rounding and after it, and whether the grid is too coarse for the shape.
    pub(crate) fn warnings(&self, exact: &Exact, places: &Places) -> Vec<Warning> {
        let (before, after) = (&exact.welded, &self.welded);
        let dropped = |before: &[usize], after: &[usize]| {
            let after = after.iter().map(|&face| exact.welded.sources[face]);
            let triangles = before.iter().copied().chain(after);
            triangles.clone().min().map(|first| (triangles.count(), places.of(first)))
        };
        let no_area = dropped(&before.degenerate, &after.degenerate);
        let duplicates = dropped(&before.duplicate, &after.duplicate);
        let (lost, faces) = (after.degenerate.len(), before.faces.len());
        let is_coarse = faces > 0 && (10 * lost >= faces || !(0.9..=1.1).contains(&self.area));
        let area = (100.0 * self.area).round() as u32;
        let warnings = vec![
            no_area.map(|(count, first)| Warning::NoArea { count, first }),
            duplicates.map(|(count, first)| Warning::Duplicates { count, first }),
            is_coarse.then_some(Warning::Coarse { lost, faces, area, finer: self.grid.finer }),
        ];
        warnings.into_iter().flatten().collect()
    }
}

/// Twice the area of triangles.
fn area(triangles: impl Iterator<Item = [[f64; 3]; 3]>) -> f64 {
    let area = |[a, b, c]: [[f64; 3]; 3]| {
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let ([ux, uy, uz], [vx, vy, vz]) = (side(b), side(c));
        (uy * vz - uz * vy).hypot(uz * vx - ux * vz).hypot(ux * vy - uy * vx)
    };
    triangles.map(area).sum()
}
