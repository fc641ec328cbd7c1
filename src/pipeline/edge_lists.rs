//! Edges in bins by their first rows, and those that have begun in lists by their kinds.

use super::bins::{BinRows, NONE};
use crate::math::hints::keep_rolled;
use core::ops::Range;

/// The kinds of edges: tall creases, wide creases, tall silhouettes, wide silhouettes. Each pass takes them in this order. Wide silhouettes come after
/// all creases: where both meet, what lies beyond the silhouette is mixed with the smoothed crease.
pub(super) const KINDS: usize = 4;
pub(super) const WIDE_CREASES: usize = 1;
pub(super) const WIDE_SILHOUETTES: usize = 3;

/// The edges of a mesh in bins of rows, and in a list of each kind those that have begun and not ended, in the order of the mesh: the edges of
/// each bin and of each list are linked.
#[derive(Debug)]
pub(super) struct EdgeLists<'s> {
    first: &'s mut [u16],
    /// The next edge of each edge that is smoothed.
    next: &'s mut [u16],
    rows: BinRows,
    lists: [u16; KINDS],
    /// The first bin whose edges are in no list yet, and the end of the last band.
    bin: usize,
    row: i32,
}

impl<'s> EdgeLists<'s> {
    /// Edges in bins. The next one of each bin is larger.
    pub(super) fn new(first: &'s mut [u16], next: &'s mut [u16], rows: BinRows) -> Self {
        Self { first, next, rows, lists: [NONE; KINDS], bin: 0, row: i32::MIN }
    }

    /// Moves the edges that begin in a band into their lists. Unless the band lies below the last one, begins again with all edges. `kind`: that of
    /// an edge, if it is smoothed.
    #[inline(never)]
    pub(super) fn advance(&mut self, rows: &Range<i32>, kind: impl Fn(usize) -> Option<usize>) {
        if rows.start < self.row {
            self.restart(&kind);
        }
        self.row = rows.end;
        let end = (self.rows.bin(rows.end - 1) + 1).min(self.first.len());
        for bin in self.bin..end {
            let Some(first) = self.first.get_mut(bin) else { break };
            let mut edge = core::mem::replace(first, NONE);
            let mut before = [NONE; KINDS];
            while let Some(&following) = self.next.get(usize::from(edge)) {
                let Some(kind) = kind(edge.into()) else { break };
                let Some(before) = before.get_mut(kind) else { break };
                let mut next = self.link(*before, kind);
                while next < edge {
                    (*before, next) = (next, self.link(next, kind));
                }
                self.set_link(*before, kind, edge);
                self.set_link(edge, kind, next);
                (*before, edge) = (edge, following);
            }
        }
        self.bin = self.bin.max(end);
    }

    /// Whether a list has no edge.
    #[inline(always)]
    pub(super) fn is_empty(&self, kind: usize) -> bool {
        self.link(NONE, kind) == NONE
    }

    /// Calls `visit` with each edge of a list: it returns whether the edge ends in the band.
    #[inline(always)]
    pub(super) fn each(&mut self, kind: usize, mut visit: impl FnMut(usize) -> bool) {
        let (mut before, mut edge) = (NONE, self.link(NONE, kind));
        while let Some(&next) = self.next.get(usize::from(edge)) {
            if visit(edge.into()) {
                self.set_link(before, kind, next);
            } else {
                before = edge;
            }
            edge = next;
        }
    }

    /// The edge after `before`, or the first one of a list.
    #[inline(always)]
    fn link(&self, before: u16, kind: usize) -> u16 {
        self.next.get(usize::from(before)).or(self.lists.get(kind)).copied().unwrap_or(NONE)
    }

    #[inline(always)]
    fn set_link(&mut self, before: u16, kind: usize, to: u16) {
        if let Some(link) = self.next.get_mut(usize::from(before)).or(self.lists.get_mut(kind)) {
            *link = to;
        }
    }

    /// Moves all edges into the first bin.
    #[cold]
    #[inline(never)]
    fn restart(&mut self, kind: &impl Fn(usize) -> Option<usize>) {
        self.first.fill(NONE);
        let mut first = NONE;
        for (edge, next) in (0..NONE).zip(self.next.iter_mut()).rev() {
            keep_rolled();
            if kind(edge.into()).is_some() {
                (*next, first) = (first, edge);
            }
        }
        if let Some(bin) = self.first.first_mut() {
            *bin = first;
        }
        (self.lists, self.bin) = ([NONE; KINDS], 0);
    }
}
