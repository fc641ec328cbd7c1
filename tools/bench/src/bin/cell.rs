//! The cells of `docs/speed.md`, a firmware each: the name of the image that is built chooses one of the list.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Counted, Deep, Frame, Plain, Smooth, CUBE, ICO, TORUS};
use bench::cells::{LineStrip8, Strip16, Strip16Deep, Strip8, Strip8Deep};
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
    // S3's edges.
    "cell_s3_wire": Plain<TORUS>, cells::s3_wire;
    // C1 and C2: the torus from near by.
    "cell_c1": Plain<TORUS>, cells::c1;
    "cell_c1_z": Deep<TORUS>, cells::c1_z;
    "cell_c1_wire": Plain<TORUS>, cells::c1_wire;
    "cell_c1_planes": Plain<TORUS>, cells::c1_planes;
    "cell_c1_planes_z": Deep<TORUS>, cells::c1_planes_z;
    "cell_c2": Plain<TORUS>, cells::c2;
    "cell_c2_z": Deep<TORUS>, cells::c2_z;
    "cell_c2_wire": Plain<TORUS>, cells::c2_wire;
    "cell_c2_planes": Plain<TORUS>, cells::c2_planes;
    "cell_c2_planes_z": Deep<TORUS>, cells::c2_planes_z;
    // T1: the turning cube. F50: fifty cubes before a moving camera.
    "cell_t1": Plain<CUBE>, cells::t1;
    "cell_f50": Plain<CUBE>, cells::f50;
    "cell_f50_z": Deep<CUBE>, cells::f50_z;
    "cell_f50_wire": Plain<CUBE>, cells::f50_wire;
    // Into a DrawTarget of the firmware's own.
    "cell_s1_dt": Plain<CUBE>, cells::s1_dt;
    "cell_s2_dt": Plain<CUBE>, cells::s2_dt;
    "cell_s2_dt_z": Deep<CUBE>, cells::s2_dt_z;
    "cell_s3_dt": Plain<TORUS>, cells::s3_dt;
    "cell_s3_dt_z": Deep<TORUS>, cells::s3_dt_z;
    "cell_s3_dt_wire": Plain<TORUS>, cells::s3_dt_wire;
    "cell_s5_dt": Frame, cells::s5_dt;
    // Anti-aliased: S1, S3's edges, at once, in bands and with a depth test, and S6.
    "cell_s1_smooth": Plain<CUBE>, cells::s1_smooth;
    "cell_s3_smooth": Plain<TORUS>, cells::s3_smooth;
    "cell_s3_smooth_bands8": LineStrip8, cells::s3_smooth_bands;
    "cell_s3_smooth_z": Deep<TORUS>, cells::s3_smooth_z;
    "cell_s6_smooth": Frame, cells::s6_smooth;
    "cell_s6_dt": Frame, cells::s6_dt;
    "cell_s7_dt": Frame, cells::s7_dt;
    "cell_s8_dt_z": Smooth<TORUS>, cells::s8_dt_z;
    // Textures on the torus, on a floor, on one that is rolled, and on one that reaches the horizon.
    "cell_x1": Plain<TORUS>, cells::x1;
    "cell_x1_z": Deep<TORUS>, cells::x1_z;
    "cell_x2": Plain<4>, cells::x2;
    "cell_x2_z": Deep<4>, cells::x2_z;
    "cell_x3": Plain<4>, cells::x3;
    "cell_x4": Plain<4>, cells::x4;
    "cell_x1_eighth": Plain<TORUS>, cells::x1_eighth;
    "cell_x1_sixteenth": Plain<TORUS>, cells::x1_sixteenth;
    "cell_x1_each": Plain<TORUS>, cells::x1_each;
    "cell_x1_every16": Plain<TORUS>, cells::x1_every16;
    "cell_x2_eighth": Plain<4>, cells::x2_eighth;
    "cell_x2_sixteenth": Plain<4>, cells::x2_sixteenth;
    "cell_x2_each": Plain<4>, cells::x2_each;
    "cell_x2_every16": Plain<4>, cells::x2_every16;
    "cell_x3_eighth": Plain<4>, cells::x3_eighth;
    "cell_x3_sixteenth": Plain<4>, cells::x3_sixteenth;
    "cell_x3_each": Plain<4>, cells::x3_each;
    "cell_x3_every16": Plain<4>, cells::x3_every16;
    "cell_x4_eighth": Plain<4>, cells::x4_eighth;
    "cell_x4_sixteenth": Plain<4>, cells::x4_sixteenth;
    "cell_x4_each": Plain<4>, cells::x4_each;
    "cell_x4_every16": Plain<4>, cells::x4_every16;
    // S5 blended in equal parts, and by an alpha.
    "cell_s5_half": Frame, cells::s5_half;
    "cell_s5_alpha": Frame, cells::s5_alpha;
    // The torus, a floor and the textured torus in fog by pixel. Fifty sprites.
    "cell_g1": Plain<TORUS>, cells::g1;
    "cell_g1_z": Deep<TORUS>, cells::g1_z;
    "cell_g2": Plain<4>, cells::g2;
    "cell_g2_z": Deep<4>, cells::g2_z;
    "cell_g3_z": Deep<TORUS>, cells::g3_z;
    "cell_b1_z": Deep<0>, cells::b1_z;
    // S3 in one piece with the clear of the picture, and in bands.
    "cell_s3_full": Plain<TORUS>, cells::s3_full;
    "cell_s3_full_z": Deep<TORUS>, cells::s3_full_z;
    "cell_s3_bands8": Strip8, cells::s3_bands;
    "cell_s3_bands8_z": Strip8Deep, cells::s3_bands_z;
    "cell_s3_bands16": Strip16, cells::s3_bands;
    "cell_s3_bands16_z": Strip16Deep, cells::s3_bands_z;
}

type Chosen = Image<{ position(env!("CARGO_BIN_NAME"), NAMES) }>;

bench::cell!(<Chosen as Cell>::Memory, Chosen::draw);
