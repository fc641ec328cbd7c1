//! Transform hierarchies: moving parts that carry other parts.

use crate::math::Affine;
use crate::scene::MeshError;
use crate::space::{Model, World};

/// A node of a transform hierarchy: its local transform, to its parent or, for a root, to the world, and its world transform,
/// which [`Hierarchy::update`] computes.
///
/// A node has no mesh: the caller draws any number of meshes with its world transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Node {
    parent: Option<u16>,
    local: Affine<Model, Model>,
    world: Affine<Model, World>,
}

impl Node {
    /// A node without a parent: `local` is its transform to the world.
    pub const fn root(local: Affine<Model, Model>) -> Self {
        Self { parent: None, local, world: Affine::identity() }
    }

    /// A child of the node with index `parent`, which must come earlier in the list.
    pub const fn child(parent: u16, local: Affine<Model, Model>) -> Self {
        Self { parent: Some(parent), local, world: Affine::identity() }
    }
}

/// A transform hierarchy over a caller-provided list of nodes. Parents come before their children, so one forward pass updates
/// all world transforms, without recursion or other memory. Only the first 65536 nodes can be parents.
///
/// ```
/// use pinhole::{mesh::{Hierarchy, MeshError, Node}, prelude::*, Angle};
/// let out = |x| Affine::<Model, Model>::translation(Vector3::from_ints(x, 0, 0));
/// let mut nodes = [Node::root(Affine::identity()), Node::child(0, out(2)), Node::child(1, out(3))];
/// let mut arm = Hierarchy::new(&mut nodes)?;
/// arm.set_local(0, Affine::rotation_z(Angle::degrees(90)));
/// arm.update();
/// let hand = arm.world(2).unwrap();
/// assert_eq!(hand.apply(Point3::from_ints(0, 0, 0)), Point3::from_ints(0, 5, 0));
///
/// let mut wrong = [Node::child(0, out(1))];
/// assert_eq!(Hierarchy::new(&mut wrong).unwrap_err(), MeshError::Parent { node: 0, parent: 0 });
/// # Ok::<(), MeshError>(())
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Hierarchy<'a> {
    nodes: &'a mut [Node],
}

impl<'a> Hierarchy<'a> {
    /// The hierarchy of these nodes, with world transforms updated.
    ///
    /// # Errors
    ///
    /// [`MeshError`] names the first node whose parent does not come before it.
    pub fn new(nodes: &'a mut [Node]) -> Result<Self, MeshError> {
        for (node, Node { parent, .. }) in nodes.iter().enumerate() {
            match *parent {
                Some(parent) if usize::from(parent) >= node => {
                    return Err(MeshError::Parent { node, parent })
                }
                _ => {}
            }
        }
        let mut hierarchy = Self { nodes };
        hierarchy.update();
        Ok(hierarchy)
    }

    /// Sets a node's local transform; [`update`](Self::update) then moves it and its descendants. Returns whether the index
    /// exists.
    pub fn set_local(&mut self, node: usize, local: Affine<Model, Model>) -> bool {
        match self.nodes.get_mut(node) {
            Some(node) => {
                node.local = local;
                true
            }
            None => false,
        }
    }

    /// Computes the world transform of every node, parent's world · local, in the order of the list. Each level adds the
    /// rounding error of [`Affine::then`]: coefficients within 2⁻³⁰ of the largest, translations within 2⁻³³.
    pub fn update(&mut self) {
        for i in 0..self.nodes.len() {
            let (before, rest) = self.nodes.split_at_mut(i); // i < len: never panics
            let Some(node) = rest.first_mut() else { return };
            let parent = node.parent.and_then(|parent| before.get(usize::from(parent)));
            let base = parent.map_or(Affine::identity(), |parent| parent.world);
            node.world = node.local.then(&base);
        }
    }

    /// A node's transform to the world, as of the last update; `None` if the index does not exist.
    pub fn world(&self, node: usize) -> Option<&Affine<Model, World>> {
        self.nodes.get(node).map(|node| &node.world)
    }
}

defmt_format!([] Hierarchy<'_>, self, "hierarchy of {=usize} nodes", self.nodes.len());
