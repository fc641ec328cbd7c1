//! What there was to do in a frame: the host draws it and looks.

use super::watch::Watch;
use super::{Case, Way};
use crate::scene::{BACKGROUND, LINE};
use core::cell::Cell;
use embedded_graphics_core::geometry::Size;
use pinhole::Placed;

/// Of one frame. *Faces* are edges where lines are drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    pub vertices: u32,
    pub faces: u32,
    pub drawn: u32,
    /// With a corner that must be clipped: drawn or not.
    pub clipped: u32,
    /// Drawn in part.
    pub cut: u32,
    /// Of faces within [`SMALL`] pixels, and of larger ones.
    pub rows: [u32; 2],
    pub pixels: u32,
    /// Of the picture: these are cleared.
    pub area: u32,
    pub bands: u32,
    /// Faces that a band meets, over all bands.
    pub met: u32,
}

/// Of so many columns and rows or fewer most take a shorter way: those within about half as many, `src/raster/mod.rs`.
const SMALL: u32 = 64;

/// What [`Work::counts`] has.
pub const fn names(way: Way) -> &'static [&'static str] {
    match way {
        Way::Lines => &[
            "frame",
            "vertex",
            "edge drawn",
            "edge to be clipped",
            "pixel of a line",
            "pixel of the picture",
        ],
        Way::Faces | Way::Depth | Way::Facing | Way::FacingDepth => &[
            "frame",
            "vertex",
            "face left out",
            "face drawn",
            "face to be clipped",
            "face cut",
            "row of a face",
            "row of a large face",
            "pixel of a face",
            "pixel of the picture",
        ],
        Way::Bands(_) => &[
            "frame",
            "vertex",
            "face",
            "face to be clipped",
            "face cut",
            "row of a face",
            "row of a large face",
            "pixel of a face",
            "pixel of the picture",
            "band",
            "face in a band",
        ],
    }
}

impl Work {
    /// For [`names`].
    pub fn counts(&self, way: Way) -> Vec<f64> {
        let Self { vertices, faces, drawn, clipped, cut, rows, pixels, area, bands, met } = *self;
        let [small, large] = rows;
        let counts = match way {
            Way::Lines => vec![1, vertices, drawn, clipped, pixels, area],
            Way::Faces | Way::Depth | Way::Facing | Way::FacingDepth => {
                vec![1, vertices, faces - drawn, drawn, clipped, cut, small, large, pixels, area]
            }
            Way::Bands(_) => {
                vec![1, vertices, faces, clipped, cut, small, large, pixels, area, bands, met]
            }
        };
        counts.into_iter().map(f64::from).collect()
    }

    /// With rows as one guesses them who knows pixels and faces alone.
    #[must_use]
    pub fn guessed(self, rows_of_root: f64) -> Self {
        let Self { drawn, pixels, .. } = self;
        let rows = (rows_of_root * (f64::from(drawn) * f64::from(pixels)).sqrt()).round() as u32;
        // A face as wide as high.
        let large = rows > drawn * SMALL;
        Self { rows: if large { [0, rows] } else { [rows, 0] }, ..self }
    }
}

impl Case {
    pub fn work(&self, way: Way) -> Option<Work> {
        let scene = self.scene()?;
        let placed = scene.place().with_cull(self.cull);
        let [width, height] = self.size;
        let rows = match way {
            Way::Bands(rows) => rows,
            _ => height,
        };
        let large = Cell::new((0, false));
        let mut all = Watch::new(Size::new(width, height), rows, &large);
        let mesh = placed.mesh();
        let asked = Cell::new(0);
        let hidden = |&vertex: &u16| placed.project(vertex.into()).is_none();
        let (statistics, faces, clipped) = match way {
            Way::Lines => {
                let clipped = mesh.edges().iter().filter(|edge| edge.iter().any(hidden)).count();
                let Ok(statistics) = placed.wireframe(LINE, &mut [], &mut all);
                (statistics, mesh.edges().len(), clipped)
            }
            _ => {
                let shade = |face: usize| {
                    large.set((face, is_large(&placed, face)));
                    let face = mesh.faces().get(face).copied().unwrap_or_default();
                    asked.set(asked.get() + usize::from(face.iter().any(hidden)));
                    BACKGROUND
                };
                // By planes, those turned away are not looked at.
                let (statistics, clipped) = if way.asks_planes() {
                    let Ok(statistics) = placed.facing().solid(shade, &mut [], &mut all);
                    (statistics, asked.get() + statistics.outside as usize)
                } else {
                    let Ok(statistics) = placed.solid(shade, &mut [], &mut all);
                    (statistics, mesh.faces().iter().filter(|face| face.iter().any(hidden)).count())
                };
                (statistics, mesh.faces().len(), clipped)
            }
        };
        Some(Work {
            vertices: mesh.vertices().len() as u32,
            faces: faces as u32,
            drawn: statistics.drawn,
            clipped: clipped as u32,
            cut: statistics.clipped,
            rows: all.runs,
            pixels: all.pixels,
            area: width * height,
            bands: height.div_ceil(rows),
            met: all.met,
        })
    }
}

/// Whether a face is larger than [`SMALL`]; one that must be clipped counts as large.
fn is_large(placed: &Placed<'_>, face: usize) -> bool {
    let corners = placed.mesh().faces().get(face).copied().unwrap_or_default();
    let [Some(a), Some(b), Some(c)] = corners.map(|vertex| placed.project(vertex.into())) else {
        return true;
    };
    let over = |[a, b, c]: [i32; 3]| a.max(b).max(c) - a.min(b).min(c) > SMALL as i32 * 256;
    over([a, b, c].map(|(point, _)| point.x())) || over([a, b, c].map(|(point, _)| point.y()))
}
