//! A projected vertex, packed into eight bytes.

use crate::math::hints::keep_branch;
use crate::math::ClipCoords;
use crate::raster::ScreenPoint;

/// A projected vertex, packed into 8 bytes: screen position in 1/256 pixel and, for drawing with a depth buffer, depth in 16.8.
/// Caller-provided buffers of screen vertices serve as vertex caches.
///
/// It has room for positions within 1024 pixels of the viewport's centre. A vertex farther out, or one that must be clipped, is
/// stored without a position, with the clip planes that it lies outside of; it is transformed again, in wide arithmetic, for
/// each visible face that uses it.
// Two layouts: with depth, and without, which takes fewer instructions per face. The caller knows which one it stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScreenVertex {
    /// Half sub-pixels right of the viewport's centre, biased by 2¹⁹ + 1, so positive and rounded when the lowest bit is
    /// dropped. Without depth: shifted right by one, 19 bits. With depth: all 20 bits on top, below them the upper 12 bits of
    /// depth. 0 marks a vertex without a position; with depth no position is 0, because the lowest of its 20 bits is set.
    right: u32,
    /// Half sub-pixels below the viewport's centre, in the layout of `right`, with the lower 12 bits of depth. In a vertex
    /// without a position: [`KNOWN`](Self::KNOWN) and the clip planes that it lies outside of, or 0 if it was not transformed.
    down: u32,
}

/// A projected vertex anywhere in the guard band.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UnpackedVertex {
    pub(crate) point: ScreenPoint,
    /// Depth in 16.8: 0 at the near plane, [`FARTHEST`](crate::raster::FARTHEST) at the far plane.
    pub(crate) depth: i32,
}

impl UnpackedVertex {
    /// Stores the vertex in the slot of its clip coordinates, so that a polygon needs one buffer. w stays.
    pub(crate) fn store_in(self, slot: &mut ClipCoords) {
        let [x, y, depth, _] = &mut slot.xydw;
        (*x, *y, *depth) = (self.point.x(), self.point.y(), self.depth);
    }

    /// Loads a vertex that [`store_in`](Self::store_in) stored.
    pub(crate) fn from_clip_slot(&ClipCoords { xydw: [x, y, depth, _] }: &ClipCoords) -> Self {
        Self { point: ScreenPoint::inside(x, y), depth }
    }

    /// Depth rounded to whole steps: 0 near … 65534 far.
    pub(crate) fn step(&self) -> u16 {
        ((self.depth + 128) >> 8) as u16 // FARTHEST rounds to 65534
    }
}

impl ScreenVertex {
    /// Positions are less than 2^18 sub-pixels from the viewport's centre.
    pub(crate) const RANGE_BITS: i32 = 18;

    /// The bias that [`new`](Self::new) adds: it makes half sub-pixels positive and rounds them.
    pub(crate) const BIAS: i32 = (2 << Self::RANGE_BITS) + 1;

    /// A vertex without a position, to initialise arrays. All bits are zero, so a `static` array of them takes no flash.
    pub const EMPTY: Self = Self { right: 0, down: 0 };

    /// The bit of `down` that marks the clip planes of a vertex without a position as known. Without depth, a position has only
    /// 19 bits there.
    const KNOWN: u32 = 1 << 31;

    /// The bits of the six clip planes, in the order of [`VertexTransform::distance`](super::VertexTransform::distance).
    pub(crate) const PLANES: u32 = 0x3f;

    /// The bit of the near plane.
    pub(crate) const NEAR: u32 = 1;

    /// The bit of a vertex inside of all planes that lies out of the range of positions, or too close to the eye.
    pub(crate) const ASIDE: u32 = 1 << 6;

    /// A vertex without a position, and the planes that it lies outside of, or [`ASIDE`](Self::ASIDE). If the bit of the near
    /// plane is set, other planes may be missing.
    pub(crate) const fn without_position(planes: u32) -> Self {
        Self { right: 0, down: Self::KNOWN | planes }
    }

    /// The planes of a vertex that [`without_position`](Self::without_position) made; `None` for any other.
    #[inline(always)]
    pub(crate) fn planes(self) -> Option<u32> {
        (!self.is_on_screen() && self.down & Self::KNOWN != 0).then_some(self.down & !Self::KNOWN)
    }

    /// Packs a position, given in half sub-pixels from the viewport's centre and rounded to sub-pixels with ties up, and a
    /// depth in 16.8 of 24 bits. Returns `None` for a position out of range. Without depth, a vertex at the left end of the range
    /// counts as one that [is not on the screen](Self::is_on_screen).
    #[inline(always)]
    pub(crate) fn new<const DEPTH: bool>(right: i32, down: i32, bias: i32, depth: i32) -> Option<Self> {
        debug_assert!(depth >> 24 == 0);
        let biased = |v: i32| v.wrapping_add(bias) as u32;
        let (right, down) = (biased(right), biased(down));
        if (right | down) >> (Self::RANGE_BITS + 2) != 0 {
            keep_branch(); // otherwise LLVM selects between two values, twice per vertex
            return None;
        }
        Some(match DEPTH {
            // The lowest bit is below a sub-pixel: `offset` drops it.
            true => Self {
                right: (right | 1) << 12 | depth as u32 >> 12,
                down: down << 12 | depth as u32 & 0xfff,
            },
            false => Self { right: right >> 1, down: down >> 1 },
        })
    }

