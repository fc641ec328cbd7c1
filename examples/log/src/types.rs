//! One of each type whose Format is written by hand.

use defmt::debug;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, View, World};
use pinhole::{
    bands::{DirtyRegions, TransferCost},
    camera::Window,
    math::Sphere,
    mesh::{Hierarchy, Node},
    prelude::*,
    Angle,
};

const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
const SQUARE: [[i16; 3]; 4] = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]];

pub(crate) fn log() {
    let mesh = Mesh::new(&SQUARE, -3, &[[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let mesh = mesh.with_edges(&[[0, 1], [1, 2]]).expect("edges");
    let (mut cache, mut face_bins, mut edge_bins) = ([ScreenVertex::EMPTY; 3], [0; 4], [0; 4]);
    debug!("{}", mesh);
    debug!("{}", Viewport::new(Point::new(8, 0), Size::new(128, 64)).expect("a viewport"));

    let [near, far] = [1, 100].map(Scalar::from_int);
    let lens = Projection::perspective(Angle::degrees(30), AREA.size, near, far).expect("a field of view");
    let instance = camera([0, 6, 40], &lens).place(&mesh, &Affine::identity());
    debug!("{}", instance);
    let transformed = instance.transform(&mut cache);
    debug!("{}", transformed);
    debug!("{}", transformed.bin_faces(&mut face_bins).expect("room"));
    debug!("{}", transformed.bin_edges(&mut edge_bins).expect("room"));

    let mut painter = Painter::<Gray8, 8, 4>::new();
    instance.faces(|_| Gray8::WHITE).sorted(&mut painter).expect("room");
    debug!("{}", painter);
    debug!("{}", painter.order());

    let mut frame = Frame::new(AREA, Gray8::BLACK);
    let mut strip = [0; 1024];
    debug!("{}", frame.next_band(&mut strip).expect("room"));
    debug!("{}", frame);
    let part = Rectangle::new(Point::new(3, 4), Size::new(5, 6));
    debug!("{}", DepthBuffer::new(part, &mut [0; 30]).expect("room"));
    let mut dirty = DirtyRegions::<4>::new(AREA, TransferCost::new(8, TransferCost::MIPI_DCS));
    dirty.mark(part);
    debug!("{}", dirty);

    debug!("{}", Hierarchy::new(&mut [Node::root(Affine::identity())]).expect("a tree"));
    let half = Scalar::from_bits(1 << 15);
    debug!("{}", Sphere { centre: Point3::from_ints(1, 2, -3), radius: half });
    debug!("{}", Vector3::<View>::new(half, half, half));
    debug!("{}", Window { left: -half, right: half, bottom: -half, top: half });

    let move_on = Affine::<Model, World>::translation(Vector3::from_ints(1, 2, -3));
    debug!("{}", move_on);
    let mut picture = [Gray8::BLACK; 6];
    let mut picture = Picture::new(&mut picture, Size::new(3, 2)).expect("room");
    debug!("{}", picture);
    debug!("{}", picture.pixels());
    let grey = ShadeTable::<Gray8>::new(Rgb888::WHITE);
    debug!("{}", grey);
    debug!("{}", grey.lit([256, 128, 0]));

    let [zero, one, two] = [0, 1, 2].map(Scalar::from_int);
    let window = Window { left: -two, right: two, bottom: -one, top: one };
    let volume = Projection::parallel_from_reference(Point3::from_ints(0, 0, 1), window, zero, -two);
    debug!("{}", volume.expect("a volume"));
    let lens =
        Projection::perspective(Angle::degrees(90), AREA.size, one, one + two).expect("near before far");
    debug!("{}", lens);
    debug!("{}", camera([0, 0, 2], &lens));
}

fn camera([x, y, z]: [i16; 3], lens: &Projection) -> Camera {
    let (eye, origin) = (Point3::from_ints(x, y, z), Point3::from_ints(0, 0, 0));
    let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0)).expect("a direction");
    Camera::new(&view, lens, &Viewport::new(AREA.top_left, AREA.size).expect("a viewport"))
}
