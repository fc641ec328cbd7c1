//! The cells of `docs/speed.md`, a firmware each: the name of the image that is built chooses one of the list.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Counted, Deep, Frame, Plain, Smooth, CUBE, ICO, TORUS};
use bench::position;

/// A firmware of the list, by its number there.
struct Image<const N: usize>;

trait Cell {
    type Memory;
    fn draw(memory: &mut Self::Memory) -> Option<Counted>;
}

macro_rules! cells {
    ($($name:literal: $memory:ty, $draw:path;)*) => {
        const NAMES: &[&str] = &[$($name),*];
        $(impl Cell for Image<{ position($name, NAMES) }> {
            type Memory = $memory;

            #[inline(always)] // as if the firmware called the function itself
            fn draw(memory: &mut $memory) -> Option<Counted> {
                $draw(memory)
            }
        })*
    };
}

cells! {
    // The start, the count of a frame in which nothing is drawn, and the end: in every cell.
    "cell_empty": Frame, cells::empty;
    // S1: the cube's edges. S2: the cube, a colour for each face.
    "cell_s1": Plain<CUBE>, cells::s1;
    "cell_s2": Plain<CUBE>, cells::s2;
    "cell_s2_z": Deep<CUBE>, cells::s2_z;
    // S3: the torus, S4: the icosphere, a colour for each face; also without early culling by face planes.
    "cell_s3": Plain<TORUS>, cells::s3;
    "cell_s3_no_planes": Plain<TORUS>, cells::s3_no_planes;
    "cell_s3_z": Deep<TORUS>, cells::s3_z;
    "cell_s3_z_no_planes": Deep<TORUS>, cells::s3_z_no_planes;
    "cell_s4": Plain<ICO>, cells::s4;
    "cell_s4_no_planes": Plain<ICO>, cells::s4_no_planes;
    "cell_s4_z": Deep<ICO>, cells::s4_z;
    "cell_s4_z_no_planes": Deep<ICO>, cells::s4_z_no_planes;
    // S5: one triangle over the whole picture. S6: a thousand lines. S7: a thousand triangles.
    "cell_s5": Frame, cells::s5;
    "cell_s6": Frame, cells::s6;
    "cell_s7": Frame, cells::s7;
    // S8: the torus, smooth, with depth.
    "cell_s8_z": Smooth<TORUS>, cells::s8_z;
    "cell_s8_z_no_planes": Smooth<TORUS>, cells::s8_z_no_planes;
}

type Chosen = Image<{ position(env!("CARGO_BIN_NAME"), NAMES) }>;

bench::cell!(<Chosen as Cell>::Memory, Chosen::draw);
