//! Back faces that the near plane cuts, culled before they are clipped.
//!
//! - **Plain twin**: clipping the face, then `Fan::begin` in `pipeline/face_triangles.rs`, which culls by the area that is left
//!   on the screen.
//! - **Domain**: only the near plane cuts the face, its other corners are on the screen, and its side is beyond doubt: it is not
//!   nearly edge-on, two of its edges reach over 4 pixels, and its corners behind the near plane are at most 8 times as far from
//!   that plane as those before it. What clipping leaves of such a face is no sliver that rounding could turn over.
//! - **Gain**: instructions of a frame, against a twin that always declines: C1 12 % on an M3 and an M0, with depth 8 % and 9 %; C2
//!   17 % and 16 %, with depth 11 % and 12 %. In C1, 50 of the 88 faces that cross the near plane are not cut; cutting one takes
//!   about 1500 instructions, this test 180.
//! - **Test**: `back_faces_are_known_before_they_are_cut` in `pipeline/clip_face.rs`.
//!
//! The side of a face is the sign of the determinant of its corners' x, y and w, also where w is negative (Olano and Greer,
//! *Triangle scan conversion using 2D homogeneous coordinates*, 1997). As a product of a corner and two edges it keeps the
//! precision of short edges.

use crate::math::num::leading_zeros;
use crate::math::ClipCoords;

/// Components of at most 2¹⁴, so that all products fit 32 bits.
const BITS: i32 = 14;

/// A determinant of this size is beyond doubt. Each component is off by less than 2: its own rounding and that of its shift by
/// 2. So the sum of six products is off by less than 6·3·2·2²⁸, and dropping 14 bits of three more adds 3·2¹⁴: less than
/// 40·2¹⁴ in all. A face that passes is turned away by more than 1/64 rad.
const MARGIN: i32 = 1 << 22;

/// Whether a face, whose first three `slots` are its corners, is a back face beyond doubt. `sub_pixels`: x/w and y/w are in
/// units of 2^`sub_pixels` sub-pixels.
#[inline(never)] // rare path: code size counts
pub(crate) fn is_back_face(slots: &[ClipCoords], sub_pixels: i32) -> bool {
    let [a, b, c, ..] = slots else { return false };
    if cfg!(pinhole_plain) {
        return false;
    }
    // The least distance from the near plane of a corner inside, as a negative distance is large without its sign; and the largest of
    // a corner outside, less 1.
    let [p, q, r] = [a, b, c].map(|&ClipCoords { xydw: [_, _, d, _] }| d);
    let inside = (p as u32).min(q as u32).min(r as u32);
    let outside = !p.min(q).min(r) as u32;
    // 30 bits, so that differences have 31.
    let [a, b, c] = [a, b, c].map(|&ClipCoords { xydw: [x, y, _, w] }| [x >> 2, y >> 2, w >> 2]);
    let edge = |to: [i32; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (v, _) = scaled(a);
    let ((p, p_reach), (q, q_reach)) = (scaled(edge(b)), scaled(edge(c)));
    // Each reach is less than twice the largest component: 2¹¹ sub-pixels are more than four pixels.
    let w = (a[2].unsigned_abs() | b[2].unsigned_abs() | c[2].unsigned_abs()) >> ((sub_pixels - 11) & 31);
    if inside < outside >> 3 || sub_pixels < 11 || p_reach.min(q_reach) < w {
        return false;
    }
    // Products ≤ 2²⁸, differences ≤ 2²⁹; three products of 2¹⁴ and 2¹⁵ stay below 2³¹.
    let cross = |i: usize, j: usize| (p[i] * q[j] - p[j] * q[i]) >> BITS;
    v[0] * cross(1, 2) + v[1] * cross(2, 0) + v[2] * cross(0, 1) > MARGIN
}

/// A vector shifted right to components of at most 2^[`BITS`], and the bitwise OR of its components' magnitudes.
#[inline(never)] // rare path: code size counts
fn scaled(v: [i32; 3]) -> ([i32; 3], u32) {
    let [x, y, w] = v;
    let reach = x.unsigned_abs() | y.unsigned_abs() | w.unsigned_abs();
    let down = (32 - leading_zeros(reach) - BITS).max(0) & 31;
    ([x >> down, y >> down, w >> down], reach)
}
