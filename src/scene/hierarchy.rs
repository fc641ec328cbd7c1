//! Moving parts that carry others.

use crate::math::Affine;
use crate::space::{Model, World};

/// A part of a scene: where it sits in its parent (or in the world), and, after
/// [`Hierarchy::update`], where that is in the world.
///
/// A node holds no mesh: any number of meshes can stand under one, and one mesh under many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Node {
    parent: Option<u16>,
    local: Affine<Model, Model>,
    world: Affine<Model, World>,
}

impl Node {
    /// A node without a parent: `local` places it in the world.
    pub const fn root(local: Affine<Model, Model>) -> Self {
        Self { parent: None, local, world: Affine::identity() }
    }

    /// A node under the one at place `parent`, which must come earlier in the list.
    pub const fn child(parent: u16, local: Affine<Model, Model>) -> Self {
        Self { parent: Some(parent), local, world: Affine::identity() }
    }

    /// Where the node sits in its parent.
    pub const fn local(&self) -> &Affine<Model, Model> {
        &self.local
    }

    /// Where the node sits in the world, as of the last update.
    pub const fn world(&self) -> &Affine<Model, World> {
        &self.world
    }
}

/// A tree of nodes in the caller's memory. Parents come before their children, so one forward pass updates all,
/// without recursion and without memory of its own. Only the first 65536 nodes can be parents.
///
/// ```
/// use pinhole::{space::Model, Affine, Angle, Hierarchy, HierarchyError, Node, Point3, Vector3};
/// let out = |x| Affine::<Model, Model>::translation(Vector3::from_ints(x, 0, 0));
/// let mut nodes = [Node::root(Affine::identity()), Node::child(0, out(2)), Node::child(1, out(3))];
/// let mut arm = Hierarchy::new(&mut nodes)?;
/// arm.set_local(0, Affine::rotation_z(Angle::QUARTER_TURN));
/// arm.update();
/// let hand = arm.world(2).unwrap();
/// assert_eq!(hand.apply(Point3::from_ints(0, 0, 0)), Point3::from_ints(0, 5, 0));
///
/// let mut wrong = [Node::child(0, out(1))];
/// assert_eq!(Hierarchy::new(&mut wrong).unwrap_err(), HierarchyError { node: 0, parent: 0 });
/// # Ok::<(), HierarchyError>(())
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Hierarchy<'a> {
    nodes: &'a mut [Node],
}

/// A node whose parent is itself or comes later: order the list so that parents come first. There
/// can be no cycle then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HierarchyError {
    /// The node's place in the list.
    pub node: usize,
    /// The parent it names.
    pub parent: u16,
}

impl core::fmt::Display for HierarchyError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "node {} names parent {}, which must come before it", self.node, self.parent)
    }
}

impl core::error::Error for HierarchyError {}

impl<'a> Hierarchy<'a> {
    /// Over these nodes, updated once.
    ///
    /// # Errors
    ///
    /// [`HierarchyError`] names the first node whose parent does not come before it.
    pub fn new(nodes: &'a mut [Node]) -> Result<Self, HierarchyError> {
        for (node, Node { parent, .. }) in nodes.iter().enumerate() {
            match *parent {
                Some(parent) if usize::from(parent) >= node => return Err(HierarchyError { node, parent }),
                _ => {}
            }
        }
        let mut hierarchy = Self { nodes };
        hierarchy.update();
        Ok(hierarchy)
    }

    /// Sets where a node sits in its parent; [`update`](Self::update) moves all below it. Returns whether there is
    /// such a node.
    pub fn set_local(&mut self, node: usize, local: Affine<Model, Model>) -> bool {
        match self.nodes.get_mut(node) {
            Some(node) => {
                node.local = local;
                true
            }
            None => false,
        }
    }

    /// World transform = parent's world · local, for all nodes in order. Each level adds the rounding of
    /// [`Affine::then`]: coefficients within 2⁻³⁰ of the largest, translations within 2⁻³³.
    pub fn update(&mut self) {
        for i in 0..self.nodes.len() {
            let (before, rest) = self.nodes.split_at_mut(i); // i < len: never panics
            let Some(node) = rest.first_mut() else { return };
            let parent = node.parent.and_then(|parent| before.get(usize::from(parent)));
            let base = parent.map_or(Affine::identity(), |parent| parent.world);
            node.world = node.local.then(&base);
        }
    }

    /// Where a node sits in the world, as of the last update; `None` where there is no such node.
    pub fn world(&self, node: usize) -> Option<&Affine<Model, World>> {
        self.nodes.get(node).map(Node::world)
    }

    /// All nodes.
    pub fn nodes(&self) -> &[Node] {
        self.nodes
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for Hierarchy<'_> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "hierarchy of {=usize} nodes", self.nodes.len());
    }
}
