//! The cases that are drawn: some to fit the constants, others to test the predictions.

use super::{Kind, SMALL};
use pinhole::{Cull, Mesh};

/// A mesh of 10 to 20 000 triangles, which `build.rs` makes; it is not checked yet: the compiler would take long.
pub(super) struct Shape {
    exponent: i8,
    vertices: &'static [[i16; 3]],
    faces: &'static [[u16; 3]],
    normals: &'static [[i16; 3]],
    edges: &'static [[u16; 2]],
    /// The two faces beside each edge.
    beside: &'static [[u16; 2]],
}

impl Shape {
    fn mesh(&self) -> Option<Mesh<'static>> {
        let mesh = Mesh::new(self.vertices, self.exponent, self.faces).ok()?;
        mesh.with_normals(self.normals).ok()?.with_edges(self.edges).ok()
    }

    /// With the first part of the edges, one of every `one_of`, and the faces beside them.
    fn with_edge_faces(&self, one_of: usize) -> Option<Mesh<'static>> {
        let count = self.edges.len() / one_of.max(1);
        let mesh = self.mesh()?.with_edges(self.edges.get(..count)?).ok()?;
        mesh.with_edge_faces(self.beside.get(..count)?).ok()
    }

    fn vertices(&self) -> usize {
        self.vertices.len()
    }

    /// Its vertices alone.
    fn points(&self) -> Option<Mesh<'static>> {
        Mesh::new(self.vertices, self.exponent, &[]).ok()
    }
}

include!(concat!(env!("OUT_DIR"), "/shapes.rs"));

/// A mesh before a camera. Lengths in 2⁻¹⁶.
pub struct Case {
    pub name: &'static str,
    pub(super) what: What,
    pub(super) eye: [i32; 3],
    pub size: [u32; 2],
    pub(super) cull: Cull,
    /// Whether the mesh is not turned.
    pub(super) level: bool,
    /// Whether the constants are fitted to it.
    pub fitted: bool,
}

pub(super) enum What {
    Shape(&'static Shape),
    /// The vertices of a mesh alone.
    Points(&'static Shape),
}

impl What {
    /// The mesh for a way to draw: for hidden lines it has the faces beside the edges.
    pub(super) fn mesh(&self, kind: Kind) -> Option<Mesh<'static>> {
        match (self, kind) {
            (Self::Shape(shape), Kind::HiddenBands) => shape.with_edge_faces(1),
            (Self::Shape(shape), Kind::FewHiddenBands) => shape.with_edge_faces(FEW),
            (Self::Shape(shape), _) => shape.mesh(),
            (Self::Points(shape), _) => shape.points(),
        }
    }
}

impl Case {
    /// Whether it has no faces.
    pub fn is_of_points(&self) -> bool {
        matches!(self.what, What::Points(_))
    }

