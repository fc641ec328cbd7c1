//! Buffers whose lengths the library computes have room for the mesh, whichever of its faces and edges are visible.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};
use pinhole::{
    mesh_buffers, strip_buffers, BinError, Camera, Cull, Mesh, MeshBuffers, Object, Scene, Viewport,
};
use pinhole::{Affine, Angle, Frame};

const VERTICES: [[i16; 3]; 3] = [[-9, -9, 0], [9, -9, 0], [0, 9, 0]];

/// A mesh of this many equal faces, and as many edges.
macro_rules! repeated {
    ($count:literal) => {
        match Mesh::new(&VERTICES, 0, &[[0, 1, 2]; $count]) {
            Ok(mesh) => match mesh.with_edges(&[[0, 1]; $count]) {
                Ok(mesh) => mesh,
                Err(_) => panic!("edges"),
            },
            Err(_) => panic!("faces"),
        }
    };
}

const FEW: Mesh<'static> = repeated!(16);
const MANY: Mesh<'static> = repeated!(17);

fn camera() -> Camera {
    let viewport = Viewport::new(Point::zero(), Size::new(40, 40)).expect("a viewport");
    let sphere = MANY.bounding_sphere();
    Camera::framing(&sphere, &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO).expect("a sphere")
}

#[test]
fn bins_have_room_for_all_faces_and_no_more() {
    let (mut buffers, camera) = (mesh_buffers!(FEW, MANY), camera());
    assert_eq!((buffers.cache.len(), buffers.bins.len(), buffers.edge_bins.len()), (3, 17 + 2, 0));
    assert_eq!(mesh_buffers!(FEW).bins.len(), 16 + 1);
    let instance = camera.place(&MANY, &Affine::identity()).with_cull(Cull::None);
    let projected = instance.transform(&mut buffers.cache);
    assert!(projected.bin_faces(&mut buffers.bins).is_ok());
    let short = projected.bin_faces(&mut buffers.bins[..18]).err();
    assert_eq!(short, Some(BinError::Storage { needed: 19, given: 18 }));
}

#[test]
fn bins_have_room_for_all_edges_and_no_more() {
    let (mut buffers, camera) = (mesh_buffers!(edges: MANY), camera());
    assert_eq!((buffers.cache.len(), buffers.bins.len(), buffers.edge_bins.len()), (3, 0, 17 + 2));
    let both = mesh_buffers!(faces, edges: MANY);
    assert_eq!((both.cache.len(), both.bins.len(), both.edge_bins.len()), (3, 19, 19));
    let instance = camera.place(&MANY, &Affine::identity());
    let projected = instance.transform(&mut buffers.cache);
    assert!(projected.bin_edges(&mut buffers.edge_bins).is_ok());
    assert!(projected.bin_edges(&mut buffers.edge_bins[..18]).is_err());
}

#[test]
fn strips_have_room_for_their_rows_and_no_more() {
    let mut strip = strip_buffers!(BinaryColor, 13, 5);
    let area = embedded_graphics::primitives::Rectangle::new(Point::zero(), Size::new(13, 100));
    let rows = |bytes: &mut [u8]| {
        let band = Frame::new(area, BinaryColor::Off).next_band(bytes).ok().flatten();
        band.map(|band| band.area().size.height)
    };
    assert_eq!(rows(&mut strip.colors), Some(5));
    assert_eq!(rows(&mut strip.colors[..9]), Some(4));
    assert_eq!(strip.depths.len(), 13 * 5);
    const WIDTH: usize = 240; // a length of any integer type
    assert_eq!(strip_buffers!(Rgb565, WIDTH, 8, no depth).colors.len(), 3840);
}

/// The objects of a scene are binned at the same time: each has its own part of both buffers.
#[test]
fn a_scene_has_room_for_all_its_objects_and_no_more() {
    const OBJECTS: usize = 3;
    let mut buffers = mesh_buffers!([FEW; OBJECTS], [MANY; 1]);
    assert_eq!((buffers.cache.len(), buffers.bins.len()), (4 * 3, 3 * (16 + 1) + 17 + 2));
    let mut scene = Scene::<(), 4>::new();
    for mesh in [&FEW, &FEW, &FEW, &MANY] {
        scene.add(Object::new(mesh, Affine::identity(), ()).with_cull(Cull::None)).expect("room for four");
    }
    let camera = camera();
    let placed = scene.place(&camera);
    assert_eq!((placed.cache_len(), placed.face_bins_len()), (buffers.cache.len(), buffers.bins.len()));
    assert!(placed.bin_faces(&mut buffers.cache, &mut buffers.bins).is_ok());
    assert!(placed.bin_faces(&mut buffers.cache, &mut buffers.bins[1..]).is_err());
    static SCENE: MeshBuffers!([FEW; OBJECTS], [MANY; 1]) = mesh_buffers!([FEW; OBJECTS], [MANY; 1]);
    assert_eq!(SCENE.cache.len(), mesh_buffers!([FEW; 4]).cache.len());
}
