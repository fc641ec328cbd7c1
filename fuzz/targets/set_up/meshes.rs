//! Meshes by their indices, and trees of nodes by their parents.

use super::transforms;
use crate::bridge::{point, scalar};
use crate::bytes::Bytes;
use crate::oracle::chain::{length, vertex, V3};
use pinhole::space::{Model, World};
use pinhole::{Affine, Hierarchy, HierarchyError, Mesh, MeshError, Node, Scalar};

/// A box of twice that has a sphere whose radius is still a number.
pub(crate) const SMALL: f64 = 18_000.0;

/// The first of the lists that names a vertex that is not there, and the largest index in it.
fn beyond<const N: usize>(lists: &[[u16; N]], vertices: usize) -> Option<(usize, u16)> {
    let largest = lists.iter().map(|l| l.iter().copied().max().unwrap_or(0));
    largest.enumerate().find(|&(_, index)| usize::from(index) >= vertices)
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    let count = b.below(7);
    let vertices: Vec<[i16; 3]> = (0..count).map(|_| [b.i16(), b.i16(), b.i16()]).collect();
    let index = |b: &mut Bytes<'_>| match b.byte() {
        0..=251 => u16::from(b.byte() & 7),
        _ => b.u16(),
    };
    let faces: Vec<[u16; 3]> = (0..b.below(4)).map(|_| [index(b), index(b), index(b)]).collect();
    let edges: Vec<[u16; 2]> = (0..b.below(4)).map(|_| [index(b), index(b)]).collect();
    let normals: Vec<[i16; 3]> = (0..b.below(4)).map(|_| [b.i16(), b.i16(), b.i16()]).collect();
    let exponent = if b.byte() & 1 == 0 { b.i8() as i8 } else { b.i8() as i8 >> 2 };
    let bad_face = beyond(&faces, count);
    let ours = Mesh::new(&vertices, exponent, &faces);
    let fixed: Vec<[Scalar; 3]> = vertices
        .iter()
        .map(|v| v.map(|c| scalar(((i64::from(c) * i64::from(b.wild())) >> 15) as i32)))
        .collect();
    let named = |error: MeshError| match error {
        MeshError::FaceIndex { face, index } => Some((face, index)),
        _ => None,
    };
    match Mesh::from_fixed(&fixed, &faces) {
        Ok(mesh) => {
            assert!(bad_face.is_none());
            let _ = mesh.bounding_sphere();
        }
        Err(error) => assert_eq!(named(error), bad_face),
    }
    let mesh = match ours {
        Err(MeshError::Exponent { exponent: e }) => {
            return assert!(e == exponent && !(-32..=15).contains(&exponent));
        }
        Err(error) => return assert!(bad_face.is_some() && named(error) == bad_face, "{error:?} {faces:?}"),
        Ok(mesh) => mesh,
    };
    assert!(bad_face.is_none() && (-32..=15).contains(&exponent), "{faces:?}");
    assert_eq!((mesh.vertices(), mesh.faces(), mesh.exponent()), (&vertices[..], &faces[..], exponent));
    match mesh.with_edges(&edges) {
        Ok(with) => assert!(beyond(&edges, count).is_none() && with.edges() == edges),
        Err(MeshError::EdgeIndex { edge, index }) => assert_eq!(beyond(&edges, count), Some((edge, index))),
        Err(error) => panic!("{error:?}"),
    }
    match mesh.with_normals(&normals) {
        Ok(with) => assert!(normals.len() == faces.len() && with.normals() == normals),
        Err(error) => {
            let wanted = MeshError::NormalCount { faces: faces.len(), normals: normals.len() };
            assert!(normals.len() != faces.len() && error == wanted);
        }
    }
    let list = vec![b.byte(); b.below(7)];
    let entries = list.len();
    let wrong = MeshError::VertexListCount { vertices: count, entries };
    assert_eq!(mesh.per_vertex(&list), if entries == count { Ok(&list[..]) } else { Err(wrong) });
    let wrong = MeshError::FaceListCount { faces: faces.len(), entries };
    assert_eq!(mesh.per_face(&list), if entries == faces.len() { Ok(&list[..]) } else { Err(wrong) });
    // The sphere holds all vertices, unless its numbers saturate.
    let sphere = mesh.bounding_sphere();
    let centre = crate::bridge::reals(sphere.centre);
    let radius = f64::from(sphere.radius.to_bits()) / 65_536.0;
    let places: Vec<V3> = vertices.iter().map(|&v| vertex(v, exponent)).collect();
    if places.iter().flatten().all(|c| c.abs() < SMALL) {
        for p in places {
            let away = length(core::array::from_fn(|i| p[i] - centre[i]));
            assert!(away <= radius, "{vertices:?}·2^{exponent}: {sphere:?}");
        }
    }
}

pub(crate) fn hierarchy(b: &mut Bytes<'_>) {
    let count = b.below(6);
    let mut parents = Vec::new();
    let mut nodes = Vec::new();
    for i in 0..count {
        let parent = match b.byte() {
            0..=63 => None,
            k @ 64..=243 => Some((usize::from(k) % i.max(1)) as u16),
            244..=250 => Some(u16::from(b.byte() & 7)),
            _ => Some(b.u16()),
        };
        let local = transforms::steps(b, 2).library().then(&Affine::<World, Model>::identity());
        parents.push(parent);
        nodes.push(parent.map_or(Node::root(local), |p| Node::child(p, local)));
    }
    let locals: Vec<Affine<Model, Model>> = nodes.iter().map(|n| *n.local()).collect();
    let wrong = parents.iter().enumerate().find_map(|(node, p)| {
        p.filter(|&p| usize::from(p) >= node).map(|parent| HierarchyError { node, parent })
    });
    let mut tree = match Hierarchy::new(&mut nodes) {
        Err(error) => return assert_eq!(Some(error), wrong),
        Ok(tree) => tree,
    };
    assert_eq!(wrong, None, "{parents:?}");
    let (moved, turned) =
        (b.below(8), transforms::steps(b, 1).library().then(&Affine::<World, Model>::identity()));
    assert_eq!(tree.set_local(moved, turned), moved < count);
    tree.update();
    assert!(tree.world(count).is_none());
    let p = point::<Model>([b.wild(), b.wild(), b.wild()]);
    for i in 0..count {
        // From the node up to its root, one by one.
        let local = |i: usize| if i == moved { turned } else { locals[i] };
        let mut path = vec![i];
        while let Some(parent) = parents[path[path.len() - 1]] {
            path.push(parent.into());
        }
        let mut world = Affine::<Model, World>::identity();
        for &node in path.iter().rev() {
            world = local(node).then(&world);
        }
        assert_eq!(tree.world(i).map(|w| w.apply(p)), Some(world.apply(p)), "{parents:?} {i}");
    }
}
