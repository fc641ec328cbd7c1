//! One of each type whose Format is written by hand.

use crate::film::{camera, AREA};
use defmt::debug;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Affine, Corner, DepthBuffer, Dirty, Frame, Hierarchy, Mesh, Node, Painter, Point3, Scalar, Sphere,
    Vector3, Viewport, Window, WindowCost,
};

const SQUARE: [[i16; 3]; 4] = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]];

pub(crate) fn log() {
    let mesh = Mesh::new(&SQUARE, -3, &[[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let mesh = mesh.with_edges(&[[0, 1], [1, 2]]).expect("edges");
    let (mut corners, mut records, mut more) = ([Corner::EMPTY; 3], [0; 3], [0; 3]);
    debug!("{}", mesh);
    debug!("{}", Viewport::new(Point::new(8, 0), Size::new(128, 64)).expect("a viewport"));

    let placed = camera(40).place(&mesh, &Affine::identity());
    debug!("{}", placed);
    let transformed = placed.transform(&mut corners);
    debug!("{}", transformed);
    debug!("{}", transformed.faces(&mut records).expect("room"));
    debug!("{}", transformed.edges(&mut more).expect("room"));

    let mut painter = Painter::<Gray8, 8, 4>::new();
    painter.add(&placed, |_| Gray8::WHITE).expect("room");
    debug!("{}", painter);
    debug!("{}", painter.order());

    let mut frame = Frame::new(AREA, Gray8::BLACK);
    let mut strip = [0; 1024];
    debug!("{}", frame.next_band(&mut strip).expect("room"));
    debug!("{}", frame);
    let part = Rectangle::new(Point::new(3, 4), Size::new(5, 6));
    debug!("{}", DepthBuffer::new(part, &mut [0; 30]).expect("room"));
    let mut dirty = Dirty::<4>::new(AREA, WindowCost::new(8, WindowCost::MIPI_DCS));
    dirty.mark(part);
    debug!("{}", dirty);

    debug!("{}", Hierarchy::new(&mut [Node::root(Affine::identity())]).expect("a tree"));
    let half = Scalar::from_bits(1 << 15);
    debug!("{}", Sphere { centre: Point3::from_ints(1, 2, -3), radius: half });
    debug!("{}", Vector3::<pinhole::space::View>::new(half, half, half));
    debug!("{}", Window { left: -half, right: half, bottom: -half, top: half });
}
