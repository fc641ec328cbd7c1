//! F1: a height field of 64 × 64 vertices, with two waves: its heights and the light at each vertex are computed in each frame. Light
//! between vertices by a shade table, with depth; 7938 faces, most of a few pixels.

use super::banded::{count_bands, Strip};
use super::{count, draw_faces, Counted, Deep, Memory};
use crate::bands::{self, bytes, pixels};
use crate::scene::{area, View};
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::{Rgb565, Rgb888};
use pinhole::prelude::*;
use pinhole::space::{Model, World};

/// Vertices along a side.
const SIDE: usize = 64;
const VERTICES: usize = SIDE * SIDE;
const FACES: usize = 2 * (SIDE - 1) * (SIDE - 1);

static INDICES: [[u16; 3]; FACES] = {
    let (mut faces, mut quad) = ([[0; 3]; FACES], 0);
    while quad < FACES / 2 {
        let a = (quad / (SIDE - 1) * SIDE + quad % (SIDE - 1)) as u16;
        let [b, c, d] = [a + 1, a + 1 + SIDE as u16, a + SIDE as u16];
        (faces[2 * quad], faces[2 * quad + 1]) = ([a, b, c], [a, c, d]);
        quad += 1;
    }
    faces
};

/// The field, and memory to draw it into.
pub struct Field<M> {
    heights: Heights,
    target: M,
}

pub type Whole = Field<Deep<VERTICES>>;
pub type Banded = Field<Strip<{ bytes(8) }, { pixels(8) }, { FACES + FACES.div_ceil(16) + 32 }, VERTICES>>;

struct Heights {
    vertices: [[i16; 3]; VERTICES],
    levels: [u16; VERTICES],
}

/// From the side and above, 7.2 units from the middle of a field of 4 × 4 units.
const VIEW: View = View {
    ahead: [-9_830, -19_661, 0],
    degrees: 41,
    range: [2 << 16, 14 << 16],
    ..View::new([170_394, 288_358, 340_787], area().size)
};

/// Two parabolas for a sine: −512 … 512, with a period of 256.
fn wave(phase: usize) -> i16 {
    let (half, at) = (phase & 128, (phase & 127) as i16);
    let height = at * (128 - at) / 8;
    if half == 0 {
        height
    } else {
        -height
    }
}

impl Heights {
    const NEW: Self = Self { vertices: [[0; 3]; VERTICES], levels: [0; VERTICES] };

    /// The field of the next frame, in 2⁻¹⁰, and its light.
    #[inline(never)]
    fn next(&mut self) -> Option<(Mesh<'_>, &[u16])> {
        let time = black_box(5); // a part of a period
        for (index, vertex) in self.vertices.iter_mut().enumerate() {
            let [x, y] = [index % SIDE, index / SIDE];
            let height = wave(9 * x + 4 * y + time) / 2 + wave(7 * y + time) / 3;
            *vertex = [64 * (x as i16 - 32), height, 64 * (32 - y as i16)];
        }
        for (index, level) in self.levels.iter_mut().enumerate() {
            let [x, y] = [index % SIDE, index / SIDE];
            let height = |x: usize, y: usize| self.vertices[y.min(SIDE - 1) * SIDE + x.min(SIDE - 1)][1];
            let along = height(x.saturating_sub(1), y) - height(x + 1, y);
            let across = height(x, y.saturating_sub(1)) - height(x, y + 1);
            *level = (150 + along / 2 + across / 3).clamp(0, 256) as u16;
        }
        Some((Mesh::new(&self.vertices, -10, &INDICES).ok()?, &self.levels))
    }
}

impl Whole {
    pub const NEW: Self = Self { heights: Heights::NEW, target: Memory::NEW };

    pub(super) fn whole(&mut self) -> Option<Counted> {
        let Self { heights, target: Memory { frame, depth, corners } } = self;
        let (camera, table) =
            (VIEW.camera()?, ShadeTable::<Rgb565>::new(black_box(Rgb888::new(60, 140, 220))));
        count(frame, &mut |picture| {
            let (mesh, levels) = heights.next()?;
            let instance = camera.place(&mesh, &Affine::<Model, World>::identity());
            let shade = |face| table.lit(mesh.corners_of(face, levels));
            draw_faces(instance.faces(shade).cached(corners), depth, &mut picture.pixels())
        })
    }
}

impl Banded {
    pub const NEW: Self = Self { heights: Heights::NEW, target: Strip::NEW };

    pub(super) fn banded(&mut self) -> Option<Counted> {
        let Self { heights, target: strip } = self;
        let (camera, table) =
            (VIEW.camera()?, ShadeTable::<Rgb565>::new(black_box(Rgb888::new(60, 140, 220))));
        count_bands(&mut |display| {
            let (mesh, levels) = heights.next()?;
            let instance = camera.place(&mesh, &Affine::<Model, World>::identity());
            let shade = |face| table.lit(mesh.corners_of(face, levels));
            bands::depth(&instance, shade, area().size, strip.storage(), |band| {
                display.take_bytes(band.bytes())
            })
        })
    }
}