    /// Whether it is drawn by the smaller painter, which has room for three times its vertices.
    pub(super) fn is_small(&self) -> bool {
        let (What::Shape(shape) | What::Points(shape)) = self.what;
        shape.vertices() <= SMALL / 3
    }
}

/// A mesh with few edges has one of every four.
const FEW: usize = 4;

/// A distance at which the torus of radius 1.4 fills the picture.
const WHOLE: [i32; 3] = [0, 0, 34 << 12];
/// A distance at which the near plane cuts the torus.
const NEAR: [i32; 3] = [0, 0, 12 << 12];

const fn case(name: &'static str, what: What, eye: [i32; 3], size: [u32; 2], fitted: bool) -> Case {
    Case { name, what, eye, size, cull: Cull::Back, level: false, fitted }
}

const fn torus(name: &'static str, shape: &'static Shape, side: u32) -> Case {
    case(name, What::Shape(shape), WHOLE, [side, side], true)
}

const fn both_sides(case: Case) -> Case {
    Case { cull: Cull::None, ..case }
}

const fn land(case: Case) -> Case {
    Case { level: true, ..case }
}

pub const CASES: &[Case] = &[
    torus("torus 24", &TORUS_24, 60),
    torus("torus 24", &TORUS_24, 240),
    torus("torus 96", &TORUS_96, 120),
    torus("torus 96", &TORUS_96, 240),
    torus("torus 320", &TORUS_320, 60),
    torus("torus 320", &TORUS_320, 240),
    torus("torus 1024", &TORUS_1024, 60),
    torus("torus 1024", &TORUS_1024, 120),
    torus("torus 1024", &TORUS_1024, 240),
    torus("torus 4096", &TORUS_4096, 120),
    torus("torus 4096", &TORUS_4096, 240),
    torus("torus 20000", &TORUS_20000, 240),
    both_sides(torus("torus 320, both sides", &TORUS_320, 240)),
    both_sides(torus("torus 1024, both sides", &TORUS_1024, 120)),
    both_sides(torus("torus 4096, both sides", &TORUS_4096, 240)),
    case("points 4096", What::Points(&TORUS_4096), WHOLE, [16, 16], true),
    case("points 24", What::Points(&TORUS_24), WHOLE, [16, 16], true),
    case("points 24", What::Points(&TORUS_24), WHOLE, [240, 240], true),
    case("points 24", What::Points(&TORUS_24), WHOLE, [480, 320], true),
    case("torus 1024, near", What::Shape(&TORUS_1024), NEAR, [240, 240], true),
    case("torus 4096, near", What::Shape(&TORUS_4096), NEAR, [120, 120], true),
    case("torus 320, near", What::Shape(&TORUS_320), [0, 0, 14 << 12], [240, 240], true),
    case("torus 1024, inside", What::Shape(&TORUS_1024), [0, 0, 6 << 12], [240, 240], true),
    case("sphere 224", What::Shape(&SPHERE_224), [0, 0, 160_000], [240, 240], true),
    case("sphere 224", What::Shape(&SPHERE_224), [0, 0, 160_000], [60, 60], true),
    case("sphere 224", What::Shape(&SPHERE_224), [0, 0, 160_000], [120, 120], true),
    case("sphere 224", What::Shape(&SPHERE_224), [0, 0, 160_000], [180, 180], true),
    case("sphere 224", What::Shape(&SPHERE_224), [0, 0, 160_000], [480, 320], true),
    case("sphere 224, close", What::Shape(&SPHERE_224), [0, 0, 120_000], [240, 240], true),
    case("sphere 224, near", What::Shape(&SPHERE_224), [0, 0, 90_000], [240, 240], true),
    land(case("land 800", What::Shape(&SHEET_800), [0, 90_000, 190_000], [240, 240], true)),
    land(case("land 800, near", What::Shape(&SHEET_800), [0, 30_000, 90_000], [240, 240], true)),
    land(case("land 800, from below", What::Shape(&SHEET_800), [0, -140_000, 140_000], [240, 240], true)),
    land(case("land 800", What::Shape(&SHEET_800), [0, 90_000, 190_000], [120, 120], true)),
    land(case("land 800, steep", What::Shape(&SHEET_800), [0, 190_000, 190_000], [180, 180], true)),
    land(case("land 800, close", What::Shape(&SHEET_800), [0, 60_000, 120_000], [240, 240], true)),
    land(case("land 800, near", What::Shape(&SHEET_800), [0, 30_000, 90_000], [120, 120], true)),
    case("sphere 10", What::Shape(&SPHERE_10), WHOLE, [240, 240], false),
    case("S2's cube", What::Shape(&S2_CUBE), [0, 0, 269_000], [240, 240], false),
    case("sphere 720", What::Shape(&SPHERE_720), [0, 0, 160_000], [128, 64], false),
    case("sphere 720", What::Shape(&SPHERE_720), [0, 0, 160_000], [240, 240], false),
    case("S3's torus", What::Shape(&S3_TORUS), [0, 0, 221_813], [240, 240], false),
    case("S3's torus", What::Shape(&S3_TORUS), [0, 0, 221_813], [480, 320], false),
    case("S3's torus, near", What::Shape(&S3_TORUS), [0, 0, 80_000], [240, 240], false),
    case("S4's icosphere", What::Shape(&S4_ICO), [0, 0, 156_264], [240, 240], false),
    case("S4's icosphere, near", What::Shape(&S4_ICO), [0, 0, 97_000], [240, 240], false),
    land(case("land 3200", What::Shape(&SHEET_3200), [0, 80_000, 200_000], [480, 320], false)),
    land(case("land 3200, close", What::Shape(&SHEET_3200), [0, 20_000, 100_000], [240, 240], false)),
];
