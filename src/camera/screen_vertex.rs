//! A vertex on the screen, in eight bytes.

use crate::math::hints::keep_branch;
use crate::math::ClipCoords;
use crate::raster::ScreenPoint;

/// A vertex's place on the screen: 8 bytes of scratch memory each, given by the caller.
///
/// It holds places within 1024 pixels of the viewport's centre; a vertex farther out is marked, like
/// one that must be clipped, and computed again where it is needed.
// Two ways to hold them: with depth, and without, which takes fewer instructions a face. Who put a corner there, knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScreenVertex {
    /// Half sub-pixels right of the viewport's centre, biased by 2¹⁹ + 1: positive, and rounded by the lowest
    /// bit's loss. Without depth: shifted right by one, 19 bits. With depth: all 20 on top, below them the upper
    /// 12 bits of depth. 0 is no place.
    right: u32,
    /// The same downwards, and the lower 12 bits of the depth.
    down: u32,
}

/// A vertex on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UnpackedVertex {
    pub(crate) point: ScreenPoint,
    /// 0 near … [`FARTHEST`](crate::raster::FARTHEST) far, in 16.8.
    pub(crate) depth: i32,
}

impl UnpackedVertex {
    /// Somewhere.
    pub(crate) const ORIGIN: Self = Self { point: ScreenPoint::ORIGIN, depth: 0 };

    /// In the room of a corner in clip space.
    pub(crate) fn held(self) -> ClipCoords {
        ClipCoords { xydw: [self.point.x(), self.point.y(), self.depth, 1] }
    }

    /// What [`held`](Self::held) made.
    pub(crate) fn of_held(&ClipCoords { xydw: [x, y, depth, _] }: &ClipCoords) -> Self {
        Self { point: ScreenPoint::inside(x, y), depth }
    }

    /// 0 near … 65534 far, rounded to nearest.
    pub(crate) fn step(&self) -> u16 {
        ((self.depth + 128) >> 8) as u16 // FARTHEST rounds to 65534
    }
}

impl ScreenVertex {
    /// PixelLayout have at most 2^18 sub-pixels.
    pub(crate) const RANGE_BITS: i32 = 18;

    /// What [`new`](Self::new) wants: brings half sub-pixels above zero, and rounds them.
    pub(crate) const BIAS: i32 = (2 << Self::RANGE_BITS) + 1;

    /// No place yet: for arrays in statics. All zeros, so that they take no room in flash.
    pub const EMPTY: Self = Self { right: 0, down: 0 };

    /// From half sub-pixels from the viewport's centre, rounded to whole ones, ties up, and depth in
    /// 16.8, 24 bits. Out of reach it is [`EMPTY`](Self::EMPTY), as it may be right at the border.
    #[inline(always)]
    pub(crate) fn new<const DEPTH: bool>(right: i32, down: i32, bias: i32, depth: i32) -> Self {
        debug_assert!(depth >> 24 == 0);
        let biased = |v: i32| v.wrapping_add(bias) as u32;
        let (right, down) = (biased(right), biased(down));
        if (right | down) >> (Self::RANGE_BITS + 2) != 0 {
            keep_branch(); // else every vertex selects between two values, twice
            return Self::EMPTY;
        }
        match DEPTH {
            true => Self { right: right << 12 | depth as u32 >> 12, down: down << 12 | depth as u32 & 0xfff },
            false => Self { right: right >> 1, down: down >> 1 },
        }
    }

    /// Whether there is a place.
    #[inline(always)]
    pub(crate) fn whole(self) -> bool {
        self.right != 0
    }

    /// Sub-pixels from a point that all corners of a viewport share, for differences; the viewport's
    /// centre lies at [`CENTRE`](Self::CENTRE).
    #[inline(always)]
    pub(crate) fn offset<const DEPTH: bool>(self) -> ScreenPoint {
        let held = |v: u32| (if DEPTH { v >> 13 } else { v }) as i32; // 19 bits
        ScreenPoint::inside(held(self.right), held(self.down))
    }

    /// Where [`offset`](Self::offset) has the viewport's centre.
    pub(crate) const CENTRE: [i32; 2] = [Self::BIAS >> 1; 2];

    /// In 16.8.
    #[inline(always)]
    pub(crate) fn depth(self) -> i32 {
        ((self.right & 0xfff) << 12 | self.down & 0xfff) as i32
    }

    /// A place anywhere in the guard band, without depth: for those who know that it is one.
    pub(crate) fn bare(point: ScreenPoint) -> Self {
        Self { right: point.x() as u32, down: point.y() as u32 }
    }

    /// What [`bare`](Self::bare) holds.
    pub(crate) fn point(self) -> ScreenPoint {
        ScreenPoint::inside(self.right as i32, self.down as i32)
    }
}

impl Default for ScreenVertex {
    fn default() -> Self {
        Self::EMPTY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_in_comes_out() {
        let places = [1 - (1 << 18), -255, -1, 0, 1, 77, (1 << 18) - 1];
        for (right, down) in places.iter().flat_map(|&right| places.map(|down| (right, down))) {
            for depth in [0, 1, 0xfff, 0x1000, 0x7f_f000, crate::raster::FARTHEST] {
                // A half is rounded up.
                for half in [0, -1] {
                    let (x, y) = (2 * right + half, 2 * down + half);
                    let deep = ScreenVertex::new::<true>(x, y, ScreenVertex::BIAS, depth);
                    let plain = ScreenVertex::new::<false>(x, y, ScreenVertex::BIAS, 0);
                    assert!(deep.whole() && plain.whole());
                    let [x, y] = ScreenVertex::CENTRE;
                    for offset in [deep.offset::<true>(), plain.offset::<false>()] {
                        assert_eq!((offset.x() - x, offset.y() - y), (right, down));
                    }
                    assert_eq!(deep.depth(), depth);
                }
            }
        }
        assert_eq!(size_of::<ScreenVertex>(), 8);
    }

    #[test]
    fn what_lies_farther_out_has_no_place() {
        assert!(!ScreenVertex::EMPTY.whole());
        for out in [1 << 19, i32::MAX, i32::MIN, -(1 << 19) - 2] {
            assert_eq!(ScreenVertex::new::<true>(out, 0, ScreenVertex::BIAS, 0), ScreenVertex::EMPTY);
            assert_eq!(ScreenVertex::new::<false>(0, out, ScreenVertex::BIAS, 0), ScreenVertex::EMPTY);
        }
    }
}
