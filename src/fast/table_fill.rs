//! A colour for each level of light, and light that runs over a triangle.

use super::depth_fill::{as_long, nothing_is_held, DepthFill, RowFill, MANY};
use super::RowOrigin;
use crate::fast;
use crate::math::num::CORTEX_M0;
use crate::raster::{DepthTriangle, Gradient, Span, Triangle};
use crate::surface::StoredPixel;
use core::hint::black_box;
use core::iter::repeat_with;
use embedded_graphics_core::pixelcolor::PixelColor;

/// A colour for each of 256 levels of light, and the light at a triangle's corners in 8.10.
#[derive(Debug)]
pub struct Shades<'t, C> {
    pub(crate) colours: &'t [C; 256],
    pub(crate) light: [i32; 3],
}

impl<'t, C: PixelColor> Shades<'t, C> {
    /// Over a triangle.
    pub(crate) fn over(&self, triangle: &Triangle<'_>) -> Shade<'t, C> {
        Shade { colours: self.colours, light: Gradient::of_light(triangle, &self.light) }
    }
}

/// Light over a triangle, and the colours to look up.
#[derive(Debug)]
pub struct Shade<'t, C> {
    colours: &'t [C; 256],
    light: Gradient,
}

impl<C: PixelColor> Shade<'_, C> {
    /// The colours of a row from a covered pixel on.
    #[inline(always)]
    pub(crate) fn run(&self, Span { x, y, .. }: Span) -> impl Iterator<Item = C> + use<'_, C> {
        let (mut light, step) = (self.light.at(x, y), self.light.step());
        repeat_with(move || {
            let colour = look_up(self.colours, light);
            light = light.wrapping_add(step);
            colour
        })
    }
}

#[inline(always)]
fn look_up<C: Copy>(colours: &[C; 256], light: u32) -> C {
    let [level, ..] = light.to_be_bytes();
    colours[usize::from(level)] // of 256 there is one
}

impl<C: StoredPixel<Cell>, Cell: Copy> DepthFill<Cell> for &Shades<'_, C> {
    type Over = [Gradient; 2];

    #[inline(always)]
    fn over(self, piece: &DepthTriangle<'_>) -> [Gradient; 2] {
        fast::depth_and_light_gradients(&piece.triangle, &piece.depths, &self.light)
    }

    #[inline(always)]
    fn rows<'a>(
        self,
        over: &'a mut [Gradient; 2],
        cells: &'a mut [Cell],
        held: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
        Self: 'a,
    {
        let (cells, held) = as_long(cells, held);
        *over = over.map(|plane| plane.sheared(shear));
        let [depth, light] = &*over;
        let ramp = Ramp { colours: self.colours, step: depth.step(), dim: light.step() };
        Looked { ramp, cells, held, over, z: depth.at(x, y), light: light.at(x, y) }
    }
}

/// Rows of colours that are looked up.
struct Looked<'a, C, Cell> {
    ramp: Ramp<'a, C>,
    cells: &'a mut [Cell],
    held: &'a mut [u16],
    over: &'a [Gradient; 2],
    /// Where the next row is counted from.
    z: u32,
    light: u32,
}

impl<C: StoredPixel<Cell>, Cell> RowFill for Looked<'_, C, Cell> {
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let (from, width) = (start.wrapping_add(left as usize), right.wrapping_sub(left));
        if width > 0 {
            if width < MANY as i32 {
                self.short(from, left, width as usize);
            } else {
                self.long(from, left, width as usize);
            }
        }
        let [depth, light] = self.over;
        self.z = self.z.wrapping_add(depth.row_step());
        self.light = self.light.wrapping_add(light.row_step());
    }
}

impl<C: StoredPixel<Cell>, Cell> Looked<'_, C, Cell> {
    /// A row's cells, their depths, and depth and light where it begins.
    #[inline(always)]
    fn part(&mut self, from: usize, left: i32, width: usize) -> Option<(&mut [Cell], &mut [u16], u32, u32)> {
        let (run, held) = (part_of(self.cells, from, width)?, part_of(self.held, from, width)?);
        let z = self.z.wrapping_add(self.ramp.step.wrapping_mul(left as u32));
        let light = self.light.wrapping_add(self.ramp.dim.wrapping_mul(left as u32));
        Some((run, held, z, light))
    }

    /// Fewer than [`MANY`] pixels. All that it needs lies in memory: a call costs little, and it has all registers.
    #[inline(never)]
    fn short(&mut self, from: usize, left: i32, width: usize) {
        let ramp = Ramp { ..self.ramp };
        if let Some((run, held, z, light)) = self.part(from, left, width) {
            let (_, run) = run.as_chunks_mut::<MANY>(); // all of it: so the compiler sees how short it is
            ramp.few(run, held, z, light);
        }
    }

    /// The same of more.
    #[inline(never)]
    fn long(&mut self, from: usize, left: i32, width: usize) {
        let ramp = Ramp { ..self.ramp };
        if let Some((run, held, z, light)) = self.part(from, left, width) {
            ramp.many(run, held, z, light);
        }
    }
}

/// So many from this one on, if there are.
#[inline(always)]
fn part_of<T>(all: &mut [T], from: usize, width: usize) -> Option<&mut [T]> {
    if CORTEX_M0 {
        // Of tests that lead to the same place the compiler would make one number, and test that: five instructions more each.
        let part = all.get_mut(from..)?;
        black_box(());
        let part = part.get_mut(..width)?;
        black_box(());
        return Some(part);
    }
    all.get_mut(from..from.wrapping_add(width)) // before from where it wraps
}

/// Colours, and the steps from a pixel to the next one.
struct Ramp<'a, C> {
    colours: &'a [C; 256],
    step: u32,
    dim: u32,
}

impl<C> Ramp<'_, C> {
    #[inline(always)]
    fn few<Cell>(&self, run: &mut [Cell], held: &mut [u16], mut z: u32, mut light: u32) -> (u32, u32)
    where
        C: StoredPixel<Cell>,
    {
        for (pixel, held) in run.iter_mut().zip(held) {
            if z >> 16 < u32::from(*held) {
                *held = (z >> 16) as u16;
                *pixel = look_up(self.colours, light).stored();
            }
            (z, light) = (z.wrapping_add(self.step), light.wrapping_add(self.dim));
            black_box(()); // unrolled only where there are few
        }
        (z, light)
    }

    /// Many pixels at a time where nothing is held yet, as is so of most.
    #[inline(always)]
    fn many<Cell>(&self, run: &mut [Cell], held: &mut [u16], mut z: u32, mut light: u32)
    where
        C: StoredPixel<Cell>,
    {
        // They are as long; here that is said.
        let Some(held) = held.get_mut(..run.len()) else { return };
        let ((many, rest), (held_many, held_rest)) =
            (run.as_chunks_mut::<MANY>(), held.as_chunks_mut::<MANY>());
        for (pixels, held) in many.iter_mut().zip(held_many) {
            if nothing_is_held(held) {
                for (pixel, held) in pixels.iter_mut().zip(held) {
                    *held = (z >> 16) as u16;
                    *pixel = look_up(self.colours, light).stored();
                    (z, light) = (z.wrapping_add(self.step), light.wrapping_add(self.dim));
                }
            } else {
                // Loaded anew: the way above needs the registers.
                (z, light) = self.few(pixels, black_box(held), z, light);
            }
            black_box(()); // not unrolled
        }
        self.few(rest, held_rest, z, light);
    }
}