    /// Whether the vertex has a position.
    #[inline(always)]
    pub(crate) fn is_on_screen(self) -> bool {
        self.right != 0
    }

    /// The planes of a vertex without a position, and a bit that is set if they are known; 0 on the screen. The bitwise AND of
    /// several vertices tells by [`share_a_plane`](Self::share_a_plane) whether all of them lie outside of one plane.
    #[inline(always)]
    pub(crate) fn known_planes(self) -> u32 {
        if self.is_on_screen() {
            0
        } else {
            self.down
        }
    }

    /// Whether vertices whose [`known_planes`](Self::known_planes) have this bitwise OR lie on the screen or before the near plane.
    pub(crate) fn is_near_alone(any: u32) -> bool {
        any == Self::KNOWN | Self::NEAR
    }

    /// Whether vertices whose [`known_planes`](Self::known_planes) have this bitwise AND all lie outside of one plane.
    #[inline(always)]
    pub(crate) fn share_a_plane(all: u32) -> bool {
        all & Self::KNOWN != 0 && all & Self::PLANES != 0
    }

    /// The position in sub-pixels, relative to an origin that all vertices of a viewport share: only differences have a
    /// meaning. The viewport's centre is at [`CENTRE`](Self::CENTRE).
    #[inline(always)]
    pub(crate) fn offset<const DEPTH: bool>(self) -> ScreenPoint {
        let position = |v: u32| (if DEPTH { v >> 13 } else { v }) as i32; // 19 bits
        ScreenPoint::inside(position(self.right), position(self.down))
    }

    /// The viewport's centre in the coordinates of [`offset`](Self::offset).
    pub(crate) const CENTRE: [i32; 2] = [Self::BIAS >> 1; 2];

    /// Depth in 16.8, of a vertex stored with depth.
    #[inline(always)]
    pub(crate) fn depth(self) -> i32 {
        ((self.right & 0xfff) << 12 | self.down & 0xfff) as i32
    }

    /// Stores a position anywhere in the guard band, without depth and not packed: only [`point`](Self::point) reads it.
    pub(crate) fn unpacked_point(point: ScreenPoint) -> Self {
        Self { right: point.x() as u32, down: point.y() as u32 }
    }

    /// The position that [`unpacked_point`](Self::unpacked_point) stored.
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
    fn packing_keeps_position_and_depth() {
        let positions = [1 - (1 << 18), -255, -1, 0, 1, 77, (1 << 18) - 1];
        for (right, down) in positions.iter().flat_map(|&right| positions.map(|down| (right, down))) {
            for depth in [0, 1, 0xfff, 0x1000, 0x7f_f000, crate::raster::FARTHEST] {
                // Ties are rounded up.
                for half in [0, -1] {
                    let (x, y) = (2 * right + half, 2 * down + half);
                    let deep = ScreenVertex::new::<true>(x, y, ScreenVertex::BIAS, depth).unwrap();
                    let plain = ScreenVertex::new::<false>(x, y, ScreenVertex::BIAS, 0).unwrap();
                    assert!(deep.is_on_screen() && plain.is_on_screen());
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
    fn vertices_out_of_range_have_no_position() {
        assert!(!ScreenVertex::EMPTY.is_on_screen());
        assert_eq!(ScreenVertex::EMPTY.planes(), None);
        for planes in [0, 1, 0x3f] {
            let vertex = ScreenVertex::without_position(planes);
            assert!(!vertex.is_on_screen());
            assert_eq!(vertex.planes(), Some(planes));
        }
        // At the left end of the range a vertex stored without depth has 0 in `right`: it counts as one without a position, and without
        // known planes. Stored with depth it is on the screen.
        let left = -ScreenVertex::BIAS;
        for down in [left, 0, (1 << 19) - 2] {
            assert!(ScreenVertex::new::<true>(left, down, ScreenVertex::BIAS, 0).unwrap().is_on_screen());
            let plain = ScreenVertex::new::<false>(left, down, ScreenVertex::BIAS, 0).unwrap();
            assert_eq!((plain.is_on_screen(), plain.planes()), (false, None));
        }
        for out in [1 << 19, i32::MAX, i32::MIN, -(1 << 19) - 2] {
            assert_eq!(ScreenVertex::new::<true>(out, 0, ScreenVertex::BIAS, 0), None);
            assert_eq!(ScreenVertex::new::<false>(0, out, ScreenVertex::BIAS, 0), None);
        }
    }
}
