//! Counts the vertex loop of every design over the torus.

use crate::board::Clock;
use crate::chain::{checksum, ways, Design, ScreenVertex};
use crate::library::{before_torus, Fixed, Library, Short};
use crate::list::{all, Visit};
use crate::torus::{self, VERTICES};
use crate::Vertex;
use core::hint::black_box;

pub const COUNT: usize = VERTICES.len();

/// The instructions that a design takes for a vertex loop, and the checksum of the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counted {
    pub id: &'static str,
    pub instructions: u32,
    pub checksum: u32,
}

/// Passes the count of every design to `take`; `None` if a clock or a design fails.
pub fn count(take: &mut dyn FnMut(Counted)) -> Option<()> {
    let mut counter = Counter { clock: Clock::new()?, take, good: true };
    counter.library::<Short>()?;
    counter.library::<Fixed>()?;
    all(&mut counter);
    counter.good.then_some(())
}

struct Counter<'t> {
    clock: Clock,
    take: &'t mut dyn FnMut(Counted),
    good: bool,
}

impl Visit for Counter<'_> {
    fn visit<D: Design>(&mut self, id: &'static str) {
        self.good &= self.design::<D>(id).is_some();
    }
}

impl Counter<'_> {
    #[inline(never)]
    fn design<D: Design>(&mut self, id: &'static str) -> Option<()> {
        // Farther away for a design that cannot show a near object.
        let [near, far] = [1, 8].map(|times| black_box(torus::object(times)));
        let (object, design) = match D::new(&near) {
            Some(design) => (near, design),
            None => (far, D::new(&far)?),
        };
        let vertices: [D::Vertex; COUNT] = core::array::from_fn(|i| D::Vertex::of(&object, VERTICES[i]));
        let mut corners = [ScreenVertex::EMPTY; COUNT];
        let mut fewest = u32::MAX;
        for way in ways::<D>() {
            let mut work = || way(black_box(&design), black_box(&vertices), black_box(&mut corners));
            fewest = fewest.min(self.clock.count(&mut work)?);
        }
        let whole = corners.iter().all(|&corner| corner != ScreenVertex::EMPTY);
        (self.take)(Counted { id, instructions: fewest, checksum: checksum(corners.iter().copied()) });
        whole.then_some(())
    }

    #[inline(never)]
    fn library<L: Library>(&mut self) -> Option<()> {
        let clock = &mut self.clock;
        let counted = before_torus::<L, _>(|instance, corners| {
            let instructions = clock.count(&mut || {
                black_box(black_box(instance).transform(black_box(&mut *corners)));
            })?;
            let places = (0..COUNT).map(|index| match instance.project(index) {
                Ok(pinhole::Projected { point: p, .. }) => ScreenVertex { x: p.x(), y: p.y() },
                Err(_) => ScreenVertex::EMPTY,
            });
            Some(Counted { id: L::ID, instructions, checksum: checksum(places) })
        })?;
        (self.take)(counted);
        Some(())
    }
}
